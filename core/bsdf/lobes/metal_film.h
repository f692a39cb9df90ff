// The highlight of a metal beneath a film as thin as light's waves are long: Principled's and Metallic BSDF's, from
// Blender 5.0 on. The metal is one of an index of refraction n + i k, or one whose curve is F82's, for which an index
// gives the phases alone. Multiple scattering keeps as much light as without a film.
//
// [Belcour17]      A Practical Extension to Microfacet Theory for the Modeling of Varying Iridescence
// [Cycles 5.2 closure/bsdf_util.h], for F82 beneath a film
#pragma once

#include <utility>

#include "core/bsdf/lobes/anisotropic_ggx.h"
#include "core/bsdf/thin_film.h"

namespace pivot {
namespace detail {

/// One polarisation of what a metal reflects, by colour: the reflectance, and the cosine and sine of the phase.
template <class T>
struct MetalWaveOf {
    Vec3<T> reflectance, cos_phase, sin_phase;
};

/// Both polarisations of light that meets a metal of index n + i k, over that of the side where the light is.
template <class T>
std::array<MetalWaveOf<T>, 2> reflected_by_metal(T cos_i, const Vec3<T>& n, const Vec3<T>& k) {
    std::array<MetalWaveOf<T>, 2> waves;
    auto& [s, p] = waves;
    const auto set = [](MetalWaveOf<T>& wave, int c, T reflectance, T re, T im) {
        const T length = sqrt(sqr(re) + sqr(im));
        const Mask<T> is_some = length > T(1e-12f);
        const T scale = T(1) / select(is_some, length, T(1));
        wave.reflectance[c] = reflectance;
        wave.cos_phase[c] = select(is_some, re * scale, T(1));
        wave.sin_phase[c] = select(is_some, im * scale, T(0));
    };
    for (int c = 0; c < 3; ++c) {
        const T real = sqr(n[c]) - sqr(k[c]), imaginary = T(2) * n[c] * k[c];  // of the index squared
        const T below = real - (T(1) - sqr(cos_i)), size = sqrt(sqr(below) + sqr(imaginary));
        const T u2 = max(T(0.5f) * (size + below), T(0)), v2 = max(T(0.5f) * (size - below), T(0));
        const T u = sqrt(u2), v = sqrt(v2);
        set(s, c, (sqr(cos_i - u) + v2) / max(sqr(cos_i + u) + v2, T(1e-12f)), sqr(cos_i) - u2 - v2, T(-2) * cos_i * v);
        const T a = real * cos_i, b = imaginary * cos_i;
        set(p, c, (sqr(a - u) + sqr(b - v)) / max(sqr(a + u) + sqr(b + v), T(1e-12f)), sqr(a) + sqr(b) - u2 - v2,
            T(2) * (b * u - a * v));
    }
    return waves;
}

}  // namespace detail

template <class T>
struct MetalFilmCurve {
    struct Parameters {
        Vec3<T> n{T(0.2f)}, k{T(4)};  ///< of the metal
        Vec3<T> f82{T(0)};            ///< of a metal of F82's curve: what it reflects at 82 degrees
        T has_f82 = T(0);             ///< 1: its curve is F82's; 0: that of n and k
        T film_ior = T(1.33f);        ///< of the film
        T film_nm = T(0);             ///< its thickness
        Vec3<T> color{T(1)};          ///< scales what it reflects
    };
    static constexpr std::string_view name = "metal_film";
    static constexpr float most = std::numeric_limits<float>::max();
    static constexpr std::array parameters{
        LobeParameter{"n", 3, 0.0f, most},        LobeParameter{"k", 3, 0.0f, most},
        LobeParameter{"f82", 3, 0.0f, 1.0f},      LobeParameter{"has_f82", 1, 0.0f, 1.0f},
        LobeParameter{"film_ior", 1, 1.0f, most}, LobeParameter{"film_nm", 1, 0.0f, most},
        LobeParameter{"color", 3, 0.0f, most}};

    Vec3<T> n, k, f82;
    T has_f82;
    ThinFilmOf<T> film;
    Vec3<T> color;

