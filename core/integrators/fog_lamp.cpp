#include "core/integrators/fog_lamp.h"

#include "core/media/phase_over_cap.h"
#include "core/sampling/warp.h"

namespace pivot {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

using Range = std::pair<float, float>;

std::optional<Range> within(const Range& a, const Range& b) {
    const Range both{std::max(a.first, b.first), std::min(a.second, b.second)};
    return both.first < both.second ? std::optional(both) : std::nullopt;
}

/// Where a ray is within the cone of all places that a spot's beam reaches: about a point behind its sphere.
std::optional<Range> within_cone(const SpotLight& spot, const Ray& ray) {
    constexpr Range everywhere{-infinity, infinity};
    const float cosine = spot.cos_half_angle;
    if (cosine <= 0.01f) return everywhere;
    const Vec3f apex =
        spot.sphere.center - spot.direction * (spot.sphere.radius_m / std::sqrt((1.0f - cosine) * (1.0f + cosine)));
    const Vec3f v = ray.origin - apex;
    const float c2 = cosine * cosine, dz = dot(ray.direction, spot.direction), vz = dot(v, spot.direction);
    const float a = dz * dz - c2, b = vz * dz - c2 * dot(v, ray.direction), c = vz * vz - c2 * length_squared(v);
    if (std::abs(a) < 1e-5f) return everywhere;
    const float root2 = b * b - a * c;
    if (root2 <= 0.0f) return a > 0.0f ? std::optional(everywhere) : std::nullopt;
    const float root = std::sqrt(root2), near = (-b - root) / a, far = (-b + root) / a;
    if (a > 0.0f) return dz > 0.0f ? Range{std::max(near, far), infinity} : Range{-infinity, std::min(near, far)};
    // Between the roots lies a piece of one nappe.
    return vz - b / a * dz > 0.0f ? std::optional(Range{std::min(near, far), std::max(near, far)}) : std::nullopt;
}

std::optional<Range> before_plane(const AreaLight& light, const Ray& ray) {
    const float height = dot(ray.origin - light.center, light.normal), rise = dot(ray.direction, light.normal);
    if (std::abs(rise) < 1e-7f) return height > 0.0f ? std::optional(Range{-infinity, infinity}) : std::nullopt;
    const float at = -height / rise;
    return rise > 0.0f ? Range{at, infinity} : Range{-infinity, at};
}

/// How far light travels through a medium from where it enters the box around it. inverse: of the way from there to the
/// light.
Batch length_within(const PlacedMedium& placed, const Vec3b& position, const Vec3b& inverse_wi,
                    const Batch& distance_m) {
    if (placed.low.x == -infinity) return distance_m;
    const auto exit = [](float low, float high, const Batch& at, const Batch& inverse) {
        return max((Batch(low) - at) * inverse, (Batch(high) - at) * inverse);
    };
    const Batch leaves = min(exit(placed.low.x, placed.high.x, position.x, inverse_wi.x),
                             min(exit(placed.low.y, placed.high.y, position.y, inverse_wi.y),
                                 exit(placed.low.z, placed.high.z, position.z, inverse_wi.z)));
    return max(min(leaves, distance_m), Batch(0.0f));
}

/// What the interval's media leave of light on its way to a place.
Vec3b transmittance_to(const FogPart& part, const Vec3b& position, const Vec3b& wi, const Batch& distance_m) {
    const auto inverse_of = [](const Batch& x) {
        return Batch(1.0f) / select(abs(x) < Batch(1e-12f), Batch(1e-12f), x);
    };
    const Vec3b inverse_wi(inverse_of(wi.x), inverse_of(wi.y), inverse_of(wi.z));
    Batch length_m(0.0f);
    for (const std::uint32_t id : part.ray.ids(part.interval))
        length_m = max(length_m, length_within(part.ray.media().at(id), position, inverse_wi, distance_m));
    return transmittance_over(part.mix.sigma_t, length_m);
}

/// sigma_s times each lobe's share of its light that comes from a cap.
Vec3b scattered_of_cap(const FogPart& part, const Cap<Batch>& cap, bool precisely) {
    const Vec3b direction = broadcast(part.ray.ray().direction);
    Vec3b sum(Batch(0.0f));
    for (const ScatterLobe& lobe : part.mix.lobes)
        sum += broadcast(lobe.sigma_s) * (precisely ? integrate_precisely(lobe.phase, direction, cap)
                                                    : integrate(lobe.phase, proxy_of(lobe.phase), direction, cap));
    return sum;
}

/// The mean of a spot's falloff over the cap that its sphere is.
Batch mean_falloff(const SpotLight& spot, const FogPart& part, const Cap<Batch>& cap, bool precisely) {
    const auto falloff = [&](const Vec3b& wi) { return spot_falloff(spot, -dot(wi, broadcast(spot.direction))); };
    const Frame<Batch> frame = frame_from_z(cap.axis);
    // Beside the lamp a beam is a small part of what it covers.
    const std::size_t count = !precisely ? 4 : any(cap.versine > Batch(0.02f)) ? 128 : 16;
    Batch sum(0.0f), weights(0.0f);
    for (std::size_t k = 0; k < count; ++k) {
        const Vec2f u = golden_point(static_cast<float>(k), count);
        const Batch versine = cap.versine * Batch(u.x);
        const Batch radius = safe_sqrt(versine * (Batch(2.0f) - versine));
        const float angle = 2.0f * pi<float> * u.y;
        const Vec3b wi =
            frame.to_world({Batch(std::cos(angle)) * radius, Batch(std::sin(angle)) * radius, Batch(1.0f) - versine});
        Batch weight(0.0f);
        for (const ScatterLobe& lobe : part.mix.lobes)
            weight += Batch(MediumMix::weight(lobe)) * eval(lobe.phase, broadcast(part.ray.ray().direction), wi);
        sum += weight * falloff(wi);
        weights += weight;
    }
    return sum / max(weights, tiny<Batch>);
}

Vec3b scattered_of(const SphereLight& light, const SpotLight* spot, const FogPart& part, const Vec3b& position,
                   bool precisely) {
    const Cap<Batch> cap = cap_from(light, position);
    Vec3b scattered = scattered_of_cap(part, cap, precisely) * broadcast(light.radiance);
    if (spot) scattered = scattered * mean_falloff(*spot, part, cap, precisely);
    return scattered;
}

Vec3b scattered_of(const SunLight& sun, const FogPart& part, bool precisely) {
    const Cap<Batch> cap{broadcast(sun.cap.axis), Batch(sun.cap.versine)};
    return scattered_of_cap(part, cap, precisely) * broadcast(sun.radiance);
}

Vec3b scattered_of(const AreaLight& light, const FogPart& part, const Vec3b& position, bool precisely) {
    const FogAreaView<Batch> view(light, position, broadcast(part.ray.ray().direction), part.mix.typical_g());
    const auto scattered = [&](const Vec3b& wi) {
        Vec3b sum(Batch(0.0f));
        for (const ScatterLobe& lobe : part.mix.lobes)
            sum += broadcast(lobe.sigma_s) * eval(lobe.phase, view.direction(), wi);
        if (light.inverse_tan_spread > 0.0f)
            sum = sum *
                  (precisely ? spread_falloff(Batch(light.inverse_tan_spread), wi.z) : view.light().spread_weight(wi));
        return sum;
    };
    return (precisely ? view.integrate<6>(scattered) : view.integrate<2>(scattered)) * broadcast(light.radiance);
}

}  // namespace

