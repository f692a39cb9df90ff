#include "core/integrators/analytic.h"

#include "core/integrators/analytic_fog.h"
#include "core/integrators/analytic_world.h"
#include "core/integrators/area_light_shading.h"
#include "core/integrators/arrival.h"
#include "core/integrators/bump_share.h"
#include "core/integrators/cap_light_shading.h"
#include "core/integrators/lobe_points.h"
#include "core/integrators/shown_surfaces.h"
#include "core/integrators/specular_occlusion.h"
#include "core/integrators/virtual_light_shading.h"
#include "core/simd/pack.h"

namespace pivot {
namespace {

/// What the Method pass shows, from cold to warm with the cost.
constexpr std::array<std::array<float, 3>, method_names.size()> method_colors{{{0.0f, 0.0f, 0.0f},
                                                                               {0.05f, 0.1f, 0.6f},
                                                                               {0.0f, 0.5f, 0.8f},
                                                                               {0.0f, 0.7f, 0.4f},
                                                                               {0.5f, 0.8f, 0.1f},
                                                                               {0.9f, 0.6f, 0.0f},
                                                                               {1.0f, 0.35f, 0.0f},
                                                                               {1.0f, 0.05f, 0.0f},
                                                                               {0.5f, 0.0f, 0.2f},
                                                                               {0.5f, 0.2f, 0.8f},
                                                                               {0.9f, 0.2f, 0.6f},
                                                                               {0.4f, 0.4f, 0.4f},
                                                                               {0.7f, 0.7f, 0.7f},
                                                                               {0.3f, 0.9f, 0.9f},
                                                                               {1.0f, 1.0f, 1.0f}}};

Rgb color_of(Method method) {
    const auto& c = method_colors[static_cast<std::size_t>(method)];
    return {c[0], c[1], c[2]};
}

float size_of(const Rgb& light) { return mean_component(abs(light)); }

/// A point's direct light so far, the methods weighted by what they contribute.
struct Gathered {
    Rgb radiance{0.0f}, indirect{0.0f}, method{0.0f};
    float size = 0.0f;  ///< of the light, whatever its sign
    float error = 0.0f, shadow_variance = 0.0f;

    void add(const Rgb& light, Method how, float relative_error) {
        radiance += light;
        size += size_of(light);
        method += size_of(light) * color_of(how);
        error += size_of(light) * relative_error;
    }
    void add(const Gathered& part) {
        radiance += part.radiance;
        indirect += part.indirect;
        size += part.size;
        method += part.method;
        error += part.error;
        shadow_variance += part.shadow_variance;
    }
};

using LightShading = std::variant<CapLightShading, AreaLightShading>;

LightShading shade_light(const Light& light, const SurfaceBatch& batch, const RenderSettings& settings) {
    if (const auto* area = std::get_if<AreaLight>(&light)) return AreaLightShading(*area, batch, settings);
    return CapLightShading(light, batch, settings);
}

const Reflection& reflection_of(const LightShading& shading) {
    return std::visit([](const auto& s) -> const Reflection& { return s.reflection(); }, shading);
}

/// By rays, or as if nothing were in the light's way.
Reflection seen_of(const LightShading& shading, const Scene& scene, const ShadowPoints& points,
                   std::span<const float> totals, bool by_rays) {
    if (by_rays) return std::visit([&](const auto& s) { return s.seen_by_rays(scene, points, totals); }, shading);
    if (const auto* area = std::get_if<AreaLightShading>(&shading)) return area->spread(scene, points, totals);
    return reflection_of(shading);
}

/// Leaves of lanes' reflections those that the light is there for.
void apply_rules(const LightRules& rules, const SurfaceBatch& batch, Reflection& reflection) {
    for (std::size_t i = 0; i < batch.count; ++i) {
        const bool is_glass = batch.lanes[i]->is_glass;
        if (!(rules.lights & visible_to_diffuse)) reflection.diffuse[i] = Rgb(0.0f);
        if (!(rules.lights & (visible_to_glossy | (is_glass ? visible_to_transmission : 0u))))
            reflection.glossy[i] = Rgb(0.0f);
    }
}

constexpr std::uint32_t bump_points_of_light = 16;

/// What bumps leave of each lane's diffuse half.
void apply_bumps(const Light& light, const SurfaceBatch& batch, Reflection& reflection) {
    for (std::size_t i = 0; i < batch.count; ++i) {
        const auto& [point, surface, bent_cone, is_glass] = *batch.lanes[i];
        if (!surface.has_diffuse() || !surface.bump.is_turned()) continue;
        const auto beam = [&, &frame = point.frame](const Vec3f& wi_local) {
            const auto* spot = std::get_if<SpotLight>(&light);
            return spot ? spot_falloff(*spot, -dot(frame.to_world(wi_local), spot->direction)) : 1.0f;
        };
        const BumpShare share = bump_share(surface.bump, local_cap(light, point), bump_points_of_light, beam);
        reflection.diffuse[i] *= share.value;
        reflection.diffuse_error[i] += share.error;
    }
}

/// What bent cones leave of each lane's reflection of a light.
void apply_bent_cones(const Light& light, const SurfaceBatch& batch, Reflection& reflection,
                      std::span<Gathered> gathered) {
    for (std::size_t i = 0; i < batch.count; ++i) {
        const auto& [point, surface, bent_cone, is_glass] = *batch.lanes[i];
        const SeenShare seen = seen_share(light, bent_cone, point, surface);
        gathered[i].error += error_of_bent_cone(reflection.diffuse[i], seen.diffuse) +
                             error_of_bent_cone(reflection.glossy[i], seen.glossy);
        reflection.diffuse[i] *= seen.diffuse;
        reflection.glossy[i] *= seen.glossy;
    }
}

/// Light that comes to a batch if nothing is in its way.
struct Unhidden {
    std::vector<LightShading> lamps;
    std::array<WorldReflection, batch_size> world{};
    Lanes totals{};  ///< of each lane; what is found to be hidden is taken off

