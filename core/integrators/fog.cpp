#include "core/integrators/fog.h"

#include "core/integrators/bounce_counts.h"
#include "core/integrators/direct_light.h"
#include "core/integrators/light_choice.h"

namespace pivot {
namespace {

constexpr std::size_t max_waiting_shadows = 1024;

}  // namespace

Rgb Fog::transmittance(const Ray& ray, std::uint32_t sample, std::uint32_t dimension) {
    RandomStream stream{stream_seed(work_.samplers[sample], dimension)};
    shadow_ray_.follow(ray, &stream);
    return shadow_ray_.through();
}

Rgb Fog::cross(const Ray& ray, std::uint32_t bounce, const Path& path, std::uint32_t part) {
    part_ = part;
    RandomStream stream{stream_seed(work_.samplers[path.sample], FogDimensions(bounce, part_).collision())};
    ray_.follow(ray, &stream);
    if (ray_.size() == 0) return Rgb(1.0f);
    add_emitted(bounce, path);
    const std::uint32_t last = work_.settings.max_bounces;
    if (!ray_.scatters() || bounce > last || (path.bounces & path_ends)) return ray_.through();
    sample_lamps(bounce, path);
    if (bounce == last && !work_.scene.has_unsampled_light()) return ray_.through();
    return sample_collision(bounce, path, stream);
}

void Fog::add_emitted(std::uint32_t bounce, const Path& path) {
    Rgb emitted(0.0f);
    std::vector<std::pair<std::uint32_t, Rgb>> of_groups;
    for (std::size_t i = 0; i < ray_.size(); ++i) {
        const Rgb part = ray_.before(i) * ray_.emitted_in(i);
        emitted += part;
        if (work_.groups) of_groups.emplace_back(ray_.light_group_in(i), path.throughput * part);
    }
    if (!(max_component(abs(emitted)) > 0.0f)) return;
    const Rgb all = path.throughput * emitted;
    const float share = bounded_share(work_.settings, bounce, all);
    add_radiance(bounce, share * all, work_.samples[path.sample]);
    for (const auto& [group, light] : of_groups) add_to_group(work_, path.sample, group, share * light);
    if (bounce == 0)
        work_.samples[path.sample].emission += share * all;
    else
        add_to_passes(work_, bounce - 1, path.sample, share * all);
}

Rgb Fog::cross(const Ray& ray, const WayOn& way, std::uint32_t bounce, const Path& path) {
    Rgb left(1.0f);
    float from_m = 0.0f;
    std::uint32_t part = 0;
    const auto cross_to = [&](float distance_m) {
        Path at = path;
        at.throughput *= left;
        at.arrival.footprint_m += path.spread * from_m;
        left *= cross(part_of(ray, from_m, distance_m), bounce, at, part++);
        from_m = distance_m;
    };
    for (const Passage& passage : way.passages) {
        cross_to(passage.hit.distance_m);
        left *= passage.ends() ? Rgb(passage.shown) : passage.passed;
    }
    if (way.passages.empty() || !way.hit) cross_to(way.hit ? way.hit->distance_m : ray.far_m);
    return left;
}

Rgb Fog::sample_collision(std::uint32_t bounce, const Path& path, RandomStream& stream) {
    std::optional<MediaRay::Collided> collided;
    Rgb through = ray_.through();
    if (ray_.is_homogeneous()) {
        through = sample_collision_evenly(bounce, path, collided);
    } else {
        Rgb throughput = path.throughput;
        collided = ray_.collide(throughput, stream, mix_);
        if (bounce > 0) through = throughput / max(path.throughput, Rgb(tiny<float>));
    }
    const Sampler& sampler = work_.samplers[path.sample];
    const Vec2f u_survival = sampler.point(FogDimensions(bounce, part_).survival());
    if (collided) {
        const ScatterLobe& lobe = mix_.choose(sampler.point(FogDimensions(bounce, part_).lobe()).x);
        Rgb throughput = collided->throughput * (lobe.sigma_s / max(mix_.sigma_s, Rgb(tiny<float>))) *
                         (mix_.total_weight / MediumMix::weight(lobe));
        // Beside the path that goes on, this one goes on as often as it is worth it, or, of later bounces, as others
        // do.
        float survival = bounce == 0 ? std::min(max_component(throughput), 1.0f) : 1.0f;
        if (bounce >= first_roulette_bounce) survival = std::min(max_component(throughput), max_roulette_survival);
        if (u_survival.x < survival) {
            throughput /= survival;
            vertices_.push_back(
                {.position = ray_.position(collided->distance_m),
                 .direction = ray_.ray().direction,
                 .phase = lobe.phase,
                 .throughput = throughput,
                 .footprint_m = path.arrival.footprint_m + path.spread * collided->distance_m,
                 .spread = path.spread,
                 .time = ray_.ray().time,
                 .sample = bounce == 0 ? path.sample + fog_sample_ : path.sample,
                 .bounces = counted(path.bounces, bounce_counts::scatter, work_.settings.bounce_limits.scatter),
                 .link_sets = ray_.link_sets_at(collided->distance_m)});
        }
    }
    if (bounce > 0) return through;
    constexpr float least_through = 0.05f;
    const float survival = std::min(max_component(through) / least_through, 1.0f);
    return u_survival.y < survival ? through / survival : Rgb(0.0f);
}

Rgb Fog::sample_collision_evenly(std::uint32_t bounce, const Path& path, std::optional<MediaRay::Collided>& collided) {
    const Rgb through = ray_.through();
    const Vec2f u = work_.samplers[path.sample].point(FogDimensions(bounce, part_).collision());
    const float sum = path.throughput.x + path.throughput.y + path.throughput.z;
    if (!(sum > 0.0f)) return through;
    const Rgb share = path.throughput / sum;  // how often each colour chooses
    const float passes = dot(share, through), stays = 1.0f - passes;
    float left = u.x;
    if (bounce > 0) {
        if (left >= stays) return through / passes;
        left /= stays;
    }
    if (!(stays > 0.0f)) return through;
    const Rgb onwards = bounce == 0 ? through : Rgb(0.0f);
    int color = 0;
    float of_colors = left * stays;
    while (color < 2 && of_colors >= share[color] * (1.0f - through[color])) {
        of_colors -= share[color] * (1.0f - through[color]);
        ++color;
    }
    const float wanted = 1.0f - u.y * (1.0f - through[color]);  // transmittance up to the collision
    std::size_t i = 0;
    while (i + 1 < ray_.size() && ray_.before(i + 1)[color] > wanted) ++i;
    const MediumInterval& interval = ray_.interval(i);
    ray_.set_mix_at(i, interval.near_m, mix_);
    if (!mix_.scatters() || !(mix_.sigma_t[color] > 0.0f)) return onwards;
    const float depth = std::log(ray_.before(i)[color] / std::max(wanted, tiny<float>));
    const float along_m = std::clamp(depth / mix_.sigma_t[color], 0.0f, interval.far_m - interval.near_m);
    const Rgb before = ray_.before(i) * transmittance_over(mix_.sigma_t, along_m);
    const float pdf_m = dot(share, before * mix_.sigma_t) / (bounce == 0 ? stays : 1.0f);
    if (is_usable(pdf_m) && std::isfinite(along_m))
        collided = {interval.near_m + along_m, path.throughput * before * mix_.sigma_s / pdf_m};
    return onwards;
}

bool Fog::is_lit_by(std::size_t light, std::uint32_t bounce) const {
    if (!work_.scene.has_light_rules()) return true;
    const LightRules& rules = work_.scene.rules_of(light);
    return (rules.lights & visible_to_scatter) && bounce <= rules.max_bounces;
}

LightLinks Fog::links_of(std::size_t light) const {
    return work_.scene.has_light_rules() ? work_.scene.rules_of(light).links : LightLinks{};
}

void Fog::sample_shining(const FogVertex& vertex, std::uint32_t bounce) {
    const Scene& scene = work_.scene;
    const LightSampling strategy = work_.settings.light_sampling;
    if (strategy == LightSampling::bsdf) return;
    const Sampler& sampler = work_.samplers[vertex.sample];
    const FogDimensions dimensions(bounce);
    const auto add = [&](const Vec3f& wi, float reach_m, const Rgb& radiance, float pdf, std::uint32_t dimension,
                         std::uint32_t group, const LightLinks& links) {
        const float phase = eval(vertex.phase, vertex.direction, wi);
        const float weight = strategy == LightSampling::light ? 1.0f : balance(pdf, phase);
        if (!is_usable(pdf)) return;
        shadows_.push_back(
            {.ray = {.origin = vertex.position, .direction = wi, .near_m = 0.0f, .far_m = reach_m, .time = vertex.time},
             .light = vertex.throughput * radiance * (phase * weight / pdf),
             .bounce = bounce,
             .sample = vertex.sample,
             .dimension = dimension,
             .group = group,
             .links = links});
    };
    const bool is_lit_by_world = scene.world_rules().lights & visible_to_scatter;
    if (const Environment& environment = scene.environment();
        !environment.is_dark() && is_lit_by_world && bounce <= scene.world_rules().max_bounces) {
        const Vec2f u = sampler.point(dimensions.world());
        const Vec3b sampled = environment.sample({Batch(u.x), Batch(u.y)}).wi;
        const Vec3f wi(store(sampled.x)[0], store(sampled.y)[0], store(sampled.z)[0]);
        add(wi, std::numeric_limits<float>::infinity(),
            world_radiance(scene.world_view(), wi, diffuse_ray, bounce + 1, work_.memory.registers),
            store(environment.pdf_omega(sampled))[0], dimensions.world(), scene.world_light_group(), {});
    }
    if (scene.triangle_lights().empty()) return;
    const auto [index, probability] =
        choose_light(scene.triangle_tree(), vertex.position, sampler.point(dimensions.triangle_choice()).x);
    const std::size_t place = scene.lamps().size() + index;
    // What shines by its program is left to the phase function.
    if (!(probability > 0.0f) || scene.varying_triangle(place) || !is_lit_by(place, bounce) ||
        !is_receiver(links_of(place), vertex.link_sets))
        return;
    const Light chosen = scene.light_at(place, vertex.time);
    const auto& light = std::get<AreaLight>(chosen);
    if (const auto point = sample_light(light, vertex.position, sampler.point(dimensions.triangle_place())))
        add(point->wi,
            point->distance_m * shadow_reach - surface_error_m(light) / std::abs(dot(point->wi, light.normal)),
            point->radiance, probability * point->pdf_omega, dimensions.triangle_place(), scene.light_group_of(place),
            links_of(place));
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
        if (!scene.has_world() || !(scene.world_rules().lights & visible_to_scatter)) return Rgb(0.0f);
        const Environment& environment = scene.environment();
        const float weight =
            environment.is_dark() ? 1.0f : weight_beside(store(environment.pdf_omega(broadcast(ray.direction)))[0]);
        return weight *
               world_radiance(scene.world_view(), ray.direction, diffuse_ray, bounce + 1, work_.memory.registers);
    }
    if (!is_receiver(scene.links_of(hit->instance), vertex.link_sets)) return Rgb(0.0f);
    const Shader& shader = scene.shaders()[scene.material_of(*hit)];
    if (!shader.is_emissive() || shader.has_varying_emission()) return Rgb(0.0f);
    float weight = 1.0f;
    if (const auto index = scene.light_of(*hit)) {
        const Light light = scene.light_at(*index, ray.time);
        if (const auto place = light_point(std::get<AreaLight>(light), ray.direction, hit->distance_m))
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
        rays.push_back(
            {.origin = vertex.position, .direction = sample(vertex.phase, vertex.direction, u), .time = vertex.time});
        pdf_omega.push_back(eval(vertex.phase, vertex.direction, rays.back().direction));
    }
    std::vector<std::optional<RayHit>> hits(rays.size());
    work_.scene.intersect(rays, visible_to_scatter, hits);
    std::vector<Passage> passages;
    if (work_.scene.has_transparency()) {
        std::vector<StraightRay> straight;
        for (std::size_t i = 0; i < vertices.size(); ++i) {
            const float spread = vertices[i].spread + spread_of_sample(work_.settings, pdf_omega[i]);
            straight.push_back({rays[i], hits[i], visible_to_scatter, diffuse_ray, vertices[i].footprint_m, spread});
        }
        const auto sample_of = [&](std::size_t i) { return vertices[i].sample; };
        passages = find_passages(work_.scene, work_.settings.max_path_passages, straight, bounce + 1,
                                 chosen_by(work_.samplers, bounce + 1, never_two, sample_of), work_.memory);
    }
    const std::vector<WayOn> ways = ways_on(passages, hits);
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const FogVertex& vertex = vertices[i];
        const std::optional<RayHit>& hit = ways[i].hit;
        Path path{.arrival = {.direction = rays[i].direction,
                              .hit = hit.value_or(RayHit{}),
                              .material = 0,
                              .footprint_m = vertex.footprint_m,
                              .ray_kind = ways[i].ray_kind(diffuse_ray)},
                  .throughput = vertex.throughput,
                  .spread = vertex.spread + spread_of_sample(work_.settings, pdf_omega[i]),
                  .emission_weight = 1.0f,
                  .sample = vertex.sample,
                  .bounces = vertex.bounces};
        path.throughput *= cross(rays[i], ways[i], bounce + 1, path);
        if (!(max_component(path.throughput) > 0.0f)) continue;
        const std::uint32_t group = hit ? work_.scene.light_group_of(*hit) : work_.scene.world_light_group();
        add_light(bounce, vertex.sample, group,
                  path.throughput * shining_met(vertex, bounce, rays[i], hit, pdf_omega[i]));
        if (!hit || ways[i].only_shines()) continue;
        path.arrival.material = work_.scene.material_of(*hit);
        path.arrival.footprint_m += path.spread * hit->distance_m;
        const bool shines_by_program = work_.scene.shaders()[path.arrival.material].has_varying_emission();
        const bool is_last = bounce >= work_.settings.max_bounces || (vertex.bounces & path_ends);
        if (is_last && !shines_by_program) continue;
        next.push_back(path);
    }
    if (shadows_.size() > max_waiting_shadows) finish();
}