std::optional<Range> lit_part(const Light& lamp, const FogPart& part) {
    const MediumInterval& interval = part.ray.interval(part.interval);
    const Range whole{interval.near_m, interval.far_m};
    if (const auto* spot = std::get_if<SpotLight>(&lamp)) {
        const auto lit = within_cone(*spot, part.ray.ray());
        return lit ? within(whole, *lit) : std::nullopt;
    }
    if (const auto* area = std::get_if<AreaLight>(&lamp); area && !area->is_two_sided()) {
        const auto lit = before_plane(*area, part.ray.ray());
        return lit ? within(whole, *lit) : std::nullopt;
    }
    return whole;
}

DistanceMap distance_map(const Light& lamp, const FogPart& part, float near_m, float far_m) {
    const float sigma_t = mean_component(part.mix.sigma_t);
    if (std::holds_alternative<SunLight>(lamp)) return {near_m, far_m, sigma_t};
    const auto* area = std::get_if<AreaLight>(&lamp);
    const float size_m = area ? 0.5f * std::sqrt(area->area_m2) : sphere_of(lamp)->radius_m;
    const Vec3f center = area ? area->center : sphere_of(lamp)->center;
    const Ray& ray = part.ray.ray();
    const float along_m = dot(center - ray.origin, ray.direction);
    const float off_m = length(ray.origin + along_m * ray.direction - center);
    return {near_m, far_m, sigma_t, along_m, std::max(off_m, size_m), part.mix.typical_g()};
}

