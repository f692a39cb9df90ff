#include "core/film/film.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace pivot {
namespace {

void write(const Pixel& pixel, std::string_view pass, float* out) {
    const float scale = pixel.count > 0 ? 1.0f / static_cast<float>(pixel.count) : 0.0f;
    const auto put = [&](const Vec3f& v) { out[0] = v.x, out[1] = v.y, out[2] = v.z; };
    if (pass == "Combined") {
        put(pixel.sum.radiance * scale);
        out[3] = pixel.sum.alpha * scale;
    } else if (pass == "Depth") {
        out[0] = pixel.center.depth_m;
    } else if (pass == "Normal") {
        put(pixel.sum.normal * scale);
    } else if (pass == "Position") {
        put(pixel.center.position);
    } else if (pass == "DiffCol") {
        put(pixel.sum.albedo * scale);
    } else if (pass == "Emit") {
        put(pixel.sum.emission * scale);
    } else if (pass == "Method") {
        put(pixel.sum.method * scale);
    } else {
        out[0] = predicted_error(pixel);
    }
}

}  // namespace

float predicted_error(const Pixel& pixel) {
    if (pixel.count == 0) return 0.0f;
    const auto n = static_cast<float>(pixel.count);
    const float sum = mean_component(pixel.sum.radiance);
    constexpr float deviations = 2.0f;  // 19 pixels in 20 are within them
    // One sample knows of its own rays only.
    const float spread = n > 1.0f ? std::max(pixel.sum_of_squares - sum * sum / n, 0.0f) / (n - 1.0f) : 0.0f;
    const float variance = std::max(spread, pixel.sum.shadow_variance / n);
    const float error = pixel.sum.error / n + deviations * std::sqrt(variance) * std::pow(n, -0.75f);
    return error / std::max(std::abs(sum / n), least_radiance);
}

Film::Film(int width, int height)
    : width_(width), height_(height), pixels_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {}

int Film::channels(std::string_view pass) {
    for (const PassInfo& info : passes) {
        if (info.name == pass) return info.channels;
    }
    std::string known;
    for (const PassInfo& info : passes) known += (known.empty() ? "" : ", ") + std::string(info.name);
    throw std::invalid_argument("there is no pass '" + std::string(pass) + "'; choose one of " + known);
}

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

std::vector<float> Film::read(std::string_view pass) const {
    const auto stride = static_cast<std::size_t>(channels(pass));
    std::vector<float> values(pixels_.size() * stride);
    const std::unique_lock lock(mutex_);
    for (std::size_t i = 0; i < pixels_.size(); ++i) write(pixels_[i], pass, &values[i * stride]);
    return values;
}

}  // namespace pivot
