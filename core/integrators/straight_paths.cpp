#include "core/integrators/straight_paths.h"

#include "core/simd/pack.h"

namespace pivot {
namespace {

/// Where both parts bring less of a camera ray's light, only one of them is followed.
constexpr float least_part_of_camera = 1.0f / 16.0f;

}  // namespace

BatchWays go_on(const Work& work, std::uint32_t bounce, std::span<const Path> paths, const RayOf<Batch>& rays,
                const Batch& spread, RayHitOf<Batch>& hit, WordBatch& ray_kind) {
    const std::array<Ray, batch_size> each = unpack<RayOf>(rays);
    std::array<RayHit, batch_size> hits = unpack<RayHitOf>(hit);
    std::array<std::uint32_t, batch_size> kinds, met;
    ray_kind.store_unaligned(kinds.data());
    met_by(ray_kind).store_unaligned(met.data());
    const Lanes spreads = store(spread);
    std::vector<StraightRay> straight;
    std::vector<std::optional<RayHit>> first_hits;
    for (std::size_t i = 0; i < paths.size(); ++i) {
        first_hits.push_back(hits[i].instance == no_instance ? std::nullopt : std::optional(hits[i]));
        straight.push_back({each[i], first_hits[i], met[i], kinds[i], paths[i].arrival.footprint_m, spreads[i]});
    }
    const auto sample_of = [&](std::size_t i) { return paths[i].sample; };
    BatchWays found{.passages = find_passages(work.scene, work.settings.max_path_passages, straight, bounce + 1,
                                              chosen_by(work.samplers, bounce + 1, never_two, sample_of), work.memory),
                    .ways = {}};
    found.ways = ways_on(found.passages, first_hits);
    constexpr RayHit none{std::numeric_limits<float>::infinity(), no_instance, 0, Vec2f(0.0f)};
    std::array<const RayHit*, batch_size> lanes;
    for (std::size_t i = 0; i < batch_size; ++i) {
        const WayOn* way = i < found.ways.size() ? &found.ways[i] : nullptr;
        hits[i] = way ? way->hit.value_or(none) : none;
        if (way) kinds[i] = way->ray_kind(kinds[i]);
        lanes[i] = &hits[i];
    }
    hit = pack<RayHitOf>(lanes);
    ray_kind = WordBatch::load_unaligned(kinds.data());
    return found;
}

void start_paths(const Work& work, Fog* fog, std::span<const Ray> camera_rays, Paths& paths) {
    const Scene& scene = work.scene;
    std::vector<std::optional<RayHit>> hits(camera_rays.size());
    scene.intersect(camera_rays, visible_to_camera, hits);
    const PixelWidth width = scene.camera().pixel_width() * part_of_pixel(work.settings);
    // Passes keep what is shown for one path of a sample.
    const float least_part = work.passes.empty() ? least_part_of_camera : never_two;
    const std::vector<Passage> passages =
        find_passages(scene, work.settings.max_path_passages, straight_rays(camera_rays, hits, width), 0,
                      chosen_by(work.samplers, 0, least_part, std::identity()), work.memory);
    std::span<const Passage> left = passages;
    for (std::size_t i = 0; i < camera_rays.size(); ++i) {
        Sample& sample = work.samples[i];
        if (!work.passes.empty() && !work.settings.transparent_film) work.passes[i].environment = Rgb(0.0f);
        Path path{.arrival = {.direction = camera_rays[i].direction,
                              .hit = {},
                              .material = 0,
                              .footprint_m = width.at(0.0f),
                              .ray_kind = camera_ray},
                  .throughput = Rgb(1.0f),
                  .spread = width.per_m,
                  .emission_weight = 1.0f,
                  .sample = static_cast<std::uint32_t>(i)};
        float from_m = camera_rays[i].near_m;  // what is clipped of media, too, is not there
        std::uint32_t part = 0;
        const auto cross_to = [&](float distance_m) {
            path.arrival.footprint_m = width.at(from_m);
            if (fog) path.throughput *= fog->cross(part_of(camera_rays[i], from_m, distance_m), 0, path, part++);
            from_m = distance_m;
        };
        const auto show = [&](const RayHit& hit, std::uint32_t material, float opacity, float shown) {
            if (scene.has_holdouts() && scene.is_holdout(hit)) {
                if (work.settings.transparent_film) sample.alpha -= mean_component(path.throughput) * opacity * shown;
                return;
            }
            path.arrival.hit = hit;
            path.arrival.material = material;
            path.arrival.footprint_m = width.at(hit.distance_m);
            paths.push_back(path);
            paths.back().throughput *= shown;
        };
        const std::span<const Passage> way = take_passages(left, i);
        const Passage* told = told_of(way);
        for (const Passage& passage : way) {
            cross_to(passage.hit.distance_m);
            path.arrival.ray_kind = passage.ray_kind;
            if (passage.only_shines) {
                const Rgb emitted = path.throughput * scene.shaders()[passage.material].constants.emission;
                sample.radiance += emitted;
                sample.emission += emitted;
                add_to_group(work, i, scene.light_group_of(passage.hit), emitted);
            } else if (passage.shown > 0.0f) {
                path.emission_weight = &passage == told ? 1.0f : 0.0f;
                show(passage.hit, passage.material, passage.opacity, passage.shown);
            }
            path.throughput *= passage.passed;
        }
        if (ends(way)) continue;
        cross_to(camera_rays[i].far_m);
        if (work.settings.transparent_film) {
            sample.alpha -= std::min(mean_component(path.throughput), 1.0f);
            continue;
        }
        const Rgb sky = path.throughput * world_radiance(scene.world_view(), camera_rays[i].direction, camera_ray, 0,
                                                         work.memory.registers);
        sample.radiance += sky;
        add_to_group(work, i, scene.world_light_group(), sky);
        if (!work.passes.empty()) work.passes[i].environment = sky;
    }
}

}  // namespace pivot
