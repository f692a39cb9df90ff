#include "core/integrators/analytic_fog.h"

#include "core/integrators/scatter_table.h"

namespace pivot {
namespace {

constexpr std::size_t nodes_of_panel = 8;
constexpr std::size_t most_panels = 8;
/// What is left to the closed forms over the lamp.
constexpr float error_over_lamp = 0.005f;

/// What a lamp scatters from one interval of a ray if nothing hides it.
class LampInFog {
   public:
    LampInFog(const Light& lamp, const MediaRay& ray, std::size_t interval, MediaRay& to_lamp)
        : lamp_(lamp), ray_(ray), interval_(interval), to_lamp_(to_lamp) {
        ray.set_typical_mix(interval, typical_);
    }
    FogPart part() const { return {ray_, interval_, typical_}; }
    const MediumMix& typical() const { return typical_; }

    /// For each m.
    std::array<Rgb, batch_size> at(const Batch& distance_m) {
        const bool is_even = ray_.is_homogeneous(interval_);
        Vec3b light = scattered_light(lamp_, part(), distance_m, true);
        if (!is_even) light = light * ray_.relative_density(interval_, typical_, distance_m);
        const Lanes t = store(distance_m), r = store(light.x), g = store(light.y), b = store(light.z);
        std::array<Rgb, batch_size> result;
        for (std::size_t i = 0; i < batch_size; ++i) {
            result[i] = Rgb(r[i], g[i], b[i]);
            if (!std::isfinite(t[i]) || !(max_component(abs(result[i])) > 0.0f)) {
                result[i] = Rgb(0.0f);
                continue;
            }
            result[i] *= ray_.transmittance(interval_, ray_.interval(interval_).near_m, t[i]) *
                         transmittance_from(lamp_, ray_.position(t[i]), to_lamp_);
        }
        return result;
    }

