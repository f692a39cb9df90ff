#include "core/integrators/light_choice.h"

#include <numeric>

#include "core/simd/batch.h"

namespace pivot {
namespace {

Batch load_at(const LightProxies::Values& values, std::size_t first) { return Batch::load_unaligned(&values[first]); }

struct Pick {
    float u;
    LightChoice choice;
};

/// Which child u falls into, and what is left of u within it.
std::size_t split(const LightProxies::Values& weights, std::size_t count, float total, float& u, float& probability) {
    float left = u * total;
    std::size_t chosen = count;
    for (std::size_t i = 0; i < count; ++i) {
        if (!(weights[i] > 0.0f)) continue;
        chosen = i;
        if (left < weights[i]) break;
        left -= weights[i];
    }
    u = std::min(left / weights[chosen], 1.0f - 0x1p-24f);
    probability *= weights[chosen] / total;
    return chosen;
}

/// Sends picks, whose u ascend, down from a node; a pick that finds nothing keeps probability 0.
void descend(const LightTree& tree, std::int32_t index, const SurfacePoint& point, const Surface& surface,
             std::span<Pick> picks) {
    const LightTree::Node& node = tree.nodes()[static_cast<std::size_t>(index)];
    const LightProxies::Values weights = light_importance(point, surface, node.proxies);
    const float total = std::accumulate(weights.begin(), weights.end(), 0.0f);
    if (!(total > 0.0f)) {
        for (Pick& pick : picks) pick.choice.probability = 0.0f;
        return;
    }
    for (std::size_t first = 0; first < picks.size();) {
        const std::size_t child = split(weights, node.count, total, picks[first].u, picks[first].choice.probability);
        std::size_t end = first + 1;
        while (end < picks.size()) {
            Pick next = picks[end];
            if (split(weights, node.count, total, next.u, next.choice.probability) != child) break;
            picks[end++] = next;
        }
        const std::span<Pick> together = picks.subspan(first, end - first);
        if (node.child[child] >= 0) {
            descend(tree, node.child[child], point, surface, together);
        } else {
            for (Pick& pick : together) pick.choice.light = static_cast<std::size_t>(~node.child[child]);
        }
        first = end;
    }
}

}  // namespace

LightProxies::Values light_importance(const SurfacePoint& point, const Surface& surface, const LightProxies& proxies) {
    const Vec3b position = broadcast(point.position), wo = broadcast(surface.wo_local);
    const Frame<Batch> frame{broadcast(point.frame.x), broadcast(point.frame.y), broadcast(point.frame.z)};
    const Batch alpha(surface.alpha), diffuse(mean_component(surface.diffuse));
    const Batch f0(mean_component(surface.fresnel.schlick_f0 + surface.fresnel.dielectric_f0));
    const Batch f90(mean_component(surface.fresnel.schlick_f90 + surface.fresnel.dielectric_f90));
    const Batch zero(0.0f), one(1.0f);

    LightProxies::Values importance;
    for (std::size_t first = 0; first < light_tree_width; first += batch_size) {
        const Vec3b center(load_at(proxies.center_x, first), load_at(proxies.center_y, first),
                           load_at(proxies.center_z, first));
        const Vec3b normal(load_at(proxies.normal_x, first), load_at(proxies.normal_y, first),
                           load_at(proxies.normal_z, first));
        const Batch sun_versine = load_at(proxies.sun_versine, first);
        const auto is_sun = sun_versine > zero;
        const Vec3b to_center = center - position;
        Cap<Batch> cap = cap_of_sphere(to_center, load_at(proxies.radius_m, first));
        cap.axis = select(is_sun, center, cap.axis);
        cap.versine = select(is_sun, sun_versine, cap.versine);

        // A flat light is seen at its slant, a spot within its cone.
        const Batch facing = -dot(to_center, normal) / max(length(to_center), tiny<Batch>);
        const Batch cos_light = select(load_at(proxies.two_sided, first) > zero, abs(facing), facing);
        const Batch cos_cone = load_at(proxies.cos_cone, first);
        const Batch lit = max((cos_light - cos_cone) / (one - cos_cone), load_at(proxies.least_lit, first));

        // Around the point, or nearly: all that is above it.
        const auto large = cap.versine > one;
        Cap<Batch> local{frame.to_local(cap.axis), cap.versine};
        local.axis = select(large, Vec3b(zero, zero, one), local.axis);
        local.versine = select(large, one, local.versine);
        const Batch sin2 = sin2_half_angle(local), sine = sqrt(sin2);
        const Batch cos_surface = min(max(local.axis.z, Batch(0.5f) * (local.axis.z + sine)), one);
        Batch reflected = diffuse * cos_surface * sin2;
        if (surface.has_glossy()) {
            // The lobe at the light's centre, wider by the light: what ggx_cap integrates, to some ten per cent.
            const Vec3b h = wo + local.axis;
            const Batch h2 = dot(h, h), alpha2 = alpha * alpha + Batch(0.25f) * sin2;
            const Batch slope = (h.x * h.x + h.y * h.y + alpha2 * h.z * h.z) / max(h2, tiny<Batch>);
            const Batch fresnel = lerp(f0, f90, schlick_weight(Batch(0.5f) * sqrt(h2)));
            const Batch density = alpha2 / max(Batch(4.0f * pi<float>) * wo.z * slope * slope, tiny<Batch>);
            reflected += fresnel * min(density * solid_angle(local), one);
        }
        reflected = select(local.axis.z + sine > zero, reflected, zero);
        const Batch result = reflected * lit * load_at(proxies.radiance, first);
        result.store_unaligned(&importance[first]);
    }
    return importance;
}

std::size_t choose_lights(const LightTree& tree, const SurfacePoint& point, const Surface& surface, float u,
                          std::span<LightChoice> choices) {
    if (tree.nodes().empty()) return 0;
    constexpr std::size_t most = 16;
    std::array<Pick, most> picks;
    const auto n = static_cast<float>(choices.size());
    for (std::size_t i = 0; i < choices.size(); ++i) picks[i] = {(static_cast<float>(i) + u) / n, {0, 1.0f}};
    descend(tree, 0, point, surface, std::span(picks).first(choices.size()));
    std::size_t count = 0;
    for (std::size_t i = 0; i < choices.size(); ++i) {
        if (picks[i].choice.probability > 0.0f) choices[count++] = picks[i].choice;
    }
    return count;
}

float choice_probability(const LightTree& tree, const SurfacePoint& point, const Surface& surface, std::size_t light) {
    auto [index, place] = tree.leaf(light);
    float probability = 1.0f;
    while (index >= 0) {
        const LightTree::Node& node = tree.nodes()[static_cast<std::size_t>(index)];
        const LightProxies::Values weights = light_importance(point, surface, node.proxies);
        const float total = std::accumulate(weights.begin(), weights.end(), 0.0f);
        if (!(weights[place] > 0.0f)) return 0.0f;
        probability *= weights[place] / total;
        index = node.parent;
        place = node.place_in_parent;
    }
    return probability;
}

}  // namespace pivot
