#include "core/integrators/lobe_points.h"

#include "core/integrators/cap_light_shading.h"
#include "core/integrators/direct_light.h"
#include "core/integrators/light_sampler.h"
#include "core/integrators/lit_share.h"
#include "core/integrators/media_ray.h"
#include "core/integrators/vertex.h"
#include "core/shading/method.h"

namespace pivot {
namespace {

/// Points of a light that its samples follow, and of one that they do not, whose lobe may be anywhere: points by the
/// lobe must find it.
struct PointCounts {
    std::uint32_t fewest, most;
};
constexpr PointCounts followed{16, 256}, sought{128, 1024};
/// Of what is thinner than a pixel, which shows the mean of many places.
constexpr PointCounts of_strands{16, 16};

/// A direction, and what light from there adds.
struct WeightedPoint {
    Vec3f wi;
    float reach_m;
    Rgb value;
};

/// Point k of so many, of either technique.
void add_points(const Light& light, const LightSampler& sampler, const Vertex& vertex, const Vec2f& u_light,
                const Vec3f& u_lobe, std::vector<WeightedPoint>& result) {
    const SurfacePoint& point = vertex.point;
    const Surface& lobe = vertex.surface;
    if (const auto place = sampler.sample(u_light); place && place->pdf_omega > 0.0f && vertex.is_open_to(place->wi)) {
        const Vec3f wi_local = point.frame.to_local(place->wi);
        const float share = sampler.shares_with_bsdf() ? balance(place->pdf_omega, pdf_omega(lobe, wi_local)) : 1.0f;
        result.push_back({place->wi, place->distance_m * shadow_reach,
                          eval(lobe, wi_local) * place->radiance * (share / place->pdf_omega)});
    }
    if (!sampler.shares_with_bsdf()) return;
    const Vec3f wi_local = sample(lobe, u_lobe.x, Vec2f(u_lobe.y, u_lobe.z)), wi = point.frame.to_world(wi_local);
    const float pdf = pdf_omega(lobe, wi_local);
    if (!(pdf > 0.0f) || !vertex.is_open_to(wi)) return;
    if (const auto place = intersect_light(light, point.position, wi))
        result.push_back({wi, place->distance_m * shadow_reach,
                          eval(lobe, wi_local) * place->radiance * (balance(pdf, sampler.pdf_omega(*place)) / pdf)});
}

bool is_of_strands(const Surface& surface) {
    bool result = false;
    for_each_lobe(surface, [&]<class L>(const L&, const LobeOf<float>&, bool) {
        if constexpr (requires { requires L::is_of_strands; }) result = true;
    });
    return result;
}

Vec3f lobe_numbers(const ShadowPoints& points, PointSet set, std::uint32_t k, std::uint32_t count) {
    const Vec2f u = points.point(set, k, count);
    const float turns = (static_cast<float>(k) + 0.5f) * 0.7548777f;  // R2's second ratio: apart from both of u
    return {turns - std::floor(turns), u.x, u.y};
}

/// The points' sum, and what of it is seen.
struct Seen {
    Rgb radiance{0.0f};  ///< without what media take
    Rgb through{1.0f};   ///< and what they leave of it
    VisibleShare share;

    float variance() const { return sqr(share.all) * share.variance(); }
};

Seen look(const Scene& scene, std::uint32_t max_passages, const LightLinks& links, const SurfacePoint& point,
          std::span<const WeightedPoint> all, bool traces_rays) {
    std::vector<Ray> rays;
    for (const WeightedPoint& p : all) rays.push_back({point.ray_origin(p.wi), p.wi, 0.0f, p.reach_m, point.time});
    std::vector<Rgb> open(rays.size(), Rgb(1.0f));
    ProgramMemory memory;
    if (traces_rays) light_along(scene, max_passages, links, rays, open, memory);
    Seen result;
    for (std::size_t i = 0; i < all.size(); ++i) {
        result.radiance += all[i].value * open[i];
        result.share.add(mean_component(all[i].value), open[i]);
    }
    if (scene.media().is_empty()) return result;
    MediaRay ray(scene.media());
    Rgb left(0.0f);
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (!(max_component(open[i]) > 0.0f)) continue;
        ray.follow(rays[i], nullptr);
        left += all[i].value * open[i] * ray.through();
    }
    for (int c = 0; c < 3; ++c)
        if (result.radiance[c] > 0.0f) result.through[c] = left[c] / result.radiance[c];
    return result;
}

}  // namespace