   private:
    const Light& lamp_;
    const MediaRay& ray_;
    std::size_t interval_;
    MediaRay& to_lamp_;
    MediumMix typical_;
};

/// By so many panels of Gauss and Legendre's nodes.
Rgb integrate(LampInFog& lamp, const DistanceMap& map, std::size_t panels) {
    Rgb sum(0.0f);
    for (std::size_t first = 0; first < panels * nodes_of_panel; first += batch_size) {
        const auto node = [&](std::size_t i) { return gauss_rule<nodes_of_panel>[(first + i) % nodes_of_panel]; };
        const Batch t = map.distance_m(gather([&](std::size_t i) {
            return (static_cast<float>((first + i) / nodes_of_panel) + node(i).x) / static_cast<float>(panels);
        }));
        const Lanes density = store(map.density(t));
        const std::array<Rgb, batch_size> scattered = lamp.at(t);
        for (std::size_t i = 0; i < batch_size; ++i)
            if (density[i] > 0.0f) sum += scattered[i] * (node(i).weight / (density[i] * static_cast<float>(panels)));
    }
    return sum;
}

/// A shadow ray's length: rays must not meet the triangle of a mesh that they ask for.
float shadow_reach_m(const Light& light, const LightPoint& point) {
    const float reach_m = point.distance_m * shadow_reach;
    const auto* area = std::get_if<AreaLight>(&light);
    if (!area) return reach_m;
    return reach_m - surface_error_m(*area) / std::max(std::abs(dot(point.wi, area->normal)), tiny<float>);
}

/// Which share of the light that comes to the ray is seen there.
VisibleShare seen_share(const Scene& scene, const Light& light, LampInFog& lamp, const MediaRay& ray,
                        const ScatterTable& table, const ShadowPoints& points) {
    LaneShares share;
    const auto add_points = [&](const PartOfPoints& part, std::span<const bool>, ShadowRays& rays) {
        const auto [begin, end] = points.range(part);
        for (std::uint32_t k = begin; k < end; ++k) {
            const Vec2f u = points.point(PointSet::fog_place, k);
            const ScatterTable::Place place = table.sample(u.x);
            const Vec3f position = ray.position(place.distance_m);
            const FogLampSampler sampler(light, lamp.typical(), position, ray.ray().direction, LightSampling::joint);
            const auto point = sampler.sample(points.point(PointSet::fog_lamp, k));
            if (!point || !(point->pdf_omega > 0.0f)) continue;
            const Rgb scattered = lamp.typical().scattered(ray.ray().direction, point->wi) * point->radiance;
            // Beside the table, which has the rest in it.
            const float weight =
                std::holds_alternative<AreaLight>(light) ? mean_component(abs(scattered)) / point->pdf_omega : 1.0f;
            rays.add({position, point->wi, 0.0f, shadow_reach_m(light, *point), ray.ray().time}, true,
                     {&share, weight, 0.0f});
        }
    };
    ask_points(scene, points, points.first_part(), {&share, 1}, add_points);
    return share.diffuse;
}

}  // namespace

Rgb transmittance_from(const Light& lamp, const Vec3f& position, MediaRay& ray) {
    const auto from = [&](const Vec3f& direction, float distance_m) {
        ray.follow({.origin = position, .direction = direction, .near_m = 0.0f, .far_m = distance_m}, nullptr);
        return ray.through();
    };
    if (const auto* sun = std::get_if<SunLight>(&lamp))
        return from(sun->cap.axis, std::numeric_limits<float>::infinity());
    if (const auto* area = std::get_if<AreaLight>(&lamp)) {
        // By four places on it, each as much as it lights.
        Rgb sum(0.0f);
        float weights = 0.0f;
        for (const Vec2f& place : {Vec2f(-0.5f, -0.5f), Vec2f(0.5f, -0.5f), Vec2f(-0.5f, 0.5f), Vec2f(0.5f, 0.5f)}) {
            const Vec3f d = area->center + place.x * area->half_u + place.y * area->half_v - position;
            const float distance_m = length(d), cosine = dot(d, area->normal),
                        weight = (area->is_two_sided() ? std::abs(cosine) : -cosine) /
                                 std::max(distance_m * sqr(distance_m), tiny<float>);
            if (!(weight > 0.0f)) continue;
            sum += weight * from(d / distance_m, distance_m);
            weights += weight;
        }
        return weights > 0.0f ? sum / weights : Rgb(1.0f);
    }
    const SphereLight& sphere = *sphere_of(lamp);
    const Vec3f d = sphere.center - position;
    const float distance_m = length(d);
    if (!(distance_m > 0.0f)) return Rgb(1.0f);
    // A sphere's face is so much nearer in the mean.
    const float face_m = sphere.is_facing_disk ? 0.0f : sphere.radius_m * (2.0f / 3.0f);
    return from(d / distance_m, std::max(distance_m - face_m, 0.0f));
}

void apply_media(const Scene& scene, const Light& light, const SurfaceBatch& batch, Reflection& reflection) {
    if (scene.media().is_empty()) return;
    MediaRay ray(scene.media());
    for (std::size_t i = 0; i < batch.count; ++i) {
        const Rgb left = transmittance_from(light, batch.lanes[i]->point.position, ray);
        reflection.diffuse[i] *= left;
        reflection.glossy[i] *= left;
        reflection.shadow_variance[i] *= sqr(mean_component(left));
    }
}

FogLight scatter_analytic(const Scene& scene, const RenderSettings& settings, const AnalyticLights& lights,
                          std::uint32_t bounce, const ShadowPoints& points, const MediaRay& ray,
                          const OnFogLight& on_light) {
    FogLight result;
    result.emitted = ray.emitted();
    const float budget = 0.01f * settings.error_budget_percent;
    MediaRay to_lamp(scene.media());
    for (std::size_t i = 0; i < ray.size(); ++i) {
        if (on_light) on_light(ray.light_group_in(i), ray.before(i) * ray.emitted_in(i));
        for (const auto& [light, rules, group] : lights.exact) {
            if (!(rules.lights & visible_to_scatter) || bounce > rules.max_bounces ||
                !is_receiver(rules.links, ray.link_sets_in(i)))
                continue;
            LampInFog lamp(light, ray, i, to_lamp);
            if (!lamp.typical().scatters()) break;
            const auto lit = lit_part(light, lamp.part());
            if (!lit) continue;
            const DistanceMap map = distance_map(light, lamp.part(), lit->first, lit->second);
            Rgb whole = integrate(lamp, map, 1);
            float error = 1.0f;
            for (std::size_t panels = 2; panels <= most_panels && error > 0.5f * budget; panels *= 2) {
                const Rgb finer = integrate(lamp, map, panels);
                const float size = mean_component(abs(finer));
                error = size > 0.0f ? mean_component(abs(finer - whole)) / size : 0.0f;
                whole = finer;
            }
            whole *= ray.before(i);
            if (!(max_component(abs(whole)) > 0.0f)) continue;
            VisibleShare share;
            if (settings.occlusion == Occlusion::ray_traced && rules.casts_shadows) {
                const ScatterTable table(map, 2 * nodes_of_panel, [&](const Batch& t) {
                    const std::array<Rgb, batch_size> scattered = lamp.at(t);
                    return gather([&](std::size_t k) { return mean_component(abs(scattered[k])); });
                });
                if (table.sum() > 0.0f)
                    share = seen_share(scene, light, lamp, ray, table, points.past_others(rules.links));
            }
            const float size = mean_component(abs(whole)) * share.value();
            const Rgb scattered = whole * share.color();
            result.scattered += scattered;
            if (on_light) on_light(group, scattered);
            result.error += size * (error + error_over_lamp);
            result.shadow_variance += sqr(mean_component(abs(whole))) * share.variance();
        }
    }
    return result;
}

}  // namespace pivot
