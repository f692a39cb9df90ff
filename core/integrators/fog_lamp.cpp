#include "core/integrators/fog_lamp.h"

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
Vec3b scattered_of_cap(const FogPart& part, const Cap<Batch>& cap) {
    const Vec3b direction = broadcast(part.ray.ray().direction);
    Vec3b sum(Batch(0.0f));
    for (const ScatterLobe& lobe : part.mix.lobes)
        sum += broadcast(lobe.sigma_s) * integrate(lobe.phase, proxy_of(lobe.phase), direction, cap);
    return sum;
}

Vec3b scattered_of(const SphereLight& light, const SpotLight* spot, const FogPart& part, const Vec3b& position) {
    const Cap<Batch> cap = cap_from(light, position);
    Vec3b scattered = scattered_of_cap(part, cap) * broadcast(light.radiance);
    if (spot) {
        // Over the sphere's width the falloff is a mean of three places.
        const Batch cosine = -dot(cap.axis, broadcast(spot->direction));
        const Batch spread = Batch(0.7f) * sqrt(sin2_half_angle(cap)) * safe_sqrt(Batch(1.0f) - cosine * cosine);
        scattered *= (spot_falloff(*spot, cosine - spread) + spot_falloff(*spot, cosine) +
                      spot_falloff(*spot, min(cosine + spread, Batch(1.0f)))) *
                     Batch(1.0f / 3.0f);
    }
    return scattered;
}

Vec3b scattered_of(const SunLight& sun, const FogPart& part) {
    const Cap<Batch> cap{broadcast(sun.cap.axis), Batch(sun.cap.versine)};
    return scattered_of_cap(part, cap) * broadcast(sun.radiance);
}

/// By four places on the light.
Vec3b scattered_of(const AreaLight& light, const FogPart& part, const Vec3b& position) {
    const float offset = light.shape == AreaShape::ellipse ? 0.5f : 0.57735f;
    const Batch least2(light.area_m2 / 16.0f);
    Vec3b sum(Batch(0.0f));
    for (const float x : {-offset, offset}) {
        for (const float y : {-offset, offset}) {
            const Vec3b d = broadcast(light.center + x * light.half_u + y * light.half_v) - position;
            const Batch r2 = max(length_squared(d), tiny<Batch>);
            const Vec3b wi = d * inverse_sqrt(r2);
            const Batch facing = max(-dot(wi, broadcast(light.normal)), Batch(0.0f));
            const Batch mu = dot(wi, broadcast(part.ray.ray().direction));
            Vec3b scattered(Batch(0.0f));
            for (const ScatterLobe& lobe : part.mix.lobes) scattered += broadcast(lobe.sigma_s) * eval(lobe.phase, mu);
            sum += scattered * (facing * Batch(0.25f * light.area_m2) / max(r2, least2));
        }
    }
    return sum * broadcast(light.radiance);
}

/// The sharpest of the lobes as its pivot of the circle; nearer to 0 where lobes differ.
float typical_g(const MediumMix& mix) {
    float sum = 0.0f;
    for (const ScatterLobe& lobe : mix.lobes) sum += MediumMix::weight(lobe) * lobe.phase.g;
    return std::clamp(sum / mix.total_weight, -0.98f, 0.98f);
}

}  // namespace

std::optional<Range> lit_part(const Light& lamp, const FogPart& part) {
    const MediumInterval& interval = part.ray.interval(part.interval);
    const Range whole{interval.near_m, interval.far_m};
    if (const auto* spot = std::get_if<SpotLight>(&lamp)) {
        const auto lit = within_cone(*spot, part.ray.ray());
        return lit ? within(whole, *lit) : std::nullopt;
    }
    if (const auto* area = std::get_if<AreaLight>(&lamp)) {
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
    return {near_m, far_m, sigma_t, along_m, std::max(off_m, size_m), typical_g(part.mix)};
}

Vec3b scattered_light(const Light& lamp, const FogPart& part, const Batch& distance_m) {
    const Ray& ray = part.ray.ray();
    const Vec3b position = broadcast(ray.origin) + distance_m * broadcast(ray.direction);
    if (const auto* sun = std::get_if<SunLight>(&lamp)) return scattered_of(*sun, part);
    if (const auto* area = std::get_if<AreaLight>(&lamp)) return scattered_of(*area, part, position);
    return scattered_of(*sphere_of(lamp), std::get_if<SpotLight>(&lamp), part, position);
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

FogLampSampler::FogLampSampler(const Light& lamp, const MediumMix& mix, const Vec3f& position, const Vec3f& direction,
                               LightSampling strategy)
    : lamp_(lamp),
      mix_(mix),
      position_(position),
      direction_(direction),
      is_sampled_(strategy != LightSampling::bsdf),
      cap_(cap_from(lamp, position)) {
    const bool is_joint = strategy == LightSampling::joint || strategy == LightSampling::sptd;
    shares_ = strategy != LightSampling::light && !(is_joint && cap_);
    if (!is_joint || !cap_ || mix.lobes.size() > max_lobes) return;
    is_joint_ = true;
    float total = 0.0f;
    for (const ScatterLobe& lobe : mix.lobes) {
        const PivotPhase<float> proxy = proxy_of(lobe.phase);
        const float share = MediumMix::weight(lobe) * integrate(lobe.phase, proxy, direction, *cap_);
        lobes_[lobe_count_++] = {proxy, share};
        total += share;
    }
    for (std::size_t i = 0; i < lobe_count_; ++i)
        lobes_[i].probability = total > 0.0f ? lobes_[i].probability / total : 1.0f / static_cast<float>(lobe_count_);
}

std::optional<LightPoint> FogLampSampler::sample(const Vec2f& u) const {
    if (!is_sampled_) return std::nullopt;
    if (!is_joint_) return sample_light(lamp_, position_, u);
    float left = u.x;
    std::size_t chosen = 0;
    while (chosen + 1 < lobe_count_ && left >= lobes_[chosen].probability) left -= lobes_[chosen++].probability;
    const float place = std::min(left / std::max(lobes_[chosen].probability, tiny<float>), 1.0f - 0x1p-24f);
    const Vec3f wi = pivot::sample(lobes_[chosen].proxy, direction_, *cap_, {place, u.y});
    LightPoint point = light_point_in_cap(lamp_, *cap_, position_, wi);
    point.pdf_omega = pdf_omega(point);
    return point;
}

float FogLampSampler::pdf_omega(const LightPoint& place) const {
    if (!is_sampled_) return 0.0f;
    if (!is_joint_) return place.pdf_omega;
    float sum = 0.0f;
    for (std::size_t i = 0; i < lobe_count_; ++i)
        sum += lobes_[i].probability * pdf_omega_uniform_inside(pivot(lobes_[i].proxy, direction_), *cap_, place.wi);
    return sum;
}

}  // namespace pivot
