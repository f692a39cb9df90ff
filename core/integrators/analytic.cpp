#include "core/integrators/analytic.h"

#include "core/distributions/projected_cap.h"
#include "core/distributions/sptd.h"
#include "core/sampling/sobol.h"
#include "core/sampling/warp.h"
#include "core/tables/ggx_sptd.h"

namespace pivot {
namespace {

const Vec3f normal_local(0.0f, 0.0f, 1.0f);

/// Which of the fixed sets a point belongs to.
enum Set : std::uint32_t { on_light = 1, world_diffuse = 2, world_glossy = 3 };

/// The points that one camera sample takes of a fixed set. A penumbra's steps stay below the error budget once all
/// samples are in.
class PointSet {
   public:
    PointSet(const RenderSettings& settings, std::uint32_t sample_index)
        : count_(std::max(1u, static_cast<std::uint32_t>(std::ceil(
                                  100.0f / (settings.error_budget_percent * static_cast<float>(settings.samples)))))),
          first_(sample_index * count_) {}

    std::uint32_t count() const { return count_; }
    Vec2f point(Set set, std::uint32_t k) const { return Sampler(0u, first_ + k).point(set); }

   private:
    std::uint32_t count_, first_;
};

bool is_visible(const Scene& scene, const SurfacePoint& point, const Vec3f& wi, float distance_m) {
    return !scene.occluded({point.ray_origin(wi), wi, 0.0f, distance_m * (1.0f - 1e-5f)});
}

/// The direction of the cap nearest to omega.
Vec3f nearest_in_cap(const Cap<float>& cap, const Vec3f& omega) {
    if (contains(cap, omega)) return omega;
    const Vec3f across = omega - dot(omega, cap.axis) * cap.axis;
    return cos_half_angle(cap) * cap.axis +
           sqrt(sin2_half_angle(cap) / std::max(length_squared(across), 1e-12f)) * across;
}

/// The GGX lobe and the diffuse lobe integrated over a light's cap, of radiance 1.
Rgb reflect_cap(const Surface& surface, const Cap<float>& cap_local) {
    Rgb reflected = surface.diffuse * (clamped_cosine_integral(cap_local, normal_local) / pi<float>);
    if (surface.has_glossy()) {
        const GgxSptd lobe = ggx_sptd(surface.alpha, surface.wo_local);
        const Pivot<float> pivot{lobe.pivot_local, lobe.delta};
        const float share = lobe.amplitude() * integrate_uniform(pivot, cap_local, {normal_local, 1.0f});
        // Fresnel at the light's point nearest the mirror direction.
        const Vec3f mirror(-surface.wo_local.x, -surface.wo_local.y, surface.wo_local.z);
        const Vec3f h = normalize(surface.wo_local + nearest_in_cap(cap_local, mirror));
        reflected += surface.fresnel.at(std::abs(dot(surface.wo_local, h))) * share;
    }
    return reflected;
}

Rgb shade_cap_light(const Scene& scene, const Light& light, const Cap<float>& cap, const SurfacePoint& point,
                    const Surface& surface, const PointSet& points) {
    const Cap<float> cap_local{point.frame.to_local(cap.axis), cap.versine};
    const Rgb reflected = reflect_cap(surface, cap_local);
    if (max_component(reflected) <= 0.0f) return Rgb(0.0f);
    // The share of the light that is seen, a spot's falloff with it, weighted by the cosine to the normal.
    const auto seen_cap =
        projected_cap(cap_local.versine > 1.0f ? Cap<float>{normal_local, 1.0f} : cap_local, normal_local);
    Rgb seen(0.0f);
    for (std::uint32_t k = 0; k < points.count(); ++k) {
        const Vec3f wi = point.frame.to_world(sample(seen_cap, points.point(on_light, k)));
        const LightPoint place = light_point_in_cap(light, cap, point.position, wi);
        if (!point.faces(wi) || max_component(place.radiance) <= 0.0f) continue;
        if (is_visible(scene, point, wi, place.distance_m)) seen += place.radiance;
    }
    return reflected * seen / static_cast<float>(points.count());
}

Rgb shade_area_light(const Scene& scene, const Light& light, const SurfacePoint& point, const Surface& surface,
                     const PointSet& points) {
    Rgb sum(0.0f);
    for (std::uint32_t k = 0; k < points.count(); ++k) {
        const auto place = sample_light(light, point.position, points.point(on_light, k));
        if (!place || !point.faces(place->wi)) continue;
        const Rgb reflected = eval(surface, point.frame.to_local(place->wi)) * place->radiance / place->pdf_omega;
        if (max_component(reflected) > 0.0f && is_visible(scene, point, place->wi, place->distance_m)) sum += reflected;
    }
    return sum / static_cast<float>(points.count());
}

Rgb shade_world(const Scene& scene, const SurfacePoint& point, const Surface& surface, const PointSet& points) {
    Rgb reflected(0.0f);
    const auto add = [&](const Vec3f& wi_local, const Rgb& weight) {
        const Vec3f wi = point.frame.to_world(wi_local);
        if (point.faces(wi) && is_visible(scene, point, wi, std::numeric_limits<float>::infinity()))
            reflected += weight;
    };
    for (std::uint32_t k = 0; k < points.count(); ++k) {
        if (surface.has_diffuse()) add(sample_cosine_hemisphere(points.point(world_diffuse, k)), surface.diffuse);
        if (!surface.has_glossy()) continue;
        const float alpha = surface.alpha;
        const Vec3f wi_local = ggx_sample(surface.wo_local, alpha, alpha, points.point(world_glossy, k));
        if (wi_local.z <= 0.0f) continue;
        add(wi_local, eval_glossy(surface, wi_local) / ggx_pdf_omega(surface.wo_local, wi_local, alpha, alpha));
    }
    return scene.world() * reflected / static_cast<float>(points.count());
}

}  // namespace

Sample shade_analytic(const Scene& scene, const RenderSettings& settings, const Ray& camera_ray,
                      std::uint32_t sample_index) {
    Sample sample;
    const auto hit = scene.intersect(camera_ray, visible_to_camera);
    if (!hit) {
        if (settings.transparent_film) sample.alpha = 0.0f;
        if (!settings.transparent_film) sample.radiance = scene.world();
        return sample;
    }
    const SurfacePoint point = scene.surface_point(camera_ray, *hit);
    const Surface surface = make_surface(*point.material, point.wo_local);
    const PointSet points(settings, sample_index);
    sample.normal = point.frame.z;
    sample.albedo = surface.diffuse;
    sample.emission = point.material->emission;
    sample.radiance = point.material->emission;
    for (const Light& light : scene.lights()) {
        const auto cap = cap_from(light, point.position);
        sample.radiance += cap ? shade_cap_light(scene, light, *cap, point, surface, points)
                               : shade_area_light(scene, light, point, surface, points);
    }
    if (max_component(scene.world()) > 0.0f) sample.radiance += shade_world(scene, point, surface, points);
    return sample;
}

}  // namespace pivot
