#include "core/integrators/gathered_light.h"

#include "core/integrators/analytic_fog.h"
#include "core/integrators/analytic_world.h"
#include "core/integrators/area_light_shading.h"
#include "core/integrators/bump_share.h"
#include "core/integrators/cap_light_shading.h"
#include "core/integrators/lobe_points.h"
#include "core/integrators/specular_occlusion.h"

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

using LightShading = std::variant<CapLightShading, AreaLightShading>;

LightShading shade_light(const Light& light, const SurfaceBatch& batch, const RenderSettings& settings) {
    if (const auto* area = std::get_if<AreaLight>(&light)) return AreaLightShading(*area, batch, settings);
    return CapLightShading(light, batch, settings);
}

const Reflection& reflection_of(const LightShading& shading) {
    return std::visit([](const auto& s) -> const Reflection& { return s.reflection(); }, shading);
}

void note(GroupLight* groups, std::size_t lane, std::uint32_t group, const Rgb& light) {
    if (groups) groups->note(lane, group, light);
}

/// By rays, or as if nothing were in the light's way.
Reflection seen_of(const LightShading& shading, const Scene& scene, const ShadowPoints& points,
                   std::span<const float> totals, bool by_rays) {
    if (by_rays) return std::visit([&](const auto& s) { return s.seen_by_rays(scene, points, totals); }, shading);
    if (const auto* area = std::get_if<AreaLightShading>(&shading)) return area->spread(scene, points, totals);
    return reflection_of(shading);
}

/// Which of a lane's reflections a light is there for, after so many bounces.
struct LitParts {
    bool diffuse, glossy;
};
LitParts lit_parts(const LightRules& rules, std::uint32_t bounce, const ShadingPoint& lane) {
    if (bounce > rules.max_bounces || !is_receiver(rules.links, lane.link_sets)) return {false, false};
    return {(rules.lights & visible_to_diffuse) != 0,
            (rules.lights & (visible_to_glossy | (lane.is_glass ? visible_to_transmission : 0u))) != 0};
}

/// Leaves of lanes' reflections those that the light is there for.
void apply_rules(const LightRules& rules, std::uint32_t bounce, const SurfaceBatch& batch, Reflection& reflection) {
    if (rules == LightRules{}) return;
    for (std::size_t i = 0; i < batch.count; ++i) {
        const LitParts lit = lit_parts(rules, bounce, *batch.lanes[i]);
        if (!lit.diffuse) reflection.diffuse[i] = Rgb(0.0f);
        if (!lit.glossy) reflection.glossy[i] = Rgb(0.0f);
    }
}

constexpr std::uint32_t bump_points_of_light = 16;

