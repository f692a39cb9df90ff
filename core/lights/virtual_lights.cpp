#include "core/lights/virtual_lights.h"

#include <algorithm>
#include <numeric>

#include "core/distributions/spherical_gaussian.h"
#include "core/sampling/sobol.h"

namespace pivot {
namespace {

using Vec3d = Vec3<double>;

/// A place that may stand for a light's, kept by a draw that favours what carries more.
struct Representative {
    float rank = -std::numeric_limits<float>::infinity();
    std::uint32_t deposit = 0;
};

/// Sums over deposits: what lights together have in common with one.
struct LightSums {
    double weight = 0.0, square = 0.0;
    Vec3d place{0.0}, axis{0.0}, power{0.0};
    std::array<Representative, VirtualLight::place_count> representatives{};  ///< the best first

    void add(const LightDeposit& deposit, std::uint32_t index, double share) {
        const double w = share * static_cast<double>(mean_component(abs(deposit.power_w)));
        const Vec3d at(deposit.place.position);
        weight += w;
        place += w * at;
        square += w * length_squared(at);
        axis += w * Vec3d(deposit.axis);
        power += share * Vec3d(deposit.power_w);
        // The largest u^(1/w) are a draw by weight without repetition.
        const float u = (static_cast<float>(hash(deposit.id, 0x76736c67u) >> 8) + 0.5f) * 0x1p-24f;
        consider({std::log(u) / static_cast<float>(std::max(w, 1e-30)), index});
    }
    void add(const LightSums& other) {
        weight += other.weight;
        place += other.place;
        square += other.square;
        axis += other.axis;
        power += other.power;
        for (const Representative& r : other.representatives) consider(r);
    }

