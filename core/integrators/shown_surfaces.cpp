#include "core/integrators/shown_surfaces.h"

namespace pivot {
namespace {

std::vector<Passage> passages_of(const Scene& scene, const RenderSettings& settings, std::uint32_t bounce,
                                 std::span<const LookRay> rays, std::span<const std::optional<RayHit>> hits,
                                 ProgramMemory& memory) {
    std::vector<StraightRay> straight;
    for (std::size_t i = 0; i < rays.size(); ++i)
        straight.push_back(
            {rays[i].ray, hits[i], met_by(rays[i].ray_kind), rays[i].ray_kind, rays[i].footprint_m, rays[i].spread});
    return find_passages(scene, settings.max_path_passages, straight, bounce, {.least_part = 0.0f, .u = {}}, memory);
}

/// What a part of a ray, after so many bounces, meets of lamps.
Rgb lamps_met(const Scene& scene, const LookRay& ray, std::uint32_t bounce, float from_m, float to_m) {
    Rgb radiance(0.0f);
    if (!ray.meets_lamps) return radiance;
    for (std::size_t k = 0; k < scene.lamps().size(); ++k) {
        const LightRules rules = scene.has_light_rules() ? scene.rules_of(k) : LightRules{};
        if (!(rules.lights & met_by(ray.ray_kind)) || (bounce > 0 && bounce - 1 > rules.max_bounces)) continue;
        const auto place = intersect_light(scene.light(k), ray.ray.origin, ray.ray.direction);
        if (place && place->distance_m >= from_m && !(place->distance_m > to_m)) radiance += place->radiance;
    }
    return radiance;
}

}  // namespace

std::vector<Shown> shown_surfaces(const Scene& scene, const RenderSettings& settings, std::uint32_t bounce,
                                  std::span<const LookRay> rays, std::span<const std::optional<RayHit>> hits,
                                  ProgramMemory& memory, std::span<Sample> samples) {
    const std::vector<Passage> passages = passages_of(scene, settings, bounce, rays, hits, memory);
    std::span<const Passage> left = passages;
    std::vector<Shown> shown;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const LookRay& ray = rays[i];
        Sample& sample = samples[ray.sample];
        Shown one{.arrival = {.direction = ray.ray.direction,
                              .hit = {},
                              .material = 0,
                              .footprint_m = 0.0f,
                              .ray_kind = ray.ray_kind},
                  .sample = ray.sample,
                  .worth = ray.worth,
                  .spread = ray.spread,
                  .is_spread = ray.is_spread,
                  .is_told = bounce == 0};
        const auto show = [&](const RayHit& hit, std::uint32_t material, float opacity) {
            if (bounce == 0 && scene.has_holdouts() && scene.is_holdout(hit)) {
                if (settings.transparent_film) sample.alpha -= mean_component(one.worth) * opacity;
                return;
            }
            one.arrival.hit = hit;
            one.arrival.material = material;
            one.arrival.footprint_m = ray.footprint_m + ray.spread * hit.distance_m;
            shown.push_back(one);
        };
        float from_m = 0.0f;
        const auto cross_to = [&](float distance_m) {
            add_light(one.worth * lamps_met(scene, ray, bounce, from_m, distance_m), ray.is_spread, sample);
            from_m = distance_m;
        };
        const std::span<const Passage> way = take_passages(left, i);
        const Passage* told = bounce == 0 ? told_of(way) : nullptr;
        for (const Passage& passage : way) {
            cross_to(passage.hit.distance_m);
            one.is_told = &passage == told;
            one.arrival.ray_kind = passage.ray_kind;
            one.only_shines = passage.only_shines;
            if (passage.shown > 0.0f) show(passage.hit, passage.material, passage.opacity);
            one.worth *= passage.passed;
        }
        if (ends(way)) continue;
        cross_to(std::numeric_limits<float>::infinity());
        if (bounce == 0 && settings.transparent_film)
            sample.alpha -= std::min(mean_component(one.worth), 1.0f);
        else
            add_light(one.worth *
                          world_radiance(scene.world_view(), ray.ray.direction, ray.ray_kind, bounce, memory.registers),
                      ray.is_spread, sample);
    }
    return shown;
}

}  // namespace pivot
