// Light that comes through a surface and leaves it evenly: Lambert, lit from the side away from the viewer. Blender's
// Translucent BSDF.
#pragma once

#include "core/bsdf/highlight.h"
#include "core/bsdf/lobe_record.h"

namespace pivot {

template <class T>
struct Translucent {
    struct Parameters {
        Vec3<T> color{T(1)};  ///< of what is lit evenly from behind, the share that comes through
    };
    static constexpr std::string_view name = "translucent";
    static constexpr std::array parameters{LobeParameter{"color", 3, 0.0f, std::numeric_limits<float>::max()}};
    static constexpr bool reflects = false, transmits = true, has_closed_form = true;

    Vec3<T> color;

    static Translucent seen(const Parameters& material, const Vec3<T>&) { return {material.color}; }
    Vec3<T> eval(const Vec3<T>& wo_local, const Vec3<T>& wi_local) const {
        return color * pdf_omega(wo_local, wi_local);
    }
    Vec3<T> eval_diffuse(const Vec3<T>& wo_local, const Vec3<T>& wi_local) const { return eval(wo_local, wi_local); }
    T pdf_omega(const Vec3<T>&, const Vec3<T>& wi_local) const { return max(-wi_local.z, T(0)) * T(1.0f / pi<float>); }
    Vec3<T> sample(const Vec3<T>&, T, const Vec2<T>& u) const {
        const Vec3<T> wi_local = sample_cosine_hemisphere(u);
        return {wi_local.x, wi_local.y, -wi_local.z};
    }
    Vec3<T> albedo(const Vec3<T>&) const { return color; }
    Vec3<T> diffuse() const { return color; }
    BaseOf<T> closed_form(const Vec3<T>& wo_local) const {
        return make_base(BaseMaterialOf<T>{.diffuse = color}, wo_local);
    }
    void add_highlights(HighlightsOf<T>& highlights, const Vec3<T>&, const Mask<T>& where) const {
        highlights.add_beside(mean_component(color), where);
    }
    Translucent blurred(T) const { return *this; }
};

}  // namespace pivot
