// Fibres that stand up from the surface, as microfacets of which the most lie across it. Blender's Velvet BSDF, and its
// Sheen BSDF's Ashikhmin.
//
// [Ashikhmin00]  A Microfacet-Based BRDF Generator, 5.4; with the shadowing of [Cook82], A Reflectance Model for
// Computer Graphics.
#pragma once

#include "core/bsdf/base.h"
#include "core/bsdf/highlight.h"
#include "core/bsdf/lobe_record.h"
#include "core/tables/velvet_albedo.h"

namespace pivot {

template <class T>
struct Velvet {
    struct Parameters {
        Vec3<T> color{T(1)};
        T sigma = T(1);  ///< how far fibres lean
    };
    static constexpr std::string_view name = "velvet";
    static constexpr std::array parameters{LobeParameter{"color", 3, 0.0f, std::numeric_limits<float>::max()},
                                           LobeParameter{"sigma", 1, 0.0f, 1.0f}};
    static constexpr bool reflects = true, transmits = false, has_closed_form = false, is_diffuse = true;

    Vec3<T> color;
    T inverse_sigma2;
    T reflectance;
    T is_grazing;  ///< 1: seen so flatly that the lobe is narrow

    static Velvet seen(const Parameters& material, const Vec3<T>& wo_local) {
        const T sigma = max(material.sigma, T(velvet_min_sigma));
        return {material.color, T(1) / (sigma * sigma), velvet_albedo(sigma, wo_local.z),
                select(wo_local.z < T(0.25f), T(1), T(0))};
    }
    Vec3<T> eval(const Vec3<T>& wo_local, const Vec3<T>& wi_local) const {
        const Vec3<T> sum = wo_local + wi_local;
        const Vec3<T> h = sum * (T(1) / sqrt(max(length_squared(sum), tiny<T>)));
        const T cos_h = h.z, cos_oh = dot(wo_local, h), sin2_h = T(1) - cos_h * cos_h;
        const Mask<T> is_lit = wi_local.z > T(0) && cos_oh > T(1e-5f) && cos_h < T(1.0f - 1e-5f);
        const T sin2 = select(is_lit, sin2_h, T(1));
        const T density = exp(-(cos_h * cos_h / sin2) * inverse_sigma2) * inverse_sigma2 /
                          (pi<T> * sin2 * sin2);  // [Ashikhmin00 (5.4)], of normals over what they cover
        const T twice = T(2) * max(cos_h / select(is_lit, cos_oh, T(1)), T(1e-5f));
        const T open = min(T(1), twice * min(wo_local.z, wi_local.z));
        return select(is_lit, color * (T(0.25f) * density * open / wo_local.z), Vec3<T>(T(0)));
    }
    T pdf_omega(const Vec3<T>&, const Vec3<T>& wi_local) const {
        return select(wi_local.z > T(0), T(0.5f / pi<float>), T(0));
    }
    Vec3<T> sample(const Vec3<T>&, T, const Vec2<T>& u) const {
        const Vec2<T> disk = sample_disk(u);  // Lambert's equal-area map
        const T radius2 = disk.x * disk.x + disk.y * disk.y, scale = safe_sqrt(T(2) - radius2);
        return {disk.x * scale, disk.y * scale, max(T(1) - radius2, T(1e-7f))};
    }
    Vec3<T> albedo(const Vec3<T>&) const { return color * reflectance; }
    Vec3<T> diffuse() const { return color * reflectance; }
    BaseOf<T> closed_form(const Vec3<T>& wo_local) const {
        return make_base(BaseMaterialOf<T>{.diffuse = color * reflectance}, wo_local);
    }
    void add_highlights(HighlightsOf<T>& highlights, const Vec3<T>&, const Mask<T>& where) const {
        constexpr float most = 10.0f;  // sigma of 0.3, where fibres lie closely across the surface
        highlights.are_close = highlights.are_close && !(where && (inverse_sigma2 > T(most) || is_grazing > T(0)));
    }
    Velvet blurred(T) const { return *this; }
};

}  // namespace pivot
