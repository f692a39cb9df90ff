#include "core/film/pixel_filter.h"

#include <algorithm>
#include <cmath>

namespace pivot {
namespace {

/// The window over [-1/2, 1/2], four terms [Harris78, table I]; its integral is 1.
double blackman_harris(double x) {
    const double t = 2.0 * pi<double> * (x + 0.5);
    return (0.35875 - 0.48829 * cos(t) + 0.14128 * cos(2.0 * t) - 0.01168 * cos(3.0 * t)) / 0.35875;
}

}  // namespace

PixelFilter::PixelFilter(PixelFilterShape shape, float width_px)
    : shape_(shape),
      width_px_(static_cast<double>(width_px)),
      reach_px_(static_cast<int>(std::ceil(std::max(0.5 * width_px_ - 0.5, 0.0)))),
      places_(cells + 1, 0.0f) {
    if (!(width_px > 0.0f)) return;
    constexpr std::size_t steps = 16 * cells;
    const double side = std::min(width_px_, 1.0);  // of the square in which samples fall
    const auto place_of = [&](double step) { return side * (step / steps - 0.5); };
    std::vector<double> cumulative{0.0};
    for (std::size_t i = 0; i < steps; ++i) {
        double sum = 0.0;
        for (int pixel = -reach_px_; pixel <= reach_px_; ++pixel)
            sum += density(place_of(static_cast<double>(i) + 0.5) - pixel);
        cumulative.push_back(cumulative.back() + sum);
    }
    for (std::size_t k = 0, i = 0; k <= cells; ++k) {
        const double target = cumulative.back() * static_cast<double>(k) / cells;
        while (i < steps && cumulative[i + 1] < target) ++i;
        const double inside = i < steps ? (target - cumulative[i]) / (cumulative[i + 1] - cumulative[i]) : 0.0;
        places_[k] = static_cast<float>(place_of(static_cast<double>(i) + inside));
    }
}

double PixelFilter::density(double offset_px) const {
    const double place = offset_px / width_px_;
    if (!(std::abs(place) <= 0.5)) return 0.0;
    return (shape_ == PixelFilterShape::box ? 1.0 : blackman_harris(place)) / width_px_;
}

std::vector<float> PixelFilter::weights(float offset_px) const {
    std::vector<float> weights;
    if (reach_px_ == 0) return {1.0f};
    double sum = 0.0;
    const auto of_pixel = [&](int pixel) { return density(static_cast<double>(offset_px) - pixel); };
    for (int pixel = -reach_px_; pixel <= reach_px_; ++pixel) sum += of_pixel(pixel);
    for (int pixel = -reach_px_; pixel <= reach_px_; ++pixel)
        weights.push_back(static_cast<float>(of_pixel(pixel) / sum));
    return weights;
}

FilterSample PixelFilter::sample(const Vec2f& u) const {
    const auto along_axis = [&](float unit) {
        const float place = unit * cells;
        const auto k = static_cast<std::size_t>(place);
        return lerp(places_[k], places_[k + 1], place - static_cast<float>(k));
    };
    const Vec2f offset(along_axis(u.x), along_axis(u.y));
    return {offset, weights(offset.x), weights(offset.y)};
}

}  // namespace pivot
