#include "core/integrators/shown_surfaces.h"

namespace pivot {

std::vector<Shown> shown_surfaces(const Scene& scene, const RenderSettings& settings, std::span<const Ray> camera_rays,
                                  std::span<const std::optional<RayHit>> hits, float spread, ProgramMemory& memory,
                                  std::span<Sample> samples) {
    std::vector<Passage> passages;
    if (scene.has_transparency())
        passages = find_passages(scene, settings.max_passages, straight_rays(camera_rays, hits, spread), 0,
                                 {.least_part = 0.0f, .u = {}}, memory);
    std::span<const Passage> left = passages;
    std::vector<Shown> shown;
    for (std::size_t i = 0; i < hits.size(); ++i) {
        Sample& sample = samples[i] = {};
        Shown one{.arrival = {.direction = camera_rays[i].direction,
                              .hit = {},
                              .material = 0,
                              .footprint_m = 0.0f,
                              .ray_kind = camera_ray},
                  .sample = i};
        const auto show = [&](const RayHit& hit, std::uint32_t material, float opacity) {
            if (scene.has_holdouts() && scene.is_holdout(hit)) {
                if (settings.transparent_film) sample.alpha -= mean_component(one.worth) * opacity;
                return;
            }
            one.arrival.hit = hit;
            one.arrival.material = material;
            one.arrival.footprint_m = spread * hit.distance_m;
            shown.push_back(one);
        };
        bool ends = false;
        if (scene.has_transparency()) {
            const std::span<const Passage> way = take_passages(left, i);
            const Passage* told = told_of(way);
            for (const Passage& passage : way) {
                one.is_told = &passage == told;
                one.arrival.ray_kind = passage.ray_kind;
                one.only_shines = passage.only_shines;
                if (passage.shown > 0.0f) show(passage.hit, passage.material, passage.opacity);
                one.worth *= passage.passed;
                ends = passage.ends();
            }
        } else if (hits[i]) {
            show(*hits[i], scene.material_of(*hits[i]), 1.0f);
            ends = true;
        }
        if (ends) continue;
        if (settings.transparent_film)
            sample.alpha -= std::min(mean_component(one.worth), 1.0f);
        else
            sample.radiance = one.worth * world_radiance(scene.world_view(), camera_rays[i].direction, camera_ray, 0,
                                                         memory.registers);
    }
    return shown;
}

}  // namespace pivot
