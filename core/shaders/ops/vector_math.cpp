// The operations of Blender's Vector Math node that are not those of its Math node on each number.
#include "core/shaders/ops/spaces.h"
#include "core/shaders/ops/tables.h"

namespace pivot {
namespace {

Vec3b project(const Vec3b& a, const Vec3b& b) { return divided(dot(a, b), dot(b, b)) * b; }

Vec3b reflect(const Vec3b& incident, const Vec3b& normal) {
    const Vec3b n = unit(normal);
    return incident - Batch(2.0f) * dot(incident, n) * n;
}

Vec3b refract(const Vec3b& incident, const Vec3b& normal, Batch eta) {
    const Vec3b n = unit(normal);
    const Batch cosine = dot(n, incident), k = Batch(1.0f) - eta * eta * (Batch(1.0f) - cosine * cosine);
    return select(k < Batch(0.0f), Vec3b(Batch(0.0f)), eta * incident - (eta * cosine + sqrt(max(k, Batch(0.0f)))) * n);
}

constexpr std::array ops{
    op<[](const Vec3b& a, const Vec3b& b) { return cross(a, b); }>("vector_cross_product"),
    op<project>("vector_project"),
    op<reflect>("vector_reflect"),
    op<refract>("vector_refract"),
    op<[](const Vec3b& a, const Vec3b& b, const Vec3b& c) { return select(dot(b, c) < Batch(0.0f), a, -a); }>(
        "vector_faceforward"),
    op<[](const Vec3b& a, const Vec3b& b) { return Batch(dot(a, b)); }>("vector_dot_product"),
    op<[](const Vec3b& a, const Vec3b& b) { return length(a - b); }>("vector_distance"),
    op<[](const Vec3b& a) { return length(a); }>("vector_length"),
    op<[](const Vec3b& a, Batch scale) { return a * scale; }>("vector_scale"),
    op<unit>("vector_normalize"),
};

}  // namespace

std::span<const OpKind> vector_math_ops() { return ops; }

}  // namespace pivot
