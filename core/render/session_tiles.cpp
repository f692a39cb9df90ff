// How a session renders samples: passes over tiles, whose rows go to the integrators.
#include <tbb/parallel_for_each.h>

#include <bit>
#include <numeric>

#include "core/integrators/analytic.h"
#include "core/integrators/catcher_light.h"
#include "core/integrators/monte_carlo.h"
#include "core/integrators/seen_surfaces.h"
#include "core/render/session.h"

namespace pivot {
namespace {

constexpr int least_tile_size = 32;
/// Passes grow from one sample, so that the first picture is early, to this many, so that tiles are worth their
/// overhead.
constexpr std::uint32_t max_samples_per_pass = 8, max_samples_per_sparse_pass = 64;
constexpr std::size_t max_bad_samples = 8;
constexpr std::uint32_t places_when_adaptive = 16;
constexpr std::uint32_t place_seed = 0x70697831;  // of where samples lie in their pixels
// Dimensions of samplers that the integrators leave.
constexpr std::uint32_t lens_dimension = 0, time_dimension = 1u << 30;

/// The squares from which samples reach a window's pixels, in tiles. Tiles of one colour, four in all, are a tile
/// apart, and as wide as two reaches: their samples reach different pixels.
std::array<std::vector<Tile>, 4> make_tiles(const Window& window, int reach_px) {
    std::array<std::vector<Tile>, 4> tiles;
    const int tile_size = std::max(least_tile_size, 2 * reach_px);
    const Tile all{-reach_px, -reach_px, window.width() + reach_px, window.height() + reach_px};
    // By place in the frame, so that a window's pixels get what those of the whole get, in the same order.
    const auto before = [&](int frame) { return frame - ((frame % tile_size) + tile_size) % tile_size; };
    const int x_first = before(window.x0 + all.x0), y_first = before(window.y0 + all.y0);
    for (int y = y_first; y < window.y0 + all.y1; y += tile_size) {
        for (int x = x_first; x < window.x0 + all.x1; x += tile_size) {
            const auto colour = static_cast<std::size_t>(((x / tile_size) & 1) + 2 * ((y / tile_size) & 1));
            tiles[colour].push_back({std::max(x - window.x0, all.x0), std::max(y - window.y0, all.y0),
                                     std::min(x - window.x0 + tile_size, all.x1),
                                     std::min(y - window.y0 + tile_size, all.y1)});
        }
    }
    return tiles;
}

/// Variance of a sample as means over n of them have it, times n^(3/2): that is how fast the error of evenly spread
/// samples falls at edges. By pairs where there are two, as what varies smoothly is nearly the same in all. Nothing of
/// a single sample.
std::optional<float> radiance_variance(std::span<const Sample> samples) {
    const std::size_t together = samples.size() >= 4 ? 2 : 1, count = samples.size() / together;
    if (count < 2) return std::nullopt;
    const auto radiance_of = [&](std::size_t i) {
        Rgb sum(0.0f);
        for (std::size_t k = 0; k < together; ++k) sum += samples[i * together + k].radiance;
        return mean_component(sum) / static_cast<float>(together);
    };
    float mean = 0.0f, squares = 0.0f;
    for (std::size_t i = 0; i < count; ++i) mean += radiance_of(i) / static_cast<float>(count);
    for (std::size_t i = 0; i < count; ++i) squares += sqr(radiance_of(i) - mean);
    return squares / static_cast<float>(count - 1) * std::pow(static_cast<float>(together), 1.5f);
}

bool is_finite(const Sample& s) {
    const Vec3f sum = s.radiance + s.indirect + s.denoising_albedo + s.denoising_normal + s.normal + s.albedo +
                      s.emission + s.method + s.volume_direct + s.volume_indirect;
    return std::isfinite(sum.x + sum.y + sum.z + s.alpha + s.error + s.shadow_variance);
}

}  // namespace

/// Successive samples, where they lie in each pixel, and what they weigh for each of those around it, row by row.
struct Session::SamplePass {
    struct Places {
        std::vector<Vec2f> offsets;
        std::vector<std::vector<float>> weights;
    };

    std::uint32_t first_sample, last_sample;
    std::uint32_t log2_samples;  ///< of all passes together, at least
    std::vector<Places> places;  ///< squares take one or another