    float size(std::size_t lamp, std::size_t lane) const {
        const Reflection& reflection = reflection_of(lamps[lamp]);
        return size_of(reflection.diffuse[lane]) + size_of(reflection.glossy[lane]);
    }
};
Unhidden unhidden_light(const Scene& scene, const RenderSettings& settings, const AnalyticLights& lights,
                        const SurfaceBatch& batch) {
    Unhidden light;
    light.lamps.reserve(lights.exact.size());
    for (const Light& lamp : lights.exact) {
        light.lamps.push_back(shade_light(lamp, batch, settings));
        for (std::size_t i = 0; i < batch.count; ++i) light.totals[i] += light.size(light.lamps.size() - 1, i);
    }
    if (!scene.has_world()) return light;
    for (std::size_t i = 0; i < batch.count; ++i) {
        light.world[i] = reflect_whole_world(scene, *batch.lanes[i]);
        light.totals[i] += size_of(light.world[i].diffuse) + size_of(light.world[i].glossy);
    }
    return light;
}

/// The lamps from the one that gives most, so that the others' rays are as many as what is seen of it asks for.
std::vector<std::size_t> brightest_first(const Unhidden& light, std::size_t lanes) {
    std::vector<float> shares(light.lamps.size());
    std::vector<std::size_t> order(shares.size());
    for (std::size_t k = 0; k < shares.size(); ++k) {
        order[k] = k;
        for (std::size_t i = 0; i < lanes; ++i)
            if (light.totals[i] > 0.0f) shares[k] = std::max(shares[k], light.size(k, i) / light.totals[i]);
    }
    std::erase_if(order, [&](std::size_t k) { return !(shares[k] > 0.0f); });
    std::ranges::stable_sort(order, std::greater(), [&](std::size_t k) { return shares[k]; });
    return order;
}

void add_lamps(const Scene& scene, const RenderSettings& settings, const AnalyticLights& lights,
               const ShadowPoints& points, const SurfaceBatch& batch, Unhidden& light, std::span<Gathered> gathered) {
    for (const std::size_t k : brightest_first(light, batch.count)) {
        const Light& lamp = lights.exact[k];
        const LightRules rules = lights.rules.empty() ? LightRules{} : lights.rules[k];
        const bool by_rays = settings.occlusion == Occlusion::ray_traced;
        const std::span<const float> totals = std::span(light.totals).first(batch.count);
        Reflection reflection = seen_of(light.lamps[k], scene, points, totals, by_rays && rules.casts_shadows);
        if (rules.lights != visible_to_paths) apply_rules(rules, batch, reflection);
        if (by_rays) {
            for (std::size_t i = 0; i < batch.count; ++i)
                light.totals[i] -= light.size(k, i) - size_of(reflection.diffuse[i]) - size_of(reflection.glossy[i]);
        }
        apply_bumps(lamp, batch, reflection);
        if (rules.casts_shadows) apply_media(scene, lamp, batch, reflection);
        if (settings.occlusion == Occlusion::bent_cone && rules.casts_shadows)
            apply_bent_cones(lamp, batch, reflection, gathered);
        for (std::size_t i = 0; i < batch.count; ++i) {
            gathered[i].add(reflection.diffuse[i], Method::points_1, reflection.diffuse_error[i]);
            gathered[i].add(reflection.glossy[i], reflection.method[i], reflection.glossy_error[i]);
            gathered[i].shadow_variance += reflection.shadow_variance[i];
        }
    }
}

void add_virtual_lights(const VirtualReflection& reflection, const Base& surface, bool has_bounced,
                        Gathered& gathered) {
    const Rgb light = reflection.radiance(surface);
    gathered.add(light, Method::virtual_lights, reflection.error);
    gathered.shadow_variance += sqr(size_of(light) * reflection.shadow_deviation);
    if (has_bounced) gathered.indirect += light;
}

void shade_batch(const Scene& scene, const RenderSettings& settings, const ShadowPoints& points,
                 const AnalyticLights& lights, std::uint32_t sample_index, std::span<const ShadingPoint> shading,
                 std::span<Gathered> gathered) {
    const SurfaceBatch batch = make_batch(shading);
    if (!batch.has_diffuse && !batch.has_glossy) return;
    Unhidden light = unhidden_light(scene, settings, lights, batch);
    add_lamps(scene, settings, lights, points, batch, light, gathered);
    for (const VirtualLightTree& side : lights.emitted) {
        if (side.empty()) continue;
        const auto reflected = reflect_virtual_lights(scene, settings, side, {}, batch, sample_index);
        for (std::size_t i = 0; i < batch.count; ++i)
            add_virtual_lights(reflected[i], shading[i].surface, false, gathered[i]);
    }
    if (!scene.has_world()) return;
    for (std::size_t i = 0; i < shading.size(); ++i) {
        WorldReflection world = light.world[i];
        if (settings.occlusion == Occlusion::ray_traced)
            world = world_seen_by_rays(world, scene, points, shading[i], light.totals[i]);
        else if (settings.occlusion == Occlusion::bent_cone)
            world = world_seen_by_cone(world, shading[i]);
        gathered[i].add(world.diffuse, Method::point_set, world.bump_error);
        gathered[i].add(world.glossy, Method::point_set, error_of_albedo);
        gathered[i].error += world.cone_error;
        gathered[i].shadow_variance += world.shadow_variance;
    }
}

/// A hit surface, for the sample of this index, and what its light is worth there.
struct HitSurface {
    std::size_t sample;
    Rgb worth;
    RayHit hit;
    SurfacePoint point;
    Surface surface;
};

/// What has closed forms, and of which surface: first all bases, so that neighbours stay neighbours, then what further
/// lobes are.
struct Parts {
    std::vector<ShadingPoint> shading;
    std::vector<std::size_t> surface;
};
Parts parts_of(const Scene& scene, const RenderSettings& settings, std::span<const HitSurface> hits) {
    Parts parts;
    const auto add = [&](std::size_t of, const SurfacePoint& point, const Base& base, bool is_glass = false) {
        parts.shading.push_back({point, base, {}, is_glass});
        if (settings.occlusion == Occlusion::bent_cone)
            parts.shading.back().bent_cone = scene.bent_cone(hits[of].hit, point);
        parts.surface.push_back(of);
    };
    for (std::size_t i = 0; i < hits.size(); ++i) add(i, hits[i].point, hits[i].surface);
    for (std::size_t i = 0; i < hits.size(); ++i)
        for_each_lobe(hits[i].surface, [&, &hit = hits[i]]<class L>(const L& lobe, const LobeOf<float>&, bool) {
            if constexpr (L::has_closed_form)
                add(i, L::reflects ? hit.point : turned_over(hit.point), lobe.closed_form(hit.surface.wo_local),
                    L::reflects && L::transmits);
        });
    return parts;
}

/// Adds what the parts reflect of light that bounced.
void add_bounced(const Scene& scene, const RenderSettings& settings, const VirtualLights& bounced,
                 std::uint32_t sample_index, std::span<const HitSurface> hits, const Parts& parts,
                 std::span<const std::uint32_t> pixels, SharedReflections& shared, std::span<Gathered> light) {
    std::vector<std::uint32_t> pixel_of;
    for (const std::size_t of : parts.surface) pixel_of.push_back(pixels[hits[of].sample]);
    const auto reflections =
        shared.reflect(scene, settings, bounced, parts.shading, pixel_of, sample_index / bounced_samples_shared);
    for (std::size_t i = 0; i < reflections.size(); ++i)
        add_virtual_lights(reflections[i], parts.shading[i].surface, true, light[parts.surface[i]]);
}

/// Adds what a surface's lobes without closed forms reflect.
void add_lobe_points(const Scene& scene, const RenderSettings& settings, const AnalyticLights& lights,
                     const ShadowPoints& points, const HitSurface& hit, Gathered& gathered) {
    for_each_lobe(hit.surface, [&]<class L>(const L&, const LobeOf<float>& record, bool) {
        if constexpr (!L::has_closed_form) {
            Surface alone(make_base(BaseMaterialOf<float>{}, hit.surface.wo_local));
            alone.lobes = {record};
            alone.lobes[0].probability = 1.0f;
            const auto add = [&](const LobeReflection& reflection) {
                gathered.add(reflection.radiance, Method::lobe_directions, reflection.error);
                gathered.shadow_variance += reflection.shadow_variance;
            };
            for (std::size_t k = 0; k < lights.exact.size(); ++k)
                add(reflect_light(scene, settings, points, lights.exact[k],
                                  lights.rules.empty() ? LightRules{} : lights.rules[k], hit.point, alone));
            if (scene.has_world()) add(reflect_world(scene, settings, points, hit.point, alone));
        }
    });
}

/// Appends the surfaces of a batch of those shown, and tells the passes of them. batch_of: their arrivals.
void see(const Scene& scene, std::span<const Arrival* const> batch_of, std::span<const Shown> shown,
         ProgramMemory& memory, std::vector<HitSurface>& surfaces, std::span<Sample> samples) {
    const ArrivalBatch batch = make_arrivals(scene, batch_of, 0, memory);
    const auto points = unpack<SurfacePointOf>(batch.point);
    SurfaceOf<Batch> surface = make_surface(batch.material, batch.point.wo_local);
    surface.bump = batch.bump;
    const auto seen = unpack<SurfaceOf>(surface);
    const auto materials = unpack<MaterialOf>(batch.material);
    for (std::size_t i = 0; i < batch_of.size(); ++i) {
        Sample& sample = samples[shown[i].sample];
        const Rgb emitted = shown[i].worth * materials[i].emission;
        sample.radiance += emitted;
        sample.emission += emitted;
        if (shown[i].is_told) {
            sample.normal = points[i].frame.z;
            sample.albedo = diffuse_color(seen[i]);
        }
        if (!shown[i].only_shines)
            surfaces.push_back({shown[i].sample, shown[i].worth, shown[i].arrival.hit, points[i], seen[i]});
    }
}

}  // namespace

void shade_analytic(const Scene& scene, const RenderSettings& settings, const AnalyticLights& lights,
                    std::span<const Ray> camera_rays, std::span<const std::uint32_t> pixels, std::uint32_t sample_index,
                    SharedReflections& shared, std::span<Sample> samples) {
    std::vector<std::optional<RayHit>> hits(camera_rays.size());
    scene.intersect(camera_rays, visible_to_camera, hits);
    ProgramMemory memory;
    const ShadowPoints points(settings, sample_index);
    std::vector<FogLight> fog;  // of each sample, and what media let through; empty: there are none
    std::vector<Rgb> through;
    if (!scene.media().is_empty()) {
        MediaRay media_ray(scene.media());
        for (std::size_t i = 0; i < hits.size(); ++i) {
            Ray ray = camera_rays[i];
            if (hits[i]) ray.far_m = hits[i]->distance_m;
            media_ray.follow(ray, nullptr);
            through.push_back(media_ray.through());
            fog.push_back(scatter_analytic(scene, settings, points, media_ray));
        }
    }
    const float spread = scene.camera().pixel_spread() * part_of_pixel(settings);
    std::vector<Shown> shown = shown_surfaces(scene, settings, camera_rays, hits, spread, memory, samples);
    // A program runs for one material.
    std::ranges::stable_sort(shown, {}, [&](const Shown& s) {
        return scene.shaders()[s.arrival.material].is_constant() ? 0 : s.arrival.material + 1;
    });
    std::vector<HitSurface> surfaces;
    std::vector<const Arrival*> ordered;
    for (const Shown& s : shown) ordered.push_back(&s.arrival);
    for (std::size_t first = 0; first < ordered.size();) {
        const auto rest = std::span<const Arrival* const>(ordered).subspan(first);
        const std::size_t count = batch_count(scene, rest);
        see(scene, rest.first(count), std::span<const Shown>(shown).subspan(first, count), memory, surfaces, samples);
        first += count;
    }
    const Parts parts = parts_of(scene, settings, surfaces);
    const auto& [shading, surface_of] = parts;
    std::vector<Gathered> light(surfaces.size());
    for (std::size_t first = 0; first < shading.size(); first += batch_size) {
        const std::size_t count = std::min(batch_size, shading.size() - first);
        std::array<Gathered, batch_size> gathered{};
        shade_batch(scene, settings, points, lights, sample_index, std::span(shading).subspan(first, count),
                    std::span(gathered).first(count));
        for (std::size_t i = 0; i < count; ++i) light[surface_of[first + i]].add(gathered[i]);
    }
    if (!lights.bounced.is_empty())
        add_bounced(scene, settings, lights.bounced, sample_index, surfaces, parts, pixels, shared, light);
    for (std::size_t i = 0; i < surfaces.size(); ++i)
        if (surfaces[i].surface.has_lobes()) add_lobe_points(scene, settings, lights, points, surfaces[i], light[i]);
    std::vector<float> size(samples.size(), 0.0f);
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
        Sample& sample = samples[surfaces[i].sample];
        const Gathered& gathered = light[i];
        const Rgb& worth = surfaces[i].worth;
        const float weight = mean_component(worth);
        sample.radiance += worth * gathered.radiance;
        sample.indirect += worth * gathered.indirect;
        sample.method += weight * gathered.method;
        size[surfaces[i].sample] += weight * gathered.size;
        sample.error += weight * gathered.error;
        sample.shadow_variance += sqr(weight) * gathered.shadow_variance;
    }
    for (std::size_t i = 0; i < samples.size(); ++i)
        samples[i].method = size[i] > 0.0f ? samples[i].method / size[i] : Rgb(0.0f);
    for (std::size_t i = 0; i < fog.size(); ++i) {
        Sample& sample = samples[i];
        const float left = mean_component(through[i]);
        sample.radiance = sample.radiance * through[i] + fog[i].scattered + fog[i].emitted;
        sample.emission = sample.emission * through[i] + fog[i].emitted;
        sample.indirect = sample.indirect * through[i];
        sample.volume_direct = fog[i].scattered;
        sample.error = sample.error * left + fog[i].error;
        sample.shadow_variance = sample.shadow_variance * sqr(left) + fog[i].shadow_variance;
        if (!hits[i] && settings.transparent_film) sample.alpha = 1.0f - std::min(left, 1.0f);
    }
}

}  // namespace pivot
