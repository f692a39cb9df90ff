// The pivot transformation and the distributions it makes.
#include "bindings/register.h"
#include "bindings/vectorize.h"
#include "core/distributions/sptd.h"

namespace pivot::bindings {

namespace {

constexpr Direction direction(const char* name) { return {{name}}; }
constexpr Number versine(const char* name) { return {.name = name, .low = 0, .high = 2}; }
constexpr Direction pivot_direction = direction("pivot_direction");
constexpr Number delta{.name = "delta", .low = 0, .high = 1, .open_low = true};

void register_transform(py::module_& distributions) {
    define(
        distributions, "pivot_transform", R"(g(omega): the other end of the chord from omega through the pivot.

omega, pivot_direction: (..., 3) unit; delta: (...) in (0, 1]. Returns (..., 3), unit. [Dupuy17 Eq 2])",
        []<class T>(Vec3<T> w, Vec3<T> u, T d) {
            return transform(Pivot<T>{u, d}, w);
        },
        direction("omega"), pivot_direction, delta);
    define(
        distributions, "pivot_jacobian", R"(d g(omega) / d omega, a ratio of solid angles.

omega, pivot_direction: (..., 3) unit; delta: (...) in (0, 1]. Returns (...). [Dupuy17 Eq 4])",
        []<class T>(Vec3<T> w, Vec3<T> u, T d) {
            return jacobian(Pivot<T>{u, d}, w);
        },
        direction("omega"), pivot_direction, delta);
    define(
        distributions, "pivot_transform_point", R"(g(r) of any point in space; its own inverse.

r: (..., 3); pivot_direction: (..., 3) unit; delta: (...) in (0, 1]. Returns (..., 3).
ValueError if r is the map's pole, pivot_direction / (1 - delta). [Dupuy17 Eq 2])",
        []<class T>(Vec3<T> r, Vec3<T> u, T d) {
            const Vec3<T> image = transform_point(Pivot<T>{u, d}, r);
            if (!std::isfinite(image.x + image.y + image.z)) fail("r", "is the pole of the map");
            return image;
        },
        Vector{"r"}, pivot_direction, delta);
    define(
        distributions, "pivot_transform_cap", R"(g(cap): the cap that a cap maps to.

axis, pivot_direction: (..., 3) unit; versine: (...) in [0, 2]; delta: (...) in (0, 1].
Returns axis (..., 3) and versine (...). [Dupuy17 Eq 6-7, as a linear map])",
        []<class T>(Vec3<T> axis, T h, Vec3<T> u, T d) {
            const Cap<T> image = transform(Pivot<T>{u, d}, Cap<T>{axis, h});
            return std::tuple(image.axis, image.versine);
        },
        direction("axis"), versine("versine"), pivot_direction, delta);
    define(
        distributions, "pivot_transform_cap_versines",
        R"(1 - cos psi' and 1 + cos psi' of the cap that a cap maps to: near the whole sphere the second keeps all its bits.

axis, pivot_direction: (..., 3) unit; versine: (...) in [0, 2]; delta: (...) in (0, 1]. Returns (...) and (...).)",
        []<class T>(Vec3<T> axis, T h, Vec3<T> u, T d) {
            const Vec2<T> versines = transform_versines(Pivot<T>{u, d}, Cap<T>{axis, h});
            return std::tuple(versines.x, versines.y);
        },
        direction("axis"), versine("versine"), pivot_direction, delta);
}

