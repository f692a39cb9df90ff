// What a render accumulates, per pixel of the window. Sums are kept with their weights, so a film can be read while it
// grows; writers add whole tiles, readers see no half of one.
#pragma once

#include <algorithm>
#include <mutex>
#include <shared_mutex>
#include <span>
#include <vector>

#include "core/film/mattes.h"
#include "core/film/passes.h"
#include "core/film/pixel.h"

namespace pivot {

/// A grid of pixels, row by row.
struct PixelGrid {
    int width, height;

    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
    }
    std::size_t size() const { return index(0, height); }
};

struct Tile {
    int x0, y0, x1, y1;
};

class Film {
   public:
    Film(int width, int height, const FilmParts& parts);

    const PixelGrid& grid() const { return grid_; }
    int width() const { return grid_.width; }
    int height() const { return grid_.height; }

    /// A copy of a tile's pixels, row by row, for a worker to add samples to.
    void load(const Tile& tile, std::vector<Pixel>& pixels) const;
    void store(const Tile& tile, const std::vector<Pixel>& pixels);

    bool keeps_own_sums() const { return !own_sums_.empty(); }
    /// Adds own sums of the pixels of a row from x on. Writers of one pixel must take turns.
    void add_own(int x, int y, std::span<const OwnSum> sums);

    bool keeps_surface_passes() const { return !surfaces_.empty(); }
    /// As load() and store() of what passes tell of surfaces.
    void load_surfaces(const Tile& tile, std::vector<SurfacePixel>& pixels) const;
    void store_surfaces(const Tile& tile, const std::vector<SurfacePixel>& pixels);

    bool keeps_mattes() const { return !mattes_.empty(); }
    void load_mattes(const Tile& tile, std::vector<Mattes>& pixels) const;
    void store_mattes(const Tile& tile, const std::vector<Mattes>& pixels);

    std::size_t named_passes() const { return named_.size() / std::max(grid_.size(), std::size_t{1}); }
    /// As load() and store() of named passes: of each pixel all.
    void load_named(const Tile& tile, std::vector<Rgb>& sums) const;
    void store_named(const Tile& tile, const std::vector<Rgb>& sums);

    /// Makes each pixel a mean of its own and the other film's, which weigh as much as is told, both row by row.
    void merge(const Film& other, std::span<const float> own_weights, std::span<const float> other_weights);

    /// The mean squared error of one of two films that were made alike, relative to the pixels' radiance.
    /// denoised_part: so much less counts what light that bounced differs by.
    float squared_error_beside(const Film& other, float denoised_part) const;
    /// Adds the other's samples.
    void add(const Film& other);

    /// A pass as height x width x channels, bottom row first. Throws std::invalid_argument where what it needs is not
    /// kept.
    std::vector<float> read(const Pass& pass) const;
    /// Two ranks of ids from this one on, as height x width x (id, weight, id, weight). Throws likewise.
    std::vector<float> read_mattes(MatteKind kind, std::size_t rank) const;
    /// One of the named passes, as height x width x 3. Throws likewise.
    std::vector<float> read_named(std::size_t which) const;

   private:
    PixelGrid grid_;
    std::vector<Pixel> pixels_;
    std::vector<OwnSum> own_sums_;        ///< of each pixel, or empty
    std::vector<Mattes> mattes_;          ///< likewise
    std::vector<SurfacePixel> surfaces_;  ///< likewise
    std::vector<Rgb> named_;              ///< sums of named passes, of each pixel all
    mutable std::shared_mutex mutex_;     ///< shared by writers, whose tiles are disjoint; owned by a reader
};

}  // namespace pivot