    static MetalFilmCurve seen(const Parameters& p, const TurnedFacets<T>& facets, const Vec3<T>& wo, T multiscatter) {
        MetalFilmCurve curve{p.n, p.k, p.f82, p.has_f82, {p.film_ior, p.film_nm}, p.color};
        const Mask<T> gives_back = multiscatter > T(0);
        if (any(gives_back)) {
            const T alpha = facets.alpha_all_around();
            const Vec3<T> scale =
                multiscatter_scale(curve.bare_mean(), ggx_albedo(alpha, wo.z), ggx_average_albedo(alpha));
            curve.color *= select(gives_back, scale, Vec3<T>(T(1)));
        }
        return curve;
    }
    /// [Belcour17 (10)], up to three further reflections within the film.
    Vec3<T> at(T cos_oh) const {
        const Vec3<T> white(T(1));
        const T cos_theta = min(max(cos_oh, T(1e-4f)), T(1)), x = clamp01(film.thickness_nm);
        const T film_ior = lerp(T(1), film.ior, sqr(x) * (T(3) - T(2) * x));
        const auto above = detail::reflected_waves(cos_theta, film_ior);
        auto below = detail::reflected_by_metal(above.cos_t, n / film_ior, k / film_ior);
        if (any(has_f82 > T(0.5f))) {
            const Vec3<T> by_f82 = f82_curve(above.cos_t, film_ior);
            for (auto& wave : below) wave.reflectance = select(has_f82 > T(0.5f), by_f82, wave.reflectance);
        }
        const T path_nm = T(2) * film_ior * film.thickness_nm * above.cos_t;
        Vec3<T> reflected(T(0));
        for (const auto& [r12, wave] : {std::pair(above.s, below[0]), std::pair(above.p, below[1])}) {
            const Vec3<T> through(T(1) - sqr(r12)), both = sqr(r12) * wave.reflectance;
            const Vec3<T> again(sqrt(both.x), sqrt(both.y), sqrt(both.z));
            const Vec3<T> inside = through * through * wave.reflectance / max(white - both, Vec3<T>(T(1e-6f)));
            reflected += T(0.5f) * (Vec3<T>(sqr(r12)) + inside);
            Vec3<T> order = inside - through, cosine = white, sine(T(0));
            const T turned_over = select(r12 > T(0), T(-1), T(1));
            const Vec3<T> cos_once = turned_over * wave.cos_phase, sin_once = turned_over * wave.sin_phase;
            for (int m = 1; m <= 3; ++m) {
                order *= again;
                const Vec3<T> next = cosine * cos_once - sine * sin_once;
                sine = sine * cos_once + cosine * sin_once;
                cosine = next;
                const T path = T(static_cast<float>(m)) * path_nm;
                reflected += order * (cosine * detail::mean_of_waves(path, [](T w) { return cos(w); }) -
                                      sine * detail::mean_of_waves(path, [](T w) { return sin(w); }));
            }
        }
        return color * select(above.is_total, white, min(max(reflected, Vec3<T>(T(0))), white));
    }
    /// By its values at both ends.
    LobeFresnelOf<T> as_of_base() const { return {at(T(1)), color, Vec3<T>(T(0)), Vec3<T>(T(0)), T(1.5f)}; }

   private:
    /// F82's curve of the metal seen from within the film, whose reflectance at 82 degrees stays as it was.
    Vec3<T> f82_curve(T cos_theta, T film_ior) const {
        const Vec3<T> white(T(1)), f0 = fresnel_conductor(T(1), n / film_ior, k / film_ior);
        const Vec3<T> curve = f0 + (white - f0) * schlick_weight(cos_theta) - dip(f0, f82) * f82_weight(cos_theta);
        return min(max(curve, Vec3<T>(T(0))), white);
    }
    /// What F82 takes off Schlick's curve.
    static Vec3<T> dip(const Vec3<T>& f0, const Vec3<T>& at_82) {
        const Vec3<T> schlick = f0 + (Vec3<T>(T(1)) - f0) * schlick_weight(T(f82_cosine));
        return (schlick - at_82) / f82_weight(T(f82_cosine));
    }
    /// Hemispherical mean without film and color.
    Vec3<T> bare_mean() const {
        const Vec3<T> white(T(1)), f0 = fresnel_conductor(T(1), n, k);
        const Vec3<T> at_82 = select(has_f82 > T(0.5f), f82, fresnel_conductor(T(f82_cosine), n, k));
        const Vec3<T> mean = f0 + (white - f0) * T(schlick_mean_weight) - dip(f0, at_82) * T(f82_mean_weight);
        return min(max(mean, Vec3<T>(T(0))), white);
    }
};

template <class T>
using MetalFilm = OwnAxesLobe<T, MetalFilmCurve>;

}  // namespace pivot
