#include "core/geometry/curves.h"

#include <cmath>
#include <stdexcept>

namespace pivot {
namespace {

/// Of the normal at the tube's silhouette, where it stands across the ray: there it faces the viewer by so much.
constexpr float max_sine = 0.9999f;

Vec3f any_across(const Vec3f& direction) { return frame_from_z(direction).x; }

Vec3f unit_or(const Vec3f& v, const Vec3f& otherwise) {
    const float v2 = length_squared(v);
    return v2 > 1e-30f ? v / std::sqrt(v2) : otherwise;
}

}  // namespace

Mesh make_curves(const std::string& name, std::span<const Vec3f> positions, std::span<const float> radii_m,
                 std::span<const std::int32_t> offsets, const CurveSettings& settings) {
    const auto fail = [&](const std::string& what) { throw std::invalid_argument("curves '" + name + "': " + what); };
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const Vec3f& p = positions[i];
        if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z) || !std::isfinite(radii_m[i]) ||
            radii_m[i] < 0.0f)
            fail("point " + std::to_string(i) + " is not finite, or its radius is negative");
    }
    if (offsets.empty() || offsets.front() != 0 || static_cast<std::size_t>(offsets.back()) != positions.size())
        fail("offsets must go from 0 to the number of points");
    for (std::size_t i = 1; i < offsets.size(); ++i) {
        if (offsets[i] < offsets[i - 1]) fail("offset " + std::to_string(i) + " is out of order");
    }
    Mesh mesh;
    mesh.name = name;
    Curves curves{.keys = {}, .segments = {}, .shape = settings.shape, .subdivisions = settings.subdivisions};
    const std::size_t curve_count = offsets.size() - 1;
    curves.keys.reserve(positions.size() + 2 * curve_count);
    curves.segments.reserve(positions.size());
    mesh.triangles.reserve(positions.size());
    const auto key = [&](std::uint32_t i) { return CurvePoint(positions[i], radii_m[i]); };
    for (std::uint32_t i = 0; settings.shape == CurveShape::ball && i < positions.size(); ++i) {
        curves.keys.push_back(key(i));
        curves.segments.push_back(i);
        mesh.triangles.emplace_back(i, i, i);
    }
    for (std::size_t curve = 0; settings.shape != CurveShape::ball && curve < curve_count; ++curve) {
        const auto first = static_cast<std::uint32_t>(offsets[curve]),
                   end = static_cast<std::uint32_t>(offsets[curve + 1]);
        if (end - first < 2) continue;
        for (std::uint32_t i = first; i + 1 < end; ++i) {
            curves.segments.push_back(static_cast<std::uint32_t>(curves.keys.size()) + (i - first));
            mesh.triangles.emplace_back(i, i + 1, i);
        }
        curves.keys.push_back(key(first));
        for (std::uint32_t i = first; i < end; ++i) curves.keys.push_back(key(i));
        curves.keys.push_back(key(end - 1));
    }
    mesh.curves = std::make_shared<const Curves>(std::move(curves));
    return mesh;
}

CurvePoint curve_point(const Curves& curves, std::uint32_t segment, float u) {
    const CurvePoint* p = &curves.keys[curves.segments[segment]];
    const CurvePoint linear = p[2] - p[0], square = 2.0f * p[0] - 5.0f * p[1] + 4.0f * p[2] - p[3],
                     cube = 3.0f * (p[1] - p[2]) + p[3] - p[0];
    return p[1] + 0.5f * u * (linear + u * (square + u * cube));
}

CurvePoint curve_derivative(const Curves& curves, std::uint32_t segment, float u) {
    const CurvePoint* p = &curves.keys[curves.segments[segment]];
    const CurvePoint linear = p[2] - p[0], square = 2.0f * p[0] - 5.0f * p[1] + 4.0f * p[2] - p[3],
                     cube = 3.0f * (p[1] - p[2]) + p[3] - p[0];
    return 0.5f * (linear + u * (2.0f * square + 3.0f * u * cube));
}

namespace {

/// Whose edges touch the surface at a place with barycentric weights uv.
HitTriangleOf<float> triangle_at(const Vec3f& position, const Vec2f& uv, const Vec3f& edge_u, const Vec3f& edge_v) {
    const Vec3f corner = position - uv.x * edge_u - uv.y * edge_v;
    return {.corner_a = corner,
            .corner_b = corner + edge_u,
            .corner_c = corner + edge_v,
            .normal_a = Vec3f(0.0f),
            .normal_b = Vec3f(0.0f),
            .normal_c = Vec3f(0.0f),
            .world_from_object = {},
            .normal_matrix = Mat3<float>(1.0f)};
}

HitTriangleOf<float> triangle_on_ball(const CurvePoint& ball, const Vec2f& uv, const Vec3f& direction) {
    const Vec2f across = uv / std::max(std::sqrt(dot(uv, uv)) / max_sine, 1.0f);
    const Vec3f normal = ball_frame(direction).to_world(Vec3f(across, std::sqrt(1.0f - dot(across, across))));
    const Frame<float> touching = frame_from_z(normal);
    return triangle_at(Vec3f(ball) + ball.w * normal, uv, ball.w * touching.x, ball.w * touching.y);
}

}  // namespace

HitTriangleOf<float> touching_triangle(const Curves& curves, std::uint32_t segment, const Vec2f& uv,
                                       const Vec3f& direction) {
    if (curves.shape == CurveShape::ball) return triangle_on_ball(curves.keys[segment], uv, direction);
    const CurvePoint axis = curve_point(curves, segment, uv.x);
    const Vec3f wo = -normalize(direction), along(curve_derivative(curves, segment, uv.x));
    const Vec3f tangent = unit_or(along, any_across(wo));
    const Vec3f across = unit_or(cross(tangent, wo), any_across(tangent)), front = cross(across, tangent);
    const float sine = std::clamp(uv.y, -max_sine, max_sine);
    const Vec3f normal = sine * across + std::sqrt(1.0f - sine * sine) * front;
    const Vec3f on_tube = curves.shape == CurveShape::round ? normal : uv.y * across;
    const Vec3f position = Vec3f(axis) + axis.w * on_tube;
    const Vec3f edge_u = std::max(length(along), 1e-6f) * tangent,
                edge_v = std::max(axis.w, 1e-9f) * cross(normal, tangent);
    return triangle_at(position, uv, edge_u, edge_v);
}

}  // namespace pivot
