#include "core/integrators/monte_carlo.h"

#include <numeric>

#include "core/integrators/bounce_counts.h"
#include "core/integrators/direct_light.h"
#include "core/integrators/fog.h"
#include "core/integrators/met_light.h"
#include "core/integrators/path_batch.h"
#include "core/integrators/straight_paths.h"
#include "core/integrators/subsurface.h"

namespace pivot {
namespace {

/// Sorts paths by material, stably, by counting: what a batch's lanes have in common is done once for all.
void sort_by_material(Paths& paths, Paths& sorted, std::vector<std::uint32_t>& first_of) {
    for (const Path& path : paths) {
        if (path.arrival.material + 2 > first_of.size()) first_of.resize(path.arrival.material + 2);
        ++first_of[path.arrival.material + 1];
    }
    std::partial_sum(first_of.begin(), first_of.end(), first_of.begin());
    sorted.resize(paths.size());
    for (const Path& path : paths) sorted[first_of[path.arrival.material]++] = path;
    std::fill(first_of.begin(), first_of.end(), 0u);
    paths.swap(sorted);
}

/// A BSDF sample of each path: its ray, and what the path is worth along it.
struct Scattered {
    RayOf<Batch> rays;
    Vec3b throughput;
    Batch pdf_omega;
    BatchMask goes_on;  ///< elsewhere the sample is worth nothing, or not wanted
    WordBatch ray_kind;
    Batch u_roulette;
};

Scattered scatter(const BouncePlan& plan, const PathBatch& batch, const BatchMask& wanted) {
    const VertexBatch& vertices = batch.vertices;
    const Vec2b u_lobe = vertices.sampler.point(plan.dimensions.lobe());
    const Vec3b wi_local = sample(vertices.surface, u_lobe.x, vertices.sampler.point(plan.dimensions.direction()));
    const Vec3b wi = vertices.point.frame.to_world(wi_local);
    const Batch zero(0.0f), pdf = pdf_omega(vertices.surface, wi_local);
    const Vec3b throughput = batch.lanes.throughput * eval_sampled(vertices.surface, wi_local) / max(pdf, tiny<Batch>);
    const WordBatch ray_kind =
        select(samples_highlight(vertices.surface, u_lobe.x), WordBatch(glossy_ray), WordBatch(diffuse_ray)) |
        select(wi_local.z < zero, WordBatch(transmission_ray), WordBatch(0u));
    const BatchMask goes_on = wanted && pdf > zero && vertices.is_open_to(wi) && max_component(throughput) > zero;
    return {.rays = {.origin = vertices.point.ray_origin(wi),
                     .direction = wi,
                     .near_m = zero,
                     .far_m = select(goes_on, std::numeric_limits<Batch>::infinity(), zero),
                     .time = vertices.point.time},
            .throughput = throughput,
            .pdf_omega = pdf,
            .goes_on = goes_on,
            .ray_kind = ray_kind,
            .u_roulette = u_lobe.y};  // free: the first number chose the lobe
}

/// Follows a bounce's rays to what they meet: lights, the world, or the paths' next vertices.
void follow(const Work& work, Fog* fog, std::uint32_t bounce, const PathBatch& batch, const Scattered& scattered,
            const VertexLights& lights, const SharedLamps& shared, Paths& next) {
    const Scene& scene = work.scene;
    RayHitOf<Batch> hit = scene.intersect(scattered.rays, met_by(scattered.ray_kind));
    WordBatch ray_kind = scattered.ray_kind | (batch.lanes.arrival.ray_kind & WordBatch(~ray_kinds));
    const Batch spread = batch.lanes.spread + spread_of_sample(work.settings, scattered.pdf_omega);
    BatchWays straight;
    if (scene.has_transparency()) straight = go_on(work, bounce, batch.paths, scattered.rays, spread, hit, ray_kind);
    const auto way_of = [&](std::size_t i, const Arrival& arrival) {
        if (!straight.ways.empty()) return straight.ways[i];
        return WayOn{{}, arrival.hit.instance == no_instance ? std::nullopt : std::optional(arrival.hit)};
    };
    std::array<Path, batch_size> paths =
        unpack<PathOf>({.arrival = {.direction = scattered.rays.direction,
                                    .hit = hit,
                                    .material = batch.lanes.arrival.material,
                                    .footprint_m = batch.lanes.arrival.footprint_m + spread * hit.distance_m,
                                    .ray_kind = ray_kind},
                        .throughput = scattered.throughput,
                        .spread = spread,
                        .emission_weight = Batch(1.0f),
                        .sample = batch.lanes.sample,
                        .bounces = batch.lanes.bounces});
    if (work.settings.bounce_limits != BounceLimits{}) {
        std::array<std::uint32_t, batch_size> kinds;
        scattered.ray_kind.store_unaligned(kinds.data());
        for (std::size_t i = 0; i < batch_size; ++i)
            paths[i].bounces = counted_ray(paths[i].bounces, work.settings.bounce_limits, kinds[i]);
    }
    const BatchMask is_lost = equal(hit.instance, WordBatch(no_instance));
    Vec3b sky(Batch(0.0f));
    if (scene.has_world() && any(is_lost))
        sky =
            select(is_lost, world_met(work, scattered.rays.direction, scattered.pdf_omega, ray_kind, bounce + 1), sky);
    const auto goes_on = store(scattered.goes_on);
    const bool is_weakened = fog || scene.has_transparency();
    const auto note = [&](std::size_t i, std::uint32_t group, const Rgb& light, const Rgb& share) {
        if (work.groups) work.groups->note(i, group, light * share);
    };
    std::array<Ray, batch_size> rays_of_lanes;
    std::array<std::uint32_t, batch_size> kinds_of_lanes;
    if (scene.has_blockers()) rays_of_lanes = unpack<RayOf>(scattered.rays);
    scattered.ray_kind.store_unaligned(kinds_of_lanes.data());
    const Lanes sky_r = store(sky.x), sky_g = store(sky.y), sky_b = store(sky.z);
    std::array<Rgb, batch_size> left, lamps;  // what is left on the way, and of lamps on it, where it is weakened
    if (is_weakened) {
        const std::array<Ray, batch_size> rays = unpack<RayOf>(scattered.rays);
        for (std::size_t i = 0; i < batch_size; ++i) {
            left[i] = Rgb(1.0f), lamps[i] = Rgb(0.0f);
            if (i >= batch.paths.size() || !goes_on[i]) continue;
            Path before = paths[i];
            before.arrival.footprint_m = store(batch.lanes.arrival.footprint_m)[i];
            const WayOn way = way_of(i, paths[i].arrival);
            left[i] = fog ? fog->cross(rays[i], way, bounce + 1, before) : way.worth();
            paths[i].throughput *= left[i];
        }
    }
    const Lanes pdf_omega = store(scattered.pdf_omega), u_roulette = store(scattered.u_roulette);
    const Lanes survival = store(min(max_component(scattered.throughput), Batch(max_roulette_survival)));
    Lanes r{}, g{}, b{};
    for (std::size_t i = 0; i < batch.paths.size(); ++i) {
        if (!goes_on[i]) continue;
        Path path = paths[i];
        if (!work.min_pdf_omega.empty()) {
            float& min_pdf_omega = work.min_pdf_omega[path.sample];
            min_pdf_omega = std::min(min_pdf_omega, pdf_omega[i]);
        }
        Arrival& arrival = path.arrival;
        const bool is_met = arrival.hit.instance != no_instance;
        const Rgb left_of_it = is_weakened ? left[i] : Rgb(1.0f);
        if (!is_met) note(i, scene.world_light_group(), {sky_r[i], sky_g[i], sky_b[i]}, left_of_it);
        Rgb light(0.0f);
        if (!shared.at(i).empty())
            (is_weakened ? lamps[i] : light) =
                lamps_met(work, fog, bounce, shared.at(i), batch.vertices.lane(i), arrival.direction, pdf_omega[i],
                          way_of(i, arrival), batch.paths[i], i);
        if (scene.has_blockers())
            (is_weakened ? lamps[i] : light) +=
                shining_past_others_met(work, fog, bounce, batch.paths[i], batch.vertices, lights, i, rays_of_lanes[i],
                                        kinds_of_lanes[i], pdf_omega[i]);
        bool shines_by_program = false;
        if (is_met) {
            arrival.material = scene.material_of(arrival.hit);
            const Shader& shader = scene.shaders()[arrival.material];
            shines_by_program = shader.has_varying_emission();
            if (shader.is_emissive()) {
                path.emission_weight = scene.has_links() && !counts_where_it_is_met(scene, arrival.hit,
                                                                                    batch.paths[i].arrival.hit.instance)
                                           ? 0.0f
                                           : emission_weight(work, bounce, batch.vertices, lights, i, arrival.direction,
                                                             pdf_omega[i], arrival.hit);
                if (!shines_by_program) {
                    const Rgb met = path.emission_weight * shader.constants.emission;
                    light += met;
                    note(i, scene.light_group_of(arrival.hit), met, left_of_it);
                }
            }
        }
        r[i] = light.x, g[i] = light.y, b[i] = light.z;
        if (!(max_component(path.throughput) > 0.0f)) continue;
        // What shines by its program tells how much when its own batch is shaded.
        const bool is_last = bounce == work.settings.max_bounces || (path.bounces & path_ends);
        if (!is_met || (is_last && !shines_by_program)) continue;
        if (scene.has_transparency() && straight.ways[i].only_shines()) continue;
        if (bounce >= first_roulette_bounce) {
            if (u_roulette[i] >= survival[i]) continue;
            path.throughput /= survival[i];
        }
        if (!work.is_diffused.empty() && (path.arrival.ray_kind & diffuse_ray)) work.is_diffused[path.sample] = 1;
        next.push_back(path);
    }
    Vec3b light = sky + Vec3b(load(r), load(g), load(b));
    if (is_weakened)
        light = light * gather_vector([&](std::size_t i) { return left[i]; }) +
                gather_vector([&](std::size_t i) { return lamps[i]; });
    const Vec3b black(Batch(0.0f));
    add_light(work, bounce, batch, select(scattered.goes_on, scattered.throughput, black),
              select(scattered.goes_on, light, black));
}

/// Traces a batch of paths from their vertices on, as many as it says: what light they bring there, and where they go
/// next, or come out from beneath.
std::size_t trace_bounce(const Work& work, Fog* fog, const BouncePlan& plan, Vertices kind, std::span<const Path> paths,
                         Paths& next, Paths& exits) {
    const std::uint32_t bounce = plan.bounce;
    PathBatch batch = make_batch(work, bounce, paths, kind);
    const std::size_t count = batch.paths.size();
    if (kind == Vertices::exits) {
        // What shines there was seen from outside, if at all.
    } else if (bounce == 0)
        see_first_hits(work, batch);
    else if (work.scene.shaders()[paths[0].arrival.material].has_varying_emission()) {
        const Vec3b met = batch.emission * batch.lanes.emission_weight;
        if (work.groups)
            work.groups->note(met, [&](std::size_t i) {
                return i < count ? work.scene.light_group_of(batch.paths[i].arrival.hit) : no_light_group;
            });
        add_light(work, bounce - 1, batch, batch.lanes.throughput, met);
    }
    if (!work.feature_worths.empty()) see_features(work, bounce, batch);
    if (bounce > work.settings.max_bounces) return count;
    if (work.settings.bounce_limits != BounceLimits{}) {
        const BatchMask ends = !equal(batch.lanes.bounces & WordBatch(path_ends), WordBatch(0u));
        batch.lanes.throughput = select(ends, Vec3b(Batch(0.0f)), batch.lanes.throughput);
    }
    const VertexLights lights(work.scene, plan, batch.vertices);
    SharedLamps shared;
    const ShadowPath shadow_path{work.settings.max_passages, bounce, batch.lanes.arrival.ray_kind,
                                 batch.lanes.arrival.hit.instance};
    const bool tells_shares = bounce == 0 && !work.passes.empty();
    LightSharesOf<Batch> shares;
    const Vec3b direct = direct_light(work.scene, work.settings.light_sampling, plan, batch.vertices, lights, shared,
                                      shadow_path, work.memory, tells_shares ? &shares : nullptr, work.groups);
    if (tells_shares) set_pass_shares(work, batch, shares);
    add_light(work, bounce, batch, batch.lanes.throughput, direct);
    // The last rays are for light that is sampled by BSDF samples alone, or by both.
    BatchMask is_wanted = batch.vertices.is_vertex();
    if (kind == Vertices::arrivals && !work.is_diffused.empty())
        is_wanted = is_wanted && !walk_beneath(work, plan, batch.paths, batch.vertices,
                                               batch.vertices.sampler.point(plan.dimensions.lobe()).x, exits);
    if (bounce == work.settings.max_bounces && !work.scene.has_unsampled_light())
        is_wanted =
            is_wanted && gather([&](std::size_t i) { return shared.at(i).empty() ? 0.0f : 1.0f; }) > Batch(0.0f);
    if (!any(is_wanted)) return count;
    const Scattered scattered = scatter(plan, batch, is_wanted);
    if (tells_shares)
        set_pass_shares(
            work, batch,
            light_shares(batch.vertices.surface, batch.vertices.point.frame.to_local(scattered.rays.direction)));
    if (any(scattered.goes_on)) follow(work, fog, bounce, batch, scattered, lights, shared, next);
    return count;
}

}  // namespace

void trace_paths(const Scene& scene, const RenderSettings& settings, std::span<const Ray> camera_rays,
                 std::span<const Sampler> samplers, std::span<Sample> samples, std::span<SurfacePasses> passes,
                 std::span<Rgb> named) {
    // Where there are media, paths that first scatter in them have samples of their own behind the others.
    const bool has_media = !scene.media().is_empty();
    const std::size_t count = samples.size();
    std::vector<Sample> own_samples(has_media ? 2 * count : 0);
    std::vector<Sampler> own_samplers;
    if (has_media) {
        own_samplers.assign(samplers.begin(), samplers.end());
        own_samplers.insert(own_samplers.end(), samplers.begin(), samplers.end());
    }
    std::ranges::fill(samples, Sample{});
    ProgramMemory memory;
    std::vector<float> min_pdf_omega(settings.filter_glossy > 0.0f ? (has_media ? 2 : 1) * count : 0,
                                     std::numeric_limits<float>::infinity());
    std::vector<std::uint8_t> is_diffused(scene.inner_rays().is_empty() ? 0 : (has_media ? 2 : 1) * count);
    std::vector<PassShares> pass_shares(passes.size());
    std::vector<Rgb> feature_worths(settings.denoising_passes ? (has_media ? 2 : 1) * count : 0, Rgb(1.0f));
    std::vector<Rgb> own_named(has_media ? 2 * named.size() : 0, Rgb(0.0f));
    std::optional<GroupLight> groups;
    if (settings.light_groups > 0)
        groups.emplace(settings.light_groups, settings.named_passes(), has_media ? std::span<Rgb>(own_named) : named);
    const Work work{scene,
                    settings,
                    has_media ? std::span<const Sampler>(own_samplers) : samplers,
                    has_media ? std::span<Sample>(own_samples) : samples,
                    memory,
                    min_pdf_omega,
                    is_diffused,
                    passes,
                    pass_shares,
                    feature_worths,
                    groups ? &*groups : nullptr};
    std::optional<Fog> in_media;
    if (has_media) in_media.emplace(work, static_cast<std::uint32_t>(count));
    Fog* fog = in_media ? &*in_media : nullptr;
    Paths paths, next, exits;
    std::vector<std::uint32_t> material_counts;
    start_paths(work, fog, camera_rays, paths);
    for (std::uint32_t bounce = 0; !paths.empty() || (fog && fog->has_paths()); ++bounce) {
        sort_by_material(paths, next, material_counts);
        next.clear();
        if (fog) fog->scatter(bounce, next);
        const BouncePlan plan = plan_bounce(scene, bounce);
        for (std::span<const Path> left(paths); !left.empty();)
            left = left.subspan(trace_bounce(work, fog, plan, Vertices::arrivals, left, next, exits));
        if (!exits.empty()) {
            sort_by_material(exits, paths, material_counts);
            const BouncePlan beneath = plan_exits(plan);
            for (std::span<const Path> left(exits); !left.empty();)
                left = left.subspan(trace_bounce(work, fog, beneath, Vertices::exits, left, next, exits));
            exits.clear();
        }
        paths.swap(next);
    }
    if (!fog) return;
    fog->finish();
    for (std::size_t i = 0; i < count; ++i) {
        const Sample& scattered = own_samples[count + i];
        samples[i] = own_samples[i];
        samples[i].radiance += scattered.radiance;
        samples[i].indirect += scattered.indirect;
        samples[i].volume_direct += scattered.volume_direct;
        samples[i].volume_indirect = scattered.radiance - scattered.volume_direct;
    }
    for (std::size_t k = 0; groups && k < named.size(); ++k) named[k] += own_named[k] + own_named[named.size() + k];
}

}  // namespace pivot
