#include "core/film/film.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace pivot {
namespace {

/// Copies a tile's pixels from or to a grid of all, as many items of each.
template <class Item>
void load_tile(const PixelGrid& grid, const std::vector<Item>& all, const Tile& tile, std::vector<Item>& items,
               std::size_t of_each = 1) {
    items.clear();
    for (int y = tile.y0; y < tile.y1; ++y) {
        const auto first = all.begin() + static_cast<std::ptrdiff_t>(grid.index(tile.x0, y) * of_each);
        items.insert(items.end(), first, first + static_cast<std::ptrdiff_t>(of_each) * (tile.x1 - tile.x0));
    }
}
template <class Item>
void store_tile(const PixelGrid& grid, std::vector<Item>& all, const Tile& tile, const std::vector<Item>& items,
                std::size_t of_each = 1) {
    auto from = items.begin();
    for (int y = tile.y0; y < tile.y1; ++y) {
        const auto end = from + static_cast<std::ptrdiff_t>(of_each) * (tile.x1 - tile.x0);
        std::copy(from, end, all.begin() + static_cast<std::ptrdiff_t>(grid.index(tile.x0, y) * of_each));
        from = end;
    }
}

}  // namespace

Film::Film(int width, int height, const FilmParts& parts)
    : grid_{width, height},
      pixels_(grid_.size()),
      own_sums_(parts.own_sums ? grid_.size() : 0),
      mattes_(parts.mattes ? grid_.size() : 0),
      surfaces_(parts.surface_passes ? grid_.size() : 0),
      named_(parts.named_passes * grid_.size(), Rgb(0.0f)) {}

void Film::load(const Tile& tile, std::vector<Pixel>& pixels) const { load_tile(grid_, pixels_, tile, pixels); }

void Film::store(const Tile& tile, const std::vector<Pixel>& pixels) {
    const std::shared_lock lock(mutex_);
    store_tile(grid_, pixels_, tile, pixels);
}

void Film::load_surfaces(const Tile& tile, std::vector<SurfacePixel>& pixels) const {
    load_tile(grid_, surfaces_, tile, pixels);
}

void Film::store_surfaces(const Tile& tile, const std::vector<SurfacePixel>& pixels) {
    const std::shared_lock lock(mutex_);
    store_tile(grid_, surfaces_, tile, pixels);
}

void Film::load_mattes(const Tile& tile, std::vector<Mattes>& pixels) const { load_tile(grid_, mattes_, tile, pixels); }

void Film::store_mattes(const Tile& tile, const std::vector<Mattes>& pixels) {
    const std::shared_lock lock(mutex_);
    store_tile(grid_, mattes_, tile, pixels);
}

void Film::load_named(const Tile& tile, std::vector<Rgb>& sums) const {
    load_tile(grid_, named_, tile, sums, named_passes());
}

void Film::store_named(const Tile& tile, const std::vector<Rgb>& sums) {
    const std::shared_lock lock(mutex_);
    store_tile(grid_, named_, tile, sums, named_passes());
}

void Film::add_own(int x, int y, std::span<const OwnSum> sums) {
    const std::shared_lock lock(mutex_);
    OwnSum* own = &own_sums_[grid_.index(x, y)];
    for (const OwnSum& sum : sums) (own++)->add(sum, 1.0f);
}

void Film::merge(const Film& other, std::span<const float> own_weights, std::span<const float> other_weights) {
    const std::unique_lock lock(mutex_);
    for (std::size_t i = 0; i < pixels_.size(); ++i) {
        if (keeps_mattes()) {
            Mattes merged;
            merged.add(mattes_[i], own_weights[i] * pixels_[i].samples.per_weight());
            merged.add(other.mattes_[i], other_weights[i] * other.pixels_[i].samples.per_weight());
            mattes_[i] = std::move(merged);
        }
        if (keeps_surface_passes()) {
            SurfacePixel merged = surfaces_[i];  // with what its centre meets
            merged.sum = {};
            merged.add(surfaces_[i], own_weights[i] * pixels_[i].samples.per_weight());
            merged.add(other.surfaces_[i], other_weights[i] * other.pixels_[i].samples.per_weight());
            surfaces_[i] = merged;
        }
        for (std::size_t k = i * named_passes(); k < (i + 1) * named_passes(); ++k)
            named_[k] = own_weights[i] * pixels_[i].samples.per_weight() * named_[k] +
                        other_weights[i] * other.pixels_[i].samples.per_weight() * other.named_[k];
        WeightedSum merged;
        for (const auto& [samples, weight] :
             {std::pair(pixels_[i].samples, own_weights[i]), std::pair(other.pixels_[i].samples, other_weights[i])})
            merged.add(samples, weight * samples.per_weight());
        pixels_[i].samples = merged;
        if (!keeps_own_sums()) continue;
        OwnSum own;
        for (const auto& [sum, weight] :
             {std::pair(own_sums_[i], own_weights[i]), std::pair(other.own_sums_[i], other_weights[i])})
            own.add(sum, weight * sum.per_weight());
        own_sums_[i] = own;
    }
}