Vec3b scattered_light(const Light& lamp, const FogPart& part, const Batch& distance_m, bool precisely) {
    const Ray& ray = part.ray.ray();
    const Vec3b position = broadcast(ray.origin) + distance_m * broadcast(ray.direction);
    if (const auto* sun = std::get_if<SunLight>(&lamp)) return scattered_of(*sun, part, precisely);
    if (const auto* area = std::get_if<AreaLight>(&lamp)) return scattered_of(*area, part, position, precisely);
    return scattered_of(*sphere_of(lamp), std::get_if<SpotLight>(&lamp), part, position, precisely);
}

Vec3b transmittance_to_lamp(const Light& lamp, const FogPart& part, const Batch& distance_m) {
    const Ray& ray = part.ray.ray();
    const Vec3b position = broadcast(ray.origin) + distance_m * broadcast(ray.direction);
    if (const auto* sun = std::get_if<SunLight>(&lamp))
        return transmittance_to(part, position, broadcast(sun->cap.axis), std::numeric_limits<Batch>::infinity());
    const auto* area = std::get_if<AreaLight>(&lamp);
    const Vec3b d = broadcast(area ? area->center : sphere_of(lamp)->center) - position;
    const Batch reach_m = sqrt(max(length_squared(d), tiny<Batch>));
    return transmittance_to(part, position, d / reach_m, reach_m);
}

bool is_sharp_beside(const AreaLight& light, const MediumMix& mix, float distance_m) {
    const float reach_m = length(light.half_u) + length(light.half_v);
    for (const ScatterLobe& lobe : mix.lobes) {
        const float g = std::abs(lobe.phase.g), widths = 30.0f * (1.0f - g);
        if (g * sqr(reach_m) > sqr(widths * distance_m)) return true;
    }
    return false;
}

LampSamples sample_lamp(const Light& lamp, const MediumMix& mix, const Vec3b& position, const Vec3b& direction,
                        const Vec2b& u) {
    if (const auto* area = std::get_if<AreaLight>(&lamp)) {
        const auto s = FogAreaSampler<Batch>(*area, mix, position, direction).sample(u);
        return {s.wi, s.pdf_omega, s.distance_m, broadcast(area->radiance) * s.spread};
    }
    const PivotPhase<Batch> proxy{Batch(proxy_of(mix.lobes[0].phase).g_p)};
    const auto sample_cap = [&](const Cap<Batch>& cap) {
        const Vec3b wi = pivot::sample(proxy, direction, cap, u);
        return std::pair(wi, pdf_omega_uniform_inside(pivot(proxy, direction), cap, wi));
    };
    if (const auto* sun = std::get_if<SunLight>(&lamp)) {
        const auto [wi, pdf] = sample_cap({broadcast(sun->cap.axis), Batch(sun->cap.versine)});
        return {wi, pdf, std::numeric_limits<Batch>::infinity(), broadcast(sun->radiance)};
    }
    const SphereLight& sphere = *sphere_of(lamp);
    const Vec3b to_center = broadcast(sphere.center) - position;
    const auto [wi, pdf] = sample_cap(cap_from(sphere, position));
    Vec3b radiance = broadcast(sphere.radiance);
    if (const auto* spot = std::get_if<SpotLight>(&lamp))
        radiance = radiance * spot_falloff(*spot, -dot(wi, broadcast(spot->direction)));
    return {wi, pdf,
            sphere.is_facing_disk ? distance_to_facing_disk(to_center, wi)
                                  : distance_to_sphere(to_center, Batch(sphere.radius_m), wi),
            radiance};
}

