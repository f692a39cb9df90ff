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
    float probability;
    std::int32_t child;  ///< what it came to: a node, or ~light

    /// Chooses of parts, cumulative weights before and up to one whose sum is total, that which u falls into: u is
    /// left as what it is within that part.
    void choose(float before, float up_to, float total, std::int32_t part) {
        u = std::min((u * total - before) / (up_to - before), below_one);
        probability *= (up_to - before) / total;
        child = part;
    }
    void find_nothing() { probability = 0.0f, child = ~0; }
};

LightChoice::LightChoice(const LightTree& tree, const LightReceiver& receivers, std::size_t count,
                         std::size_t cut_nodes)
    : tree_(tree), receivers_(receivers), count_(count) {
    cut_[0] = 0;
    cumulative_[0].fill(1.0f);
    if (cut_nodes == 1) return;
    std::array<Batch, most_in_cut> weights;
    // How much is unknown of where each node's light comes from: what refines first. 0: a light, or none.
    std::array<float, (most_in_cut + batch_size - 1) / batch_size * batch_size> unknown{};
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
            if (node.child[i] >= 0) unknown[at] = hadd(reflected * variance * inverse(variance + Batch(0.2f)));
        }
        Batch most(0.0f);
        for (std::size_t i = 0; i < cut_size_; i += batch_size) most = max(most, Batch::load_unaligned(&unknown[i]));
        const float largest = std::ranges::max(store(most));
        if (!(largest > 0.0f) || cut_size_ >= cut_nodes) break;
        place = static_cast<std::size_t>(std::ranges::find(unknown, largest) - unknown.begin());
    }
    Batch total(0.0f), sum(0.0f);
    for (std::size_t i = 0; i < cut_size_; ++i) total += weights[i];
    for (std::size_t i = 0; i < cut_size_; ++i) cumulative_[i] = store(sum += not_lost(weights[i], total));
}

/// What a node's children weigh for one receiver: 0, then each with all before it. Past the last child: all.
LightChoice::Weights LightChoice::cumulative_weights(const LightTree::Node& node, std::size_t lane) const {
    if (!alone_) {
        const auto each = unpack<LightReceiverOf>(receivers_);
        alone_.emplace();
        for (std::size_t i = 0; i < count_; ++i) (*alone_)[i] = broadcast<LightReceiverOf>(each[i]);
    }
    std::array<Batch, light_tree_width / batch_size> of_children;
    Batch sum(0.0f);
    for (std::size_t i = 0; i < of_children.size(); ++i)
        sum += of_children[i] = light_importance((*alone_)[lane], node.proxies.batch(i * batch_size)).reflected;
    const Batch total(hadd(sum));
    Weights weights;
    weights[0] = 0.0f;
    for (std::size_t i = 0; i < of_children.size(); ++i)
        not_lost(of_children[i], total).store_unaligned(&weights[1 + i * batch_size]);
    std::partial_sum(weights.begin(), weights.end(), weights.begin());
    return weights;
}

/// Among the cut's nodes, all receivers at once.
void LightChoice::choose_in_cut(Batch u, std::size_t k, std::span<Picks> picks) const {
    const Batch total = load(cumulative_[cut_size_ - 1]), sought = u * total;
    Batch place(0.0f);
    for (std::size_t i = 0; i + 1 < cut_size_; ++i)
        place += select(load(cumulative_[i]) <= sought, Batch(1.0f), Batch(0.0f));
    const Lanes places = store(place), totals = store(total), u_lanes = store(u);
    for (std::size_t lane = 0; lane < count_; ++lane) {
        Pick& pick = picks[lane][k] = {u_lanes[lane], 1.0f, 0};
        const auto i = static_cast<std::size_t>(places[lane]);
        if (can_choose(totals[lane]))
            pick.choose(i > 0 ? cumulative_[i - 1][lane] : 0.0f, cumulative_[i][lane], totals[lane], cut_[i]);
        else
            pick.find_nothing();
    }
}

/// Moves those of a receiver's picks that are at nodes on to children of these: whether some are at nodes then.
bool LightChoice::go_down(std::size_t lane, std::span<Pick> picks) const {
    bool is_at_node = false;
    for (std::size_t k = 0; k < picks.size();) {
        const std::int32_t index = picks[k].child;
        if (index < 0) {
            ++k;
            continue;
        }
        const LightTree::Node& node = tree_.nodes()[static_cast<std::size_t>(index)];
        const Weights cumulative = cumulative_weights(node, lane);
        const float total = cumulative.back();
        // Picks ascend: those of one node follow each other.
        for (; k < picks.size() && picks[k].child == index; ++k) {
            if (!can_choose(total)) {
                picks[k].find_nothing();
                continue;
            }
            const float sought = picks[k].u * total;
            Batch before(0.0f);
            for (std::size_t first = 0; first < light_tree_width; first += batch_size)
                before +=
                    select(Batch::load_unaligned(&cumulative[1 + first]) <= Batch(sought), Batch(1.0f), Batch(0.0f));
            const auto i = static_cast<std::size_t>(to_index(hadd(before)));
            picks[k].choose(cumulative[i], cumulative[i + 1], total, node.child[i]);
            is_at_node = is_at_node || picks[k].child >= 0;
        }
    }
    return is_at_node;
}

void LightChoice::choose(const Batch& u, std::span<LightChoices> choices) const {
    std::array<Picks, batch_size> picks;
    for (std::size_t k = 0; k < choices.size(); ++k) {
        const Batch first(static_cast<float>(k)), count(static_cast<float>(choices.size()));
        choose_in_cut(min((first + u) / count, Batch(below_one)), k, picks);
    }
    // Level by level, so that the weights of one node need not wait for what is chosen by those of another.
    for (bool is_at_node = true; is_at_node;) {
        is_at_node = false;
        for (std::size_t lane = 0; lane < count_; ++lane)
            is_at_node |= go_down(lane, std::span(picks[lane]).first(choices.size()));
    }
    for (std::size_t k = 0; k < choices.size(); ++k) {
        for (std::size_t lane = 0; lane < count_; ++lane) {
            choices[k].light[lane] = static_cast<std::size_t>(~picks[lane][k].child);
            choices[k].probability[lane] = picks[lane][k].probability;
        }
    }
}

float LightChoice::probability(std::size_t lane, std::size_t light) const {
    const auto part = [](float before, float up_to, float total) {
        return can_choose(total) ? (up_to - before) / total : 0.0f;
    };
    float probability = 1.0f;
    std::int32_t child = ~static_cast<std::int32_t>(light);
    auto [index, place] = tree_.leaf(light);
    const std::span<const std::int32_t> cut(cut_.data(), cut_size_);
    for (auto at = std::ranges::find(cut, child);; at = std::ranges::find(cut, child)) {
        if (at != cut.end()) {
            const auto i = static_cast<std::size_t>(at - cut.begin());
            return probability * part(i > 0 ? cumulative_[i - 1][lane] : 0.0f, cumulative_[i][lane],
                                      cumulative_[cut_size_ - 1][lane]);
        }
        const LightTree::Node& node = tree_.nodes()[static_cast<std::size_t>(index)];
        const Weights cumulative = cumulative_weights(node, lane);
        probability *= part(cumulative[place], cumulative[place + 1], cumulative.back());
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
