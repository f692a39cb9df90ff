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
    float sum_of_squares = 0.0f;  ///< of the samples' mean radiance over colours
    std::uint32_t count = 0;
};

/// The error predicted of an analytic pixel, relative to its radiance, or to least_radiance where it is darker: that of
/// the closed forms, and that of evenly spread samples whose values differ, by shadows and edges in the pixel.
float predicted_error(const Pixel& pixel);

inline constexpr float least_radiance = 1e-3f;

struct Tile {
    int x0, y0, x1, y1;
};

/// A pass by Blender's name, with its channels.
struct PassInfo {
    std::string_view name;
    int channels;
};

inline constexpr PassInfo passes[] = {{"Combined", 4}, {"Depth", 1}, {"Normal", 3}, {"Position", 3},
                                      {"DiffCol", 3},  {"Emit", 3},  {"Method", 3}, {"Error", 1}};

class Film {
   public:
    Film(int width, int height);

    int width() const { return width_; }
    int height() const { return height_; }

    /// A copy of a tile's pixels, row by row, for a worker to add samples to.
    void load(const Tile& tile, std::vector<Pixel>& pixels) const;
    void store(const Tile& tile, const std::vector<Pixel>& pixels);

    /// A pass as width x height x channels, bottom row first. Throws std::invalid_argument for an unknown name.
    std::vector<float> read(std::string_view pass) const;
    static int channels(std::string_view pass);

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