LobeReflection reflect_light(const Scene& scene, const RenderSettings& settings, const ShadowPoints& points,
                             const Light& light, const LightRules& rules, const SurfacePoint& point,
                             const Surface& lobe) {
    const LightSampler sampler(light, point, lobe, LightSampling::joint);
    const Vertex vertex{{}, point, lobe};
    const float budget = 0.01f * settings.error_budget_percent;
    const PointCounts& counts = is_of_strands(lobe) ? of_strands : sampler.shares_with_bsdf() ? sought : followed;
    LobeReflection result;
    std::vector<WeightedPoint> all;
    for (std::uint32_t count = std::max(points.count(), counts.fewest);; count *= 2) {
        all.clear();
        std::array<float, 2> halves{};
        float squares = 0.0f;
        for (std::uint32_t k = 0; k < count; ++k) {
            const std::size_t first = all.size();
            add_points(light, sampler, vertex, points.point(PointSet::lobe_light, k, count),
                       lobe_numbers(points, PointSet::lobe_direction, k, count), all);
            float both = 0.0f;
            for (std::size_t i = first; i < all.size(); ++i) both += mean_component(all[i].value);
            halves[k % 2] += both;
            squares += sqr(both);
        }
        const float sum = halves[0] + halves[1];
        // Evenly spread points are off by less than random ones; those that seek a lobe may be as far off.
        const float spread = sampler.shares_with_bsdf() ? std::sqrt(squares) : 0.0f;
        result.error = sum > 0.0f ? std::max(std::abs(halves[0] - halves[1]), spread) / sum : 0.0f;
        const auto n = static_cast<float>(count);
        for (WeightedPoint& p : all) p.value *= lit_share(rules, lobe, point.frame.to_local(p.wi)) / n;
        if (result.error < budget || count * 2 > std::max(counts.most, points.count())) break;
    }
    const bool traces_rays = settings.occlusion == Occlusion::ray_traced && rules.casts_shadows;
    const Seen seen = look(scene, settings.max_passages, rules.links, point, all, traces_rays);
    result.radiance = seen.radiance * (rules.casts_shadows ? seen.through : Rgb(1.0f));
    result.shadow_variance = seen.variance();
    return result;
}

LobeReflection reflect_world(const Scene& scene, const RenderSettings& settings, const ShadowPoints& points,
                             const SurfacePoint& point, const Surface& lobe) {
    Rgb albedo = albedo_base(lobe);
    for_each_lobe(lobe, [&](const auto& l, const LobeOf<float>&, bool) { albedo += l.albedo(lobe.wo_local); });
    const std::uint32_t count = std::max(points.count(), followed.fewest);
    std::vector<WeightedPoint> all;
    const Vertex vertex{{}, point, lobe};
    for (std::uint32_t k = 0; k < count; ++k) {
        const Vec3f u = lobe_numbers(points, PointSet::lobe_world, k, count);
        const Vec3f wi_local = sample(lobe, u.x, Vec2f(u.y, u.z)), wi = point.frame.to_world(wi_local);
        const float pdf = pdf_omega(lobe, wi_local);
        if (pdf > 0.0f && vertex.is_open_to(wi))
            all.push_back({wi, std::numeric_limits<float>::infinity(), eval(lobe, wi_local) / pdf});
    }
    const Seen seen =
        look(scene, settings.max_passages, LightLinks{}, point, all, settings.occlusion == Occlusion::ray_traced);
    if (!(seen.share.all > 0.0f)) return {};
    Rgb whole(0.0f), lit(0.0f);
    for (const WeightedPoint& p : all) {
        whole += p.value;
        lit += p.value * lit_share(scene.world_rules(), lobe, point.frame.to_local(p.wi));
    }
    const Rgb light = scene.world() * albedo * (lit / max(whole, Rgb(tiny<float>)));
    return {light * seen.through * seen.share.color(), error_of_albedo,
            sqr(mean_component(abs(light))) * std::max(seen.share.variance(), points.missed_variance(seen.share))};
}

}  // namespace pivot
