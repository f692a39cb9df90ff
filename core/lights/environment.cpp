#include "core/lights/environment.h"

#include <numeric>

namespace pivot {
namespace {

/// So much of the samples goes evenly over the sphere: a table may miss what lies between its samples.
constexpr float even_share = 0.02f;

/// Numbers' sums up to each over the whole, and 1; and where to look among them for each of so many even steps.
void accumulate(std::span<const float> numbers, double total, std::uint32_t steps, std::vector<float>& sums,
                std::vector<std::uint16_t>& guide) {
    const std::size_t first = sums.size();
    double sum = 0.0;
    for (const float number : numbers) {
        sums.push_back(static_cast<float>(sum / total));
        sum += static_cast<double>(number);
    }
    sums.push_back(1.0f);
    std::uint16_t at = 0;
    for (std::uint32_t k = 0; k <= steps; ++k) {
        const float u = static_cast<float>(k) / static_cast<float>(steps);
        while (at + 1u < numbers.size() && sums[first + at + 1] <= u) ++at;
        guide.push_back(at);
    }
}

/// Where u falls among the sums that start at `first`, how far between two, and how far these are apart.
struct Found {
    IndexBatch index;
    Batch fraction, width;
};
Found find(const std::vector<float>& sums, const IndexBatch& first, const std::vector<std::uint16_t>& guide,
           const IndexBatch& first_guide, std::uint32_t steps, const Batch& u) {
    const Vec2b ends = fetch_pair<Batch>(guide.data(), first_guide + to_index(u * Batch(static_cast<float>(steps))));
    IndexBatch low = to_index(ends.x), high = to_index(ends.y);
    while (xsimd::any(low < high)) {
        const IndexBatch middle = (low + high + IndexBatch(1)) >> 1;
        const BatchMask beyond = fetch(sums.data(), first + middle) <= u;
        low = select(beyond, middle, low);
        high = select(beyond, high, middle - IndexBatch(1));
    }
    const Batch before = fetch(sums.data(), first + low), after = fetch(sums.data(), first + low + IndexBatch(1));
    return {low, min((u - before) / max(after - before, tiny<Batch>), Batch(1.0f - 0x1p-24f)), after - before};
}

/// Of one of so many cells with so much of the samples.
Batch density(const Batch& row_share, const Batch& column_share) {
    constexpr float per_share = static_cast<float>(Environment::rows) * Environment::columns / (4.0f * pi<float>);
    return row_share * column_share * Batch(per_share);
}

}  // namespace

Environment::Environment(std::span<const float> brightness) {
    const double total = std::accumulate(brightness.begin(), brightness.end(), 0.0);
    if (!(total > 0.0)) return;
    const auto mean = static_cast<float>(total / (static_cast<double>(rows) * columns));
    std::vector<float> row(columns), row_totals;
    for (std::uint32_t y = 0; y < rows; ++y) {
        for (std::uint32_t x = 0; x < columns; ++x) {
            row[x] = lerp(brightness[y * columns + x] / mean, 1.0f, even_share);
        }
        const double of_row = std::accumulate(row.begin(), row.end(), 0.0);
        row_totals.push_back(static_cast<float>(of_row));
        accumulate(row, of_row, guide_steps, column_sums_, column_guide_);
    }
    const double all = std::accumulate(row_totals.begin(), row_totals.end(), 0.0);
    accumulate(row_totals, all, guide_steps, row_sums_, row_guide_);
    // Two are read at once.
    column_guide_.push_back(0), row_guide_.push_back(0);
}

Vec3b Environment::direction(const Vec2b& place) {
    const Batch z = Batch(2.0f) * place.y - Batch(1.0f), phi = Batch(2.0f * pi<float>) * place.x;
    const Batch radius = safe_sqrt(Batch(1.0f) - z * z);
    return {radius * cos(phi), radius * sin(phi), z};
}

EnvironmentSample Environment::sample(const Vec2b& u) const {
    const auto times = [](const IndexBatch& index, std::uint32_t factor) {
        return index * IndexBatch(static_cast<std::int32_t>(factor));
    };
    const Found row = find(row_sums_, IndexBatch(0), row_guide_, IndexBatch(0), guide_steps, u.y);
    const Found column = find(column_sums_, times(row.index, columns + 1), column_guide_,
                              times(row.index, guide_steps + 1), guide_steps, u.x);
    const Vec2b place((xsimd::to_float(column.index) + column.fraction) * Batch(1.0f / columns),
                      (xsimd::to_float(row.index) + row.fraction) * Batch(1.0f / rows));
    return {direction(place), density(row.width, column.width)};
}

Batch Environment::pdf_omega(const Vec3b& direction) const {
    const auto cell = [](const Batch& place, std::uint32_t count) {
        return min(max(floor(place * Batch(static_cast<float>(count))), Batch(0.0f)),
                   Batch(static_cast<float>(count - 1)));
    };
    const Batch turn = atan2(direction.y, direction.x) * Batch(0.5f / pi<float>);
    const Batch x = cell(select(turn < Batch(0.0f), turn + Batch(1.0f), turn), columns);
    const IndexBatch y = to_index(cell(Batch(0.5f) * direction.z + Batch(0.5f), rows));
    const IndexBatch at = y * IndexBatch(static_cast<std::int32_t>(columns + 1)) + to_index(x);
    const auto width = [](const std::vector<float>& sums, const IndexBatch& index) {
        return fetch(sums.data(), index + IndexBatch(1)) - fetch(sums.data(), index);
    };
    return density(width(row_sums_, y), width(column_sums_, at));
}

}  // namespace pivot
