#include "bindings/register.h"
#include "bindings/vectorize.h"
#include "core/distributions/ltc.h"

namespace pivot::bindings {

namespace {

BaseDistribution base_named(const std::string& name) {
    if (name == "uniform_sphere") return BaseDistribution::uniform_sphere;
    if (name == "uniform_hemisphere") return BaseDistribution::uniform_hemisphere;
    if (name == "clamped_cosine") return BaseDistribution::clamped_cosine;
    if (name == "squared_clamped_cosine") return BaseDistribution::squared_clamped_cosine;
    fail("base", "must be 'uniform_sphere', 'uniform_hemisphere', 'clamped_cosine' or 'squared_clamped_cosine'");
}

/// Adds fn(base, ...) over arrays, `base` a name.
template <class Fn, class... Specs>
void define_with_base(py::module_& module, const char* name, const char* doc, Fn fn, Specs... specs) {
    module.def(
        name,
        [fn, specs...](const std::string& base, std::conditional_t<true, const py::object&, Specs>... arguments) {
            const auto with_base = [fn, kind = base_named(base)](const auto&... values) { return fn(kind, values...); };
            return vectorized(with_base, specs...)(arguments...);
        },
        doc, py::arg("base"), py::arg(specs.name)...);
}

constexpr Matrix m_spec{.name = "m"};

template <class T>
Ltsd<T> ltc(const Mat3<T>& m) {
    return make_ltsd(BaseDistribution::clamped_cosine, m);
}

}  // namespace

void register_ltsd(py::module_& distributions) {
    define_with_base(
        distributions, "ltsd_base_sample_cosine",
        "ltsd_base_sample_cosine(base, xi): the cosine to z of a direction drawn from the base distribution "
        "D_o, by inverting "
        "its distribution at xi.\n\n"
        "base: 'uniform_sphere', 'uniform_hemisphere', 'clamped_cosine' or 'squared_clamped_cosine'; xi (...) "
        "in [0, 1].\n"
        "[Heitz16, supplement 1.1-1.4]",
        [](BaseDistribution base, auto xi) { return sample_base_theta(base, xi).x; },
        Number{.name = "xi", .low = 0, .high = 1});
    define_with_base(
        distributions, "ltsd_eval",
        "ltsd_eval(base, m, omega): the linearly transformed distribution D at omega, per steradian; also the "
        "pdf of "
        "ltsd_sample. Integrates to 1.\n\n"
        "m (..., 3, 3), invertible, its scale without effect: omega = m omega_o / |m omega_o|; omega (..., 3), "
        "unit.\n"
        "D = D_o(m^-1 omega / |m^-1 omega|) |det m^-1| / |m^-1 omega|^3. ValueError if m is singular.\n"
        "[Heitz16 (1)]",
        []<class T>(BaseDistribution base, const Mat3<T>& m, const Vec3<T>& omega) {
            return eval(make_ltsd(base, m), omega);
        },
        m_spec, Direction{"omega"});
    define_with_base(
        distributions, "ltsd_sample",
        "ltsd_sample(base, m, u): a direction (..., 3) drawn from D, with pdf ltsd_eval.\n\n"
        "m (..., 3, 3); u (..., 2) in [0, 1). [Heitz16, supplement, algorithm 1]",
        []<class T>(BaseDistribution base, const Mat3<T>& m, const Vec2<T>& u) {
            return sample(make_ltsd(base, m), u);
        },
        m_spec, UnitSquare{"u"});
    define_with_base(
        distributions, "ltsd_integrate_polygon",
        "ltsd_integrate_polygon(base, m, polygon): the integral of D over the directions of a polygon, in [0, "
        "1].\n\n"
        "m (..., 3, 3); polygon (..., n, 3), n >= 3 vertices relative to the shading point, in either order. "
        "Exact for all\n"
        "four bases; what falls below the base's horizon counts nothing. Relative error in float32 about 1e-7 "
        "/ angular size.\n"
        "[Heitz16, supplement 2.3]",
        []<class T>(BaseDistribution base, const Mat3<T>& m, const std::vector<Vec3<T>>& polygon) {
            return integrate<T>(make_ltsd(base, m), polygon);
        },
        m_spec, Polygon{"polygon"});
    define_with_base(
        distributions, "ltsd_mean_direction",
        "ltsd_mean_direction(base, m): the mean direction E[omega] (..., 3), of length <= 1.\n\n"
        "m (..., 3, 3). Exact to rounding. [Heitz16, supplement 2.4]",
        []<class T>(BaseDistribution base, const Mat3<T>& m) { return mean_direction(make_ltsd(base, m)); }, m_spec);
    define(
        distributions, "ltc_above_horizon",
        "ltc_above_horizon(m): the integral of the linearly transformed cosine over z > 0.\n\nm (..., 3, 3).",
        []<class T>(const Mat3<T>& m) { return integrate_above_horizon(ltc(m)); }, m_spec);
    define(
        distributions, "ltc_integrate_cap",
        "ltc_integrate_cap(m, axis, versine): the integral of the linearly transformed cosine over a cap's part at z > "
        "0,\n"
        "exact.\n\n"
        "m (..., 3, 3); axis (..., 3), unit; versine (...) = 1 - cos(half-angle), in [0, 2].",
        []<class T>(const Mat3<T>& m, const Vec3<T>& axis, T versine) {
            return integrate_above_horizon(ltc(m), Cap<T>{axis, versine});
        },
        m_spec, Direction{"axis"}, Number{.name = "versine", .low = 0, .high = 2});
    define(
        distributions, "ltc_integrate_polygon",
        "ltc_integrate_polygon(m, polygon): the integral of the linearly transformed cosine over a polygon's part at z "
        "> 0.\n\n"
        "m (..., 3, 3); polygon (..., n, 3), n >= 3 vertices relative to the shading point, in either order.",
        []<class T>(const Mat3<T>& m, const std::vector<Vec3<T>>& polygon) {
            return integrate_above_horizon<T>(ltc(m), std::span<const Vec3<T>>(polygon));
        },
        m_spec, Polygon{"polygon"});
}

}  // namespace pivot::bindings
