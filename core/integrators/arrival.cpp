#include "core/integrators/arrival.h"

#include "core/integrators/openness.h"
#include "core/simd/pack.h"

namespace pivot {
namespace {

MaterialOf<Batch> pack_materials(const std::array<const Material*, batch_size>& materials) {
    constexpr std::size_t without_lobes = lobes_place, with_one = lobes_place + all_numbers<LobeOf>;
    const auto have_lobe = [&](std::size_t k) {
        return std::ranges::any_of(materials, [&](const Material* material) { return material->lobes[k].kind > 0.0f; });
    };
    if (!have_lobe(0)) return pack<MaterialOf, without_lobes>(materials);
    return have_lobe(1) ? pack<MaterialOf>(materials) : pack<MaterialOf, with_one>(materials);
}

}  // namespace

std::size_t batch_count(const Scene& scene, std::span<const Arrival* const> arrivals) {
    const std::uint32_t first = arrivals[0]->material;
    const bool is_constant = scene.shaders()[first].is_constant();
    std::size_t count = 1;
    while (count < std::min(batch_size, arrivals.size())) {
        const std::uint32_t material = arrivals[count]->material;
        if (material != first && !(is_constant && scene.shaders()[material].is_constant())) break;
        ++count;
    }
    return count;
}

namespace {

/// Arrivals side by side, where they are. Lanes past the last repeat it.
struct Arrived {
    std::array<const Arrival*, batch_size> lanes;
    ArrivalOf<Batch> arrivals;
    HitTriangleOf<Batch> corners;
    SurfacePointOf<Batch> point;
};

Arrived find_places(const Scene& scene, std::span<const Arrival* const> arrivals) {
    std::array<const Arrival*, batch_size> lanes;
    std::array<HitTriangleOf<float>, batch_size> triangles;
    std::array<const HitTriangleOf<float>*, batch_size> triangle_lanes;
    for (std::size_t i = 0; i < batch_size; ++i) {
        const std::size_t place = std::min(i, arrivals.size() - 1);
        lanes[i] = arrivals[place];
        if (i == place) triangles[i] = scene.hit_triangle(lanes[i]->hit, lanes[i]->direction);
        triangle_lanes[i] = &triangles[place];
    }
    const ArrivalOf<Batch> arrived = pack<ArrivalOf>(lanes);
    const HitTriangleOf<Batch> corners = pack<HitTriangleOf>(triangle_lanes);
    return {lanes, arrived, corners, surface_point(corners, arrived.hit.barycentric, -arrived.direction)};
}

void run(const Scene& scene, const Program& program, const Arrived& at, std::uint32_t bounce, ProgramMemory& memory) {
    const ArrivalOf<Batch>& arrived = at.arrivals;
    const Openness openness = [&](const OpennessQuestion& question) {
        std::array<std::uint32_t, batch_size> instances;
        for (std::size_t i = 0; i < batch_size; ++i) instances[i] = at.lanes[i]->hit.instance;
        return openness_around(scene, at.point, instances, question);
    };
    PlaceLanes place_lanes{.meshes = {},
                           .objects = {},
                           .triangles = {},
                           .corners = at.corners,
                           .wo = -arrived.direction,
                           .front = at.point.front,
                           .ray_length_m = arrived.hit.distance_m,
                           .ray_kind = arrived.ray_kind,
                           .bounce = WordBatch(bounce),
                           .camera = &scene.camera_facts(),
                           .footprint_m = arrived.footprint_m,
                           .openness = &openness};
    for (std::size_t i = 0; i < batch_size; ++i) {
        place_lanes.meshes[i] = &scene.mesh_of(at.lanes[i]->hit);
        place_lanes.objects[i] = &scene.facts_of(at.lanes[i]->hit);
        place_lanes.triangles[i] = at.lanes[i]->hit.triangle;
    }
    run_on_surfaces(program, place_lanes, at.point, arrived.hit.barycentric, memory);
}

}  // namespace

TransparencyOf<Batch> transparency_of(const Scene& scene, std::span<const Arrival* const> arrivals,
                                      std::uint32_t bounce, ProgramMemory& memory) {
    const Shader& shader = scene.shaders()[arrivals[0]->material];
    if (shader.is_constant()) {
        std::array<const Transparency*, batch_size> lanes;
        for (std::size_t i = 0; i < batch_size; ++i) {
            const Arrival& arrival = *arrivals[std::min(i, arrivals.size() - 1)];
            lanes[i] = &scene.shaders()[arrival.material].constants.transparency;
        }
        return pack<TransparencyOf>(lanes);
    }
    if (shader.has_varying_transparency())
        run(scene, shader.transparency, find_places(scene, arrivals), bounce, memory);
    return transparency_at(shader, memory.registers);
}

ArrivalBatch make_arrivals(const Scene& scene, std::span<const Arrival* const> arrivals, std::uint32_t bounce,
                           ProgramMemory& memory) {
    const Arrived at = find_places(scene, arrivals);
    const Shader& shader = scene.shaders()[arrivals[0]->material];
    const BatchMask is_behind = at.point.front < Batch(0.0f);
    if (shader.is_constant()) {
        std::array<const Material*, batch_size> materials;
        for (std::size_t i = 0; i < batch_size; ++i) materials[i] = &scene.shaders()[at.lanes[i]->material].constants;
        ArrivalBatch batch{at.point, pack_materials(materials)};
        turn_over(batch.material, is_behind);
        return batch;
    }
    run(scene, shader.program, at, bounce, memory);
    const SurfacePointOf<Batch>& point = at.point;
    const Vec3b wo = -at.arrivals.direction;
    ArrivalBatch batch{point, material_at(shader, memory.registers)};
    turn_over(batch.material, is_behind);
    const auto unit_of = [](const Vec3b& v, const Vec3b& otherwise) {
        const Batch v2 = dot(v, v);
        const BatchMask has_length = v2 > tiny<Batch> && v2 <= std::numeric_limits<Batch>::max();
        return select(has_length, v / sqrt(select(has_length, v2, Batch(1.0f))), otherwise);
    };
    const auto unit = [&](const std::array<std::uint32_t, 3>& registers, const Vec3b& otherwise) {
        const auto& r = memory.registers;
        return unit_of(Vec3b(r[registers[0]], r[registers[1]], r[registers[2]]), otherwise);
    };
    const Vec3b smooth = batch.point.frame.z;
    // A normal of no length, or of no number, leaves the surface's own; such a tangent any.
    const Vec3b turned = shader.normal ? unit(*shader.normal, smooth) : smooth;
    if (shader.normal) {
        const BatchMask reflects = batch.material.has_glossy() || batch.material.lobes[0].kind > Batch(0.0f);
        set_shading_normal(batch.point, turned, wo, reflects);
    }
    if (shader.tangent) set_tangent(batch.point, unit(*shader.tangent, batch.point.frame.x));
    const Vec3b none(Batch(0.0f));
    turn_normals(batch.material, [&](const Vec3b& normal) {
        const Vec3b turned_to = unit_of(normal, none);
        const Vec3b reflecting = reflecting_normal(batch.point.normal_geometric, wo, turned_to);
        return select(dot(turned_to, turned_to) > Batch(0.0f), batch.point.frame.to_local(reflecting), none);
    });
    if (!shader.normal) return batch;
    batch.bump.normal = batch.point.frame.to_local(turned);
    if (shader.normal_is_own) return batch;
    const Batch cos_turned = dot(turned, smooth), cos2 = max(cos_turned * cos_turned, tiny<Batch>);
    batch.bump.normal_smooth = batch.point.frame.to_local(smooth);
    batch.bump.alpha2 = clamp01(Batch(0.125f) * (Batch(1.0f) / cos2 - Batch(1.0f)));
    return batch;
}

}  // namespace pivot