/// What bumps leave of each lane's diffuse half.
void apply_bumps(const Light& light, const SurfaceBatch& batch, Reflection& reflection) {
    for (std::size_t i = 0; i < batch.count; ++i) {
        const SurfacePoint& point = batch.lanes[i]->point;
        const Base& surface = batch.lanes[i]->surface;
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
        const ShadingPoint& lane = *batch.lanes[i];
        const SeenShare seen = seen_share(light, lane.bent_cone, lane.point, lane.surface);
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
                        std::uint32_t bounce, const SurfaceBatch& batch) {
    Unhidden light;
    light.lamps.reserve(lights.exact.size());
    for (const ExactLight& lamp : lights.exact) {
        light.lamps.push_back(shade_light(lamp.light, batch, settings));
        std::visit([&](auto& shading) { apply_rules(lamp.rules, bounce, batch, shading.reflection()); },
                   light.lamps.back());
        for (std::size_t i = 0; i < batch.count; ++i) light.totals[i] += light.size(light.lamps.size() - 1, i);
    }
    if (!scene.has_world()) return light;
    for (std::size_t i = 0; i < batch.count; ++i) {
        light.world[i] = reflect_whole_world(scene, *batch.lanes[i]);
        const LitParts lit = lit_parts(scene.world_rules(), bounce, *batch.lanes[i]);
        if (!lit.diffuse) light.world[i].diffuse = Rgb(0.0f);
        if (!lit.glossy || is_mirror(batch.lanes[i]->surface)) light.world[i].glossy = Rgb(0.0f);
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
               const ShadowPoints& points, const SurfaceBatch& batch, Unhidden& light, std::span<Gathered> gathered,
               GroupLight* groups) {
    for (const std::size_t k : brightest_first(light, batch.count)) {
        const auto& [lamp, rules, group] = lights.exact[k];
        const bool by_rays = settings.occlusion == Occlusion::ray_traced;
        const std::span<const float> totals = std::span(light.totals).first(batch.count);
        Reflection reflection =
            seen_of(light.lamps[k], scene, points.past_others(rules.links), totals, by_rays && rules.casts_shadows);
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
            note(groups, i, group, reflection.diffuse[i]);
            if (k < scene.lamps().size() || !is_mirror(batch.lanes[i]->surface)) {
                gathered[i].add(reflection.glossy[i], reflection.method[i], reflection.glossy_error[i]);
                note(groups, i, group, reflection.glossy[i]);
            }
            gathered[i].shadow_variance += reflection.shadow_variance[i];
        }
    }
}

/// Returns what it adds.
Rgb add_virtual_lights(VirtualReflection reflection, const Base& surface, bool has_bounced, Gathered& gathered) {
    if (is_mirror(surface)) reflection.glossy = {};
    const Rgb light = reflection.radiance(surface);
    gathered.add(light, Method::virtual_lights, reflection.error);
    gathered.shadow_variance += sqr(size_of(light) * reflection.shadow_deviation);
    if (has_bounced) gathered.indirect += light;
    return light;
}

/// What a batch reflects of the triangles that are virtual lights.
void add_emitted(const Scene& scene, const RenderSettings& settings, const AnalyticLights& lights, std::uint32_t bounce,
                 const SurfaceBatch& batch, std::uint32_t sample_index, std::span<Gathered> gathered,
                 GroupLight* groups) {
    for (const EmittedLights& emitted : lights.emitted) {
        for (const VirtualLightTree& side : emitted.sides) {
            if (side.empty()) continue;
            auto reflected =
                reflect_virtual_lights(scene, settings, side, {}, batch, sample_index, emitted.rules.links);
            for (std::size_t i = 0; i < batch.count; ++i) {
                const LitParts lit = lit_parts(emitted.rules, bounce, *batch.lanes[i]);
                if (!lit.diffuse) reflected[i].diffuse = {};
                if (!lit.glossy) reflected[i].glossy = {};
                note(groups, i, emitted.group,
                     add_virtual_lights(reflected[i], batch.lanes[i]->surface, false, gathered[i]));
            }
        }
    }
}

void shade_batch(const Scene& scene, const RenderSettings& settings, const ShadowPoints& points,
                 const AnalyticLights& lights, std::uint32_t bounce, std::uint32_t sample_index,
                 std::span<const ShadingPoint> shading, std::span<Gathered> gathered, GroupLight* groups) {
    const SurfaceBatch batch = make_batch(shading);
    if (!batch.has_diffuse && !batch.has_glossy) return;
    Unhidden light = unhidden_light(scene, settings, lights, bounce, batch);
    add_lamps(scene, settings, lights, points, batch, light, gathered, groups);
    add_emitted(scene, settings, lights, bounce, batch, sample_index, gathered, groups);
    if (!scene.has_world()) return;
    for (std::size_t i = 0; i < shading.size(); ++i) {
        WorldReflection world = light.world[i];
        if (settings.occlusion == Occlusion::ray_traced)
            world = world_seen_by_rays(world, scene, points, shading[i], light.totals[i]);
        else if (settings.occlusion == Occlusion::bent_cone)
            world = world_seen_by_cone(world, shading[i]);
        gathered[i].add(world.diffuse, Method::point_set, world.bump_error);
        gathered[i].add(world.glossy, Method::point_set, error_of_albedo);
        note(groups, i, scene.world_light_group(), world.diffuse + world.glossy);
        gathered[i].error += world.cone_error;
        gathered[i].shadow_variance += world.shadow_variance;
    }
}

/// What has closed forms, and of which surface: first all bases, so that neighbours stay neighbours, then what further
/// lobes are. Behind these, where virtual lights shine, the bases that stand for lobes without closed forms there.
struct Parts {
    std::vector<ShadingPoint> shading;
    std::vector<std::size_t> surface;
    std::size_t exact_count = 0;
};
Parts parts_of(const Scene& scene, const RenderSettings& settings, const AnalyticLights& lights,
               std::span<const LookedAt> hits) {
    Parts parts;
    const auto add = [&](std::size_t of, const SurfacePoint& point, const Base& base, bool is_glass = false) {
        if (is_black(base)) return;
        parts.shading.push_back({point, base, {}, is_glass, scene.link_sets_of(hits[of].arrival.hit.instance)});
        if (settings.occlusion == Occlusion::bent_cone)
            parts.shading.back().bent_cone = scene.bent_cone(hits[of].arrival.hit, point);
        parts.surface.push_back(of);
    };
    for (std::size_t i = 0; i < hits.size(); ++i) add(i, hits[i].point, hits[i].surface);
    const auto add_lobes = [&](bool with_closed_form) {
        for (std::size_t i = 0; i < hits.size(); ++i)
            for_each_lobe(hits[i].surface, [&, &hit = hits[i]]<class L>(const L& lobe, const LobeOf<float>&, bool) {
                if (L::has_closed_form == with_closed_form && !is_seen_from_within(lobe))
                    add(i, L::reflects ? hit.point : turned_over(hit.point), lobe.closed_form(hit.surface.wo_local),
                        L::reflects && L::transmits);
            });
    };
    add_lobes(true);
    parts.exact_count = parts.shading.size();
    if (!lights.emitted.empty() || !lights.bounced.empty()) add_lobes(false);
    return parts;
}

/// Adds what the parts reflect of light that bounced.
void add_bounced(const Scene& scene, const RenderSettings& settings, std::span<const VirtualLights> bounced,
                 std::uint32_t sample_index, std::span<const LookedAt> hits, const Parts& parts,
                 std::span<const std::uint32_t> pixels, std::span<SharedReflections> shared, std::span<Gathered> light,
                 GroupLight* groups) {
    Parts lit;
    std::vector<std::uint32_t> pixel_of;
    for (std::size_t i = 0; i < parts.shading.size(); ++i) {
        ShadingPoint part = parts.shading[i];
        if (is_mirror(part.surface)) part.surface = without_highlight(part.surface);
        if (is_black(part.surface)) continue;
        lit.shading.push_back(part);
        lit.surface.push_back(parts.surface[i]);
        pixel_of.push_back(pixels[hits[parts.surface[i]].sample]);
    }
    for (std::size_t of = 0; of < bounced.size(); ++of) {
        const auto reflections = shared[of].reflect(scene, settings, bounced[of], lit.shading, pixel_of,
                                                    sample_index / bounced_samples_shared);
        for (std::size_t i = 0; i < reflections.size(); ++i) {
            const LookedAt& hit = hits[lit.surface[i]];
            const Rgb added = add_virtual_lights(reflections[i], lit.shading[i].surface, true, light[lit.surface[i]]);
            if (groups) groups->add(hit.sample, bounced[of].light_group, hit.worth * added);
        }
    }
}

/// Adds what a surface's lobes without closed forms reflect.
void add_lobe_points(const Scene& scene, const RenderSettings& settings, const AnalyticLights& lights,
                     const ShadowPoints& points, std::uint32_t bounce, const LookedAt& hit, Gathered& gathered,
                     GroupLight* groups) {
    const LinkSets& link_sets = scene.link_sets_of(hit.arrival.hit.instance);
    for_each_lobe(hit.surface, [&]<class L>(const L&, const LobeOf<float>& record, bool) {
        if constexpr (!L::has_closed_form) {
            Surface alone(make_base(BaseMaterialOf<float>{}, hit.surface.wo_local));
            alone.bump = hit.surface.bump;
            alone.lobes = {record};
            alone.lobes[0].probability = 1.0f;
            const auto add = [&](const LobeReflection& reflection, std::uint32_t group) {
                gathered.add(reflection.radiance, Method::lobe_directions, reflection.error);
                gathered.shadow_variance += reflection.shadow_variance;
                if (groups) groups->add(hit.sample, group, hit.worth * reflection.radiance);
            };
            for (const auto& [light, rules, group] : lights.exact)
                if (bounce <= rules.max_bounces && is_receiver(rules.links, link_sets))
                    add(reflect_light(scene, settings, points, light, rules, hit.point, alone), group);
            if (scene.has_world() && bounce <= scene.world_rules().max_bounces)
                add(reflect_world(scene, settings, points, hit.point, alone), scene.world_light_group());
        }
    });
}

}  // namespace

