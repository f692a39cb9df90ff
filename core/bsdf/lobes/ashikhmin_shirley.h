// A highlight whose microfacets' normals are distributed as a power of the cosine, wider along one axis than along the
// other: Blender's Glossy BSDF of that name, without Fresnel as there. Sampled by GGX microfacets about as rough.
//
// [Ashikhmin00]  An Anisotropic Phong BRDF Model
#pragma once

#include "core/bsdf/lobes/anisotropic_ggx.h"
#include "core/bsdf/lobes/sampled_reflectance.h"

namespace pivot {

template <class T>
struct AshikhminShirley {
    struct Parameters {
        Vec3<T> color{T(1)};                     ///< scales what it reflects
        T alpha_x = T(0.5f), alpha_y = T(0.5f);  ///< GGX's alpha about as rough, in [0, 1]
        T rotation = T(0);     ///< of the axes about the normal, from x of the shading frame, in turns
        Vec3<T> normal{T(0)};  ///< in the shading frame; none: the surface's own

        template <class LocalOf>
        void turn_normals(const LocalOf& local_of, const Mask<T>& where) {
            normal = select(where, local_of(normal), normal);
        }
    };
    static constexpr std::string_view name = "ashikhmin_shirley";
    static constexpr float most = std::numeric_limits<float>::max();
    static constexpr std::array parameters{
        LobeParameter{"color", 3, 0.0f, most}, LobeParameter{"alpha_x", 1, 0.0f, 1.0f},
        LobeParameter{"alpha_y", 1, 0.0f, 1.0f}, LobeParameter{"rotation", 1, -1e3f, 1e3f},
        LobeParameter{"normal", 3, -most, most}};
    static constexpr bool reflects = true, transmits = false, has_closed_form = false;

    TurnedFacets<T> turned;
    Vec3<T> color;
    T reflectance;

    static AshikhminShirley seen(const Parameters& p, const Vec3<T>& wo_local) {
        AshikhminShirley lobe{TurnedFacets<T>::turned(p.normal, p.rotation, p.alpha_x, p.alpha_y, T(0)), p.color, T(0)};
        lobe.reflectance = sampled_reflectance<64>(
            lobe, wo_local, [&](const Vec3<T>& wi_local) { return lobe.shape(wo_local, wi_local); });
        return lobe;
    }
    Vec3<T> eval(const Vec3<T>& wo_local, const Vec3<T>& wi_local) const { return color * shape(wo_local, wi_local); }
    T pdf_omega(const Vec3<T>& wo_local, const Vec3<T>& wi_local) const { return turned.pdf_omega(wo_local, wi_local); }
    Vec3<T> sample(const Vec3<T>& wo_local, T, const Vec2<T>& u) const { return turned.sample(wo_local, u); }
    Vec3<T> albedo(const Vec3<T>&) const { return color * reflectance; }
    Vec3<T> diffuse() const { return Vec3<T>(T(0)); }
    /// As rough all around.
    BaseOf<T> closed_form(const Vec3<T>& wo_local) const {
        return {.wo_local = wo_local,
                .diffuse = Vec3<T>(T(0)),
                .alpha = turned.alpha_all_around(),
                .fresnel = {color, color, Vec3<T>(T(0)), Vec3<T>(T(0)), T(1.5f)},
                .glossy_probability = select(max_component(color) > T(0), T(1), T(0))};
    }
    T highlight_probability() const { return T(1); }
    void add_highlights(HighlightsOf<T>& highlights, const Vec3<T>& wo_local, const Mask<T>& where) const {
        HighlightOf<T> own = highlight_about_normal(turned.facets.alpha_x, closed_form(wo_local).fresnel);
        own.frame = turned.frame();
        own.alpha_y = turned.facets.alpha_y;
        highlights.add(own, where);
    }
    AshikhminShirley blurred(T least_alpha) const {
        AshikhminShirley result = *this;
        result.turned.facets.alpha_x = max(turned.facets.alpha_x, least_alpha);
        result.turned.facets.alpha_y = max(turned.facets.alpha_y, least_alpha);
        return result;
    }

   private:
    /// BRDF times cosine, white [Ashikhmin00 (4)].
    T shape(const Vec3<T>& wo_local, const Vec3<T>& wi_local) const {
        const Vec3<T> wo = turned.frame().to_local(wo_local), wi = turned.frame().to_local(wi_local);
        const Mask<T> is_lit = wo.z > T(0) && wi.z > T(0) && wi_local.z > T(0);
        const Vec3<T> sum = wo + wi;
        const Vec3<T> h = sum * inverse_sqrt(max(length_squared(sum), T(1e-12f)));
        const auto exponent = [](T alpha) { return max(T(2) / sqr(alpha) - T(2), T(0)); };
        const T n_x = exponent(turned.facets.alpha_x), n_y = exponent(turned.facets.alpha_y);
        const T cos_h = min(max(h.z, T(1e-6f)), T(1)), x2 = sqr(h.x), y2 = sqr(h.y);
        const T power = select(x2 + y2 > T(1e-12f), (n_x * x2 + n_y * y2) / max(x2 + y2, T(1e-12f)), T(0));
        const T peak = sqrt((n_x + T(1)) * (n_y + T(1))) * T(0.125f / pi<float>);
        const T pump = max(dot(h, wo), T(1e-6f)) * max(max(wo.z, wi.z), T(1e-6f));
        return select(is_lit, wi.z * peak * exp(max(power * log(cos_h), T(-80))) / pump, T(0));
    }
};

}  // namespace pivot
