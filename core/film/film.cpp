#include "core/film/film.h"

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

constexpr Pass passes[] = {
    {"Combined", 4, write_combined},
    {"Depth", 1, [](const Pixel& pixel, float* out) { *out = pixel.center.depth_m; }},
    {"Normal", 3, write_mean<&Sample::normal>},
    {"Position", 3, [](const Pixel& pixel, float* out) { put(pixel.center.position, out); }},
    {"DiffCol", 3, write_mean<&Sample::albedo>},
    {"Emit", 3, write_mean<&Sample::emission>},
    {"Method", 3, write_mean<&Sample::method>},
    {"Error", 1, [](const Pixel& pixel, float* out) { *out = pixel.sum.predicted_error * pixel.per_sample(); }},
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
