// A distribution of microfacet normals as a picture: the hemisphere of normals h seen orthographically, x and y of the
// square from -1 to 1 those of h. A pixel is its mean over its part of the unit disk; within it D leans towards what
// its neighbours are, as far as that makes no new extreme along either axis.
//
// [Patapom]   "Solid angle of a pixel", Wakapon wiki: pixels weighted by exact solid angles.
// [vanLeer77] "Towards the ultimate conservative difference scheme IV": slopes that make no new extreme
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "core/distributions/ndf_pixel.h"

namespace pivot {

inline constexpr std::size_t min_ndf_size_px = 8, max_ndf_size_px = 4096;

class NdfImage {
   public:
    /// pixels: size * size, row by row from y = -1, scaled here such that D's projected area, the integral of D h.z dw,
    /// is 1. Throws std::invalid_argument that says what is wrong with them.
    NdfImage(std::size_t size, std::vector<float> pixels);

    std::size_t size() const { return size_; }
    /// The pixels' means of D, 1/sr, row by row.
    const std::vector<float>& pixels() const { return density_; }

    /// D(h), 1/sr; h unit, h.z >= 0.
    float density(const Vec3f& h) const;
    /// A normal in proportion to the pixels, whoever sees it, and its density.
    Vec3f sample(const Vec2f& u) const;
    float pdf_omega(const Vec3f& h) const;

    std::size_t memory_bytes() const {
        return (density_.size() + cumulative_.size()) * sizeof(float) + cumulative_row_.size() * sizeof(double);
    }

   private:
    /// x or y of a normal in pixels, and the pixel's row or column.
    float in_pixels(float x) const { return std::max((x + 1.0f) * 0.5f * static_cast<float>(size_), 0.0f); }
    std::size_t pixel_at(float x) const { return std::min(static_cast<std::size_t>(in_pixels(x)), size_ - 1); }

    std::size_t size_;
    std::vector<float> density_;
    std::vector<float> cumulative_;       ///< of D's integral along each row, the row's own from its first pixel on
    std::vector<double> cumulative_row_;  ///< of the rows
};

}  // namespace pivot
