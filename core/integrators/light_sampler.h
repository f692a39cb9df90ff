// How one light is sampled from one surface point: the strategies behind RenderSettings::light_sampling.
//
// A cap-shaped light is drawn from a mixture of two techniques, one fit for the diffuse lobe and one for the glossy
// lobe, in proportion to what each lobe reflects of the light in closed form. Their density is exact, so whatever the
// closed forms say, the estimate is unbiased.
//
//            diffuse lobe         glossy lobe                          shares with BSDF samples by MIS
//   joint    projected cap        exact core (uniform where the        only where the core's cone leaves the horizon
//                                 core's cone leaves the horizon)
//   sptd     uniform in the cap   pivoted cap [Dupuy17, Sec. 6.1]      yes
//   mis      uniform in the cap   uniform in the cap                   yes
//   light    uniform in the cap   uniform in the cap                   no
//   bsdf     -                    -                                    BSDF samples alone
//
// By strategy joint the highlights (highlight.h) of lobes beside the base (core/bsdf/lobe.h) are techniques of their
// own (cap_mixture.h), and what is beside these is found by the diffuse lobe's; where that is not close to the lobes,
// and by other strategies, light samples share with BSDF samples. Of a surface that transmits light the diffuse
// technique is uniform, in the cap or by area, also below the horizon.
//
// Where there are no lobes beside the base, a joint sample adds at most 10 times the light's radiance, 50 times an area
// light's. Of a cap above the horizon it adds at most 2.5 times the light's mean where the surface has one lobe, 20
// times where it has two (7.1, 26, 2.0 and 8.9 measured, over 4e7 samples of 40000 surfaces and lights, 5e8 of 60000
// area lights; tests/core/test_sample_weights.py).
//
// An area light is drawn by strategy joint in proportion to what is reflected of its parts, a lamp at first hits and a
// mesh's triangle where it is near; the triangle, and a lamp where its samples vary, share with BSDF samples (see
// area_sampling.h). Else it is drawn uniformly by area, sharing in every strategy but light. In rooms of four bounces
// joint samples of lamps after the first hit took 4 % from relMSE and cost 10 % more CPU; of triangles that are not
// near they cost what they brought.
#pragma once

#include <variant>

#include "core/bsdf/surface.h"
#include "core/distributions/elliptic_cone.h"
#include "core/distributions/projected_cap.h"
#include "core/distributions/sptd.h"
#include "core/geometry/surface_point.h"
#include "core/integrators/area_sampling.h"
#include "core/integrators/cap_mixture.h"
#include "core/integrators/settings.h"
#include "core/lights/light.h"

namespace pivot {

/// How a bounce samples a light: what joint samples of an area lamp cost pays at first hits alone.
inline LightSampling strategy_at(std::uint32_t bounce, const Light& light, LightSampling strategy) {
    const auto* area = std::get_if<AreaLight>(&light);
    const bool is_simpler = bounce > 0 && strategy == LightSampling::joint && area && !area->is_two_sided();
    return is_simpler ? LightSampling::mis : strategy;
}

class LightSampler {
   public:
    LightSampler(const Light& light, const SurfacePoint& point, const Surface& surface, LightSampling strategy);

    /// Whether BSDF samples take part; if not, those that meet this light count nothing.
    bool shares_with_bsdf() const { return shares_with_bsdf_; }

    /// Nothing where the light does not reach the point, or by strategy bsdf.
    std::optional<LightPoint> sample(const Vec2f& u) const;

    /// Density of sample() at a place on the light.
    float pdf_omega(const LightPoint& place) const;

   private:
    /// Of the sampler of an area light that there is.
    template <class Visit>
    auto with_area(const Visit& visit) const {
        const auto* finer = std::get_if<FinerAreaSampler<float>>(&area_);
        return finer ? visit(*finer) : visit(std::get<AreaSampler<float>>(area_));
    }

    enum class Technique { none, uniform, projected, pivot, exact };

    Vec3f sample_in_cap(Technique technique, const Vec2f& u) const;
    float pdf_in_cap(Technique technique, const Vec3f& wi_local) const;

    const Light& light_;
    const SurfacePoint& point_;
    std::variant<std::monostate, AreaSampler<float>, FinerAreaSampler<float>> area_;  ///< joint
    std::optional<AreaView<float>> area_view_;                                        ///< of area_, if it is there
    std::optional<Cap<float>> cap_;                                                   ///< world space
    Cap<float> cap_local_{};
    Technique diffuse_technique_ = Technique::none;
    Technique glossy_technique_ = Technique::none;
    float glossy_probability_ = 0.0f;
    bool shares_with_bsdf_ = true;
    ProjectedCap<float> projected_cap_{};
    Pivot<float> pivot_{};
    GgxCap<float> ggx_cap_{};
    std::optional<CapMixture<float>> mixture_;  ///< joint, of surfaces with lobes unlike a base's: in place of both
};

}  // namespace pivot
