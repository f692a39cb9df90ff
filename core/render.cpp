#include "core/render.h"

#include <tbb/parallel_for_each.h>
#include <tbb/task_arena.h>

#include <numeric>
#include <stdexcept>

#include "core/integrators/analytic.h"
#include "core/integrators/monte_carlo.h"

namespace pivot {
namespace {

constexpr int tile_size = 32;
/// Passes grow from one sample, so that the first picture is early, to this many, so that tiles are worth their
/// overhead.
constexpr std::uint32_t max_samples_per_pass = 8;
constexpr std::size_t max_bad_samples = 8;

std::vector<Tile> make_tiles(int width, int height) {
    std::vector<Tile> tiles;
    for (int y = 0; y < height; y += tile_size) {
        for (int x = 0; x < width; x += tile_size) {
            tiles.push_back({x, y, std::min(x + tile_size, width), std::min(y + tile_size, height)});
        }
    }
    return tiles;
}

bool is_finite(const Sample& s) {
    const Vec3f sum = s.radiance + s.normal + s.albedo + s.emission + s.method + s.volume_direct + s.volume_indirect;
    return std::isfinite(sum.x + sum.y + sum.z + s.alpha + s.error + s.shadow_variance);
}

void add(Sample& sum, const Sample& sample) {
    sum.radiance += sample.radiance;
    sum.alpha += sample.alpha;
    sum.normal += sample.normal;
    sum.albedo += sample.albedo;
    sum.emission += sample.emission;
    sum.volume_direct += sample.volume_direct;
    sum.volume_indirect += sample.volume_indirect;
    sum.method += sample.method;
    sum.error += sample.error;
    sum.shadow_variance += sample.shadow_variance;
}

}  // namespace

Session::Session(std::shared_ptr<Scene> scene, const RenderSettings& settings)
    : scene_(std::move(scene)),
      settings_(settings),
      filter_(settings.filter_shape, settings.filter_width_px),
      film_(scene_->camera().window.width(), scene_->camera().window.height()),
      total_pixel_samples_(static_cast<std::uint64_t>(film_.width()) * static_cast<std::uint64_t>(film_.height()) *
                           settings.samples) {
    if (film_.width() < 1) throw std::invalid_argument("the scene has no camera: call set_camera");
}

Session::~Session() {
    stop();
    if (thread_.joinable()) thread_.join();
}

void Session::start() {
    if (thread_.joinable()) throw std::logic_error("the session was started before");
    auto hold = std::make_unique<SceneHold>(*scene_);
    start_time_ = std::chrono::steady_clock::now();
    thread_ = std::thread([this, hold = std::move(hold)]() mutable {
        std::exception_ptr fault;
        try {
            tbb::task_arena arena(settings_.threads > 0 ? settings_.threads : tbb::task_arena::automatic);
            arena.execute([this] { run(); });
        } catch (...) {
            fault = std::current_exception();
        }
        hold.reset();
        const std::lock_guard lock(mutex_);
        fault_ = fault;
        has_ended_ = true;
        ended_.notify_all();
    });
}

bool Session::wait(double seconds) {
    std::unique_lock lock(mutex_);
    const bool ended = ended_.wait_for(lock, std::chrono::duration<double>(seconds), [this] { return has_ended_; });
    if (fault_) std::rethrow_exception(fault_);
    return ended;
}

double Session::progress() const {
    const double of_samples = static_cast<double>(pixel_samples_done_) / static_cast<double>(total_pixel_samples_);
    if (!(settings_.time_limit_s > 0.0f)) return of_samples;
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_time_;
    return std::clamp(elapsed.count() / static_cast<double>(settings_.time_limit_s), of_samples, 1.0);
}

std::vector<std::string> Session::bad_samples() const {
    const std::lock_guard lock(mutex_);
    return bad_samples_;
}

bool Session::should_stop() const { return stop_ || std::chrono::steady_clock::now() >= deadline_; }

void Session::run() {
    using clock = std::chrono::steady_clock;
    const auto limit =
        std::chrono::duration_cast<clock::duration>(std::chrono::duration<double>(settings_.time_limit_s));
    deadline_ = settings_.time_limit_s > 0.0f ? start_time_ + limit : clock::time_point::max();
    scene_->commit();
    if (settings_.integrator == Integrator::analytic && settings_.occlusion == Occlusion::bent_cone)
        scene_->trace_bent_cones([this] { return should_stop(); });
    const bool adaptive = settings_.adaptive && settings_.integrator == Integrator::monte_carlo;
    const std::uint32_t pilot_end = adaptive ? pilot_samples(settings_.samples) : settings_.samples;
    if (adaptive) pilots_.resize(static_cast<std::size_t>(film_.width()) * static_cast<std::size_t>(film_.height()));
    if (!render_passes(0, pilot_end) || pilot_end == settings_.samples) return;
    counts_ = sample_counts(pilots_, film_.width(), 0.01f * settings_.error_budget_percent, settings_.samples);
    pilots_.clear();
    total_pixel_samples_ = std::accumulate(counts_.begin(), counts_.end(), std::uint64_t{0});
    render_passes(pilot_end, *std::max_element(counts_.begin(), counts_.end()));
    if (!should_stop()) samples_done_ = settings_.samples;
}

bool Session::render_passes(std::uint32_t first_sample, std::uint32_t last_sample) {
    for (std::uint32_t done = first_sample; done < last_sample;) {
        const std::uint32_t pass = std::min({std::max(done, 1u), max_samples_per_pass, last_sample - done});
        render_pass(done, done + pass);
        if (should_stop()) return false;
        done += pass;
        samples_done_ = done;
    }
    return true;
}

void Session::render_pass(std::uint32_t first_sample, std::uint32_t last_sample) {
    const std::vector<Tile> tiles = make_tiles(film_.width(), film_.height());
    tbb::parallel_for_each(tiles, [&](const Tile& tile) { render_tile(tile, first_sample, last_sample); });
}

void Session::render_tile(const Tile& tile, std::uint32_t first_sample, std::uint32_t last_sample) {
    std::vector<Pixel> pixels;
    film_.load(tile, pixels);
    const auto width = static_cast<std::size_t>(tile.x1 - tile.x0);
    std::span<Pixel> left = pixels;
    std::size_t samples_added = 0;
    for (int y = tile.y0; y < tile.y1; ++y, left = left.subspan(width)) {
        if (should_stop()) return;  // a tile is all or nothing: every pixel of it has all of a pass or none
        const std::span<Pixel> row = left.first(width);
        for (std::size_t i = 0; first_sample == 0 && i < width; ++i)
            see_center(row[i], tile.x0 + static_cast<int>(i), y);
        samples_added += add_samples(row, tile.x0, y, first_sample, last_sample);
    }
    film_.store(tile, pixels);
    pixel_samples_done_ += samples_added;
}

std::size_t Session::add_samples(std::span<Pixel> row, int x0, int y, std::uint32_t first_sample,
                                 std::uint32_t last_sample) {
    const Camera& camera = scene_->camera();
    const bool analytic = settings_.integrator == Integrator::analytic;
    const std::size_t first_pixel =
        static_cast<std::size_t>(y) * static_cast<std::size_t>(film_.width()) + static_cast<std::size_t>(x0);
    const auto end_of = [&](std::size_t pixel) {
        return counts_.empty() ? last_sample : std::min(last_sample, counts_[first_pixel + pixel]);
    };
    struct PixelSample {
        std::size_t pixel;
        std::uint32_t index;
    };
    // Paths of one pixel side by side, but analytic samples of one index: what they share goes together in a batch.
    std::vector<PixelSample> planned;
    planned.reserve(row.size() * (last_sample - first_sample));
    if (analytic) {
        for (std::uint32_t index = first_sample; index < last_sample; ++index)
            for (std::size_t i = 0; i < row.size(); ++i) planned.push_back({i, index});
    } else {
        for (std::size_t i = 0; i < row.size(); ++i)
            for (std::uint32_t index = first_sample; index < end_of(i); ++index) planned.push_back({i, index});
    }
    const int frame_x0 = camera.window.x0 + x0, frame_y = camera.window.y0 + y;
    std::vector<Sampler> samplers;
    samplers.reserve(planned.size());
    for (const auto& [pixel, index] : planned) {
        // By place in the frame, so that a window shows the pixels of the whole; analytic pictures use one pattern for
        // all.
        const std::uint32_t place =
            hash(static_cast<std::uint32_t>(frame_x0 + static_cast<int>(pixel)), static_cast<std::uint32_t>(frame_y));
        samplers.emplace_back(analytic ? 0u : hash(place, settings_.seed), index);
    }
    std::vector<Vec2f> in_pixel(planned.size());
    sample_points(samplers, 0, in_pixel);
    std::vector<Ray> rays(planned.size());
    for (std::size_t i = 0; i < planned.size(); ++i) {
        const int frame_x = frame_x0 + static_cast<int>(planned[i].pixel);
        const Vec2f center(static_cast<float>(frame_x) + 0.5f, static_cast<float>(frame_y) + 0.5f);
        rays[i] = camera.ray(center + filter_.sample(in_pixel[i]));
    }
    std::vector<Sample> samples(rays.size());
    if (analytic) {
        for (std::size_t first = 0; first < rays.size(); first += row.size()) {
            shade_analytic(*scene_, settings_, std::span(rays).subspan(first, row.size()), planned[first].index,
                           std::span(samples).subspan(first, row.size()));
        }
    } else {
        trace_paths(*scene_, settings_, rays, samplers, samples);
    }
    for (std::size_t i = 0; i < rays.size(); ++i) {
        Pixel& pixel = row[planned[i].pixel];
        pixel.count += 1;
        if (is_finite(samples[i])) {
            add(pixel.sum, samples[i]);
            if (analytic) pixel.sum_of_squares += sqr(mean_component(samples[i].radiance));
        } else {
            report_bad_sample(frame_x0 + static_cast<int>(planned[i].pixel), frame_y, rays[i]);
        }
    }
    if (!pilots_.empty() && (last_sample - first_sample) % pilot_block == 0) {
        for (std::size_t i = 0; i < rays.size(); i += pilot_block) {
            Rgb block(0.0f);
            for (std::size_t k = 0; k < pilot_block; ++k) block += samples[i + k].radiance;
            const float mean = (block.x + block.y + block.z) / (3.0f * pilot_block);
            if (std::isfinite(mean)) pilots_[first_pixel + planned[i].pixel].add(mean);
        }
    }
    return rays.size();
}

void Session::see_center(Pixel& pixel, int x, int y) const {
    const Camera& camera = scene_->camera();
    const Vec2f center(static_cast<float>(camera.window.x0 + x) + 0.5f,
                       static_cast<float>(camera.window.y0 + y) + 0.5f);
    const Ray ray = camera.ray(center);
    const auto hit = scene_->intersect(ray, visible_to_camera);
    if (!hit) return;
    const Vec3f position = scene_->surface_point(ray, *hit).position;
    pixel.center = {camera.depth_m(position), position};
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
