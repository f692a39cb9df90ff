#include "core/integrators/area_light_shading.h"

namespace pivot {

Reflection shade_area_light(const Scene& scene, const AreaLight& light, const SurfaceBatch& batch,
                            const RenderSettings& settings, const FixedPoints& points) {
    Reflection reflection{};
    const Light any_light = light;
    for (std::size_t i = 0; i < batch.count; ++i) {
        const auto& [point, surface, bent_cone] = *batch.lanes[i];
        const std::uint32_t count = points.count();
        for (std::uint32_t k = 0; k < count; ++k) {
            const auto place = sample_light(any_light, point.position, points.point(PointSet::light_diffuse, k, count));
            if (!place || !point.faces(place->wi)) continue;
            const Ray ray{point.ray_origin(place->wi), place->wi, 0.0f, place->distance_m * (1.0f - 1e-5f)};
            if (settings.occlusion == Occlusion::ray_traced && scene.occluded(ray)) continue;
            const Vec3f wi_local = point.frame.to_local(place->wi);
            const Rgb incident = place->radiance / (place->pdf_omega * static_cast<float>(count));
            reflection.diffuse[i] += eval_diffuse(surface, wi_local) * incident;
            if (surface.has_glossy()) reflection.glossy[i] += eval_glossy(surface, wi_local) * incident;
        }
        reflection.method[i] = Method::point_set;
    }
    return reflection;
}

}  // namespace pivot
