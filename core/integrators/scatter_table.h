// What a lamp scatters along a part of a ray, at a few nodes: a density of distances, linear between them.
#pragma once

#include <array>
#include <span>

#include "core/integrators/distance_map.h"
#include "core/simd/batch.h"

namespace pivot {

class ScatterTable {
   public:
    static constexpr std::size_t max_nodes = 32;
    static_assert(max_nodes % batch_size == 0);

    /// scattered(distance_m, Batch): at least 0, finite, for each m of the ray. node_count: a multiple of 8.
    template <class Scattered>
    ScatterTable(const DistanceMap& map, std::size_t node_count, const Scattered& scattered)
        : map_(map), count_(node_count) {
        const float last = static_cast<float>(count_ - 1);
        for (std::size_t first = 0; first < count_; first += batch_size) {
            const Batch u = gather([&](std::size_t i) { return static_cast<float>(first + i) / last; });
            const Batch t = map_.distance_m(u);
            const Batch value = scattered(t) / max(map_.density(t), tiny<Batch>);
            select(t < std::numeric_limits<Batch>::max() && value < std::numeric_limits<Batch>::max(), value,
                   Batch(0.0f))
                .store_unaligned(&nodes_[first]);
        }
        // Endless parts of a ray end in the dark.
        if (std::isinf(map_.far_m())) nodes_[count_ - 1] = 0.0f;
        sum_ = 0.0f;
        for (std::size_t i = 0; i + 1 < count_; ++i) sum_ += 0.5f * (nodes_[i] + nodes_[i + 1]);
        sum_ /= last;
        // What falls between the nodes must be found too.
        for (std::size_t i = 0; i < count_; ++i) nodes_[i] += least_share * sum_;
    }

    /// About the integral of what is scattered.
    float sum() const { return sum_; }

    struct Place {
        float distance_m, pdf_m;
    };
    /// The sum is above 0.
    struct PlaceLanes {
        Batch distance_m, pdf_m;
    };
    PlaceLanes sample(const Batch& u) const {
        Lanes in_table = store(u), density;
        for (std::size_t i = 0; i < batch_size; ++i) {
            const InTable place = find(in_table[i]);
            in_table[i] = place.u, density[i] = place.density;
        }
        const Batch distance_m = map_.distance_m(load(in_table));
        return {distance_m, load(density) * map_.density(distance_m)};
    }
    /// u in [0, 1).
    Place sample(float u) const {
        const InTable place = find(u);
        const float distance_m = map_.distance_m(place.u);
        return {distance_m, place.density * map_.density(distance_m)};
    }

   private:
    static constexpr float least_share = 0.02f;

    /// A place of [0, 1] that the map takes to the ray, and its density there.
    struct InTable {
        float u, density;
    };
    InTable find(float u) const {
        const float last = static_cast<float>(count_ - 1), whole = (1.0f + least_share) * sum_ * last;
        float left = u * whole;
        std::size_t cell = 0;
        while (cell + 2 < count_ && left > 0.5f * (nodes_[cell] + nodes_[cell + 1]))
            left -= 0.5f * (nodes_[cell] + nodes_[cell + 1]), ++cell;
        const float low = nodes_[cell], rise = nodes_[cell + 1] - low;
        const float root = low + std::sqrt(std::max(low * low + 2.0f * rise * left, 0.0f));
        const float z = root > 0.0f ? std::clamp(2.0f * left / root, 0.0f, 1.0f) : 0.5f;
        return {(static_cast<float>(cell) + z) / last, (low + rise * z) * last / whole};
    }

    DistanceMap map_;
    std::size_t count_;
    std::array<float, max_nodes> nodes_;
    float sum_;
};

}  // namespace pivot
