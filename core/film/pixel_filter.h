// The pixel filter. A sample in one pixel is also worth something to the pixels around whose filters reach it: samples
// are drawn from the sum of all pixels' filters, and each pixel weighs them by its own filter's share of that sum. This
// is the balance heuristic [Veach97] over pixels: unbiased, and of Blender's default filter it leaves 0.45 of the noise
// of samples that serve their own pixel alone. Where all pixels take samples at the same places, the weights
// of each sum to its number of samples: what is even stays even. Blackman-Harris, or the box.
//
// [Harris78]  On the Use of Windows for Harmonic Analysis with the Discrete Fourier Transform
// [Veach97]   Robust Monte Carlo Methods for Light Transport Simulation
#pragma once

#include <vector>

#include "core/math/vector.h"

namespace pivot {

enum class PixelFilterShape { blackman_harris, box };

/// Where a sample lies in its pixel, and its weights there and for the pixels around. Weights sum to 1.
struct FilterSample {
    Vec2f offset;                             ///< from the pixel's centre, in pixels
    std::vector<float> weights_x, weights_y;  ///< for the pixels from -reach_px to reach_px off, along each axis
};

class PixelFilter {
   public:
    /// width_px: of the whole window; Cycles' setting of 1.5 is half of it.
    PixelFilter(PixelFilterShape shape, float width_px);

    /// How many pixels on each side a sample can be worth something to.
    int reach_px() const { return reach_px_; }

    /// For u in [0, 1)^2.
    FilterSample sample(const Vec2f& u) const;

   private:
    /// The filter of a pixel at this distance from its centre, in pixels; its integral is 1.
    double density(double offset_px) const;
    std::vector<float> weights(float offset_px) const;

    static constexpr std::size_t cells = 1024;

    PixelFilterShape shape_;
    double width_px_;
    int reach_px_;
    std::vector<float> places_;  ///< where in the pixel the sum of all filters reaches k / cells
};

}  // namespace pivot
