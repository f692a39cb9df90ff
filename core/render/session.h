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
#include "core/integrators/analytic_lights.h"
#include "core/integrators/settings.h"
#include "core/sampling/sobol.h"
#include "core/scene/scene.h"

namespace pivot {

/// What an analytic session gathered, for those to come of the same scene.
struct SessionLights {
    std::weak_ptr<const Scene> scene;
    RenderSettings settings;
    AnalyticLights lights;
};

class Session {
   public:
    /// Sessions may share a scene, which must not be edited until all have ended. known: lights of a session before,
    /// since when the scene has been edited by set_camera() alone; they are taken over where they are what this session
    /// would gather.
    Session(std::shared_ptr<Scene> scene, const RenderSettings& settings,
            std::shared_ptr<const SessionLights> known = nullptr);
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

    /// What a session allocates for each pixel of its window.
    static std::size_t bytes_per_pixel(bool adaptive, const FilmParts& parts);

    double progress() const;
    /// Since the scene was ready, until the render has ended.
    double sampling_s() const;
    std::uint32_t samples_done() const { return samples_done_; }
    /// Of all squares.
    std::uint64_t pixel_samples() const { return pixel_samples_done_; }
    const Film& film() const { return film_; }
    /// Once samples are done.
    std::span<const VirtualLights> virtual_lights() const;
    /// Null until they are gathered, and of Monte Carlo.
    std::shared_ptr<const SessionLights> lights() const;
    /// The first few samples that were not finite and were left out, each by pixel and object.
    std::vector<std::string> bad_samples() const;

   private:
    /// Samples that go to one film by one sequence of points. Squares are the window's pixels and those around it whose
    /// samples reach these.
    struct Round {
        Film& film;
        std::uint32_t seed;  ///< of the sequence; analytic pictures have one for all
        bool sees_centers = false;
        std::uint32_t first_index = 0;            ///< in the sequence
        std::span<Pilot> pilot{};                 ///< of each square, to be told of its samples; empty: nobody asks
        std::span<const std::uint32_t> counts{};  ///< of each square; empty: all get as many
        std::span<const float> weights{};         ///< of the round in each pixel; empty: that of its samples
    };
    struct SamplePass;

    void run();
    void render_adaptively();
    /// So many samples of each square, or of its count as many. False when it was stopped.
    bool render_round(const Round& round, std::uint32_t samples);
    void render_tile(const Round& round, const SamplePass& pass, const Tile& tile);
    /// A pass's samples of the squares of row y from x0 to x1, one after the other.
    /// passes, mattes, named: of these, where they are asked for.
    std::vector<Sample> sample_row(const Round& round, const SamplePass& pass, int x0, int x1, int y,
                                   std::vector<SurfacePasses>& passes, std::vector<SeenMatte>& mattes,
                                   std::vector<Rgb>& named);
    /// Rays of a row, as analytic samples take them.
    struct IndexedRays {
        std::span<const Ray> rays;
        std::span<const std::uint32_t> indices;
        std::span<const std::uint32_t> pixels;  ///< rising
        std::span<const Vec2f> offsets;         ///< by their indices
    };
    /// Analytic samples of one index go together in a batch: what is known by it they share. named: of each sample, as
    /// light groups fill them; may be empty.
    static void shade_by_index(const Scene& scene, const RenderSettings& settings, const AnalyticLights& lights,
                               const IndexedRays& all, std::span<Sample> samples, std::span<Rgb> named);
    /// Follows those of a row's rays through the scene of shadow catchers alone.
    void follow_among_catchers(const IndexedRays& all, std::span<const Sampler> samplers,
                               std::span<const std::size_t> which, std::span<Sample> samples) const;
    /// How many of a pass's samples a square gets.
    static std::size_t count_of(const Round& round, const SamplePass& pass, std::size_t square);
    /// surfaces: null where nobody asks.
    void see_center(Pixel& pixel, SurfacePixel* surfaces, int x, int y) const;
    void report_bad_sample(int x, int y, const Ray& ray);
    bool should_stop() const;

    std::shared_ptr<Scene> scene_;
    std::shared_ptr<Scene> catchers_;  ///< alone; none where these are not told of
    AnalyticLights catcher_lights_;    ///< likewise, of analytic pictures
    RenderSettings settings_;
    std::shared_ptr<const SessionLights> known_lights_;
    PixelFilter filter_;
    float denoised_part_;  ///< of what noise takes light that bounced off by, where one is to come
    PixelGrid squares_;
    Film film_;
    std::atomic<std::uint64_t> total_pixel_samples_;
    std::chrono::steady_clock::time_point start_time_, deadline_;
    std::atomic<bool> stop_{false};
    std::atomic<std::uint32_t> samples_done_{0};
    std::atomic<std::uint64_t> pixel_samples_done_{0};
    mutable std::mutex mutex_;  ///< of what follows
    std::condition_variable ended_;
    bool has_ended_ = false;
    std::chrono::steady_clock::time_point sampling_start_, end_time_;
    std::shared_ptr<const SessionLights> lights_;  ///< of this session; the threads that sample read it without a lock
    std::exception_ptr fault_;
    std::vector<std::string> bad_samples_;
    std::thread thread_;
};

}  // namespace pivot
