#include "core/integrators/monte_carlo.h"

#include "core/integrators/direct_light.h"

namespace pivot {
namespace {

constexpr std::uint32_t first_roulette_bounce = 3;
constexpr float max_roulette_survival = 0.95f;

/// The weight of a BSDF sample that meets a light, beside the light's own samples.
float bsdf_weight(const Scene& scene, LightSampling strategy, const Vertex& vertex, std::size_t index,
                  const LightPoint& place, float bsdf_pdf_omega) {
    const LightSampler light(scene.lights()[index], vertex.point, vertex.surface, strategy);
    if (!light.shares_with_bsdf()) return 0.0f;
    const float light_pdf_omega = light.pdf_omega(place);  // 0: BSDF samples are alone
    const float expected = light_pdf_omega > 0.0f ? expected_samples(scene, vertex, index) : 0.0f;
    return balance(bsdf_pdf_omega, expected * light_pdf_omega);
}

/// What a BSDF sample that reaches distance_m meets of the lamps.
Rgb lights_met(const Scene& scene, LightSampling strategy, const Vertex& vertex, const Vec3f& wi, float bsdf_pdf_omega,
               float distance_m) {
    const std::span<const Light> lamps = scene.lamps();
    Rgb radiance(0.0f);
    for (std::size_t i = 0; i < lamps.size(); ++i) {
        const auto place = intersect_light(lamps[i], vertex.point.position, wi);
        // A sun is met where the ray leaves the scene: infinity against infinity.
        if (!place || place->distance_m > distance_m) continue;
        radiance += place->radiance * bsdf_weight(scene, strategy, vertex, i, *place, bsdf_pdf_omega);
    }
    return radiance;
}

/// The emission that a BSDF sample meets on a surface, weighted if its triangle is a light that is sampled.
Rgb emission_met(const Scene& scene, LightSampling strategy, const Vertex& vertex, const Vec3f& wi,
                 float bsdf_pdf_omega, const RayHit& hit, const Rgb& emission) {
    const auto index = scene.light_of(hit);
    if (!index) return emission;
    const auto place = light_point(std::get<AreaLight>(scene.lights()[*index]), wi, hit.distance_m);
    if (!place) return emission;
    return emission * bsdf_weight(scene, strategy, vertex, *index, *place, bsdf_pdf_omega);
}

/// Light that a path brings by way of a vertex: what bounced may be bounded, at the price of some of it.
void add_contribution(const RenderSettings& settings, std::uint32_t bounce, const Rgb& light, Rgb& radiance) {
    const float size = mean_component(abs(light)), limit = settings.clamp_indirect;
    radiance += bounce > 0 && limit > 0.0f && size > limit ? light * (limit / size) : light;
}

/// Paths that have reached the same bounce: their vertices side by side, for batches and packets.
struct Paths {
    std::vector<Vertex> vertices;
    std::vector<Rgb> throughput;
    std::vector<std::size_t> sample;   ///< of the caller's
    std::vector<std::uint8_t> shares;  ///< whether the vertex' BSDF sample counts lights

    std::size_t size() const { return vertices.size(); }

    void reserve(std::size_t count) {
        vertices.reserve(count);
        throughput.reserve(count);
        sample.reserve(count);
    }

    void add(const Vertex& vertex, const Rgb& weight, std::size_t of_sample) {
        vertices.push_back(vertex);
        throughput.push_back(weight);
        sample.push_back(of_sample);
    }

