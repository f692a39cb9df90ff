#include "core/integrators/light_choice.h"

#include <algorithm>

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
    T around;  ///< what is scattered alike from all sides
};
using Receiver = ReceiverOf<Batch>;

template <class T>
ReceiverOf<T> receiver_at(const VertexOf<T>& vertex) {
    return {vertex.point.position, vertex.point.frame, joint_surface(vertex.surface), lobe_albedo(vertex.surface),
            T(0)};
}

ReceiverOf<float> receiver_at(const Vec3f& position) {
    const Vec3f up(0.0f, 0.0f, 1.0f);
    return {position, frame_from_z(up), {up, 1.0f, 0.0f, 0.0f, 0.0f}, {0.0f, 0.0f}, 1.0f};
}

/// How much of each light a surface reflects if nothing is in the way, nearly: above 0 for each that reaches it.
/// Relative to each other only. Lanes are lights, or vertices, or both.
Batch light_importance(const Receiver& receiver, const LightProxy& light) {
    const JointSurface<Batch>& surface = receiver.surface;
    const Batch zero(0.0f), one(1.0f);
    const auto is_sun = light.sun_versine > zero;
    const Vec3b to_center = light.center - receiver.position;
    const Batch inverse_distance = inverse_sqrt(max(length_squared(to_center), tiny<Batch>));
    const Vec3b towards = select(is_sun, light.center, to_center * inverse_distance);

    // A flat light is seen at its slant, a spot within its cone.
    const Batch facing = -dot(towards, light.normal);
    const Batch cos_light = select(light.two_sided > zero, abs(facing), facing);
    const Batch lit =
        max((cos_light - light.cos_cone) * inverse(max(one - light.cos_cone, tiny<Batch>)), light.least_lit);

    // Around the point, or nearly: all that is above it.
    const Batch of_sphere = sqr(light.radius_m * inverse_distance);
    const Batch of_sun = light.sun_versine * (Batch(2.0f) - light.sun_versine);
    const auto large = light.sun_versine > one || of_sphere > one;
    const Vec3b axis = select(large, Vec3b(zero, zero, one), receiver.frame.to_local(towards));
    const Batch sin2 = select(large, one, select(is_sun, of_sun, of_sphere)), sine = sqrt(sin2);
    const Batch cos_surface = min(max(axis.z, Batch(0.5f) * (axis.z + sine)), one);
    Batch reflected = surface.diffuse * cos_surface * sin2;
    if (any(surface.fresnel_f0 + surface.fresnel_f90 > zero)) {
        // The lobe at the light's centre, wider by the light: what ggx_cap integrates, to some ten per cent.
        const Vec3b h = surface.wo_local + axis;
        const Batch h2 = dot(h, h), alpha2 = surface.alpha * surface.alpha + Batch(0.25f) * sin2;
        const Batch slope = (h.x * h.x + h.y * h.y + alpha2 * h.z * h.z) * inverse(max(h2, tiny<Batch>));
        const Batch fresnel = lerp(surface.fresnel_f0, surface.fresnel_f90, schlick_weight(Batch(0.5f) * sqrt(h2)));
        const Batch density =
            alpha2 * inverse(max(Batch(4.0f * pi<float>) * surface.wo_local.z * slope * slope, tiny<Batch>));
        const Batch solid_angle = Batch(2.0f * pi<float>) * sin2 * inverse(one + safe_sqrt(one - sin2));
        reflected += fresnel * min(density * solid_angle, one);
    }
    // Of further lobes what an even one of their albedo would send on, so that no light that they meet is forgotten.
    if (any(receiver.lobes.above > zero)) reflected += receiver.lobes.above * cos_surface * sin2;
    reflected = select(axis.z + sine > zero, reflected, zero);
    if (any(receiver.lobes.below > zero)) {
        const Batch cos_below = select(large, one, min(max(-axis.z, Batch(0.5f) * (sine - axis.z)), one));
        reflected += receiver.lobes.below * max(cos_below, zero) * sin2;
    }
    reflected += receiver.around * sin2;
    // Where there is no light, what is above has no meaning.
    return select(light.radiance > zero, reflected * lit * light.radiance, zero);
}

/// What a node's children weigh for one vertex, each with all before it. Past the last child: all.
Weights cumulative_weights(const LightTree::Node& node, const Receiver& receiver) {
    Weights weights;
    for (std::size_t first = 0; first < light_tree_width; first += batch_size)
        light_importance(receiver, node.proxies.batch(first)).store_unaligned(&weights[first]);
    float sum = 0.0f;
    for (float& weight : weights) weight = sum += weight;
    return weights;
}

/// One of a vertex's choices on its way down the tree.
struct Pick {
    float u;
    std::uint32_t child;
    std::size_t light;
    float probability;
};