void Gathered::add(const Rgb& light, Method how, float relative_error) {
    radiance += light;
    size += size_of(light);
    method += size_of(light) * color_of(how);
    error += size_of(light) * relative_error;
}

void Gathered::add(const Gathered& part) {
    radiance += part.radiance;
    indirect += part.indirect;
    size += part.size;
    method += part.method;
    error += part.error;
    shadow_variance += part.shadow_variance;
}

std::vector<Gathered> gather_light(const Scene& scene, const RenderSettings& settings, const AnalyticLights& lights,
                                   const ShadowPoints& points, std::uint32_t bounce, std::span<const LookedAt> surfaces,
                                   std::span<const std::uint32_t> pixels, std::uint32_t sample_index,
                                   std::span<SharedReflections> shared, GroupLight* groups) {
    const Parts parts = parts_of(scene, settings, lights, surfaces);
    const auto& [shading, surface_of, exact_count] = parts;
    std::vector<Gathered> light(surfaces.size());
    for (std::size_t first = 0, count = 0; first < shading.size(); first += count) {
        const bool is_exact = first < exact_count;
        count = std::min(batch_size, (is_exact ? exact_count : shading.size()) - first);
        std::array<Gathered, batch_size> gathered{};
        const auto lanes = std::span(shading).subspan(first, count);
        if (is_exact)
            shade_batch(scene, settings, points, lights, bounce, sample_index, lanes, std::span(gathered).first(count),
                        groups);
        else
            add_emitted(scene, settings, lights, bounce, make_batch(lanes), sample_index, gathered, groups);
        for (std::size_t i = 0; i < count; ++i) light[surface_of[first + i]].add(gathered[i]);
        if (!groups) continue;
        const auto surface = [&](std::size_t i) -> const LookedAt& {
            return surfaces[surface_of[first + std::min(i, count - 1)]];
        };
        groups->add_noted(count, gather_vector([&](std::size_t i) { return surface(i).worth; }),
                          [&](std::size_t i) { return surface(i).sample; });
    }
    // Light that bounced once counts as one bounce more.
    if (!lights.bounced.empty() && bounce < settings.max_bounces)
        add_bounced(scene, settings, lights.bounced, sample_index, surfaces, parts, pixels, shared, light, groups);
    for (std::size_t i = 0; i < surfaces.size(); ++i)
        if (surfaces[i].surface.has_lobes())
            add_lobe_points(scene, settings, lights, points, bounce, surfaces[i], light[i], groups);
    return light;
}

}  // namespace pivot
