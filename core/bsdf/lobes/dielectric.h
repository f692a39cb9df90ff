// A rough boundary between two media: microfacets that mirror Fresnel's share of the light and refract the rest.
// Blender's Glass and Refraction BSDF and Principled's transmission are settings of its numbers.
//
// Sampled as path tracers follow radiance that is not scaled by the square of the index of refraction: a white boundary
// without losses has an albedo of 1 from either side, as in Cycles. eval(wo, wi) / |cos_i| seen from outside is so
// ior^2 times what it is the other way round. What single scattering loses is given back in proportion to it, also as
// in Cycles, so that this reciprocity is exact without multiscatter.
//
// [Walter07]     Microfacet Models for Refraction through Rough Surfaces
// [KullaConty17] Revisiting Physically Based Shading at Imageworks
#pragma once

#include "core/bsdf/highlight.h"
#include "core/bsdf/lobe_record.h"
#include "core/bsdf/microfacets.h"
#include "core/bsdf/thin_film.h"
#include "core/tables/ggx_albedo.h"
#include "core/tables/ggx_glass.h"

namespace pivot {

template <class T>
struct Dielectric {
    struct Parameters {
        Vec3<T> reflection{T(1)};    ///< scales what is reflected
        Vec3<T> transmission{T(1)};  ///< scales what comes through
        Vec3<T> f0_tint{T(1)};       ///< scales Fresnel's reflectance at normal incidence
        T alpha = T(min_alpha);      ///< GGX alpha, roughness squared, in [0, 1]; the smoothest is min_alpha
        T ior = T(1.5f);             ///< behind the surface's front, over that before it
        T fresnel = T(1);            ///< 1: what is not reflected comes through; 0: all that can, reflection or not
        T multiscatter = T(0);       ///< 1: give back what single scattering loses between microfacets; 0: do not
        T weight = T(1);             ///< the share of the surface that it is, multiplied into both colours
        T film_ior = T(1.33f);       ///< of a thin film on it, over that before the surface's front
        T film_nm = T(0);            ///< the film's thickness
        T beckmann = T(0);           ///< 1: Beckmann's distribution of microfacets; 0: GGX

        /// As it is seen from behind, where that is so.
        void turn_over(const Mask<T>& is_behind) {
            film_ior = select(is_behind, film_ior / ior, film_ior);
            ior = select(is_behind, T(1) / ior, ior);
        }
    };
    static constexpr std::string_view name = "dielectric";
    static constexpr float most = std::numeric_limits<float>::max();
    static constexpr std::array parameters{
        LobeParameter{"reflection", 3, 0.0f, most},   LobeParameter{"transmission", 3, 0.0f, most},
        LobeParameter{"f0_tint", 3, 0.0f, most},      LobeParameter{"alpha", 1, 0.0f, 1.0f},
        LobeParameter{"ior", 1, 1e-5f, most},         LobeParameter{"fresnel", 1, 0.0f, 1.0f},
        LobeParameter{"multiscatter", 1, 0.0f, 1.0f}, LobeParameter{"weight", 1, 0.0f, most},
        LobeParameter{"film_ior", 1, 1e-5f, most},    LobeParameter{"film_nm", 1, 0.0f, most},
        LobeParameter{"beckmann", 1, 0.0f, 1.0f}};
    static constexpr bool reflects = true, transmits = true, has_closed_form = true;

    Vec3<T> reflection, transmission, f0_tint;
    T alpha, eta;  ///< eta: index of refraction on the other side of the viewer's, over that on the viewer's
    T fresnel;
    Vec3<T> reflected, refracted;  ///< albedo, by the side that the light comes from
    ThinFilmOf<T> film;
    T beckmann;

