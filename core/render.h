// A render: a scene, settings and a film, worked on by native threads that can be watched, read and stopped.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <memory>
#include <thread>

#include "core/film/film.h"
#include "core/film/pixel_filter.h"
#include "core/film/sample_counts.h"
#include "core/integrators/settings.h"
#include "core/sampling/sobol.h"
#include "core/scene/scene.h"

namespace pivot {

class Session {
   public:
    /// Sessions may share a scene, which must not be edited until all have ended.
    Session(std::shared_ptr<Scene> scene, const RenderSettings& settings);
    /// Stops and waits.
    ~Session();
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    /// Holds the scene until the render has ended. Throws std::logic_error when called twice.
    void start();
    /// Whether the render has ended within the given time. Throws what the render threw.
    bool wait(double seconds);
    /// Asks the render to end; it does so within milliseconds.
    void stop() { stop_ = true; }

    double progress() const;
    std::uint32_t samples_done() const { return samples_done_; }
    const Film& film() const { return film_; }
    /// The first few samples that were not finite and were left out, each by pixel and object.
    std::vector<std::string> bad_samples() const;

   private:
    void run();
    void render_pass(std::uint32_t first_sample, std::uint32_t last_sample);
    void render_tile(const Tile& tile, std::uint32_t first_sample, std::uint32_t last_sample);
    /// False when it was stopped.
    bool render_passes(std::uint32_t first_sample, std::uint32_t last_sample);
    /// Adds the samples to part of row y of the window, from x0 on; how many they were.
    std::size_t add_samples(std::span<Pixel> row, int x0, int y, std::uint32_t first_sample, std::uint32_t last_sample);
    void see_center(Pixel& pixel, int x, int y) const;
    void report_bad_sample(int x, int y, const Ray& ray);
    bool should_stop() const;

    std::shared_ptr<Scene> scene_;
    RenderSettings settings_;
    PixelFilter filter_;
    Film film_;
    // Adaptive sampling: what the pilot found while it lasts, then each pixel's count. Tiles touch their own pixels.
    std::vector<Pilot> pilots_;
    std::vector<std::uint32_t> counts_;
    std::atomic<std::uint64_t> total_pixel_samples_;
    std::chrono::steady_clock::time_point start_time_, deadline_;
    std::atomic<bool> stop_{false};
    std::atomic<std::uint32_t> samples_done_{0};
    std::atomic<std::uint64_t> pixel_samples_done_{0};
    mutable std::mutex mutex_;  ///< of what follows
    std::condition_variable ended_;
    bool has_ended_ = false;
    std::exception_ptr fault_;
    std::vector<std::string> bad_samples_;
    std::thread thread_;
};

}  // namespace pivot