   private:
    void consider(Representative candidate) {
        for (const Representative& kept : representatives)
            if (kept.rank > -std::numeric_limits<float>::infinity() && kept.deposit == candidate.deposit) return;
        for (Representative& kept : representatives)
            if (candidate.rank > kept.rank) std::swap(kept, candidate);
    }
};

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
        std::uint32_t h = hash(key.owner, std::uint32_t{key.level} << 4 | key.direction);
        for (const std::int32_t x : key.place) h = hash(h, static_cast<std::uint32_t>(x));
        return h;
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

struct Nothing {};

struct Cell {
    LightSums sums;
    std::vector<std::uint32_t> children;  ///< cells
};

/// Far beyond what a float can tell apart.
std::int32_t cell_coordinate(float x) { return static_cast<std::int32_t>(std::clamp(std::floor(x), -1e9f, 1e9f)); }

/// How large cells are: 2^exponent metres, and the part of the light that goes to cells of twice that.
struct CellSize {
    int exponent;
    float coarser;
    float edge_m() const { return std::ldexp(1.0f, exponent); }
};

/// Some deposits tell how large cells are to be.
constexpr float deposits_asked = 16384.0f;

std::size_t cells_filled(std::span<const LightDeposit* const> deposits, float edge_m) {
    CellMap<Nothing> cells;
    for (const LightDeposit* d : deposits) {
        CellKey key{d->owner, 0, 0, {}};
        for (int c = 0; c < 3; ++c)
            key.place[static_cast<std::size_t>(c)] = cell_coordinate(d->cell_position[c] / edge_m + 0.5f);
        cells.find_or_add(key);
    }
    return cells.size();
}

constexpr std::size_t places_per_cell = 4;  ///< at least, in the mean

/// Between the two sizes that fill fewer and more cells than asked for, by the logarithm.
CellSize cell_size(std::span<const LightDeposit> all, std::size_t most_cells) {
    Vec3f low(std::numeric_limits<float>::infinity()), high = -low;
    std::vector<const LightDeposit*> deposits;
    const float share =
        std::max(deposits_asked, 8.0f * static_cast<float>(most_cells)) / static_cast<float>(all.size());
    for (const LightDeposit& d : all) {
        if (to_unit(hash(d.id, 0x63656c6cu)) < share) deposits.push_back(&d);
        low = min(low, d.cell_position), high = max(high, d.cell_position);
    }
    const float size_m = std::clamp(max_component(high - low), 1e-6f, 1e9f);
    int exponent = std::ilogb(size_m) + 1;
    // What reaches few places is no better for cells that hold one of them each.
    const std::size_t places = cells_filled(deposits, std::ldexp(1.0f, exponent - 16));
    const std::size_t cell_count = std::min(most_cells, std::max<std::size_t>(places / places_per_cell, 1));
    std::size_t fewer = cells_filled(deposits, std::ldexp(1.0f, exponent));
    for (const int last = exponent - 16; exponent > last && fewer < cell_count;) {
        const std::size_t more = cells_filled(deposits, std::ldexp(1.0f, exponent - 1));
        --exponent;
        if (more >= cell_count) {
            const auto log_of = [](std::size_t n) { return std::log(static_cast<float>(n)); };
            const float part = (log_of(more) - log_of(cell_count)) / std::max(log_of(more) - log_of(fewer), 1e-6f);
            return {exponent, clamp01(part)};
        }
        fewer = more;
    }
    return {exponent, 0.0f};
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

class TreeBuilder {
   public:
    TreeBuilder(std::span<const LightDeposit> deposits, CellMap<Cell>& cells, float least_variance_m2)
        : deposits_(deposits), cells_(cells), least_variance_m2_(least_variance_m2) {}

    VirtualLightTree build(std::vector<std::uint32_t> roots) {
        tree_.emplace_back();
        put(0, join(std::move(roots)));
        return std::move(tree_);
    }

   private:
    /// One cell in which all are.
    std::uint32_t join(std::vector<std::uint32_t> parts) {
        if (parts.size() == 1) return parts[0];
        if (parts.size() > 8) {
            // Halves along the longest side until they are few.
            std::vector<std::vector<std::uint32_t>> groups{std::move(parts)};
            while (groups.size() < 8) {
                const auto largest = std::ranges::max_element(groups, {}, [](const auto& g) { return g.size(); });
                auto [a, b] = halve(std::move(*largest));
                *largest = std::move(a);
                groups.push_back(std::move(b));
            }
            parts.clear();
            for (auto& group : groups) parts.push_back(join(std::move(group)));
        }
        const std::uint32_t whole = cells_.find_or_add({~0u, 0, 0, {next_join_++, 0, 0}});
        for (const std::uint32_t part : parts) {
            const LightSums sums = cells_[part].sums;
            cells_[whole].sums.add(sums);
        }
        cells_[whole].children = std::move(parts);
        return whole;
    }

    Vec3d mean_of(std::uint32_t cell) const { return cells_[cell].sums.place / cells_[cell].sums.weight; }

    std::pair<std::vector<std::uint32_t>, std::vector<std::uint32_t>> halve(std::vector<std::uint32_t> parts) const {
        Vec3d low(std::numeric_limits<double>::infinity()), high = -low;
        for (const std::uint32_t part : parts) {
            low = glm::min(low, mean_of(part));
            high = glm::max(high, mean_of(part));
        }
        const Vec3d size = high - low;
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        std::ranges::stable_sort(parts, {}, [&](std::uint32_t part) { return mean_of(part)[axis]; });
        const auto middle = parts.begin() + static_cast<std::ptrdiff_t>(parts.size() / 2);
        return {{parts.begin(), middle}, {middle, parts.end()}};
    }

    /// Writes a cell and all below it; one child alone is passed over. Returns its lobe_sharpness.
    float put(std::size_t at, std::uint32_t cell) {
        while (cells_[cell].children.size() == 1 && is_all(cell)) cell = cells_[cell].children[0];
        tree_[at] = light_of(cells_[cell].sums);
        const std::vector<std::uint32_t> children = cells_[cell].children;
        if (children.empty()) return tree_[at].lobe_sharpness;
        const std::size_t first = tree_.size();
        tree_[at].first_child = static_cast<std::uint32_t>(first);
        tree_[at].child_count = static_cast<std::uint32_t>(children.size());
        tree_.resize(first + children.size());
        double spread = 0.0;
        tree_[at].bound_m = 0.0f;
        for (std::size_t i = 0; i < children.size(); ++i) {
            const double of_lobe = 1.0 / static_cast<double>(put(first + i, children[i]));
            spread += of_lobe * cells_[children[i]].sums.weight / cells_[cell].sums.weight;
            const VirtualLight& child = tree_[first + i];
            const Vec3f away = child.mean - tree_[at].mean;
            tree_[at].bound_m = std::max(tree_[at].bound_m, length(away) + child.bound_m);
            tree_[at].lowest_m = std::min(tree_[at].lowest_m, dot(away, tree_[at].axis) + child.lowest_m);
        }
        return tree_[at].lobe_sharpness = static_cast<float>(1.0 / spread);
    }

    bool is_all(std::uint32_t cell) const {
        return cells_[cells_[cell].children[0]].sums.weight >= cells_[cell].sums.weight * (1.0 - 1e-9);
    }

    VirtualLight light_of(const LightSums& sums) const {
        VirtualLight light;
        const Vec3d mean = sums.place / sums.weight, axis = sums.axis / sums.weight;
        light.mean = Vec3f(mean);
        light.variance_m2 = static_cast<float>(std::max(0.5 * (sums.square / sums.weight - length_squared(mean)), 0.0));
        light.variance_m2 = std::max(light.variance_m2, least_variance_m2_);
        const double axis_length = length(axis);
        light.axis = axis_length > 1e-6 ? Vec3f(axis / axis_length) : Vec3f(0.0f, 0.0f, 1.0f);
        light.sharpness = static_cast<float>(sharpness_of_mean(axis_length));
        light.bound_m = 3.0f * std::sqrt(light.variance_m2);
        light.lowest_m = 0.0f;
        light.lobe_sharpness = std::max(light.sharpness, 1e-3f);
        light.power_w = Rgb(sums.power);
        for (std::size_t i = 0; i < light.places.size(); ++i) {
            const Representative& r = sums.representatives[i];
            light.places[i] =
                r.rank > -std::numeric_limits<float>::infinity() ? deposits_[r.deposit].place : light.places[0];
        }
        return light;
    }

    std::span<const LightDeposit> deposits_;
    CellMap<Cell>& cells_;
    float least_variance_m2_;
    std::int32_t next_join_ = 0;
    VirtualLightTree tree_;
};

/// A cell that is lit evenly has a variance of a sixth of its edge squared; what a few deposits, or one, say of theirs
/// is no less than this part of it, lest they seem points, whose light has no bound.
constexpr float few_deposits = 24.0f;
/// Cells are joined by eights so many times before objects are joined by where they stand.
constexpr int levels_of_object = 7;

}  // namespace

VirtualLightTree build_virtual_lights(std::span<const LightDeposit> deposits, std::size_t cell_count) {
    if (deposits.empty()) return {};
    const CellSize size = cell_size(deposits, cell_count);
    CellMap<Cell> cells;
    for (std::uint32_t i = 0; i < deposits.size(); ++i) {
        for (const std::uint16_t level : {0, 1}) {
            const float of_level = level == 1 ? size.coarser : 1.0f - size.coarser;
            if (!(of_level > 0.0f)) continue;
            for_each_cell(deposits[i], size.edge_m() * (level == 1 ? 2.0f : 1.0f), level,
                          [&](const CellKey& key, float share) {
                              cells[cells.find_or_add(key)].sums.add(deposits[i], i, double(share * of_level));
                          });
        }
    }
    std::array<std::vector<std::uint32_t>, levels_of_object + 1> of_level;
    for (std::uint32_t i = 0; i < cells.size(); ++i)
        if (cells[i].sums.weight > 0.0) of_level[cells.key(i).level].push_back(i);
    for (std::size_t level = 0; level < levels_of_object; ++level) {
        for (const std::uint32_t cell : of_level[level]) {
            const std::uint32_t parent = cells.find_or_add(cells.key(cell).parent());
            if (cells[parent].children.empty()) of_level[level + 1].push_back(parent);
            const LightSums sums = cells[cell].sums;
            cells[parent].sums.add(sums);
            cells[parent].children.push_back(cell);
        }
    }
    std::vector<std::uint32_t> roots = std::move(of_level[levels_of_object]);
    if (roots.empty()) return {};
    return TreeBuilder(deposits, cells, sqr(size.edge_m()) / few_deposits).build(std::move(roots));
}

}  // namespace pivot
