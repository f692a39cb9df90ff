// What the artist sets.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/film/pixel_filter.h"
#include "core/film/shadow_catcher.h"

namespace pivot {

enum class Integrator { monte_carlo, analytic };

/// How Monte Carlo finds light: jointly with the BSDF by the exact core, jointly by one SPTD lobe and MIS, or by light
/// and BSDF samples, together or alone.
enum class LightSampling { joint, sptd, mis, light, bsdf };

/// How the analytic integrator integrates a GGX lobe over a light: the cheapest that meets the error budget, the exact
/// core, one SPTD lobe, or one linearly transformed cosine.
enum class AnalyticMethod { automatic, exact, sptd, ltc };

/// What the analytic integrator takes for visibility: rays to the lights, the bent cones of the vertices, or nothing.
enum class Occlusion { ray_traced, bent_cone, none };

/// What the analytic integrator shows of light that comes by way of other surfaces: nothing, or that of virtual
/// spherical Gaussian lights.
enum class Indirect { none, virtual_lights };

/// How virtual lights are integrated: by the exact core's caps where they matter, all by the widened lobe of
/// [Tokuyoshi24], or all by the formulas of [Tokuyoshi15]; the last two for comparison.
enum class VirtualLightMethod { automatic, widened, anisotropic };

/// Where a pass of mist is from 0 to 1, in m along rays from the camera, and by which power.
struct Mist {
    float start_m = 5.0f, depth_m = 25.0f, falloff = 2.0f;
};

/// How often a path may be reflected or scattered in each way; 0: direct light only of what it comes to so.
struct BounceLimits {
    std::uint32_t diffuse = ~0u, glossy = ~0u, transmission = ~0u, scatter = ~0u;

    bool operator==(const BounceLimits&) const = default;
};

/// What is kept of each AOV: its colour, and the share of the pixel where shaders give it.
inline constexpr std::size_t colors_of_aov = 2;

struct RenderSettings {
    Integrator integrator = Integrator::monte_carlo;
    LightSampling light_sampling = LightSampling::joint;
    std::uint32_t samples = 64;
    bool adaptive = false;  ///< samples go where they help the picture most, until it meets the error budget
    std::uint32_t seed = 0;
    std::uint32_t max_bounces = 4;        ///< 0: direct light only
    BounceLimits bounce_limits{};         ///< of each kind, beside
    std::uint32_t max_passages = 8;       ///< transparent surfaces that a path and a shadow ray from it pass together
    std::uint32_t max_path_passages = 9;  ///< and that a path passes: of what is behind it shows only what shines
    float clamp_indirect = 0.0f;          ///< the mean over colours that light which bounced adds at once; 0: no bound
    float filter_glossy = 0.0f;           ///< blurs what is met after BSDF samples of a density below this; 0: nothing
    float error_budget_percent = 2.0f;    ///< analytic: the steps a penumbra may show; adaptive: what noise may be left
    AnalyticMethod analytic_method = AnalyticMethod::automatic;
    Occlusion occlusion = Occlusion::ray_traced;
    Indirect indirect = Indirect::none;
    std::uint32_t virtual_lights = 4096;  ///< about so many cells of light of either kind
    VirtualLightMethod virtual_light_method = VirtualLightMethod::automatic;
    float time_limit_s = 0.0f;  ///< 0: none
    int threads = 0;            ///< 0: all cores
    PixelFilterShape filter_shape = PixelFilterShape::blackman_harris;
    float filter_width_px = 1.5f;
    bool transparent_film = false;
    bool denoising_passes = false;   ///< whether what a denoiser works on is kept
    bool surface_passes = false;     ///< whether what passes tell of surfaces and their light is
    bool mattes = false;             ///< whether what Cryptomatte's passes rank is
    int uv_attribute = -1;           ///< that the pass shows; -1: none
    std::uint32_t light_groups = 0;  ///< whose light passes show apart
    std::uint32_t aovs = 0;          ///< values of shaders that passes show
    Mist mist{};
    bool shadow_catchers = false;       ///< whether what others do to their light is told
    float occlusion_distance_m = 0.0f;  ///< how far the pass of ambient occlusion looks; 0: it is not asked for

    std::size_t named_passes() const { return first_catcher_pass() + (shadow_catchers ? catcher_pass::count : 0); }
    /// What is kept for shadow catchers comes behind the passes that an artist names.
    std::size_t first_catcher_pass() const { return std::size_t{light_groups} + colors_of_aov * aovs; }
};

/// What every pixel has at least: all, or the pilot of adaptive sampling, which needs more to be worth it.
inline std::uint32_t even_samples(const RenderSettings& settings) {
    const std::uint32_t pilot = std::clamp(settings.samples / 64, 16u, 32u) / 2 * 2;
    return settings.adaptive ? std::min(settings.samples, pilot) : settings.samples;
}

/// How much of a pixel a sample stands for, along an edge.
inline float part_of_pixel(const RenderSettings& settings) {
    return std::max(0.125f, 1.0f / std::sqrt(static_cast<float>(settings.samples)));
}

}  // namespace pivot
