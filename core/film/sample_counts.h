// How many samples each pixel gets under adaptive sampling, from a pilot that all have. Samples go where they lower the
// error of the whole picture most: a pixel's are in proportion to its standard deviation, relative to its radiance.
//
// The pilot has two halves that know nothing of each other. How much one half's samples weigh beside those that follow
// is decided by the other half's spread, so that no sample decides its own weight, and the picture stays unbiased: but
// for two numbers that are the whole picture's, in which a pixel of many has little say.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/film/film.h"

namespace pivot {

/// The spread of a pixel's blocks of successive samples, each the mean radiance over its samples and colours: evenly
/// placed points do better than their single samples show.
class Pilot {
   public:
    void add(float radiance) { add(radiance, radiance); }
    /// counted: of the radiance, what its spread is told of.
    void add(float radiance, float counted);
    float mean() const { return blocks_ > 0 ? light_ / static_cast<float>(blocks_) : 0.0f; }
    /// Of one sample as blocks of them have it; 0 of fewer than two blocks.
    float variance() const { return variance_of(sum_, sum_of_squares_, blocks_); }
    /// The same without the brightest block, of three and more.
    float variance_without_most() const {
        return blocks_ < 3 ? variance() : variance_of(sum_ - most_, sum_of_squares_ - sqr(most_), blocks_ - 1);
    }

   private:
    static constexpr std::uint32_t samples_per_block = 2;
    static float variance_of(float sum, float sum_of_squares, std::uint32_t blocks);

    float block_of_light_ = 0.0f, light_ = 0.0f;
    float block_ = 0.0f, sum_ = 0.0f, sum_of_squares_ = 0.0f, most_ = 0.0f;
    std::uint32_t samples_ = 0, blocks_ = 0;
};

/// For each pixel.
struct SampleCounts {
    std::vector<std::uint32_t> further;             ///< samples that are to follow the pilot's
    std::array<std::vector<float>, 2> half_weight;  ///< of each half of the pilot in the picture; what is left: theirs
};

/// So that the mean squared error over all pixels is relative_error^2, and none has four times that error, with at most
/// max_samples a pixel: others do not make good for what these leave of one. half_error: the mean squared error of a
/// picture of half a pilot, which tells what the filter and even spreading leave of the samples' variance. A pixel has
/// no fewer than a quarter of the samples of those beside it, which its own serve too; and what only one block of a
/// pixel met, and none beside it, may be met anywhere near.
SampleCounts sample_counts(const std::array<std::vector<Pilot>, 2>& pilot, const PixelGrid& grid, int reach_px,
                           float half_error, float relative_error, std::uint32_t pilot_samples,
                           std::uint32_t max_samples);

}  // namespace pivot
