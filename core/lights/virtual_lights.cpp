#include "core/lights/virtual_lights.h"

#include <algorithm>
#include <numeric>

#include "core/distributions/spherical_gaussian.h"
#include "core/lights/light_cells.h"

namespace pivot {
namespace {

using Vec3d = Vec3<double>;
using Mat3d = Mat3<double>;

double trace(const Mat3d& m) { return m[0][0] + m[1][1] + m[2][2]; }

/// So many deposits tell half of how axes turn with places.
constexpr double deposits_that_tell = 8.0;
/// Variances that are no less, relative to all: of places along one axis, and of axes about how they turn.
constexpr double least_part_of_places = 0.01, least_part_of_axes = 0.05;
/// Axes turn half as much where lobes are as wide as this, rad^2: it is a first order's.
constexpr double variance_of_half_turn = 0.1;

/// A place that may stand for a light's, kept by a draw that favours what carries more.
struct Representative {
    float rank = -std::numeric_limits<float>::infinity();
    std::uint32_t deposit = 0;
};

/// Sums over deposits: what lights together have in common with one.
struct LightSums {
    double weight = 0.0, weight_square = 0.0;
    Vec3d place{0.0}, axis{0.0}, power{0.0};
    Mat3d places{0.0}, axes_by_places{0.0};  ///< products of each with itself, and of the one with the other
    std::array<Representative, VirtualLight::place_count> representatives{};  ///< the best first

