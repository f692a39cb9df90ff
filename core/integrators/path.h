// What the parts of the path tracer share: paths between bounces, and what all batches of a render's part work on.
#pragma once

#include "core/bsdf/surface_parts.h"
#include "core/film/film.h"
#include "core/integrators/arrival.h"
#include "core/integrators/settings.h"
#include "core/integrators/vertex.h"

namespace pivot {

inline constexpr std::uint32_t first_roulette_bounce = 3;
inline constexpr float max_roulette_survival = 0.95f;

/// A path whose ray has met a surface.
template <class T>
struct PathOf {
    ArrivalOf<T> arrival;
    Vec3<T> throughput;  ///< up to the surface
    T spread;            ///< how much the footprint grows on the way, m for each m
    T emission_weight;   ///< of what the surface's program emits, beside light samples; first hits: 1 if passes tell
    Word<T> sample;      ///< of the caller's
};

using Path = PathOf<float>;

/// Paths that have reached the same bounce.
using Paths = std::vector<Path>;

/// By what the first vertex of a path reflects what comes by way of it: as much of it is diffuse and glossy.
using PassShares = LightSharesOf<float>;

/// What all batches of a render's part share.
struct Work {
    const Scene& scene;
    const RenderSettings& settings;
    std::span<const Sampler> samplers;
    std::span<Sample> samples;
    ProgramMemory& memory;
    std::span<float> min_pdf_omega;       ///< of each path's BSDF samples so far; empty where nothing is blurred
    std::span<std::uint8_t> is_diffused;  ///< whether anything diffuse reflected a path so far; empty: nobody asks
    std::span<SurfacePasses> passes{};    ///< of each sample that first meets a surface; empty: nobody asks
    std::span<PassShares> pass_shares{};  ///< likewise, of the path so far
    std::span<Rgb> feature_worths{};      ///< of each sample, how much mirrors and glass so far show of what a denoiser
                                          ///< goes by, 0 once that is known; empty: there is no denoiser
};

/// How much wider a footprint grows for each m past a BSDF sample: a sample stands for the directions that it is drawn
/// among.
template <class T>
T spread_of_sample(const RenderSettings& settings, const T& pdf_omega) {
    return T(part_of_pixel(settings)) * inverse_sqrt(max(T(pi<float>) * pdf_omega, T(1e-3f)));
}

/// Light that bounced may be bounded, at the price of some of it.
template <class T>
Vec3<T> bounded(const RenderSettings& settings, std::uint32_t bounce, const Vec3<T>& light) {
    if (bounce == 0 || !(settings.clamp_indirect > 0.0f)) return light;
    const T size = mean_component(abs(light)), limit(settings.clamp_indirect);
    return light * select(size > limit, limit / size, T(1));
}

/// Adds what a path brings by way of its vertex of that bounce.
inline void add_radiance(std::uint32_t bounce, const Rgb& light, Sample& sample) {
    sample.radiance += light;
    if (bounce > 0) sample.indirect += light;
}

/// Adds the same to what passes tell of the surface that the path first met.
inline void add_to_passes(const Work& work, std::uint32_t bounce, std::uint32_t sample, const Rgb& light) {
    if (sample >= work.passes.size()) return;
    const PassShares& shares = work.pass_shares[sample];
    const Rgb diffuse = shares.diffuse * light, glossy = shares.glossy * light;
    SurfacePasses& passes = work.passes[sample];
    (bounce == 0 ? passes.diffuse_direct : passes.diffuse_indirect) += diffuse;
    (bounce == 0 ? passes.glossy_direct : passes.glossy_indirect) += glossy;
    (bounce == 0 ? passes.transmission_direct : passes.transmission_indirect) += light - diffuse - glossy;
}

}  // namespace pivot
