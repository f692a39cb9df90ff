#include <numeric>

#include "core/integrators/fog.h"
#include "core/integrators/light_choice.h"

namespace pivot {
namespace {

/// The sharper the phase functions, the more nodes.
std::size_t node_count(const MediumMix& mix) {
    float sharpest = 0.0f;
    for (const ScatterLobe& lobe : mix.lobes) sharpest = std::max(sharpest, std::abs(lobe.phase.g));
    return sharpest > 0.95f ? 32 : sharpest > 0.85f ? 16 : 8;
}

/// So many places of a camera's ray look for lamps, or a few more.
constexpr float places_of_camera_ray = 8.0f;

float wrap(float x) { return std::min(x - std::floor(x), 1.0f - 0x1p-24f); }

}  // namespace

void Fog::add_candidates(const Light& lamp, const Path& path) {
    for (std::size_t i = 0; i < ray_.size(); ++i) {
        const Rgb before = path.throughput * ray_.before(i);
        if (!(max_component(before) > 0.0f)) return;
        ray_.set_typical_mix(i, mix_);
        if (!mix_.scatters() || !is_receiver(links_of(place_of(lamp)), ray_.link_sets_in(i))) continue;
        const FogPart part{ray_, i, mix_};
        const auto lit = lit_part(lamp, part);
        if (!lit) continue;
        const Vec3b worth = broadcast(before);
        const bool is_even = ray_.is_homogeneous(i);
        // Where the density varies its integral is summed from node to node.
        float depth_m = 0.0f, reached_m = ray_.interval(i).near_m, density_there = 1.0f;
        const auto scattered = [&](const Batch& distance_m) {
            Vec3b light =
                worth * scattered_light(lamp, part, distance_m) * transmittance_to_lamp(lamp, part, distance_m);
            Batch length_m = distance_m - Batch(ray_.interval(i).near_m);
            if (!is_even) {
                const Batch relative = ray_.relative_density(i, mix_, distance_m);
                const Lanes distances = store(distance_m), densities = store(relative);
                Lanes depths;
                for (std::size_t k = 0; k < batch_size; ++k) {
                    depth_m += 0.5f * (density_there + densities[k]) * (distances[k] - reached_m);
                    reached_m = distances[k], density_there = densities[k], depths[k] = depth_m;
                }
                length_m = load(depths);
                light = light * relative;
            }
            return mean_component(abs(light * transmittance_over(mix_.sigma_t, length_m)));
        };
        const std::size_t nodes = is_even ? node_count(mix_) : ScatterTable::max_nodes;
        const ScatterTable table(distance_map(lamp, part, lit->first, lit->second), nodes, scattered);
        if (table.sum() > 0.0f) candidates_.push_back({&lamp, i, table});
    }
}

void Fog::sample_candidates(std::span<const Candidate> candidates, std::uint32_t bounce, const Path& path, float weight,
                            std::uint32_t place, std::uint32_t count) {
    float total = 0.0f;
    for (const Candidate& candidate : candidates) total += candidate.table.sum();
    const Sampler& sampler = work_.samplers[path.sample];
    const std::uint32_t dimension = FogDimensions(bounce, part_).lamp(place);
    const Vec2f u = sampler.point(dimension), u_light = sampler.point(dimension + 1);
    // Evenly spread along the ray, so that what hides a part of it hides the same part of them.
    const LightSampling strategy = work_.settings.light_sampling;
    if (candidates.size() == 1 && weight == 1.0f && ray_.is_homogeneous() &&
        (strategy == LightSampling::joint || strategy == LightSampling::sptd) &&
        !has_blockers_of_its_own(links_of(place_of(*candidates[0].lamp))) &&
        !work_.scene.lamp_shader(place_of(*candidates[0].lamp))) {
        ray_.set_typical_mix(candidates[0].interval, mix_);
        if (mix_.lobes.size() == 1 && !is_sharp_along_ray(candidates[0])) {
            const std::uint32_t batches = (count + batch_size - 1) / batch_size;
            for (std::uint32_t i = 0; i < batches; ++i)
                sample_places(candidates[0], u, u_light, i * batch_size, batches * batch_size, bounce, path, dimension);
            return;
        }
    }
    std::size_t mixed = ray_.size();  // the interval that mix_ is of
    for (std::uint32_t k = 0; k < count; ++k) {
        float left = (static_cast<float>(k) + u.x) / static_cast<float>(count) * total;
        std::size_t chosen = 0;
        while (chosen + 1 < candidates.size() && left >= candidates[chosen].table.sum())
            left -= candidates[chosen++].table.sum();
        const float sum = candidates[chosen].table.sum();
        const ScatterTable::Place at = candidates[chosen].table.sample(std::min(left / sum, 1.0f - 0x1p-24f));
        if (!is_usable(at.pdf_m) || !std::isfinite(at.distance_m)) continue;
        const Vec2f turned(wrap(u_light.x + 0.7548777f * static_cast<float>(k)),
                           wrap(u_light.y + 0.5698403f * static_cast<float>(k)));  // R2's ratios
        const float share = weight * total / (sum * at.pdf_m * static_cast<float>(count));
        if (candidates[chosen].interval != mixed || !ray_.is_homogeneous())
            ray_.set_mix_at(mixed = candidates[chosen].interval, at.distance_m, mix_);
        if (mix_.scatters()) sample_place(candidates[chosen], at.distance_m, share, turned, bounce, path, dimension);
    }
}

void Fog::sample_places(const Candidate& candidate, const Vec2f& u, const Vec2f& u_light, std::uint32_t first,
                        std::uint32_t count, std::uint32_t bounce, const Path& path, std::uint32_t dimension) {
    const Sampler& sampler = work_.samplers[path.sample];
    const Batch k = gather([&](std::size_t i) { return static_cast<float>(first + i); });
    const auto turned = [&](float from, float ratio) {
        const Batch x = Batch(from) + Batch(ratio) * k;
        return min(x - floor(x), Batch(1.0f - 0x1p-24f));
    };
    const ScatterTable::PlaceLanes at = candidate.table.sample((k + Batch(u.x)) / Batch(static_cast<float>(count)));
    const Vec3b direction = broadcast(ray_.ray().direction);
    const Vec3b position = broadcast(ray_.ray().origin) + at.distance_m * direction;
    const MediumInterval& interval = ray_.interval(candidate.interval);
    const LampSamples lamp = sample_lamp(*candidate.lamp, mix_, position, direction,
                                         {turned(u_light.x, 0.7548777f), turned(u_light.y, 0.5698403f)});
    const Batch pdf = lamp.pdf_omega * at.pdf_m * Batch(static_cast<float>(count)), zero(0.0f);
    const BatchMask is_usable = pdf > zero && pdf <= std::numeric_limits<Batch>::max() &&
                                at.distance_m < std::numeric_limits<Batch>::infinity();
    const RayOf<Batch> rays{.origin = position,
                            .direction = lamp.wi,
                            .near_m = zero,
                            .far_m = select(is_usable, lamp.distance_m * Batch(shadow_reach), zero),
                            .time = Batch(ray_.ray().time)};
    const bool casts = casts_shadows(*candidate.lamp);
    const Batch visible = casts ? work_.scene.visibility(rays) : Batch(1.0f);
    const Batch seen = select(is_usable, visible * eval(mix_.lobes[0].phase, direction, lamp.wi) / pdf, zero);
    if (!any(seen > zero)) return;
    Vec3b left = transmittance_over(mix_.sigma_t, at.distance_m - Batch(interval.near_m));
    if (casts)
        left = left * pivot::transmittance(work_.scene.media(), rays,
                                           WordBatch(stream_seed(sampler, dimension)) + WordBatch(first));
    if (casts && work_.scene.has_transparency()) {
        RayOf<Batch> open = rays;
        open.far_m = select(seen > zero, rays.far_m, zero);
        const ShadowPath shadow_path{work_.settings.max_passages, bounce, WordBatch(camera_ray)};
        left = left * light_through(work_.scene, open, shadow_path, work_.memory);
    }
    const Vec3b light = select(seen > zero, left * lamp.radiance * seen, Vec3b(zero));
    const auto sum = [](const Batch& batch) {
        const Lanes lanes = store(batch);
        return std::accumulate(lanes.begin(), lanes.end(), 0.0f);
    };
    add_light(bounce, path.sample, work_.scene.light_group_of(place_of(*candidate.lamp)),
              path.throughput * ray_.before(candidate.interval) * mix_.lobes[0].sigma_s *
                  Rgb(sum(light.x), sum(light.y), sum(light.z)));
}

void Fog::sample_place(const Candidate& candidate, float distance_m, float weight, const Vec2f& u, std::uint32_t bounce,
                       const Path& path, std::uint32_t dimension) {
    const std::size_t i = candidate.interval;
    const Vec3f position = ray_.position(distance_m), direction = ray_.ray().direction;
    const Rgb worth =
        path.throughput * ray_.before(i) * ray_.transmittance(i, ray_.interval(i).near_m, distance_m) * weight;
    const FogLampSampler lamp(*candidate.lamp, mix_, position, direction, work_.settings.light_sampling);
    const auto add = [&](const LightPoint& point, float pdf) {
        if (!is_usable(pdf)) return;
        const Rgb left =
            work_.scene.lamp_share(place_of(*candidate.lamp), position, point.wi, bounce + 1, work_.memory.registers);
        shadows_.push_back({.ray = {.origin = position,
                                    .direction = point.wi,
                                    .near_m = 0.0f,
                                    .far_m = point.distance_m * shadow_reach,
                                    .time = ray_.ray().time},
                            .light = worth * mix_.scattered(direction, point.wi) * point.radiance * left / pdf,
                            .bounce = bounce,
                            .sample = path.sample,
                            .dimension = dimension,
                            .group = work_.scene.light_group_of(place_of(*candidate.lamp)),
                            .links = links_of(place_of(*candidate.lamp)),
                            .is_open = !casts_shadows(*candidate.lamp)});
    };
    const bool shares = lamp.shares_with_phase();
    const auto phase_pdf = [&](const Vec3f& wi) { return mix_.pdf_omega(direction, wi); };
    if (const auto point = lamp.sample(u)) add(*point, point->pdf_omega + (shares ? phase_pdf(point->wi) : 0.0f));
    if (!shares) return;
    const Vec2f u_phase = work_.samplers[path.sample].point(dimension + 2);
    const Vec3f wi = sample(mix_.choose(u.y).phase, direction, {wrap(u_phase.x + u.x), u_phase.y});
    if (const auto point = intersect_light(*candidate.lamp, position, wi))
        add(*point, lamp.pdf_omega(*point) + phase_pdf(wi));
}

bool Fog::is_sharp_along_ray(const Candidate& candidate) const {
    const auto* area = std::get_if<AreaLight>(candidate.lamp);
    if (!area) return false;
    const Ray& ray = ray_.ray();
    const MediumInterval& interval = ray_.interval(candidate.interval);
    const float nearest_m = std::clamp(dot(area->center - ray.origin, ray.direction), interval.near_m, interval.far_m);
    return is_sharp_beside(*area, mix_, length(ray.origin + nearest_m * ray.direction - area->center));
}

std::size_t Fog::place_of(const Light& lamp) const {
    return static_cast<std::size_t>(&lamp - work_.scene.lamps().data());
}

bool Fog::casts_shadows(const Light& lamp) const {
    return !work_.scene.has_light_rules() || work_.scene.rules_of(place_of(lamp)).casts_shadows;
}

std::pair<std::size_t, float> Fog::choose_lamp(float u, float u_place) {
    // Seen from a place that light is likely to come from: where the ray would end if it were stopped.
    float wanted = u_place * (1.0f - mean_component(ray_.through()));
    std::size_t i = 0;
    const auto stopped_in = [&](std::size_t k) { return mean_component(ray_.before(k) - ray_.before(k + 1)); };
    for (; i + 1 < ray_.size() && wanted >= stopped_in(i); ++i) wanted -= stopped_in(i);
    ray_.set_typical_mix(i, mix_);
    const MediumInterval& interval = ray_.interval(i);
    const float before = std::max(mean_component(ray_.before(i)), tiny<float>);
    const float depth = -std::log1p(-std::min(wanted / before, 1.0f - 0x1p-24f));
    const float along_m = depth / std::max(mean_component(mix_.sigma_t), tiny<float>);
    const float most_m = std::min(interval.far_m - interval.near_m, 1e6f);
    return choose_light(work_.scene.lamp_tree(), ray_.position(interval.near_m + std::min(along_m, most_m)), u);
}

void Fog::sample_lamps(std::uint32_t bounce, const Path& path) {
    const std::span<const Light> lamps = work_.scene.lamps();
    candidates_.clear();
    if (lamps.size() <= max_lamp_samples) {
        for (const Light& lamp : lamps)
            if (is_lit_by(place_of(lamp), bounce)) add_candidates(lamp, path);
        if (candidates_.empty()) return;
        if (bounce > 0) return sample_candidates(candidates_, bounce, path, 1.0f, 0, 1);
        // A camera's ray samples each lamp, by what it scatters of it.
        float total = 0.0f;
        for (const Candidate& candidate : candidates_) total += candidate.table.sum();
        for (std::size_t first = 0, end; first < candidates_.size(); first = end) {
            float sum = 0.0f;
            for (end = first; end < candidates_.size() && candidates_[end].lamp == candidates_[first].lamp; ++end)
                sum += candidates_[end].table.sum();
            const auto count = static_cast<std::uint32_t>(std::ceil(places_of_camera_ray * sum / total));
            const auto lamp = static_cast<std::uint32_t>(place_of(*candidates_[first].lamp));
            sample_candidates(std::span(candidates_).subspan(first, end - first), bounce, path, 1.0f, lamp, count);
        }
        return;
    }
    const std::uint32_t count = bounce == 0 ? max_lamp_samples : 1;
    const Vec2f u = work_.samplers[path.sample].point(FogDimensions(bounce, part_).lamp_choice());
    for (std::uint32_t k = 0; k < count; ++k) {
        const auto [lamp, probability] = choose_lamp((static_cast<float>(k) + u.x) / static_cast<float>(count),
                                                     wrap(u.y + 0.618034f * static_cast<float>(k)));
        if (!(probability > 0.0f) || !is_lit_by(lamp, bounce)) continue;
        candidates_.clear();
        add_candidates(lamps[lamp], path);
        if (candidates_.empty()) continue;
        sample_candidates(candidates_, bounce, path, 1.0f / (probability * static_cast<float>(count)), k, 1);
    }
}

}  // namespace pivot
