// Light samples: a path's vertex, one light, and the ray that decides. The first vertices of many paths are sampled
// together, in SIMD batches and ray packets.
#pragma once

#include "core/film/film.h"
#include "core/integrators/light_choice.h"
#include "core/integrators/light_sampler.h"
#include "core/sampling/sobol.h"
#include "core/scene/scene.h"

namespace pivot {

/// With more lights than this, a first vertex samples that many of them, chosen by their importance; with fewer, all.
inline constexpr std::size_t max_light_samples = 8;

/// Sampler dimensions of one bounce: the BSDF's two, the choice of lights, then one per light sample.
struct Dimensions {
    std::uint32_t base;

    explicit Dimensions(std::uint32_t bounce) : base(1 + bounce * (3 + max_light_samples)) {}

    std::uint32_t lobe() const { return base; }
    std::uint32_t direction() const { return base + 1; }
    std::uint32_t light_choice() const { return base + 2; }
    std::uint32_t light_place(std::size_t light_sample) const {
        return base + 3 + static_cast<std::uint32_t>(light_sample);
    }
};

/// A path's vertex: what its light samples and its BSDF sample both need.
struct Vertex {
    Sampler sampler;
    SurfacePoint point;
    Surface surface;
    Dimensions dimensions;
    std::size_t light_samples;  ///< as many as there are lights: one of each; fewer: as chosen
};

/// How many samples of this light a vertex takes, on average.
float expected_samples(const Scene& scene, const Vertex& vertex, std::size_t light);

/// MIS by the balance heuristic.
inline float balance(float pdf, float other_pdf) { return pdf / (pdf + other_pdf); }

/// Light samples that wait for their rays: what each adds to its vertex' radiance if its ray is free.
struct LightSamples {
    std::vector<Ray> rays;
    std::vector<std::size_t> vertices;
    std::vector<Rgb> radiance;
};

/// Light samples of each of the vertices but those that add nothing. shares[i]: whether vertex i's BSDF sample must be
/// traced for some light.
LightSamples sample_direct_light(const Scene& scene, LightSampling strategy, std::span<const Vertex> vertices,
                                 std::span<std::uint8_t> shares);

/// The same, traced and added to radiance[i].
void add_direct_light(const Scene& scene, LightSampling strategy, std::span<const Vertex> vertices,
                      std::span<Rgb> radiance, std::span<std::uint8_t> shares);

}  // namespace pivot
