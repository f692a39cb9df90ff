#include "core/integrators/arrival.h"

#include "core/simd/pack.h"

namespace pivot {
namespace {

/// A place's neighbour, `along` the surface in m: barycentric coordinates go on past the triangle's edges.
Place neighbour(const Place& place, const Vec3b& along) {
    const HitTriangleOf<Batch>& triangle = place.lanes.corners;
    const Vec3b ab = triangle.corner_b - triangle.corner_a, ac = triangle.corner_c - triangle.corner_a;
    const Vec3b world_ab = triangle.world_from_object.vector(ab), world_ac = triangle.world_from_object.vector(ac);
    const Vec3b across = cross(world_ab, world_ac);
    const Batch area2 = max(dot(across, across), tiny<Batch>);
    const Batch u = dot(cross(along, world_ac), across) / area2, v = dot(cross(world_ab, along), across) / area2;
    Place next = place;
    next.position += along;
    next.barycentric += Vec2b(u, v);
    next.position_object += u * ab + v * ac;
    return next;
}

Vec3b normal_at(const Place& place) {
    const Batch front = place.lanes.front;
    return smooth_normal(place.lanes.corners, place.barycentric, front * place.normal_geometric) * front;
}

/// A place, and all the neighbours that a program looks at if it looks at any.
std::vector<Place>& places_at(const PlaceLanes& lanes, const SurfacePointOf<Batch>& point, const Vec2b& barycentric,
                              const Program& program, std::vector<Place>& places) {
    const HitTriangleOf<Batch>& t = lanes.corners;
    const Vec3b &n = point.normal_geometric, ab = t.corner_b - t.corner_a, ac = t.corner_c - t.corner_a;
    places.clear();
    places.push_back({.lanes = lanes,
                      .position = point.position,
                      .normal = {},
                      .normal_geometric = n,
                      .barycentric = barycentric,
                      .position_object = t.corner_a + barycentric.x * ab + barycentric.y * ac});
    places[0].normal = normal_at(places[0]);
    if (!program.needs_neighbours()) return places;
    // At the edges of the footprint: across the view, and along it.
    const Batch cos_view = max(dot(n, lanes.wo), Batch(1e-2f));
    const Frame<Batch> any_frame = frame_from_z(n);
    const Vec3b slope = lanes.wo - cos_view * n;
    const Batch slope2 = dot(slope, slope);
    const BatchMask head_on = slope2 < Batch(1e-6f);
    const Vec3b along = select(head_on, any_frame.x, slope * inverse_sqrt(max(slope2, tiny<Batch>)));
    for (const Vec3b& step : {cross(n, along) * lanes.footprint_m, along * (lanes.footprint_m / cos_view)}) {
        places.push_back(neighbour(places[0], step));
        places.back().normal = normal_at(places.back());
    }
    // Bump mapping looks as far whatever the view, and normals stay those of the place. [Cycles 4.5 svm/attribute.h]
    const auto [x, y] = bump_directions(n);
    for (const float width : program.bump_widths())
        for (const Vec3b& direction : {x, y})
            places.push_back(neighbour(places[0], direction * (lanes.footprint_m * Batch(width))));
    return places;
}

MaterialOf<Batch> pack_materials(const std::array<const Material*, batch_size>& materials) {
    constexpr std::size_t without_lobes = all_numbers<MaterialOf> - max_lobes * all_numbers<LobeOf>;
    const auto has_lobes = [](const Material* material) { return material->lobes[0].kind > 0.0f; };
    if (std::any_of(materials.begin(), materials.end(), has_lobes)) return pack<MaterialOf>(materials);
    return pack<MaterialOf, without_lobes>(materials);
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

ArrivalBatch make_arrivals(const Scene& scene, std::span<const Arrival* const> arrivals, std::uint32_t bounce,
                           ProgramMemory& memory) {
    std::array<const Arrival*, batch_size> lanes;
    std::array<HitTriangleOf<float>, batch_size> triangles;
    std::array<const HitTriangleOf<float>*, batch_size> triangle_lanes;
    std::array<const Material*, batch_size> materials;
    for (std::size_t i = 0; i < batch_size; ++i) {
        const std::size_t place = std::min(i, arrivals.size() - 1);
        lanes[i] = arrivals[place];
        if (i == place) triangles[i] = scene.hit_triangle(lanes[i]->hit);
        triangle_lanes[i] = &triangles[place];
        materials[i] = &scene.shaders()[lanes[i]->material].constants;
    }
    const ArrivalOf<Batch> arrived = pack<ArrivalOf>(lanes);
    const HitTriangleOf<Batch> corners = pack<HitTriangleOf>(triangle_lanes);
    const Vec3b wo = -arrived.direction;
    const SurfacePointOf<Batch> point = surface_point(corners, arrived.hit.barycentric, wo);
    const Shader& shader = scene.shaders()[lanes[0]->material];
    if (shader.is_constant()) return {arrived, point, pack_materials(materials)};
    PlaceLanes place_lanes{.meshes = {},
                           .objects = {},
                           .triangles = {},
                           .corners = corners,
                           .wo = wo,
                           .front = point.front,
                           .ray_length_m = arrived.hit.distance_m,
                           .ray_kind = arrived.ray_kind,
                           .bounce = WordBatch(bounce),
                           .camera = &scene.camera_facts(),
                           .footprint_m = arrived.footprint_m};
    for (std::size_t i = 0; i < batch_size; ++i) {
        place_lanes.meshes[i] = &scene.mesh_of(lanes[i]->hit);
        place_lanes.objects[i] = &scene.facts_of(lanes[i]->hit);
        place_lanes.triangles[i] = lanes[i]->hit.triangle;
    }
    memory.registers.resize(std::max<std::size_t>(memory.registers.size(), shader.program.register_count()));
    shader.program.run(places_at(place_lanes, point, arrived.hit.barycentric, shader.program, memory.places),
                       memory.registers);
    ArrivalBatch batch{arrived, point, material_at(shader, memory.registers)};
    if (shader.normal) {
        const auto& [x, y, z] = *shader.normal;
        const Vec3b normal(memory.registers[x], memory.registers[y], memory.registers[z]);
        const Batch n2 = dot(normal, normal);
        // A normal of no length, or of no number, leaves the surface's own.
        const BatchMask is_normal = n2 > tiny<Batch> && n2 <= std::numeric_limits<Batch>::max();
        const Vec3b unit = normal / sqrt(select(is_normal, n2, Batch(1.0f)));
        const BatchMask reflects = batch.material.has_glossy() || batch.material.lobes[0].kind > Batch(0.0f);
        const Vec3b smooth = batch.point.frame.z, turned = select(is_normal, unit, smooth);
        set_shading_normal(batch.point, turned, wo, reflects);
        const Batch cos_turned = dot(turned, smooth), cos2 = max(cos_turned * cos_turned, tiny<Batch>);
        batch.bump.normal = batch.point.frame.to_local(turned);
        if (shader.normal_is_own) return batch;
        batch.bump.normal_smooth = batch.point.frame.to_local(smooth);
        batch.bump.alpha2 = clamp01(Batch(0.125f) * (Batch(1.0f) / cos2 - Batch(1.0f)));
    }
    return batch;
}

}  // namespace pivot
