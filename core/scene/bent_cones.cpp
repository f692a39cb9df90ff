#include "core/scene/bent_cones.h"

#include <tbb/parallel_for.h>

#include <numeric>

#include "core/math/frame.h"

namespace pivot {
namespace {

constexpr std::size_t ray_count = 128;
/// How far towards a triangle's middle a ray starts: clear of walls that stand on its edges.
constexpr float inset = 1.0f / 64.0f;

/// Uniform over the hemisphere about z, in opposite pairs of azimuths: their mean is exactly along z. Neighbours in a
/// packet are of like azimuth.
std::array<Vec3f, ray_count> hemisphere_points() {
    std::array<Vec3f, ray_count> points;
    constexpr float golden_angle = 2.39996323f;
    for (std::size_t i = 0; i < ray_count / 2; ++i) {
        const float z = (static_cast<float>(i) + 0.5f) / (ray_count / 2), radius = sqrt(1.0f - z * z);
        const float phi = golden_angle * static_cast<float>(i);
        points[2 * i] = {radius * cos(phi), radius * sin(phi), z};
        points[2 * i + 1] = {-points[2 * i].x, -points[2 * i].y, z};
    }
    std::sort(points.begin(), points.end(),
              [](const Vec3f& a, const Vec3f& b) { return atan2(a.y, a.x) < atan2(b.y, b.x); });
    return points;
}

Vec3f corner_normal(const Mesh& mesh, std::size_t triangle, int corner) {
    const Triangle& t = mesh.triangles[triangle];
    const Vec3f given = mesh.normals(triangle)[static_cast<std::size_t>(corner)];
    if (length_squared(given) > 0.0f) return given;
    const Vec3f n = cross(mesh.positions[t.y] - mesh.positions[t.x], mesh.positions[t.z] - mesh.positions[t.x]);
    return length_squared(n) > 0.0f ? normalize(n) : Vec3f(0.0f, 0.0f, 1.0f);
}

/// A triangle at a site, as rays leave over it.
struct Exit {
    Vec3f offset;   ///< from the vertex to where they start, but for the height
    Vec3f towards;  ///< unit, along the triangle
    Vec3f normal;
};

/// The cone of a site on one side.
Cap<float> trace_cone(const RayTracer& ray_tracer, const Vec3f& position, const Vec3f& normal,
                      std::span<const Exit> exits, float side, float error_m, float reach_m) {
    static const std::array<Vec3f, ray_count> points = hemisphere_points();
    const Frame<float> frame = frame_from_z(normal);
    std::array<Ray, ray_count> rays;
    std::size_t count = 0;
    for (const Vec3f& point : points) {
        const Vec3f omega = frame.to_world(point);
        // From the triangle that the ray passes over, of those that do not rise above it.
        const Exit* best = nullptr;
        for (const Exit& exit : exits) {
            const bool is_above = side * dot(exit.normal, omega) > 0.0f;
            if (is_above && (!best || dot(exit.towards, omega) > dot(best->towards, omega))) best = &exit;
        }
        if (best) rays[count++] = {position + best->offset + error_m * side * best->normal, omega, 0.0f, reach_m};
    }
    std::array<std::uint8_t, ray_count> occluded;
    ray_tracer.occluded(std::span(rays).first(count), std::span(occluded).first(count));
    Vec3f sum(0.0f);
    std::size_t free = 0;
    for (std::size_t i = 0; i < count; ++i) {
        if (occluded[i] != 0) continue;
        sum += rays[i].direction;
        ++free;
    }
    const float size = length(sum);
    return {size > 0.0f ? sum / size : normal, static_cast<float>(free) / ray_count};
}

}  // namespace

BentConeSites::BentConeSites(const Mesh& mesh) {
    struct Corner {
        std::array<float, 6> key;  ///< position and normal, rounded so that seams close
        std::uint32_t triangle;
        int corner;
    };
    float extent = 0.0f;
    for (const Vec3f& p : mesh.positions) extent = std::max(extent, max_component(abs(p)));
    const float steps = extent > 0.0f ? 0x1p20f / extent : 0.0f;
    std::vector<Corner> corners;
    corners.reserve(3 * mesh.triangles.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        for (int k = 0; k < 3; ++k) {
            const Vec3f p = round(mesh.positions[mesh.triangles[t][k]] * steps),
                        n = round(corner_normal(mesh, t, k) * 512.0f);
            corners.push_back({{p.x, p.y, p.z, n.x, n.y, n.z}, static_cast<std::uint32_t>(t), k});
        }
    }
    std::stable_sort(corners.begin(), corners.end(), [](const Corner& a, const Corner& b) { return a.key < b.key; });
    triangle_sites.resize(mesh.triangles.size());
    triangles.reserve(corners.size());
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Corner& c = corners[i];
        if (i == 0 || c.key != corners[i - 1].key) {
            const auto first = static_cast<std::uint32_t>(i);
            sites.push_back(
                {mesh.triangles[c.triangle][c.corner], corner_normal(mesh, c.triangle, c.corner), first, first});
        }
        triangles.push_back(c.triangle);
        ++sites.back().end;
        triangle_sites[c.triangle][c.corner] = static_cast<std::uint32_t>(sites.size() - 1);
    }
}

