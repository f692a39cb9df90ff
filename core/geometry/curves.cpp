#include "core/geometry/curves.h"

#include <cmath>
#include <stdexcept>

#include "core/math/moving_transform.h"

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

Mesh moving_curves(const Mesh& mesh, std::span<const MeshStep> steps) {
    Curves moving = *mesh.curves;
    std::size_t points = 0;
    for (const Triangle& ends : mesh.triangles)
        points = std::max({points, std::size_t{ends.x} + 1, std::size_t{ends.y} + 1});
    const auto is_usable = [&](const MeshStep& step) {
        return step.positions.size() > points && std::ranges::all_of(step.positions, [](const Vec3f& p) {
                   return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
               });
    };
    if (steps.size() < 2 || steps.size() > MovingTransform::max_steps || !std::ranges::all_of(steps, is_usable))
        throw std::invalid_argument("curves '" + mesh.name +
                                    "': their motion needs 2 to 129 finite steps of as many points as they have");
    moving.steps.assign(steps.size(), moving.keys);
    for (std::size_t i = 0; i < steps.size(); ++i) {
        const auto put = [&](std::size_t key, std::uint32_t point) {
            CurvePoint& moved = moving.steps[i][key];
            moved = CurvePoint(steps[i].positions[point], moved.w);
        };
        const std::vector<std::uint32_t>& segments = moving.segments;
        for (std::size_t k = 0; k < segments.size(); ++k) {
            const std::uint32_t first = segments[k];
            const Triangle& ends = mesh.triangles[k];
            if (moving.shape == CurveShape::ball) {
                put(first, ends.x);
                continue;
            }
            if (k == 0 || segments[k - 1] + 1 != first) put(first, ends.x);
            put(first + 1, ends.x);
            put(first + 2, ends.y);
            if (k + 1 == segments.size() || segments[k + 1] != first + 1) put(first + 3, ends.y);
        }
    }
    Mesh moved = mesh;
    moved.curves = std::make_shared<const Curves>(std::move(moving));
    moved.steps.assign(steps.size(), MeshStep{});
    return moved;
}

namespace {

/// The four of a segment at a time.
std::array<CurvePoint, 4> keys_at(const Curves& curves, std::uint32_t segment, float time) {
    const std::uint32_t first = curves.segments[segment];
    std::array<CurvePoint, 4> keys;
    if (curves.steps.empty()) {
        std::copy_n(curves.keys.begin() + first, 4, keys.begin());
        return keys;
    }
    const BetweenSteps between(time, curves.steps.size());
    const auto &a = curves.steps[between.first], &b = curves.steps[between.first + 1];
    for (std::size_t i = 0; i < 4; ++i) keys[i] = between.of(a[first + i], b[first + i]);
    return keys;
}

CurvePoint ball_at(const Curves& curves, std::uint32_t ball, float time) {
    if (curves.steps.empty()) return curves.keys[ball];
    const BetweenSteps between(time, curves.steps.size());
    return between.of(curves.steps[between.first][ball], curves.steps[between.first + 1][ball]);
}

}  // namespace

CurvePoint curve_point(const Curves& curves, std::uint32_t segment, float u, float time) {
    const std::array<CurvePoint, 4> p = keys_at(curves, segment, time);
    const CurvePoint linear = p[2] - p[0], square = 2.0f * p[0] - 5.0f * p[1] + 4.0f * p[2] - p[3],
                     cube = 3.0f * (p[1] - p[2]) + p[3] - p[0];
    return p[1] + 0.5f * u * (linear + u * (square + u * cube));
}

CurvePoint curve_derivative(const Curves& curves, std::uint32_t segment, float u, float time) {
    const std::array<CurvePoint, 4> p = keys_at(curves, segment, time);
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
                                       const Vec3f& direction, float time) {
    if (curves.shape == CurveShape::ball) return triangle_on_ball(ball_at(curves, segment, time), uv, direction);
    const CurvePoint axis = curve_point(curves, segment, uv.x, time);
    const Vec3f wo = -normalize(direction), along(curve_derivative(curves, segment, uv.x, time));
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
