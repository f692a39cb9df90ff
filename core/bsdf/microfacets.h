// Microfacets whose normals are distributed as GGX has it, or Beckmann, as a number of the lobe says; Smith's
// height-correlated masking and shadowing of both. Shading frame, z the normal; wo and wi point away from the surface.
//
// [Heitz14]  Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs
#pragma once

#include "core/bsdf/beckmann.h"
#include "core/bsdf/ggx.h"

namespace pivot {

template <class T>
struct MicrofacetsOf {
    T alpha_x, alpha_y;
    T beckmann;  ///< 1: Beckmann's distribution; 0: GGX

    Mask<T> is_beckmann() const { return beckmann > T(0.5f); }

    /// Density of normals, 1/sr, for a unit h above the surface.
    T ndf(const Vec3<T>& h_local) const {
        const T ggx = ggx_ndf(h_local, alpha_x, alpha_y);
        if (!any(is_beckmann())) return ggx;
        return select(is_beckmann(), beckmann_ndf(h_local, alpha_x, alpha_y), ggx);
    }
    /// Masking of one direction.
    T g1(const Vec3<T>& w_local) const { return T(1) / (T(1) + lambda(w_local)); }
    /// Masking and shadowing [Heitz14 (99)].
    T g2(const Vec3<T>& wo_local, const Vec3<T>& wi_local) const {
        return T(1) / (T(1) + lambda(wo_local) + lambda(wi_local));
    }
    /// BRDF times cosine without Fresnel, D G2 / (4 cos_o), 1/sr; both directions above the surface.
    T eval(const Vec3<T>& wo_local, const Vec3<T>& wi_local) const {
        return ndf(normalize(wo_local + wi_local)) * g2(wo_local, wi_local) / (T(4) * wo_local.z);
    }
    /// Density of wo mirrored at sample_normal()'s, G1(wo) D / (4 cos_o), 1/sr.
    T pdf_omega(const Vec3<T>& wo_local, const Vec3<T>& wi_local) const {
        return ndf(normalize(wo_local + wi_local)) * g1(wo_local) / (T(4) * wo_local.z);
    }
    /// A visible normal for u in [0, 1)^2.
    Vec3<T> sample_normal(const Vec3<T>& wo_local, const Vec2<T>& u) const {
        const Vec3<T> ggx = ggx_sample_normal(wo_local, alpha_x, alpha_y, u);
        if (!any(is_beckmann())) return ggx;
        return select(is_beckmann(), beckmann_sample_normal(wo_local, alpha_x, alpha_y, u), ggx);
    }

   private:
    T lambda(const Vec3<T>& w_local) const {
        const T ggx = ggx_lambda(w_local, alpha_x, alpha_y);
        if (!any(is_beckmann())) return ggx;
        return select(is_beckmann(), beckmann_lambda(w_local, alpha_x, alpha_y), ggx);
    }
};

}  // namespace pivot
