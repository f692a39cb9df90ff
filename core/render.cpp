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
    const auto place = [&](std::size_t i) {
        const auto width = static_cast<std::size_t>(tile.x1 - tile.x0);
        return std::pair(tile.x0 + static_cast<int>(i % width), tile.y0 + static_cast<int>(i / width));
    };
    std::vector<Ray> rays(pixels.size());
    std::vector<Sampler> samplers(pixels.size());
    std::vector<Sample> samples(pixels.size());
    for (std::uint32_t index = first_sample; index < last_sample; ++index) {
        if (should_stop()) return;  // a tile is all or nothing: every pixel of it keeps the same sample count
        for (std::size_t i = 0; i < pixels.size(); ++i) {
            const auto [x, y] = place(i);
            if (index == 0) see_center(pixels[i], x, y);
            samplers[i] = sampler(x, y, index);
            rays[i] = camera_ray(x, y, samplers[i]);
        }
        if (settings_.integrator == Integrator::analytic) {
            shade_analytic(*scene_, settings_, rays, index, samples);
        } else {
            for (std::size_t i = 0; i < pixels.size(); ++i) {
                if (should_stop()) return;
                samples[i] = trace_path(*scene_, settings_, rays[i], samplers[i]);
            }
        }
        for (std::size_t i = 0; i < pixels.size(); ++i) add_sample(pixels[i], samples[i], rays[i], place(i));
    }
    film_.store(tile, pixels);
    pixel_samples_done_ += pixels.size() * (last_sample - first_sample);
}

Sampler Session::sampler(int x, int y, std::uint32_t index) const {
    // By place in the frame, so that a window shows the pixels of the whole; analytic pictures use one pattern for all.
    if (settings_.integrator == Integrator::analytic) return Sampler(0u, index);
    const Window& window = scene_->camera().window;
    const std::uint32_t place =
        hash(static_cast<std::uint32_t>(window.x0 + x), static_cast<std::uint32_t>(window.y0 + y));
    return Sampler(hash(place, settings_.seed), index);
}

Ray Session::camera_ray(int x, int y, const Sampler& sampler) const {
    const Camera& camera = scene_->camera();
    const Vec2f center(static_cast<float>(camera.window.x0 + x) + 0.5f,
                       static_cast<float>(camera.window.y0 + y) + 0.5f);
    return camera.ray(center + filter_.sample(sampler.point(0)));
}

void Session::add_sample(Pixel& pixel, const Sample& sample, const Ray& ray, std::pair<int, int> place) {
    pixel.count += 1;
    if (!is_finite(sample)) {
        const Window& window = scene_->camera().window;
        report_bad_sample(window.x0 + place.first, window.y0 + place.second, ray);
        return;
    }
    pixel.sum.radiance += sample.radiance;
    pixel.sum.alpha += sample.alpha;
    pixel.sum.normal += sample.normal;
    pixel.sum.albedo += sample.albedo;
    pixel.sum.emission += sample.emission;
    pixel.sum.method += sample.method;
    pixel.sum.predicted_error += sample.predicted_error;
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
