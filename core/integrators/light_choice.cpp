#include "core/integrators/light_choice.h"

#include <numeric>

#include "core/integrators/joint_sampling.h"

namespace pivot {
namespace {

using Weights = LightProxies::Values;

/// Vertices, or one in every lane, as lights are weighed for them.
template <class T>
struct ReceiverOf {
    Vec3<T> position;
    Frame<T> frame;
    JointSurface<T> surface;
    LobeAlbedoOf<T> lobes;
};
using Receiver = ReceiverOf<Batch>;

template <class T>
ReceiverOf<T> receiver_at(const VertexOf<T>& vertex) {
    return {vertex.point.position, vertex.point.frame, joint_surface(vertex.surface), lobe_albedo(vertex.surface)};
}

/// How much of each light a surface reflects if nothing is in the way, nearly: above 0 for each that reaches it.
/// Relative to each other only. Lanes are lights, or vertices, or both.
Batch light_importance(const Receiver& receiver, const LightProxy& light) {
    const JointSurface<Batch>& surface = receiver.surface;
    const Batch zero(0.0f), one(1.0f);
    const auto is_sun = light.sun_versine > zero;
    const Vec3b to_center = light.center - receiver.position;
    Cap<Batch> cap = cap_of_sphere(to_center, light.radius_m);
    cap.axis = select(is_sun, light.center, cap.axis);
    cap.versine = select(is_sun, light.sun_versine, cap.versine);

    // A flat light is seen at its slant, a spot within its cone.
    const Batch facing = -dot(to_center, light.normal) / max(length(to_center), tiny<Batch>);
    const Batch cos_light = select(light.two_sided > zero, abs(facing), facing);
    const Batch lit = max((cos_light - light.cos_cone) / (one - light.cos_cone), light.least_lit);

    // Around the point, or nearly: all that is above it.
    const auto large = cap.versine > one;
    Cap<Batch> local{receiver.frame.to_local(cap.axis), cap.versine};
    local.axis = select(large, Vec3b(zero, zero, one), local.axis);
    local.versine = select(large, one, local.versine);
    const Batch sin2 = sin2_half_angle(local), sine = sqrt(sin2);
    const Batch cos_surface = min(max(local.axis.z, Batch(0.5f) * (local.axis.z + sine)), one);
    Batch reflected = surface.diffuse * cos_surface * sin2;
    if (any(surface.fresnel_f0 + surface.fresnel_f90 > zero)) {
        // The lobe at the light's centre, wider by the light: what ggx_cap integrates, to some ten per cent.
        const Vec3b h = surface.wo_local + local.axis;
        const Batch h2 = dot(h, h), alpha2 = surface.alpha * surface.alpha + Batch(0.25f) * sin2;
        const Batch slope = (h.x * h.x + h.y * h.y + alpha2 * h.z * h.z) / max(h2, tiny<Batch>);
        const Batch fresnel = lerp(surface.fresnel_f0, surface.fresnel_f90, schlick_weight(Batch(0.5f) * sqrt(h2)));
        const Batch density = alpha2 / max(Batch(4.0f * pi<float>) * surface.wo_local.z * slope * slope, tiny<Batch>);
        reflected += fresnel * min(density * solid_angle(local), one);
    }
    // Of further lobes what an even one of their albedo would send on, so that no light that they meet is forgotten.
    if (any(receiver.lobes.above > zero)) reflected += receiver.lobes.above * cos_surface * sin2;
    reflected = select(local.axis.z + sine > zero, reflected, zero);
    if (any(receiver.lobes.below > zero)) {
        const Batch cos_below = select(large, one, min(max(-local.axis.z, Batch(0.5f) * (sine - local.axis.z)), one));
        reflected += receiver.lobes.below * max(cos_below, zero) * sin2;
    }
    return reflected * lit * light.radiance;
}

/// What a node's children weigh for one vertex.
Weights child_weights(const LightTree::Node& node, const Receiver& receiver) {
    Weights weights;
    for (std::size_t first = 0; first < light_tree_width; first += batch_size)
        light_importance(receiver, node.proxies.batch(first)).store_unaligned(&weights[first]);
    return weights;
}

struct Pick {
    float u;
    std::size_t light;
    float probability;
};

/// Which child u falls into, and what is left of u within it.
std::size_t split(const Weights& weights, std::size_t count, float total, float& u, float& probability) {
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
/// weights_of(node): of the node's children.
template <class WeightsOf>
void descend(const LightTree& tree, const LightTree::Node& node, const Weights& weights, const WeightsOf& weights_of,
             std::span<Pick> picks) {
    const float total = std::accumulate(weights.begin(), weights.begin() + node.count, 0.0f);
    if (!(total > 0.0f)) {
        for (Pick& pick : picks) pick.probability = 0.0f;
        return;
    }
    for (std::size_t first = 0; first < picks.size();) {
        const std::size_t child = split(weights, node.count, total, picks[first].u, picks[first].probability);
        std::size_t end = first + 1;
        while (end < picks.size()) {
            Pick next = picks[end];
            if (split(weights, node.count, total, next.u, next.probability) != child) break;
            picks[end++] = next;
        }
        const std::span<Pick> together = picks.subspan(first, end - first);
        if (node.child[child] >= 0) {
            const LightTree::Node& below = tree.nodes()[static_cast<std::size_t>(node.child[child])];
            descend(tree, below, weights_of(below), weights_of, together);
        } else {
            for (Pick& pick : together) pick.light = static_cast<std::size_t>(~node.child[child]);
        }
        first = end;
    }
}

}  // namespace

void choose_lights(const LightTree& tree, const VertexBatch& vertices, const Batch& u,
                   std::span<LightChoices> choices) {
    const LightTree::Node& root = tree.nodes()[0];
    const Receiver receiver = receiver_at<Batch>(vertices);
    std::optional<std::array<ReceiverOf<float>, batch_size>> each;
    std::array<Lanes, light_tree_width> root_weights;  // [child][vertex]
    for (std::size_t i = 0; i < root.count; ++i)
        root_weights[i] = store(light_importance(receiver, root.proxies.broadcast(i)));
    const Lanes u_lanes = store(u);
    const auto n = static_cast<float>(choices.size());
    std::array<Pick, max_light_samples> picks;
    for (std::size_t lane = 0; lane < vertices.count(); ++lane) {
        for (std::size_t k = 0; k < choices.size(); ++k)
            picks[k] = {(static_cast<float>(k) + u_lanes[lane]) / n, 0, 1.0f};
        Weights weights{};
        for (std::size_t i = 0; i < root.count; ++i) weights[i] = root_weights[i][lane];
        std::optional<Receiver> alone;
        const auto weights_of = [&](const LightTree::Node& node) {
            if (!each) each = unpack<ReceiverOf>(receiver);
            if (!alone) alone = broadcast<ReceiverOf>((*each)[lane]);
            return child_weights(node, *alone);
        };
        descend(tree, root, weights, weights_of, std::span(picks).first(choices.size()));
        for (std::size_t k = 0; k < choices.size(); ++k) {
            choices[k].light[lane] = picks[k].light;
            choices[k].probability[lane] = picks[k].probability;
        }
    }
}

float choice_probability(const LightTree& tree, const Vertex& vertex, std::size_t light) {
    const Receiver receiver = broadcast<ReceiverOf>(receiver_at(vertex));
    auto [index, place] = tree.leaf(light);
    float probability = 1.0f;
    while (index >= 0) {
        const LightTree::Node& node = tree.nodes()[static_cast<std::size_t>(index)];
        const Weights weights = child_weights(node, receiver);
        const float total = std::accumulate(weights.begin(), weights.begin() + node.count, 0.0f);
        if (!(weights[place] > 0.0f)) return 0.0f;
        probability *= weights[place] / total;
        index = node.parent;
        place = node.place_in_parent;
    }
    return probability;
}

}  // namespace pivot
