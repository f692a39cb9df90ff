// What a render accumulates, per pixel of the window. Sums are kept with their counts, so a film can be read while it
// grows; writers add whole tiles, readers see no half of one.
#pragma once

#include <mutex>
#include <shared_mutex>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/math/vector.h"

namespace pivot {

/// One camera sample, averaged over samples.
struct Sample {
    Rgb radiance{0.0f};
    float alpha = 1.0f;
    Vec3f normal{0.0f};            ///< world space, at the first hit
    Rgb albedo{0.0f};              ///< of the diffuse lobe at the first hit
    Rgb emission{0.0f};            ///< of the first hit itself
    Rgb volume_direct{0.0f};       ///< what media scatter to the camera of light that comes to them straight
    Rgb volume_indirect{0.0f};     ///< and of other light
    Rgb method{0.0f};              ///< analytic: colour of the methods that shaded the first hit
    float error = 0.0f;            ///< analytic: predicted for what is in closed form, as radiance
    float shadow_variance = 0.0f;  ///< analytic: of what this sample's rays say of shadows, radiance squared
};

/// What the ray through the pixel's centre meets; never averaged.
struct CenterSample {
    float depth_m = 1e10f;  ///< along the camera's axis; 1e10 where there is nothing, as Cycles writes it
    Vec3f position{0.0f};
};

struct Pixel {
    Sample sum{.alpha = 0.0f};
    CenterSample center;
    float sum_of_squares = 0.0f;  ///< analytic: of the samples' mean radiance over colours
    std::uint32_t count = 0;

    /// What a sum is multiplied by for its mean; 0 without samples.
    float per_sample() const { return count > 0 ? 1.0f / static_cast<float>(count) : 0.0f; }
};

struct Tile {
    int x0, y0, x1, y1;
};

/// A pass by Blender's name, its channels, and how a pixel writes them.
struct Pass {
    std::string_view name;
    int channels;
    void (*write)(const Pixel& pixel, float* out);
};

/// Throws std::invalid_argument, which lists the passes there are.
const Pass& find_pass(std::string_view name);

class Film {
   public:
    Film(int width, int height);

    int width() const { return width_; }
    int height() const { return height_; }

    /// A copy of a tile's pixels, row by row, for a worker to add samples to.
    void load(const Tile& tile, std::vector<Pixel>& pixels) const;
    void store(const Tile& tile, const std::vector<Pixel>& pixels);

    /// A pass as height x width x channels, bottom row first.
    std::vector<float> read(const Pass& pass) const;

   private:
    Pixel* row(int x, int y) {
        return &pixels_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)];
    }
    const Pixel* row(int x, int y) const { return const_cast<Film*>(this)->row(x, y); }

    int width_, height_;
    std::vector<Pixel> pixels_;
    mutable std::shared_mutex mutex_;  ///< shared by writers, whose tiles are disjoint; owned by a reader
};

}  // namespace pivot
