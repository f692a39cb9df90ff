#include "core/film/sample_counts.h"

#include <algorithm>
#include <cmath>

namespace pivot {
namespace {

/// Means over squares of pixels, 2 reach + 1 wide, as far as these are in the grid.
std::vector<float> means_around(std::span<const float> values, const PixelGrid& grid, int reach) {
    // Sums of sums lose nothing beside a pixel that is a million times brighter, as differences of running ones would.
    std::vector<float> along_x(grid.size()), means(grid.size());
    for (int y = 0; y < grid.height; ++y) {
        for (int x = 0; x < grid.width; ++x) {
            const int first = std::max(x - reach, 0), last = std::min(x + reach, grid.width - 1);
            for (int u = first; u <= last; ++u) along_x[grid.index(x, y)] += values[grid.index(u, y)];
            along_x[grid.index(x, y)] /= static_cast<float>(last - first + 1);
        }
    }
    for (int y = 0; y < grid.height; ++y) {
        const int first = std::max(y - reach, 0), last = std::min(y + reach, grid.height - 1);
        for (int x = 0; x < grid.width; ++x) {
            for (int v = first; v <= last; ++v) means[grid.index(x, y)] += along_x[grid.index(x, v)];
            means[grid.index(x, y)] /= static_cast<float>(last - first + 1);
        }
    }
    return means;
}

/// Of one sample of each pixel, relative to its radiance, as it and those beside it have it. Of what came once, and as
/// a surprise to all of these, the mean over the pixels far around.
std::vector<float> relative_variances(std::span<const Pilot> pilot, const PixelGrid& grid) {
    constexpr float foreseen = 4.0f;  // times the variance of the other samples
    constexpr int far_px = 16;
    std::vector<float> own(grid.size()), others(grid.size()), radiance(grid.size()), surprise(grid.size());
    for (std::size_t i = 0; i < grid.size(); ++i) {
        own[i] = pilot[i].variance();
        others[i] = pilot[i].variance_without_most();
        radiance[i] = std::abs(pilot[i].mean());
    }
    radiance = means_around(radiance, grid, 1);
    others = means_around(others, grid, 1);
    std::vector<float> variances = means_around(own, grid, 1);
    for (std::size_t i = 0; i < grid.size(); ++i) {
        const float scale = 1.0f / sqr(std::max(radiance[i], least_radiance_of_error));
        surprise[i] = scale * std::max(own[i] - foreseen * others[i], 0.0f);
        variances[i] *= scale;
    }
    surprise = means_around(surprise, grid, far_px);
    for (std::size_t i = 0; i < grid.size(); ++i) variances[i] += surprise[i];
    return variances;
}

/// How many samples a pixel of some variance gets: in proportion to its standard deviation.
struct Allotment {
    float wanted, least, most;  ///< wanted: squared error
    float per_deviation = 0.0f;

    float operator()(float variance) const {
        // For four times the error, and for a quarter of it.
        const float needed = variance / (worst * wanted), enough = worst * variance / wanted;
        return std::clamp(std::clamp(std::sqrt(variance) * per_deviation, needed, enough), least, most);
    }
    /// The mean of the pixels' squared errors. What even the most samples leave of one beyond the error wanted is not
    /// made good for by others, which would each take the most to no avail.
    float error_of(std::span<const float> variances) const {
        double sum = 0.0;
        for (const float variance : variances) {
            const float samples = (*this)(variance), left_by_most = std::max(variance / most - wanted, 0.0f);
            sum += static_cast<double>(variance / samples - left_by_most);
        }
        return static_cast<float>(sum / static_cast<double>(variances.size()));
    }

   private:
    static constexpr float worst = 16.0f;
};

/// The least that makes the error.
Allotment allot(std::span<const float> variances, float relative_error, float least, float most) {
    Allotment allotment{sqr(relative_error), least, most};
    float low = 1e-3f, high = 1e12f;
    for (int step = 0; step < 60; ++step) {
        allotment.per_deviation = std::sqrt(low * high);
        (allotment.error_of(variances) <= allotment.wanted ? high : low) = allotment.per_deviation;
    }
    return allotment;
}

}  // namespace

void Pilot::add(float radiance, float counted) {
    constexpr float most = 1e12f;  // whose square is a number
    block_of_light_ += std::clamp(radiance, -most, most) / samples_per_block;
    block_ += std::clamp(counted, -most, most) / samples_per_block;
    if (++samples_ % samples_per_block != 0) return;
    light_ += block_of_light_;
    sum_ += block_;
    sum_of_squares_ += sqr(block_);
    most_ = blocks_ == 0 ? block_ : std::max(most_, block_);
    ++blocks_;
    block_ = block_of_light_ = 0.0f;
}

float Pilot::variance_of(float sum, float sum_of_squares, std::uint32_t blocks) {
    if (blocks < 2) return 0.0f;
    const auto n = static_cast<float>(blocks);
    return samples_per_block * std::max(sum_of_squares - sum * sum / n, 0.0f) / (n - 1.0f);
}

SampleCounts sample_counts(const std::array<std::vector<Pilot>, 2>& pilot, const PixelGrid& grid, int reach_px,
                           float half_error, float relative_error, std::uint32_t pilot_samples,
                           std::uint32_t max_samples) {
    const auto least = static_cast<float>(pilot_samples), most = static_cast<float>(max_samples);
    std::array<std::vector<float>, 2> halves{relative_variances(pilot[0], grid), relative_variances(pilot[1], grid)};
    std::vector<float> variances;
    for (std::size_t i = 0; i < grid.size(); ++i) variances.push_back(0.5f * (halves[0][i] + halves[1][i]));
    double told = 0.0;  // of a half's error by its samples
    for (const float variance : variances) told += static_cast<double>(variance / (0.5f * least)) / grid.size();
    const float scale = told > 0.0 ? std::clamp(half_error / static_cast<float>(told), 0.25f, 4.0f) : 1.0f;
    for (std::vector<float>* all : {&halves[0], &halves[1], &variances})
        for (float& variance : *all) variance *= scale;

    const Allotment samples_of = allot(variances, relative_error, least, most);
    SampleCounts counts;
    std::vector<std::uint32_t> further(grid.size());
    for (std::size_t i = 0; i < grid.size(); ++i) {
        // As many as either half asks for, whose weights count on them.
        for (const std::size_t half : {0, 1}) {
            const float samples = samples_of(halves[half][i]);
            counts.half_weight[1 - half].push_back(0.5f * least / samples);
            further[i] = std::max(further[i], static_cast<std::uint32_t>(std::ceil(samples - least)));
        }
    }
    counts.further = further;
    for (int y = 0; y < grid.height; ++y)
        for (int x = 0; x < grid.width; ++x)
            for (int v = std::max(y - reach_px, 0); v <= std::min(y + reach_px, grid.height - 1); ++v)
                for (int u = std::max(x - reach_px, 0); u <= std::min(x + reach_px, grid.width - 1); ++u)
                    counts.further[grid.index(x, y)] =
                        std::max(counts.further[grid.index(x, y)], (further[grid.index(u, v)] + 3) / 4);
    return counts;
}

}  // namespace pivot