void register_uniform(py::module_& distributions) {
    define(
        distributions, "sptd_uniform_eval", R"(The pivot transformed uniform distribution, per steradian; also its pdf.

omega, pivot_direction: (..., 3) unit; delta: (...) in (0, 1]. Returns (...). [Dupuy17 Eq 8, 16])",
        []<class T>(Vec3<T> w, Vec3<T> u, T d) {
            return eval_uniform(Pivot<T>{u, d}, w);
        },
        direction("omega"), pivot_direction, delta);
    define(
        distributions, "sptd_uniform_integral", R"(Its integral over a cap, in [0, 1].

axis, pivot_direction: (..., 3) unit; versine: (...) in [0, 2]; delta: (...) in (0, 1]. Returns (...).
[Dupuy17 Eq 10, 15])",
        []<class T>(Vec3<T> axis, T h, Vec3<T> u, T d) {
            return integrate_uniform(Pivot<T>{u, d}, Cap<T>{axis, h});
        },
        direction("axis"), versine("versine"), pivot_direction, delta);
    define(
        distributions, "sptd_uniform_integral2", R"(Its integral over the intersection of two caps, in [0, 1].

axis1, axis2, pivot_direction: (..., 3) unit; versine1, versine2: (...) in [0, 2], 1 to clip at the horizon;
delta: (...) in (0, 1]. Returns (...). [Dupuy17 Eq 17-19, 23])",
        []<class T>(Vec3<T> axis1, T h1, Vec3<T> axis2, T h2, Vec3<T> u, T d) {
            return integrate_uniform(Pivot<T>{u, d}, Cap<T>{axis1, h1}, Cap<T>{axis2, h2});
        },
        direction("axis1"), versine("versine1"), direction("axis2"), versine("versine2"), pivot_direction, delta);
    define(
        distributions, "sptd_uniform_integral3", R"(Its integral over the intersection of three caps, in [0, 1].

axis1, axis2, axis3, pivot_direction: (..., 3) unit; versine1, versine2, versine3: (...) in [0, 2]; delta: (...) in
(0, 1]. Returns (...). Specular occlusion above the horizon. [Dupuy17 Eq 23, clipped])",
        []<class T>(Vec3<T> axis1, T h1, Vec3<T> axis2, T h2, Vec3<T> axis3, T h3, Vec3<T> u, T d) {
            return integrate_uniform(Pivot<T>{u, d},
                                     std::array{Cap<T>{axis1, h1}, Cap<T>{axis2, h2}, Cap<T>{axis3, h3}});
        },
        direction("axis1"), versine("versine1"), direction("axis2"), versine("versine2"), direction("axis3"),
        versine("versine3"), pivot_direction, delta);
    define(
        distributions, "sptd_uniform_sample", R"(A direction from it; its pdf is sptd_uniform_eval.

pivot_direction: (..., 3) unit; delta: (...) in (0, 1]; u: (..., 2) in [0, 1). Returns (..., 3), unit. [Dupuy17 Sec 4.2])",
        []<class T>(Vec3<T> u, T d, Vec2<T> random) {
            return sample_uniform(Pivot<T>{u, d}, random);
        },
        pivot_direction, delta, UnitSquare{"u"});
    define(
        distributions, "sptd_uniform_cap_sample", R"(A direction from it inside a cap.

axis, pivot_direction: (..., 3) unit; versine: (...) in [0, 2]; delta: (...) in (0, 1]; u: (..., 2) in [0, 1).
Returns (..., 3), unit. [Dupuy17 Sec 6.1])",
        []<class T>(Vec3<T> axis, T h, Vec3<T> u, T d, Vec2<T> random) {
            return sample_uniform(Pivot<T>{u, d}, Cap<T>{axis, h}, random);
        },
        direction("axis"), versine("versine"), pivot_direction, delta, UnitSquare{"u"});
    define(
        distributions, "sptd_uniform_cap_pdf", R"(The density of sptd_uniform_cap_sample, per steradian: 0 outside.

axis, pivot_direction, omega: (..., 3) unit; versine: (...) in (0, 2]; delta: (...) in (0, 1]. Returns (...).
[Dupuy17 Sec 6.1])",
        []<class T>(Vec3<T> axis, T h, Vec3<T> u, T d, Vec3<T> w) {
            return pdf_omega_uniform(Pivot<T>{u, d}, Cap<T>{axis, h}, w);
        },
        direction("axis"), Number{.name = "versine", .low = 0, .high = 2, .open_low = true}, pivot_direction, delta,
        direction("omega"));
    define(
        distributions, "sptd_uniform_clipped_sample",
        R"(A direction from it inside two caps, such as light and hemisphere.

axis1, axis2, pivot_direction: (..., 3) unit; versine1, versine2: (...) in [0, 2]; delta: (...) in (0, 1];
u: (..., 2) in [0, 1). Returns (..., 3), unit. [Dupuy17 Sec 4.2])",
        []<class T>(Vec3<T> axis1, T h1, Vec3<T> axis2, T h2, Vec3<T> u, T d, Vec2<T> random) {
            return sample_uniform(Pivot<T>{u, d}, Cap<T>{axis1, h1}, Cap<T>{axis2, h2}, random);
        },
        direction("axis1"), versine("versine1"), direction("axis2"), versine("versine2"), pivot_direction, delta,
        UnitSquare{"u"});
    define(
        distributions, "sptd_uniform_clipped_pdf",
        R"(The density of sptd_uniform_clipped_sample, per steradian: 0 outside the intersection.

Arguments as of sptd_uniform_clipped_sample, with omega: (..., 3) unit for u. Returns (...).)",
        []<class T>(Vec3<T> axis1, T h1, Vec3<T> axis2, T h2, Vec3<T> u, T d, Vec3<T> w) {
            return pdf_omega_uniform(Pivot<T>{u, d}, Cap<T>{axis1, h1}, Cap<T>{axis2, h2}, w);
        },
        direction("axis1"), versine("versine1"), direction("axis2"), versine("versine2"), pivot_direction, delta,
        direction("omega"));
}

