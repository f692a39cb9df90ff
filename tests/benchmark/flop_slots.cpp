// What shading one point by one light costs, in FLOP slots: time x the peak of single-precision FMA of the same thread
// and instruction set, measured in the same run. Prints name,slots,nanoseconds lines; compiled by analytic.py.
#include <cstdio>
#include <ctime>
#include <optional>
#include <vector>

#include "core/distributions/sptd.h"
#include "core/shading/ggx_area_light.h"
#include "core/simd/batch.h"

using namespace pivot;

namespace {

/// CPU time, which other work on the machine changes least.
double seconds(const auto& body) {
    double best = 1e30;
    for (int repeat = 0; repeat < 5; ++repeat) {
        const std::clock_t start = std::clock();
        body();
        best = std::min(best, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
    }
    return best;
}

volatile float sink;

double peak_flops() {
    constexpr int rounds = 4000000, chains = 10;
    std::array<Batch, chains> r;
    for (int k = 0; k < chains; ++k) r[static_cast<size_t>(k)] = Batch(1.0f + static_cast<float>(k));
    const Batch m(0.9999999f), c(1e-7f);
    const double time = seconds([&] {
        for (int i = 0; i < rounds; ++i)
            for (Batch& x : r) x = xsimd::fma(x, m, c);
    });
    Batch sum(0.0f);
    for (const Batch& x : r) sum += x;
    sink = store(sum)[0];
    return 2.0 * rounds * chains * static_cast<double>(batch_size) / time;
}

/// Neighbours in a frame's row, and one light.
struct Neighbours {
    GgxLobe<Batch> lobe;
    Cap<Batch> cap;
    Pivot<Batch> pivot;
};

struct Hit {
    Vec3f position, normal, view;
    float alpha;
};

struct Ball {
    Vec3f center;
    float radius, alpha;
};

/// 25 balls on a floor, each of its own roughness, 0.02..1.
std::vector<Ball> balls() {
    std::vector<Ball> result;
    for (int i = 0; i < 25; ++i) {
        const Vec3f center(1.1f * static_cast<float>(i % 5 - 2), 1.1f * static_cast<float>(i / 5 - 2), 0.5f);
        result.push_back({center, 0.5f, std::max(sqr(0.02f + 0.98f * static_cast<float>(i) / 24.0f), min_alpha)});
    }
    return result;
}

/// What the camera's ray through (x, y) of the unit square sees first.
std::optional<Hit> look(float x, float y) {
    const Vec3f eye(0.0f, -8.0f, 5.0f), ahead = normalize(-eye), right(1.0f, 0.0f, 0.0f), up = cross(right, ahead);
    const Vec3f ray = normalize(ahead + (x - 0.5f) * 0.9f * right + (0.5f - y) * 0.5f * up);
    float nearest = ray.z < 0.0f ? -eye.z / ray.z : 1e30f;
    Hit hit{eye + nearest * ray, {0.0f, 0.0f, 1.0f}, -ray, 0.25f};
    for (const Ball& ball : balls()) {
        const Vec3f to = ball.center - eye;
        const float along = dot(to, ray), under = sqr(ball.radius) - (dot(to, to) - sqr(along));
        const float t = along - std::sqrt(std::max(under, 0.0f));
        if (under <= 0.0f || t >= nearest) continue;
        nearest = t;
        hit = {eye + t * ray, (eye + t * ray - ball.center) / ball.radius, -ray, ball.alpha};
    }
    return nearest < 1e30f ? std::optional(hit) : std::nullopt;
}

/// A picture of the balls under three sphere lights, in batches of what is seen one after the other in a row.
std::vector<Neighbours> frame(int width, int height) {
    const std::array<std::pair<Vec3f, float>, 3> lights{
        {{{-3.0f, -4.0f, 5.0f}, 1.0f}, {{4.0f, -3.0f, 3.0f}, 0.5f}, {{1.0f, 5.0f, 4.0f}, 0.25f}}};
    std::vector<Neighbours> result;
    for (int row = 0; row < height; ++row) {
        std::vector<Hit> hits;
        for (int column = 0; column < width; ++column) {
            const auto hit = look((static_cast<float>(column) + 0.5f) / static_cast<float>(width),
                                  (static_cast<float>(row) + 0.5f) / static_cast<float>(height));
            if (hit) hits.push_back(*hit);
        }
        for (std::size_t first = 0; first + batch_size <= hits.size(); first += batch_size) {
            const auto hit = [&](std::size_t lane) -> const Hit& { return hits[first + lane]; };
            const Frame<Batch> local = frame_from_z(gather_vector([&](std::size_t i) { return hit(i).normal; }));
            const Vec3b position = gather_vector([&](std::size_t i) { return hit(i).position; });
            const Vec3b wo = local.to_local(gather_vector([&](std::size_t i) { return hit(i).view; }));
            const Batch alpha = gather([&](std::size_t i) { return hit(i).alpha; });
            for (const auto& [center, radius] : lights) {
                Cap<Batch> cap = cap_of_sphere(broadcast(center) - position, Batch(radius));
                cap.axis = local.to_local(cap.axis);
                const Pivot<Batch> pivot{{-wo.x, -wo.y, wo.z}, min(Batch(1.2f) * alpha, Batch(0.9f))};
                result.push_back({{wo, alpha, Batch(1.5f), true, Batch(20.0f)}, cap, pivot});
            }
        }
    }
    return result;
}

void report(const char* name, double peak, std::size_t points, double time) {
    const double each = time / static_cast<double>(points);
    std::printf("%s,%.0f,%.2f\n", name, each * peak, each * 1e9);
}

}  // namespace

int main() {
    const double peak = peak_flops();
    std::printf("peak GFLOP/s,%.1f,\n", peak * 1e-9);
    const std::vector<Neighbours> batches = frame(160, 90);
    const std::size_t points = batches.size() * batch_size;
    const auto measure = [&](const char* name, const auto& shade) {
        report(name, peak, points, seconds([&] {
                   Batch sum(0.0f);
                   for (const Neighbours& n : batches) sum += shade(n);
                   sink = store(sum)[0];
               }));
    };
    const Cap<Batch> horizon{{Batch(0.0f), Batch(0.0f), Batch(1.0f)}, Batch(1.0f)};
    measure("one SPTD lobe with the horizon exact (table apart)",
            [&](const Neighbours& n) { return integrate_uniform(n.pivot, n.cap, horizon); });
    measure("one SPTD lobe with the horizon by Eq 37 (table apart)", [&](const Neighbours& n) {
        return intersection_solid_angle_approximate(transform(n.pivot, n.cap), transform(n.pivot, horizon));
    });
    measure("the exact core with one point and G2 and both Fresnel curves", [&](const Neighbours& n) {
        const GgxCap<Batch> g = ggx_cap(n.lobe.wo_local, n.cap, n.lobe.alpha);
        const GgxCapPoint<Batch> point = center_point(g);
        const Batch cos_oh = point.cos_oh;
        return point.weight * IsotropicG2<Batch>(n.lobe.wo_local, n.lobe.alpha)(point.omega_i.z) *
               (schlick_weight(cos_oh) + fresnel_dielectric_weight(cos_oh, n.lobe.ior));
    });
    for (const float budget : {0.005f, 0.01f, 0.02f, 0.05f}) {
        const std::string name =
            "a frame of mixed roughness at budget " + std::to_string(budget * 100.0f).substr(0, 3) + " %";
        measure(name.c_str(), [&](const Neighbours& n) {
            const LobeSums<Batch> sums = integrate(ggx_cap_light(n.lobe, n.cap), Batch(budget)).sums;
            return sums.plain + sums.schlick + sums.dielectric;
        });
    }
    measure("a disk light at budget 2.0 %", [&](const Neighbours& n) {
        const Frame<Batch> frame_of_axis = frame_from_z(n.cap.axis);
        const Batch radius = sqrt(sin2_half_angle(n.cap));
        const AreaOutline<Batch> outline{n.cap.axis, radius * frame_of_axis.x, radius * frame_of_axis.y, true};
        return integrate(n.lobe, outline, Batch(0.02f)).sums.plain;
    });
    return 0;
}
