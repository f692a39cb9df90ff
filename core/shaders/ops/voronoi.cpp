// Voronoi's cells: each unit cube has one point in it, and a texture tells of those next to where it is looked up.
// [C] Cycles 4.5 kernel/svm/voronoi.h; 5.0's differs by its hashes. [Worley96] Steven Worley, "A Cellular Texture Basis
// Function", SIGGRAPH 1996: F1 and F2.
#include "core/shaders/ops/hash_cell.h"
#include "core/shaders/ops/math.h"
#include "core/shaders/ops/tables.h"

namespace pivot {
namespace {

enum class Metric { euclidean, manhattan, chebychev, minkowski };
enum class Feature { f1, f2, smooth_f1 };

/// The numbers of an op's settings, in this order.
struct Manner {
    Metric metric;
    bool is_normalized;
    bool is_bounded;  ///< before Blender 4.0: points that are 8 or further away are not seen
    CellHash hash;

    explicit Manner(Settings<4> settings)
        : metric(static_cast<Metric>(settings[0])),
          is_normalized(settings[1] != 0.0f),
          is_bounded(settings[2] != 0.0f),
          hash(static_cast<CellHash>(settings[3])) {}
};

/// Distances by a metric, compared by what grows with them and is faster to get.
struct Distances {
    Metric metric;
    Batch exponent;  ///< of Minkowski's

    template <std::size_t n>
    Batch measure(const Point<n>& way) const {
        if (metric == Metric::euclidean && n > 1) return dot(way, way);
        Batch result(0.0f);
        for (const Batch& x : way.x) {
            if (metric == Metric::chebychev)
                result = max(result, abs(x));
            else
                result += metric == Metric::minkowski && n > 1 ? power(abs(x), exponent) : abs(x);
        }
        return result;
    }
    template <std::size_t n>
    Batch distance(const Batch& measure) const {
        if (metric == Metric::euclidean && n > 1) return sqrt(measure);
        return metric == Metric::minkowski && n > 1 ? power(measure, divided(Batch(1.0f), exponent)) : measure;
    }
    template <std::size_t n>
    Batch bound(bool is_bounded) const {
        if (!is_bounded) return Batch(std::numeric_limits<float>::max());
        Point<n> along_axis{};
        along_axis.x.fill(Batch(0.0f));
        along_axis.x[0] = Batch(8.0f);
        return measure(along_axis);
    }
};

/// Calls visit(offset) of each cell of -reach..reach, the first dimension fastest.
template <std::size_t n, class Visit>
void each_cell(int reach, const Visit& visit) {
    std::array<int, n> at;
    at.fill(-reach);
    while (true) {
        visit(make_point<n>([&](std::size_t i) { return Batch(static_cast<float>(at[i])); }));
        std::size_t i = 0;
        while (i < n && at[i] == reach) at[i++] = -reach;
        if (i == n) return;
        ++at[i];
    }
}

/// The cell of a point, and the points of cells about it, from its lowest corner.
template <std::size_t n>
struct Cell {
    Point<n> corner, local;
    Batch randomness;
    CellHash hash;

    Cell(const Point<n>& at, const Batch& random, CellHash cell_hash)
        : corner(floor(at)), local(at - corner), randomness(random), hash(cell_hash) {}