    SamplePass(std::uint32_t first, std::uint32_t last, std::uint32_t first_index, std::uint32_t all,
               const PixelFilter& filter, std::uint32_t seed, std::uint32_t place_count)
        : first_sample(first), last_sample(last), log2_samples(static_cast<std::uint32_t>(std::bit_width(all - 1))) {
        const auto across = static_cast<std::size_t>(2 * filter.reach_px() + 1);
        for (std::uint32_t k = 0; k < place_count; ++k) {
            Places& of_one = places.emplace_back();
            of_one.weights.resize(across * across);
            for (std::uint32_t index = first; index < last; ++index) {
                const FilterSample sample = filter.sample(Sampler{hash(seed, k), first_index + index}.point(0));
                of_one.offsets.push_back(sample.offset);
                for (std::size_t y = 0; y < across; ++y)
                    for (std::size_t x = 0; x < across; ++x)
                        of_one.weights[y * across + x].push_back(sample.weights_x[x] * sample.weights_y[y]);
            }
        }
    }

    /// By place in the frame.
    const Places& places_of(int frame_x, int frame_y) const {
        return places[hash(static_cast<std::uint32_t>(frame_x), static_cast<std::uint32_t>(frame_y)) % places.size()];
    }
};

bool Session::render_round(const Round& round, std::uint32_t samples) {
    const auto tiles = make_tiles(scene_->camera().window, filter_.reach_px());
    const std::uint32_t most = round.counts.empty() ? max_samples_per_pass : max_samples_per_sparse_pass;
    const std::uint32_t first_count = virtual_lights().empty() ? 1u : bounced_samples_shared;
    // An analytic picture is the same for all seeds.
    const std::uint32_t seed = settings_.integrator == Integrator::analytic ? 0u : hash(round.seed, place_seed);
    for (std::uint32_t done = 0; done < samples;) {
        const std::uint32_t count = std::min({std::max(done, first_count), most, samples - done});
        const SamplePass pass(done, done + count, round.first_index, samples, filter_, seed,
                              round.pilot.empty() && round.counts.empty() ? 1u : places_when_adaptive);
        for (const std::vector<Tile>& of_one_colour : tiles)
            tbb::parallel_for_each(of_one_colour, [&](const Tile& tile) { render_tile(round, pass, tile); });
        if (should_stop()) return false;
        samples_done_ += count;
        done += count;
    }
    return true;
}

std::size_t Session::count_of(const Round& round, const SamplePass& pass, std::size_t square) {
    const std::uint32_t last =
        round.counts.empty() ? pass.last_sample : std::min(pass.last_sample, round.counts[square]);
    return last > pass.first_sample ? last - pass.first_sample : 0;
}

void Session::render_tile(const Round& round, const SamplePass& pass, const Tile& tile) {
    const bool analytic = settings_.integrator == Integrator::analytic;
    const int reach = filter_.reach_px();
    const bool sees_centers = pass.first_sample == 0 && round.sees_centers;
    const auto is_wanted = [&] {
        for (int y = tile.y0; y < tile.y1; ++y)
            for (int x = tile.x0; x < tile.x1; ++x)
                if (count_of(round, pass, squares_.index(x + reach, y + reach)) > 0) return true;
        return false;
    };
    if (!is_wanted()) return;
    const Tile reached{std::max(tile.x0 - reach, 0), std::max(tile.y0 - reach, 0),
                       std::min(tile.x1 + reach, film_.width()), std::min(tile.y1 + reach, film_.height())};
    const Window& window = scene_->camera().window;
    const PixelGrid grid{reached.x1 - reached.x0, reached.y1 - reached.y0};
    std::vector<Pixel> pixels;
    round.film.load(reached, pixels);
    std::vector<SurfacePixel> surfaces;
    if (settings_.surface_passes) round.film.load_surfaces(reached, surfaces);
    std::vector<Mattes> mattes;
    if (settings_.mattes) round.film.load_mattes(reached, mattes);
    std::vector<Rgb> named, named_of_row;
    const std::size_t named_passes = round.film.named_passes();
    round.film.load_named(reached, named);
    std::vector<SurfacePasses> passes;
    std::vector<SeenMatte> seen_mattes;
    const PixelGrid own_grid{tile.x1 - tile.x0, tile.y1 - tile.y0};
    std::vector<OwnSum> own(round.film.keeps_own_sums() ? own_grid.size() : 0);
    std::size_t samples_added = 0;
    for (int y = tile.y0; y < tile.y1; ++y) {
        if (should_stop()) return;  // a tile is all or nothing: every square of it has all of a pass or none
        const std::vector<Sample> row = sample_row(round, pass, tile.x0, tile.x1, y, passes, seen_mattes, named_of_row);
        if (row.empty()) continue;
        samples_added += row.size();
        std::size_t first = 0;
        for (int x = tile.x0; x < tile.x1; ++x) {
            const bool is_seen = x >= 0 && x < film_.width() && y >= 0 && y < film_.height();
            if (sees_centers && is_seen) {
                const std::size_t at = grid.index(x - reached.x0, y - reached.y0);
                see_center(pixels[at], surfaces.empty() ? nullptr : &surfaces[at], x, y);
            }
            const std::size_t square = squares_.index(x + reach, y + reach), count = count_of(round, pass, square);
            const std::span<const Sample> samples = std::span(row).subspan(first, count);
            const std::span<const SurfacePasses> told =
                surfaces.empty() ? std::span<const SurfacePasses>() : std::span(passes).subspan(first, count);
            const auto from = [&](std::size_t ray) {
                return std::ranges::lower_bound(seen_mattes, ray, {}, &SeenMatte::ray);
            };
            const std::span<const SeenMatte> shown(from(first), from(first + count));
            const std::size_t first_ray = first;
            const std::span<const Rgb> named_of_samples =
                std::span(named_of_row).subspan(first * named_passes, count * named_passes);
            const auto variance = analytic ? radiance_variance(samples) : std::nullopt;
            first += count;
            const float scale = round.counts.empty() ? 1.0f : 1.0f / std::max(round.counts[square], 1u);
            const auto weight_in = [&](int u, int v) {
                return scale * (round.weights.empty() ? 1.0f : round.weights[film_.grid().index(u, v)]);
            };
            if (is_seen && !own.empty()) own[own_grid.index(x - tile.x0, y - tile.y0)].add(samples, weight_in(x, y));
            auto weights = pass.places_of(window.x0 + x, window.y0 + y).weights.begin();
            for (int v = y - reach; v <= y + reach; ++v) {
                for (int u = x - reach; u <= x + reach; ++u, ++weights) {
                    if (u < reached.x0 || u >= reached.x1 || v < reached.y0 || v >= reached.y1) continue;
                    const std::size_t at = grid.index(u - reached.x0, v - reached.y0);
                    pixels[at].samples.add(samples, *weights, variance, weight_in(u, v));
                    if (!surfaces.empty()) surfaces[at].add(told, *weights, weight_in(u, v));
                    if (!mattes.empty()) mattes[at].add(shown, first_ray, *weights, weight_in(u, v));
                    if (named_passes > 0)
                        add_named(named_of_samples, *weights, weight_in(u, v),
                                  std::span(named).subspan(at * named_passes, named_passes));
                }
            }
        }
    }
    round.film.store(reached, pixels);
    if (!surfaces.empty()) round.film.store_surfaces(reached, surfaces);
    if (!mattes.empty()) round.film.store_mattes(reached, mattes);
    round.film.store_named(reached, named);
    for (int y = std::max(tile.y0, 0); y < std::min(tile.y1, film_.height()) && !own.empty(); ++y) {
        const int x0 = std::max(tile.x0, 0), x1 = std::min(tile.x1, film_.width());
        round.film.add_own(x0, y,
                           std::span(own).subspan(own_grid.index(x0 - tile.x0, y - tile.y0),
                                                  static_cast<std::size_t>(std::max(x1 - x0, 0))));
    }
    pixel_samples_done_ += samples_added;
}

void Session::shade_by_index(const Scene& scene, const RenderSettings& settings, const AnalyticLights& lights,
                             const IndexedRays& all, std::span<Sample> samples, std::span<Rgb> named) {
    std::vector<std::size_t> order(all.rays.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    // Of samples that share, those near the pixel's centre come first: what they find stands for the pixel.
    const std::uint32_t first_index = std::ranges::min(all.indices);
    std::ranges::stable_sort(order, {}, [&](std::size_t i) {
        const std::uint32_t index = all.indices[i];
        const Vec2f& offset = all.offsets[index - first_index];
        return std::tuple(index / bounced_samples_shared, dot(offset, offset), index);
    });
    std::vector<Ray> together;
    std::vector<std::uint32_t> pixels_of_together;
    std::vector<Sample> shaded;
    std::vector<Rgb> of_groups;
    std::vector<SharedReflections> shared;
    std::uint32_t shared_by = ~0u;
    for (std::size_t first = 0; first < order.size(); first += together.size()) {
        const std::uint32_t index = all.indices[order[first]];
        if (const std::uint32_t by = index / bounced_samples_shared; by != shared_by) {
            shared.assign(lights.bounced.size(), SharedReflections(all.pixels.back() + 1));
            shared_by = by;
        }
        together.clear();
        pixels_of_together.clear();
        for (std::size_t i = first; i < order.size() && all.indices[order[i]] == index; ++i) {
            together.push_back(all.rays[order[i]]);
            pixels_of_together.push_back(all.pixels[order[i]]);
        }
        shaded.resize(together.size());
        of_groups.assign(settings.light_groups * together.size(), Rgb(0.0f));
        GroupLight groups(settings.light_groups, settings.light_groups, of_groups);
        shade_analytic(scene, settings, lights, together, pixels_of_together, index, shared, shaded,
                       settings.light_groups > 0 ? &groups : nullptr);
        for (std::size_t i = 0; i < shaded.size(); ++i) {
            samples[order[first + i]] = shaded[i];
            for (std::size_t k = 0; k < settings.light_groups; ++k)
                named[order[first + i] * settings.named_passes() + k] = of_groups[i * settings.light_groups + k];
        }
    }
}

void Session::follow_among_catchers(const IndexedRays& all, std::span<const Sampler> samplers,
                                    std::span<const std::size_t> which, std::span<Sample> samples) const {
    const auto those = [&]<class T>(std::span<const T> of_all) {
        std::vector<T> some;
        for (const std::size_t i : which) some.push_back(of_all[i]);
        return some;
    };
    const RenderSettings settings = settings_of_catchers(settings_);
    const std::vector<Ray> rays = those(all.rays);
    if (settings.integrator == Integrator::monte_carlo) {
        trace_paths(*catchers_, settings, rays, those(samplers), samples);
        return;
    }
    const std::vector<std::uint32_t> indices = those(all.indices), pixels = those(all.pixels);
    const std::uint32_t skipped = std::ranges::min(indices) - std::ranges::min(all.indices);
    shade_by_index(*catchers_, settings, catcher_lights_, {rays, indices, pixels, all.offsets.subspan(skipped)},
                   samples, {});
}

std::vector<Sample> Session::sample_row(const Round& round, const SamplePass& pass, int x0, int x1, int y,
                                        std::vector<SurfacePasses>& passes, std::vector<SeenMatte>& mattes,
                                        std::vector<Rgb>& named) {
    const Camera& camera = scene_->camera();
    const int reach = filter_.reach_px(), frame_y = camera.window.y0 + y;
    const bool is_analytic = settings_.integrator == Integrator::analytic, has_lens = camera.lens.radius_m > 0.0f;
    const bool blurs = scene_->moves() && camera.blurs;
    const std::uint32_t seed = is_analytic ? 0u : round.seed;
    std::vector<Ray> rays;
    std::vector<std::uint32_t> indices;
    std::vector<Sampler> samplers;
    std::vector<std::uint32_t> pixels;  // of each ray, from x0 on
    for (int x = x0; x < x1; ++x) {
        const int frame_x = camera.window.x0 + x;
        const Vec2f center(static_cast<float>(frame_x) + 0.5f, static_cast<float>(frame_y) + 0.5f);
        // By place in the frame, so that a window shows the pixels of the whole; but those that choose among lights do
        // so together with their neighbours, of which a window has others.
        const auto column = static_cast<std::uint32_t>(frame_x), line = static_cast<std::uint32_t>(frame_y);
        const std::size_t square = squares_.index(x + reach, y + reach);
        const std::size_t count = count_of(round, pass, square);
        const std::vector<Vec2f>& offsets = pass.places_of(frame_x, frame_y).offsets;
        for (std::size_t k = 0; k < count; ++k) {
            pixels.push_back(static_cast<std::uint32_t>(x - x0));
            const std::uint32_t index = round.first_index + pass.first_sample + static_cast<std::uint32_t>(k);
            indices.push_back(index);
            samplers.push_back(pixel_sampler(column, line, seed, pass.log2_samples, index));
            const float time = blurs ? camera.time(samplers.back().point(time_dimension).x) : middle_time;
            rays.push_back(has_lens ? camera.ray(center + offsets[k], samplers.back().point(lens_dimension), time)
                                    : camera.ray(center + offsets[k], time));
        }
    }
    std::vector<Sample> samples(rays.size());
    passes.assign(settings_.surface_passes ? rays.size() : 0, {});
    mattes.clear();
    named.assign(settings_.named_passes() * rays.size(), Rgb(0.0f));
    if (rays.empty()) return samples;
    if (!passes.empty() || settings_.mattes || settings_.aovs > 0)
        see_surfaces(*scene_, settings_, rays, samplers, passes, mattes, named);
    const IndexedRays indexed{rays, indices, pixels, pass.places_of(camera.window.x0 + x0, frame_y).offsets};
    if (is_analytic)
        shade_by_index(*scene_, settings_, lights_->lights, indexed, samples, named);
    else
        trace_paths(*scene_, settings_, rays, samplers, samples, passes, named);
    for (std::size_t i = 0; i < rays.size(); ++i)
        if (!(rays[i].far_m > 0.0f)) samples[i] = {};  // the lens sees nothing there
    if (catchers_)
        tell_catchers(
            *scene_, settings_, rays, samplers, samples,
            [&](std::span<const std::size_t> which, std::span<Sample> of_catchers) {
                follow_among_catchers(indexed, samplers, which, of_catchers);
            },
            named);
    const std::size_t first_square = squares_.index(x0 + reach, y + reach);
    std::size_t at = 0;
    for (int x = x0; x < x1; ++x) {
        const std::size_t square = first_square + static_cast<std::size_t>(x - x0);
        for (const std::size_t end = at + count_of(round, pass, square); at < end; ++at) {
            if (!is_finite(samples[at])) {
                report_bad_sample(camera.window.x0 + x, frame_y, rays[at]);
                samples[at] = {.alpha = 0.0f};
                if (!passes.empty()) passes[at] = {};
                const std::size_t named_passes = named.size() / samples.size();
                std::fill_n(named.begin() + static_cast<std::ptrdiff_t>(at * named_passes), named_passes, Rgb(0.0f));
            }
            if (round.pilot.empty()) continue;
            const Rgb& radiance = samples[at].radiance;
            round.pilot[square].add(mean_component(radiance),
                                    mean_component(radiance - denoised_part_ * samples[at].indirect));
        }
    }
    return samples;
}

void Session::see_center(Pixel& pixel, SurfacePixel* surfaces, int x, int y) const {
    const Camera& camera = scene_->camera();
    const Vec2f center(static_cast<float>(camera.window.x0 + x) + 0.5f,
                       static_cast<float>(camera.window.y0 + y) + 0.5f);
    const Ray ray = camera.ray(center);
    const auto hit = scene_->intersect(ray, visible_to_camera);
    if (!hit || scene_->is_holdout(*hit)) return;
    const Vec3f position = scene_->surface_point(ray, *hit).position;
    pixel.center = {camera.depth_m(position), position};
    if (!surfaces) return;
    surfaces->object_index = scene_->facts_of(*hit).pass_index;
    surfaces->material_index = scene_->material_index_of(*hit);
}

void Session::report_bad_sample(int x, int y, const Ray& ray) {
    const auto hit = scene_->intersect(ray, visible_to_camera);
    const std::string where = hit ? "object '" + scene_->instance_name(hit->instance) + "'" : "the background";
    const std::lock_guard lock(mutex_);
    if (bad_samples_.size() < max_bad_samples) {
        bad_samples_.push_back("pixel (" + std::to_string(x) + ", " + std::to_string(y) + ") on " + where +
                               ": a sample was not finite and was left out");
    }
}

}  // namespace pivot
