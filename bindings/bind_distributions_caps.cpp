// Spherical caps, their intersections and projections.
#include "bindings/register.h"
#include "bindings/vectorize.h"
#include "core/distributions/cap_region.h"
#include "core/distributions/projected_cap.h"

namespace pivot::bindings {

namespace {

constexpr Number number(const char* name, double low, double high) { return {.name = name, .low = low, .high = high}; }
constexpr Direction direction(const char* name) { return {{name}}; }

void register_single(py::module_& distributions) {
    define(
        distributions, "cap_solid_angle", R"(The solid angle of a cap, in steradians.

versine: (...) in [0, 2]. Returns (...). [Dupuy17 Eq 5])",
        []<class T>(T h) {
            return solid_angle(Cap<T>{{}, h});
        },
        number("versine", 0, 2));
    define(
        distributions, "cap_contains", R"(Whether a direction lies in a cap.

axis, omega: (..., 3) unit; versine: (...) in [0, 2]. Returns (...) bool.)",
        []<class T>(Vec3<T> axis, T h, Vec3<T> omega) {
            return contains(Cap<T>{axis, h}, omega);
        },
        direction("axis"), number("versine", 0, 2), direction("omega"));
    define(
        distributions, "cap_sample", R"(A direction uniform over a cap.

axis: (..., 3) unit; versine: (...) in [0, 2]; u: (..., 2) in [0, 1). Returns (..., 3), unit.)",
        []<class T>(Vec3<T> axis, T h, Vec2<T> u) {
            return sample(Cap<T>{axis, h}, u);
        },
        direction("axis"), number("versine", 0, 2), UnitSquare{"u"});
    define(
        distributions, "cap_pdf", R"(The density of cap_sample, per steradian: 0 outside the cap.

axis, omega: (..., 3) unit; versine: (...) in (0, 2]. Returns (...).)",
        []<class T>(Vec3<T> axis, T h, Vec3<T> omega) {
            return pdf_omega(Cap<T>{axis, h}, omega);
        },
        direction("axis"), Number{.name = "versine", .low = 0, .high = 2, .open_low = true}, direction("omega"));
    define(
        distributions, "sphere_light_cap", R"(The cap that a sphere covers, seen from the origin.

center: (..., 3) and radius: (...) >= 0, in one unit of length. Returns axis (..., 3) and versine (...): 2, the whole
sphere of directions, from inside the sphere or on it. [Dupuy17 Sec 5.1])",
        []<class T>(Vec3<T> center, T radius) {
            const Cap<T> cap = cap_of_sphere(center, radius);
            return std::tuple(cap.axis, cap.versine);
        },
        Vector{"center"}, number("radius", 0, std::numeric_limits<double>::max()));
    define(
        distributions, "cap_cosine_integral",
        R"(The integral of max(0, omega . normal) over a cap, cut by the horizon: its projected solid angle.

axis, normal: (..., 3) unit; versine: (...) in [0, 2]. Returns (...), in [0, pi]. [Peters19 Cases 1-3])",
        []<class T>(Vec3<T> axis, T h, Vec3<T> normal) {
            return clamped_cosine_integral(Cap<T>{axis, h}, normal);
        },
        direction("axis"), number("versine", 0, 2), direction("normal"));
}

