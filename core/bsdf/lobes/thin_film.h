// The highlight of a dielectric beneath a thin film: Principled's with a film. Its microfacets reflect by thin_film.h's
// curve, and keep as much light as the dielectric's alone would.
#pragma once

#include "core/bsdf/lobes/anisotropic_ggx.h"
#include "core/bsdf/thin_film.h"

namespace pivot {

template <class T>
struct ThinFilmCurve {
    struct Parameters {
        T ior = T(1.5f);        ///< of the dielectric
        T film_ior = T(1.33f);  ///< of the film
        T film_nm = T(0);       ///< its thickness
        Vec3<T> f0_tint{T(1)};  ///< scales the reflectance at normal incidence
        Vec3<T> color{T(1)};    ///< scales what it reflects
    };
    static constexpr std::string_view name = "thin_film";
    static constexpr float most = std::numeric_limits<float>::max();
    static constexpr std::array parameters{
        LobeParameter{"ior", 1, 1.0f, most}, LobeParameter{"film_ior", 1, 1.0f, most},
        LobeParameter{"film_nm", 1, 0.0f, most}, LobeParameter{"f0_tint", 3, 0.0f, most},
        LobeParameter{"color", 3, 0.0f, most}};

    T ior;
    ThinFilmOf<T> film;
    Vec3<T> f0_tint, color;

    static ThinFilmCurve seen(const Parameters& p, const TurnedFacets<T>& facets, const Vec3<T>& wo, T multiscatter) {
        const T ior = max(p.ior, T(1.0001f));
        const BaseOf<T> bare = make_base(BaseMaterialOf<T>{.alpha = facets.alpha_all_around(),
                                                           .dielectric_weight = T(1),
                                                           .dielectric_ior = ior,
                                                           .dielectric_tint = p.f0_tint,
                                                           .multiscatter = multiscatter},
                                         wo);
        return {ior, {p.film_ior, p.film_nm}, p.f0_tint, p.color * bare.fresnel.dielectric_f90};
    }
    Vec3<T> at(T cos_oh) const {
        return color * thin_film_reflectance(min(max(cos_oh, T(1e-4f)), T(1)), ior, film, f0_tint);
    }
    /// By its values at both ends.
    LobeFresnelOf<T> as_of_base() const { return {at(T(1)), color, Vec3<T>(T(0)), Vec3<T>(T(0)), T(1.5f)}; }
};

template <class T>
using ThinFilm = OwnAxesLobe<T, ThinFilmCurve>;

}  // namespace pivot
