// What shading one point by one light costs, in FLOP slots: time x the peak of single-precision FMA of the same thread
// and instruction set, measured in the same run. Prints name,slots,nanoseconds lines; compiled by analytic.py.
#include <chrono>
#include <cstdio>
#include <random>

#include "core/distributions/sptd.h"
#include "core/shading/ggx_area_light.h"
#include "core/simd/batch.h"

using namespace pivot;

namespace {

double seconds(const auto& body) {
    double best = 1e30;
    for (int repeat = 0; repeat < 5; ++repeat) {
        const auto start = std::chrono::steady_clock::now();
        body();
        best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
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

/// Eight neighbours of a frame: one surface and light, views a pixel apart.
struct Neighbours {
    GgxLobe<Batch> lobe;
    Cap<Batch> cap;
    Pivot<Batch> pivot;
};

/// A frame of mixed roughness: alpha even in its root, views to 85 degrees, lights of 0.5..30 degrees near the
/// highlight, one in ten across the horizon.
std::vector<Neighbours> frame(std::size_t count) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> u(0.0f, 1.0f);
    std::vector<Neighbours> result;
    for (std::size_t i = 0; i < count; ++i) {
        const float alpha = sqr(0.05f + 0.9f * u(random)), half_angle = 0.0087f * std::pow(60.0f, u(random));
        const float theta = 1.48f * u(random);
        const Vec3f view(std::sin(theta), 0.0f, std::cos(theta));
        Vec3f axis = normalize(ggx_sample(view, alpha, alpha, Vec2f(u(random), u(random))));
        const bool crosses = u(random) < 0.1f;
        axis.z = crosses ? (2.0f * u(random) - 1.0f) * half_angle : std::max(axis.z, 1.2f * std::sin(half_angle));
        axis = normalize(axis);
        Lanes x, z;
        for (std::size_t lane = 0; lane < batch_size; ++lane) {
            const float turned = std::min(theta + 5e-4f * static_cast<float>(lane), 1.5f);
            x[lane] = std::sin(turned);
            z[lane] = std::cos(turned);
        }
        Neighbours n;
        n.lobe = {{load(x), Batch(0.0f), load(z)}, Batch(alpha), Batch(1.5f), true, Batch(20.0f)};
        n.cap = {{Batch(axis.x), Batch(axis.y), Batch(axis.z)}, Batch(versine_of_angle(half_angle))};
        n.pivot = {{-load(x), Batch(0.0f), load(z)}, Batch(std::min(1.2f * alpha, 0.9f))};
        result.push_back(n);
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
    const std::vector<Neighbours> batches = frame(4096);
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
        const GgxCap<Batch> g = ggx_cap(n.lobe.wo_local, n.cap, n.lobe.alpha, n.lobe.alpha);
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
