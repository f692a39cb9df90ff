#include "core/integrators/catcher_light.h"

namespace pivot {

RenderSettings settings_of_catchers(const RenderSettings& settings) {
    RenderSettings alone = settings;
    alone.light_groups = alone.aovs = 0;
    alone.shadow_catchers = alone.surface_passes = alone.mattes = false;
    return alone;
}

void tell_catchers(const Scene& scene, const RenderSettings& settings, std::span<const Ray> rays,
                   std::span<const Sample> samples, const FollowAlone& follow_alone, std::span<Rgb> named) {
    const auto passes_of = [&](std::size_t i) {
        return named.subspan(i * settings.named_passes() + settings.first_catcher_pass(), catcher_pass::count);
    };
    std::vector<std::optional<RayHit>> hits(rays.size());
    scene.intersect(rays, visible_to_camera, hits);
    std::vector<std::size_t> met;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        if (hits[i] && scene.is_shadow_catcher(*hits[i])) {
            met.push_back(i);
        } else {
            passes_of(i)[catcher_pass::matte] = samples[i].radiance;
            passes_of(i)[catcher_pass::shares].x = samples[i].alpha;
        }
    }
    if (met.empty()) return;
    std::vector<Sample> of_catchers(met.size());
    follow_alone(met, of_catchers);
    Registers registers;
    for (std::size_t k = 0; k < met.size(); ++k) {
        passes_of(met[k])[catcher_pass::alone] = of_catchers[k].radiance;
        passes_of(met[k])[catcher_pass::among_all] = samples[met[k]].radiance;
        passes_of(met[k])[catcher_pass::shares].y = 1.0f;
        passes_of(met[k])[catcher_pass::world] =
            world_radiance(scene.world_view(), rays[met[k]].direction, camera_ray, 0, registers);
    }
}

}  // namespace pivot
