#include "core/integrators/light_choice.h"

#include <algorithm>
#include <numeric>

namespace pivot {
namespace {

/// Whether weights of this sum tell anything.
bool can_choose(float total) { return total > tiny<float> && total <= std::numeric_limits<float>::max(); }
constexpr float below_one = 1.0f - 0x1p-24f;

/// A weight among others of this total: none that is above 0 is so small that a sum of floats loses it.
template <class T>
T not_lost(T weight, T total) {
    return select(weight > T(0), max(weight, total * T(0x1p-20f)), weight);
}

}  // namespace

/// One of a receiver's choices on its way down the tree.
struct LightChoice::Pick {
    float u;
    std::size_t light;
    float probability;
};

LightChoice::LightChoice(const LightTree& tree, const LightReceiver& receivers, std::size_t count,
                         std::size_t cut_nodes)
    : tree_(tree), receivers_(receivers), count_(count) {
    cut_[0] = 0;
    cumulative_[0].fill(1.0f);
    if (cut_nodes == 1) return;
    std::array<Batch, max_cut_nodes> weights;
    // How much is unknown of where each node's light comes from: what refines first. 0: a light.
    std::array<float, max_cut_nodes> unknown;
    for (std::size_t place = 0;;) {
        const LightTree::Node& node = tree.nodes()[static_cast<std::size_t>(cut_[place])];
        // In the tree's order: neighbours in u are neighbours in space.
        const auto make_room = [&](auto& values) {
            const auto after = values.begin() + static_cast<std::ptrdiff_t>(place) + 1;
            std::move_backward(after, values.begin() + static_cast<std::ptrdiff_t>(cut_size_),
                               values.begin() + static_cast<std::ptrdiff_t>(cut_size_ + node.count) - 1);
        };
        make_room(cut_), make_room(weights), make_room(unknown);
        cut_size_ += node.count - 1;
        for (std::size_t i = 0; i < node.count; ++i) {
            const std::size_t at = place + i;
            cut_[at] = node.child[i];
            const auto [reflected, variance] = light_importance(receivers_, node.proxies.broadcast(i));
            weights[at] = reflected;
            unknown[at] = 0.0f;
            if (node.child[i] < 0) continue;
            const Lanes weight = store(reflected * variance * inverse(variance + Batch(0.2f)));
            unknown[at] = std::accumulate(weight.begin(), weight.begin() + static_cast<std::ptrdiff_t>(count), 0.0f);
        }
        const auto next = std::max_element(unknown.begin(), unknown.begin() + static_cast<std::ptrdiff_t>(cut_size_));
        place = static_cast<std::size_t>(next - unknown.begin());
        if (!(unknown[place] > 0.0f)) break;
        if (cut_size_ + tree.nodes()[static_cast<std::size_t>(cut_[place])].count - 1 > cut_nodes) break;
    }
    Batch total(0.0f), sum(0.0f);
    for (std::size_t i = 0; i < cut_size_; ++i) total += weights[i];
    for (std::size_t i = 0; i < cut_size_; ++i) cumulative_[i] = store(sum += not_lost(weights[i], total));
}

/// What a node's children weigh for one receiver, each with all before it. Past the last child: all.
LightChoice::Weights LightChoice::cumulative_weights(const LightTree::Node& node, std::size_t lane) const {
    if (!each_) each_ = unpack<LightReceiverOf>(receivers_);
    if (alone_lane_ != lane) alone_ = broadcast<LightReceiverOf>((*each_)[lane]), alone_lane_ = lane;
    Weights weights;
    for (std::size_t first = 0; first < light_tree_width; first += batch_size)
        light_importance(alone_, node.proxies.batch(first)).reflected.store_unaligned(&weights[first]);
    const float total = std::accumulate(weights.begin(), weights.end(), 0.0f);
    float sum = 0.0f;
    for (float& weight : weights) weight = sum += not_lost(weight, total);
    return weights;
}

/// Sends picks, whose u ascend, each to what its u falls into, and leaves what is left of u within it: calls visit(i,
/// picks) for each that some choose. cumulative(i): the weight of what is before and of i, the last's all. Where that
/// is 0, they find nothing and get probability 0.
template <class Cumulative, class Visit>
void LightChoice::distribute(std::size_t count, const Cumulative& cumulative, std::span<Pick> picks,
                             const Visit& visit) {
    const float total = cumulative(count - 1);
    if (!can_choose(total)) {
        for (Pick& pick : picks) pick.probability = 0.0f;
        return;
    }
    std::size_t i = 0;
    for (std::size_t first = 0, end; first < picks.size(); first = end) {
        while (cumulative(i) <= picks[first].u * total) ++i;
        const float before = i > 0 ? cumulative(i - 1) : 0.0f, weight = cumulative(i) - before;
        for (end = first; end < picks.size() && picks[end].u * total < cumulative(i); ++end) {
            picks[end].u = std::min((picks[end].u * total - before) / weight, below_one);
            picks[end].probability *= weight / total;
        }
        visit(i, picks.subspan(first, end - first));
    }
}

/// Sends picks down to their lights.
void LightChoice::descend(std::int32_t child, std::size_t lane, std::span<Pick> picks) const {
    if (child < 0) {
        for (Pick& pick : picks) pick.light = static_cast<std::size_t>(~child);
        return;
    }
    const LightTree::Node& node = tree_.nodes()[static_cast<std::size_t>(child)];
    const Weights cumulative = cumulative_weights(node, lane);
    distribute(
        node.count, [&](std::size_t i) { return cumulative[i]; }, picks,
        [&](std::size_t i, std::span<Pick> of_child) { descend(node.child[i], lane, of_child); });
}

void LightChoice::choose(const Batch& u, std::span<LightChoices> choices) const {
    const Lanes u_lanes = store(u);
    const auto n = static_cast<float>(choices.size());
    std::array<Pick, max_light_samples> each;
    const std::span<Pick> picks = std::span(each).first(choices.size());
    for (std::size_t lane = 0; lane < count_; ++lane) {
        for (std::size_t k = 0; k < picks.size(); ++k)
            picks[k] = {std::min((static_cast<float>(k) + u_lanes[lane]) / n, below_one), 0, 1.0f};
        distribute(
            cut_size_, [&](std::size_t i) { return cumulative_[i][lane]; }, picks,
            [&](std::size_t i, std::span<Pick> of_node) { descend(cut_[i], lane, of_node); });
        for (std::size_t k = 0; k < picks.size(); ++k) {
            choices[k].light[lane] = picks[k].light;
            choices[k].probability[lane] = picks[k].probability;
        }
    }
}

float LightChoice::probability(std::size_t lane, std::size_t light) const {
    // A node's part of its cumulative weights, as distribute() takes it.
    const auto part = [](std::size_t i, std::size_t count, const auto& cumulative) {
        const float total = cumulative(count - 1), weight = cumulative(i) - (i > 0 ? cumulative(i - 1) : 0.0f);
        return can_choose(total) ? weight / total : 0.0f;
    };
    float probability = 1.0f;
    std::int32_t child = ~static_cast<std::int32_t>(light);
    auto [index, place] = tree_.leaf(light);
    const std::span<const std::int32_t> cut(cut_.data(), cut_size_);
    for (auto at = std::ranges::find(cut, child);; at = std::ranges::find(cut, child)) {
        if (at != cut.end())
            return probability * part(static_cast<std::size_t>(at - cut.begin()), cut_size_,
                                      [&](std::size_t i) { return cumulative_[i][lane]; });
        const LightTree::Node& node = tree_.nodes()[static_cast<std::size_t>(index)];
        const Weights cumulative = cumulative_weights(node, lane);
        probability *= part(place, node.count, [&](std::size_t i) { return cumulative[i]; });
        if (!(probability > 0.0f)) return 0.0f;
        child = index;
        place = node.place_in_parent;
        index = node.parent;
    }
}

std::pair<std::size_t, float> choose_light(const LightTree& tree, const Vec3f& position, float u) {
    LightChoices choice;
    LightChoice(tree, light_receiver(position), 1, 1).choose(Batch(u), {&choice, 1});
    return {choice.light[0], choice.probability[0]};
}

float choice_probability(const LightTree& tree, const Vec3f& position, std::size_t light) {
    return LightChoice(tree, light_receiver(position), 1, 1).probability(0, light);
}

}  // namespace pivot