void Fog::add_light(std::uint32_t bounce, std::uint32_t sample, std::uint32_t group, const Rgb& light) {
    const Rgb added = light * bounded_share(work_.settings, bounce, light);
    add_radiance(bounce, added, work_.samples[sample]);
    add_to_group(work_, sample, group, added);
    if (bounce == 0)
        work_.samples[sample].volume_direct += added;
    else
        add_to_passes(work_, bounce, sample, added);
}

void Fog::finish() {
    std::vector<Ray> rays;
    for (const Shadow& shadow : shadows_) rays.push_back(shadow.ray);
    std::vector<Rgb> left(rays.size());
    light_along(work_.scene, work_.settings.max_passages, {}, rays, left, work_.memory);
    for (std::size_t i = 0; i < shadows_.size(); ++i) {
        const Shadow& shadow = shadows_[i];
        if (shadow.is_open)
            add_light(shadow.bounce, shadow.sample, shadow.group, shadow.light);
        else if (has_blockers_of_its_own(shadow.links)) {
            const ShadowPath path{work_.settings.max_passages, shadow.bounce, WordBatch(camera_ray)};
            const Rgb past = light_past_others(work_.scene, shadow.ray, shadow.links, path, 0, work_.memory);
            add_light(shadow.bounce, shadow.sample, shadow.group,
                      shadow.light * past * transmittance(shadow.ray, shadow.sample, shadow.dimension));
        } else if (max_component(left[i]) > 0.0f)
            add_light(shadow.bounce, shadow.sample, shadow.group,
                      shadow.light * left[i] * transmittance(shadow.ray, shadow.sample, shadow.dimension));
    }
    shadows_.clear();
}

}  // namespace pivot
