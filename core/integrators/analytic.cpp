#include "core/integrators/analytic.h"

#include "core/integrators/area_light_shading.h"
#include "core/integrators/cap_light_shading.h"
#include "core/integrators/specular_occlusion.h"
#include "core/sampling/warp.h"

namespace pivot {
namespace {

/// What the Method pass shows, from cold to warm with the cost.
constexpr std::array<std::array<float, 3>, method_names.size()> method_colors{{{0.0f, 0.0f, 0.0f},
                                                                               {0.05f, 0.1f, 0.6f},
                                                                               {0.0f, 0.5f, 0.8f},
                                                                               {0.0f, 0.7f, 0.4f},
                                                                               {0.5f, 0.8f, 0.1f},
                                                                               {0.9f, 0.6f, 0.0f},
                                                                               {1.0f, 0.35f, 0.0f},
                                                                               {1.0f, 0.05f, 0.0f},
                                                                               {0.5f, 0.2f, 0.8f},
                                                                               {0.9f, 0.2f, 0.6f},
                                                                               {0.4f, 0.4f, 0.4f},
                                                                               {0.7f, 0.7f, 0.7f},
                                                                               {1.0f, 1.0f, 1.0f}}};

Rgb color_of(Method method) {
    const auto& c = method_colors[static_cast<std::size_t>(method)];
    return {c[0], c[1], c[2]};
}

/// A pixel's direct light so far: its methods and errors are weighted by what they contribute.
struct Gathered {
    Rgb radiance{0.0f}, method{0.0f};
    float error = 0.0f;

