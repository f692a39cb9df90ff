// A microfacet surface whose distribution of normals is a picture: GGX's functions (ggx.h) for a table. Shading frame,
// z the normal, x the tangent; wo and wi above the surface.
//
// Masking-shadowing is Smith's, height-correlated, of G1(w) = w.z / sigma(w), never above 1 [Heitz14 (99)]. Normals are
// drawn by what wo sees of the fitted lobes (ndf_fit.h), the more often the better these fit, else in proportion to the
// picture itself: whatever the fit leaves out is found.
//
// [Heitz14]  "Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs"
// [Dupuy15]  "Extracting Microfacet-based BRDF Parameters from Arbitrary Materials with Power Iterations", (3): G1
#pragma once

#include "core/distributions/ndf_fit.h"
#include "core/distributions/ndf_projected_area.h"

namespace pivot {

class TabulatedNdf {
   public:
    /// pixels: as NdfImage takes them, which throws where they cannot be.
    TabulatedNdf(std::size_t size, std::vector<float> pixels);

    const NdfImage& image() const { return image_; }
    const NdfFit& fit() const { return fit_; }
    /// The fit's lobes, each about its own axes.
    const std::vector<OwnAxes>& fit_axes() const { return fit_axes_; }
    /// Of a GGX distribution about as rough, all around.
    float alpha() const { return sigma_.alpha(); }

    /// int max(w.h, 0) D(h) dw.
    float sigma(const Vec3f& w_local) const { return sigma_(w_local); }
    float g1(const Vec3f& w_local) const { return 1.0f / (1.0f + lambda(w_local)); }
    /// BRDF times cosine without Fresnel, D G2 / (4 cos_o), 1/sr; 0 where wi is below the surface.
    float eval(const Vec3f& wo_local, const Vec3f& wi_local) const;
    /// Density of sample(), which may draw directions below the surface.
    float pdf_omega(const Vec3f& wo_local, const Vec3f& wi_local) const;
    Vec3f sample(const Vec3f& wo_local, float u_part, const Vec2f& u) const;

    /// Directional albedo, the integral of eval over wi; and its hemispherical mean.
    float albedo(const Vec3f& wo_local) const;
    float average_albedo() const { return average_albedo_; }

    std::size_t memory_bytes() const;

   private:
    float lambda(const Vec3f& w_local) const;
    float visible_pdf(const Vec3f& wo_local, const Vec3f& h_local) const;
    float measured_albedo(const Vec3f& wo_local) const;

    static constexpr std::size_t albedo_azimuths = 16, albedo_elevations = 16;

    NdfImage image_;
    NdfProjectedArea sigma_;
    NdfFit fit_;
    std::vector<OwnAxes> fit_axes_;
    float fit_probability_;  ///< of drawing a normal by the fit
    std::array<float, albedo_azimuths * albedo_elevations> albedo_;
    float average_albedo_ = 0.0f;
};

}  // namespace pivot
