// Shading points side by side in a batch's lanes. Lanes past `count` repeat the last point.
#pragma once

#include <array>
#include <span>

#include "core/scene/surface_point.h"
#include "core/shading/ggx_cap_light.h"
#include "core/simd/batch.h"

namespace pivot {

struct ShadingPoint {
    SurfacePoint point;
    Surface surface;
    Cap<float> bent_cone;  ///< world space, where occlusion is by bent cones
};

struct SurfaceBatch {
    std::size_t count;
    std::array<const ShadingPoint*, batch_size> lanes;
    Vec3b position;
    Frame<Batch> frame;
    GgxLobe<Batch> lobe;                           // of alpha 1 where there is none
    bool has_diffuse = false, has_glossy = false;  // in some lane
};

/// What a function of each point gives, lane by lane.
template <class Value>
Lanes gather_lanes(const SurfaceBatch& batch, const Value& value) {
    Lanes lanes;
    for (std::size_t i = 0; i < batch_size; ++i) lanes[i] = value(*batch.lanes[i]);
    return lanes;
}

template <class Value>
Batch gather(const SurfaceBatch& batch, const Value& value) {
    return load(gather_lanes(batch, value));
}

template <class Value>
Vec3b gather_vector(const SurfaceBatch& batch, const Value& value) {
    Lanes x, y, z;
    for (std::size_t i = 0; i < batch_size; ++i) {
        const Vec3f v = value(*batch.lanes[i]);
        x[i] = v.x;
        y[i] = v.y;
        z[i] = v.z;
    }
    return {load(x), load(y), load(z)};
}

/// How much larger Fresnel's curve is at grazing than at normal incidence, relative.
inline float fresnel_contrast(const LobeFresnel& f) {
    const Rgb f0 = f.schlick_f0 + f.dielectric_f0, f90 = f.schlick_f90 + f.dielectric_f90;
    float contrast = 0.0f;
    for (int i = 0; i < 3; ++i)
        if (f90[i] > f0[i]) contrast = std::max(contrast, (f90[i] - f0[i]) / std::max(f0[i], 1e-3f * f90[i]));
    return contrast;
}

/// At most batch_size points, at least one.
inline SurfaceBatch make_batch(std::span<const ShadingPoint> points) {
    SurfaceBatch batch;
    batch.count = points.size();
    for (std::size_t i = 0; i < batch_size; ++i) batch.lanes[i] = &points[std::min(i, points.size() - 1)];
    batch.position = gather_vector(batch, [](const ShadingPoint& p) { return p.point.position; });
    batch.frame = {gather_vector(batch, [](const ShadingPoint& p) { return p.point.frame.x; }),
                   gather_vector(batch, [](const ShadingPoint& p) { return p.point.frame.y; }),
                   gather_vector(batch, [](const ShadingPoint& p) { return p.point.frame.z; })};
    batch.lobe.wo_local = gather_vector(batch, [](const ShadingPoint& p) { return p.surface.wo_local; });
    batch.lobe.alpha =
        gather(batch, [](const ShadingPoint& p) { return p.surface.has_glossy() ? p.surface.alpha : 1.0f; });
    batch.lobe.ior = gather(batch, [](const ShadingPoint& p) { return p.surface.fresnel.ior; });
    batch.lobe.fresnel_contrast =
        gather(batch, [](const ShadingPoint& p) { return fresnel_contrast(p.surface.fresnel); });
    batch.lobe.has_dielectric = false;
    for (const ShadingPoint* p : batch.lanes) {
        batch.lobe.has_dielectric |= max_component(p->surface.fresnel.dielectric_f90) > 0.0f;
        batch.has_diffuse |= p->surface.has_diffuse();
        batch.has_glossy |= p->surface.has_glossy();
    }
    return batch;
}

}  // namespace pivot