    void keep(std::size_t count) {
        vertices.erase(vertices.begin() + static_cast<std::ptrdiff_t>(count), vertices.end());
        throughput.resize(count);
        sample.resize(count);
    }
};

Vertex make_vertex(const Scene& scene, const Sampler& sampler, const SurfacePoint& point, std::uint32_t bounce) {
    return {.sampler = sampler,
            .point = point,
            .surface = make_surface(*point.material, point.wo_local),
            .dimensions = Dimensions(bounce),
            .lamp_samples = std::min(scene.lamps().size(), bounce == 0 ? max_lamp_samples : 1),
            .triangle_samples = std::min(scene.triangle_lights().size(), bounce == 0 ? max_triangle_samples : 1)};
}

/// The camera's rays; those that meet nothing end here.
Paths start_paths(const Scene& scene, const RenderSettings& settings, std::span<const Ray> camera_rays,
                  std::span<const Sampler> samplers, std::span<Sample> samples) {
    std::vector<std::optional<RayHit>> hits(camera_rays.size());
    scene.intersect(camera_rays, visible_to_camera, hits);
    Paths paths;
    paths.reserve(camera_rays.size());
    for (std::size_t i = 0; i < camera_rays.size(); ++i) {
        Sample& sample = samples[i] = {};
        if (!hits[i]) {
            if (settings.transparent_film) sample.alpha = 0.0f;
            if (!settings.transparent_film) sample.radiance = scene.world();
            continue;
        }
        const Vertex vertex = make_vertex(scene, samplers[i], scene.surface_point(camera_rays[i], *hits[i]), 0);
        sample.radiance = sample.emission = vertex.point.material->emission;
        sample.normal = vertex.point.frame.z;
        sample.albedo = vertex.surface.diffuse;
        paths.add(vertex, Rgb(1.0f), i);
    }
    return paths;
}

/// The light that reaches each vertex straight from the lights.
void add_light(const Scene& scene, const RenderSettings& settings, std::uint32_t bounce, Paths& paths,
               std::span<Sample> samples) {
    std::vector<Rgb> direct(paths.size(), Rgb(0.0f));
    paths.shares.assign(paths.size(), 0);
    add_direct_light(scene, settings.light_sampling, paths.vertices, direct, paths.shares);
    for (std::size_t i = 0; i < paths.size(); ++i)
        add_contribution(settings, bounce, paths.throughput[i] * direct[i], samples[paths.sample[i]].radiance);
}

/// A BSDF sample of each path: its ray, and what the path is worth along it.
struct Scattered {
    std::vector<Ray> rays;
    std::vector<float> pdf_omega;
};

/// Paths whose sample is worth nothing are dropped, and so are, at the last bounce, those that can meet no light; the
/// others move up.
Scattered scatter(Paths& paths, bool is_for_shared_lights) {
    Scattered scattered;
    scattered.rays.reserve(paths.size());
    scattered.pdf_omega.reserve(paths.size());
    std::size_t kept = 0;
    for (std::size_t i = 0; i < paths.size(); ++i) {
        if (is_for_shared_lights && !paths.shares[i]) continue;
        const Vertex& vertex = paths.vertices[i];
        const SurfacePoint& point = vertex.point;
        const Vec3f wi_local = pivot::sample(vertex.surface, vertex.sampler.number(vertex.dimensions.lobe()),
                                             vertex.sampler.point(vertex.dimensions.direction()));
        const Vec3f wi = point.frame.to_world(wi_local);
        const float bsdf_pdf_omega = pdf_omega(vertex.surface, wi_local);
        if (!(bsdf_pdf_omega > 0.0f) || !point.faces(wi)) continue;
        const Rgb throughput = paths.throughput[i] * eval(vertex.surface, wi_local) / bsdf_pdf_omega;
        if (max_component(throughput) <= 0.0f) continue;
        scattered.rays.push_back({point.ray_origin(wi), wi});
        scattered.pdf_omega.push_back(bsdf_pdf_omega);
        paths.vertices[kept] = vertex;
        paths.throughput[kept] = throughput;
        paths.sample[kept] = paths.sample[i];
        paths.shares[kept] = paths.shares[i];
        ++kept;
    }
    paths.keep(kept);
    return scattered;
}

/// Follows the rays of a bounce to what they meet: lights, the world, or the paths' next vertices, which are returned.
Paths next_vertices(const Scene& scene, const RenderSettings& settings, const Paths& paths, const Scattered& scattered,
                    std::uint32_t bounce, std::span<Sample> samples) {
    std::vector<std::optional<RayHit>> hits(paths.size());
    scene.intersect(scattered.rays, visible_to_light, hits);
    Paths next;
    next.reserve(paths.size());
    for (std::size_t i = 0; i < paths.size(); ++i) {
        const Vertex& vertex = paths.vertices[i];
        const Ray& ray = scattered.rays[i];
        Rgb throughput = paths.throughput[i];
        const auto add = [&](const Rgb& light) {
            add_contribution(settings, bounce, throughput * light, samples[paths.sample[i]].radiance);
        };
        if (paths.shares[i]) {
            const float reached_m = hits[i] ? hits[i]->distance_m : ray.far_m;
            add(lights_met(scene, settings.light_sampling, vertex, ray.direction, scattered.pdf_omega[i], reached_m));
        }
        if (!hits[i]) {
            add(scene.world());
            continue;
        }
        if (bounce >= first_roulette_bounce) {
            const float survival = std::min(max_component(throughput), max_roulette_survival);
            // The lobe's second number is free: the first chose the lobe.
            if (vertex.sampler.point(vertex.dimensions.lobe()).y >= survival) continue;
            throughput /= survival;
        }
        const SurfacePoint point = scene.surface_point(ray, *hits[i]);
        if (point.material->is_emissive())
            add(emission_met(scene, settings.light_sampling, vertex, ray.direction, scattered.pdf_omega[i], *hits[i],
                             point.material->emission));
        if (bounce < settings.max_bounces)
            next.add(make_vertex(scene, vertex.sampler, point, bounce + 1), throughput, paths.sample[i]);
    }
    return next;
}

}  // namespace

void trace_paths(const Scene& scene, const RenderSettings& settings, std::span<const Ray> camera_rays,
                 std::span<const Sampler> samplers, std::span<Sample> samples) {
    Paths paths = start_paths(scene, settings, camera_rays, samplers, samples);
    for (std::uint32_t bounce = 0; paths.size() > 0; ++bounce) {
        add_light(scene, settings, bounce, paths, samples);
        const bool is_last = bounce == settings.max_bounces;
        const Scattered scattered = scatter(paths, is_last && !scene.has_unsampled_light());
        paths = next_vertices(scene, settings, paths, scattered, bounce, samples);
    }
}

}  // namespace pivot
