// GGX over caps and polygons.
#include "bindings/register.h"
#include "bindings/vectorize.h"
#include "core/distributions/elliptic_cone.h"
#include "core/distributions/ggx_contour.h"

namespace pivot::bindings {

namespace {

constexpr Direction wo{{"wo"}}, axis{{"axis"}};
constexpr Number cap_versine{.name = "versine", .low = 0, .high = 2, .open_low = true, .open_high = true};
constexpr Number alpha_x{.name = "alpha_x", .low = 0, .high = 1, .open_low = true};
constexpr Number alpha_y{.name = "alpha_y", .low = 0, .high = 1, .open_low = true};

template <class T>
GgxCap<T> checked_cap(const Vec3<T>& o, const Vec3<T>& c, T h, T ax, T ay) {
    if (!(o.z > T(0))) fail("wo", "must be above the surface");
    return ggx_cap(o, Cap<T>{c, h}, ax, ay);
}

template <class T>
GgxCap<T> valid_cap(const Vec3<T>& o, const Vec3<T>& c, T h, T ax, T ay) {
    const GgxCap<T> g = checked_cap(o, c, h, ax, ay);
    if (!is_valid(g)) fail("versine", "makes a cap whose half vectors leave the upper hemisphere: cut it");
    return g;
}

template <size_t N>
auto points_of() {
    return vectorized(
        []<class T>(Vec3<T> o, Vec3<T> c, T h, T ax, T ay) {
            const GgxCap<T> g = valid_cap(o, c, h, ax, ay);
            const std::array<GgxCapPoint<T>, N> rule = points<N>(g);
            T sum = T(0);
            for (const GgxCapPoint<T>& point : rule) sum += point.weight;
            std::array<Vec3<T>, N> omega_i;
            std::array<T, N> weight;
            for (size_t k = 0; k < N; ++k) {
                omega_i[k] = rule[k].omega_i;
                weight[k] = rule[k].weight * (integral(g) / sum);
            }
            return std::tuple(omega_i, weight);
        },
        wo, axis, cap_versine, alpha_x, alpha_y);
}

py::object ggx_cap_points(const py::object& o, const py::object& c, const py::object& h, const py::object& ax,
                          const py::object& ay, int count) {
    if (count == 1) return points_of<1>()(o, c, h, ax, ay);
    if (count == 4) return points_of<4>()(o, c, h, ax, ay);
    if (count == 8) return points_of<8>()(o, c, h, ax, ay);
    if (count == 16) return points_of<16>()(o, c, h, ax, ay);
    fail("count", "must be 1, 4, 8 or 16");
}

void register_cap(py::module_& distributions) {
    define(
        distributions, "ggx_cap_integral",
        R"(The integral over a cap of D(h) / (4 cos_o), GGX without masking, Fresnel and horizon; and whether it holds.

wo, axis: (..., 3) unit, in the shading frame (z = normal), wo above; versine: (...) in (0, 2); alpha_x, alpha_y: (...) in
(0, 1]. Returns the integral (...) and valid (...) bool: False, and the integral 0, where the cap's half vectors are no
cone or leave the upper hemisphere. float32 is within 1e-4 relative for alphas from 1e-3 and half-angles from 1e-5.)",
        []<class T>(Vec3<T> o, Vec3<T> c, T h, T ax, T ay) {
            const GgxCap<T> g = checked_cap(o, c, h, ax, ay);
            return std::tuple(integral(g), is_valid(g));
        },
        wo, axis, cap_versine, alpha_x, alpha_y);
    define(
        distributions, "ggx_cap_sample",
        R"(A direction in a cap by the GGX lobe, its weight D(h) / (4 cos_o) / pdf, and its pdf per steradian.

wo, axis: (..., 3) unit; versine: (...) in (0, 2); alpha_x, alpha_y: (...) in (0, 1]; u: (..., 2) in [0, 1). Returns
omega_i (..., 3) unit, weight (...) and pdf (...). ValueError where ggx_cap_integral is not valid.)",
        []<class T>(Vec3<T> o, Vec3<T> c, T h, T ax, T ay, Vec2<T> u) {
            const GgxCapPoint<T> point = sample(valid_cap(o, c, h, ax, ay), u);
            return std::tuple(point.omega_i, point.weight, point.pdf_omega);
        },
        wo, axis, cap_versine, alpha_x, alpha_y, UnitSquare{"u"});
    define(
        distributions, "ggx_cap_pdf", R"(The density of ggx_cap_sample, per steradian: 0 outside the cap.

Arguments as of ggx_cap_sample, with omega_i: (..., 3) unit for u. Returns (...).)",
        []<class T>(Vec3<T> o, Vec3<T> c, T h, T ax, T ay, Vec3<T> omega_i) {
            return pdf_omega(valid_cap(o, c, h, ax, ay), omega_i);
        },
        wo, axis, cap_versine, alpha_x, alpha_y, Direction{{"omega_i"}});
    distributions.def("ggx_cap_points", ggx_cap_points, R"(A fixed rule of 1, 4, 8 or 16 directions in a cap.

wo, axis: (..., 3) unit; versine: (...) in (0, 2); alpha_x, alpha_y: (...) in (0, 1]. Returns omega_i (..., count, 3) unit
and weights (..., count), which sum to ggx_cap_integral: the integral of D(h) / (4 cos_o) times a smooth f, such as
masking and Fresnel, is about the sum of weight f(omega_i). One point is the highlight's centre.)",
                      py::arg("wo"), py::arg("axis"), py::arg("versine"), py::arg("alpha_x"), py::arg("alpha_y"),
                      py::arg("count"));
}

void register_polygon(py::module_& distributions) {
    define(
        distributions, "ggx_polygon_integral",
        R"(The integral over a polygon of D(h) / (4 cos_o), GGX without masking and Fresnel, by its contour.

wo: (..., 3) unit, in the shading frame (z = normal), above the surface; alpha_x, alpha_y: (...) in (0, 1]; polygon:
(..., n, 3), its vertices relative to the shaded point, either way round; what is below the surface is clipped. Returns
the integral (...) and the half vector (..., 3) of the highlight's centre. Converged to the precision of the input.)",
        []<class T>(Vec3<T> o, T ax, T ay, const std::vector<Vec3<T>>& polygon) {
            if (!(o.z > T(0))) fail("wo", "must be above the surface");
            const auto result = ggx_polygon<T>(o, ax, ay, polygon);
            return std::tuple(result.integral, result.half);
        },
        wo, alpha_x, alpha_y, Polygon{"polygon"});
    define(
        distributions, "ggx_polygon_chords_integral",
        R"(ggx_polygon_integral with a number of chords for each edge, in place of convergence.

chords: (...) >= 1, a whole number. Other arguments and results as of ggx_polygon_integral.)",
        []<class T>(Vec3<T> o, T ax, T ay, const std::vector<Vec3<T>>& polygon, T chords) {
            if (!(o.z > T(0))) fail("wo", "must be above the surface");
            if (chords != std::floor(chords)) fail("chords", "must be a whole number");
            const auto result = ggx_polygon_chords<T>(o, ax, ay, polygon, static_cast<int>(chords));
            return std::tuple(result.integral, result.half);
        },
        wo, alpha_x, alpha_y, Polygon{"polygon"}, Number{.name = "chords", .low = 1, .high = 65536});
}

}  // namespace

void register_ggx(py::module_& distributions) {
    register_cap(distributions);
    register_polygon(distributions);
}

}  // namespace pivot::bindings
