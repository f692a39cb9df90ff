#include "core/integrators/area_sampling.h"

#include <numeric>

#include "core/integrators/light_choice.h"
#include "core/sampling/warp.h"

namespace pivot {
namespace {

constexpr int max_levels = 2;
/// Of each choice, this share is even over the patches: it bounds what a patch that looks dark can weigh.
constexpr float even_share = 0.1f;

/// A part of the unit square that area-preservingly maps to the light.
struct Patch {
    Vec2f low{0.0f}, size{1.0f};
    float probability = 1.0f;
};

/// How often the light is cut: until a patch looks small beside the lobe.
int level_count(const AreaLight& light, const SurfacePoint& point, const Surface& surface) {
    const float alpha = surface.has_glossy() ? surface.alpha : 1.0f;
    const float size_over_lobe = std::sqrt(light.area_m2) / (length(light.center - point.position) * alpha);
    return size_over_lobe < 0.5f ? 0 : size_over_lobe < 2.0f ? 1 : max_levels;
}

/// Goes down the patches; choose(weights) gives the child to take, of 4 x 2 along the longer side.
template <class Choose>
Patch descend(const AreaLight& light, const SurfacePoint& point, const Surface& surface, const Choose& choose) {
    Patch patch;
    for (int level = level_count(light, point, surface); level > 0; --level) {
        const bool wide = length(light.half_u) * patch.size.x >= length(light.half_v) * patch.size.y;
        const Vec2f size = patch.size / (wide ? Vec2f(4.0f, 2.0f) : Vec2f(2.0f, 4.0f));
        const auto low_of = [&](std::size_t child) {
            const Vec2f cell = wide ? Vec2f(child % 4, child / 4) : Vec2f(child % 2, child / 2);
            return patch.low + cell * size;
        };
        LightProxies proxies;
        for (std::size_t i = 0; i < light_tree_width; ++i) {
            proxies.set_flat(i, place_on(light, low_of(i) + 0.5f * size), light.area_m2 * size.x * size.y, light.normal,
                             mean_component(light.radiance));
        }
        LightProxies::Values weights = light_importance(point, surface, proxies);
        const float total = std::accumulate(weights.begin(), weights.end(), 0.0f);
        for (float& weight : weights) {
            weight = lerp(total > 0.0f ? weight / total : 1.0f / light_tree_width, 1.0f / light_tree_width, even_share);
        }
        const std::size_t child = choose(weights, low_of, size);
        patch = {low_of(child), size, patch.probability * weights[child]};
    }
    return patch;
}

/// Over the density by area, of a place at the patch.
float relative_density(const Patch& patch) { return patch.probability / (patch.size.x * patch.size.y); }

}  // namespace

bool area_patches_suffice(const AreaLight& light, const SurfacePoint& point, const Surface& surface) {
    return level_count(light, point, surface) < max_levels;
}

std::optional<LightPoint> sample_area_jointly(const AreaLight& light, const SurfacePoint& point, const Surface& surface,
                                              const Vec2f& u) {
    if (dot(point.position - light.center, light.normal) <= 0.0f) return std::nullopt;
    Vec2f left = u;
    const Patch patch = descend(light, point, surface, [&](const LightProxies::Values& weights, const auto&, auto) {
        std::size_t child = 0;
        while (child + 1 < light_tree_width && left.x >= weights[child]) left.x -= weights[child++];
        left.x = std::min(left.x / weights[child], 1.0f - 0x1p-24f);
        return child;
    });
    const Vec3f d = place_on(light, patch.low + left * patch.size) - point.position;
    const float distance_m = length(d);
    const float cos_light = -dot(d, light.normal) / distance_m;
    if (!(distance_m > 0.0f) || !(cos_light > 0.0f)) return std::nullopt;
    const float pdf_omega = relative_density(patch) * sqr(distance_m) / (cos_light * light.area_m2);
    return LightPoint{d / distance_m, distance_m, light.radiance, pdf_omega};
}

float pdf_omega_area_jointly(const AreaLight& light, const SurfacePoint& point, const Surface& surface,
                             const LightPoint& place) {
    const Vec2f on_light = area_coordinates(light, point.position + place.distance_m * place.wi);
    const Vec2f u = light.ellipse ? invert_disk(on_light) : 0.5f * on_light + 0.5f;
    const Patch patch =
        descend(light, point, surface, [&](const LightProxies::Values&, const auto& low_of, const Vec2f& size) {
            std::size_t nearest = 0;
            float least = std::numeric_limits<float>::infinity();
            for (std::size_t i = 0; i < light_tree_width; ++i) {
                const Vec2f off = abs((u - low_of(i)) / size - 0.5f);
                const float distance = std::max(off.x, off.y);
                if (distance < least) nearest = i, least = distance;
            }
            return nearest;
        });
    return relative_density(patch) * place.pdf_omega;  // which is that of a uniform sample by area
}

}  // namespace pivot