void register_intersections(py::module_& distributions) {
    define(
        distributions, "cap_intersection", R"(The solid angle inside two caps, in steradians.

axis1, axis2: (..., 3) unit; versine1, versine2: (...) in [0, 2]. Returns (...). [Dupuy17 Eq 35-36, in forms that keep
small caps' bits and cover caps that overlap all around])",
        []<class T>(Vec3<T> axis1, T h1, Vec3<T> axis2, T h2) {
            return intersection_solid_angle(Cap<T>{axis1, h1}, Cap<T>{axis2, h2});
        },
        direction("axis1"), number("versine1", 0, 2), direction("axis2"), number("versine2", 0, 2));
    define(
        distributions, "cap_intersection_approximate", R"(The solid angle inside two caps by a cubic, in steradians.

Exact where one cap holds the other or they are apart. Arguments as of cap_intersection. [Dupuy17 Eq 37-38])",
        []<class T>(Vec3<T> axis1, T h1, Vec3<T> axis2, T h2) {
            return intersection_solid_angle_approximate(Cap<T>{axis1, h1}, Cap<T>{axis2, h2});
        },
        direction("axis1"), number("versine1", 0, 2), direction("axis2"), number("versine2", 0, 2));
    define(
        distributions, "cap_intersection_at", R"(cap_intersection, given the angle between the axes.

versine1, versine2: (...) in [0, 2]; separation: (...) in [0, pi], radians. Returns (...).)",
        []<class T>(T h1, T h2, T angle) { return intersection_solid_angle(h1, h2, separation_of_angle(angle)); },
        number("versine1", 0, 2), number("versine2", 0, 2), number("separation", 0, 3.1415928));
    define(
        distributions, "cap_intersection_approximate_at",
        R"(cap_intersection_approximate, given the angle between the axes.

versine1, versine2: (...) in [0, 2]; separation: (...) in [0, pi], radians. Returns (...).)",
        []<class T>(T h1, T h2, T angle) {
            return intersection_solid_angle_approximate(h1, h2, separation_of_angle(angle));
        },
        number("versine1", 0, 2), number("versine2", 0, 2), number("separation", 0, 3.1415928));
    define(
        distributions, "cap_intersection3", R"(The solid angle inside three caps, in steradians.

axis1, axis2, axis3: (..., 3) unit; versine1, versine2, versine3: (...) in [0, 2]. Returns (...). For specular occlusion
above the horizon: light, bent cone and hemisphere. [Dupuy17 Eq 23, clipped])",
        []<class T>(Vec3<T> axis1, T h1, Vec3<T> axis2, T h2, Vec3<T> axis3, T h3) {
            return intersection_solid_angle(std::array{Cap<T>{axis1, h1}, Cap<T>{axis2, h2}, Cap<T>{axis3, h3}});
        },
        direction("axis1"), number("versine1", 0, 2), direction("axis2"), number("versine2", 0, 2), direction("axis3"),
        number("versine3", 0, 2));
    define(
        distributions, "cap_intersection_sample", R"(A direction uniform over the intersection of two caps.

axis1, axis2: (..., 3) unit; versine1, versine2: (...) in [0, 2], 1 to cut a cap by the horizon about the other axis;
u: (..., 2) in [0, 1). Returns (..., 3), unit; an axis of the two if the intersection is empty.)",
        []<class T>(Vec3<T> axis1, T h1, Vec3<T> axis2, T h2, Vec2<T> u) {
            return sample_intersection(Cap<T>{axis1, h1}, Cap<T>{axis2, h2}, u);
        },
        direction("axis1"), number("versine1", 0, 2), direction("axis2"), number("versine2", 0, 2), UnitSquare{"u"});
    define(
        distributions, "cap_intersection_pdf",
        R"(The density of cap_intersection_sample, per steradian: 0 outside the intersection.

Arguments as of cap_intersection_sample, with omega: (..., 3) unit for u. Returns (...).)",
        []<class T>(Vec3<T> axis1, T h1, Vec3<T> axis2, T h2, Vec3<T> omega) {
            return pdf_omega_intersection(Cap<T>{axis1, h1}, Cap<T>{axis2, h2}, omega);
        },
        direction("axis1"), number("versine1", 0, 2), direction("axis2"), number("versine2", 0, 2), direction("omega"));
}

