// Which lights a path's vertex samples, where it does not sample all: by about what it reflects of each, so that a
// glossy surface finds the light that it mirrors.
//
// The vertices of a batch may share a cut through the light tree: nodes that stand for all lights, refined where most
// light comes from. Each vertex weighs the cut's nodes itself, and goes down the tree from those that it chose. Places
// in fog, one at a time, go down from the root. Of 1000 sphere lights one is chosen with a relative variance of 0.021
// (all on a ceiling) to 0.107 (all over a room) on metal of alpha 0.1, with a cut of 64 nodes; from the root, of 0.09
// to 0.68 (tests/benchmark/light_choice.py).
#pragma once

#include "core/integrators/light_importance.h"

namespace pivot {

/// A light for each vertex of a batch.
struct LightChoices {
    std::array<std::size_t, batch_size> light;
    Lanes probability;  ///< 0: none reaches the vertex
};

/// Chooses among a tree's lights for a batch of receivers.
class LightChoice {
   public:
    /// count: of receivers, the first lanes; the others repeat some of these. cut_nodes: a cut with fewer is refined;
    /// 1: there is none.
    LightChoice(const LightTree& tree, const LightReceiver& receivers, std::size_t count, std::size_t cut_nodes);

    /// choices.size() lights for each receiver, each by the probability it says; u in [0, 1) places them all, evenly.
    void choose(const Batch& u, std::span<LightChoices> choices) const;

    /// With which probability each choice of a lane takes this light.
    float probability(std::size_t lane, std::size_t light) const;

    static constexpr std::size_t max_cut_nodes = 64;

   private:
    struct Pick;
    using Picks = std::array<Pick, max_light_samples>;  ///< of a receiver
    using Weights = std::array<float, light_tree_width + 1>;

    Weights cumulative_weights(const LightTree::Node& node, std::size_t lane) const;
    void choose_in_cut(Batch u, std::size_t k, std::span<Picks> picks) const;
    bool go_down(std::size_t lane, std::span<Pick> picks) const;

    const LightTree& tree_;
    LightReceiver receivers_;
    std::size_t count_;
    static constexpr std::size_t most_in_cut = max_cut_nodes + light_tree_width - 2;

    std::array<std::int32_t, most_in_cut> cut_;  ///< nodes, or ~light, in the tree's order
    std::size_t cut_size_ = 1;
    std::array<Lanes, most_in_cut> cumulative_;  ///< what they weigh for each receiver, with all before them
    mutable std::optional<std::array<LightReceiver, batch_size>> alone_;  ///< each receiver in all lanes
};

/// A light for a place in fog, and with which probability: 0 where there is none.
std::pair<std::size_t, float> choose_light(const LightTree& tree, const Vec3f& position, float u);
float choice_probability(const LightTree& tree, const Vec3f& position, std::size_t light);

}  // namespace pivot
