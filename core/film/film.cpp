#include "core/film/film.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace pivot {
namespace {

void put(const Vec3f& v, float* out) { out[0] = v.x, out[1] = v.y, out[2] = v.z; }

void write_combined(const Pixel& pixel, float* out) {
    put(pixel.sum.radiance * pixel.per_sample(), out);
    out[3] = pixel.sum.alpha * pixel.per_sample();
}

/// A sum of three channels as its mean.
template <Vec3f Sample::*sum>
void write_mean(const Pixel& pixel, float* out) {
    put(pixel.sum.*sum * pixel.per_sample(), out);
}

/// The error predicted of an analytic pixel, relative to its radiance, or to least_radiance where it is darker: that of
/// the closed forms, and that of evenly spread samples whose values differ, by shadows and edges in the pixel.
float predicted_error(const Pixel& pixel) {
    constexpr float deviations = 2.0f;  // 19 pixels in 20 are within them
    constexpr float least_radiance = 1e-3f;
    if (pixel.count == 0) return 0.0f;
    const auto n = static_cast<float>(pixel.count);
    const float sum = mean_component(pixel.sum.radiance);
    // One sample knows of its own rays only.
    const float spread = n > 1.0f ? std::max(pixel.sum_of_squares - sum * sum / n, 0.0f) / (n - 1.0f) : 0.0f;
    const float variance = std::max(spread, pixel.sum.shadow_variance / n);
    const float error = pixel.sum.error / n + deviations * std::sqrt(variance) * std::pow(n, -0.75f);
    return error / std::max(std::abs(sum / n), least_radiance);
}

constexpr Pass passes[] = {
    {"Combined", 4, write_combined},
    {"Depth", 1, [](const Pixel& pixel, float* out) { *out = pixel.center.depth_m; }},
    {"Normal", 3, write_mean<&Sample::normal>},
    {"Position", 3, [](const Pixel& pixel, float* out) { put(pixel.center.position, out); }},
    {"DiffCol", 3, write_mean<&Sample::albedo>},
    {"Emit", 3, write_mean<&Sample::emission>},
    {"VolumeDir", 3, write_mean<&Sample::volume_direct>},
    {"VolumeInd", 3, write_mean<&Sample::volume_indirect>},
    {"Method", 3, write_mean<&Sample::method>},
    {"Error", 1, [](const Pixel& pixel, float* out) { *out = predicted_error(pixel); }},
};

}  // namespace

const Pass& find_pass(std::string_view name) {
    std::string known;
    for (const Pass& pass : passes) {
        if (pass.name == name) return pass;
        known += (known.empty() ? "" : ", ") + std::string(pass.name);
    }
    throw std::invalid_argument("there is no pass '" + std::string(name) + "'; choose one of " + known);
}

Film::Film(int width, int height)
    : width_(width), height_(height), pixels_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {}

void Film::load(const Tile& tile, std::vector<Pixel>& pixels) const {
    pixels.clear();
    for (int y = tile.y0; y < tile.y1; ++y) {
        pixels.insert(pixels.end(), row(tile.x0, y), row(tile.x0, y) + (tile.x1 - tile.x0));
    }
}

void Film::store(const Tile& tile, const std::vector<Pixel>& pixels) {
    const std::shared_lock lock(mutex_);
    const auto width = static_cast<std::ptrdiff_t>(tile.x1 - tile.x0);
    for (int y = tile.y0; y < tile.y1; ++y) {
        const auto begin = pixels.begin() + (y - tile.y0) * width;
        std::copy(begin, begin + width, row(tile.x0, y));
    }
}

std::vector<float> Film::read(const Pass& pass) const {
    const auto stride = static_cast<std::size_t>(pass.channels);
    std::vector<float> values(pixels_.size() * stride);
    const std::unique_lock lock(mutex_);
    for (std::size_t i = 0; i < pixels_.size(); ++i) pass.write(pixels_[i], &values[i * stride]);
    return values;
}

}  // namespace pivot
