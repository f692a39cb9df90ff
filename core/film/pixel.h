// What a pixel keeps of its samples: sums with their weights, for what a camera sees, for a denoiser and for passes of
// surfaces.
#pragma once

#include <optional>
#include <span>

#include "core/math/vector.h"

namespace pivot {

/// One camera sample, averaged over samples.
struct Sample {
    Rgb radiance{0.0f};
    float alpha = 1.0f;
    Vec3f normal{0.0f};            ///< world space, at the first hit
    Rgb albedo{0.0f};              ///< of the diffuse lobe at the first hit
    Rgb emission{0.0f};            ///< of the first hit itself
    Rgb volume_direct{0.0f};       ///< what media scatter to the camera of light that comes to them straight
    Rgb volume_indirect{0.0f};     ///< and of other light
    Rgb indirect{0.0f};            ///< of radiance, what came by way of other surfaces and media
    Rgb denoising_albedo{0.0f};    ///< Monte Carlo, for a denoiser: of all lobes, at most 1, of the first surface that
                                   ///< is not like a mirror or clear glass, as those before it show it
    Vec3f denoising_normal{0.0f};  ///< likewise
    Rgb method{0.0f};              ///< analytic: colour of the methods that shaded the first hit
    float error = 0.0f;            ///< analytic: predicted for what is in closed form, as radiance
    float shadow_variance = 0.0f;  ///< analytic: of what this sample's rays say of shadows, radiance squared
};

/// What passes tell of the surfaces that a camera sees and of the light that these send to it, averaged over samples.
/// Kept only where it is asked for.
struct SurfacePasses {
    // Light by what reflected it last, straight from where it shines and by way of others.
    Rgb diffuse_direct{0.0f}, diffuse_indirect{0.0f};
    Rgb glossy_direct{0.0f}, glossy_indirect{0.0f};
    Rgb transmission_direct{0.0f}, transmission_indirect{0.0f};
    Rgb environment{0.0f};        ///< the world as it is seen
    Rgb ambient_occlusion{0.0f};  ///< what a white sky within a distance would bring to white surfaces
    // What the surfaces send to the camera where all light around is 1.
    Rgb diffuse_color{0.0f}, glossy_color{0.0f}, transmission_color{0.0f};
    Vec3f uv{0.0f};         ///< the third is 1 on surfaces
    float nearness = 0.0f;  ///< how much the mist leaves of what is seen
    // How far what is seen was from here, and will have come, in pixels: of a camera that does not blur motion.
    Vec2f from_before{0.0f}, to_after{0.0f};
    float moving_weight = 0.0f;  ///< 1 where the two are known
};

/// Errors of noise are relative to a pixel's radiance, or to this where it is darker.
inline constexpr float least_radiance_of_error = 0.1f;

/// What the ray through the pixel's centre meets; never averaged.
struct CenterSample {
    float depth_m = 1e10f;  ///< along the camera's axis; 1e10 where there is nothing, as Cycles writes it
    Vec3f position{0.0f};
};

/// Samples, each times its weight for a pixel.
struct WeightedSum {
    Sample sum{.alpha = 0.0f};
    float weight = 0.0f;
    float squared_weight = 0.0f;
    float told_weight = 0.0f;  ///< analytic: squared, of samples that tell how far others in their square differ
    float variance = 0.0f;     ///< analytic: of the radiance in their squares, times told_weight

    /// Adds samples of one square by their weights, all of it times `scale`. radiance_variance: of these samples, if
    /// known.
    void add(std::span<const Sample> samples, std::span<const float> weights, std::optional<float> radiance_variance,
             float scale);
    void add(const WeightedSum& other, float scale);

    /// What a sum is multiplied by for its mean; 0 without samples.
    float per_weight() const { return weight > 0.0f ? 1.0f / weight : 0.0f; }
};

struct Pixel {
    WeightedSum samples;
    CenterSample center;
};

/// What a denoiser works on: sums of a pixel's own samples, which no other pixel shares. Where neighbours share samples
/// their noise looks alike, and a denoiser takes it for what is seen.
struct OwnSum {
    Rgb radiance{0.0f}, indirect{0.0f}, albedo{0.0f};
    Vec3f normal{0.0f};
    float weight = 0.0f;
    float told_weight = 0.0f;                                ///< squared, of samples that tell how far others differ
    float direct_variance = 0.0f, indirect_variance = 0.0f;  ///< of a sample, over its colours, times told_weight

    /// Adds samples that are spread evenly together, all of them times `scale`.
    void add(std::span<const Sample> samples, float scale);
    void add(const OwnSum& other, float scale);
    /// What a sum is multiplied by for its mean; 0 without samples.
    float per_weight() const { return weight > 0.0f ? 1.0f / weight : 0.0f; }
};

/// A pixel's sums of what passes tell of surfaces, weighted as its samples, and what the ray through its centre meets.
struct SurfacePixel {
    SurfacePasses sum;
    float object_index = 0.0f, material_index = 0.0f;

    /// Adds samples of one square by their weights, all of it times `scale`.
    void add(std::span<const SurfacePasses> samples, std::span<const float> weights, float scale);
    void add(const SurfacePixel& other, float scale);
};

/// What a film keeps beside its samples, at the price of memory.
struct FilmParts {
    bool own_sums = false;  ///< for a denoiser
    bool surface_passes = false;
    bool mattes = false;
    std::size_t named_passes = 0;  ///< those that an artist names, each a colour
};

/// Adds samples of one square by their weights, all of it times `scale`: as many colours of each as there are sums.
void add_named(std::span<const Rgb> samples, std::span<const float> weights, float scale, std::span<Rgb> sums);

}  // namespace pivot
