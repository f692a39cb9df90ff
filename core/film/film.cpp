#include "core/film/film.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/simd/batch.h"

namespace pivot {
namespace {

/// Sums of structs of floats, number by number.
template <class Numbers>
void add_weighted(std::span<const Numbers> samples, std::span<const float> weights, float scale, Numbers& sum) {
    constexpr std::size_t numbers = sizeof(Numbers) / sizeof(float);
    constexpr std::size_t together = numbers / batch_size * batch_size;
    for (std::size_t first = 0; first < together; first += batch_size) {
        Batch added(0.0f);
        for (std::size_t i = 0; i < samples.size(); ++i)
            added += Batch(weights[i]) * Batch::load_unaligned(reinterpret_cast<const float*>(&samples[i]) + first);
        float* const to = reinterpret_cast<float*>(&sum) + first;
        (Batch::load_unaligned(to) + Batch(scale) * added).store_unaligned(to);
    }
    for (std::size_t at = together; at < numbers; ++at) {
        float added = 0.0f;
        for (std::size_t i = 0; i < samples.size(); ++i)
            added += weights[i] * reinterpret_cast<const float*>(&samples[i])[at];
        reinterpret_cast<float*>(&sum)[at] += scale * added;
    }
}

void put(const Vec3f& v, float* out) { out[0] = v.x, out[1] = v.y, out[2] = v.z; }

void write_combined(const Pixel& pixel, const OwnSum&, const SurfacePixel&, float* out) {
    put(pixel.samples.sum.radiance * pixel.samples.per_weight(), out);
    out[3] = pixel.samples.sum.alpha * pixel.samples.per_weight();
}

/// A sum of three channels as its mean.
template <Vec3f Sample::*sum>
void write_mean(const Pixel& pixel, const OwnSum&, const SurfacePixel&, float* out) {
    put(pixel.samples.sum.*sum * pixel.samples.per_weight(), out);
}

template <Vec3f OwnSum::*sum>
void write_own(const Pixel&, const OwnSum& own, const SurfacePixel&, float* out) {
    put(own.*sum * own.per_weight(), out);
}

void write_noisy(const Pixel& pixel, const OwnSum& own, const SurfacePixel&, float* out) {
    put(own.radiance * own.per_weight(), out);
    out[3] = pixel.samples.sum.alpha * pixel.samples.per_weight();
}

/// A sum over surfaces as its mean.
template <Vec3f SurfacePasses::*sum>
void write_surfaces(const Pixel& pixel, const OwnSum&, const SurfacePixel& surfaces, float* out) {
    put(surfaces.sum.*sum * pixel.samples.per_weight(), out);
}

/// Light over the colour that reflected it, which it is to be multiplied by again; 0 where that has none.
template <Vec3f SurfacePasses::*light, Vec3f SurfacePasses::*color>
void write_uncolored(const Pixel&, const OwnSum&, const SurfacePixel& surfaces, float* out) {
    const Vec3f &l = surfaces.sum.*light, &c = surfaces.sum.*color;
    for (int i = 0; i < 3; ++i) out[i] = c[i] != 0.0f ? l[i] / c[i] : 0.0f;
}

void write_mist(const Pixel& pixel, const OwnSum&, const SurfacePixel& surfaces, float* out) {
    *out = std::clamp(1.0f - surfaces.sum.nearness * pixel.samples.per_weight(), 0.0f, 1.0f);
}

/// Where it was, less where it is, and that less where it will be, of the surfaces alone. [Cycles 4.5
/// kernel/geom/primitive.h, primitive_motion_vector]
void write_vector(const Pixel&, const OwnSum&, const SurfacePixel& surfaces, float* out) {
    const SurfacePasses& sum = surfaces.sum;
    const float per_weight = sum.moving_weight > 0.0f ? 1.0f / sum.moving_weight : 0.0f;
    const Vec2f before = -per_weight * sum.from_before, after = -per_weight * sum.to_after;
    out[0] = before.x, out[1] = before.y, out[2] = after.x, out[3] = after.y;
}

void write_depth(const Pixel& pixel, const OwnSum&, const SurfacePixel&, float* out) { *out = pixel.center.depth_m; }

/// The error predicted of an analytic pixel, relative to its radiance, or to least_radiance where it is darker: that of
/// the closed forms, and that of evenly spread samples whose values differ, by shadows and edges in the pixel.
float predicted_error(const Pixel& pixel) {
    constexpr float edges = 0.77f;      // of how samples in a square differ; the rest varies smoothly and costs little
    constexpr float deviations = 2.0f;  // 19 pixels in 20 are within them
    constexpr float least_radiance = 1e-3f;
    const WeightedSum& samples = pixel.samples;
    if (!(samples.weight > 0.0f)) return 0.0f;
    const float n = samples.weight, mean = mean_component(samples.sum.radiance) / n;
    // One sample knows of its own rays only.
    const float spread = samples.told_weight > 0.0f ? edges * samples.variance / samples.told_weight : 0.0f;
    const float variance = std::max(spread, samples.sum.shadow_variance / n) * samples.squared_weight / n;
    const float error = samples.sum.error / n + deviations * std::sqrt(variance) * std::pow(n, -0.75f);
    return error / std::max(std::abs(mean), least_radiance);
}

/// How far noise takes a pixel's light from its mean, squared: that of a sample over how many the pixel is of, as its
/// filter weighs them. 0 where no two samples came together.
template <float OwnSum::*variance>
void write_variance(const Pixel& pixel, const OwnSum& own, const SurfacePixel&, float* out) {
    const float of_sample = own.told_weight > 0.0f ? own.*variance / own.told_weight : 0.0f;
    *out = of_sample * pixel.samples.squared_weight * sqr(pixel.samples.per_weight());
}

constexpr FilmParts own_sums{.own_sums = true}, surface_passes{.surface_passes = true};
using S = SurfacePasses;

constexpr Pass passes[] = {
    {"Combined", 4, write_combined},
    {"Depth", 1, write_depth},
    {"Normal", 3, write_mean<&Sample::normal>},
    {"Position", 3,
     [](const Pixel& pixel, const OwnSum&, const SurfacePixel&, float* out) { put(pixel.center.position, out); }},
    {"DiffCol", 3, write_mean<&Sample::albedo>},
    {"Emit", 3, write_mean<&Sample::emission>},
    {"VolumeDir", 3, write_mean<&Sample::volume_direct>},
    {"VolumeInd", 3, write_mean<&Sample::volume_indirect>},
    {"Indirect", 3, write_mean<&Sample::indirect>},
    {"Method", 3, write_mean<&Sample::method>},
    {"Error", 1,
     [](const Pixel& pixel, const OwnSum&, const SurfacePixel&, float* out) { *out = predicted_error(pixel); }},
    {"Noisy Image", 4, write_noisy, own_sums},
    {"Noisy Indirect", 3, write_own<&OwnSum::indirect>, own_sums},
    {"Direct Variance", 1, write_variance<&OwnSum::direct_variance>, own_sums},
    {"Indirect Variance", 1, write_variance<&OwnSum::indirect_variance>, own_sums},
    {"Denoising Albedo", 3, write_own<&OwnSum::albedo>, own_sums},
    {"Denoising Normal", 3, write_own<&OwnSum::normal>, own_sums},
    {"DiffDir", 3, write_uncolored<&S::diffuse_direct, &S::diffuse_color>, surface_passes},
    {"DiffInd", 3, write_uncolored<&S::diffuse_indirect, &S::diffuse_color>, surface_passes},
    {"Diffuse Color", 3, write_surfaces<&S::diffuse_color>, surface_passes},
    {"GlossDir", 3, write_uncolored<&S::glossy_direct, &S::glossy_color>, surface_passes},
    {"GlossInd", 3, write_uncolored<&S::glossy_indirect, &S::glossy_color>, surface_passes},
    {"GlossCol", 3, write_surfaces<&S::glossy_color>, surface_passes},
    {"TransDir", 3, write_uncolored<&S::transmission_direct, &S::transmission_color>, surface_passes},
    {"TransInd", 3, write_uncolored<&S::transmission_indirect, &S::transmission_color>, surface_passes},
    {"TransCol", 3, write_surfaces<&S::transmission_color>, surface_passes},
    {"Env", 3, write_surfaces<&S::environment>, surface_passes},
    {"AO", 3, write_surfaces<&S::ambient_occlusion>, surface_passes},
    {"UV", 3, write_surfaces<&S::uv>, surface_passes},
    {"Mist", 1, write_mist, surface_passes},
    {"Vector", 4, write_vector, surface_passes},
    {"IndexOB", 1,
     [](const Pixel&, const OwnSum&, const SurfacePixel& surfaces, float* out) { *out = surfaces.object_index; },
     surface_passes},
    {"IndexMA", 1,
     [](const Pixel&, const OwnSum&, const SurfacePixel& surfaces, float* out) { *out = surfaces.material_index; },
     surface_passes},
};

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

void WeightedSum::add(std::span<const Sample> samples, std::span<const float> weights,
                      std::optional<float> radiance_variance, float scale) {
    add_weighted(samples, weights, scale, sum);
    float added = 0.0f, squared = 0.0f;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        added += weights[i];
        squared += weights[i] * weights[i];
    }
    weight += scale * added;
    squared_weight += sqr(scale) * squared;
    if (!radiance_variance) return;
    told_weight += sqr(scale) * squared;
    variance += sqr(scale) * squared * *radiance_variance;
}

void WeightedSum::add(const WeightedSum& other, float scale) {
    constexpr float once = 1.0f;
    add_weighted<Sample>({&other.sum, 1}, {&once, 1}, scale, sum);
    weight += scale * other.weight;
    squared_weight += sqr(scale) * other.squared_weight;
    told_weight += sqr(scale) * other.told_weight;
    variance += sqr(scale) * other.variance;
}

void SurfacePixel::add(std::span<const SurfacePasses> samples, std::span<const float> weights, float scale) {
    add_weighted(samples, weights, scale, sum);
}

void SurfacePixel::add(const SurfacePixel& other, float scale) {
    constexpr float once = 1.0f;
    add_weighted<SurfacePasses>({&other.sum, 1}, {&once, 1}, scale, sum);
}

void add_named(std::span<const Rgb> samples, std::span<const float> weights, float scale, std::span<Rgb> sums) {
    for (std::size_t i = 0; i * sums.size() < samples.size(); ++i)
        for (std::size_t k = 0; k < sums.size(); ++k) sums[k] += scale * weights[i] * samples[i * sums.size() + k];
}

void OwnSum::add(std::span<const Sample> samples, float scale) {
    for (const Sample& sample : samples) {
        radiance += scale * sample.radiance;
        indirect += scale * sample.indirect;
        albedo += scale * sample.denoising_albedo;
        normal += scale * sample.denoising_normal;
        weight += scale;
    }
    const std::size_t half = samples.size() / 2;
    if (half < 1) return;
    // By their two halves. Evenly spread samples of direct light leave less than halves of them tell: 0.36 to 0.6 of
    // it, as measured, where light that bounced has all of it.
    constexpr float even = 0.5f;
    Rgb direct_apart(0.0f), indirect_apart(0.0f);
    for (std::size_t i = 0; i < 2 * half; ++i) {
        const float sign = i < half ? 1.0f : -1.0f;
        direct_apart += sign * (samples[i].radiance - samples[i].indirect);
        indirect_apart += sign * samples[i].indirect;
    }
    const auto variance = [&](const Rgb& apart) {
        return mean_component(apart * apart) / static_cast<float>(2 * half);
    };
    const float told = sqr(scale) * static_cast<float>(samples.size());
    told_weight += told;
    direct_variance += even * told * variance(direct_apart);
    indirect_variance += told * variance(indirect_apart);
}

void OwnSum::add(const OwnSum& other, float scale) {
    radiance += scale * other.radiance;
    indirect += scale * other.indirect;
    albedo += scale * other.albedo;
    normal += scale * other.normal;
    weight += scale * other.weight;
    told_weight += sqr(scale) * other.told_weight;
    direct_variance += sqr(scale) * other.direct_variance;
    indirect_variance += sqr(scale) * other.indirect_variance;
}

const Pass& find_pass(std::string_view name) {
    std::string known;
    for (const Pass& pass : passes) {
        if (pass.name == name) return pass;
        known += (known.empty() ? "" : ", ") + std::string(pass.name);
    }
    throw std::invalid_argument("there is no pass '" + std::string(name) + "'; choose one of " + known);
}

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
    for (std::size_t i = 0; i < pixels_.size(); ++i)
        put(named_[i * named_passes() + which] * pixels_[i].samples.per_weight(), &values[3 * i]);
    return values;
}

}  // namespace pivot