/// Sends a pick to the child that its u falls into, and leaves what is left of u within it. The weights' sum is above
/// 0, so that the child's is too.
void choose_child(const Weights& cumulative, Pick& pick) {
    const float total = cumulative.back(), at = pick.u * total;
    std::uint32_t child = 0;
    for (const float sum : cumulative) child += sum <= at ? 1 : 0;
    const float before = child > 0 ? cumulative[child - 1] : 0.0f, weight = cumulative[child] - before;
    pick.child = child;
    pick.u = std::min((at - before) / weight, 1.0f - 0x1p-24f);
    pick.probability *= weight / total;
}

/// Sends picks, whose u ascend, down from a node; a pick that finds nothing gets probability 0.
/// weights_of(node): cumulative_weights.
template <class WeightsOf>
void descend(const LightTree& tree, const LightTree::Node& node, const Weights& cumulative, const WeightsOf& weights_of,
             std::span<Pick> picks) {
    if (!(cumulative.back() > tiny<float>)) {
        for (Pick& pick : picks) pick.probability = 0.0f;
        return;
    }
    for (Pick& pick : picks) choose_child(cumulative, pick);
    for (std::size_t first = 0, end; first < picks.size(); first = end) {
        const std::uint32_t child = picks[first].child;
        for (end = first + 1; end < picks.size() && picks[end].child == child;) ++end;
        const std::span<Pick> together = picks.subspan(first, end - first);
        if (node.child[child] >= 0) {
            const LightTree::Node& below = tree.nodes()[static_cast<std::size_t>(node.child[child])];
            descend(tree, below, weights_of(below), weights_of, together);
        } else {
            for (Pick& pick : together) pick.light = static_cast<std::size_t>(~node.child[child]);
        }
    }
}

}  // namespace

void choose_lights(const LightTree& tree, const VertexBatch& vertices, const Batch& u,
                   std::span<LightChoices> choices) {
    const LightTree::Node& root = tree.nodes()[0];
    const Receiver receiver = receiver_at<Batch>(vertices);
    std::optional<std::array<ReceiverOf<float>, batch_size>> each;
    std::array<Lanes, light_tree_width> root_weights;  // [child][vertex], each child's with all before it
    Batch sum(0.0f);
    for (std::size_t i = 0; i < light_tree_width; ++i) {
        if (i < root.count) sum += light_importance(receiver, root.proxies.broadcast(i));
        root_weights[i] = store(sum);
    }
    const Lanes u_lanes = store(u);
    const auto n = static_cast<float>(choices.size());
    std::array<Pick, max_light_samples> picks;
    for (std::size_t lane = 0; lane < vertices.count(); ++lane) {
        for (std::size_t k = 0; k < choices.size(); ++k)
            picks[k] = {(static_cast<float>(k) + u_lanes[lane]) / n, 0, 0, 1.0f};
        Weights weights;
        for (std::size_t i = 0; i < light_tree_width; ++i) weights[i] = root_weights[i][lane];
        std::optional<Receiver> alone;
        const auto weights_of = [&](const LightTree::Node& node) {
            if (!each) each = unpack<ReceiverOf>(receiver);
            if (!alone) alone = broadcast<ReceiverOf>((*each)[lane]);
            return cumulative_weights(node, *alone);
        };
        descend(tree, root, weights, weights_of, std::span(picks).first(choices.size()));
        for (std::size_t k = 0; k < choices.size(); ++k) {
            choices[k].light[lane] = picks[k].light;
            choices[k].probability[lane] = picks[k].probability;
        }
    }
}

namespace {

float choice_probability(const LightTree& tree, const Receiver& receiver, std::size_t light) {
    auto [index, place] = tree.leaf(light);
    float probability = 1.0f;
    while (index >= 0) {
        const LightTree::Node& node = tree.nodes()[static_cast<std::size_t>(index)];
        const Weights cumulative = cumulative_weights(node, receiver);
        const float weight = cumulative[place] - (place > 0 ? cumulative[place - 1] : 0.0f);
        if (!(weight > 0.0f) || !(cumulative.back() > tiny<float>)) return 0.0f;
        probability *= weight / cumulative.back();
        index = node.parent;
        place = node.place_in_parent;
    }
    return probability;
}

}  // namespace

float choice_probability(const LightTree& tree, const Vertex& vertex, std::size_t light) {
    return choice_probability(tree, broadcast<ReceiverOf>(receiver_at(vertex)), light);
}

float choice_probability(const LightTree& tree, const Vec3f& position, std::size_t light) {
    return choice_probability(tree, broadcast<ReceiverOf>(receiver_at(position)), light);
}

std::pair<std::size_t, float> choose_light(const LightTree& tree, const Vec3f& position, float u) {
    const Receiver receiver = broadcast<ReceiverOf>(receiver_at(position));
    const auto weights_of = [&](const LightTree::Node& node) { return cumulative_weights(node, receiver); };
    const LightTree::Node& root = tree.nodes()[0];
    Pick pick{u, 0, 0, 1.0f};
    descend(tree, root, weights_of(root), weights_of, {&pick, 1});
    return {pick.light, pick.probability};
}

}  // namespace pivot
