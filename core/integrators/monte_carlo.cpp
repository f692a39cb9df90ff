#include "core/integrators/monte_carlo.h"

#include "core/integrators/direct_light.h"

namespace pivot {
namespace {

constexpr std::uint32_t first_roulette_bounce = 3;
constexpr float max_roulette_survival = 0.95f;

/// What a BSDF sample that reaches distance_m meets of the lights, weighted against their own samples.
Rgb lights_met(const Scene& scene, LightSampling strategy, const Vertex& vertex, const Vec3f& wi, float bsdf_pdf_omega,
               float distance_m) {
    const auto& lights = scene.lights();
    Rgb radiance(0.0f);
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const auto place = intersect_light(lights[i], vertex.point.position, wi);
        // A sun is met where the ray leaves the scene: infinity against infinity.
        if (!place || place->distance_m > distance_m) continue;
        const LightSampler light(lights[i], vertex.point, vertex.surface, strategy);
        if (!light.shares_with_bsdf()) continue;
        const float light_pdf_omega = light.pdf_omega(*place);  // 0: BSDF samples are alone
        const float expected = light_pdf_omega > 0.0f ? expected_samples(scene, vertex, i) : 0.0f;
        radiance += place->radiance * balance(bsdf_pdf_omega, expected * light_pdf_omega);
    }
    return radiance;
}

/// The path from its first vertex on, whose own light is in. shares: whether the first BSDF sample counts lights.
void follow_path(const Scene& scene, const RenderSettings& settings, Vertex vertex, bool shares, Sample& sample) {
    const LightSampling strategy = settings.light_sampling;
    Rgb throughput(1.0f);
    for (std::uint32_t bounce = 0;; ++bounce) {
        if (bounce == settings.max_bounces && !shares && !scene.has_unsampled_light()) return;
        const SurfacePoint& point = vertex.point;
        const Vec3f wi_local = pivot::sample(vertex.surface, vertex.sampler.number(vertex.dimensions.lobe()),
                                             vertex.sampler.point(vertex.dimensions.direction()));
        const Vec3f wi = point.frame.to_world(wi_local);
        const float bsdf_pdf_omega = pdf_omega(vertex.surface, wi_local);
        if (!(bsdf_pdf_omega > 0.0f) || !point.faces(wi)) return;
        throughput *= eval(vertex.surface, wi_local) / bsdf_pdf_omega;
        if (max_component(throughput) <= 0.0f) return;

        const Ray ray{point.ray_origin(wi), wi};
        const auto hit = scene.intersect(ray, visible_to_light);
        const float reached_m = hit ? hit->distance_m : ray.far_m;
        if (shares) {
            sample.radiance += throughput * lights_met(scene, strategy, vertex, wi, bsdf_pdf_omega, reached_m);
        }
        if (!hit) {
            sample.radiance += throughput * scene.world();
            return;
        }
        if (bounce >= first_roulette_bounce) {
            const float survival = std::min(max_component(throughput), max_roulette_survival);
            // The lobe's second number is free: the first chose the lobe.
            if (vertex.sampler.point(vertex.dimensions.lobe()).y >= survival) return;
            throughput /= survival;
        }
        vertex.point = scene.surface_point(ray, *hit);
        sample.radiance += throughput * vertex.point.material->emission;
        if (bounce == settings.max_bounces) return;
        vertex.surface = make_surface(*vertex.point.material, vertex.point.wo_local);
        vertex.dimensions = Dimensions(bounce + 1);
        vertex.light_samples = std::min<std::size_t>(scene.lights().size(), 1);
        Rgb direct(0.0f);
        std::uint8_t vertex_shares = 0;
        add_direct_light(scene, strategy, {&vertex, 1}, {&direct, 1}, {&vertex_shares, 1});
        shares = vertex_shares != 0;
        sample.radiance += throughput * direct;
    }
}

}  // namespace

void trace_paths(const Scene& scene, const RenderSettings& settings, std::span<const Ray> camera_rays,
                 std::span<const Sampler> samplers, std::span<Sample> samples) {
    std::vector<std::optional<RayHit>> hits(camera_rays.size());
    scene.intersect(camera_rays, visible_to_camera, hits);
    std::vector<Vertex> vertices;
    std::vector<std::size_t> places;  // of the vertices' samples
    vertices.reserve(camera_rays.size());
    places.reserve(camera_rays.size());
    for (std::size_t i = 0; i < camera_rays.size(); ++i) {
        Sample& sample = samples[i];
        sample = {};
        if (!hits[i]) {
            if (settings.transparent_film) sample.alpha = 0.0f;
            if (!settings.transparent_film) sample.radiance = scene.world();
            continue;
        }
        const Vertex vertex{
            .sampler = samplers[i],
            .point = scene.surface_point(camera_rays[i], *hits[i]),
            .surface = make_surface(*vertex.point.material, vertex.point.wo_local),
            .dimensions = Dimensions(0),
            .light_samples = std::min(scene.lights().size(), max_light_samples),
        };
        const Rgb emission = vertex.point.material->emission;
        sample.radiance = emission;
        sample.normal = vertex.point.frame.z;
        sample.albedo = vertex.surface.diffuse;
        sample.emission = emission;
        places.push_back(i);
        vertices.push_back(vertex);
    }
    std::vector<Rgb> direct(vertices.size(), Rgb(0.0f));
    std::vector<std::uint8_t> shares(vertices.size(), 0);
    add_direct_light(scene, settings.light_sampling, vertices, direct, shares);
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        Sample& sample = samples[places[i]];
        sample.radiance += direct[i];
        follow_path(scene, settings, vertices[i], shares[i] != 0, sample);
    }
}

}  // namespace pivot
