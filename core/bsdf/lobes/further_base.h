// Another base beside the first, for surfaces that mix highlights of different kinds: each keeps its own diffuse lobe
// beneath its own highlight.
#pragma once

#include "core/bsdf/highlight.h"
#include "core/bsdf/lobe_record.h"

namespace pivot {

template <class T>
struct FurtherBase {
    using Parameters = BaseMaterialOf<T>;
    static constexpr std::string_view name = "base";
    static constexpr float most = std::numeric_limits<float>::max();
    static constexpr std::array parameters{
        LobeParameter{"diffuse", 3, 0.0f, most},          LobeParameter{"alpha", 1, 0.0f, 1.0f},
        LobeParameter{"conductor_f0", 3, 0.0f, most},     LobeParameter{"conductor_f90", 3, 0.0f, most},
        LobeParameter{"conductor_weight", 1, 0.0f, most}, LobeParameter{"dielectric_weight", 1, 0.0f, most},
        LobeParameter{"dielectric_ior", 1, 1.0f, most},   LobeParameter{"dielectric_tint", 3, 0.0f, most},
        LobeParameter{"multiscatter", 1, 0.0f, 1.0f},     LobeParameter{"weight", 1, 0.0f, most},
        LobeParameter{"conductor_dip", 3, 0.0f, most}};
    static constexpr bool reflects = true, transmits = false, has_closed_form = true;

    BaseOf<T> base;

    static FurtherBase seen(const Parameters& material, const Vec3<T>& wo_local) {
        return {make_base(material, wo_local)};
    }
    Vec3<T> eval(const Vec3<T>&, const Vec3<T>& wi_local) const { return eval_base(base, wi_local); }
    Vec3<T> eval_diffuse(const Vec3<T>&, const Vec3<T>& wi_local) const { return pivot::eval_diffuse(base, wi_local); }
    T pdf_omega(const Vec3<T>&, const Vec3<T>& wi_local) const { return pdf_omega_base(base, wi_local); }
    Vec3<T> sample(const Vec3<T>&, T u_lobe, const Vec2<T>& u) const { return sample_base(base, u_lobe, u); }
    Vec3<T> albedo(const Vec3<T>&) const { return albedo_base(base); }
    Vec3<T> diffuse() const { return base.diffuse; }
    BaseOf<T> closed_form(const Vec3<T>&) const { return base; }
    T highlight_probability() const { return base.glossy_probability; }
    void add_highlights(HighlightsOf<T>& highlights, const Vec3<T>&, const Mask<T>& where) const {
        highlights.add_beside(mean_component(base.diffuse), where);
        highlights.add(highlight_about_normal(base.alpha, base.fresnel), where);
    }
    FurtherBase blurred(T least_alpha) const { return {pivot::blurred(base, least_alpha)}; }
};

}  // namespace pivot
