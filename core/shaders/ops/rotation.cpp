// Rotations as matrices, which are a program's constants where their angles are, and what they do to a vector.
#include "core/shaders/ops/tables.h"

namespace pivot {
namespace {

/// By row.
using Matrix = std::tuple<Vec3b, Vec3b, Vec3b>;

/// About x, then y, then z, by angles in radians.
Matrix euler_rotation(const Vec3b& angles) {
    const Batch cx = cos(angles.x), cy = cos(angles.y), cz = cos(angles.z);
    const Batch sx = sin(angles.x), sy = sin(angles.y), sz = sin(angles.z);
    return {Vec3b(cy * cz, sy * sx * cz - cx * sz, sy * cx * cz + sx * sz),
            Vec3b(cy * sz, sy * sx * sz + cx * cz, sy * cx * sz - sx * cz), Vec3b(-sy, cy * sx, cy * cx)};
}

/// About an axis of any length, by an angle in radians; none about an axis of no length.
Matrix axis_rotation(const Vec3b& axis, Batch angle) {
    const Batch size = length(axis);
    const BatchMask turns = size != Batch(0.0f);
    const Vec3b a = axis / select(turns, size, Batch(1.0f));
    const Batch one(1.0f), c = select(turns, cos(angle), one), s = sin(angle), rest = one - c;
    return {Vec3b(c + rest * a.x * a.x, rest * a.x * a.y - a.z * s, rest * a.x * a.z + a.y * s),
            Vec3b(rest * a.x * a.y + a.z * s, c + rest * a.y * a.y, rest * a.y * a.z - a.x * s),
            Vec3b(rest * a.x * a.z - a.y * s, rest * a.y * a.z + a.x * s, c + rest * a.z * a.z)};
}

/// A matrix by row times a vector, and an offset.
Vec3b transform(const Vec3b& v, const Vec3b& x, const Vec3b& y, const Vec3b& z, const Vec3b& offset) {
    return Vec3b(dot(x, v), dot(y, v), dot(z, v)) + offset;
}

constexpr std::array ops{
    op<euler_rotation>("euler_rotation"),
    op<axis_rotation>("axis_rotation"),
    op<transform>("transform"),
};

}  // namespace

std::span<const OpKind> rotation_ops() { return ops; }

}  // namespace pivot
