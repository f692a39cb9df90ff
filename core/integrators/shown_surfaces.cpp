#include "core/integrators/shown_surfaces.h"

#include "core/integrators/lit_share.h"

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

/// Adds what a part of a ray, after so many bounces, meets of lamps. worth: of it.
void add_lamps_met(const Scene& scene, const LookRay& ray, std::uint32_t bounce, const Rgb& worth, float from_m,
                   float to_m, Sample& sample, GroupLight* groups) {
    if (!ray.meets_lamps) return;
    for (std::size_t k = 0; k < scene.lamps().size(); ++k) {
        const LightRules rules = scene.has_light_rules() ? scene.rules_of(k) : LightRules{};
        if (!(rules.lights & met_by(ray.ray_kind)) || (bounce > 0 && bounce - 1 > rules.max_bounces) ||
            !is_for(scene, rules.links, ray.from))
            continue;
        const auto place = intersect_light(scene.light(k), ray.ray.origin, ray.ray.direction);
        if (!place || place->distance_m < from_m || place->distance_m > to_m) continue;
        const Rgb light = worth * place->radiance;
        add_light(light, ray.is_spread, sample);
        if (groups) groups->add(ray.sample, scene.light_group_of(k), light);
    }
}

}  // namespace

std::vector<Shown> shown_surfaces(const Scene& scene, const RenderSettings& settings, std::uint32_t bounce,
                                  std::span<const LookRay> rays, std::span<const std::optional<RayHit>> hits,
                                  ProgramMemory& memory, std::span<Sample> samples, GroupLight* groups) {
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
                  .is_told = bounce == 0,
                  .from = ray.from};
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
            add_lamps_met(scene, ray, bounce, one.worth, from_m, distance_m, sample, groups);
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
        if (bounce == 0 && settings.transparent_film) {
            sample.alpha -= std::min(mean_component(one.worth), 1.0f);
            continue;
        }
        const Rgb sky =
            one.worth * world_radiance(scene.world_view(), ray.ray.direction, ray.ray_kind, bounce, memory.registers);
        add_light(sky, ray.is_spread, sample);
        if (groups) groups->add(ray.sample, scene.world_light_group(), sky);
    }
    return shown;
}

}  // namespace pivot
