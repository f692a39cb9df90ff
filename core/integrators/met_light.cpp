#include "core/integrators/met_light.h"

#include "core/integrators/light_sampler.h"
#include "core/integrators/lit_share.h"
#include "core/integrators/world_sampling.h"

namespace pivot {
namespace {

/// The weight of a BSDF sample that meets a light of which so many samples are expected, beside these.
float bsdf_weight(const Light& light, LightSampling strategy, std::uint32_t bounce, const Vertex& vertex,
                  const LightPoint& place, float expected_samples, float bsdf_pdf_omega) {
    const LightSampler sampler(light, vertex.point, vertex.surface, strategy_at(bounce, light, strategy));
    if (!sampler.shares_with_bsdf()) return 0.0f;
    return balance(bsdf_pdf_omega, expected_samples * sampler.pdf_omega(place));  // 0: BSDF samples are alone
}

/// Of shadow rays from where one path has arrived, in each lane.
ShadowPath shadow_path_of(const Work& work, std::uint32_t bounce, const Path& path) {
    return {work.settings.max_passages, bounce, WordBatch(path.arrival.ray_kind)};
}

}  // namespace

Rgb lamps_met(const Work& work, Fog* fog, std::uint32_t bounce, std::span<const SharedLamp> lamps, const Vertex& vertex,
              const Vec3f& wi, float bsdf_pdf_omega, const WayOn& way, const Path& path, std::size_t lane) {
    const float distance_m = way.hit ? way.hit->distance_m : std::numeric_limits<float>::infinity();
    Rgb radiance(0.0f);
    for (const auto& [index, expected] : lamps) {
        const Light& lamp = work.scene.light(index);
        const auto place = intersect_light(lamp, vertex.point.position, wi);
        // A sun is met where the ray leaves the scene: infinity against infinity.
        const LightRules rules = work.scene.has_light_rules() ? work.scene.rules_of(index) : LightRules{};
        if (!place || bounce > rules.max_bounces || !is_for(work.scene, rules.links, path.arrival.hit.instance))
            continue;
        const bool has_own_blockers = rules.casts_shadows && has_blockers_of_its_own(rules.links);
        if (rules.casts_shadows && !has_own_blockers && place->distance_m > distance_m) continue;
        Rgb light = place->radiance *
                    (bsdf_weight(lamp, work.settings.light_sampling, bounce, vertex, *place, expected, bsdf_pdf_omega) /
                     expected);
        light *= lit_share(rules, vertex.surface, vertex.point.frame.to_local(wi)) *
                 work.scene.lamp_share(index, vertex.point.position, wi, bounce + 1, work.memory.registers);
        const Ray ray{.origin = vertex.point.ray_origin(wi),
                      .direction = wi,
                      .far_m = place->distance_m,
                      .time = vertex.point.time};
        if (has_own_blockers)
            light *=
                light_past_others(work.scene, ray, rules.links, shadow_path_of(work, bounce, path), 0, work.memory);
        else if (!way.passages.empty() && rules.casts_shadows)
            light *= way.worth_from(place->distance_m);
        if (fog && rules.casts_shadows)
            light *= fog->transmittance(ray, path.sample, static_cast<std::uint32_t>(index));
        radiance += light;
        if (work.groups) work.groups->note(lane, work.scene.light_group_of(index), light);
    }
    return radiance;
}

float emission_weight(const Work& work, std::uint32_t bounce, const VertexBatch& vertices, const VertexLights& lights,
                      std::size_t lane, const Vec3f& wi, float bsdf_pdf_omega, const RayHit& hit) {
    const auto index = work.scene.light_of(hit);
    if (!index) return 1.0f;
    const Light light = work.scene.light_at(*index, hit.time);
    const auto place = light_point(std::get<AreaLight>(light), wi, hit.distance_m);
    if (!place) return 1.0f;
    return bsdf_weight(light, work.settings.light_sampling, bounce, vertices.lane(lane), *place,
                       lights.expected_samples(lane, *index), bsdf_pdf_omega);
}

Rgb shining_past_others_met(const Work& work, Fog* fog, std::uint32_t bounce, const Path& path,
                            const VertexBatch& vertices, const VertexLights& lights, std::size_t lane, const Ray& from,
                            std::uint32_t ray_kind, float bsdf_pdf_omega) {
    const Scene& scene = work.scene;
    Rgb sum(0.0f);
    Ray ray = from;
    ray.far_m = std::numeric_limits<float>::infinity();
    while (const auto hit = scene.intersect(ray, shines_past_others)) {
        ray.near_m = behind(hit->distance_m);
        const LightLinks& links = scene.links_of(hit->instance);
        if (!is_for(scene, links, path.arrival.hit.instance) || !scene.is_met(hit->instance, met_by(ray_kind)))
            continue;
        const Arrival arrival{.direction = from.direction,
                              .hit = *hit,
                              .material = scene.material_of(*hit),
                              .footprint_m = 0.0f,
                              .ray_kind = ray_kind};
        const Arrival* const arrivals[] = {&arrival};
        const Vec3b emission = make_arrivals(scene, arrivals, bounce + 1, work.memory).material.emission;
        Rgb light(store(emission.x)[0], store(emission.y)[0], store(emission.z)[0]);
        light *= emission_weight(work, bounce, vertices, lights, lane, from.direction, bsdf_pdf_omega, *hit);
        const Ray to_it{.origin = from.origin,
                        .direction = from.direction,
                        .far_m = hit->distance_m * shadow_reach,
                        .time = from.time};
        light *= light_past_others(scene, to_it, links, shadow_path_of(work, bounce, path), 0, work.memory);
        if (fog) light *= fog->transmittance(to_it, path.sample, hit->instance);
        sum += light;
        if (work.groups) work.groups->note(lane, scene.light_group_of(*hit), light);
    }
    return sum;
}

Vec3b world_met(const Work& work, const Vec3b& wi, const Batch& bsdf_pdf_omega, const WordBatch& ray_kind,
                std::uint32_t bounce) {
    const Environment& environment = work.scene.environment();
    Vec3b radiance = world_radiance(work.scene.world_view(), wi, ray_kind, bounce, work.memory.registers);
    if (work.scene.has_world_rules()) {
        const LightRules& rules = work.scene.world_rules();
        const WordBatch none(0u);
        radiance = select(equal(met_by(ray_kind) & WordBatch(rules.lights), none), Vec3b(Batch(0.0f)), radiance);
    }
    if (environment.is_dark() || work.settings.light_sampling == LightSampling::bsdf) return radiance;
    if (work.settings.light_sampling == LightSampling::light) return Vec3b(Batch(0.0f));
    // Past its own bounces the world is met as it is in Cycles, which weighs it beside a sample that it does not take.
    const bool is_sampled = bounce - 1 <= work.scene.world_rules().max_bounces;
    const auto samples = is_sampled ? static_cast<float>(WorldPlan::at(bounce - 1).candidates) : 1.0f;
    return radiance * balance(bsdf_pdf_omega, Batch(samples) * environment.pdf_omega(wi));
}

bool counts_where_it_is_met(const Scene& scene, const RayHit& hit, std::uint32_t instance) {
    const LightLinks& links = scene.links_of(hit.instance);
    return is_for(scene, links, instance) && !has_blockers_of_its_own(links);
}

}  // namespace pivot
