#include "core/integrators/fog.h"

#include "core/integrators/direct_light.h"
#include "core/integrators/light_choice.h"
#include "core/integrators/transmittance.h"

namespace pivot {
namespace {

constexpr std::size_t max_waiting_shadows = 1024;

/// The sampler's dimensions that media take of a bounce, past those of surfaces.
struct FogDimensions {
    std::uint32_t base;

    explicit FogDimensions(std::uint32_t bounce) : base((1u << 16) + bounce * (8 + 3 * max_lamp_samples)) {}

    std::uint32_t collision() const { return base; }
    std::uint32_t lobe() const { return base + 1; }
    std::uint32_t direction() const { return base + 2; }
    std::uint32_t lamp_choice() const { return base + 3; }
    std::uint32_t triangle_choice() const { return base + 4; }
    std::uint32_t triangle_place() const { return base + 5; }
    std::uint32_t world() const { return base + 6; }
    std::uint32_t survival() const { return base + 7; }
    std::uint32_t lamp(std::uint32_t place) const { return base + 8 + 3 * place; }  ///< three
};

/// The sharper the phase functions, the more nodes.
std::size_t node_count(const MediumMix& mix) {
    float sharpest = 0.0f;
    for (const ScatterLobe& lobe : mix.lobes) sharpest = std::max(sharpest, std::abs(lobe.phase.g));
    return sharpest > 0.95f ? 32 : sharpest > 0.85f ? 16 : 8;
}

/// exp(-sigma_t length), where 0 times an endless length is 0.
Rgb transmittance_over(const Rgb& sigma_t, float length_m) {
    Rgb left(1.0f);
    for (int c = 0; c < 3; ++c)
        if (sigma_t[c] > 0.0f) left[c] = std::exp(-sigma_t[c] * length_m);
    return left;
}

Vec3b transmittance_over(const Rgb& sigma_t, const Batch& length_m) {
    const auto left = [&](float sigma) { return exp(Batch(-sigma) * length_m); };
    const Batch red = left(sigma_t.x);
    if (sigma_t.x == sigma_t.y && sigma_t.x == sigma_t.z) return Vec3b(red);
    return {red, left(sigma_t.y), left(sigma_t.z)};
}

/// About a direction of travel, by the phase function's cosine.
Vec3f around(const Vec3f& direction, const Vec2f& cos_sin, float u) {
    const float phi = 2.0f * pi<float> * u;
    return frame_from_z(direction).to_world({cos_sin.y * std::cos(phi), cos_sin.y * std::sin(phi), cos_sin.x});
}

/// Radiance that a ray's vertex adds is not certain to be finite where densities underflow.
bool is_usable(float pdf) { return pdf > 0.0f && std::isfinite(pdf); }

}  // namespace

Rgb Fog::transmittance(const Ray& ray) { return pivot::transmittance(work_.scene.media(), ray, along_, mix_); }

void Fog::set_mix_in(const MediumInterval& interval, const Ray& ray) {
    set_mix(mix_, work_.scene.media(), along_.active_in(interval), ray.origin);
}

Rgb Fog::cross(const Ray& ray, std::uint32_t bounce, const Path& path) {
    work_.scene.media().find_along(ray, along_);
    if (along_.intervals.empty()) return Rgb(1.0f);
    transmittance_.assign(1, Rgb(1.0f));
    Rgb emitted(0.0f);
    bool scatters = false;
    for (const MediumInterval& interval : along_.intervals) {
        set_mix_in(interval, ray);
        const float length_m = interval.far_m - interval.near_m;
        const Rgb left = transmittance_over(mix_.sigma_t, length_m);
        for (int c = 0; c < 3; ++c) {
            if (mix_.emission[c] == 0.0f) continue;
            const float sigma = mix_.sigma_t[c], depth = sigma * length_m;
            emitted[c] += transmittance_.back()[c] * mix_.emission[c] *
                          (depth > 1e-3f ? -std::expm1(-depth) / sigma : length_m * (1.0f - 0.5f * depth));
        }
        scatters = scatters || mix_.scatters();
        transmittance_.push_back(transmittance_.back() * left);
    }
    if (max_component(abs(emitted)) > 0.0f) {
        const Rgb light = bounded(work_.settings, bounce, path.throughput * emitted);
        work_.samples[path.sample].radiance += light;
        if (bounce == 0) work_.samples[path.sample].emission += light;
    }
    const std::uint32_t last = work_.settings.max_bounces;
    if (!scatters || bounce > last) return transmittance_.back();
    sample_lamps(ray, bounce, path);
    if (bounce == last && !work_.scene.has_unsampled_light()) return transmittance_.back();
    return sample_collision(ray, bounce, path);
}

// ---- lamps

void Fog::add_candidates(const Light& lamp, const Ray& ray, const Path& path) {
    for (std::size_t i = 0; i < along_.intervals.size(); ++i) {
        const MediumInterval& interval = along_.intervals[i];
        const Rgb before = path.throughput * transmittance_[i];
        if (!(max_component(before) > 0.0f)) return;
        set_mix_in(interval, ray);
        if (!mix_.scatters()) continue;
        const FogPart part{work_.scene.media(), along_.active_in(interval), mix_, ray, interval.near_m, interval.far_m};
        const auto lit = lit_part(lamp, part);
        if (!lit) continue;
        const Vec3b worth = broadcast(before);
        const auto scattered = [&](const Batch& distance_m) {
            const Vec3b left = transmittance_over(mix_.sigma_t, distance_m - Batch(interval.near_m));
            return mean_component(abs(worth * left * scattered_light(lamp, part, distance_m)));
        };
        const ScatterTable table(distance_map(lamp, part, lit->first, lit->second), node_count(mix_), scattered);
        if (table.sum() > 0.0f) candidates_.push_back({&lamp, i, table});
    }
}

void Fog::sample_candidate(const Ray& ray, std::uint32_t bounce, const Path& path, float weight, std::uint32_t place) {
    if (candidates_.empty()) return;
    const LightSampling strategy = work_.settings.light_sampling;
    const Sampler& sampler = work_.samplers[path.sample];
    const std::uint32_t dimension = FogDimensions(bounce).lamp(place);
    const Vec2f u = sampler.point(dimension);
    float total = 0.0f;
    for (const Candidate& candidate : candidates_) total += candidate.table.sum();
    float left = u.x * total;
    std::size_t index = 0;
    while (index + 1 < candidates_.size() && left >= candidates_[index].table.sum())
        left -= candidates_[index++].table.sum();
    const Candidate& chosen = candidates_[index];
    const float within = std::min(left / chosen.table.sum(), 1.0f - 0x1p-24f);
    const ScatterTable::Place at = chosen.table.sample(within);
    if (!is_usable(at.pdf_m) || !std::isfinite(at.distance_m)) return;
    const MediumInterval& interval = along_.intervals[chosen.interval];
    set_mix_in(interval, ray);
    const Vec3f position = ray.origin + at.distance_m * ray.direction;
    const Rgb worth = path.throughput * transmittance_[chosen.interval] *
                      transmittance_over(mix_.sigma_t, at.distance_m - interval.near_m) *
                      (weight * total / (chosen.table.sum() * at.pdf_m));
    const FogLampSampler lamp(*chosen.lamp, mix_, position, ray.direction, strategy);
    const auto add = [&](const LightPoint& point, float pdf) {
        if (!is_usable(pdf)) return;
        const Rgb light = worth * mix_.scattered(dot(point.wi, ray.direction)) * point.radiance / pdf;
        shadows_.push_back({.ray = {.origin = position,
                                    .direction = point.wi,
                                    .near_m = 0.0f,
                                    .far_m = point.distance_m * shadow_reach},
                            .light = light,
                            .bounce = bounce,
                            .sample = path.sample});
    };
    const bool shares = lamp.shares_with_phase();
    const auto phase_pdf = [&](const Vec3f& wi) { return mix_.pdf_omega(dot(wi, ray.direction)); };
    if (const auto point = lamp.sample(sampler.point(dimension + 1)))
        add(*point, point->pdf_omega + (shares ? phase_pdf(point->wi) : 0.0f));
    if (!shares) return;
    const Vec2f u_phase = sampler.point(dimension + 2);
    float of_lobe = u.y * mix_.total_weight;
    std::size_t lobe = 0;
    while (lobe + 1 < mix_.lobes.size() && of_lobe >= MediumMix::weight(mix_.lobes[lobe]))
        of_lobe -= MediumMix::weight(mix_.lobes[lobe++]);
    const Vec3f wi = around(ray.direction, sample_cosine(mix_.lobes[lobe].phase, u_phase.x), u_phase.y);
    if (const auto point = intersect_light(*chosen.lamp, position, wi))
        add(*point, lamp.pdf_omega(*point) + phase_pdf(wi));
}

std::optional<std::size_t> Fog::choose_lamp(const Ray& ray, float u, float u_place, float& probability) {
    // Seen from a place that light is likely to come from: where the ray would be scattered if it were.
    const float lost = 1.0f - mean_component(transmittance_.back());
    float wanted = u_place * lost;
    Vec3f position = ray.origin;
    for (std::size_t i = 0; i < along_.intervals.size(); ++i) {
        const float before = mean_component(transmittance_[i]);
        const float part = before - mean_component(transmittance_[i + 1]);
        if (wanted >= part && i + 1 < along_.intervals.size()) {
            wanted -= part;
            continue;
        }
        set_mix_in(along_.intervals[i], ray);
        const float sigma = std::max(mean_component(mix_.sigma_t), tiny<float>);
        const float along_m = -std::log1p(-std::min(wanted / std::max(before, tiny<float>), 1.0f - 0x1p-24f)) / sigma;
        const float most_m = std::min(along_.intervals[i].far_m - along_.intervals[i].near_m, 1e6f);
        position += (along_.intervals[i].near_m + std::min(along_m, most_m)) * ray.direction;
        break;
    }
    const auto [light, chance] = choose_light(work_.scene.lamp_tree(), position, u);
    probability = chance;
    return chance > 0.0f ? std::optional(light) : std::nullopt;
}

void Fog::sample_lamps(const Ray& ray, std::uint32_t bounce, const Path& path) {
    const std::span<const Light> lamps = work_.scene.lamps();
    if (lamps.size() <= max_lamp_samples && bounce == 0) {
        for (std::uint32_t i = 0; i < lamps.size(); ++i) {
            candidates_.clear();
            add_candidates(lamps[i], ray, path);
            sample_candidate(ray, bounce, path, 1.0f, i);
        }
        return;
    }
    candidates_.clear();
    if (lamps.size() <= max_lamp_samples) {
        for (const Light& lamp : lamps) add_candidates(lamp, ray, path);
        sample_candidate(ray, bounce, path, 1.0f, 0);
        return;
    }
    const std::uint32_t count = bounce == 0 ? max_lamp_samples : 1;
    const Vec2f u = work_.samplers[path.sample].point(FogDimensions(bounce).lamp_choice());
    for (std::uint32_t k = 0; k < count; ++k) {
        float probability;
        const auto of_count = [&](float number) {
            return (static_cast<float>(k) + number) / static_cast<float>(count);
        };
        const float turned = u.y + 0.618034f * static_cast<float>(k);
        const auto lamp = choose_lamp(ray, of_count(u.x), turned - std::floor(turned), probability);
        if (!lamp) continue;
        candidates_.clear();
        add_candidates(lamps[*lamp], ray, path);
        sample_candidate(ray, bounce, path, 1.0f / (probability * static_cast<float>(count)), k);
    }
}

// ---- scattering

Rgb Fog::sample_collision(const Ray& ray, std::uint32_t bounce, const Path& path) {
    constexpr float least_through = 0.05f;
    const Rgb through = transmittance_.back();
    const Sampler& sampler = work_.samplers[path.sample];
    const FogDimensions dimensions(bounce);
    const Vec2f u = sampler.point(dimensions.collision()), u_lobe = sampler.point(dimensions.lobe());
    const Vec2f u_survival = sampler.point(dimensions.survival());
    const float sum = path.throughput.x + path.throughput.y + path.throughput.z;
    if (!(sum > 0.0f)) return through;
    const Rgb share = path.throughput / sum;  // how often each colour chooses
    const float passes = dot(share, through), stays = 1.0f - passes;
    const bool goes_both_ways = bounce == 0;
    float left = u.x;
    if (!goes_both_ways) {
        if (left >= stays) return through / passes;
        left /= stays;
    }
    const auto onwards = [&] {
        if (!goes_both_ways) return Rgb(0.0f);
        const float survival = std::min(max_component(through) / least_through, 1.0f);
        return u_survival.y < survival ? through / survival : Rgb(0.0f);
    };
    if (!(stays > 0.0f)) return through;
    int color = 0;
    float of_colors = left * stays;
    while (color < 2 && of_colors >= share[color] * (1.0f - through[color])) {
        of_colors -= share[color] * (1.0f - through[color]);
        ++color;
    }
    const float wanted = 1.0f - u.y * (1.0f - through[color]);  // transmittance up to the collision
    std::size_t i = 0;
    while (i + 1 < along_.intervals.size() && transmittance_[i + 1][color] > wanted) ++i;
    const MediumInterval& interval = along_.intervals[i];
    set_mix_in(interval, ray);
    if (!mix_.scatters() || !(mix_.sigma_t[color] > 0.0f)) return onwards();
    const float length_m = interval.far_m - interval.near_m;
    const float along_m = std::clamp(
        std::log(transmittance_[i][color] / std::max(wanted, tiny<float>)) / mix_.sigma_t[color], 0.0f, length_m);
    const Rgb before = transmittance_[i] * transmittance_over(mix_.sigma_t, along_m);
    const float pdf_m = dot(share, before * mix_.sigma_t) / (goes_both_ways ? stays : 1.0f);
    if (!is_usable(pdf_m) || !std::isfinite(along_m)) return onwards();
    float of_lobes = u_lobe.x * mix_.total_weight;
    std::size_t lobe = 0;
    while (lobe + 1 < mix_.lobes.size() && of_lobes >= MediumMix::weight(mix_.lobes[lobe]))
        of_lobes -= MediumMix::weight(mix_.lobes[lobe++]);
    const ScatterLobe& chosen = mix_.lobes[lobe];
    Rgb throughput =
        path.throughput * before * chosen.sigma_s * (mix_.total_weight / (MediumMix::weight(chosen) * pdf_m));
    // Beside the path that goes on, this one goes on as often as it is worth it, or, of later bounces, as others do.
    float survival = 1.0f;
    if (goes_both_ways) survival = std::min(max_component(throughput), 1.0f);
    if (bounce > first_roulette_bounce) survival = std::min(max_component(throughput), max_roulette_survival);
    if (u_survival.x < survival) {
        throughput /= survival;
        const float distance_m = interval.near_m + along_m;
        vertices_.push_back({.position = ray.origin + distance_m * ray.direction,
                             .direction = ray.direction,
                             .phase = chosen.phase,
                             .throughput = throughput,
                             .footprint_m = path.arrival.footprint_m + path.spread * distance_m,
                             .spread = path.spread,
                             .sample = bounce == 0 ? path.sample + fog_sample_ : path.sample});
    }
    return onwards();
}

void Fog::sample_shining(const FogVertex& vertex, std::uint32_t bounce) {
    const Scene& scene = work_.scene;
    const LightSampling strategy = work_.settings.light_sampling;
    if (strategy == LightSampling::bsdf) return;
    const Sampler& sampler = work_.samplers[vertex.sample];
    const FogDimensions dimensions(bounce);
    const auto add = [&](const Vec3f& wi, float reach_m, const Rgb& radiance, float pdf) {
        const float phase = eval(vertex.phase, dot(wi, vertex.direction));
        const float weight = strategy == LightSampling::light ? 1.0f : balance(pdf, phase);
        if (!is_usable(pdf)) return;
        shadows_.push_back({.ray = {.origin = vertex.position, .direction = wi, .near_m = 0.0f, .far_m = reach_m},
                            .light = vertex.throughput * radiance * (phase * weight / pdf),
                            .bounce = bounce,
                            .sample = vertex.sample});
    };
    if (const Environment& environment = scene.environment(); !environment.is_dark()) {
        const Vec2f u = sampler.point(dimensions.world());
        const Vec3b sampled = environment.sample({Batch(u.x), Batch(u.y)});
        const Vec3f wi(store(sampled.x)[0], store(sampled.y)[0], store(sampled.z)[0]);
        add(wi, std::numeric_limits<float>::infinity(),
            world_radiance(scene.world_view(), wi, diffuse_ray, bounce + 1, work_.memory.registers),
            store(environment.pdf_omega(sampled))[0]);
    }
    if (scene.triangle_lights().empty()) return;
    const auto [index, probability] =
        choose_light(scene.triangle_tree(), vertex.position, sampler.point(dimensions.triangle_choice()).x);
    const std::size_t place = scene.lamps().size() + index;
    // What shines by its program is left to the phase function.
    if (!(probability > 0.0f) || scene.varying_triangle(place)) return;
    const auto& light = std::get<AreaLight>(scene.light(place));
    if (const auto point = sample_light(light, vertex.position, sampler.point(dimensions.triangle_place())))
        add(point->wi,
            point->distance_m * shadow_reach - surface_error_m(light) / std::abs(dot(point->wi, light.normal)),
            point->radiance, probability * point->pdf_omega);
}

Rgb Fog::shining_met(const FogVertex& vertex, std::uint32_t bounce, const Ray& ray, const std::optional<RayHit>& hit,
                     float pdf_omega) {
    const Scene& scene = work_.scene;
    const LightSampling strategy = work_.settings.light_sampling;
    const auto weight_beside = [&](float light_pdf_omega) {
        if (strategy == LightSampling::light) return 0.0f;
        return strategy == LightSampling::bsdf ? 1.0f : balance(pdf_omega, light_pdf_omega);
    };
    if (!hit) {
        if (!scene.has_world()) return Rgb(0.0f);
        const Environment& environment = scene.environment();
        const float weight =
            environment.is_dark() ? 1.0f : weight_beside(store(environment.pdf_omega(broadcast(ray.direction)))[0]);
        return weight *
               world_radiance(scene.world_view(), ray.direction, diffuse_ray, bounce + 1, work_.memory.registers);
    }
    const Shader& shader = scene.shaders()[scene.material_of(*hit)];
    if (!shader.is_emissive() || shader.has_varying_emission()) return Rgb(0.0f);
    float weight = 1.0f;
    if (const auto index = scene.light_of(*hit)) {
        const auto& light = std::get<AreaLight>(scene.light(*index));
        if (const auto place = light_point(light, ray.direction, hit->distance_m))
            weight = weight_beside(place->pdf_omega * choice_probability(scene.triangle_tree(), vertex.position,
                                                                         *index - scene.lamps().size()));
    }
    return weight * shader.constants.emission;
}

void Fog::scatter(std::uint32_t bounce, Paths& next) {
    const std::vector<FogVertex> vertices = std::exchange(vertices_, {});
    std::vector<Ray> rays;
    std::vector<float> pdf_omega;
    for (const FogVertex& vertex : vertices) {
        sample_shining(vertex, bounce);
        const Vec2f u = work_.samplers[vertex.sample].point(FogDimensions(bounce).direction());
        const Vec2f cos_sin = sample_cosine(vertex.phase, u.x);
        rays.push_back({.origin = vertex.position, .direction = around(vertex.direction, cos_sin, u.y)});
        pdf_omega.push_back(eval(vertex.phase, cos_sin.x));
    }
    std::vector<std::optional<RayHit>> hits(rays.size());
    work_.scene.intersect(rays, visible_to_light, hits);
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const FogVertex& vertex = vertices[i];
        Ray ray = rays[i];
        if (hits[i]) ray.far_m = hits[i]->distance_m;
        Path path{.arrival = {.direction = ray.direction,
                              .hit = hits[i].value_or(RayHit{}),
                              .material = 0,
                              .footprint_m = vertex.footprint_m,
                              .ray_kind = diffuse_ray},
                  .throughput = vertex.throughput,
                  .spread = vertex.spread + spread_of_sample(work_.settings, pdf_omega[i]),
                  .emission_weight = 1.0f,
                  .sample = vertex.sample};
        path.throughput *= cross(ray, bounce + 1, path);
        if (!(max_component(path.throughput) > 0.0f)) continue;
        add_light(bounce, vertex.sample, path.throughput * shining_met(vertex, bounce, ray, hits[i], pdf_omega[i]));
        if (!hits[i]) continue;
        path.arrival.material = work_.scene.material_of(*hits[i]);
        path.arrival.footprint_m += path.spread * ray.far_m;
        const bool shines_by_program = work_.scene.shaders()[path.arrival.material].has_varying_emission();
        if (bounce >= work_.settings.max_bounces && !shines_by_program) continue;
        next.push_back(path);
    }
    if (shadows_.size() > max_waiting_shadows) finish();
}

void Fog::add_light(std::uint32_t bounce, std::uint32_t sample, const Rgb& light) {
    const Rgb added = bounded(work_.settings, bounce, light);
    work_.samples[sample].radiance += added;
    if (bounce == 0) work_.samples[sample].volume_direct += added;
}

void Fog::finish() {
    std::vector<Ray> rays;
    for (const Shadow& shadow : shadows_) rays.push_back(shadow.ray);
    std::vector<std::uint8_t> hidden(rays.size());
    work_.scene.occluded(rays, hidden);
    for (std::size_t i = 0; i < shadows_.size(); ++i) {
        const Shadow& shadow = shadows_[i];
        if (!hidden[i]) add_light(shadow.bounce, shadow.sample, shadow.light * transmittance(shadow.ray));
    }
    shadows_.clear();
}

}  // namespace pivot
