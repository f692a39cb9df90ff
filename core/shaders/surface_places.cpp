#include "core/shaders/surface_places.h"

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

}  // namespace

void run_on_surfaces(const Program& program, const PlaceLanes& lanes, const SurfacePointOf<Batch>& point,
                     const Vec2b& barycentric, ProgramMemory& memory) {
    program.run(places_at(lanes, point, barycentric, program, memory.places), memory.registers);
}

}  // namespace pivot
