// A clear coat of microfacets whose normals are spread with a long tail: Clearcoat of Blender's Principled before 4.0.
// It reflects as a dielectric of IOR 1.5 does and takes nothing from what lies beneath; all of them mask as GGX of
// alpha 0.25. [Cycles 3.4 closure/bsdf_microfacet.h]
//
// [Burley12]  Physically Based Shading at Disney
#pragma once

#include "core/bsdf/lobes/anisotropic_ggx.h"
#include "core/bsdf/lobes/sampled_reflectance.h"

namespace pivot {

template <class T>
struct Clearcoat {
    struct Parameters {
        T weight = T(1);       ///< scales what it reflects
        T alpha = T(0.1f);     ///< of its normals' distribution, in [0, 0.9]: rougher ones send half of all down
        Vec3<T> normal{T(0)};  ///< in the shading frame; none: the surface's own

        template <class LocalOf>
        void turn_normals(const LocalOf& local_of, const Mask<T>& where) {
            normal = select(where, local_of(normal), normal);
        }
    };
    static constexpr std::string_view name = "clearcoat";
    static constexpr float most = std::numeric_limits<float>::max(), most_alpha = 0.9f;
    static constexpr std::array parameters{LobeParameter{"weight", 1, 0.0f, most},
                                           LobeParameter{"alpha", 1, 0.0f, most_alpha},
                                           LobeParameter{"normal", 3, -most, most}};
    static constexpr bool reflects = true, transmits = false, has_closed_form = false;
    static constexpr float masking_alpha = 0.25f, ior = 1.5f;

    Frame<T> frame;  ///< about its normal
    T weight, alpha, reflectance;

    static Clearcoat seen(const Parameters& p, const Vec3<T>& wo_local) {
        const Vec3<T> x(T(1), T(0), T(0)), z(T(0), T(0), T(1));
        Clearcoat lobe{frame_from_z(select(length_squared(p.normal) > T(0), p.normal, z), x), p.weight,
                       min(max(p.alpha, T(min_alpha)), T(most_alpha)), T(0)};
        lobe.reflectance = sampled_reflectance<64>(
            lobe, wo_local, [&](const Vec3<T>& wi_local) { return lobe.shape(wo_local, wi_local); });
        return lobe;
    }
    Vec3<T> eval(const Vec3<T>& wo_local, const Vec3<T>& wi_local) const {
        return Vec3<T>(weight * shape(wo_local, wi_local));
    }
    T pdf_omega(const Vec3<T>& wo_local, const Vec3<T>& wi_local) const {
        const Seen s = seen_along(wo_local, wi_local);
        const T across = s.wo.z * s.h.z - s.wo.x * s.h.x - s.wo.y * s.h.y;
        const T both = select(across > T(0), T(1), T(2));
        return select(s.is_lit, both * ndf(s.h) * s.h.z / (T(4) * max(dot(s.wo, s.h), tiny<T>)), T(0));
    }
    /// Of wo mirrored at a normal of its distribution [Burley12 (B.1)], turned about the surface's to be seen; may lie
    /// below the surface, where it is zero.
    Vec3<T> sample(const Vec3<T>& wo_local, T, const Vec2<T>& u) const {
        const T a2 = sqr(alpha), cos2 = (T(1) - exp((T(1) - u.y) * log(a2))) / (T(1) - a2), phi = T(2) * pi<T> * u.x;
        const T z = safe_sqrt(cos2), r = safe_sqrt(T(1) - cos2);
        Vec3<T> h = frame.to_world(Vec3<T>(r * cos(phi), r * sin(phi), z));
        h = select(dot(wo_local, h) > T(0), h, T(2) * z * frame.z - h);
        const Vec3<T> wi = T(2) * dot(wo_local, h) * h - wo_local;
        return {wi.x, wi.y, select(dot(wi, frame.z) > T(0), wi.z, min(wi.z, T(0)))};
    }
    Vec3<T> albedo(const Vec3<T>&) const { return Vec3<T>(weight * reflectance); }
    Vec3<T> diffuse() const { return Vec3<T>(T(0)); }
    BaseOf<T> closed_form(const Vec3<T>& wo_local) const {
        return make_base(BaseMaterialOf<T>{.alpha = alpha, .dielectric_weight = weight, .dielectric_ior = T(ior)},
                         wo_local);
    }
    T highlight_probability() const { return T(1); }
    void add_highlights(HighlightsOf<T>& highlights, const Vec3<T>& wo_local, const Mask<T>& where) const {
        HighlightOf<T> own = highlight_about_normal(alpha, closed_form(wo_local).fresnel);
        own.frame = frame;
        highlights.add(own, where);
    }
    Clearcoat blurred(T least_alpha) const {
        Clearcoat result = *this;
        result.alpha = max(alpha, min(least_alpha, T(most_alpha)));
        return result;
    }

   private:
    struct Seen {
        Vec3<T> wo, wi, h;  ///< about its normal
        Mask<T> is_lit;
    };
    Seen seen_along(const Vec3<T>& wo_local, const Vec3<T>& wi_local) const {
        const Vec3<T> wo = frame.to_local(wo_local), wi = frame.to_local(wi_local), sum = wo + wi;
        const Vec3<T> h = sum * inverse_sqrt(max(length_squared(sum), T(1e-12f)));
        return {wo, wi, h, wo.z > T(0) && wi.z > T(0) && wi_local.z > T(0) && dot(wo, h) > T(0)};
    }
    /// Density of normals, 1/sr: GTR of exponent 1 [Burley12 (4)].
    T ndf(const Vec3<T>& h) const {
        const T a2 = sqr(alpha);
        return (a2 - T(1)) / (pi<T> * log(a2) * (sqr(h.x) + sqr(h.y) + a2 * sqr(h.z)));
    }
    /// BRDF times cosine at weight 1.
    T shape(const Vec3<T>& wo_local, const Vec3<T>& wi_local) const {
        const Seen s = seen_along(wo_local, wi_local);
        const T mask = T(masking_alpha), g = ggx_g1(s.wo, mask, mask) * ggx_g1(s.wi, mask, mask);
        const T f = fresnel_dielectric(min(dot(s.wo, s.h), T(1)), T(ior));
        return select(s.is_lit, f * g * ndf(s.h) / (T(4) * max(s.wo.z, tiny<T>)), T(0));
    }
};

}  // namespace pivot