    static Dielectric seen(const Parameters& material, const Vec3<T>& wo_local) {
        const T one(1), alpha = min(max(material.alpha, T(min_alpha)), one), eta = distinct(material.ior);
        const GlassAlbedo<T> facets = ggx_glass_albedo(alpha, wo_local.z, eta);
        const T kept = facets.reflected + facets.refracted;
        Dielectric lobe{.reflection = material.reflection,
                        .transmission = material.transmission,
                        .f0_tint = material.f0_tint,
                        .alpha = alpha,
                        .eta = eta,
                        .fresnel = material.fresnel,
                        .reflected = Vec3<T>(T(0)),
                        .refracted = Vec3<T>(T(0)),
                        .film = {material.film_ior, material.film_nm},
                        .beckmann = material.beckmann};
        if (const Mask<T> multiscatter = material.multiscatter > T(0); any(multiscatter)) {
            // Most of the colour is that of what comes through.
            const Vec3<T> color = min(material.transmission / max(material.weight, T(1e-6f)), Vec3<T>(one));
            const Vec3<T> scale = select(
                multiscatter, multiscatter_scale(color, kept, ggx_glass_average_albedo(alpha, eta)), Vec3<T>(one));
            lobe.reflection *= scale;
            lobe.transmission *= scale;
        }
        // The table's Fresnel, its F0 tinted.
        const T f0 = f0_from_ior(eta), share = clamp01((facets.reflected / kept - f0) / (one - f0));
        const Vec3<T> tinted = min(f0 * material.f0_tint, Vec3<T>(one));
        Vec3<T> mirrored = kept * (tinted + (Vec3<T>(one) - tinted) * share);
        if (const Mask<T> has_film = lobe.film.is_there(); any(has_film)) {
            // By how much the film changes what a facet about the normal mirrors.
            const Vec3<T> bare = tinted + (Vec3<T>(one) - tinted) * fresnel_dielectric_weight(wo_local.z, eta);
            const Vec3<T> filmed = mirrored * lobe.film_at(wo_local.z) / max(bare, Vec3<T>(T(1e-6f)));
            mirrored = select(has_film, min(filmed, Vec3<T>(kept)), mirrored);
        }
        // Without Fresnel what cannot come through still does not.
        const T all = facets.refracted + select(eta < one, facets.refracted * (f0 / (one - f0)), facets.reflected);
        lobe.reflected = lobe.reflection * mirrored;
        lobe.refracted = lobe.transmission * (Vec3<T>(all) + (Vec3<T>(kept - all) - mirrored) * material.fresnel);
        if (const Mask<T> is_beckmann = lobe.distribution().is_beckmann(); any(is_beckmann)) {
            const auto [above, below] = lobe.summed_albedo(wo_local);
            lobe.reflected = select(is_beckmann, above, lobe.reflected);
            lobe.refracted = select(is_beckmann, below, lobe.refracted);
        }
        return lobe;
    }

    Vec3<T> eval(const Vec3<T>& wo_local, const Vec3<T>& wi_local) const {
        const Facet facet = facet_between(wo_local, wi_local);
        const Split split = split_at(facet.cos_oh);
        const T g2 = distribution().g2(wo_local, wi_local);
        return select(facet.is_valid,
                      select(facet.is_reflected, split.reflected, split.refracted) * (facet.density * g2),
                      Vec3<T>(T(0)));
    }
    T pdf_omega(const Vec3<T>& wo_local, const Vec3<T>& wi_local) const {
        const Facet facet = facet_between(wo_local, wi_local);
        const T reflects_probability = split_at(facet.cos_oh).reflects_probability();
        const T probability = select(facet.is_reflected, reflects_probability, T(1) - reflects_probability);
        return select(facet.is_valid, probability * facet.density * distribution().g1(wo_local), T(0));
    }
    Vec3<T> sample(const Vec3<T>& wo_local, T u_lobe, const Vec2<T>& u) const {
        const Vec3<T> h = distribution().sample_normal(wo_local, u);
        const auto [above, below] = directions_by(h, wo_local);
        return select(u_lobe < split_at(dot(wo_local, h)).reflects_probability(), above, below);
    }
    /// Where one facet sends light to wo from: mirrored, and from the other side.
    std::array<FacetRayOf<T>, 2> facet_rays(const Vec3<T>& wo_local, const Vec2<T>& u) const {
        const Vec3<T> h = distribution().sample_normal(wo_local, u);
        const auto [above, below] = directions_by(h, wo_local);
        const Split split = split_at(dot(wo_local, h));
        const T g1 = distribution().g1(wo_local);
        const auto shadowing = [&](const Vec3<T>& wi_local) { return distribution().g2(wo_local, wi_local) / g1; };
        const Vec3<T> none(T(0));
        return {FacetRayOf<T>{above, select(above.z > T(0), split.reflected * shadowing(above), none)},
                FacetRayOf<T>{below, select(below.z < T(0), split.refracted * shadowing(below), none)}};
    }
    Vec3<T> albedo(const Vec3<T>&) const { return reflected + refracted; }
    Vec3<T> diffuse() const { return Vec3<T>(T(0)); }
    /// What it mirrors: of Fresnel's curve; where some of that is all of the light, as much of every angle's.
    BaseOf<T> closed_form(const Vec3<T>& wo_local) const {
        const Vec3<T> black(T(0));
        const Mask<T> is_denser = eta > T(1);
        const Vec3<T> evenly = select(is_denser, black, reflected / ggx_albedo(alpha, wo_local.z));
        const Vec3<T> by_curve = select(is_denser, reflection, black);
        return {.wo_local = wo_local,
                .diffuse = black,
                .alpha = alpha,
                .fresnel = {evenly, evenly, by_curve * min(f0_tint * f0_from_ior(eta), Vec3<T>(T(1))), by_curve,
                            max(eta, T(1) / eta)},
                .glossy_probability = select(max_component(reflection) > T(0), T(1), T(0))};
    }
    T highlight_probability() const { return T(1); }
    void add_highlights(HighlightsOf<T>& highlights, const Vec3<T>& wo_local, const Mask<T>& where) const {
        highlights.add(highlight_about_normal(alpha, closed_form(wo_local).fresnel), where);
        highlights.add_beside(mean_component(refracted), where);
        highlights.are_close = highlights.are_close && !(where && max_component(refracted) > T(0));
    }
    Dielectric blurred(T least_alpha) const {
        Dielectric result = *this;
        result.alpha = max(alpha, least_alpha);
        return result;
    }

