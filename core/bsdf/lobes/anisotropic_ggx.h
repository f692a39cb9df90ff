// Highlights about axes of their own: rougher along one than along the other, and about a normal that need not be the
// surface's. What their microfacets, GGX's or Beckmann's, reflect is a curve, of which each kind of lobe has another.
//
// multiscatter gives back what single scattering loses of the GGX lobe of alpha sqrt(alpha_x alpha_y), as in Cycles:
// an anisotropic one may lose more. What they reflect in all is summed over fixed points.
#pragma once

#include "core/bsdf/highlight.h"
#include "core/bsdf/lobe_record.h"
#include "core/bsdf/microfacets.h"
#include "core/sampling/warp.h"
#include "core/tables/ggx_albedo.h"

namespace pivot {

/// Microfacets in the shading frame. Directions below the surface, or below the microfacets' own, see none of them.
template <class T>
struct TurnedFacets {
    Vec3<T> x, z;  ///< unit: the axis of alpha_x, and their normal
    MicrofacetsOf<T> facets;

    static TurnedFacets turned(const Vec3<T>& normal, T rotation, T alpha_x, T alpha_y, T beckmann) {
        const Vec3<T> x(T(1), T(0), T(0)), z(T(0), T(0), T(1));
        const Frame<T> about = frame_from_z(select(length_squared(normal) > T(0), normal, z), x);
        const T angle = T(2) * pi<T> * rotation;
        const auto clamped = [](T alpha) { return min(max(alpha, T(min_alpha)), T(1)); };
        return {cos(angle) * about.x + sin(angle) * about.y, about.z, {clamped(alpha_x), clamped(alpha_y), beckmann}};
    }
    T alpha_all_around() const { return sqrt(facets.alpha_x * facets.alpha_y); }

    Frame<T> frame() const { return {x, cross(z, x), z}; }
    /// BRDF times cosine without Fresnel, and the density of sample().
    T eval(const Vec3<T>& wo_local, const Vec3<T>& wi_local) const {
        const Vec3<T> wo = frame().to_local(wo_local), wi = frame().to_local(wi_local);
        return select(sees(wo, wi, wi_local), facets.eval(wo, wi), T(0));
    }
    T pdf_omega(const Vec3<T>& wo_local, const Vec3<T>& wi_local) const {
        const Vec3<T> wo = frame().to_local(wo_local), wi = frame().to_local(wi_local);
        return select(sees(wo, wi, wi_local), facets.pdf_omega(wo, wi), T(0));
    }
    Vec3<T> sample(const Vec3<T>& wo_local, const Vec2<T>& u) const {
        const Vec3<T> wo = frame().to_local(wo_local), h = facets.sample_normal(wo, u);
        const Vec3<T> wi = T(2) * dot(wo, h) * h - wo;
        const Vec3<T> wi_local = frame().to_world(wi);
        return {wi_local.x, wi_local.y, select(wi.z > T(0), wi_local.z, min(wi_local.z, T(0)))};
    }

    /// The integral of eval times a curve of the cosine to the microfacet's normal.
    template <class Curve>
    Vec3<T> albedo(const Curve& curve, const Vec3<T>& wo_local) const {
        constexpr std::size_t count = 16;
        const Vec3<T> wo = frame().to_local(wo_local);
        const T g1 = facets.g1(wo);
        Vec3<T> sum(T(0));
        for (std::size_t k = 0; k < count; ++k) {
            const Vec3<T> h = facets.sample_normal(wo, golden_point(T(static_cast<float>(k)), count));
            const T cos_oh = dot(wo, h);
            const Vec3<T> wi = T(2) * cos_oh * h - wo;
            const T kept = facets.g2(wo, wi) / g1;
            sum += select(sees(wo, wi, frame().to_world(wi)), curve.at(cos_oh) * kept, Vec3<T>(T(0)));
        }
        return sum / T(static_cast<float>(count));
    }

