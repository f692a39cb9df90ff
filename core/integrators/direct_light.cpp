#include "core/integrators/direct_light.h"

#include <algorithm>

#include "core/integrators/light_sampler.h"
#include "core/integrators/lit_share.h"
#include "core/integrators/media_ray.h"
#include "core/integrators/world_sampling.h"

namespace pivot {
namespace {

/// How far a light sample's shadow ray goes.
float reach_m(const Light& light, const SurfacePoint& point, const LightPoint& place) {
    const auto* area = std::get_if<AreaLight>(&light);
    const float error_m = area ? surface_error_m(*area) : 0.0f;
    if (error_m == 0.0f) return place.distance_m * shadow_reach;
    return place.distance_m * shadow_reach - (error_m + point.error_m) / std::abs(dot(place.wi, area->normal));
}

/// A light sample of one vertex, and whether BSDF samples share.
struct SharedSample {
    LightSample sample{Vec3f(0.0f), Vec3f(0.0f), 0.0f};
    bool shares;
};
SharedSample sample_light_of(const Light& light, LightSampling strategy, const Vertex& vertex, const Vec2f& u,
                             float expected_samples) {
    const LightSampler sampler(light, vertex.point, vertex.surface, strategy);
    SharedSample result{.shares = sampler.shares_with_bsdf()};
    const auto place = sampler.sample(u);
    if (!place || !(place->pdf_omega > 0.0f) || !vertex.is_open_to(place->wi)) return result;
    const float pdf = expected_samples * place->pdf_omega;
    const Vec3f wi_local = vertex.point.frame.to_local(place->wi);
    const float weight = result.shares ? balance(pdf, pdf_omega(vertex.surface, wi_local)) : 1.0f;
    result.sample = {weight * eval(vertex.surface, wi_local) * place->radiance / pdf, place->wi,
                     reach_m(light, vertex.point, *place)};
    return result;
}

/// Has the lights that move stand where they are at the vertices' times. moved: what they then are.
void move_lights(const Scene& scene, const VertexBatch& vertices, const LightPicks& picks, std::vector<Light>& moved,
                 std::array<const Light*, batch_size>& lights) {
    moved.reserve(batch_size);
    const Lanes times = store(vertices.point.time);
    for (std::size_t i = 0; i < vertices.count(); ++i) {
        if (!scene.is_moving_light(picks.light[i])) continue;
        moved.push_back(scene.light_at(picks.light[i], times[i]));
        lights[i] = &moved.back();
    }
}

/// A sample by each vertex, of its own light; the lanes that the closed forms leave out, and those of surfaces whose
/// lobes read tables, are sampled one by one.
LightSampleOf<Batch> sample_lights(const Scene& scene, LightSampling strategy, std::uint32_t bounce,
                                   const VertexBatch& vertices, const LightPicks& picks, std::uint32_t dimension,
                                   SharedLamps& shared_lamps) {
    const Vec2b u = vertices.sampler.point(dimension);
    const std::size_t lamp_count = scene.lamps().size();
    LightSampleOf<Batch> samples{Vec3b(Batch(0.0f)), Vec3b(Batch(0.0f)), Batch(0.0f)};
    std::array<const Light*, batch_size> lights;
    for (std::size_t i = 0; i < batch_size; ++i)
        lights[i] = &scene.light(picks.light[std::min(i, vertices.count() - 1)]);
    std::vector<Light> moved;
    if (scene.moves()) move_lights(scene, vertices, picks, moved, lights);
    const Batch expected = load(picks.expected_samples);
    BatchMask left = expected > Batch(0.0f) && vertices.is_vertex();
    // BSDF samples that meet emissive meshes count whatever is there.
    const auto share = [&](std::size_t i) {
        if (picks.light[i] < lamp_count) shared_lamps.add(i, {picks.light[i], picks.expected_samples[i]});
    };
    const auto sample_kind = [&](const BatchMask& is_kind, const auto& sample_lanes) {
        const BatchMask chosen = left && is_kind;
        if (!any(chosen)) return;
        std::array<const Light*, batch_size> of_kind = lights;
        if (any(!chosen)) {
            // Of lanes of another kind, the batch computes what nobody reads.
            const auto is_chosen = store(chosen);
            const auto first = std::ranges::find(is_chosen, true) - is_chosen.begin();
            for (std::size_t i = 0; i < batch_size; ++i)
                if (!is_chosen[i]) of_kind[i] = lights[static_cast<std::size_t>(first)];
        }
        const LaneSamples lit = sample_lanes(vertices, of_kind, u);
        const BatchMask sampled = lit.valid && chosen;
        Batch weight = Batch(1.0f) / expected;
        if (const BatchMask shared = sampled && lit.needs_bsdf; any(shared)) {
            const Batch other = pdf_omega(vertices.surface, vertices.point.frame.to_local(lit.sample.wi));
            weight *= select(shared, balance(expected * lit.pdf_omega, other), Batch(1.0f));
            const auto flags = store(shared);
            for (std::size_t i = 0; i < vertices.count(); ++i)
                if (flags[i]) share(i);
        }
        samples = {select(sampled, lit.sample.radiance * weight, samples.radiance),
                   select(sampled, lit.sample.wi, samples.wi), select(sampled, lit.sample.reach_m, samples.reach_m)};
        left = left && !sampled;
    };
    if (strategy == LightSampling::joint) {
        BatchMask is_area = gather([&](std::size_t i) {
                                return std::holds_alternative<AreaLight>(*lights[i]) ? 1.0f : 0.0f;
                            }) > Batch(0.0f);
        const BatchMask is_plain = is_like_base(vertices.surface);
        sample_kind(!is_area && is_plain, sample_cap_lights);
        if (any(!is_plain)) {
            const BatchMask is_known = has_common_highlights(vertices.surface);
            sample_kind(!is_area && !is_plain && is_known, sample_cap_lights_by_lobes);
            is_area = is_area && is_known;
        }
        sample_kind(is_area,
                    [&](const VertexBatch& all, const std::array<const Light*, batch_size>& of_kind,
                        const Vec2b& u_place) { return sample_area_lights(all, of_kind, u_place, bounce == 0); });
    }
    if (!any(left)) return samples;
    const auto is_left = store(left);
    std::array<LightSample, batch_size> each = unpack<LightSampleOf>(samples);
    const Lanes u_x = store(u.x), u_y = store(u.y);
    for (std::size_t i = 0; i < vertices.count(); ++i) {
        if (!is_left[i]) continue;
        const SharedSample one = sample_light_of(*lights[i], strategy_at(bounce, *lights[i], strategy),
                                                 vertices.lane(i), {u_x[i], u_y[i]}, picks.expected_samples[i]);
        each[i] = one.sample;
        if (one.shares) share(i);
    }
    std::array<const LightSample*, batch_size> lanes;
    for (std::size_t i = 0; i < batch_size; ++i) lanes[i] = &each[i];
    return pack<LightSampleOf>(lanes);
}

/// The ray that a light sample of a triangle stands for, where that is met, a bounce on.
Arrival arrival_at(const Scene& scene, const SceneTriangle& triangle, const AreaLight& light, const Vec3f& origin,
                   const Vec3f& wi, float time) {
    const float distance_m = dot(light.center - origin, light.normal) / dot(wi, light.normal);
    const Vec2f place = area_coordinates(light, origin + distance_m * wi);
    const RayHit hit{.distance_m = distance_m,
                     .instance = triangle.instance,
                     .triangle = triangle.triangle,
                     .barycentric = barycentric_in_triangle(place),
                     .time = time};
    return {
        .direction = wi, .hit = hit, .material = scene.material_of(hit), .footprint_m = 0.0f, .ray_kind = diffuse_ray};
}

/// Makes what samples bring of lights that vary what these shine where they are sampled. They were taken for grey.
void shade_lights(const Scene& scene, const BouncePlan& plan, const VertexBatch& vertices, const LightPicks& picks,
                  LightSampleOf<Batch>& samples, ProgramMemory& memory) {
    std::array<Arrival, batch_size> arrivals;
    std::array<const Arrival*, batch_size> in_turn;
    std::array<std::size_t, batch_size> lane_of;
    std::size_t count = 0;
    const Lanes brought = store(max_component(abs(samples.radiance)));
    const std::array<LightSample, batch_size> each = unpack<LightSampleOf>(samples);
    const Vec3b& from = vertices.point.position;
    const Lanes x = store(from.x), y = store(from.y), z = store(from.z), times = store(vertices.point.time);
    for (std::size_t i = 0; i < vertices.count(); ++i) {
        const auto triangle = brought[i] > 0.0f ? scene.varying_triangle(picks.light[i]) : std::nullopt;
        if (!triangle) continue;
        const Light light = scene.light_at(picks.light[i], times[i]);
        arrivals[count] =
            arrival_at(scene, *triangle, std::get<AreaLight>(light), {x[i], y[i], z[i]}, each[i].wi, times[i]);
        in_turn[count] = &arrivals[count];
        lane_of[count++] = i;
    }
    if (count == 0) return;
    Lanes r, g, b;
    r.fill(1.0f), g.fill(1.0f), b.fill(1.0f);
    for (std::size_t first = 0; first < count;) {
        const std::span<const Arrival* const> left = std::span(in_turn).subspan(first, count - first);
        const std::size_t together = batch_count(scene, left);
        const Vec3b emission = make_arrivals(scene, left.first(together), plan.bounce + 1, memory).material.emission;
        const Lanes red = store(emission.x), green = store(emission.y), blue = store(emission.z);
        for (std::size_t k = 0; k < together; ++k) {
            const std::size_t lane = lane_of[first + k];
            const float grey = std::get<AreaLight>(scene.light(picks.light[lane])).radiance.x;
            r[lane] = red[k] / grey, g[lane] = green[k] / grey, b[lane] = blue[k] / grey;
        }
        first += together;
    }
    samples.radiance = samples.radiance * Vec3b(load(r), load(g), load(b));
}

/// Leaves of samples of lamps what these lamps' own shaders say.
void shade_lamps(const Scene& scene, const BouncePlan& plan, const VertexBatch& vertices, const LightPicks& picks,
                 LightSampleOf<Batch>& samples, Registers& registers) {
    const Lanes brought = store(max_component(abs(samples.radiance)));
    std::array<bool, batch_size> is_done{};
    for (std::size_t i = 0; i < vertices.count(); ++i) {
        const std::size_t place = picks.light[i];
        const Shader* shader = brought[i] > 0.0f && !is_done[i] ? scene.lamp_shader(place) : nullptr;
        if (!shader) continue;
        const Vec3b share = lamp_share({*shader, scene.camera_facts()}, scene.light(place), vertices.point.position,
                                       samples.wi, plan.bounce + 1, registers);
        const BatchMask is_of_it = gather([&](std::size_t k) {
                                       is_done[k] = is_done[k] || picks.light[k] == place;
                                       return picks.light[k] == place ? 1.0f : 0.0f;
                                   }) > Batch(0.5f);
        samples.radiance = select(is_of_it, samples.radiance * share, samples.radiance);
    }
}

/// Leaves of samples of the world what its rules say.
void obey_world_rules(const Scene& scene, std::uint32_t bounce, const VertexBatch& vertices,
                      LightSampleOf<Batch>& samples) {
    const Vec3b wi_local = vertices.point.frame.to_local(samples.wi);
    const Lanes x = store(wi_local.x), y = store(wi_local.y), z = store(wi_local.z);
    samples.radiance = samples.radiance * gather_vector([&](std::size_t i) {
                           if (i >= vertices.count() || bounce > scene.world_rules().max_bounces) return Rgb(0.0f);
                           return lit_share(scene.world_rules(), vertices.lane(i).surface, {x[i], y[i], z[i]});
                       });
}

/// Of a batch of shadow rays those to lights that have blockers of their own, and what is left along them.
struct PastOthers {
    BatchMask is_asked = BatchMask(false);
    Vec3b left = Vec3b(Batch(0.0f));
};
PastOthers light_past_others(const Scene& scene, const RayOf<Batch>& rays, const LightPicks& picks,
                             const ShadowPath& path, ProgramMemory& memory) {
    const std::array<Ray, batch_size> each = unpack<RayOf>(rays);
    Lanes is_asked{};
    const Vec3b left = gather_vector([&](std::size_t i) {
        if (!(each[i].far_m > 0.0f)) return Rgb(0.0f);
        const LightLinks& links = scene.rules_of(picks.light[i]).links;
        if (!has_blockers_of_its_own(links)) return Rgb(0.0f);
        is_asked[i] = 1.0f;
        return pivot::light_past_others(scene, each[i], links, path, i, memory);
    });
    return {load(is_asked) > Batch(0.5f), left};
}

/// Calls visit(LightSampleOf<Batch>, shadow rays, BatchMask, LightPicks) with each round of the vertices' light
/// samples; the mask: whose light comes through what is in its way; the picks: null, the world's.
template <class Visit>
void for_each_sample(const Scene& scene, LightSampling strategy, const BouncePlan& plan, const VertexBatch& vertices,
                     const WordBatch& instances, const VertexLights& lights, SharedLamps& shared_lamps,
                     ProgramMemory& memory, const Visit& visit) {
    const auto visit_with_rays = [&](const LightSampleOf<Batch>& samples, const BatchMask& is_open,
                                     const LightPicks* of_lights) {
        const BatchMask adds = max_component(abs(samples.radiance)) > Batch(0.0f) && vertices.is_vertex();
        visit(samples,
              RayOf<Batch>{.origin = vertices.point.ray_origin(samples.wi),
                           .direction = samples.wi,
                           .near_m = Batch(0.0f),
                           .far_m = select(adds, samples.reach_m, Batch(0.0f)),
                           .time = vertices.point.time},
              is_open, of_lights);
    };
    const BatchMask none(false);
    if (!scene.environment().is_dark() && strategy != LightSampling::bsdf) {
        const WorldSampler world(scene, strategy, plan, vertices);
        for (std::uint32_t k = 0; k < world.rays(); ++k) {
            LightSampleOf<Batch> samples = world.sample(k, memory.registers);
            if (scene.has_world_rules()) obey_world_rules(scene, plan.bounce, vertices, samples);
            visit_with_rays(samples, none, nullptr);
        }
    }
    const std::span<const LightPicks> picks = lights.picks();
    for (std::size_t k = 0; k < picks.size(); ++k) {
        const std::size_t place = k < plan.lamp_samples ? k : max_lamp_samples + k - plan.lamp_samples;
        LightSampleOf<Batch> samples = sample_lights(scene, strategy, plan.bounce, vertices, picks[k],
                                                     plan.dimensions.light_place(place), shared_lamps);
        if (scene.has_varying_lights()) shade_lights(scene, plan, vertices, picks[k], samples, memory);
        if (scene.has_shaded_lamps()) shade_lamps(scene, plan, vertices, picks[k], samples, memory.registers);
        visit_with_rays(
            samples,
            scene.has_light_rules() ? obey_rules(scene, plan.bounce, vertices, instances, picks[k], samples) : none,
            &picks[k]);
    }
}

}  // namespace

Vec3b direct_light(const Scene& scene, LightSampling strategy, const BouncePlan& plan, const VertexBatch& vertices,
                   const VertexLights& lights, SharedLamps& shared_lamps, const ShadowPath& shadow_path,
                   ProgramMemory& memory, LightSharesOf<Batch>* shares, GroupLight* groups) {
    const Batch zero(0.0f);
    const Vec3b black(zero);
    Vec3b radiance(black);
    const auto add = [&](const Vec3b& light, const Vec3b& wi, const LightPicks* picks) {
        radiance += light;
        if (groups)
            groups->note(light, [&](std::size_t lane) {
                return picks ? scene.light_group_of(picks->light[lane]) : scene.world_light_group();
            });
        if (!shares) return;
        const auto of_sample = light_shares(vertices.surface, vertices.point.frame.to_local(wi));
        shares->diffuse += light * of_sample.diffuse;
        shares->glossy += light * of_sample.glossy;
    };
    for_each_sample(
        scene, strategy, plan, vertices, shadow_path.instance, lights, shared_lamps, memory,
        [&](const LightSampleOf<Batch>& samples, const RayOf<Batch>& all_rays, const BatchMask& is_open,
            const LightPicks* picks) {
            RayOf<Batch> rays = all_rays;
            if (any(is_open)) {
                add(select(is_open && rays.far_m > zero, samples.radiance, black), samples.wi, picks);
                rays.far_m = select(is_open, zero, rays.far_m);
            }
            PastOthers past;
            if (picks && scene.has_blockers()) {
                past = light_past_others(scene, rays, *picks, shadow_path, memory);
                rays.far_m = select(past.is_asked, zero, rays.far_m);
            }
            const Batch visible = scene.visibility(rays);
            // Where no ray is, there is nothing to add.
            Vec3b light = select(rays.far_m > zero, samples.radiance * visible, black);
            RayOf<Batch> seen = rays;
            seen.far_m = select(visible > zero, rays.far_m, zero);
            if (scene.has_transparency()) light = light * light_through(scene, seen, shadow_path, memory);
            if (any(past.is_asked)) {
                light = select(past.is_asked, samples.radiance * past.left, light);
                seen.far_m = select(past.is_asked && max_component(past.left) > zero, all_rays.far_m, seen.far_m);
            }
            if (!scene.media().is_empty()) {
                light = light * transmittance(scene.media(), seen, stream_seed(vertices.sampler, plan.dimensions.base));
            }
            add(light, samples.wi, picks);
        });
    if (!shares) return radiance;
    const auto share_of = [&](const Vec3b& part) {
        const auto of = [&](const Batch& x, const Batch& all) {
            return select(all != zero, x / select(all != zero, all, Batch(1.0f)), zero);
        };
        return Vec3b(of(part.x, radiance.x), of(part.y, radiance.y), of(part.z, radiance.z));
    };
    *shares = {share_of(shares->diffuse), share_of(shares->glossy)};
    return radiance;
}

std::vector<LightSample> light_samples_of(const Scene& scene, LightSampling strategy, const BouncePlan& plan,
                                          const VertexBatch& vertices, const VertexLights& lights,
                                          SharedLamps& shared_lamps, ProgramMemory& memory) {
    std::vector<LightSample> result;
    for_each_sample(
        scene, strategy, plan, vertices, WordBatch(no_instance), lights, shared_lamps, memory,
        [&](const LightSampleOf<Batch>& samples, const RayOf<Batch>& rays, const BatchMask&, const LightPicks*) {
            const Lanes far_m = store(rays.far_m);
            const std::array<LightSample, batch_size> each = unpack<LightSampleOf>(samples);
            for (std::size_t i = 0; i < batch_size; ++i)
                if (far_m[i] > 0.0f) result.push_back(each[i]);
        });
    return result;
}

}  // namespace pivot