   private:
    MicrofacetsOf<T> distribution() const { return {alpha, alpha, beckmann}; }

    /// Of microfacets that no table knows: what some of them reflect and refract.
    std::array<Vec3<T>, 2> summed_albedo(const Vec3<T>& wo_local) const {
        constexpr std::size_t count = 32;
        std::array<Vec3<T>, 2> sums{Vec3<T>(T(0)), Vec3<T>(T(0))};
        for (std::size_t k = 0; k < count; ++k) {
            const auto rays = facet_rays(wo_local, golden_point(T(static_cast<float>(k)), count));
            for (std::size_t side = 0; side < 2; ++side)
                sums[side] += rays[side].worth * T(1.0f / static_cast<float>(count));
        }
        return sums;
    }

    /// Media of one index let light pass straight on, which no density stands for; so near to it, nothing bends.
    static T distinct(T ior) {
        constexpr float least_step = 1e-4f, most_ior = 1e3f;
        const T bounded = min(max(ior, T(1.0f / most_ior)), T(most_ior));
        return select(abs(bounded - T(1)) < T(least_step), T(1.0f + least_step), bounded);
    }

    /// The microfacet that sends wi to wo.
    struct Facet {
        T cos_oh;
        T density;  ///< D over cos_o, times the solid angle of its normals for one of wi, times cos_oh
        Mask<T> is_reflected, is_valid;
    };
    Facet facet_between(const Vec3<T>& wo_local, const Vec3<T>& wi_local) const {
        const Mask<T> is_reflected = wi_local.z > T(0);
        const Vec3<T> sum = wo_local + select(is_reflected, T(1), eta) * wi_local;  // [Walter07 (13), (16)]
        const T inverse_length = T(1) / sqrt(max(length_squared(sum), tiny<T>));
        const Vec3<T> h = sum * select(sum.z < T(0), -inverse_length, inverse_length);
        const T cos_oh = dot(wo_local, h), cos_ih = dot(wi_local, h);
        const T refracts = sqr(eta * inverse_length) * cos_oh * abs(cos_ih);  // [Walter07 (17)]
        const T density = distribution().ndf(h) * select(is_reflected, T(0.25f), refracts) / wo_local.z;
        return {cos_oh, density, is_reflected, cos_oh > T(0) && wi_local.z * cos_ih > T(0)};
    }

    /// Where a microfacet mirrors wo, and where it refracts it. What it sends to the side where its part of the lobe is
    /// 0 lies at z = 0, where both are.
    std::array<Vec3<T>, 2> directions_by(const Vec3<T>& h, const Vec3<T>& wo_local) const {
        const T cos_oh = dot(wo_local, h), inverse_eta = T(1) / eta;
        const T cos_ih = safe_sqrt(T(1) - (T(1) - sqr(cos_oh)) * sqr(inverse_eta));
        Vec3<T> above = T(2) * cos_oh * h - wo_local;
        Vec3<T> below = (inverse_eta * cos_oh - cos_ih) * h - inverse_eta * wo_local;  // [Walter07 (40)]
        above.z = max(above.z, T(0));
        below.z = min(below.z, T(0));
        return {above, below};
    }

    Vec3<T> film_at(T cos_theta) const { return thin_film_reflectance(max(cos_theta, T(1e-4f)), eta, film, f0_tint); }

    /// What a microfacet does with the light.
    struct Split {
        Vec3<T> reflected, refracted;

        T reflects_probability() const {
            const T of_reflected = mean_component(reflected);
            return of_reflected / max(of_reflected + mean_component(refracted), tiny<T>);
        }
    };
    Split split_at(T cos_oh) const {
        const T c = min(max(cos_oh, T(1e-6f)), T(1));
        const Vec3<T> white(T(1)), f0 = min(f0_from_ior(eta) * f0_tint, white);
        Vec3<T> mirrored = f0 + (white - f0) * fresnel_dielectric_weight(c, eta);
        if (any(film.is_there())) mirrored = select(film.is_there(), film_at(c), mirrored);
        const Mask<T> refracts = sqr(eta) - T(1) + sqr(c) > T(0);
        return {reflection * mirrored, select(refracts, transmission * (white - fresnel * mirrored), Vec3<T>(T(0)))};
    }
};

}  // namespace pivot