   private:
    static Mask<T> sees(const Vec3<T>& wo, const Vec3<T>& wi, const Vec3<T>& wi_local) {
        return wo.z > T(0) && wi.z > T(0) && wi_local.z > T(0);
    }
};

/// The curves that a base's highlight has: of a conductor and of a dielectric.
template <class T>
struct BaseCurves {
    struct Parameters {
        Vec3<T> conductor_f0{T(0)}, conductor_f90{T(0)};  ///< these are as a base's
        Vec3<T> conductor_dip{T(0)};
        T conductor_weight = T(1);
        T dielectric_weight = T(0);
        T dielectric_ior = T(1.5f);
        Vec3<T> dielectric_tint{T(1)};
        Vec3<T> color{T(1)};  ///< scales what it reflects
    };
    static constexpr std::string_view name = "anisotropic";
    static constexpr float most = std::numeric_limits<float>::max();
    static constexpr std::array parameters{
        LobeParameter{"conductor_f0", 3, 0.0f, most},      LobeParameter{"conductor_f90", 3, 0.0f, most},
        LobeParameter{"conductor_dip", 3, 0.0f, most},     LobeParameter{"conductor_weight", 1, 0.0f, most},
        LobeParameter{"dielectric_weight", 1, 0.0f, most}, LobeParameter{"dielectric_ior", 1, 1.0f, most},
        LobeParameter{"dielectric_tint", 3, 0.0f, most},   LobeParameter{"color", 3, 0.0f, most}};

    LobeFresnelOf<T> fresnel;

    static BaseCurves seen(const Parameters& p, const TurnedFacets<T>& facets, const Vec3<T>& wo, T multiscatter) {
        const BaseOf<T> base = make_base(BaseMaterialOf<T>{.alpha = facets.alpha_all_around(),
                                                           .conductor_f0 = p.conductor_f0,
                                                           .conductor_f90 = p.conductor_f90,
                                                           .conductor_weight = p.conductor_weight,
                                                           .dielectric_weight = p.dielectric_weight,
                                                           .dielectric_ior = p.dielectric_ior,
                                                           .dielectric_tint = p.dielectric_tint,
                                                           .multiscatter = multiscatter,
                                                           .conductor_dip = p.conductor_dip},
                                         wo);
        LobeFresnelOf<T> fresnel = base.fresnel;
        fresnel.schlick_f0 *= p.color, fresnel.schlick_f90 *= p.color, fresnel.conductor_dip *= p.color;
        fresnel.dielectric_f0 *= p.color, fresnel.dielectric_f90 *= p.color;
        return {fresnel};
    }
    Vec3<T> at(T cos_oh) const { return fresnel.at(cos_oh); }
    LobeFresnelOf<T> as_of_base() const { return fresnel; }
};

/// The curve of a conductor's index of refraction, n + i k.
template <class T>
struct ConductorCurve {
    struct Parameters {
        Vec3<T> n{T(0.2f)}, k{T(4)};
        Vec3<T> color{T(1)};  ///< scales what it reflects
    };
    static constexpr std::string_view name = "conductor";
    static constexpr float most = std::numeric_limits<float>::max();
    static constexpr std::array parameters{LobeParameter{"n", 3, 0.0f, most}, LobeParameter{"k", 3, 0.0f, most},
                                           LobeParameter{"color", 3, 0.0f, most}};

    Vec3<T> n, k, color;

    static ConductorCurve seen(const Parameters& p, const TurnedFacets<T>& facets, const Vec3<T>& wo, T multiscatter) {
        ConductorCurve curve{p.n, p.k, p.color};
        const Mask<T> gives_back = multiscatter > T(0);
        if (any(gives_back)) {
            const T alpha = facets.alpha_all_around();
            const Vec3<T> scale = multiscatter_scale(curve.mean(), ggx_albedo(alpha, wo.z), ggx_average_albedo(alpha));
            curve.color *= select(gives_back, scale, Vec3<T>(T(1)));
        }
        return curve;
    }
    Vec3<T> at(T cos_oh) const { return color * fresnel_conductor(cos_oh, n, k); }
    /// By its values at both ends.
    LobeFresnelOf<T> as_of_base() const { return {at(T(1)), color, Vec3<T>(T(0)), Vec3<T>(T(0)), T(1.5f)}; }