float Film::squared_error_beside(const Film& other, float denoised_part) const {
    const auto mean_of = [](const Pixel& pixel, const Rgb& sum) {
        return mean_component(sum) * pixel.samples.per_weight();
    };
    double sum = 0.0;
    for (std::size_t i = 0; i < pixels_.size(); ++i) {
        const Sample &own = pixels_[i].samples.sum, &others = other.pixels_[i].samples.sum;
        const auto difference = [&](const Rgb& of_own, const Rgb& of_other) {
            return mean_of(pixels_[i], of_own) - mean_of(other.pixels_[i], of_other);
        };
        const float radiance = mean_of(pixels_[i], own.radiance) + mean_of(other.pixels_[i], others.radiance);
        const float scale = std::max(0.5f * std::abs(radiance), least_radiance_of_error);
        const float counted =
            difference(own.radiance, others.radiance) - denoised_part * difference(own.indirect, others.indirect);
        sum += static_cast<double>(0.5f * sqr(counted / scale));
    }
    return static_cast<float>(sum / static_cast<double>(pixels_.size()));
}

void Film::add(const Film& other) {
    const std::unique_lock lock(mutex_);
    for (std::size_t i = 0; i < pixels_.size(); ++i) pixels_[i].samples.add(other.pixels_[i].samples, 1.0f);
    for (std::size_t i = 0; i < own_sums_.size(); ++i) own_sums_[i].add(other.own_sums_[i], 1.0f);
    for (std::size_t i = 0; i < surfaces_.size(); ++i) surfaces_[i].add(other.surfaces_[i], 1.0f);
    for (std::size_t i = 0; i < mattes_.size(); ++i) mattes_[i].add(other.mattes_[i], 1.0f);
    for (std::size_t i = 0; i < named_.size(); ++i) named_[i] += other.named_[i];
}

std::vector<float> Film::read(const Pass& pass) const {
    const auto stride = static_cast<std::size_t>(pass.channels);
    std::vector<float> values(pixels_.size() * stride);
    const auto refuse = [&](const std::string& why) {
        throw std::invalid_argument("the pass '" + std::string(pass.name) + "' is " + why);
    };
    if (pass.needs.own_sums && !keeps_own_sums()) refuse("for a denoiser: render with denoising_passes");
    if (pass.needs.surface_passes && !keeps_surface_passes()) refuse("of surfaces: render with surface_passes");
    const OwnSum no_own;
    const SurfacePixel no_surfaces;
    const std::unique_lock lock(mutex_);
    for (std::size_t i = 0; i < pixels_.size(); ++i)
        pass.write(pixels_[i], keeps_own_sums() ? own_sums_[i] : no_own,
                   keeps_surface_passes() ? surfaces_[i] : no_surfaces, &values[i * stride]);
    return values;
}

std::vector<float> Film::read_mattes(MatteKind kind, std::size_t rank) const {
    if (!keeps_mattes()) throw std::invalid_argument("there are no mattes: render with mattes");
    std::vector<float> values(4 * pixels_.size());
    const std::unique_lock lock(mutex_);
    for (std::size_t i = 0; i < pixels_.size(); ++i)
        mattes_[i].write(kind, rank, pixels_[i].samples.per_weight(), &values[4 * i]);
    return values;
}

std::vector<float> Film::read_named(std::size_t which) const {
    if (which >= named_passes())
        throw std::invalid_argument("there is no named pass " + std::to_string(which) +
                                    ": render with as many light_groups and aovs");
    std::vector<float> values(3 * pixels_.size());
    const std::unique_lock lock(mutex_);
    for (std::size_t i = 0; i < pixels_.size(); ++i) {
        const Rgb mean = named_[i * named_passes() + which] * pixels_[i].samples.per_weight();
        for (int channel = 0; channel < 3; ++channel) values[3 * i + static_cast<std::size_t>(channel)] = mean[channel];
    }
    return values;
}

}  // namespace pivot
