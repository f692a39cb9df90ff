// Fresnel reflectance of a dielectric beneath a film as thin as light's waves are long, which colours it: over float or
// batches, in linear RGB.
//
// [Belcour17]  A Practical Extension to Microfacet Theory for the Modeling of Varying Iridescence; with the fit of the
//              CIE's curves by Gaussians of its supplement
#pragma once

#include <array>
#include <utility>

#include "core/bsdf/fresnel.h"

namespace pivot {

template <class T>
struct ThinFilmOf {
    T ior = T(1.33f);       ///< over that of the side where the light is
    T thickness_nm = T(0);  ///< next to none: there is no film

    Mask<T> is_there() const { return thickness_nm > T(0.1f); }
};

namespace detail {

/// What a boundary reflects of waves, by polarisation; below 0: turned over. And the cosine on the other side.
template <class T>
struct WavesOf {
    T s, p, cos_t;
    Mask<T> is_total;  ///< all is reflected
};
template <class T>
WavesOf<T> reflected_waves(T cos_i, T ior) {
    const T cos2_t = T(1) - (T(1) - sqr(cos_i)) / sqr(ior), cos_t = safe_sqrt(cos2_t);
    return {(cos_i - ior * cos_t) / (cos_i + ior * cos_t), (ior * cos_i - cos_t) / (ior * cos_i + cos_t), cos_t,
            !(cos2_t > T(0))};
}

/// The mean over wavelengths of wave(2 pi path / wavelength), wave cos or sin, by what the eye's colours weigh them: of
/// white light, and in proportion to white. [Belcour17 (13), supplement]
template <class T, class Wave>
Vec3<T> mean_of_waves(T path_nm, const Wave& wave) {
    struct Gaussian {
        float height, at, variance;
    };
    constexpr float norm = 1.0f / 1.0685e-7f;
    constexpr Gaussian x{5.4856e-13f, 1.6810e6f, 4.3278e9f}, y{4.4201e-13f, 1.7953e6f, 9.3046e9f},
        z{5.2481e-13f, 2.2084e6f, 6.6121e9f};
    const T phase = path_nm * T(2.0f * pi<float> * 1e-9f), phase2 = sqr(phase);
    const auto about = [&](float height, float at, float variance) {
        return T(height) * wave(T(at) * phase) * exp(T(-variance) * phase2);
    };
    const auto of = [&](const Gaussian& g) {
        return about(norm * g.height * std::sqrt(2.0f * pi<float> * g.variance), g.at, g.variance);
    };
    const Vec3<T> xyz(of(x) + about(norm * 1.64408e-8f, 2.2399e6f, 4.5282e9f), of(y), of(z));
    // The curves are of equal energy, so white is scaled to that of Rec. 709, D65.
    const T wx = xyz.x * T(0.95047f), wy = xyz.y, wz = xyz.z * T(1.08883f);
    return {T(3.2404542f) * wx - T(1.5371385f) * wy - T(0.4985314f) * wz,
            T(-0.9692660f) * wx + T(1.8760108f) * wy + T(0.0415560f) * wz,
            T(0.0556434f) * wx - T(0.2040259f) * wy + T(1.0572252f) * wz};
}

}  // namespace detail

/// Unpolarised, of a dielectric of that ior, over that of the side where the light is; cos_theta > 0. [Belcour17 (10)],
/// up to three further reflections within the film.
template <class T>
Vec3<T> thin_film_reflectance(T cos_theta, T ior, const ThinFilmOf<T>& film) {
    const Vec3<T> white(T(1));
    // Of a film much thinner than a wave there is next to nothing. [Cycles 4.5 closure/bsdf_util.h]
    const T x = clamp01(film.thickness_nm * T(1.0f / 30.0f)),
            film_ior = lerp(T(1), film.ior, sqr(x) * (T(3) - T(2) * x));
    const auto above = detail::reflected_waves(cos_theta, film_ior);
    const auto below = detail::reflected_waves(above.cos_t, ior / film_ior);
    T once(0);
    std::array<T, 3> further{T(0), T(0), T(0)};
    for (const auto& [r12, r23] : {std::pair(above.s, below.s), std::pair(above.p, below.p)}) {
        const T through = T(1) - sqr(r12), again = -r12 * r23;
        const T inside = sqr(through * r23) / max(T(1) - sqr(again), T(1e-6f));
        once += T(0.5f) * (sqr(r12) + inside);
        T order = inside - through;
        for (T& each : further) order *= again, each += order;
    }
    Vec3<T> reflected(once);
    const T path_nm = T(2) * film_ior * film.thickness_nm * above.cos_t;
    for (std::size_t m = 0; m < further.size(); ++m)
        reflected +=
            further[m] * detail::mean_of_waves(T(static_cast<float>(m + 1)) * path_nm, [](T w) { return cos(w); });
    reflected = min(max(reflected, Vec3<T>(T(0))), white);
    return select(above.is_total || below.is_total, white, reflected);
}

/// The same where the reflectance at normal incidence is tinted: near that of a bare boundary, by all of the tint; near
/// 1, by none of it. [Cycles 4.5 closure/bsdf_microfacet.h]
template <class T>
Vec3<T> thin_film_reflectance(T cos_theta, T ior, const ThinFilmOf<T>& film, const Vec3<T>& f0_tint) {
    const Vec3<T> white(T(1)), bare = thin_film_reflectance(cos_theta, ior, film);
    const T f0 = f0_from_ior(ior);
    const Vec3<T> near = min((white - bare) / max(T(1) - f0, T(1e-6f)), white);
    return select(f0 > T(1e-5f), bare * (white + near * (f0_tint - white)), bare);
}

}  // namespace pivot
