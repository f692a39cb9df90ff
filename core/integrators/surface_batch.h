// Shading points side by side in a batch's lanes. Lanes past `count` repeat the last point.
#pragma once

#include <array>
#include <span>

#include "core/bsdf/surface.h"
#include "core/geometry/surface_point.h"
#include "core/integrators/settings.h"
#include "core/scene/light_links.h"
#include "core/shading/ggx_cap_light.h"
#include "core/simd/batch.h"

namespace pivot {

/// A surface, or the part of one that a lobe beside its base is.
struct ShadingPoint {
    SurfacePoint point;
    Base surface;
    Cap<float> bent_cone;   ///< world space, where occlusion is by bent cones
    bool is_glass = false;  ///< the part of a lobe that refracts, too
    LinkSets link_sets{};   ///< of its object
};

struct SurfaceBatch {
    std::size_t count;
    std::array<const ShadingPoint*, batch_size> lanes;
    Vec3b position;
    Frame<Batch> frame;
    GgxLobe<Batch> lobe;                           // of alpha 1 where there is none
    bool has_diffuse = false, has_glossy = false;  // in some lane
};

/// The error that closed forms may make, relative. A method that was asked for by name takes the best there is, also
/// where the exact core stands in for it.
inline Batch budget_of(const RenderSettings& settings) {
    const bool automatic = settings.analytic_method == AnalyticMethod::automatic;
    return Batch(automatic ? 0.01f * settings.error_budget_percent : 1e-4f);
}

/// How much larger Fresnel's curve is at grazing than at normal incidence, relative.
inline float fresnel_contrast(const LobeFresnel& f) {
    const Rgb f0 = f.schlick_f0 + f.dielectric_f0, f90 = f.schlick_f90 + f.dielectric_f90;
    float contrast = 0.0f;
    for (int i = 0; i < 3; ++i)
        if (f90[i] > f0[i]) contrast = std::max(contrast, (f90[i] - f0[i]) / std::max(f0[i], 1e-3f * f90[i]));
    return contrast;
}

/// What a lobe reflects of a light, by its sums. Those under F82's weight are not kept, which is nearly a line over
/// Schlick's weight: it is taken at that one's mean.
inline Rgb reflected_by(const LobeFresnel& f, const LobeSums<float>& sums) {
    const float schlick = f.has_dip() ? clamp01(sums.schlick / std::max(sums.plain, tiny<float>)) : 0.0f;
    const float f82 = f.has_dip() ? sums.plain * f82_weight(1.0f - std::pow(schlick, 0.2f)) : 0.0f;
    return f.of_sums(sums.plain, sums.schlick, f82, sums.dielectric);
}

/// At most batch_size points, at least one.
inline SurfaceBatch make_batch(std::span<const ShadingPoint> points) {
    SurfaceBatch batch;
    batch.count = points.size();
    for (std::size_t i = 0; i < batch_size; ++i) batch.lanes[i] = &points[std::min(i, points.size() - 1)];
    const auto point = [&](std::size_t i) -> const SurfacePoint& { return batch.lanes[i]->point; };
    const auto surface = [&](std::size_t i) -> const Base& { return batch.lanes[i]->surface; };
    batch.position = gather_vector([&](std::size_t i) { return point(i).position; });
    batch.frame = {gather_vector([&](std::size_t i) { return point(i).frame.x; }),
                   gather_vector([&](std::size_t i) { return point(i).frame.y; }),
                   gather_vector([&](std::size_t i) { return point(i).frame.z; })};
    batch.lobe.wo_local = gather_vector([&](std::size_t i) { return surface(i).wo_local; });
    batch.lobe.alpha = gather([&](std::size_t i) { return surface(i).has_glossy() ? surface(i).alpha : 1.0f; });
    batch.lobe.ior = gather([&](std::size_t i) { return surface(i).fresnel.ior; });
    batch.lobe.fresnel_contrast = gather([&](std::size_t i) { return fresnel_contrast(surface(i).fresnel); });
    batch.lobe.has_dielectric = false;
    for (const ShadingPoint* p : batch.lanes) {
        batch.lobe.has_dielectric |= max_component(p->surface.fresnel.dielectric_f90) > 0.0f;
        batch.has_diffuse |= p->surface.has_diffuse();
        batch.has_glossy |= p->surface.has_glossy();
    }
    return batch;
}

}  // namespace pivot
