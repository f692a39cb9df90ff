#include "core/integrators/cap_light_shading.h"

#include "core/distributions/sptd.h"
#include "core/sampling/warp.h"
#include "core/tables/ggx_ltc.h"
#include "core/tables/ggx_sptd.h"

namespace pivot {
namespace {

Cap<Batch> local_cap(const Light& light, const SurfaceBatch& batch) {
    Cap<Batch> cap;
    if (const SphereLight* sphere = sphere_of(light)) {
        cap = cap_of_sphere(broadcast(sphere->center) - batch.position, Batch(sphere->radius_m));
    } else {
        const Cap<float>& sun = std::get<SunLight>(light).cap;
        cap = {broadcast(sun.axis), Batch(sun.versine)};
    }
    return {batch.frame.to_local(cap.axis), cap.versine};
}

Rgb radiance_of(const Light& light) {
    if (const SphereLight* sphere = sphere_of(light)) return sphere->radiance;
    return std::get<SunLight>(light).radiance;
}

/// The direction of the cap nearest to omega.
Vec3b nearest_in_cap(const Cap<Batch>& cap, const Vec3b& omega) {
    const Vec3b across = omega - dot(omega, cap.axis) * cap.axis;
    const Vec3b on_rim = cos_half_angle(cap) * cap.axis +
                         sqrt(sin2_half_angle(cap) / max(length_squared(across), Batch(1e-12f))) * across;
    return select(contains(cap, omega), omega, on_rim);
}

/// The place in a cap, about z, of a point of the unit disk: uniform in solid angle.
Vec3b cap_point(const Cap<Batch>& cap, const Vec2f& xy) {
    const Batch versine = cap.versine * Batch(dot(xy, xy)), radius = sqrt(cap.versine * (Batch(2.0f) - versine));
    return {Batch(xy.x) * radius, Batch(xy.y) * radius, Batch(1.0f) - versine};
}

/// One SPTD lobe of the table, clipped at the horizon by [Dupuy17 (37)]: a fifth of the exact intersection's cost, and
/// 2 % of the light off where it crosses, on average.
Batch integrate_sptd(const SurfaceBatch& batch, const Cap<Batch>& cap) {
    std::array<GgxSptd, batch_size> lobes;
    for (std::size_t i = 0; i < batch_size; ++i)
        lobes[i] = ggx_sptd(batch.lanes[i]->surface.alpha, batch.lanes[i]->surface.wo_local);
    const Pivot<Batch> pivot{gather_vector([&](std::size_t i) { return lobes[i].pivot_local; }),
                             gather([&](std::size_t i) { return lobes[i].delta; })};
    const Cap<Batch> horizon{{Batch(0.0f), Batch(0.0f), Batch(1.0f)}, Batch(1.0f)};
    const Batch amplitude = gather([&](std::size_t i) { return lobes[i].amplitude(); });
    const Batch clipped = intersection_solid_angle_approximate(transform(pivot, cap), transform(pivot, horizon));
    return amplitude * clipped * Batch(0.25f / pi<float>);
}

/// One LTC of the table, clipped at the horizon.
Batch integrate_ltc(const SurfaceBatch& batch, const Cap<Batch>& cap) {
    const Lanes x = store(cap.axis.x), y = store(cap.axis.y), z = store(cap.axis.z), versine = store(cap.versine);
    Lanes integral;
    for (std::size_t i = 0; i < batch_size; ++i) {
        const Surface& surface = batch.lanes[i]->surface;
        const GgxLtc lobe = ggx_ltc(surface.alpha, surface.wo_local);
        integral[i] =
            lobe.amplitude() * integrate_above_horizon(lobe.lobe_local, Cap<float>{{x[i], y[i], z[i]}, versine[i]});
    }
    return load(integral);
}

}  // namespace

void put_glossy(const SurfaceBatch& batch, const LobeIntegral<Batch>& integral, const Rgb& radiance,
                Reflection& reflection) {
    const Lanes plain = store(integral.sums.plain), schlick = store(integral.sums.schlick),
                dielectric = store(integral.sums.dielectric), method = store(integral.method);
    reflection.predicted_error = store(integral.predicted_error);
    for (std::size_t i = 0; i < batch.count; ++i) {
        const Surface& surface = batch.lanes[i]->surface;
        reflection.method[i] = static_cast<Method>(method[i]);
        if (!surface.has_glossy()) continue;
        const LobeFresnel& f = surface.fresnel;
        reflection.glossy[i] =
            radiance * (f.schlick_f0 * plain[i] + (f.schlick_f90 - f.schlick_f0) * schlick[i] +
                        f.dielectric_f0 * plain[i] + (f.dielectric_f90 - f.dielectric_f0) * dielectric[i]);
    }
}

CapLightShading::CapLightShading(const Light& light, const SurfaceBatch& batch, const RenderSettings& settings)
    : light_(light), batch_(batch), cap_(local_cap(light, batch)), falloff_varies_(cap_.versine < Batch(0.0f)) {
    if (const auto* spot = std::get_if<SpotLight>(&light)) {
        falloff_ = {spot, batch.frame.to_local(broadcast(spot->direction))};
        const Batch cosine = -dot(falloff_.direction_local, cap_.axis), sine = safe_sqrt(Batch(1.0f) - sqr(cosine));
        const Batch turn = sqrt(sin2_half_angle(cap_)) * sine, rest = cosine * cos_half_angle(cap_);
        falloff_varies_ = spot_falloff(*spot, rest - turn) != spot_falloff(*spot, rest + turn);
    }
    if (batch.has_glossy) reflect_glossy(settings);
    if (batch.has_diffuse) reflect_diffuse();
}

void CapLightShading::reflect_glossy(const RenderSettings& settings) {
    exact_.emplace(ggx_cap_light(batch_.lobe, cap_));
    LobeIntegral<Batch> integral;
    if (settings.analytic_method == AnalyticMethod::sptd || settings.analytic_method == AnalyticMethod::ltc) {
        const bool is_sptd = settings.analytic_method == AnalyticMethod::sptd;
        const Batch share = is_sptd ? integrate_sptd(batch_, cap_) : integrate_ltc(batch_, cap_);
        // Fresnel at the light's point nearest the mirror direction.
        const Vec3b& wo = batch_.lobe.wo_local;
        const Vec3b nearest = nearest_in_cap(cap_, Vec3b(-wo.x, -wo.y, wo.z));
        const Batch plain = share * falloff_(nearest), cos_oh = abs(dot(wo, normalize(wo + nearest)));
        integral.sums = {plain, plain * schlick_weight(cos_oh),
                         plain * fresnel_dielectric_weight(cos_oh, batch_.lobe.ior)};
        integral.predicted_error = Batch(1.0f);
        integral.method = detail::number_of<Batch>(is_sptd ? Method::sptd : Method::ltc);
    } else {
        // EXACT takes the best there is
        const bool automatic = settings.analytic_method == AnalyticMethod::automatic;
        const Batch budget(automatic ? 0.01f * settings.error_budget_percent : 1e-4f);
        integral = integrate(*exact_, budget, falloff_, falloff_varies_);
    }
    put_glossy(batch_, integral, radiance_of(light_), reflection_);
}

void CapLightShading::reflect_diffuse() {
    const Vec3b normal(Batch(0.0f), Batch(0.0f), Batch(1.0f));
    Batch share = clamped_cosine_integral(cap_, normal) * Batch(1.0f / pi<float>);
    if (std::holds_alternative<SpotLight>(light_)) {
        Batch mean = falloff_(cap_.axis);
        if (any(falloff_varies_)) {
            // over the projected disk of the light
            const Frame<Batch> frame = frame_from_z(cap_.axis);
            Batch sum(0.0f), weights(0.0f);
            for (const Vec2f& xy : disk_rule<float, 16>()) {
                const Vec3b wi = frame.to_world(cap_point(cap_, xy));
                const Batch weight = max(wi.z, Batch(0.0f));
                sum += weight * falloff_(wi);
                weights += weight;
            }
            mean = select(weights > Batch(0.0f), sum / max(weights, tiny<Batch>), mean);
        }
        share *= mean;
    }
    const Lanes shares = store(share);
    const Rgb radiance = radiance_of(light_);
    for (std::size_t i = 0; i < batch_.count; ++i)
        reflection_.diffuse[i] = radiance * batch_.lanes[i]->surface.diffuse * shares[i];
}

Reflection CapLightShading::seen_by_rays(const Scene& scene, const FixedPoints& points) const {
    bool wants_diffuse = false, wants_glossy = false;
    for (std::size_t i = 0; i < batch_.count; ++i) {
        const float diffuse = max_component(reflection_.diffuse[i]), glossy = max_component(reflection_.glossy[i]);
        wants_diffuse |= diffuse > 0.05f * glossy;
        wants_glossy |= glossy > 0.05f * diffuse;
    }
    Reflection seen = reflection_;
    if (!wants_diffuse && !wants_glossy) return seen;

    // A first round finds what is all seen or all hidden; a second spends more where it is mixed.
    std::array<LaneShares, batch_size> shares{};
    const std::uint32_t all = points.count(), first = all < 8 ? all : all / 4;
    trace(scene, points, wants_diffuse, wants_glossy, {0, first, all}, shares);
    const bool mixed = std::any_of(shares.begin(), shares.end(), [](const LaneShares& s) { return s.is_mixed(); });
    if (mixed && first < all) trace(scene, points, wants_diffuse, wants_glossy, {first, all, all}, shares);
    for (std::size_t i = 0; i < batch_.count; ++i) {
        const auto& [diffuse, glossy] = shares[i];
        seen.diffuse[i] *= diffuse.all > 0.0f ? diffuse.value() : glossy.value();
        seen.glossy[i] *= glossy.all > 0.0f ? glossy.value() : diffuse.value();
    }
    return seen;
}

void CapLightShading::trace(const Scene& scene, const FixedPoints& points, bool wants_diffuse, bool wants_glossy,
                            const PointRange& range, std::array<LaneShares, batch_size>& shares) const {
    struct Probe {
        VisibleShare* share;
        float weight;
        bool is_faced;
    };
    std::vector<Ray> rays;
    std::vector<Probe> probes;
    const bool is_first = range.begin == 0;
    std::array<bool, batch_size> takes_part;
    for (std::size_t i = 0; i < batch_size; ++i) takes_part[i] = i < batch_.count && (is_first || shares[i].is_mixed());
    const auto add = [&](const Vec3b& wi_local, const Batch& weight, bool glossy) {
        const Vec3b wi = batch_.frame.to_world(wi_local);
        const Lanes x = store(wi.x), y = store(wi.y), z = store(wi.z), weights = store(weight);
        for (std::size_t i = 0; i < batch_.count; ++i) {
            if (!takes_part[i] || !(weights[i] > 0.0f)) continue;
            const SurfacePoint& point = batch_.lanes[i]->point;
            const Vec3f direction(x[i], y[i], z[i]);
            const float far_m = distance_to_light(light_, point.position, direction) * (1.0f - 1e-5f);
            rays.push_back({point.ray_origin(direction), direction, 0.0f, far_m});
            probes.push_back({glossy ? &shares[i].glossy : &shares[i].diffuse, weights[i], point.faces(direction)});
        }
    };
    const Frame<Batch> frame = frame_from_z(cap_.axis);
    const GgxAxes<Batch> axes = wants_glossy ? ellipse_axes(exact_->chart) : GgxAxes<Batch>{};
    for (std::uint32_t k = range.begin; k < range.end; ++k) {
        if (wants_diffuse) {
            const Vec2f xy = sample_disk(points.point(PointSet::light_diffuse, k, range.all));
            const Vec3b wi = frame.to_world(cap_point(cap_, xy));
            add(wi, max(wi.z, Batch(0.0f)) * falloff_(wi), false);
        }
        if (wants_glossy) {
            const Vec2f xy = sample_disk(points.point(PointSet::light_glossy, k, range.all));
            const auto point = lobe_point(*exact_, axes, {Batch(xy.x), Batch(xy.y)}, Batch(1.0f - dot(xy, xy)));
            add(point.omega_i, point.value * falloff_(point.omega_i), true);
        }
    }
    std::vector<std::uint8_t> occluded(rays.size());
    scene.occluded(rays, occluded);
    for (std::size_t r = 0; r < rays.size(); ++r) {
        probes[r].share->all += probes[r].weight;
        if (!occluded[r] && probes[r].is_faced) probes[r].share->seen += probes[r].weight;
    }
}

}  // namespace pivot
