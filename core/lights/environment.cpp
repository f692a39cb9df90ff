#include "core/lights/environment.h"

#include <numeric>

namespace pivot {
namespace {

/// So much of the samples goes evenly over the sphere: a table may miss what lies between its samples.
constexpr float even_share = 0.02f;

/// Replaces numbers by their sums up to each over the whole; the last is 1.
void accumulate(std::span<const float> numbers, float total, std::vector<float>& sums) {
    float sum = 0.0f;
    for (const float number : numbers) {
        sums.push_back(sum / total);
        sum += number;
    }
    sums.push_back(1.0f);
}

/// Where u falls among the sums that start at `first`, a power of two of them, and how far between two.
struct Found {
    IndexBatch index;
    Batch fraction;
};
Found find(const std::vector<float>& sums, const IndexBatch& first, std::uint32_t count, const Batch& u) {
    IndexBatch index = first;
    for (std::uint32_t step = count / 2; step > 0; step /= 2) {
        const IndexBatch next = index + IndexBatch(static_cast<std::int32_t>(step));
        index = select(fetch(sums.data(), next) <= u, next, index);
    }
    const Batch low = fetch(sums.data(), index), high = fetch(sums.data(), index + IndexBatch(1));
    return {index - first, min((u - low) / max(high - low, tiny<Batch>), Batch(1.0f - 0x1p-24f))};
}

}  // namespace

Environment::Environment(std::span<const float> brightness) {
    const double total = std::accumulate(brightness.begin(), brightness.end(), 0.0);
    if (!(total > 0.0)) return;
    const auto mean = static_cast<float>(total / (rows * columns));
    std::vector<float> row(columns), row_totals;
    for (std::uint32_t y = 0; y < rows; ++y) {
        for (std::uint32_t x = 0; x < columns; ++x) {
            row[x] = lerp(brightness[y * columns + x] / mean, 1.0f, even_share);
            pdf_omega_.push_back(row[x] / (4.0f * pi<float>));
        }
        row_totals.push_back(std::accumulate(row.begin(), row.end(), 0.0f));
        accumulate(row, row_totals.back(), column_sums_);
    }
    accumulate(row_totals, std::accumulate(row_totals.begin(), row_totals.end(), 0.0f), row_sums_);
}

Vec3b Environment::direction(const Vec2b& place) {
    const Batch z = Batch(2.0f) * place.y - Batch(1.0f), phi = Batch(2.0f * pi<float>) * place.x;
    const Batch radius = safe_sqrt(Batch(1.0f) - z * z);
    return {radius * cos(phi), radius * sin(phi), z};
}

Vec3b Environment::sample(const Vec2b& u) const {
    const Found row = find(row_sums_, IndexBatch(0), rows, u.y);
    const Found column =
        find(column_sums_, row.index * IndexBatch(static_cast<std::int32_t>(columns + 1)), columns, u.x);
    return direction({(xsimd::to_float(column.index) + column.fraction) * Batch(1.0f / columns),
                      (xsimd::to_float(row.index) + row.fraction) * Batch(1.0f / rows)});
}

Batch Environment::pdf_omega(const Vec3b& direction) const {
    const auto cell = [](const Batch& place, std::uint32_t count) {
        return min(max(floor(place * Batch(static_cast<float>(count))), Batch(0.0f)),
                   Batch(static_cast<float>(count - 1)));
    };
    const Batch turn = atan2(direction.y, direction.x) * Batch(0.5f / pi<float>);
    const Batch x = cell(select(turn < Batch(0.0f), turn + Batch(1.0f), turn), columns);
    const Batch y = cell(Batch(0.5f) * direction.z + Batch(0.5f), rows);
    return fetch(pdf_omega_.data(), to_index(y * Batch(static_cast<float>(columns)) + x));
}

}  // namespace pivot
