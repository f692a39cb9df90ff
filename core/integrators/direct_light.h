// Light samples: a path's vertex, one light, and the ray that decides. The first vertices of many paths are sampled
// together, in SIMD batches and ray packets.
#pragma once

#include "core/film/film.h"
#include "core/integrators/light_sampler.h"
#include "core/sampling/sobol.h"
#include "core/scene/scene.h"

namespace pivot {

/// Sampler dimensions of one bounce: the BSDF's two, the choice of a light, then one per light.
struct Dimensions {
    std::uint32_t base;

    Dimensions(std::uint32_t bounce, std::size_t light_count)
        : base(1 + bounce * (3 + static_cast<std::uint32_t>(light_count))) {}

    std::uint32_t lobe() const { return base; }
    std::uint32_t direction() const { return base + 1; }
    std::uint32_t light_choice() const { return base + 2; }
    std::uint32_t light_place(std::size_t light) const { return base + 3 + static_cast<std::uint32_t>(light); }
};

/// A path's vertex: what its light samples and its BSDF sample both need.
struct Vertex {
    Sampler sampler;
    SurfacePoint point;
    Surface surface;
    Dimensions dimensions;
    bool samples_all_lights;
};

/// Whether BSDF samples take part in sampling this light. Where one light stands for all they do even by strategy
/// joint: the choice is by irradiance, and a highlight of a light that is seldom chosen is the BSDF's to find.
bool shares_with_bsdf(const Vertex& vertex, const LightSampler& light, LightSampling strategy);

/// MIS by the balance heuristic.
inline float balance(float pdf, float other_pdf) { return pdf / (pdf + other_pdf); }

/// What a light sample adds if its ray is free.
struct LightCandidate {
    Rgb radiance{0.0f};  ///< 0: there is no ray to trace
    Ray ray;
    bool shares_with_bsdf = false;  ///< whether BSDF samples must be traced for this light
};

/// One sample of a light that is chosen with the given probability.
LightCandidate sample_light_at(const Scene& scene, LightSampling strategy, const Vertex& vertex, std::size_t light,
                               float probability);

/// One sample of every light for each of the vertices, added to radiance[i]. shares[i]: whether vertex i's BSDF sample
/// must be traced for some light.
void add_all_lights(const Scene& scene, LightSampling strategy, std::span<const Vertex> vertices,
                    std::span<Rgb> radiance, std::span<std::uint8_t> shares);

}  // namespace pivot
