#include "bindings/register.h"
#include "bindings/vectorize.h"
#include "core/media/phase_over_cap.h"

namespace pivot::bindings {

namespace {

constexpr Number g_spec{.name = "g", .low = -1, .high = 1, .open_low = true, .open_high = true};
constexpr Number g_p_spec{.name = "g_p", .low = -1, .high = 1, .open_low = true, .open_high = true};
constexpr Number g_closed_spec{.name = "g", .low = -1, .high = 1};
constexpr Direction omega_o_spec{{"omega_o"}}, light_axis_spec{{"light_axis"}};
constexpr Number light_versine_spec{.name = "light_versine", .low = 0, .high = 2, .open_low = true};
constexpr Number mu_spec{.name = "mu", .low = -1, .high = 1};
constexpr Number xi_spec{.name = "xi", .low = 0, .high = 1};

}  // namespace

void register_media(py::module_& distributions) {
    define(
        distributions, "henyey_greenstein_eval",
        "henyey_greenstein_eval(g, mu): the phase function per steradian, also the pdf of its sampling.\n\n"
        "g (...) in (-1, 1), the mean cosine; mu (...): cosine between the directions of travel before and "
        "after. [Dupuy17 (26)]",
        []<class T>(T g, T mu) { return eval(HenyeyGreenstein<T>{g}, mu); }, g_spec, mu_spec);
    define(
        distributions, "henyey_greenstein_cdf", "henyey_greenstein_cdf(g, mu): the probability of a cosine <= mu.",
        []<class T>(T g, T mu) { return cdf(HenyeyGreenstein<T>{g}, mu); }, g_spec, mu_spec);
    define(
        distributions, "henyey_greenstein_sample_cosine",
        "henyey_greenstein_sample_cosine(g, xi): (mu, sin) by inverting the cdf at xi in [0, 1].",
        []<class T>(T g, T xi) {
            const Vec2<T> cosine = sample_cosine(HenyeyGreenstein<T>{g}, xi);
            return std::tuple(cosine.x, cosine.y);
        },
        g_spec, xi_spec);
    define(
        distributions, "henyey_greenstein_mean_cosine", "henyey_greenstein_mean_cosine(g): g itself.",
        []<class T>(T g) { return mean_cosine(HenyeyGreenstein<T>{g}); }, g_spec);
    define(
        distributions, "henyey_greenstein_cap_integral",
        "henyey_greenstein_cap_integral(g, omega_o, light_axis, light_versine): the phase function's integral over a "
        "sphere\n"
        "light's cap, in [0, 1], to half a percent. Arguments as of pivot_phase_cap_integral.",
        []<class T>(T g, const Vec3<T>& omega_o, const Vec3<T>& axis, T versine) {
            return integrate(HenyeyGreenstein<T>{g}, omega_o, Cap<T>{axis, versine});
        },
        g_spec, omega_o_spec, light_axis_spec, light_versine_spec);
    define(
        distributions, "pivot_phase_eval",
        "pivot_phase_eval(g_p, mu): the pivot phase function per steradian, also the pdf of its sampling.\n\n"
        "g_p (...) in (-1, 1): the pivot's place on the direction of travel, not the mean cosine. [Dupuy17 "
        "(25)]",
        []<class T>(T g_p, T mu) { return eval(PivotPhase<T>{g_p}, mu); }, g_p_spec, mu_spec);
    define(
        distributions, "pivot_phase_cdf", "pivot_phase_cdf(g_p, mu): the probability of a cosine <= mu.",
        []<class T>(T g_p, T mu) { return cdf(PivotPhase<T>{g_p}, mu); }, g_p_spec, mu_spec);
    define(
        distributions, "pivot_phase_sample_cosine",
        "pivot_phase_sample_cosine(g_p, xi): (mu, sin) by inverting the cdf at xi in [0, 1].",
        []<class T>(T g_p, T xi) {
            const Vec2<T> cosine = sample_cosine(PivotPhase<T>{g_p}, xi);
            return std::tuple(cosine.x, cosine.y);
        },
        g_p_spec, xi_spec);
    define(
        distributions, "pivot_phase_mean_cosine",
        "pivot_phase_mean_cosine(g_p): (1 + g_p^2) / (2 g_p) - (1 - g_p^2)^2 / (2 g_p^2) atanh(g_p).",
        []<class T>(T g_p) { return mean_cosine(PivotPhase<T>{g_p}); }, g_p_spec);
    define(
        distributions, "pivot_phase_like",
        "pivot_phase_like(g): g_p of the pivot phase function that looks like Henyey-Greenstein at g, by the "
        "paper's rational fit\n"
        "with its sign corrected. [Dupuy17 (27-28)]",
        []<class T>(T g) { return pivot_phase_like(HenyeyGreenstein<T>{g}).g_p; }, g_closed_spec);
    define(
        distributions, "pivot_phase_of_mean_cosine",
        "pivot_phase_of_mean_cosine(g): g_p of the pivot phase function whose mean cosine is g.",
        []<class T>(T g) { return pivot_phase_of_mean_cosine(HenyeyGreenstein<T>{g}).g_p; }, g_closed_spec);
    define(
        distributions, "pivot_phase_cap_integral",
        "pivot_phase_cap_integral(g_p, omega_o, light_axis, light_versine): the phase function's integral over a "
        "sphere light's\n"
        "cap, in [0, 1]; exact.\n\n"
        "omega_o, light_axis (..., 3), unit: the direction of travel that mu is measured from, and the light's "
        "centre;\n"
        "light_versine (...) in (0, 2]. [Dupuy17 (24), 6.2]",
        []<class T>(T g_p, const Vec3<T>& omega_o, const Vec3<T>& axis, T versine) {
            return integrate(PivotPhase<T>{g_p}, omega_o, Cap<T>{axis, versine});
        },
        g_p_spec, omega_o_spec, light_axis_spec, light_versine_spec);
    define(
        distributions, "pivot_phase_cap_sample",
        "pivot_phase_cap_sample(g_p, omega_o, light_axis, light_versine, u): a direction (..., 3) inside the light's "
        "cap, in\n"
        "proportion to the phase function. u (..., 2) in [0, 1). [Dupuy17, 6.2]",
        []<class T>(T g_p, const Vec3<T>& omega_o, const Vec3<T>& axis, T versine, const Vec2<T>& u) {
            return sample(PivotPhase<T>{g_p}, omega_o, Cap<T>{axis, versine}, u);
        },
        g_p_spec, omega_o_spec, light_axis_spec, light_versine_spec, UnitSquare{"u"});
    define(
        distributions, "pivot_phase_cap_pdf",
        "pivot_phase_cap_pdf(g_p, omega_o, light_axis, light_versine, omega): pdf per steradian of "
        "pivot_phase_cap_sample; 0\n"
        "outside the cap.",
        []<class T>(T g_p, const Vec3<T>& omega_o, const Vec3<T>& axis, T versine, const Vec3<T>& omega) {
            return pdf_omega(PivotPhase<T>{g_p}, omega_o, Cap<T>{axis, versine}, omega);
        },
        g_p_spec, omega_o_spec, light_axis_spec, light_versine_spec, Direction{{"omega"}});
}

}  // namespace pivot::bindings
