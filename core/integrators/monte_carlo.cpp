#include "core/integrators/monte_carlo.h"

#include "core/integrators/light_choice.h"
#include "core/integrators/light_sampler.h"

namespace pivot {
namespace {

constexpr std::uint32_t first_roulette_bounce = 3;
constexpr float max_roulette_survival = 0.95f;

/// Sampler dimensions of one bounce: the BSDF's two, the choice of a light, then two per light.
struct Dimensions {
    std::uint32_t base;

    Dimensions(std::uint32_t bounce, std::size_t light_count)
        : base(1 + bounce * (3 + 2 * static_cast<std::uint32_t>(light_count))) {}

    std::uint32_t lobe() const { return base; }
    std::uint32_t direction() const { return base + 1; }
    std::uint32_t light_choice() const { return base + 2; }
    std::uint32_t light_technique(std::size_t light) const { return base + 3 + 2 * static_cast<std::uint32_t>(light); }
    std::uint32_t light_place(std::size_t light) const { return light_technique(light) + 1; }
};

/// A path's vertex: what its light samples and its BSDF sample both need.
struct Vertex {
    const Scene& scene;
    const RenderSettings& settings;
    const Sampler& sampler;
    const SurfacePoint& point;
    const Surface& surface;
    Dimensions dimensions;
    bool samples_all_lights;

    /// Where one light stands for all, its samples share with BSDF samples even by strategy joint: the choice is by
    /// irradiance, and a highlight of a light that is seldom chosen is the BSDF's to find.
    bool shares_with_bsdf(const LightSampler& light) const {
        return samples_all_lights ? light.shares_with_bsdf() : settings.light_sampling != LightSampling::light;
    }
};

/// MIS by the balance heuristic.
float balance(float pdf, float other_pdf) { return pdf / (pdf + other_pdf); }

bool is_visible(const Scene& scene, const SurfacePoint& point, const LightPoint& place) {
    // The light's own surface is no occluder; a mesh that touches it should not become one by rounding.
    return !scene.occluded({point.ray_origin(place.wi), place.wi, 0.0f, place.distance_m * (1.0f - 1e-5f)});
}

struct DirectLight {
    Rgb radiance{0.0f};
    bool shares_with_bsdf = false;  ///< whether BSDF samples must be traced for some light
};

/// One sample of a light that is chosen with the given probability.
DirectLight sample_light_at(const Vertex& vertex, std::size_t index, float probability) {
    const LightSampler light(vertex.scene.lights()[index], vertex.point, vertex.surface,
                             vertex.settings.light_sampling);
    DirectLight direct{.shares_with_bsdf = vertex.shares_with_bsdf(light)};
    const auto place = light.sample(vertex.sampler.number(vertex.dimensions.light_technique(index)),
                                    vertex.sampler.point(vertex.dimensions.light_place(index)));
    if (!place || !(place->pdf_omega > 0.0f) || !vertex.point.faces(place->wi)) return direct;
    const float pdf = probability * place->pdf_omega;
    const Vec3f wi_local = vertex.point.frame.to_local(place->wi);
    const Rgb reflected = eval(vertex.surface, wi_local) * place->radiance / pdf;
    if (max_component(reflected) <= 0.0f || !is_visible(vertex.scene, vertex.point, *place)) return direct;
    const float weight = direct.shares_with_bsdf ? balance(pdf, pdf_omega(vertex.surface, wi_local)) : 1.0f;
    direct.radiance = weight * reflected;
    return direct;
}

DirectLight sample_lights(const Vertex& vertex) {
    const auto& lights = vertex.scene.lights();
    DirectLight direct;
    if (vertex.samples_all_lights) {
        for (std::size_t i = 0; i < lights.size(); ++i) {
            const DirectLight one = sample_light_at(vertex, i, 1.0f);
            direct.radiance += one.radiance;
            direct.shares_with_bsdf |= one.shares_with_bsdf;
        }
        return direct;
    }
    const auto choice = choose_light(lights, vertex.point, vertex.sampler.number(vertex.dimensions.light_choice()));
    if (choice) direct = sample_light_at(vertex, choice->light, choice->probability);
    return direct;
}

/// What a BSDF sample that reaches distance_m meets of the lights, weighted against their own samples.
Rgb lights_met(const Vertex& vertex, const Vec3f& wi, float bsdf_pdf_omega, float distance_m) {
    const auto& lights = vertex.scene.lights();
    Rgb radiance(0.0f);
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const auto place = intersect_light(lights[i], vertex.point.position, wi);
        // A sun is met where the ray leaves the scene: infinity against infinity.
        if (!place || place->distance_m > distance_m) continue;
        const LightSampler light(lights[i], vertex.point, vertex.surface, vertex.settings.light_sampling);
        if (!vertex.shares_with_bsdf(light)) continue;
        const float probability = vertex.samples_all_lights ? 1.0f : choice_probability(lights, vertex.point, i);
        radiance += place->radiance * balance(bsdf_pdf_omega, probability * light.pdf_omega(*place));
    }
    return radiance;
}

}  // namespace

