#include "core/render/session.h"

#include <tbb/task_arena.h>

#include <numeric>
#include <stdexcept>

#include "core/integrators/catcher_light.h"

namespace pivot {
namespace {

constexpr std::size_t mattes_of_pixel = 4;  // about

/// How far noise takes light that bounced from its mean once it is denoised, over how far before: a quarter as measured
/// in rooms, more where little light bounces, which then is a small part of the error.
constexpr float left_by_denoiser = 0.25f;

}  // namespace

Session::Session(std::shared_ptr<Scene> scene, const RenderSettings& settings,
                 std::shared_ptr<const SessionLights> known)
    : scene_(std::move(scene)),
      settings_(settings),
      known_lights_(std::move(known)),
      filter_(settings.filter_shape, settings.filter_width_px),
      denoised_part_(settings.denoising_passes && settings.integrator != Integrator::analytic ? 1.0f - left_by_denoiser
                                                                                              : 0.0f),
      squares_{scene_->camera().window.width() + 2 * filter_.reach_px(),
               scene_->camera().window.height() + 2 * filter_.reach_px()},
      film_(scene_->camera().window.width(), scene_->camera().window.height(),
            {.own_sums = settings.denoising_passes,
             .surface_passes = settings.surface_passes,
             .mattes = settings.mattes,
             .named_passes = settings.named_passes()}),
      total_pixel_samples_(squares_.size() * std::uint64_t{settings.samples}) {
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
        end_time_ = std::chrono::steady_clock::now();
        ended_.notify_all();
    });
}

bool Session::wait(double seconds) {
    std::unique_lock lock(mutex_);
    const bool ended = ended_.wait_for(lock, std::chrono::duration<double>(seconds), [this] { return has_ended_; });
    if (fault_) std::rethrow_exception(fault_);
    return ended;
}

std::size_t Session::bytes_per_pixel(bool adaptive, const FilmParts& parts) {
    const std::size_t film =
        sizeof(Pixel) + (parts.own_sums ? sizeof(OwnSum) : 0) + (parts.surface_passes ? sizeof(SurfacePixel) : 0) +
        (parts.mattes ? sizeof(Mattes) + mattes_of_pixel * sizeof(Matte) : 0) + parts.named_passes * sizeof(Rgb);
    if (!adaptive) return film;
    constexpr std::size_t numbers_of_counts = 16;  // while they are made
    return 2 * (film + sizeof(Pilot)) + numbers_of_counts * sizeof(float);
}

double Session::progress() const {
    const double of_samples = static_cast<double>(pixel_samples_done_) / static_cast<double>(total_pixel_samples_);
    if (!(settings_.time_limit_s > 0.0f)) return of_samples;
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_time_;
    return std::clamp(elapsed.count() / static_cast<double>(settings_.time_limit_s), of_samples, 1.0);
}

double Session::sampling_s() const {
    const std::lock_guard lock(mutex_);
    if (sampling_start_ == std::chrono::steady_clock::time_point{}) return 0.0;
    const auto end = has_ended_ ? end_time_ : std::chrono::steady_clock::now();
    return std::chrono::duration<double>(end - sampling_start_).count();
}

std::span<const VirtualLights> Session::virtual_lights() const {
    return lights_ ? std::span<const VirtualLights>(lights_->lights.bounced) : std::span<const VirtualLights>();
}

std::shared_ptr<const SessionLights> Session::lights() const {
    const std::lock_guard lock(mutex_);
    return lights_;
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
    if (settings_.shadow_catchers) {
        catchers_ = scene_->only_shadow_catchers();
        catchers_->commit();
    }
    const bool is_analytic = settings_.integrator == Integrator::analytic;
    if (is_analytic && settings_.occlusion == Occlusion::bent_cone) {
        scene_->trace_bent_cones([this] { return should_stop(); });
        if (catchers_) catchers_->trace_bent_cones([this] { return should_stop(); });
    }
    std::shared_ptr<const SessionLights> lights;
    if (is_analytic) {
        if (catchers_) catcher_lights_ = gather_lights(*catchers_, settings_of_catchers(settings_));
        const bool is_known = known_lights_ && known_lights_->scene.lock() == scene_ &&
                              gather_the_same(known_lights_->settings, settings_);
        lights = is_known ? known_lights_
                          : std::make_shared<SessionLights>(scene_, settings_, gather_lights(*scene_, settings_));
    }
    {
        const std::lock_guard lock(mutex_);
        lights_ = std::move(lights);
        sampling_start_ = clock::now();
    }
    if (even_samples(settings_) < settings_.samples)
        render_adaptively();
    else
        render_round({.film = film_, .seed = settings_.seed, .sees_centers = true}, settings_.samples);
}

void Session::render_adaptively() {
    const bool analytic = settings_.integrator == Integrator::analytic;
    const std::uint32_t whole = even_samples(settings_), half = whole / 2;
    Film other_film(film_.width(), film_.height(),
                    {.own_sums = film_.keeps_own_sums(),
                     .surface_passes = film_.keeps_surface_passes(),
                     .mattes = film_.keeps_mattes(),
                     .named_passes = film_.named_passes()});
    std::array<std::vector<Pilot>, 2> pilot;
    // Monte Carlo's samples know nothing of those that decide on them; the analytic integrator's complete each other.
    const auto round_of = [&](std::uint32_t number, Film& film) {
        return Round{.film = film, .seed = hash(settings_.seed, number), .first_index = analytic ? number * half : 0};
    };
    for (const std::uint32_t number : {0u, 1u}) {
        pilot[number].resize(squares_.size());
        Round round = round_of(number, number == 0 ? film_ : other_film);
        round.pilot = pilot[number];
        round.sees_centers = number == 0;
        if (!render_round(round, half)) {
            if (number == 1) film_.add(other_film);
            return;
        }
    }
    const float error = 0.01f * settings_.error_budget_percent;
    const float half_error = film_.squared_error_beside(other_film, denoised_part_);
    const auto [further, half_weight] =
        sample_counts(pilot, squares_, filter_.reach_px(), half_error, error, whole, settings_.samples);
    // What a pixel weighs in all is how many samples it has.
    std::array<std::vector<float>, 2> weights;
    std::vector<float> weight_left;
    for (int y = 0; y < film_.height(); ++y) {
        for (int x = 0; x < film_.width(); ++x) {
            const std::size_t square = squares_.index(x + filter_.reach_px(), y + filter_.reach_px());
            const auto all = static_cast<float>(whole + further[square]);
            for (const std::size_t number : {0, 1}) weights[number].push_back(all * half_weight[number][square]);
            weight_left.push_back(all - weights[0].back() - weights[1].back());
        }
    }
    film_.merge(other_film, weights[0], weights[1]);
    total_pixel_samples_ = pixel_samples_done_ + std::accumulate(further.begin(), further.end(), std::uint64_t{0});
    Round rest = round_of(2, film_);
    rest.counts = further, rest.weights = weight_left;
    if (render_round(rest, *std::ranges::max_element(further))) samples_done_ = settings_.samples;
}

}  // namespace pivot
