#include "core/lights/light_cells.h"

#include <limits>

namespace pivot {
namespace {

struct Nothing {};

/// Some deposits tell how large cells are to be.
constexpr float deposits_asked = 16384.0f, deposits_per_cell = 8.0f;

std::size_t cells_filled(std::span<const LightDeposit* const> deposits, int exponent) {
    CellMap<Nothing> cells;
    for (const LightDeposit* d : deposits)
        for_each_cell(*d, std::ldexp(1.0f, exponent), 0, [&](const CellKey& key, float) { cells.find_or_add(key); });
    return cells.size();
}

std::size_t places_met(std::span<const LightDeposit* const> deposits, float edge_m) {
    CellMap<Nothing> cells;
    for (const LightDeposit* d : deposits) {
        CellKey key{d->owner, 0, 0, {}};
        for (int c = 0; c < 3; ++c)
            key.place[static_cast<std::size_t>(c)] = cell_coordinate(d->cell_position[c] / edge_m);
        cells.find_or_add(key);
    }
    return cells.size();
}

/// What reaches few places is no better for more cells than one for each: a place alone fills eight at least.
constexpr std::size_t cells_per_place = 1;
constexpr int exponents = 16;  ///< of sizes, from that of all that is lit

}  // namespace

CellSize cell_size(std::span<const LightDeposit> all, std::size_t cell_count) {
    Vec3f low(std::numeric_limits<float>::infinity()), high = -low;
    std::vector<const LightDeposit*> deposits;
    const float share =
        std::max(deposits_asked, deposits_per_cell * static_cast<float>(cell_count)) / static_cast<float>(all.size());
    for (const LightDeposit& d : all) {
        if (to_unit(hash(d.id, 0x63656c6cu)) < share) deposits.push_back(&d);
        low = min(low, d.cell_position), high = max(high, d.cell_position);
    }
    const int coarsest = std::ilogb(std::clamp(max_component(high - low), 1e-6f, 1e9f)) + 1;
    const std::size_t places = places_met(deposits, std::ldexp(1.0f, coarsest - exponents));
    // Sizes go by twos and what they fill by fours, on surfaces: about as many as asked for are half to twice that.
    const auto most =
        2.0f * static_cast<float>(std::min(cell_count, std::max<std::size_t>(places * cells_per_place, 1)));
    float of_coarser = static_cast<float>(cells_filled(deposits, coarsest)), fits = 2.0f * of_coarser;
    for (int exponent = coarsest; exponent > coarsest - exponents; --exponent) {
        const auto of_finer = static_cast<float>(cells_filled(deposits, exponent - 1));
        const float filled = of_coarser + of_finer;
        if (filled > most) {
            const float part = std::log(filled / most) / std::log(std::max(filled / fits, 1.001f));
            return {exponent, clamp01(part)};
        }
        of_coarser = of_finer, fits = filled;
    }
    return {coarsest - exponents, 0.0f};
}

}  // namespace pivot