FogLampSampler::FogLampSampler(const Light& lamp, const MediumMix& mix, const Vec3f& position, const Vec3f& direction,
                               LightSampling strategy)
    : lamp_(lamp),
      position_(position),
      direction_(direction),
      is_sampled_(strategy != LightSampling::bsdf),
      shares_(strategy != LightSampling::light),
      cap_(cap_from(lamp, position)) {
    if (strategy != LightSampling::joint && strategy != LightSampling::sptd) return;
    if (const auto* area = std::get_if<AreaLight>(&lamp)) {
        area_.emplace(*area, mix, position, direction);
        shares_ = is_sharp_beside(*area, mix, length(area->center - position));
    } else if (mix.lobes.size() <= max_lobes) {
        weigh_lobes(mix);
        shares_ = false;
    }
}

void FogLampSampler::weigh_lobes(const MediumMix& mix) {
    for (const ScatterLobe& lobe : mix.lobes) {
        const PivotPhase<float> proxy = proxy_of(lobe.phase);
        proxies_[count_] = proxy;
        const bool is_alone = mix.lobes.size() == 1;
        probability_[count_++] =
            is_alone ? 1.0f : MediumMix::weight(lobe) * integrate(lobe.phase, proxy, direction_, *cap_);
    }
    float total = 0.0f;
    for (std::size_t i = 0; i < count_; ++i) total += probability_[i];
    for (std::size_t i = 0; i < count_; ++i)
        probability_[i] = total > 0.0f ? probability_[i] / total : 1.0f / static_cast<float>(count_);
}

std::optional<LightPoint> FogLampSampler::sample(const Vec2f& u) const {
    if (!is_sampled_) return std::nullopt;
    if (area_) {
        const FogAreaSample<float> s = area_->sample(u);
        if (!(s.pdf_omega > 0.0f)) return std::nullopt;
        return LightPoint{s.wi, s.distance_m, std::get<AreaLight>(lamp_).radiance * s.spread, s.pdf_omega};
    }
    if (count_ == 0) return sample_light(lamp_, position_, u);
    // The first number chooses the lobe, and what is left of it the place within.
    float left = u.x;
    std::size_t chosen = 0;
    while (chosen + 1 < count_ && left >= probability_[chosen]) left -= probability_[chosen++];
    left = std::min(left / std::max(probability_[chosen], tiny<float>), 1.0f - 0x1p-24f);
    const Vec3f wi = pivot::sample(proxies_[chosen], direction_, *cap_, {left, u.y});
    LightPoint point = light_point_in_cap(lamp_, *cap_, position_, wi);
    point.pdf_omega = pdf_omega(point);
    return point;
}

float FogLampSampler::pdf_omega(const LightPoint& place) const {
    if (!is_sampled_) return 0.0f;
    if (area_) {
        const auto& light = std::get<AreaLight>(lamp_);
        return area_->pdf_omega(area_coordinates(light, position_ + place.distance_m * place.wi));
    }
    if (count_ == 0) return place.pdf_omega;
    float sum = 0.0f;
    for (std::size_t i = 0; i < count_; ++i)
        sum += probability_[i] * pdf_omega_uniform_inside(pivot(proxies_[i], direction_), *cap_, place.wi);
    return sum;
}

}  // namespace pivot
