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
        cap = cap_from(*sphere, batch.position);
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
        const Base& surface = batch.lanes[i]->surface;
        const GgxLtc lobe = ggx_ltc(surface.alpha, surface.wo_local);
        integral[i] =
            lobe.amplitude() * integrate_above_horizon(lobe.lobe_local, Cap<float>{{x[i], y[i], z[i]}, versine[i]});
    }
    return load(integral);
}

/// Relative, of taking F82's weight at the mean s of Schlick's: its second derivative by s, times half the variance of
/// s over microfacets as rough as these; of rough ones a light picks some.
float error_of_f82(const Base& surface, const LobeSums<float>& sums, const Rgb& reflected) {
    const float s = std::clamp(sums.schlick / std::max(sums.plain, tiny<float>), 1e-6f, 1.0f);
    const float bend = std::abs(0.24f * std::pow(s, -0.8f) - 0.56f * std::pow(s, -0.6f));
    const float m = std::pow(s, 0.2f), sin2_oh = 1.0f - sqr(1.0f - m);
    const float variance = sqr(5.0f * sqr(sqr(m))) * sin2_oh * sqr(0.5f * std::min(surface.alpha, 0.25f));
    const float off = 0.5f * bend * variance * sums.plain * mean_component(surface.fresnel.conductor_dip);
    return off / std::max(mean_component(reflected), tiny<float>);
}

}  // namespace

void put_glossy(const SurfaceBatch& batch, const LobeIntegral<Batch>& integral, const Rgb& radiance,
                Reflection& reflection) {
    const Lanes plain = store(integral.sums.plain), schlick = store(integral.sums.schlick),
                dielectric = store(integral.sums.dielectric), method = store(integral.method);
    reflection.glossy_error = store(integral.predicted_error);
    for (std::size_t i = 0; i < batch.count; ++i) {
        const Base& surface = batch.lanes[i]->surface;
        reflection.method[i] = static_cast<Method>(method[i]);
        if (!surface.has_glossy()) continue;
        const LobeSums<float> sums{plain[i], schlick[i], dielectric[i]};
        const Rgb reflected = reflected_by(surface.fresnel, sums);
        reflection.glossy[i] = radiance * reflected;
        if (surface.fresnel.has_dip()) reflection.glossy_error[i] += error_of_f82(surface, sums, reflected);
    }
}

CapLightShading::CapLightShading(const Light& light, const SurfaceBatch& batch, const RenderSettings& settings)
    : light_(light),
      batch_(batch),
      cap_(local_cap(light, batch)),
      budget_(budget_of(settings)),
      falloff_varies_(cap_.versine < Batch(0.0f)),
      has_edge_(falloff_varies_) {
    if (const auto* spot = std::get_if<SpotLight>(&light)) {
        falloff_ = {spot, batch.frame.to_local(broadcast(spot->direction))};
        span_ = beam_span(-falloff_.direction_local, cap_);
        const Batch low = spot_falloff(*spot, span_.low), high = spot_falloff(*spot, span_.high);
        falloff_varies_ = low != high;
        falloff_error_ = error_of_falloff(high - low, (span_.high - span_.low) / Batch(spot_falloff_width(*spot)),
                                          falloff_(cap_.axis));
        has_edge_ = falloff_varies_ && falloff_error_ > budget_;
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
        integral = integrate(*exact_, budget_, falloff_, falloff_varies_ && !has_edge_);
        integral.predicted_error += select(falloff_varies_ && !has_edge_, falloff_error_, Batch(0.0f));
        if (any(has_edge_)) cut_by_beam(integral);
    }
    put_glossy(batch_, integral, radiance_of(light_), reflection_);
}

void CapLightShading::cut_by_beam(LobeIntegral<Batch>& integral) const {
    const SpotLight& spot = *falloff_.spot;
    // A light around -wo has no disk to cut: what the beam leaves of it is guessed from the beam at its centre.
    const BatchMask on_disk = has_edge_ && !exact_->surrounds;
    const LobeIntegral<Batch> whole = integrate(*exact_, budget_);
    LobeSums<Batch> sums = whole.sums * spot_falloff(spot, span_.low);
    for_each_layer<beam_layers>(spot, span_, [&](const Batch& cosine, const Batch& rise) {
        const Cap<Batch> cone{-falloff_.direction_local, Batch(1.0f) - cosine};
        sums += integrate_within(*exact_, cone, budget_, on_disk) * rise;
    });
    const Batch guessed = falloff_(cap_.axis);
    sums = select<Batch>(on_disk, sums, whole.sums * guessed);
    const Batch error = select(exact_->crosses, Batch(error_of_beam_across_horizon), error_of_slices(budget_));
    integral.sums = select<Batch>(has_edge_, sums, integral.sums);
    integral.predicted_error =
        select(has_edge_, select(on_disk, error, max(guessed, Batch(1.0f) - guessed)), integral.predicted_error);
    integral.method = select(has_edge_, detail::number_of<Batch>(Method::beam_layers), integral.method);
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
        share = select(has_edge_, cosine_in_beam(share), share * mean);
        reflection_.diffuse_error =
            store(select(falloff_varies_, select(has_edge_, Batch(error_of_beam_layers), falloff_error_), Batch(0.0f)));
    }
    const Lanes shares = store(share);
    const Rgb radiance = radiance_of(light_);
    for (std::size_t i = 0; i < batch_.count; ++i)
        reflection_.diffuse[i] = radiance * batch_.lanes[i]->surface.diffuse * shares[i];
}

