// Curves with a thickness, such as hairs, and points with one, which are balls, in object space. They are kept beside a
// Mesh, whose triangles are then their segments, so that attributes, material slots and instances are those of meshes.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/geometry/mesh.h"
#include "core/geometry/surface_point.h"

namespace pivot {

/// How rays meet curves: as ribbons that face each ray, shaded as if they were round, as round tubes, or each point by
/// itself as a ball.
enum class CurveShape { ribbon, round, ball };

/// x, y, z and the radius, m.
using CurvePoint = glm::vec<4, float>;

/// Catmull-Rom splines through points.
struct Curves {
    std::vector<CurvePoint> keys;         ///< those of each curve, its first and its last twice; balls
    std::vector<std::uint32_t> segments;  ///< the first of the four keys of each; of balls the one
    CurveShape shape;
    std::uint32_t subdivisions;                    ///< straight parts of a ribbon's segment
    std::vector<std::vector<CurvePoint>> steps{};  ///< keys at even times, the first at 0, the last at 1; empty: still
};

struct CurveSettings {
    CurveShape shape = CurveShape::ribbon;
    std::uint32_t subdivisions = 3;
};

/// offsets: where in the points each curve starts, and their number; a curve of one point has no segment. The segments'
/// triangles name the points at their ends, the first again as third corner; those of balls the one. Throws
/// std::invalid_argument that names the mesh where a number is not finite, a radius negative or an offset out of order.
Mesh make_curves(const std::string& name, std::span<const Vec3f> positions, std::span<const float> radii_m,
                 std::span<const std::int32_t> offsets, const CurveSettings& settings);

/// A mesh of curves whose points are elsewhere at times: in each step the positions of all, and one more, as meshes
/// have. Throws std::invalid_argument that names it unless there are 2 to 129 of these, finite, and of all points.
Mesh moving_curves(const Mesh& mesh, std::span<const MeshStep> steps);

/// The spline, or how it changes, at u of [0, 1] along a segment, at a time.
CurvePoint curve_point(const Curves& curves, std::uint32_t segment, float u, float time);
CurvePoint curve_derivative(const Curves& curves, std::uint32_t segment, float u, float time);

/// A triangle that touches the tube where a ray meets it, object space; its barycentric weights of there are uv: u
/// along the segment, v in [-1, 1] across, the sine of the angle between the tube's normal and the ray in the plane
/// across the curve. Of balls uv is where the normal lies in ball_frame(). direction: the ray's, object space.
HitTriangleOf<float> touching_triangle(const Curves& curves, std::uint32_t segment, const Vec2f& uv,
                                       const Vec3f& direction, float time);

/// z: back along a ray, of any length.
inline Frame<float> ball_frame(const Vec3f& direction) { return frame_from_z(-normalize(direction)); }

}  // namespace pivot
