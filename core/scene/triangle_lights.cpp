#include "core/scene/triangle_lights.h"

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>
#include <unordered_map>

#include "core/sampling/warp.h"
#include "core/shaders/surface_places.h"
#include "core/simd/pack.h"

namespace pivot {
namespace {

/// How bright a triangle is whose emission is a program's, nearly: at a place in each lane, of both sides by turns.
float mean_brightness(const Shader& shader, const Mesh& mesh, const Instance& instance, std::uint32_t triangle,
                      const CameraFacts& camera, ProgramMemory& memory) {
    const HitTriangleOf<Batch> corners = broadcast<HitTriangleOf>(triangle_of(instance, mesh, triangle));
    const Batch lane = gather([](std::size_t i) { return static_cast<float>(i); });
    const Vec2b barycentric = barycentric_in_triangle(place_in_triangle(golden_point(lane, batch_size)));
    const auto world = [&](const Vec3b& edge) { return corners.world_from_object.vector(edge); };
    const Vec3b across = cross(world(corners.corner_b - corners.corner_a), world(corners.corner_c - corners.corner_a));
    const Batch area2_m2 = max(length(across), tiny<Batch>);
    const Vec3b wo = across / area2_m2 * gather([](std::size_t i) { return i % 2 == 0 ? 1.0f : -1.0f; });
    const SurfacePointOf<Batch> point = surface_point(corners, barycentric, wo);
    PlaceLanes lanes{.meshes = {},
                     .objects = {},
                     .triangles = {},
                     .corners = corners,
                     .wo = wo,
                     .front = point.front,
                     .ray_length_m = Batch(0.0f),
                     .ray_kind = WordBatch(diffuse_ray),
                     .bounce = WordBatch(1),
                     .camera = &camera,
                     .footprint_m = sqrt(area2_m2 * Batch(0.5f / batch_size))};
    lanes.meshes.fill(&mesh);
    lanes.objects.fill(&instance.facts);
    lanes.triangles.fill(triangle);
    run_on_surfaces(shader.program, lanes, point, barycentric, memory);
    const Lanes brightness = store(mean_component(abs(material_at(shader, memory.registers).emission)));
    return std::accumulate(brightness.begin(), brightness.end(), 0.0f) / batch_size;
}

/// A triangle's corners in its object's space, in whatever order it has them.
struct Corners {
    std::array<Vec3f, 3> positions;

    explicit Corners(const std::array<Vec3f, 3>& corners) : positions(corners) {
        std::ranges::sort(positions, [](const Vec3f& a, const Vec3f& b) {
            return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
        });
    }
    bool operator==(const Corners&) const = default;
};
struct CornersHash {
    std::size_t operator()(const Corners& corners) const {
        constexpr std::uint64_t odd = 0x9e3779b97f4a7c15u;  // of the golden ratio
        std::uint64_t h = 0;
        for (const Vec3f& p : corners.positions)
            for (int c = 0; c < 3; ++c) h = ((h ^ h >> 32) + std::bit_cast<std::uint32_t>(p[c] + 0.0f)) * odd;
        return static_cast<std::size_t>(h >> 16);
    }
};

}  // namespace

TriangleLights make_triangle_lights(const Mesh& mesh, const Instance& instance, std::span<const Shader> shaders,
                                    const CameraFacts& camera) {
    TriangleLights made;
    made.light_of_triangle.assign(mesh.triangles.size(), TriangleLights::no_light);
    if (mesh.curves) return made;  // found by the rays that meet them
    ProgramMemory memory;
    std::unordered_map<Corners, std::uint32_t, CornersHash> lights;
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
        const Shader& shader = shaders[material_of(instance, mesh, i)];
        const bool varies = shader.has_varying_emission();
        if (!varies && !shader.constants.is_emissive()) continue;
        const Rgb radiance =
            varies ? Rgb(mean_brightness(shader, mesh, instance, i, camera, memory)) : shader.constants.emission;
        if (radiance == Rgb(0.0f)) continue;
        const Triangle& t = mesh.triangles[i];
        const auto corner = [&](std::uint32_t v) { return instance.world_from_object.point(mesh.positions[v]); };
        const auto light = make_triangle_light({corner(t.x), corner(t.y), corner(t.z)}, radiance);
        if (!light) continue;
        const Corners corners({mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]});
        const auto [found, is_new] = lights.emplace(corners, static_cast<std::uint32_t>(made.lights.size()));
        made.light_of_triangle[i] = found->second;
        if (!is_new) continue;
        made.lights.push_back(*light);
        made.triangle_of_light.push_back(i);
        made.any_varies = made.any_varies || varies;
    }
    return made;
}

}  // namespace pivot
