// Light from all around as a distribution of directions: a table over the sphere in an equal-area map, its rows even in
// z and its columns in azimuth, so that a cell's density is its share over its size.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/simd/batch.h"

namespace pivot {

struct EnvironmentSample {
    Vec3b wi;
    Batch pdf_omega;
};

class Environment {
   public:
    /// As fine as pictures of skies are: what differs within a cell is noise.
    static constexpr std::uint32_t rows = 1024, columns = 2048;

    /// No light: is_dark().
    Environment() = default;
    /// brightness: of each cell, row by row, at least 0.
    explicit Environment(std::span<const float> brightness);

    bool is_dark() const { return row_sums_.empty(); }

    /// u in [0, 1)^2; every direction has a chance.
    EnvironmentSample sample(const Vec2b& u) const;
    Batch pdf_omega(const Vec3b& direction) const;

    /// The direction of a place of the map, x and y in [0, 1].
    static Vec3b direction(const Vec2b& place);

   private:
    static constexpr std::uint32_t guide_steps = 1024;

    std::vector<float> row_sums_;     ///< up to each row, then 1
    std::vector<float> column_sums_;  ///< of each row likewise, columns + 1 numbers
    // For each step of u from 0 to 1, the last of the sums that are no larger.
    std::vector<std::uint16_t> row_guide_, column_guide_;
};

}  // namespace pivot
