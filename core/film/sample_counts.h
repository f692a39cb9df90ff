// How many samples each pixel gets under adaptive sampling, from a pilot that all pixels have. A pixel's count follows
// from its neighbours' pilots alone: its own samples do not decide when it stops, so the picture stays unbiased.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace pivot {

/// Successive samples that are averaged before their spread is taken: evenly placed points do better than their single
/// samples show.
inline constexpr std::uint32_t pilot_block = 4;

/// The spread of a pixel's blocks, each the mean radiance over its samples and colours.
struct Pilot {
    float sum = 0.0f;
    float sum_of_squares = 0.0f;
    std::uint32_t blocks = 0;

    void add(float block) {
        sum += block;
        sum_of_squares += block * block;
        blocks += 1;
    }
};

/// Samples of the pilot itself when at most max_samples are allowed.
std::uint32_t pilot_samples(std::uint32_t max_samples);

/// Counts from the pilot's to max_samples that bring each pixel's standard error to relative_error of its radiance, or
/// of 0.1 where it is darker. pilots: row by row, width to a row.
std::vector<std::uint32_t> sample_counts(std::span<const Pilot> pilots, int width, float relative_error,
                                         std::uint32_t max_samples);

}  // namespace pivot
