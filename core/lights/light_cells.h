// The cells that virtual lights are summed up in: where deposits go, and how large cells are for so many to be filled.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "core/lights/virtual_lights.h"
#include "core/sampling/sobol.h"

namespace pivot {

struct CellKey {
    std::uint32_t owner;
    std::uint16_t level, direction;
    std::array<std::int32_t, 3> place;

    static constexpr std::uint16_t joins = 8;

    bool operator==(const CellKey&) const = default;
    /// The cell that joins this one with its neighbours. Cells that join are apart from those that deposits fill.
    CellKey parent() const {
        return {owner,
                static_cast<std::uint16_t>(level + 1),
                static_cast<std::uint16_t>(direction | joins),
                {place[0] >> 1, place[1] >> 1, place[2] >> 1}};
    }
};

struct CellHash {
    std::size_t operator()(const CellKey& key) const {
        constexpr std::uint64_t odd = 0x9e3779b97f4a7c15u;  // of the golden ratio
        std::uint64_t h = (std::uint64_t{key.owner} << 32 | std::uint64_t{key.level} << 4 | key.direction) * odd;
        for (const std::int32_t x : key.place) h = ((h ^ h >> 32) + static_cast<std::uint32_t>(x)) * odd;
        return static_cast<std::size_t>(h >> 32);
    }
};

/// Cells in the order in which they were met, found by key in an open table.
template <class Value>
class CellMap {
   public:
    std::uint32_t find_or_add(const CellKey& key) {
        if (2 * (keys_.size() + 1) > table_.size()) grow();
        for (std::size_t at = CellHash()(key) & (table_.size() - 1);; at = (at + 1) & (table_.size() - 1)) {
            if (table_[at] == none) {
                table_[at] = static_cast<std::uint32_t>(keys_.size());
                keys_.push_back(key);
                values_.emplace_back();
                return table_[at];
            }
            if (keys_[table_[at]] == key) return table_[at];
        }
    }
    std::size_t size() const { return keys_.size(); }
    const CellKey& key(std::size_t i) const { return keys_[i]; }
    Value& operator[](std::size_t i) { return values_[i]; }

   private:
    static constexpr std::uint32_t none = ~0u;

    void grow() {
        table_.assign(std::max<std::size_t>(64, 2 * table_.size()), none);
        for (std::uint32_t i = 0; i < keys_.size(); ++i) {
            std::size_t at = CellHash()(keys_[i]) & (table_.size() - 1);
            while (table_[at] != none) at = (at + 1) & (table_.size() - 1);
            table_[at] = i;
        }
    }

    std::vector<std::uint32_t> table_;
    std::vector<CellKey> keys_;
    std::vector<Value> values_;
};

/// Far beyond what a float can tell apart.
inline std::int32_t cell_coordinate(float x) {
    return static_cast<std::int32_t>(std::clamp(std::floor(x), -1e9f, 1e9f));
}

/// The cells about a deposit, of one size, and what each gets of it.
template <class Visit>
void for_each_cell(const LightDeposit& d, float edge_m, std::uint16_t level, const Visit& visit) {
    std::array<std::int32_t, 3> first;
    std::array<float, 3> part;
    for (int c = 0; c < 3; ++c) {
        const float x = d.cell_position[c] / edge_m, before = std::floor(x);
        first[static_cast<std::size_t>(c)] = cell_coordinate(x);
        part[static_cast<std::size_t>(c)] = std::clamp(x - before, 0.0f, 1.0f);
    }
    for (int axis = 0; axis < 3; ++axis) {
        const float of_axis = sqr(d.cell_axis[axis]);
        if (of_axis < 1e-4f) continue;
        const auto direction = static_cast<std::uint16_t>(2 * axis + (d.cell_axis[axis] > 0.0f ? 1 : 0));
        for (std::int32_t corner = 0; corner < 8; ++corner) {
            float share = of_axis;
            CellKey key{d.owner, level, direction, first};
            for (std::size_t c = 0; c < 3; ++c) {
                const std::int32_t next = corner >> c & 1;
                key.place[c] += next;
                share *= next ? part[c] : 1.0f - part[c];
            }
            if (share > 1e-4f) visit(key, share);
        }
    }
}

/// How large cells are: 2^exponent metres, and the part of the light that goes to cells of twice that.
struct CellSize {
    int exponent;
    float coarser;
    float edge_m() const { return std::ldexp(1.0f, exponent); }
};

/// The finest pair of sizes that together fill no more than twice as many cells, as some of the deposits tell. All
/// light is in the coarser of them where they just fit, and in the finer where the next pair would, by the logarithm.
CellSize cell_size(std::span<const LightDeposit> all, std::size_t cell_count);

}  // namespace pivot
