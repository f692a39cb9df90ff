#include "core/distributions/ndf_image.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace pivot {
namespace {

constexpr float below_one = 1.0f - 0x1p-24f;

void require_ndf(std::size_t size, const std::vector<float>& pixels) {
    if (size == 0 || pixels.size() != size * size) throw std::invalid_argument("it must be square");
    if (size < min_ndf_size_px)
        throw std::invalid_argument("it is " + std::to_string(size) + " pixels wide, fewer than " +
                                    std::to_string(min_ndf_size_px) + ", which tell nothing");
    if (size > max_ndf_size_px)
        throw std::invalid_argument("it is " + std::to_string(size) + " pixels wide, more than " +
                                    std::to_string(max_ndf_size_px) + "; scale it down");
    if (!std::ranges::all_of(pixels, [](float value) { return std::isfinite(value); }))
        throw std::invalid_argument("it has pixels that are not finite");
    if (std::ranges::any_of(pixels, [](float value) { return value < 0.0f; }))
        throw std::invalid_argument("it has negative pixels; a density is at least 0");
}

/// The slope at the middle of three values, such that nothing between is beyond them [vanLeer77].
float limited_slope(float before, float here, float after) {
    const float down = 2.0f * (here - before), up = 2.0f * (after - here), mean = 0.25f * (down + up);
    if (down * up <= 0.0f) return 0.0f;
    return std::copysign(std::min({std::abs(down), std::abs(up), std::abs(mean)}), mean);
}

}  // namespace

NdfImage::NdfImage(std::size_t size, std::vector<float> pixels) : size_(size), density_(std::move(pixels)) {
    require_ndf(size, density_);
    const float largest = *std::ranges::max_element(density_);
    cumulative_.resize(size * size);
    std::vector<double> row_mass(size), row_area(size);
    tbb::parallel_for(std::size_t(0), size, [&](std::size_t row) {
        double mass = 0.0;
        for (std::size_t i = 0; i < size; ++i) {
            float& density = density_[row * size + i];
            const NdfPixelMoments m = moments(NdfPixel::at(size, i, row));
            density = m.solid_angle > 0.0 && largest > 0.0f ? density / largest : 0.0f;
            mass += static_cast<double>(density) * m.solid_angle;
            row_area[row] += static_cast<double>(density) * m.h.z;
            cumulative_[row * size + i] = static_cast<float>(mass);
        }
        row_mass[row] = mass;
    });
    double area = 0.0;
    for (const double of_row : row_area) area += of_row;
    if (!(area > 0.0)) throw std::invalid_argument("it is black within the unit disk, which holds all normals");
    // A density of one pixel at the rim may be beyond any float.
    if (!(1.0 / area < static_cast<double>(std::numeric_limits<float>::max())))
        throw std::invalid_argument("nothing of it faces the viewer");
    const auto scale = static_cast<float>(1.0 / area);
    for (float& density : density_) density *= scale;
    for (float& mass : cumulative_) mass *= scale;
    double total = 0.0;
    for (const double mass : row_mass) cumulative_row_.push_back(total += mass / area);
}

float NdfImage::density(const Vec3f& h) const {
    const std::size_t column = pixel_at(h.x), row = pixel_at(h.y);
    const float* at = &density_[row * size_ + column];
    if (!(*at > 0.0f) || column == 0 || row == 0 || column + 1 == size_ || row + 1 == size_) return *at;
    const auto stride = static_cast<std::ptrdiff_t>(size_);
    const auto from_middle = [&](float x, std::size_t pixel) {
        return in_pixels(x) - static_cast<float>(pixel) - 0.5f;
    };
    const float lean = limited_slope(at[-1], *at, at[1]) * from_middle(h.x, column) +
                       limited_slope(at[-stride], *at, at[stride]) * from_middle(h.y, row);
    return std::max(*at + lean, 0.0f);
}

Vec3f NdfImage::sample(const Vec2f& u) const {
    const double total = cumulative_row_.back(), wanted = static_cast<double>(u.y) * total;
    const auto row = std::min<std::size_t>(
        static_cast<std::size_t>(std::ranges::upper_bound(cumulative_row_, wanted) - cumulative_row_.begin()),
        size_ - 1);
    const double before = row > 0 ? cumulative_row_[row - 1] : 0.0, of_row = cumulative_row_[row] - before;
    const std::span<const float> masses(&cumulative_[row * size_], size_);
    const float at = u.x * masses.back();
    const auto column = std::min<std::size_t>(
        static_cast<std::size_t>(std::ranges::upper_bound(masses, at) - masses.begin()), size_ - 1);
    const float first = column > 0 ? masses[column - 1] : 0.0f, mass = masses[column] - first;
    const auto left = [](double part, double whole) {
        return whole > 0.0 ? std::clamp(static_cast<float>(part / whole), 0.0f, below_one) : 0.5f;
    };
    return pivot::sample(
        NdfPixel::at(size_, column, row),
        {left(static_cast<double>(at - first), static_cast<double>(mass)), left(wanted - before, of_row)});
}

float NdfImage::pdf_omega(const Vec3f& h) const {
    const std::size_t column = pixel_at(h.x), row = pixel_at(h.y), index = row * size_ + column;
    if (!(density_[index] > 0.0f)) return 0.0f;
    const float* masses = &cumulative_[row * size_];
    const auto mass = static_cast<double>(masses[column] - (column > 0 ? masses[column - 1] : 0.0f));
    return static_cast<float>(mass / cumulative_row_.back() *
                              pivot::pdf_omega(NdfPixel::at(size_, column, row), static_cast<double>(h.x)));
}

}  // namespace pivot