void register_cosine(py::module_& distributions) {
    define(
        distributions, "sptd_cosine_eval",
        R"(The pivot transformed clamped cosine, per steradian; also the pdf of sptd_cosine_sample.

omega, pivot_direction, cosine_axis: (..., 3) unit; delta: (...) in (0, 1]. Returns (...). The pivot turns the sphere
around: the lobe faces away from cosine_axis. [Dupuy17 Eq 8])",
        []<class T>(Vec3<T> w, Vec3<T> u, T d, Vec3<T> axis) {
            return eval_cosine(Pivot<T>{u, d}, axis, w);
        },
        direction("omega"), pivot_direction, delta, direction("cosine_axis"));
    define(
        distributions, "sptd_cosine_integral", R"(Its integral over a cap, in [0, 1].

axis, pivot_direction, cosine_axis: (..., 3) unit; versine: (...) in [0, 2]; delta: (...) in (0, 1]. Returns (...).
[Dupuy17 Eq 10])",
        []<class T>(Vec3<T> axis, T h, Vec3<T> u, T d, Vec3<T> n) {
            return integrate_cosine(Pivot<T>{u, d}, n, Cap<T>{axis, h});
        },
        direction("axis"), versine("versine"), pivot_direction, delta, direction("cosine_axis"));
    define(
        distributions, "sptd_cosine_integral2", R"(Its integral over the intersection of two caps, in [0, 1].

axis1, axis2, pivot_direction, cosine_axis: (..., 3) unit; versine1, versine2: (...) in [0, 2]; delta: (...) in (0, 1].
Returns (...). [Dupuy17 Eq 11])",
        []<class T>(Vec3<T> axis1, T h1, Vec3<T> axis2, T h2, Vec3<T> u, T d, Vec3<T> n) {
            return integrate_cosine(Pivot<T>{u, d}, n, std::array{Cap<T>{axis1, h1}, Cap<T>{axis2, h2}});
        },
        direction("axis1"), versine("versine1"), direction("axis2"), versine("versine2"), pivot_direction, delta,
        direction("cosine_axis"));
    define(
        distributions, "sptd_cosine_integral3", R"(Its integral over the intersection of three caps, in [0, 1].

axis1, axis2, axis3, pivot_direction, cosine_axis: (..., 3) unit; versine1, versine2, versine3: (...) in [0, 2];
delta: (...) in (0, 1]. Returns (...). [Dupuy17 Eq 11])",
        []<class T>(Vec3<T> axis1, T h1, Vec3<T> axis2, T h2, Vec3<T> axis3, T h3, Vec3<T> u, T d, Vec3<T> n) {
            return integrate_cosine(Pivot<T>{u, d}, n,
                                    std::array{Cap<T>{axis1, h1}, Cap<T>{axis2, h2}, Cap<T>{axis3, h3}});
        },
        direction("axis1"), versine("versine1"), direction("axis2"), versine("versine2"), direction("axis3"),
        versine("versine3"), pivot_direction, delta, direction("cosine_axis"));
    define(
        distributions, "sptd_cosine_sample", R"(A direction from it; its pdf is sptd_cosine_eval.

pivot_direction, cosine_axis: (..., 3) unit; delta: (...) in (0, 1]; u: (..., 2) in [0, 1). Returns (..., 3), unit.
[Dupuy17 Sec 4.2])",
        []<class T>(Vec3<T> u, T d, Vec3<T> n, Vec2<T> random) {
            return sample_cosine(Pivot<T>{u, d}, n, random);
        },
        pivot_direction, delta, direction("cosine_axis"), UnitSquare{"u"});
    define(
        distributions, "sptd_cosine_cap_sample", R"(A direction from it inside a cap.

axis, pivot_direction, cosine_axis: (..., 3) unit; versine: (...) in [0, 2]; delta: (...) in (0, 1]; u: (..., 2) in
[0, 1). Returns (..., 3), unit. [Dupuy17 Sec 4.2])",
        []<class T>(Vec3<T> axis, T h, Vec3<T> u, T d, Vec3<T> n, Vec2<T> random) {
            return sample_cosine(Pivot<T>{u, d}, n, std::array{Cap<T>{axis, h}}, random);
        },
        direction("axis"), versine("versine"), pivot_direction, delta, direction("cosine_axis"), UnitSquare{"u"});
    define(
        distributions, "sptd_cosine_cap_pdf",
        R"(The density of sptd_cosine_cap_sample, per steradian: 0 outside the cap and the image of the cosine's horizon.

Arguments as of sptd_cosine_cap_sample, with omega: (..., 3) unit for u. Returns (...).)",
        []<class T>(Vec3<T> axis, T h, Vec3<T> u, T d, Vec3<T> n, Vec3<T> w) {
            return pdf_omega_cosine(Pivot<T>{u, d}, n, std::array{Cap<T>{axis, h}}, w);
        },
        direction("axis"), versine("versine"), pivot_direction, delta, direction("cosine_axis"), direction("omega"));
    define(
        distributions, "sptd_cosine_clipped_sample",
        R"(A direction from it inside two caps, such as light and hemisphere.

axis1, axis2, pivot_direction, cosine_axis: (..., 3) unit; versine1, versine2: (...) in [0, 2]; delta: (...) in (0, 1];
u: (..., 2) in [0, 1). Returns (..., 3), unit. [Dupuy17 Sec 4.2])",
        []<class T>(Vec3<T> axis1, T h1, Vec3<T> axis2, T h2, Vec3<T> u, T d, Vec3<T> n, Vec2<T> random) {
            return sample_cosine(Pivot<T>{u, d}, n, std::array{Cap<T>{axis1, h1}, Cap<T>{axis2, h2}}, random);
        },
        direction("axis1"), versine("versine1"), direction("axis2"), versine("versine2"), pivot_direction, delta,
        direction("cosine_axis"), UnitSquare{"u"});
    define(
        distributions, "sptd_cosine_clipped_pdf",
        R"(The density of sptd_cosine_clipped_sample, per steradian: 0 outside the intersection.

Arguments as of sptd_cosine_clipped_sample, with omega: (..., 3) unit for u. Returns (...).)",
        []<class T>(Vec3<T> axis1, T h1, Vec3<T> axis2, T h2, Vec3<T> u, T d, Vec3<T> n, Vec3<T> w) {
            return pdf_omega_cosine(Pivot<T>{u, d}, n, std::array{Cap<T>{axis1, h1}, Cap<T>{axis2, h2}}, w);
        },
        direction("axis1"), versine("versine1"), direction("axis2"), versine("versine2"), pivot_direction, delta,
        direction("cosine_axis"), direction("omega"));
}

}  // namespace

void register_pivot(py::module_& distributions) {
    register_transform(distributions);
    register_uniform(distributions);
    register_cosine(distributions);
}

}  // namespace pivot::bindings