    Point<n> point(const Point<n>& offset) const { return offset + cell_point(corner + offset, hash) * randomness; }
};

template <std::size_t n>
struct Found {
    Batch distance;
    Vec3b color;
    Point<n> position;
};

/// The nearest point, or the second nearest.
template <std::size_t n, Feature feature>
Found<n> find_nearest(const Cell<n>& cell, const Distances& distances, bool is_bounded) {
    std::array<Batch, 2> nearest;
    nearest.fill(distances.bound<n>(is_bounded));
    std::array<Point<n>, 2> offset, position;
    for (std::size_t k = 0; k < 2; ++k) offset[k].x.fill(Batch(0.0f)), position[k].x.fill(Batch(0.0f));
    each_cell<n>(1, [&](const Point<n>& at) {
        const Point<n> point = cell.point(at);
        const Batch measure = distances.measure(point - cell.local);
        const BatchMask first = measure < nearest[0];
        if constexpr (feature == Feature::f2) {
            const BatchMask second = measure < nearest[1];
            const auto replace = [&](auto& kept, const auto& found) {
                kept[1] = select(first, kept[0], select(second, found, kept[1]));
            };
            replace(nearest, measure), replace(offset, at), replace(position, point);
        }
        nearest[0] = select(first, measure, nearest[0]);
        offset[0] = select(first, at, offset[0]);
        position[0] = select(first, point, position[0]);
    });
    constexpr std::size_t k = feature == Feature::f2 ? 1 : 0;
    return {.distance = distances.distance<n>(nearest[k]),
            .color = cell_color(cell.corner + offset[k], cell.hash),
            .position = cell.corner + position[k]};
}

/// The nearest point, smoothly: each cell is mixed in by how near it is.
template <std::size_t n>
Found<n> find_smooth(const Cell<n>& cell, const Distances& distances, bool is_bounded, const Batch& smoothness) {
    Found<n> found{.distance = Batch(is_bounded ? 8.0f : 1e30f), .color = Vec3b(Batch(0.0f)), .position = {}};
    found.position.x.fill(Batch(0.0f));
    each_cell<n>(2, [&](const Point<n>& offset) {
        const Point<n> point = cell.point(offset);
        const Batch distance = distances.distance<n>(distances.measure(point - cell.local));
        const Batch t = clamp01(Batch(0.5f) + Batch(0.5f) * (found.distance - distance) / smoothness);
        const Batch h = t * t * (Batch(3.0f) - Batch(2.0f) * t), rest = Batch(1.0f) - h;
        const Batch dip = smoothness * h * rest, small_dip = dip / (Batch(1.0f) + Batch(3.0f) * smoothness);
        found.distance = rest * found.distance + h * distance - dip;
        found.color = rest * found.color + h * cell_color(cell.corner + offset, cell.hash) - small_dip;
        for (std::size_t i = 0; i < n; ++i)
            found.position.x[i] = rest * found.position.x[i] + h * point.x[i] - small_dip;
    });
    found.position = cell.corner + found.position;
    return found;
}

template <std::size_t n, Feature feature>
[[gnu::noinline]] Found<n> find(const Manner& manner, const Distances& distances, const Point<n>& at,
                                const Batch& smoothness, const Batch& randomness) {
    const Cell<n> cell(at, randomness, manner.hash);
    if constexpr (feature != Feature::smooth_f1) {
        return find_nearest<n, feature>(cell, distances, manner.is_bounded);
    } else {
        const BatchMask sharp = smoothness == Batch(0.0f);
        const Found<n> smooth = find_smooth(cell, distances, manner.is_bounded, select(sharp, Batch(1.0f), smoothness));
        if (!any(sharp)) return smooth;
        const Found<n> nearest = find_nearest<n, Feature::f1>(cell, distances, manner.is_bounded);
        return {.distance = select(sharp, nearest.distance, smooth.distance),
                .color = select(sharp, nearest.color, smooth.color),
                .position = select(sharp, nearest.position, smooth.position)};
    }
}

/// How much of an octave counts; the first does in full.
Batch share(const Batch& detail, int octave) { return clamp01(detail + Batch(1.0f - static_cast<float>(octave))); }

/// Distance, colour, position, and that of the fourth dimension.
using Outputs = std::tuple<Batch, Vec3b, Vec3b, Batch>;

/// Octaves of a feature, as a fractal's, but for positions, which are mixed.
template <std::size_t n, Feature feature>
Outputs voronoi(Settings<4> settings, const Point<n>& at, Batch detail, Batch roughness, Batch lacunarity,
                Batch smoothness, Batch exponent, Batch randomness) {
    const Manner manner(settings);
    const Distances distances{manner.metric, exponent};
    Batch distance(0.0f), amplitudes(0.0f), amplitude(1.0f), frequency(1.0f);
    Vec3b color(Batch(0.0f));
    Point<n> position;
    position.x.fill(Batch(0.0f));
    Batch counts(1.0f);
    for (int i = 0; any(counts > Batch(0.0f)); ++i) {
        const Found<n> found = find<n, feature>(manner, distances, at * frequency, smoothness, randomness);
        const Batch weight = counts * amplitude;
        distance += found.distance * weight;
        color += found.color * weight;
        amplitudes += weight;
        for (std::size_t k = 0; k < n; ++k)
            position.x[k] = select(weight != Batch(0.0f), lerp(position.x[k], found.position.x[k] / frequency, weight),
                                   position.x[k]);
        frequency *= lacunarity;
        amplitude *= roughness;
        counts = select(amplitude != Batch(0.0f), share(detail, i + 1), Batch(0.0f));
    }
    if (manner.is_normalized) {
        const Batch half = Batch(0.5f) + Batch(0.5f) * randomness;
        const Batch furthest =
            distances.distance<n>(distances.measure(make_point<n>([&](std::size_t) { return half; })));
        distance /= amplitudes * furthest * Batch(feature == Feature::f2 ? 2.0f : 1.0f);
        color /= amplitudes;
    }
    Vec3b position_3d(Batch(0.0f));
    for (std::size_t k = 0; n > 1 && k < std::min<std::size_t>(n, 3); ++k)
        position_3d[static_cast<int>(k)] = position.x[k];
    return {distance, color, position_3d, n == 1 || n == 4 ? position.x[n - 1] : Batch(0.0f)};
}

/// To the plane half-way between the nearest point and another.
template <std::size_t n>
[[gnu::noinline]] Batch distance_to_edge(const Cell<n>& cell, bool is_bounded) {
    if constexpr (n == 1) {
        const auto point = [&](float offset) { return cell.point({{Batch(offset)}}).x[0]; };
        const auto to_middle = [&](const Batch& other) {
            return abs((point(0.0f) + other) * Batch(0.5f) - cell.local.x[0]);
        };
        return min(to_middle(point(-1.0f)), to_middle(point(1.0f)));
    } else {
        const Batch bound(is_bounded ? 8.0f : std::numeric_limits<float>::max());
        Batch nearest = bound;
        Point<n> to_nearest;
        to_nearest.x.fill(Batch(0.0f));
        each_cell<n>(1, [&](const Point<n>& offset) {
            const Point<n> way = cell.point(offset) - cell.local;
            const Batch squared = dot(way, way);
            to_nearest = select(squared < nearest, way, to_nearest);
            nearest = min(nearest, squared);
        });
        Batch result = bound;
        each_cell<n>(1, [&](const Point<n>& offset) {
            const Point<n> way = cell.point(offset) - cell.local, across = way - to_nearest;
            const Batch squared = dot(across, across);
            const BatchMask is_other = squared > Batch(0.0001f);
            const Batch distance =
                Batch(0.5f) * dot(to_nearest + way, across) / sqrt(select(is_other, squared, Batch(1.0f)));
            result = select(is_other, min(result, distance), result);
        });
        return result;
    }
}

template <std::size_t n>
Batch edge(Settings<4> settings, const Point<n>& at, Batch detail, Batch roughness, Batch lacunarity,
           Batch randomness) {
    const Manner manner(settings);
    const Batch furthest = Batch(0.5f) + Batch(0.5f) * randomness;
    Batch distance(8.0f), largest = furthest, amplitude(1.0f), frequency(1.0f), counts(1.0f);
    for (int i = 0; any(counts > Batch(0.0f)); ++i) {
        const Batch found =
            distance_to_edge(Cell<n>(at * frequency, randomness, manner.hash), manner.is_bounded) / frequency;
        const Batch weight = counts * amplitude;
        const BatchMask there = weight != Batch(0.0f);
        distance = select(there, lerp(distance, min(distance, found), weight), distance);
        largest = select(there, lerp(largest, furthest / frequency, weight), largest);
        frequency *= lacunarity;
        amplitude *= roughness;
        counts = select(amplitude != Batch(0.0f), share(detail, i + 1), Batch(0.0f));
    }
    return manner.is_normalized ? distance / largest : distance;
}

/// Half the distance of the nearest point from its nearest one.
template <std::size_t n>
Batch radius(Settings<4> settings, const Point<n>& at, Batch randomness) {
    const Cell<n> cell(at, randomness, Manner(settings).hash);
    const Batch infinite(std::numeric_limits<float>::max());
    Batch nearest = infinite;
    Point<n> offset, position;
    offset.x.fill(Batch(0.0f)), position.x.fill(Batch(0.0f));
    each_cell<n>(1, [&](const Point<n>& beside) {
        const Point<n> point = cell.point(beside), way = point - cell.local;
        const Batch squared = dot(way, way);
        const BatchMask is_nearer = squared < nearest;
        nearest = min(nearest, squared);
        offset = select(is_nearer, beside, offset);
        position = select(is_nearer, point, position);
    });
    Batch next = infinite;
    each_cell<n>(1, [&](const Point<n>& beside) {
        const Point<n> way = cell.point(offset + beside) - position;
        const BatchMask is_other = dot(beside, beside) > Batch(0.0f);
        next = select(is_other, min(next, dot(way, way)), next);
    });
    return Batch(0.5f) * sqrt(next);
}

constexpr std::array ops{
    op<voronoi<1, Feature::f1>>("voronoi_f1_1d"),
    op<voronoi<2, Feature::f1>>("voronoi_f1_2d"),
    op<voronoi<3, Feature::f1>>("voronoi_f1_3d"),
    op<voronoi<4, Feature::f1>>("voronoi_f1_4d"),
    op<voronoi<1, Feature::f2>>("voronoi_f2_1d"),
    op<voronoi<2, Feature::f2>>("voronoi_f2_2d"),
    op<voronoi<3, Feature::f2>>("voronoi_f2_3d"),
    op<voronoi<4, Feature::f2>>("voronoi_f2_4d"),
    op<voronoi<1, Feature::smooth_f1>>("voronoi_smooth_f1_1d"),
    op<voronoi<2, Feature::smooth_f1>>("voronoi_smooth_f1_2d"),
    op<voronoi<3, Feature::smooth_f1>>("voronoi_smooth_f1_3d"),
    op<voronoi<4, Feature::smooth_f1>>("voronoi_smooth_f1_4d"),
    op<edge<1>>("voronoi_distance_to_edge_1d"),
    op<edge<2>>("voronoi_distance_to_edge_2d"),
    op<edge<3>>("voronoi_distance_to_edge_3d"),
    op<edge<4>>("voronoi_distance_to_edge_4d"),
    op<radius<1>>("voronoi_n_sphere_radius_1d"),
    op<radius<2>>("voronoi_n_sphere_radius_2d"),
    op<radius<3>>("voronoi_n_sphere_radius_3d"),
    op<radius<4>>("voronoi_n_sphere_radius_4d"),
};

}  // namespace

std::span<const OpKind> voronoi_ops() { return ops; }

}  // namespace pivot
