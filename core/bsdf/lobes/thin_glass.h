// Light that comes through a wall of glass too thin to bend it: GGX microfacets that refract it twice spread it as a
// mirror would, turned to the other side. What the wall lets through in all is whoever's who makes the lobe. Principled
// with Thin Wall, from Blender 5.2 on.
//
// [KullaConty17]  Revisiting Physically Based Shading at Imageworks
#pragma once

#include "core/bsdf/base.h"
#include "core/bsdf/ggx.h"
#include "core/bsdf/highlight.h"
#include "core/bsdf/lobe_record.h"
#include "core/tables/ggx_albedo.h"

namespace pivot {

template <class T>
struct ThinGlass {
    struct Parameters {
        Vec3<T> color{T(1)};  ///< what comes through
        T alpha = T(0.5f);    ///< GGX alpha of both refractions together, in [0, 1]
    };
    static constexpr std::string_view name = "thin_glass";
    static constexpr std::array parameters{LobeParameter{"color", 3, 0.0f, std::numeric_limits<float>::max()},
                                           LobeParameter{"alpha", 1, 0.0f, 1.0f}};
    static constexpr bool reflects = false, transmits = true, has_closed_form = false;

    Vec3<T> color;  ///< times what gives back the light that single scattering loses
    T alpha;
    T kept;  ///< by single scattering

    static ThinGlass seen(const Parameters& p, const Vec3<T>& wo_local) {
        const T alpha = min(max(p.alpha, T(min_alpha)), T(1)), kept = ggx_albedo(alpha, wo_local.z);
        return {p.color / kept, alpha, kept};
    }
    Vec3<T> eval(const Vec3<T>& wo_local, const Vec3<T>& wi_local) const {
        const Mask<T> is_behind = wi_local.z < T(0);
        return color * select(is_behind, ggx_eval(wo_local, turned(wi_local), alpha, alpha), T(0));
    }
    T pdf_omega(const Vec3<T>& wo_local, const Vec3<T>& wi_local) const {
        return select(wi_local.z < T(0), ggx_pdf_omega(wo_local, turned(wi_local), alpha, alpha), T(0));
    }
    Vec3<T> sample(const Vec3<T>& wo_local, T, const Vec2<T>& u) const {
        return turned(ggx_sample(wo_local, alpha, alpha, u));
    }
    Vec3<T> albedo(const Vec3<T>&) const { return color * kept; }
    Vec3<T> diffuse() const { return Vec3<T>(T(0)); }
    BaseOf<T> closed_form(const Vec3<T>& wo_local) const {
        return make_base(BaseMaterialOf<T>{.diffuse = albedo(wo_local)}, wo_local);
    }
    T highlight_probability() const { return T(1); }
    ThinGlass blurred(T least_alpha) const {
        ThinGlass result = *this;
        result.alpha = max(alpha, least_alpha);
        return result;
    }

   private:
    static Vec3<T> turned(const Vec3<T>& w_local) { return {w_local.x, w_local.y, -w_local.z}; }
};

}  // namespace pivot