Sample trace_path(const Scene& scene, const RenderSettings& settings, const Ray& camera_ray, const Sampler& sampler) {
    Sample sample;
    Ray ray = camera_ray;
    auto hit = scene.intersect(ray, visible_to_camera);
    if (!hit) {
        if (settings.transparent_film) sample.alpha = 0.0f;
        if (!settings.transparent_film) sample.radiance = scene.world();
        return sample;
    }
    Rgb throughput(1.0f);
    for (std::uint32_t bounce = 0;; ++bounce) {
        const SurfacePoint point = scene.surface_point(ray, *hit);
        const Material& material = *point.material;
        sample.radiance += throughput * material.emission;
        if (bounce > settings.max_bounces) break;

        const Surface surface = make_surface(material, point.wo_local);
        if (bounce == 0) {
            sample.normal = point.frame.z;
            sample.albedo = surface.diffuse;
            sample.emission = material.emission;
        }
        const Vertex vertex{.scene = scene,
                            .settings = settings,
                            .sampler = sampler,
                            .point = point,
                            .surface = surface,
                            .dimensions = Dimensions(bounce, scene.lights().size()),
                            .samples_all_lights = bounce == 0};
        const DirectLight direct = sample_lights(vertex);
        sample.radiance += throughput * direct.radiance;
        if (bounce == settings.max_bounces && !direct.shares_with_bsdf && !scene.has_unsampled_light()) break;

        const Vec3f wi_local = pivot::sample(surface, sampler.number(vertex.dimensions.lobe()),
                                             sampler.point(vertex.dimensions.direction()));
        const Vec3f wi = point.frame.to_world(wi_local);
        const float bsdf_pdf_omega = pdf_omega(surface, wi_local);
        if (!(bsdf_pdf_omega > 0.0f) || !point.faces(wi)) break;
        throughput *= eval(surface, wi_local) / bsdf_pdf_omega;
        if (max_component(throughput) <= 0.0f) break;

        ray = {point.ray_origin(wi), wi};
        hit = scene.intersect(ray, visible_to_light);
        const float reached_m = hit ? hit->distance_m : ray.far_m;
        if (direct.shares_with_bsdf) {
            sample.radiance += throughput * lights_met(vertex, wi, bsdf_pdf_omega, reached_m);
        }
        if (!hit) {
            sample.radiance += throughput * scene.world();
            break;
        }
        if (bounce >= first_roulette_bounce) {
            const float survival = std::min(max_component(throughput), max_roulette_survival);
            // The lobe's second number is free: the first chose the lobe.
            if (sampler.point(vertex.dimensions.lobe()).y >= survival) break;
            throughput /= survival;
        }
    }
    return sample;
}

}  // namespace pivot
