#include "core/film/passes.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace pivot {
namespace {

void put(const Vec3f& v, float* out) { out[0] = v.x, out[1] = v.y, out[2] = v.z; }

void write_combined(const Pixel& pixel, const OwnSum&, const SurfacePixel&, float* out) {
    put(pixel.samples.sum.radiance * pixel.samples.per_weight(), out);
    out[3] = pixel.samples.sum.alpha * pixel.samples.per_weight();
}

/// A sum of three channels as its mean.
template <Vec3f Sample::*sum>
void write_mean(const Pixel& pixel, const OwnSum&, const SurfacePixel&, float* out) {
    put(pixel.samples.sum.*sum * pixel.samples.per_weight(), out);
}

template <Vec3f OwnSum::*sum>
void write_own(const Pixel&, const OwnSum& own, const SurfacePixel&, float* out) {
    put(own.*sum * own.per_weight(), out);
}

void write_noisy(const Pixel& pixel, const OwnSum& own, const SurfacePixel&, float* out) {
    put(own.radiance * own.per_weight(), out);
    out[3] = pixel.samples.sum.alpha * pixel.samples.per_weight();
}

/// A sum over surfaces as its mean.
template <Vec3f SurfacePasses::*sum>
void write_surfaces(const Pixel& pixel, const OwnSum&, const SurfacePixel& surfaces, float* out) {
    put(surfaces.sum.*sum * pixel.samples.per_weight(), out);
}

/// Light over the colour that reflected it, which it is to be multiplied by again; 0 where that has none.
template <Vec3f SurfacePasses::*light, Vec3f SurfacePasses::*color>
void write_uncolored(const Pixel&, const OwnSum&, const SurfacePixel& surfaces, float* out) {
    const Vec3f &l = surfaces.sum.*light, &c = surfaces.sum.*color;
    for (int i = 0; i < 3; ++i) out[i] = c[i] != 0.0f ? l[i] / c[i] : 0.0f;
}

void write_mist(const Pixel& pixel, const OwnSum&, const SurfacePixel& surfaces, float* out) {
    *out = std::clamp(1.0f - surfaces.sum.nearness * pixel.samples.per_weight(), 0.0f, 1.0f);
}

/// Where it was, less where it is, and that less where it will be, of the surfaces alone. [Cycles 4.5
/// kernel/geom/primitive.h, primitive_motion_vector]
void write_vector(const Pixel&, const OwnSum&, const SurfacePixel& surfaces, float* out) {
    const SurfacePasses& sum = surfaces.sum;
    const float per_weight = sum.moving_weight > 0.0f ? 1.0f / sum.moving_weight : 0.0f;
    const Vec2f before = -per_weight * sum.from_before, after = -per_weight * sum.to_after;
    out[0] = before.x, out[1] = before.y, out[2] = after.x, out[3] = after.y;
}

void write_depth(const Pixel& pixel, const OwnSum&, const SurfacePixel&, float* out) { *out = pixel.center.depth_m; }

/// The error predicted of an analytic pixel, relative to its radiance, or to least_radiance where it is darker: that of
/// the closed forms, and that of evenly spread samples whose values differ, by shadows and edges in the pixel.
float predicted_error(const Pixel& pixel) {
    constexpr float edges = 0.77f;      // of how samples in a square differ; the rest varies smoothly and costs little
    constexpr float deviations = 2.0f;  // 19 pixels in 20 are within them
    constexpr float least_radiance = 1e-3f;
    const WeightedSum& samples = pixel.samples;
    if (!(samples.weight > 0.0f)) return 0.0f;
    const float n = samples.weight, mean = mean_component(samples.sum.radiance) / n;
    // One sample knows of its own rays only.
    const float spread = samples.told_weight > 0.0f ? edges * samples.variance / samples.told_weight : 0.0f;
    const float variance = std::max(spread, samples.sum.shadow_variance / n) * samples.squared_weight / n;
    const float error = samples.sum.error / n + deviations * std::sqrt(variance) * std::pow(n, -0.75f);
    return error / std::max(std::abs(mean), least_radiance);
}

/// How far noise takes a pixel's light from its mean, squared: that of a sample over how many the pixel is of, as its
/// filter weighs them. 0 where no two samples came together.
template <float OwnSum::*variance>
void write_variance(const Pixel& pixel, const OwnSum& own, const SurfacePixel&, float* out) {
    const float of_sample = own.told_weight > 0.0f ? own.*variance / own.told_weight : 0.0f;
    *out = of_sample * pixel.samples.squared_weight * sqr(pixel.samples.per_weight());
}

constexpr FilmParts own_sums{.own_sums = true}, surface_passes{.surface_passes = true};
using S = SurfacePasses;

constexpr Pass passes[] = {
    {"Combined", 4, write_combined},
    {"Depth", 1, write_depth},
    {"Normal", 3, write_mean<&Sample::normal>},
    {"Position", 3,
     [](const Pixel& pixel, const OwnSum&, const SurfacePixel&, float* out) { put(pixel.center.position, out); }},
    {"DiffCol", 3, write_mean<&Sample::albedo>},
    {"Emit", 3, write_mean<&Sample::emission>},
    {"VolumeDir", 3, write_mean<&Sample::volume_direct>},
    {"VolumeInd", 3, write_mean<&Sample::volume_indirect>},
    {"Indirect", 3, write_mean<&Sample::indirect>},
    {"Method", 3, write_mean<&Sample::method>},
    {"Error", 1,
     [](const Pixel& pixel, const OwnSum&, const SurfacePixel&, float* out) { *out = predicted_error(pixel); }},
    {"Noisy Image", 4, write_noisy, own_sums},
    {"Noisy Indirect", 3, write_own<&OwnSum::indirect>, own_sums},
    {"Direct Variance", 1, write_variance<&OwnSum::direct_variance>, own_sums},
    {"Indirect Variance", 1, write_variance<&OwnSum::indirect_variance>, own_sums},
    {"Denoising Albedo", 3, write_own<&OwnSum::albedo>, own_sums},
    {"Denoising Normal", 3, write_own<&OwnSum::normal>, own_sums},
    {"DiffDir", 3, write_uncolored<&S::diffuse_direct, &S::diffuse_color>, surface_passes},
    {"DiffInd", 3, write_uncolored<&S::diffuse_indirect, &S::diffuse_color>, surface_passes},
    {"Diffuse Color", 3, write_surfaces<&S::diffuse_color>, surface_passes},
    {"GlossDir", 3, write_uncolored<&S::glossy_direct, &S::glossy_color>, surface_passes},
    {"GlossInd", 3, write_uncolored<&S::glossy_indirect, &S::glossy_color>, surface_passes},
    {"GlossCol", 3, write_surfaces<&S::glossy_color>, surface_passes},
    {"TransDir", 3, write_uncolored<&S::transmission_direct, &S::transmission_color>, surface_passes},
    {"TransInd", 3, write_uncolored<&S::transmission_indirect, &S::transmission_color>, surface_passes},
    {"TransCol", 3, write_surfaces<&S::transmission_color>, surface_passes},
    {"Env", 3, write_surfaces<&S::environment>, surface_passes},
    {"AO", 3, write_surfaces<&S::ambient_occlusion>, surface_passes},
    {"UV", 3, write_surfaces<&S::uv>, surface_passes},
    {"Mist", 1, write_mist, surface_passes},
    {"Vector", 4, write_vector, surface_passes},
    {"IndexOB", 1,
     [](const Pixel&, const OwnSum&, const SurfacePixel& surfaces, float* out) { *out = surfaces.object_index; },
     surface_passes},
    {"IndexMA", 1,
     [](const Pixel&, const OwnSum&, const SurfacePixel& surfaces, float* out) { *out = surfaces.material_index; },
     surface_passes},
};

}  // namespace

const Pass& find_pass(std::string_view name) {
    std::string known;
    for (const Pass& pass : passes) {
        if (pass.name == name) return pass;
        known += (known.empty() ? "" : ", ") + std::string(pass.name);
    }
    throw std::invalid_argument("there is no pass '" + std::string(name) + "'; choose one of " + known);
}

}  // namespace pivot
