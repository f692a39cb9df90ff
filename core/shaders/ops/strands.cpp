// What shaders may ask of curves where rays meet them.
#include "core/geometry/curves.h"
#include "core/shaders/ops/spaces.h"
#include "core/shaders/ops/tables.h"

namespace pivot {
namespace {

Batch is_strand(const Place& place) {
    return gather([&](std::size_t lane) {
        const Mesh* mesh = place.lanes.meshes[lane];
        return mesh && mesh->curves && mesh->curves->shape != CurveShape::ball ? 1.0f : 0.0f;
    });
}

/// m, of the object's own space; 0 of a mesh and of balls. [Cycles 4.5 geom/curve.h, curve_thickness]
Batch strand_thickness(const Place& place) {
    const Lanes u = store(place.barycentric.x);
    return gather([&](std::size_t lane) {
        const Mesh* mesh = place.lanes.meshes[lane];
        if (!mesh || !mesh->curves || mesh->curves->shape == CurveShape::ball) return 0.0f;
        const CurvePoint* keys = &mesh->curves->keys[mesh->curves->segments[place.lanes.triangles[lane]]];
        return 2.0f * lerp(keys[1].w, keys[2].w, u[lane]);
    });
}

/// Along a curve, or along the first edge of a mesh's triangle; unit.
Vec3b strand_tangent(const Place& place) {
    if (place.lanes.is_world()) return Vec3b(Batch(0.0f));
    const HitTriangleOf<Batch>& t = place.lanes.corners;
    return unit(t.world_from_object.vector(t.corner_b - t.corner_a));
}

/// What the Hair BSDF lies along: a curve, or the other edge of a mesh's triangle from its first corner; unit.
/// [Cycles 4.5 svm/closure.h, geom/triangle.h, triangle_dPdudv]
Vec3b hair_tangent(const Place& place) {
    if (place.lanes.is_world()) return Vec3b(Batch(0.0f));
    const HitTriangleOf<Batch>& t = place.lanes.corners;
    return select(is_strand(place) > Batch(0.0f), strand_tangent(place),
                  unit(t.world_from_object.vector(t.corner_c - t.corner_a)));
}

/// Along a curve; elsewhere what else there is.
Vec3b along_curve(const Place& place, const Vec3b& otherwise) {
    return select(is_strand(place) > Batch(0.0f), strand_tangent(place), otherwise);
}

/// Towards the viewer, across the curve; 0 of a mesh. [Cycles 4.5 geom/curve.h, curve_tangent_normal]
Vec3b strand_tangent_normal(const Place& place) {
    const Vec3b along = strand_tangent(place), wo = place.lanes.wo;
    return is_strand(place) * unit(wo - dot(along, wo) * along);
}

constexpr std::array ops{
    op<is_strand>("is_strand"),           op<strand_thickness>("strand_thickness"),
    op<strand_tangent>("strand_tangent"), op<hair_tangent>("hair_tangent"),
    op<along_curve>("along_curve"),       op<strand_tangent_normal>("strand_tangent_normal"),
};

}  // namespace

std::span<const OpKind> strand_ops() { return ops; }

}  // namespace pivot
