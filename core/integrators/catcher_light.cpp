#include "core/integrators/catcher_light.h"

#include "core/integrators/monte_carlo.h"

namespace pivot {

void tell_catchers(const Scene& scene, const Scene& catchers, const RenderSettings& settings, std::span<const Ray> rays,
                   std::span<const Sampler> samplers, std::span<const Sample> samples, std::span<Rgb> named) {
    const auto passes_of = [&](std::size_t i) {
        return named.subspan(i * settings.named_passes() + settings.first_catcher_pass(), catcher_pass::count);
    };
    std::vector<std::optional<RayHit>> hits(rays.size());
    scene.intersect(rays, visible_to_camera, hits);
    std::vector<std::size_t> met;
    std::vector<Ray> met_rays;
    std::vector<Sampler> met_samplers;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        if (hits[i] && scene.is_shadow_catcher(*hits[i])) {
            met.push_back(i);
            met_rays.push_back(rays[i]);
            met_samplers.push_back(samplers[i]);
        } else {
            passes_of(i)[catcher_pass::matte] = samples[i].radiance;
            passes_of(i)[catcher_pass::shares].x = samples[i].alpha;
        }
    }
    if (met.empty()) return;
    RenderSettings alone = settings;
    alone.light_groups = alone.aovs = 0;
    alone.shadow_catchers = alone.surface_passes = alone.mattes = false;
    std::vector<Sample> of_catchers(met.size());
    trace_paths(catchers, alone, met_rays, met_samplers, of_catchers);
    Registers registers;
    for (std::size_t k = 0; k < met.size(); ++k) {
        passes_of(met[k])[catcher_pass::alone] = of_catchers[k].radiance;
        passes_of(met[k])[catcher_pass::among_all] = samples[met[k]].radiance;
        passes_of(met[k])[catcher_pass::shares].y = 1.0f;
        passes_of(met[k])[catcher_pass::world] =
            world_radiance(scene.world_view(), met_rays[k].direction, camera_ray, 0, registers);
    }
}

}  // namespace pivot
