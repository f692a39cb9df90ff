// The pixel filter, by importance: a sample's place in the pixel is drawn from the filter, and every sample weighs the
// same. Blackman-Harris, or the box.
//
// [Harris78]  On the Use of Windows for Harmonic Analysis with the Discrete Fourier Transform
#pragma once

#include <array>

#include "core/math/vector.h"

namespace pivot {

enum class PixelFilterShape { blackman_harris, box };

class PixelFilter {
   public:
    /// width_px: of the whole window; Cycles' setting of 1.5 is half of it.
    PixelFilter(PixelFilterShape shape, float width_px) : width_px_(width_px) {
        if (shape == PixelFilterShape::box) {
            for (std::size_t k = 0; k <= cells; ++k) inverse_[k] = static_cast<float>(k) / cells;
            return;
        }
        constexpr std::size_t steps = 16;  // integration steps per table cell
        double sum = 0.0;
        std::array<double, cells * steps + 1> cumulative{};
        for (std::size_t i = 0; i < cells * steps; ++i) {
            sum += window((static_cast<double>(i) + 0.5) / (cells * steps));
            cumulative[i + 1] = sum;
        }
        std::size_t i = 0;
        for (std::size_t k = 0; k <= cells; ++k) {
            const double target = sum * static_cast<double>(k) / cells;
            while (i < cells * steps && cumulative[i + 1] < target) ++i;
            const double inside =
                i < cells * steps ? (target - cumulative[i]) / (cumulative[i + 1] - cumulative[i]) : 0.0;
            inverse_[k] = static_cast<float>((static_cast<double>(i) + inside) / (cells * steps));
        }
    }

    /// Offset from the pixel's centre for u in [0, 1)^2, in pixels.
    Vec2f sample(const Vec2f& u) const { return {sample_axis(u.x), sample_axis(u.y)}; }

   private:
    static constexpr std::size_t cells = 1024;

    /// The window over [0, 1], four terms [Harris78, table I].
    static double window(double x) {
        const double t = 2.0 * pi<double> * x;
        return 0.35875 - 0.48829 * cos(t) + 0.14128 * cos(2.0 * t) - 0.01168 * cos(3.0 * t);
    }

    float sample_axis(float u) const {
        const float place = u * cells;
        const auto k = static_cast<std::size_t>(place);
        return width_px_ * (lerp(inverse_[k], inverse_[k + 1], place - static_cast<float>(k)) - 0.5f);
    }

    float width_px_;
    std::array<float, cells + 1> inverse_{};
};

}  // namespace pivot
