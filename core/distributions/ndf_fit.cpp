#include "core/distributions/ndf_fit.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <span>

namespace pivot {
namespace {

constexpr double good_enough = 0.02;   // error at which no further lobe is added
constexpr double least_weight = 1e-3;  // of a lobe that is kept
constexpr std::size_t most_cells = 4000;
constexpr std::size_t finest_px = 1024;  // larger images are fitted as if they had so many pixels

using Vec2d = Vec2<double>;

/// Covariances of slopes: (xx, xy; xy, yy).
struct Covariance {
    double xx = 0.0, xy = 0.0, yy = 0.0;

    double det() const { return xx * yy - xy * xy; }
    void add(double weight, const Covariance& c) { xx += weight * c.xx, xy += weight * c.xy, yy += weight * c.yy; }
    void add_square(double weight, const Vec2d& d) {
        xx += weight * d.x * d.x, xy += weight * d.x * d.y, yy += weight * d.y * d.y;
    }
};

/// A patch of neighbouring pixels: what of all projected area it holds, and where its slopes lie.
struct Cell {
    double mass = 0.0;
    Vec2d slope{0.0};
    Covariance spread;
    double slope_area = 0.0;  ///< of the plane of slopes

    void add(const Cell& part) {
        if (!(part.mass > 0.0)) {
            slope_area += part.slope_area;
            return;
        }
        const double sum = mass + part.mass, share = part.mass / sum;
        const Vec2d apart = part.slope - slope;
        spread = {spread.xx * (1.0 - share), spread.xy * (1.0 - share), spread.yy * (1.0 - share)};
        spread.add(share, part.spread);
        spread.add_square(share * (1.0 - share), apart);
        slope += share * apart;
        mass = sum;
        slope_area += part.slope_area;
    }
};

/// Cells of 2 x 2 of those of the level below, the finest first.
std::vector<std::vector<Cell>> pyramid(const NdfImage& image) {
    const std::size_t size = image.size(), step = (size + finest_px - 1) / finest_px;
    std::size_t side = std::bit_ceil((size + step - 1) / step);
    std::vector<std::vector<Cell>> levels(1);
    levels[0].resize(side * side);
    for (std::size_t row = 0; row < size; ++row)
        for (std::size_t column = 0; column < size; ++column) {
            const NdfPixel px = NdfPixel::at(size, column, row);
            const double x = 0.5 * (px.x0 + px.x1), y = 0.5 * (px.y0 + px.y1), z2 = 1.0 - x * x - y * y;
            const double width = px.x1 - px.x0;
            if (z2 < width * width) continue;  // nearly level with the surface: no lobe of a fit goes there
            const double z = std::sqrt(z2), area = width * width, variance = area / 12.0;
            // d slope = (1 + slope slope') d(x, y) / z
            const Vec2d slope(x / z, y / z);
            const double a = (1.0 + slope.x * slope.x) / z, b = slope.x * slope.y / z,
                         c = (1.0 + slope.y * slope.y) / z;
            levels[0][row / step * side + column / step].add(
                {static_cast<double>(image.pixels()[row * size + column]) * area,
                 slope,
                 {variance * (a * a + b * b), variance * (a * b + b * c), variance * (b * b + c * c)},
                 area / (z2 * z2)});
        }
    for (; side > 1; side /= 2) {
        const std::vector<Cell>& fine = levels.back();
        std::vector<Cell> coarse(side / 2 * (side / 2));
        for (std::size_t row = 0; row < side; ++row)
            for (std::size_t column = 0; column < side; ++column)
                coarse[row / 2 * (side / 2) + column / 2].add(fine[row * side + column]);
        levels.push_back(std::move(coarse));
    }
    return levels;
}

/// Cells of which none holds much: where the image is bright they are single pixels.
struct Cells {
    std::vector<Cell> all;  ///< of mass 1 together
    double dropped;         ///< what is too near the rim, of all projected area
};
Cells cells_of(const NdfImage& image) {
    const std::vector<std::vector<Cell>> levels = pyramid(image);
    std::vector<Cell> cells;
    const double most = 4.0 * levels.back()[0].mass / static_cast<double>(most_cells);
    const auto split = [&](const auto& again, std::size_t level, std::size_t row, std::size_t column) -> void {
        const std::size_t side = std::size_t(1) << (levels.size() - 1 - level);
        const Cell& cell = levels[level][row * side + column];
        if (!(cell.mass > 0.0)) return;
        if (level == 0 || cell.mass < most) {
            cells.push_back(cell);
            return;
        }
        for (std::size_t i = 0; i < 4; ++i) again(again, level - 1, 2 * row + i / 2, 2 * column + i % 2);
    };
    split(split, levels.size() - 1, 0, 0);
    double sum = 0.0;
    for (const Cell& cell : cells) sum += cell.mass;
    for (Cell& cell : cells) cell.mass /= sum;
    return {std::move(cells), std::clamp(1.0 - sum, 0.0, 1.0)};
}

/// A lobe while it is being fitted: its density of slopes is weight / (pi det A) (1 + distance2)^-2, A A' = scale.
struct Lobe {
    double weight;
    Vec2d center;
    Covariance scale;

