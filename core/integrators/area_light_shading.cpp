#include "core/integrators/area_light_shading.h"

#include "core/sampling/warp.h"
#include "core/shading/ggx_area_light.h"
#include "core/tables/ggx_ltc.h"

namespace pivot {
namespace {

AreaOutline<Batch> local_outline(const AreaLight& light, const SurfaceBatch& batch) {
    const auto local = [&](const Vec3b& v) { return batch.frame.to_local(v); };
    return {local(broadcast(light.center) - batch.position), local(broadcast(light.half_u)),
            local(broadcast(light.half_v)), light.shape};
}

/// One LTC of the table, clipped at the horizon, with Fresnel at the mirror direction.
LobeIntegral<Batch> integrate_ltc(const SurfaceBatch& batch, const AreaLight& light) {
    Lanes plain, cos_oh;
    for (std::size_t i = 0; i < batch_size; ++i) {
        const SurfacePoint& point = batch.lanes[i]->point;
        const Base& surface = batch.lanes[i]->surface;
        const Vec3f center = point.frame.to_local(light.center - point.position);
        const Vec3f u = point.frame.to_local(light.half_u), v = point.frame.to_local(light.half_v);
        const auto corners = AreaOutline<float>{center, u, v, light.shape}.corners();
        std::vector<Vec3f> outline(corners.begin(),
                                   light.shape == AreaShape::triangle ? corners.end() - 1 : corners.end());
        if (light.shape == AreaShape::ellipse) {
            outline.clear();
            for (int k = 0; k < 32; ++k) {
                const float angle = 2.0f * pi<float> * (static_cast<float>(k) + 0.5f) / 32.0f;
                outline.push_back(center + std::cos(angle) * u + std::sin(angle) * v);
            }
        }
        const GgxLtc lobe = ggx_ltc(surface.alpha, surface.wo_local);
        plain[i] = lobe.amplitude() * integrate_above_horizon(lobe.lobe_local, std::span<const Vec3f>(outline));
        cos_oh[i] = surface.wo_local.z;
    }
    const Batch share = load(plain), cosine = load(cos_oh);
    return {{share, share * schlick_weight(cosine), share * fresnel_dielectric_weight(cosine, batch.lobe.ior)},
            Batch(1.0f),
            detail::number_of<Batch>(Method::ltc)};
}

/// The lobe by the method asked for; the SPTD paper has no area lights, so that SPTD takes the exact rule too.
LobeIntegral<Batch> integrate_glossy(const SurfaceBatch& batch, const AreaLight& light,
                                     const AreaOutline<Batch>& outline, const RenderSettings& settings) {
    if (settings.analytic_method == AnalyticMethod::ltc) return integrate_ltc(batch, light);
    return integrate(batch.lobe, outline, max(budget_of(settings), Batch(5e-4f)));
}

/// Point k of a light's rim; a rectangle's corners are among them, and a triangle's nearly.
Vec3f rim_of(const AreaLight& light, std::uint32_t k) {
    Vec2f xy = rim_point(k);
    if (light.shape == AreaShape::triangle) {
        constexpr std::array<Vec2f, 3> corners{Vec2f(-1.0f, 0.0f), Vec2f(1.0f, -1.0f), Vec2f(1.0f, 1.0f)};
        const float along = 3.0f * static_cast<float>(k) / rim_points, part = along - std::floor(along);
        const auto corner = static_cast<std::size_t>(along);
        xy = glm::mix(corners[corner], corners[(corner + 1) % 3], part);
        xy = glm::mix(Vec2f(1.0f / 3.0f, 0.0f), xy, 0.99f);
    }
    if (light.shape == AreaShape::parallelogram) xy *= 0.99f / std::max(std::abs(xy.x), std::abs(xy.y));
    return light.center + xy.x * light.half_u + xy.y * light.half_v;
}

}  // namespace

AreaLightShading::AreaLightShading(const AreaLight& light, const SurfaceBatch& batch, const RenderSettings& settings)
    : light_(light), batch_(batch) {
    const AreaOutline<Batch> outline = local_outline(light, batch);
    Batch height = dot(batch.position - broadcast(light.center), broadcast(light.normal));
    // Within rounding of its plane a triangle would be the horizon, or all of the sky.
    if (light.is_two_sided()) {
        const Batch error_m = gather([&](std::size_t i) { return batch.lanes[i]->point.error_m; });
        height = abs(height) - Batch(surface_error_m(light)) - error_m;
    }
    const Lanes facing = store(height);
    if (std::none_of(facing.begin(), facing.end(), [](float f) { return f > 0.0f; }) || !any(is_above(outline))) return;
    if (batch.has_glossy)
        put_glossy(batch, integrate_glossy(batch, light, outline, settings), light.radiance, reflection_);
    if (batch.has_diffuse) {
        const Lanes shares = store(diffuse_share(outline));
        for (std::size_t i = 0; i < batch.count; ++i)
            reflection_.diffuse[i] = light.radiance * batch.lanes[i]->surface.diffuse * shares[i];
    }
    for (std::size_t i = 0; i < batch.count; ++i)
        if (!(facing[i] > 0.0f)) reflection_.diffuse[i] = reflection_.glossy[i] = Rgb(0.0f);
}

Reflection AreaLightShading::left_by_points(const Scene& scene, const ShadowPoints& points,
                                            std::span<const float> totals, bool traces_rays) const {
    std::array<Rgb, batch_size> both;
    for (std::size_t i = 0; i < batch_size; ++i) both[i] = abs(reflection_.diffuse[i]) + abs(reflection_.glossy[i]);
    // Shares of few points that see parts of the light are shifted.
    constexpr std::uint32_t spread_points = 64;
    const bool is_spread = light_.inverse_tan_spread > 0.0f;
    const ShadowPoints of_light =
        points.for_share(largest_share(both, totals)).at_least(is_spread ? spread_points : 1u);
    std::array<LaneShares, batch_size> shares{};
    const auto add_points = [&](const PartOfPoints& part, std::span<const bool> wanted, ShadowRays& rays) {
        const auto add = [&](const Vec3f& on_light, bool is_rim) {
            for (std::size_t i = 0; i < batch_.count; ++i) {
                if (!wanted[i]) continue;
                const SurfacePoint& point = batch_.lanes[i]->point;
                const Base& surface = batch_.lanes[i]->surface;
                const Vec3f d = on_light - point.position;
                const float distance_m = length(d);
                const Vec3f wi = d / std::max(distance_m, 1e-30f), wi_local = point.frame.to_local(wi);
                if (!(wi_local.z > 0.0f)) continue;
                const float cosine = -dot(wi, normal_towards(light_, point.position));
                const float solid_angle = cosine / sqr(distance_m);
                const float error_m = light_.is_two_sided() ? surface_error_m(light_) + point.error_m : 0.0f;
                const bool has_lobe = !is_rim && surface.has_glossy();
                const float lobe = has_lobe ? ggx_eval(surface.wo_local, wi_local, surface.alpha, surface.alpha) : 0.0f;
                rays.add({point.ray_origin(wi), wi, 0.0f, distance_m * shadow_reach - error_m / std::max(cosine, 1e-6f),
                          point.time},
                         point.faces(wi),
                         {&shares[i], is_rim ? 0.0f : solid_angle * wi_local.z, solid_angle * lobe,
                          is_rim ? 1.0f : 0.0f, is_spread ? spread_falloff(light_.inverse_tan_spread, cosine) : 1.0f});
            }
        };
        for (std::uint32_t k = 0; part.asks_rim() && k < rim_points; ++k) add(rim_of(light_, k), true);
        const auto [begin, end] = of_light.range(part);
        for (std::uint32_t k = begin; k < end; ++k)
            add(place_on(light_, of_light.point(PointSet::light_diffuse, k)), false);
    };
    const std::span<LaneShares> lanes = std::span(shares).first(batch_.count);
    ask_points(scene, points, is_spread ? 1.0f : of_light.first_part(), lanes, add_points, {}, traces_rays);
    return seen_in_part(reflection_, lanes, points);
}

}  // namespace pivot