   private:
    /// Hemispherical mean without color: of the F82 that has its values at normal incidence and at 82 degrees. [Cycles
    /// 4.5 closure/bsdf_util.h, fresnel_conductor_Fss]
    Vec3<T> mean() const {
        const Vec3<T> white(T(1)), f0 = fresnel_conductor(T(1), n, k), f82 = fresnel_conductor(T(f82_cosine), n, k);
        const Vec3<T> schlick = f0 + (white - f0) * schlick_weight(T(f82_cosine));
        const Vec3<T> dip = (schlick - f82) / f82_weight(T(f82_cosine));
        return min(max(f0 + (white - f0) * T(schlick_mean_weight) - dip * T(f82_mean_weight), Vec3<T>(T(0))), white);
    }
};

template <class T, template <class> class CurveOf>
struct OwnAxesLobe {
    using Curve = CurveOf<T>;
    struct Parameters {
        typename Curve::Parameters curve;
        T alpha_x = T(0.5f), alpha_y = T(0.5f);  ///< GGX alpha, in [0, 1]; the smoothest is min_alpha
        T rotation = T(0);      ///< of the axes about the normal, from x of the shading frame, in turns
        Vec3<T> normal{T(0)};   ///< in the shading frame; none: the surface's own
        T multiscatter = T(0);  ///< 1: give back what single scattering loses between microfacets; 0: do not
        T beckmann = T(0);      ///< 1: Beckmann's distribution; 0: GGX

        template <class LocalOf>
        void turn_normals(const LocalOf& local_of, const Mask<T>& where) {
            normal = select(where, local_of(normal), normal);
        }
    };
    static constexpr std::string_view name = Curve::name;
    static constexpr auto parameters = joined(
        Curve::parameters,
        std::array{LobeParameter{"alpha_x", 1, 0.0f, 1.0f}, LobeParameter{"alpha_y", 1, 0.0f, 1.0f},
                   LobeParameter{"rotation", 1, -1e3f, 1e3f},
                   LobeParameter{"normal", 3, -std::numeric_limits<float>::max(), std::numeric_limits<float>::max()},
                   LobeParameter{"multiscatter", 1, 0.0f, 1.0f}, LobeParameter{"beckmann", 1, 0.0f, 1.0f}});
    static constexpr bool reflects = true, transmits = false, has_closed_form = false;

    TurnedFacets<T> turned;
    Curve curve;
    Vec3<T> albedo_seen;

    static OwnAxesLobe seen(const Parameters& p, const Vec3<T>& wo_local) {
        const TurnedFacets<T> turned = TurnedFacets<T>::turned(p.normal, p.rotation, p.alpha_x, p.alpha_y, p.beckmann);
        const Vec3<T> wo = turned.frame().to_local(wo_local);
        const Vec3<T> above(wo.x, wo.y, max(wo.z, T(1e-4f)));
        const Curve curve = Curve::seen(p.curve, turned, above, p.multiscatter);
        return {turned, curve, turned.albedo(curve, wo_local)};
    }
    Vec3<T> eval(const Vec3<T>& wo_local, const Vec3<T>& wi_local) const {
        const T value = turned.eval(wo_local, wi_local), cos_oh = dot(wo_local, normalize(wo_local + wi_local));
        return select(value > T(0), curve.at(cos_oh) * value, Vec3<T>(T(0)));
    }
    T pdf_omega(const Vec3<T>& wo_local, const Vec3<T>& wi_local) const { return turned.pdf_omega(wo_local, wi_local); }
    Vec3<T> sample(const Vec3<T>& wo_local, T, const Vec2<T>& u) const { return turned.sample(wo_local, u); }
    Vec3<T> albedo(const Vec3<T>&) const { return albedo_seen; }
    Vec3<T> diffuse() const { return Vec3<T>(T(0)); }
    /// As rough all around.
    BaseOf<T> closed_form(const Vec3<T>& wo_local) const {
        return {.wo_local = wo_local,
                .diffuse = Vec3<T>(T(0)),
                .alpha = turned.alpha_all_around(),
                .fresnel = curve.as_of_base(),
                .glossy_probability = select(max_component(albedo_seen) > T(0), T(1), T(0))};
    }
    T highlight_probability() const { return T(1); }
    void add_highlights(HighlightsOf<T>& highlights, const Vec3<T>&, const Mask<T>& where) const {
        HighlightOf<T> own = highlight_about_normal(turned.facets.alpha_x, curve.as_of_base());
        own.frame = turned.frame();
        own.alpha_y = turned.facets.alpha_y;
        highlights.add(own, where);
    }
    OwnAxesLobe blurred(T least_alpha) const {
        OwnAxesLobe result = *this;
        result.turned.facets.alpha_x = max(turned.facets.alpha_x, least_alpha);
        result.turned.facets.alpha_y = max(turned.facets.alpha_y, least_alpha);
        return result;
    }
};

template <class T>
using AnisotropicGgx = OwnAxesLobe<T, BaseCurves>;
template <class T>
using Conductor = OwnAxesLobe<T, ConductorCurve>;

}  // namespace pivot
