#include "core/render.h"

#include <tbb/parallel_for_each.h>
#include <tbb/task_arena.h>

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
    const Vec3f sum = s.radiance + s.normal + s.albedo + s.emission + s.method;
    return std::isfinite(sum.x + sum.y + sum.z + s.alpha + s.predicted_error);
}

void add(Sample& sum, const Sample& sample) {
    sum.radiance += sample.radiance;
    sum.alpha += sample.alpha;
    sum.normal += sample.normal;
    sum.albedo += sample.albedo;
    sum.emission += sample.emission;
    sum.method += sample.method;
    sum.predicted_error += sample.predicted_error;
}

}  // namespace

Session::Session(std::shared_ptr<Scene> scene, const RenderSettings& settings)
    : scene_(std::move(scene)),
      settings_(settings),
      filter_(settings.filter_shape, settings.filter_width_px),
      film_(scene_->camera().window.width(), scene_->camera().window.height()) {
    if (film_.width() < 1) throw std::invalid_argument("the scene has no camera: call set_camera");
}

Session::~Session() {
    stop();
    if (thread_.joinable()) thread_.join();
}

void Session::start() {
    if (thread_.joinable()) throw std::logic_error("the session was started before");
    scene_->hold();
    start_time_ = std::chrono::steady_clock::now();
    thread_ = std::thread([this] {
        std::exception_ptr fault;
        try {
            tbb::task_arena arena(settings_.threads > 0 ? settings_.threads : tbb::task_arena::automatic);
            arena.execute([this] { run(); });
        } catch (...) {
            fault = std::current_exception();
        }
        scene_->release();
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
    const double pixels = static_cast<double>(film_.width()) * film_.height();
    const double of_samples = static_cast<double>(pixel_samples_done_) / (pixels * settings_.samples);
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
    for (std::uint32_t done = 0; done < settings_.samples && !should_stop();) {
        const std::uint32_t pass = std::min({std::max(done, 1u), max_samples_per_pass, settings_.samples - done});
        render_pass(done, done + pass);
        if (should_stop()) return;
        done += pass;
        samples_done_ = done;
    }
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
    for (int y = tile.y0; y < tile.y1; ++y, left = left.subspan(width)) {
        if (should_stop()) return;  // a tile is all or nothing: every pixel of it keeps the same sample count
        const std::span<Pixel> row = left.first(width);
        for (std::size_t i = 0; first_sample == 0 && i < width; ++i)
            see_center(row[i], tile.x0 + static_cast<int>(i), y);
        add_samples(row, tile.x0, y, first_sample, last_sample);
    }
    film_.store(tile, pixels);
    pixel_samples_done_ += pixels.size() * (last_sample - first_sample);
}

void Session::add_samples(std::span<Pixel> row, int x0, int y, std::uint32_t first_sample, std::uint32_t last_sample) {
    const Camera& camera = scene_->camera();
    const bool analytic = settings_.integrator == Integrator::analytic;
    const int frame_y = camera.window.y0 + y;
    const std::size_t count = last_sample - first_sample;
    std::vector<Ray> rays(row.size() * count);
    std::vector<Sampler> samplers(rays.size());
    std::vector<Sample> samples(rays.size());
    // Paths of one pixel side by side, but analytic samples of one index: what they share goes together in a batch.
    const auto place_of = [&](std::size_t pixel, std::size_t sample) {
        return analytic ? sample * row.size() + pixel : pixel * count + sample;
    };
    for (std::size_t i = 0; i < row.size(); ++i) {
        const int frame_x = camera.window.x0 + x0 + static_cast<int>(i);
        const Vec2f center(static_cast<float>(frame_x) + 0.5f, static_cast<float>(frame_y) + 0.5f);
        // By place in the frame, so that a window shows the pixels of the whole; analytic pictures use one pattern for
        // all.
        const std::uint32_t place = hash(static_cast<std::uint32_t>(frame_x), static_cast<std::uint32_t>(frame_y));
        const std::uint32_t seed = analytic ? 0u : hash(place, settings_.seed);
        for (std::size_t k = 0; k < count; ++k) {
            const Sampler sampler(seed, first_sample + static_cast<std::uint32_t>(k));
            samplers[place_of(i, k)] = sampler;
            rays[place_of(i, k)] = camera.ray(center + filter_.sample(sampler.point(0)));
        }
    }
    if (analytic) {
        for (std::size_t k = 0; k < count; ++k) {
            const auto first = k * row.size();
            shade_analytic(*scene_, settings_, std::span(rays).subspan(first, row.size()),
                           first_sample + static_cast<std::uint32_t>(k), std::span(samples).subspan(first, row.size()));
        }
    } else {
        trace_paths(*scene_, settings_, rays, samplers, samples);
    }
    for (std::size_t i = 0; i < row.size(); ++i) {
        for (std::size_t k = 0; k < count; ++k) {
            const Sample& sample = samples[place_of(i, k)];
            row[i].count += 1;
            if (is_finite(sample)) {
                add(row[i].sum, sample);
            } else {
                report_bad_sample(camera.window.x0 + x0 + static_cast<int>(i), frame_y, rays[place_of(i, k)]);
            }
        }
    }
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