Batch CapLightShading::cosine_in_beam(Batch whole) const {
    const SpotLight& spot = *falloff_.spot;
    const Vec3f normal(0.0f, 0.0f, 1.0f);
    const auto wanted = store(has_edge_);
    const Lanes axis_x = store(cap_.axis.x), axis_y = store(cap_.axis.y), axis_z = store(cap_.axis.z);
    const Lanes versine = store(cap_.versine), low = store(span_.low), high = store(span_.high);
    const Vec3b to_beam = -falloff_.direction_local;
    const Lanes beam_x = store(to_beam.x), beam_y = store(to_beam.y), beam_z = store(to_beam.z);
    Lanes sums = store(whole * spot_falloff(spot, span_.low));
    for (std::size_t i = 0; i < batch_.count; ++i) {
        if (!wanted[i]) continue;
        const Cap<float> cap{{axis_x[i], axis_y[i], axis_z[i]}, versine[i]};
        for_each_layer<beam_layers>(spot, BeamSpan<float>{low[i], high[i]}, [&](float cosine, float rise) {
            const std::array<Cap<float>, 2> both{cap, {{beam_x[i], beam_y[i], beam_z[i]}, 1.0f - cosine}};
            sums[i] += rise * clamped_cosine_integral(both, normal) / pi<float>;
        });
    }
    return load(sums);
}

Reflection CapLightShading::seen_by_rays(const Scene& scene, const ShadowPoints& points,
                                         std::span<const float> totals) const {
    bool wants_diffuse = false, wants_glossy = false;
    for (std::size_t i = 0; i < batch_.count; ++i) {
        const float diffuse = max_component(abs(reflection_.diffuse[i]));
        const float glossy = max_component(abs(reflection_.glossy[i]));
        wants_diffuse |= diffuse > 0.05f * glossy;
        wants_glossy |= glossy > 0.05f * diffuse;
    }
    if (!wants_diffuse && !wants_glossy) return reflection_;

    std::array<LaneShares, batch_size> shares{};
    const Frame<Batch> frame = frame_from_z(cap_.axis);
    const GgxAxes<Batch> axes = wants_glossy ? ellipse_axes(exact_->chart) : GgxAxes<Batch>{};
    const ShadowPoints diffuse_points = points.for_share(largest_share(reflection_.diffuse, totals));
    const ShadowPoints glossy_points = points.for_share(largest_share(reflection_.glossy, totals));
    const auto add_points = [&](const PartOfPoints& part, std::span<const bool> wanted, ShadowRays& rays) {
        const auto add = [&](const Vec3b& wi_local, const Batch& weight, VisibleShare LaneShares::*of) {
            const Vec3b wi = batch_.frame.to_world(wi_local);
            const Lanes x = store(wi.x), y = store(wi.y), z = store(wi.z), weights = store(weight);
            for (std::size_t i = 0; i < batch_.count; ++i) {
                if (!wanted[i] || !(weights[i] > 0.0f)) continue;
                const SurfacePoint& point = batch_.lanes[i]->point;
                const Vec3f direction(x[i], y[i], z[i]);
                const float far_m = distance_to_light(light_, point.position, direction) * (1.0f - 1e-5f);
                rays.add({point.ray_origin(direction), direction, 0.0f, far_m, point.time}, point.faces(direction),
                         {&shares[i], of == &LaneShares::diffuse ? weights[i] : 0.0f,
                          of == &LaneShares::glossy ? weights[i] : 0.0f, of == &LaneShares::rim ? weights[i] : 0.0f});
            }
        };
        for (std::uint32_t k = 0; part.asks_rim() && k < rim_points; ++k) {
            const Vec3b wi = frame.to_world(cap_point(cap_, rim_point(k)));
            add(wi, max(wi.z, Batch(0.0f)), &LaneShares::rim);
        }
        if (wants_diffuse) {
            const auto [begin, end] = diffuse_points.range(part);
            for (std::uint32_t k = begin; k < end; ++k) {
                const Vec3b wi =
                    frame.to_world(cap_point(cap_, sample_disk(diffuse_points.point(PointSet::light_diffuse, k))));
                add(wi, max(wi.z, Batch(0.0f)) * falloff_(wi), &LaneShares::diffuse);
            }
        }
        if (wants_glossy) {
            const auto [begin, end] = glossy_points.range(part);
            for (std::uint32_t k = begin; k < end; ++k) {
                const Vec2f xy = sample_disk(glossy_points.point(PointSet::light_glossy, k));
                const auto point = lobe_point(*exact_, axes, {Batch(xy.x), Batch(xy.y)}, Batch(1.0f - dot(xy, xy)));
                add(point.omega_i, point.value * falloff_(point.omega_i), &LaneShares::glossy);
            }
        }
    };
    const std::span<LaneShares> lanes = std::span(shares).first(batch_.count);
    ask_points(scene, points, std::min(diffuse_points.first_part(), glossy_points.first_part()), lanes, add_points);
    return seen_in_part(reflection_, lanes, points);
}

}  // namespace pivot
