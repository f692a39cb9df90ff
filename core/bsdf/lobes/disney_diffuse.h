// The diffuse part of the Principled BSDF before Blender 4.0: Lambert's, darker at grazing angles, brighter where a
// rough surface is seen along the light; and a sheen of light that grazes fibres. Nothing above takes a share of it.
//
// [Burley15]  Extending the Disney BRDF to a BSDF with Integrated Subsurface Scattering, section 2.3; the sheen is that
// of [Burley12], Physically-Based Shading at Disney.
#pragma once

#include "core/bsdf/fresnel.h"
#include "core/bsdf/lobe_record.h"

namespace pivot {

template <class T>
struct DisneyDiffuse {
    struct Parameters {
        Vec3<T> color{T(1)};
        T roughness = T(0.5f);  ///< the artist's, of the surface's highlight too
        Vec3<T> sheen{T(0)};    ///< how much, in what colour
    };
    static constexpr std::string_view name = "disney_diffuse";
    static constexpr float most = std::numeric_limits<float>::max();
    static constexpr std::array parameters{LobeParameter{"color", 3, 0.0f, most},
                                           LobeParameter{"roughness", 1, 0.0f, 1.0f},
                                           LobeParameter{"sheen", 3, 0.0f, most}};
    static constexpr bool reflects = true, transmits = false, has_closed_form = false, is_diffuse = true;

    Vec3<T> color;
    T roughness;
    Vec3<T> sheen;

    static DisneyDiffuse seen(const Parameters& material, const Vec3<T>&) {
        return {material.color, material.roughness, material.sheen};
    }
    Vec3<T> eval(const Vec3<T>& wo_local, const Vec3<T>& wi_local) const {
        const T cos_i = max(wi_local.z, T(0)), one(1), half(0.5f);
        const T cos_oi = max(dot(wo_local, wi_local), T(-1));
        const T fo = schlick_weight(wo_local.z), fi = schlick_weight(cos_i);
        const T retro = roughness * (one + cos_oi);
        const T whole =
            (one - half * fo) * (one - half * fi) + retro * (fo + fi + fo * fi * (retro - one));  // [Burley15 (4)]
        const T grazing = schlick_weight(sqrt(half + half * cos_oi));
        return (color * (whole * T(1.0f / pi<float>)) + sheen * grazing) * cos_i;
    }
    T pdf_omega(const Vec3<T>&, const Vec3<T>& wi_local) const { return max(wi_local.z, T(0)) * T(1.0f / pi<float>); }
    Vec3<T> sample(const Vec3<T>&, T, const Vec2<T>& u) const { return sample_cosine_hemisphere(u); }
    /// Exact of the diffuse part: moments of Schlick's weight; the sheen's is a fit, 0.2 % off at most.
    Vec3<T> albedo(const Vec3<T>& wo_local) const {
        const T c = wo_local.z, c2 = c * c, one(1), fo = schlick_weight(c);
        const T along = T(1.0f / 21.0f) + c * T(1.0f / 84.0f);  // the mean of (1 + cos_oi) fi
        const T squared = T(1.0f / 21.0f) + c * T(1.0f / 42.0f) + c2 * T(1.0f / 252.0f) +
                          (one - c2) * T(0.5f * (1.0f / 21.0f - 1.0f / 252.0f));  // and of (1 + cos_oi)^2 fi
        const T whole = (one - T(0.5f) * fo) * T(41.0f / 42.0f) +
                        roughness * (along + fo * (one + c * T(2.0f / 3.0f) - along + roughness * squared));
        const T grazing =
            T(0.08840695f) + c * (T(-0.24997361f) + c * (T(0.26876233f) + c * (T(-0.13374666f) + c * T(0.02680844f))));
        return color * whole + sheen * grazing;
    }
    Vec3<T> diffuse() const { return color; }
    BaseOf<T> closed_form(const Vec3<T>& wo_local) const {
        return make_base(BaseMaterialOf<T>{.diffuse = albedo(wo_local)}, wo_local);
    }
    DisneyDiffuse blurred(T) const { return *this; }
};

}  // namespace pivot
