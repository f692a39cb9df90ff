// Diffuse reflection of a rough surface: brighter than Lambert's towards the light and along the edges. Blender's
// Diffuse BSDF, and Principled's diffuse part, with a roughness.
//
// [Fujii12]  A Tiny Improvement of Oren-Nayar Reflectance Model: the qualitative model, which loses some light.
// [Portsmouth24]  EON: A Practical Energy-Preserving Rough Diffuse BRDF: light that facets scatter on gives that back,
// coloured anew by each of them. Here as in Cycles 4.5, which multiplies it by the colour once more than the paper
// does.
#pragma once

#include "core/bsdf/lobe_record.h"

namespace pivot {

template <class T>
struct OrenNayar {
    struct Parameters {
        Vec3<T> weight{T(1)};   ///< the share of the surface that it is, and in what colour
        Vec3<T> color{T(1)};    ///< of its facets, for light that they scatter on
        T roughness = T(0);     ///< in [0, 1]; 0 is Lambert
        T keeps_energy = T(1);  ///< 1: facets scatter light on; 0: that is lost
    };
    static constexpr std::string_view name = "oren_nayar";
    static constexpr float most = std::numeric_limits<float>::max();
    static constexpr std::array parameters{
        LobeParameter{"weight", 3, 0.0f, most}, LobeParameter{"color", 3, 0.0f, most},
        LobeParameter{"roughness", 1, 0.0f, 1.0f}, LobeParameter{"keeps_energy", 1, 0.0f, 1.0f}};
    static constexpr bool reflects = true, transmits = false, has_closed_form = false, is_diffuse = true;

    Vec3<T> weight;
    T even, bent;          ///< A and B of [Fujii12], over pi
    Vec3<T> scattered_on;  ///< what facets add to the BRDF, over what they lose of light from wi

    static OrenNayar seen(const Parameters& material, const Vec3<T>& wo_local) {
        OrenNayar lobe;
        const T roughness = clamp01(material.roughness), one(1);
        lobe.weight = material.weight;
        lobe.even = one / (pi<T> + roughness * (T(0.5f) * pi<T> - T(2.0f / 3.0f)));
        lobe.bent = roughness * lobe.even;
        const T mean = lobe.mean_kept();
        const Vec3<T> color = min(max(material.color, Vec3<T>(T(0))), Vec3<T>(one));
        const Vec3<T> further = color * color * mean / ((Vec3<T>(one) - color * (one - mean)) * pi<T>);
        lobe.scattered_on =
            further * (material.keeps_energy * (one - lobe.kept(wo_local.z)) / max(one - mean, T(1e-6f)));
        return lobe;
    }
    Vec3<T> eval(const Vec3<T>& wo_local, const Vec3<T>& wi_local) const {
        const T cos_i = max(wi_local.z, T(0));
        const T across = dot(wi_local, wo_local) - cos_i * wo_local.z;
        const T s = select(across > T(0), across / max(max(cos_i, wo_local.z), tiny<T>), across);  // [Fujii12]
        const Vec3<T> brdf = Vec3<T>(even + bent * s) + scattered_on * (T(1) - kept(cos_i));
        return weight * brdf * cos_i;
    }
    T pdf_omega(const Vec3<T>&, const Vec3<T>& wi_local) const { return max(wi_local.z, T(0)) * T(1.0f / pi<float>); }
    Vec3<T> sample(const Vec3<T>&, T, const Vec2<T>& u) const { return sample_cosine_hemisphere(u); }
    Vec3<T> albedo(const Vec3<T>& wo_local) const {
        return weight * (Vec3<T>(kept(wo_local.z)) + scattered_on * (pi<T> * (T(1) - mean_kept())));
    }
    /// What Cycles' pass shows: not what is lost.
    Vec3<T> diffuse() const { return weight; }
    BaseOf<T> closed_form(const Vec3<T>& wo_local) const {
        return make_base(BaseMaterialOf<T>{.diffuse = albedo(wo_local)}, wo_local);
    }
    OrenNayar blurred(T) const { return *this; }

   private:
    /// Of light from an angle, what is left after one facet [Portsmouth24 (14)].
    T kept(T cos_theta) const {
        const T c = clamp01(cos_theta), s = safe_sqrt(T(1) - c * c), third(2.0f / 3.0f);
        const T turned = s * (acos(c) - third - s * c) + third * s * c * (T(1) + s + s * s) / (T(1) + s);
        return even * pi<T> + bent * turned;
    }
    /// Its mean over the hemisphere.
    T mean_kept() const { return even * pi<T> + bent * T((2.0f * pi<float> - 5.6f) / 3.0f); }
};

}  // namespace pivot
