// Light from within a cone, all of it alike up to a soft rim: about the normal, or about where the viewer's mirror
// image is. Blender's Toon BSDF, Diffuse and Glossy. [Cycles 4.5 closure/bsdf_toon.h], from whose equations this is.
#pragma once

#include "core/bsdf/base.h"
#include "core/bsdf/highlight.h"
#include "core/bsdf/lobes/sampled_reflectance.h"
#include "core/math/frame.h"

namespace pivot {

template <class T>
struct Toon {
    struct Parameters {
        Vec3<T> color{T(1)};  ///< scales what it reflects
        T size = T(0.5f);     ///< the cone's half angle, in quarter turns
        T smooth = T(0);      ///< of the rim about it, likewise
        T glossy = T(0);      ///< 1: about the mirror image; 0: about the normal
    };
    static constexpr std::string_view name = "toon";
    static constexpr std::array parameters{LobeParameter{"color", 3, 0.0f, std::numeric_limits<float>::max()},
                                           LobeParameter{"size", 1, 0.0f, 1.0f}, LobeParameter{"smooth", 1, 0.0f, 1.0f},
                                           LobeParameter{"glossy", 1, 0.0f, 1.0f}};
    static constexpr bool reflects = true, transmits = false, has_closed_form = false;

    Vec3<T> color, axis;
    T angle, rim;  ///< rad
    T height;      ///< of the cone with its rim: the versine of its half angle
    T of_diffuse;  ///< 1: about the normal
    T reflectance;

    static Toon seen(const Parameters& p, const Vec3<T>& wo_local) {
        const T quarter = T(0.5f) * pi<T>, is_glossy = select(p.glossy > T(0.5f), T(1), T(0));
        const Vec3<T> mirrored(-wo_local.x, -wo_local.y, wo_local.z), normal(T(0), T(0), T(1));
        Toon lobe;
        lobe.color = p.color;
        lobe.axis = select(is_glossy > T(0), mirrored, normal);
        lobe.angle = min(max(p.size, T(1e-3f)), T(1)) * quarter;
        lobe.rim = clamp01(p.smooth) * quarter;
        lobe.height = T(1) - cos(min(lobe.angle + lobe.rim, quarter));
        lobe.of_diffuse = T(1) - is_glossy;
        lobe.reflectance = sampled_reflectance<16>(
            lobe, wo_local, [&](const Vec3<T>& wi_local) { return lobe.shape(wo_local, wi_local); });
        return lobe;
    }
    Vec3<T> eval(const Vec3<T>& wo_local, const Vec3<T>& wi_local) const { return color * shape(wo_local, wi_local); }
    T pdf_omega(const Vec3<T>&, const Vec3<T>& wi_local) const {
        const Mask<T> is_within = T(1) - dot(axis, wi_local) < height && wi_local.z > T(0);
        return select(is_within, T(0.5f / pi<float>) / height, T(0));
    }
    Vec3<T> sample(const Vec3<T>&, T, const Vec2<T>& u) const {
        const T z = T(1) - u.x * height, r = safe_sqrt(T(1) - sqr(z)), phi = T(2) * pi<T> * u.y;
        return frame_from_z(axis).to_world(Vec3<T>(r * cos(phi), r * sin(phi), z));
    }
    Vec3<T> albedo(const Vec3<T>&) const { return color * reflectance; }
    Vec3<T> diffuse() const { return color * of_diffuse; }
    BaseOf<T> closed_form(const Vec3<T>& wo_local) const {
        return make_base(BaseMaterialOf<T>{.diffuse = color * reflectance}, wo_local);
    }
    Toon blurred(T) const { return *this; }

   private:
    /// BRDF times cosine, white.
    T shape(const Vec3<T>& wo_local, const Vec3<T>& wi_local) const {
        return pdf_omega(wo_local, wi_local) * share(wi_local);
    }
    /// Of the light from a direction of the cone, what is reflected.
    T share(const Vec3<T>& wi_local) const {
        const T from_axis = acos(min(max(dot(axis, wi_local), T(-1)), T(1)));
        const T faded = T(1) - (from_axis - angle) / max(rim, T(1e-6f));
        return select(wi_local.z > T(0), select(from_axis < angle, T(1), clamp01(faded)), T(0));
    }
};

}  // namespace pivot