void register_projected(py::module_& distributions) {
    constexpr Number versine{.name = "versine", .low = 0, .high = 1, .open_low = true};
    define(
        distributions, "projected_cap_geometry", R"(The rim of a cap in the frame of a normal.

axis, normal: (..., 3) unit; versine: (...) in (0, 1]. Returns r_x, r_y, r_z, c_x, c_z and t_x, each (...): extents and
centre, z along the normal, x along the horizon to the axis, and the x where rim and horizon meet (>= 1 if they do not).
[Peters19 suppl. Sec 1])",
        []<class T>(Vec3<T> axis, T h, Vec3<T> normal) {
            const ProjectedCap<T> p = projected_cap(Cap<T>{axis, h}, normal);
            return std::tuple(p.r_x, p.r_y, p.r_z, p.c_x, p.c_z, p.t_x);
        },
        direction("axis"), versine, direction("normal"));
    define(
        distributions, "projected_cap_sample",
        R"(A direction in a cap and above the horizon, by projected solid angle: uniform in it, or nearly so.

axis, normal: (..., 3) unit; versine: (...) in (0, 1]; u: (..., 2) in [0, 1). Returns (..., 3), unit; a direction on the
horizon if the cap is below it. [Peters19])",
        []<class T>(Vec3<T> axis, T h, Vec3<T> normal, Vec2<T> u) {
            return sample(projected_cap(Cap<T>{axis, h}, normal), u);
        },
        direction("axis"), versine, direction("normal"), UnitSquare{"u"});
    define(
        distributions, "projected_cap_pdf", R"(The density of projected_cap_sample, per steradian.

axis, normal, omega: (..., 3) unit; versine: (...) in (0, 1]. Returns (...), 0 outside the cap and below the horizon.
[Peters19 suppl. Sec 2])",
        []<class T>(Vec3<T> axis, T h, Vec3<T> normal, Vec3<T> omega) {
            return pdf_omega(projected_cap(Cap<T>{axis, h}, normal), omega);
        },
        direction("axis"), versine, direction("normal"), direction("omega"));
    define(
        distributions, "projected_cap_invert", R"(The u at which projected_cap_sample returns omega.

axis, normal, omega: (..., 3) unit, omega in the cap and above the horizon; versine: (...) in (0, 1]. Returns (..., 2).)",
        []<class T>(Vec3<T> axis, T h, Vec3<T> normal, Vec3<T> omega) {
            return invert(projected_cap(Cap<T>{axis, h}, normal), omega);
        },
        direction("axis"), versine, direction("normal"), direction("omega"));
    define(
        distributions, "projected_cap_warp",
        R"(The warp of a cap whose axis is below the horizon, from the cut disk that it samples uniformly.

axis, normal: (..., 3) unit; versine: (...) in (0, 1]; d_x, d_y: (...) in the disk, d_x <= -t_x. Returns omega (..., 3),
in the frame of projected_cap_geometry, its density (...) with respect to projected solid angle, and the cut disk's area
(...). [Peters19 suppl. Sec 2])",
        []<class T>(Vec3<T> axis, T h, Vec3<T> normal, T d_x, T d_y) {
            const ProjectedCap<T> p = projected_cap(Cap<T>{axis, h}, normal);
            if (p.z >= T(0)) fail("axis", "must be below the horizon");
            if (d_x * d_x + d_y * d_y > T(1)) fail("d_x, d_y", "must be in the unit disk");
            const T d_z = safe_sqrt((T(1) - d_x) * (T(1) + d_x) - d_y * d_y);
            const WarpedPoint<T> point = warp(p, Vec3<T>(d_x, d_y, d_z));
            return std::tuple(point.omega, point.density, p.disk);
        },
        direction("axis"), versine, direction("normal"), number("d_x", -1, 0), number("d_y", -1, 1));
    define(
        distributions, "projected_cap_density_bound",
        R"(A bound of max / min density of projected_cap_sample with respect to projected solid angle.

axis, normal: (..., 3) unit; versine: (...) in (0, 1). Returns (...) >= 1. [Peters19 suppl. Eq 4])",
        []<class T>(Vec3<T> axis, T h, Vec3<T> normal) {
            return density_ratio_bound(projected_cap(Cap<T>{axis, h}, normal));
        },
        direction("axis"), Number{.name = "versine", .low = 0, .high = 1, .open_low = true, .open_high = true},
        direction("normal"));
    define(
        distributions, "projected_cap_worst_density_bound",
        R"(The maximum of projected_cap_density_bound over all elevations of a sphere light.

inverse_sine: (...) > 1, the distance of the sphere over its radius. Returns (...): sqrt(2) from 2 on.
[Peters19 suppl. Sec 3.4])",
        []<class T>(T inverse_sine) { return worst_density_ratio_bound(inverse_sine); },
        Number{.name = "inverse_sine", .low = 1, .open_low = true});
}

}  // namespace

void register_caps(py::module_& distributions) {
    register_single(distributions);
    register_intersections(distributions);
    register_projected(distributions);
}

}  // namespace pivot::bindings
