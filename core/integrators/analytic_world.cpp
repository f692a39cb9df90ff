#include "core/integrators/analytic_world.h"

#include "core/integrators/bump_share.h"
#include "core/integrators/media_ray.h"
#include "core/integrators/specular_occlusion.h"
#include "core/sampling/warp.h"

namespace pivot {
namespace {

constexpr std::uint32_t bump_points = 64;
/// The world is hidden all around, by more than one edge: errors of this many times one edge's.
constexpr float edges_in_front = 2.0f;

float size_of(const Rgb& light) { return mean_component(abs(light)); }

}  // namespace

WorldReflection reflect_whole_world(const Scene& scene, const ShadingPoint& shading) {
    const Base& surface = shading.surface;
    constexpr Cap<float> above{Vec3f(0.0f, 0.0f, 1.0f), 1.0f};
    BumpShare bumped;
    if (surface.bump.is_turned())
        bumped = bump_share(surface.bump, above, bump_points, [](const Vec3f&) { return 1.0f; });
    WorldReflection whole;
    whole.diffuse = scene.world() * surface.diffuse * bumped.value;
    if (surface.has_glossy()) whole.glossy = scene.world() * glossy_albedo(surface);
    whole.bump_error = bumped.error;
    return whole;
}

WorldReflection world_seen_by_rays(const WorldReflection& whole, const Scene& scene, const ShadowPoints& points,
                                   const ShadingPoint& shading, float total) {
    const SurfacePoint& point = shading.point;
    const Base& surface = shading.surface;
    const float diffuse = size_of(whole.diffuse), glossy = size_of(whole.glossy);
    if (!(diffuse + glossy > 0.0f)) return whole;
    const float all = std::max(total, diffuse + glossy);  // which rounding may leave less of
    const bool is_bumped = surface.bump.is_turned();
    const float diffuse_share = edges_in_front * diffuse / all, glossy_share = edges_in_front * glossy / all;
    const ShadowPoints diffuse_points =
        is_bumped ? points.for_share_of_unequal(diffuse_share) : points.for_share(diffuse_share);
    const ShadowPoints glossy_points = points.for_share_of_unequal(glossy_share);
    LaneShares shares;
    const auto add_points = [&](const PartOfPoints& part, std::span<const bool>, ShadowRays& rays) {
        const auto add = [&](const Vec3f& wi_local, float of_diffuse, float of_glossy) {
            const Vec3f wi = point.frame.to_world(wi_local);
            rays.add({.origin = point.ray_origin(wi), .direction = wi, .time = point.time}, point.faces(wi),
                     {&shares, of_diffuse, of_glossy});
        };
        if (diffuse > 0.0f) {
            const auto [begin, end] = diffuse_points.range(part);
            for (std::uint32_t k = begin; k < end; ++k) {
                const Vec3f wi_local = sample_cosine_hemisphere(diffuse_points.point(PointSet::world_diffuse, k));
                add(wi_local, is_bumped ? surface.bump.cosine(wi_local) / wi_local.z : 1.0f, 0.0f);
            }
        }
        if (glossy > 0.0f) {
            const float alpha = surface.alpha;
            const auto [begin, end] = glossy_points.range(part);
            for (std::uint32_t k = begin; k < end; ++k) {
                const Vec3f wi_local =
                    ggx_sample(surface.wo_local, alpha, alpha, glossy_points.point(PointSet::world_glossy, k));
                if (wi_local.z <= 0.0f) continue;
                add(wi_local, 0.0f,
                    size_of(eval_glossy(surface, wi_local)) / ggx_pdf_omega(surface.wo_local, wi_local, alpha, alpha));
            }
        }
    };
    // What media leave of what is seen.
    Rgb left_diffuse(0.0f), left_glossy(0.0f);
    MediaRay media(scene.media());
    ShadowRays::OnSeen on_seen;
    if (!scene.media().is_empty())
        on_seen = [&](const Ray& ray, const ShadowRays::Probe& probe, const Rgb& left) {
            media.follow(ray, nullptr);
            left_diffuse += probe.diffuse * left * media.through();
            left_glossy += probe.glossy * left * media.through();
        };
    ask_points(scene, points, 1.0f, {&shares, 1}, add_points, on_seen);
    WorldReflection seen = whole;
    if (on_seen) {
        const auto of_seen = [](const Rgb& left, const Rgb& seen_color) {
            return left / max(seen_color, Rgb(tiny<float>));
        };
        if (shares.diffuse.seen > 0.0f) seen.diffuse *= of_seen(left_diffuse, shares.diffuse.seen_color);
        if (shares.glossy.seen > 0.0f) seen.glossy *= of_seen(left_glossy, shares.glossy.seen_color);
    }
    const auto deviation = [&](const VisibleShare& share) {
        return std::sqrt(std::max(share.variance(), points.missed_variance(share)));
    };
    seen.shadow_variance =
        sqr(size_of(seen.diffuse) * deviation(shares.diffuse) + size_of(seen.glossy) * deviation(shares.glossy));
    seen.diffuse *= shares.diffuse.color();
    seen.glossy *= shares.glossy.color();
    return seen;
}

WorldReflection world_seen_by_cone(const WorldReflection& whole, const ShadingPoint& shading) {
    const SeenShare share = seen_share_of_world(shading.bent_cone, shading.point, shading.surface);
    WorldReflection seen = whole;
    seen.cone_error = error_of_bent_cone(whole.diffuse, share.diffuse) + error_of_bent_cone(whole.glossy, share.glossy);
    seen.diffuse *= share.diffuse;
    seen.glossy *= share.glossy;
    return seen;
}

float error_of_bent_cone(const Rgb& whole, float seen) { return size_of(whole) * std::min(seen, 1.0f - seen); }

}  // namespace pivot