    void add(const Rgb& light, Method how, float predicted_error) {
        radiance += light;
        method += max_component(light) * color_of(how);
        error += max_component(light) * predicted_error;
    }
};

using LightShading = std::variant<CapLightShading, AreaLightShading>;

LightShading shade_light(const Light& light, const SurfaceBatch& batch, const RenderSettings& settings) {
    if (const auto* area = std::get_if<AreaLight>(&light)) return AreaLightShading(*area, batch, settings);
    return CapLightShading(light, batch, settings);
}

const Reflection& reflection_of(const LightShading& shading) {
    return std::visit([](const auto& s) -> const Reflection& { return s.reflection(); }, shading);
}

Reflection seen_by_rays(const LightShading& shading, const Scene& scene, const FixedPoints& points) {
    return std::visit([&](const auto& s) { return s.seen_by_rays(scene, points); }, shading);
}

/// The largest part that one light's reflection has of any lane's total.
float largest_share(const Reflection& reflection, std::span<const float> totals) {
    float share = 0.0f;
    for (std::size_t i = 0; i < totals.size(); ++i)
        if (totals[i] > 0.0f)
            share = std::max(share, max_component(reflection.diffuse[i] + reflection.glossy[i]) / totals[i]);
    return share;
}

/// All lights in closed form first: one that gives little of the total needs few rays for its share of the budget.
void add_lights(const Scene& scene, const RenderSettings& settings, const FixedPoints& points,
                const SurfaceBatch& batch, std::span<Gathered> gathered) {
    std::vector<LightShading> shadings;
    shadings.reserve(scene.lights().size());
    std::array<float, batch_size> totals{};
    for (const Light& light : scene.lights()) {
        shadings.push_back(shade_light(light, batch, settings));
        const Reflection& reflection = reflection_of(shadings.back());
        for (std::size_t i = 0; i < batch.count; ++i)
            totals[i] += max_component(reflection.diffuse[i] + reflection.glossy[i]);
    }
    for (std::size_t k = 0; k < shadings.size(); ++k) {
        Reflection reflection = reflection_of(shadings[k]);
        const float share = largest_share(reflection, std::span(totals).first(batch.count));
        if (!(share > 0.0f)) continue;
        if (settings.occlusion == Occlusion::ray_traced)
            reflection = seen_by_rays(shadings[k], scene, points.for_share(share));
        for (std::size_t i = 0; i < batch.count; ++i) {
            if (settings.occlusion == Occlusion::bent_cone) {
                const auto& [point, surface, bent_cone] = *batch.lanes[i];
                const SeenShare seen = seen_share(scene.lights()[k], bent_cone, point, surface);
                reflection.diffuse[i] *= seen.diffuse;
                reflection.glossy[i] *= seen.glossy;
            }
            gathered[i].add(reflection.diffuse[i], Method::points_1, 0.0f);
            gathered[i].add(reflection.glossy[i], reflection.method[i], reflection.predicted_error[i]);
        }
    }
}

Rgb shade_world(const Scene& scene, const ShadingPoint& shading, const RenderSettings& settings,
                const FixedPoints& points) {
    const auto& [point, surface, bent_cone] = shading;
    std::vector<Ray> rays;
    std::vector<Rgb> weights;
    const auto add = [&](const Vec3f& wi_local, const Rgb& weight) {
        const Vec3f wi = point.frame.to_world(wi_local);
        if (!point.faces(wi)) return;
        rays.push_back({point.ray_origin(wi), wi});
        weights.push_back(weight);
    };
    const std::uint32_t count = points.count();
    for (std::uint32_t k = 0; k < count; ++k) {
        if (surface.has_diffuse())
            add(sample_cosine_hemisphere(points.point(PointSet::world_diffuse, k, count)), surface.diffuse);
        if (!surface.has_glossy()) continue;
        const float alpha = surface.alpha;
        const Vec3f wi_local =
            ggx_sample(surface.wo_local, alpha, alpha, points.point(PointSet::world_glossy, k, count));
        if (wi_local.z <= 0.0f) continue;
        add(wi_local, eval_glossy(surface, wi_local) / ggx_pdf_omega(surface.wo_local, wi_local, alpha, alpha));
    }
    std::vector<std::uint8_t> occluded(rays.size());
    if (settings.occlusion == Occlusion::ray_traced) scene.occluded(rays, occluded);
    Rgb reflected(0.0f);
    for (std::size_t i = 0; i < rays.size(); ++i)
        if (!occluded[i] && (settings.occlusion != Occlusion::bent_cone || contains(bent_cone, rays[i].direction)))
            reflected += weights[i];
    return scene.world() * reflected / static_cast<float>(count);
}

void shade_batch(const Scene& scene, const RenderSettings& settings, const FixedPoints& points,
                 std::span<const ShadingPoint> shading, std::span<Gathered> gathered) {
    const SurfaceBatch batch = make_batch(shading);
    if (batch.has_diffuse || batch.has_glossy) add_lights(scene, settings, points, batch, gathered);
    if (max_component(scene.world()) > 0.0f) {
        for (std::size_t i = 0; i < shading.size(); ++i)
            gathered[i].add(shade_world(scene, shading[i], settings, points), Method::point_set, 0.0f);
    }
}

}  // namespace

void shade_analytic(const Scene& scene, const RenderSettings& settings, std::span<const Ray> camera_rays,
                    std::uint32_t sample_index, std::span<Sample> samples) {
    std::vector<std::optional<RayHit>> hits(camera_rays.size());
    scene.intersect(camera_rays, visible_to_camera, hits);
    std::vector<ShadingPoint> shading;
    std::vector<std::size_t> pixel;
    for (std::size_t i = 0; i < hits.size(); ++i) {
        Sample& sample = samples[i] = {};
        if (!hits[i]) {
            if (settings.transparent_film) sample.alpha = 0.0f;
            if (!settings.transparent_film) sample.radiance = scene.world();
            continue;
        }
        const SurfacePoint point = scene.surface_point(camera_rays[i], *hits[i]);
        const Surface surface = make_surface(*point.material, point.wo_local);
        sample.normal = point.frame.z;
        sample.albedo = surface.diffuse;
        sample.emission = point.material->emission;
        sample.radiance = point.material->emission;
        shading.push_back({point, surface, {}});
        if (settings.occlusion == Occlusion::bent_cone) shading.back().bent_cone = scene.bent_cone(*hits[i], point);
        pixel.push_back(i);
    }
    const FixedPoints points(settings, sample_index);
    for (std::size_t first = 0; first < shading.size(); first += batch_size) {
        const std::size_t count = std::min(batch_size, shading.size() - first);
        std::array<Gathered, batch_size> gathered{};
        shade_batch(scene, settings, points, std::span(shading).subspan(first, count),
                    std::span(gathered).first(count));
        for (std::size_t i = 0; i < count; ++i) {
            Sample& sample = samples[pixel[first + i]];
            const float weight = max_component(gathered[i].radiance);
            sample.radiance += gathered[i].radiance;
            sample.method = weight > 0.0f ? gathered[i].method / weight : Rgb(0.0f);
            sample.predicted_error = weight > 0.0f ? gathered[i].error / weight : 0.0f;
        }
    }
}

}  // namespace pivot