float LightReach::from(const Vec3f& point) const {
    if (is_infinite || positions.empty()) return std::numeric_limits<float>::infinity();
    return std::accumulate(positions.begin(), positions.end(), 0.0f, [&](float farthest, const Vec3f& position) {
        return std::max(farthest, length(position - point));
    });
}

BentCones::BentCones(const RayTracer& ray_tracer, const Mesh& mesh, std::shared_ptr<const BentConeSites> sites,
                     const Transform& world_from_object, const LightReach& reach,
                     const std::function<bool()>& should_stop)
    : sites_(std::move(sites)), cones_(sites_->sites.size()) {
    tbb::parallel_for(std::size_t{0}, cones_.size(), [&](std::size_t i) {
        if (should_stop()) return;
        const BentConeSites::Site& site = sites_->sites[i];
        const Vec3f position = world_from_object.point(mesh.positions[site.vertex]);
        Vec3f normal = normalize(world_from_object.normal(site.normal));
        std::vector<Exit> exits;
        float size_m = std::max(max_component(abs(position)), max_component(abs(world_from_object.translation)));
        for (std::uint32_t k = site.first; k < site.end; ++k) {
            const Triangle& t = mesh.triangles[sites_->triangles[k]];
            const Vec3f a = world_from_object.point(mesh.positions[t.x]),
                        b = world_from_object.point(mesh.positions[t.y]),
                        c = world_from_object.point(mesh.positions[t.z]);
            const Vec3f out = world_from_object.normal(
                cross(mesh.positions[t.y] - mesh.positions[t.x], mesh.positions[t.z] - mesh.positions[t.x]));
            const Vec3f offset = ((a + b + c) / 3.0f - position) * inset;
            // The normal of a sliver is noise.
            const float longest2 = std::max(length_squared(b - a), length_squared(c - a));
            if (!(length(cross(b - a, c - a)) > 1e-6f * longest2) || !(length_squared(out) > 0.0f)) continue;
            exits.push_back({offset, normalize(offset), normalize(out)});
            size_m = std::max({size_m, max_component(abs(a)), max_component(abs(b)), max_component(abs(c))});
        }
        if (!(length_squared(normal) > 0.5f)) normal = Vec3f(0.0f, 0.0f, 1.0f);  // of a mesh scaled to nothing
        if (exits.empty()) {  // triangles without an area, which no ray hits
            cones_[i] = {Cap<float>{normal, 1.0f}, Cap<float>{-normal, 1.0f}};
            return;
        }
        if (dot(normal, exits.front().normal) < 0.0f) normal = -normal;
        const float error_m = 0x1p-19f * size_m, reach_m = reach.from(position);
        cones_[i] = {trace_cone(ray_tracer, position, normal, exits, 1.0f, error_m, reach_m),
                     trace_cone(ray_tracer, position, -normal, exits, -1.0f, error_m, reach_m)};
    });
}

Cap<float> BentCones::at(const RayHit& hit, bool front) const {
    const Triangle& corners = sites_->triangle_sites[hit.triangle];
    const std::array<float, 3> weights{1.0f - hit.barycentric.x - hit.barycentric.y, hit.barycentric.x,
                                       hit.barycentric.y};
    Vec3f sum(0.0f);
    float versine = 0.0f;
    for (int k = 0; k < 3; ++k) {
        const Cap<float>& cone = cones_[corners[k]][front ? 0 : 1];
        const float share = weights[static_cast<std::size_t>(k)] * cone.versine;
        sum += share * cone.axis;
        versine += share;
    }
    const float size = length(sum);
    return size > 0.0f ? Cap<float>{sum / size, versine} : Cap<float>{Vec3f(0.0f, 0.0f, 1.0f), 0.0f};
}

}  // namespace pivot
