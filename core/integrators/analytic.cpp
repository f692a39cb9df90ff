#include "core/integrators/analytic.h"

#include "core/integrators/analytic_fog.h"
#include "core/integrators/arrival.h"
#include "core/integrators/gathered_light.h"
#include "core/integrators/lit_share.h"
#include "core/integrators/look_rays.h"
#include "core/integrators/shown_surfaces.h"
#include "core/simd/pack.h"

namespace pivot {
namespace {

/// Appends the surfaces of a batch of those shown, and tells the passes of them. batch_of: their arrivals.
void see(const Scene& scene, std::uint32_t bounce, std::span<const Arrival* const> batch_of,
         std::span<const Shown> shown, ProgramMemory& memory, std::vector<LookedAt>& surfaces,
         std::span<Sample> samples, GroupLight* groups) {
    const ArrivalBatch batch = make_arrivals(scene, batch_of, bounce, memory);
    const auto points = unpack<SurfacePointOf>(batch.point);
    SurfaceOf<Batch> surface = make_surface(batch.material, batch.point.wo_local);
    surface.bump = batch.bump;
    const auto seen = unpack<SurfaceOf>(surface);
    const auto materials = unpack<MaterialOf>(batch.material);
    for (std::size_t i = 0; i < batch_of.size(); ++i) {
        const Shown& one = shown[i];
        Sample& sample = samples[one.sample];
        const bool shines = is_for(scene, scene.links_of(one.arrival.hit.instance), one.from);
        const Rgb emitted = shines ? one.worth * materials[i].emission : Rgb(0.0f);
        add_light(emitted, one.is_spread, sample);
        if (groups) groups->add(one.sample, scene.light_group_of(one.arrival.hit), emitted);
        if (bounce == 0) sample.emission += emitted;
        if (one.is_told) {
            sample.normal = points[i].frame.z;
            sample.albedo = diffuse_color(seen[i]);
        }
        if (!one.only_shines)
            surfaces.push_back({one.arrival, one.sample, one.worth, one.spread, one.is_spread, points[i], seen[i]});
    }
}

/// The surfaces that rays show.
std::vector<LookedAt> look_at(const Scene& scene, const RenderSettings& settings, std::uint32_t bounce,
                              std::span<const LookRay> rays, std::span<const std::optional<RayHit>> hits,
                              ProgramMemory& memory, std::span<Sample> samples, GroupLight* groups) {
    std::vector<Shown> shown = shown_surfaces(scene, settings, bounce, rays, hits, memory, samples, groups);
    if (bounce > settings.max_bounces)
        for (Shown& one : shown) one.only_shines = true;
    // A program runs for one material.
    std::ranges::stable_sort(shown, {}, [&](const Shown& s) {
        return scene.shaders()[s.arrival.material].is_constant() ? 0 : s.arrival.material + 1;
    });
    std::vector<LookedAt> surfaces;
    surfaces.reserve(shown.size());
    const auto arrival_of = [](const Shown& s) -> const Arrival& { return s.arrival; };
    for_each_arrival_batch<Shown>(scene, shown, arrival_of,
                                  [&](std::span<const Arrival* const> batch, std::span<const Shown> of_batch) {
                                      see(scene, bounce, batch, of_batch, memory, surfaces, samples, groups);
                                  });
    return surfaces;
}

/// Adds what media bring along rays, and takes from what the rays are worth behind them.
void cross_media(const Scene& scene, const RenderSettings& settings, const AnalyticLights& lights, std::uint32_t bounce,
                 const ShadowPoints& points, std::span<const std::optional<RayHit>> hits, std::span<LookRay> rays,
                 std::span<Sample> samples, GroupLight* groups) {
    MediaRay media_ray(scene.media());
    for (std::size_t i = 0; i < rays.size(); ++i) {
        LookRay& look = rays[i];
        const float far_m = hits[i] ? hits[i]->distance_m : look.ray.far_m;
        media_ray.follow(part_of(look.ray, look.ray.near_m, far_m), nullptr);  // what is clipped of media is not there
        OnFogLight on_light;
        if (groups)
            on_light = [&](std::uint32_t group, const Rgb& light) {
                groups->add(look.sample, group, look.worth * light);
            };
        const FogLight fog = scatter_analytic(scene, settings, lights, bounce, points, media_ray, on_light);
        Sample& sample = samples[look.sample];
        const Rgb scattered = look.worth * fog.scattered, emitted = look.worth * fog.emitted;
        const float weight = mean_component(look.worth);
        add_light(scattered + emitted, look.is_spread, sample);
        if (bounce == 0) {
            sample.emission += emitted;
            sample.volume_direct += scattered;
        } else {
            sample.indirect += scattered;
        }
        sample.error += weight * fog.error;
        sample.shadow_variance += sqr(weight) * fog.shadow_variance;
        look.worth *= media_ray.through();
    }
}

}  // namespace

void shade_analytic(const Scene& scene, const RenderSettings& settings, const AnalyticLights& lights,
                    std::span<const Ray> camera_rays, std::span<const std::uint32_t> pixels, std::uint32_t sample_index,
                    std::span<SharedReflections> shared, std::span<Sample> samples, GroupLight* groups) {
    ProgramMemory memory;
    const ShadowPoints points(settings, sample_index);
    std::ranges::fill(samples, Sample{});
    std::vector<float> size(samples.size(), 0.0f);  // of the light of which `method` is the sum
    std::vector<LookRay> rays;
    rays.reserve(camera_rays.size());
    const PixelWidth width = scene.camera().pixel_width() * part_of_pixel(settings);
    for (std::size_t i = 0; i < camera_rays.size(); ++i)
        rays.push_back({.ray = camera_rays[i], .sample = i, .footprint_m = width.start_m, .spread = width.per_m});
    for (std::uint32_t bounce = 0; !rays.empty(); ++bounce) {
        std::vector<std::optional<RayHit>> hits(rays.size());
        std::vector<Ray> bare;
        std::vector<std::uint32_t> met;
        for (const LookRay& look : rays) bare.push_back(look.ray), met.push_back(met_by(look.ray_kind));
        scene.intersect(bare, met, hits);
        if (!scene.media().is_empty())
            cross_media(scene, settings, lights, bounce, points, hits, rays, samples, groups);
        const std::vector<LookedAt> surfaces = look_at(scene, settings, bounce, rays, hits, memory, samples, groups);
        const std::vector<Gathered> light =
            gather_light(scene, settings, lights, points, bounce, surfaces, pixels, sample_index, shared, groups);
        rays.clear();
        const Vec2f u = points.facet_point(bounce);
        for (std::size_t i = 0; i < surfaces.size(); ++i) {
            const LookedAt& surface = surfaces[i];
            const Gathered& gathered = light[i];
            Sample& sample = samples[surface.sample];
            const float weight = mean_component(surface.worth);
            const Rgb reflected = surface.worth * gathered.radiance;
            add_light(reflected, surface.is_spread, sample);
            sample.indirect += bounce == 0 ? surface.worth * gathered.indirect : reflected;
            if (bounce == 0) {
                sample.method += weight * gathered.method;
                size[surface.sample] += weight * gathered.size;
            }
            sample.error += weight * gathered.error;
            sample.shadow_variance += sqr(weight) * gathered.shadow_variance;
            look_on(surface, u, rays);
        }
    }
    for (std::size_t i = 0; i < samples.size(); ++i)
        samples[i].method = size[i] > 0.0f ? samples[i].method / size[i] : Rgb(0.0f);
}

}  // namespace pivot