    /// The mean over a cell of |A^-1 (slope - center)|^2.
    double distance2(const Cell& cell) const {
        const Vec2d d = cell.slope - center;
        const double quadratic = scale.yy * (d.x * d.x + cell.spread.xx) + scale.xx * (d.y * d.y + cell.spread.yy) -
                                 2.0 * scale.xy * (d.x * d.y + cell.spread.xy);
        return quadratic / scale.det();
    }
    double density(double distance2) const {
        return weight / (pi<double> * std::sqrt(scale.det()) * (1.0 + distance2) * (1.0 + distance2));
    }
};

/// Keeps a lobe from vanishing: no smoother than GGX may be.
void bound(Covariance& scale) {
    constexpr double least = 1e-6;  // an alpha of 1e-3, squared
    scale.xx = std::max(scale.xx, least), scale.yy = std::max(scale.yy, least);
    const double most_xy = std::sqrt(std::max((scale.xx - 0.5 * least) * (scale.yy - 0.5 * least), 0.0)) * 0.99999;
    scale.xy = std::clamp(scale.xy, -most_xy, most_xy);
}

/// One step of expectation and maximisation.
void improve(std::vector<Lobe>& lobes, std::span<const Cell> cells) {
    struct Sums {
        double mass = 0.0, pull = 0.0;
        Vec2d slope{0.0};
    };
    const std::size_t count = lobes.size();
    std::vector<Sums> sums(count);
    std::vector<double> shares(cells.size() * count), pulls(shares.size());
    for (std::size_t i = 0; i < cells.size(); ++i) {
        double total = 0.0;
        for (std::size_t k = 0; k < count; ++k) {
            const double distance2 = lobes[k].distance2(cells[i]);
            total += shares[i * count + k] = lobes[k].density(distance2);
            pulls[i * count + k] = 2.0 / (1.0 + distance2);  // [Peel00 (17)] of two degrees, scale / 2 its matrix
        }
        for (std::size_t k = 0; k < count; ++k) {
            double& share = shares[i * count + k];
            share = total > 0.0 ? cells[i].mass * share / total : 0.0;
            pulls[i * count + k] *= share;
            sums[k].mass += share;
            sums[k].pull += pulls[i * count + k];
            sums[k].slope += pulls[i * count + k] * cells[i].slope;
        }
    }
    for (std::size_t k = 0; k < count; ++k) {
        if (!(sums[k].pull > 1e-12)) continue;
        Lobe& lobe = lobes[k];
        lobe.center = sums[k].slope / sums[k].pull;
        lobe.scale = {};
        for (std::size_t i = 0; i < cells.size(); ++i) {
            // Twice: A A' is twice the matrix of Student's distribution.
            const double pull = 2.0 * pulls[i * count + k] / sums[k].mass;
            lobe.scale.add(pull, cells[i].spread);
            lobe.scale.add_square(pull, cells[i].slope - lobe.center);
        }
        bound(lobe.scale);
        lobe.weight = sums[k].mass;
    }
}

/// What each cell holds more than the mixture says.
std::vector<double> lacking(std::span<const Lobe> lobes, std::span<const Cell> cells) {
    std::vector<double> result(cells.size());
    for (std::size_t i = 0; i < cells.size(); ++i) {
        double density = 0.0;
        for (const Lobe& lobe : lobes) {
            Cell point = cells[i];
            point.spread = {};
            density += lobe.density(lobe.distance2(point));
        }
        result[i] = cells[i].mass - density * cells[i].slope_area;
    }
    return result;
}

/// A lobe for the part of the hemisphere of normals, of 12 x 12, that lacks most.
Lobe lobe_for(std::span<const double> lack, std::span<const Cell> cells) {
    constexpr int across = 12;
    const auto part_of = [](const Vec2d& slope) {
        const double z = 1.0 / std::sqrt(1.0 + dot(slope, slope));
        const auto place = [&](double x) {
            return std::clamp(static_cast<int>((x + 1.0) * 0.5 * across), 0, across - 1);
        };
        return static_cast<std::size_t>(place(slope.y * z) * across + place(slope.x * z));
    };
    std::array<double, across * across> parts{};
    for (std::size_t i = 0; i < cells.size(); ++i) parts[part_of(cells[i].slope)] += lack[i];
    const auto most = static_cast<std::size_t>(std::ranges::max_element(parts) - parts.begin());
    Cell sum;
    for (std::size_t i = 0; i < cells.size(); ++i)
        if (lack[i] > 0.0 && part_of(cells[i].slope) == most) {
            Cell cell = cells[i];
            cell.mass = lack[i];
            sum.add(cell);
        }
    bound(sum.spread);
    return {std::max(sum.mass, 1e-6), sum.slope, sum.spread};
}

/// At the pixels' middles; those that are nearly black do not count.
float worst_ratio(const NdfImage& image, std::span<const TiltedGgx> lobes) {
    const std::size_t size = image.size();
    const float least = 1e-6f * *std::ranges::max_element(image.pixels());
    float worst = 0.0f;
    for (std::size_t row = 0; row < size; ++row)
        for (std::size_t column = 0; column < size; ++column) {
            const float density = image.pixels()[row * size + column];
            const auto place = [&](std::size_t i) {
                return (2.0f * static_cast<float>(i) + 1.0f) / static_cast<float>(size) - 1.0f;
            };
            const float x = place(column), y = place(row), z2 = 1.0f - x * x - y * y;
            if (density <= least || !(z2 > 0.0f)) continue;
            float sum = 0.0f;
            for (const TiltedGgx& lobe : lobes) sum += ndf(lobe, {x, y, std::sqrt(z2)});
            worst = std::max(worst, density / std::max(sum, tiny<float>));
        }
    return worst;
}

TiltedGgx as_ggx(const Lobe& lobe) {
    const double xx = std::sqrt(lobe.scale.xx), yx = lobe.scale.xy / xx;
    return {static_cast<float>(lobe.weight), Vec2f(lobe.center), static_cast<float>(xx), static_cast<float>(yx),
            static_cast<float>(std::sqrt(std::max(lobe.scale.yy - yx * yx, 1e-7)))};
}

}  // namespace

NdfFit fit(const NdfImage& image) {
    const auto [cells, dropped] = cells_of(image);
    if (cells.empty()) return {{TiltedGgx{}}, 1.0f, std::numeric_limits<float>::infinity()};
    Cell all;
    for (const Cell& cell : cells) all.add(cell);
    bound(all.spread);
    std::vector<Lobe> lobes{{1.0, all.slope, all.spread}}, best;
    double least = 2.0;
    for (;;) {
        for (int step = 0; step < 40; ++step) improve(lobes, cells);
        const std::vector<double> lack = lacking(lobes, cells);
        double error = 0.0;
        for (const double part : lack) error += std::max(part, 0.0);
        if (error < least) least = error, best = lobes;
        if (error < good_enough || lobes.size() == max_ndf_lobes) break;
        Lobe added = lobe_for(lack, cells);
        for (Lobe& lobe : lobes) lobe.weight *= 1.0 - std::min(added.weight, 0.5);
        added.weight = std::min(added.weight, 0.5);
        lobes.push_back(added);
    }
    std::erase_if(best, [](const Lobe& lobe) { return lobe.weight < least_weight; });
    NdfFit result{{}, static_cast<float>(std::min(least + dropped, 1.0)), 0.0f};
    double weight = 0.0;
    for (const Lobe& lobe : best) weight += lobe.weight;
    for (const Lobe& lobe : best) {
        result.lobes.push_back(as_ggx(lobe));
        result.lobes.back().weight /= static_cast<float>(weight);
    }
    result.worst = worst_ratio(image, result.lobes);
    return result;
}

}  // namespace pivot