    void add(const LightDeposit& deposit, std::uint32_t index, double share) {
        const double w = share * static_cast<double>(mean_component(abs(deposit.power_w)));
        const Vec3d at(deposit.place.position);
        weight += w;
        weight_square += w * w;
        place += w * at;
        places += glm::outerProduct(w * at, at);
        axis += w * Vec3d(deposit.axis);
        axes_by_places += glm::outerProduct(w * Vec3d(deposit.axis), at);
        power += share * Vec3d(deposit.power_w);
        // The largest u^(1/w) are a draw by weight without repetition.
        const float u = (static_cast<float>(hash(deposit.id, 0x76736c67u) >> 8) + 0.5f) * 0x1p-24f;
        consider({std::log(u) / static_cast<float>(std::max(w, 1e-30)), index});
    }
    void add(const LightSums& other) {
        weight += other.weight;
        weight_square += other.weight_square;
        place += other.place;
        places += other.places;
        axis += other.axis;
        axes_by_places += other.axes_by_places;
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

struct Cell {
    LightSums sums;
    std::vector<std::uint32_t> children;  ///< cells
};

class TreeBuilder {
   public:
    /// pieces: of the first cells, which deposits fill.
    TreeBuilder(std::span<const LightDeposit> deposits, std::span<const PieceSums> pieces, CellMap<Cell>& cells,
                float least_variance_m2)
        : deposits_(deposits), pieces_(pieces), cells_(cells), least_variance_m2_(least_variance_m2) {}

    VirtualLightTree build(std::vector<std::uint32_t> roots) {
        tree_.lights.emplace_back();
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
        std::vector<VirtualLight>& lights = tree_.lights;
        lights[at] = light_of(cells_[cell].sums);
        const std::vector<std::uint32_t> children = cells_[cell].children;
        if (children.empty()) {
            if (const auto pieces = pieces_[cell].pieces()) {
                lights[at].pieces = static_cast<std::uint32_t>(tree_.pieces.size());
                tree_.pieces.push_back(*pieces);
            }
            return lights[at].lobe_sharpness;
        }
        const std::size_t first = lights.size();
        lights[at].first_child = static_cast<std::uint32_t>(first);
        lights[at].child_count = static_cast<std::uint32_t>(children.size());
        lights.resize(first + children.size());
        double spread = 0.0;
        lights[at].bound_m = 0.0f;
        for (std::size_t i = 0; i < children.size(); ++i) {
            const double of_lobe = 1.0 / static_cast<double>(put(first + i, children[i]));
            spread += of_lobe * cells_[children[i]].sums.weight / cells_[cell].sums.weight;
            const VirtualLight& child = lights[first + i];
            const Vec3f away = child.mean - lights[at].mean;
            lights[at].bound_m = std::max(lights[at].bound_m, length(away) + child.bound_m);
            lights[at].lowest_m = std::min(lights[at].lowest_m, dot(away, lights[at].axis) + child.lowest_m);
        }
        return lights[at].lobe_sharpness = static_cast<float>(1.0 / spread);
    }

    bool is_all(std::uint32_t cell) const {
        return cells_[cells_[cell].children[0]].sums.weight >= cells_[cell].sums.weight * (1.0 - 1e-9);
    }

    VirtualLight light_of(const LightSums& sums) const {
        VirtualLight light;
        const Vec3d mean = sums.place / sums.weight, axis = sums.axis / sums.weight;
        light.mean = Vec3f(mean);
        const Mat3d covariance = sums.places / sums.weight - glm::outerProduct(mean, mean);
        const double variance = std::max(0.5 * trace(covariance), 0.0);
        light.variance_m2 = std::max(static_cast<float>(variance), least_variance_m2_);
        const double axis_length = length(axis);
        light.axis = axis_length > 1e-6 ? Vec3f(axis / axis_length) : Vec3f(0.0f, 0.0f, 1.0f);
        light.sharpness = static_cast<float>(sharpness_of_mean(axis_length));
        light.turn = turn_of(sums, covariance, mean, axis);
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

    static LightTurn turn_of(const LightSums& sums, const Mat3d& covariance, const Vec3d& mean, const Vec3d& axis) {
        LightTurn turn;
        const double trace_m2 = trace(covariance), axis_length = length(axis);
        const double axis_variance = 1.0 / std::max(sharpness_of_mean(axis_length), 1e-3);
        turn.axis_variance = static_cast<float>(axis_variance);
        if (!(trace_m2 > 0.0) || !(axis_length > 1e-3)) return turn;
        // By least squares, less where few deposits tell. Nothing is told of what leads out of a flat surface.
        const double count = sqr(sums.weight) / sums.weight_square;
        const Mat3d mixed = sums.axes_by_places / sums.weight - glm::outerProduct(axis, mean);
        const Mat3d axis_from_place = mixed * glm::inverse(covariance + Mat3d(least_part_of_places * trace_m2)) *
                                      (count / (count + deposits_that_tell));
        const Mat3d told = axis_from_place * covariance * glm::transpose(axis_from_place);
        const double told_across = trace(told) - dot(axis, told * axis) / sqr(axis_length);
        const double part = told_across / (1.0 - sqr(axis_length));
        turn.axis_from_place =
            Mat3<float>(axis_from_place / (axis_length * (1.0 + axis_variance / variance_of_half_turn)));
        turn.axis_variance *= static_cast<float>(std::max(1.0 - part, least_part_of_axes));
        return turn;
    }

    std::span<const LightDeposit> deposits_;
    std::span<const PieceSums> pieces_;
    CellMap<Cell>& cells_;
    float least_variance_m2_;
    std::int32_t next_join_ = 0;
    VirtualLightTree tree_;
};

/// A cell that is lit evenly has a variance of a sixth of its edge squared; what a few deposits, or one, say of theirs
/// is no less than this part of it, lest they seem points, whose light has no bound.
constexpr float few_deposits = 24.0f;
/// What a cell gets less of than this tells nothing of how its light is spread.
constexpr float least_share_of_pieces = 0.01f;
/// Cells are joined by eights so many times before objects are joined by where they stand.
constexpr int levels_of_object = 7;

}  // namespace

VirtualLightTree build_virtual_lights(std::span<const LightDeposit> deposits, std::size_t cell_count) {
    if (deposits.empty()) return {};
    const CellSize size = cell_size(deposits, cell_count);
    CellMap<Cell> cells;
    std::vector<PieceSums> pieces;
    for (std::uint32_t i = 0; i < deposits.size(); ++i) {
        const LightDeposit& deposit = deposits[i];
        for (const std::uint16_t level : {0, 1}) {
            const float of_level = level == 1 ? size.coarser : 1.0f - size.coarser;
            if (!(of_level > 0.0f)) continue;
            const float edge_m = size.edge_m() * (level == 1 ? 2.0f : 1.0f);
            for_each_cell(deposit, edge_m, level, [&](const CellKey& key, float share) {
                const std::uint32_t cell = cells.find_or_add(key);
                if (cell == pieces.size()) pieces.emplace_back();
                cells[cell].sums.add(deposit, i, double(share * of_level));
                if (share < least_share_of_pieces) return;
                const Vec3f middle(key.place[0], key.place[1], key.place[2]);
                pieces[cell].add(deposit.cell_position / edge_m - middle, deposit.flat_axis, deposit.place.position,
                                 share * of_level * mean_component(abs(deposit.power_w)));
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
    return TreeBuilder(deposits, pieces, cells, sqr(size.edge_m()) / few_deposits).build(std::move(roots));
}

}  // namespace pivot
