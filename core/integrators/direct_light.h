// Light samples: a path's vertex, one light, and the ray that decides. The first vertices of many paths are sampled
// together, in SIMD batches and ray packets.
#pragma once

#include "core/integrators/light_choice.h"
#include "core/integrators/light_sampler.h"
#include "core/integrators/vertex.h"
#include "core/scene/scene.h"

namespace pivot {

/// How many samples of this light a vertex takes, on average.
float expected_samples(const Scene& scene, const Vertex& vertex, std::size_t light);

/// MIS by the balance heuristic.
inline float balance(float pdf, float other_pdf) { return pdf / (pdf + other_pdf); }

/// Light samples of each of the vertices, which take the same number, added to radiance[i]. shares[i]: whether vertex
/// i's BSDF sample must be traced for some light.
void add_direct_light(const Scene& scene, LightSampling strategy, std::span<const Vertex> vertices,
                      std::span<Rgb> radiance, std::span<std::uint8_t> shares);

/// What a light sample adds to its vertex' radiance if its ray is free.
struct LightSample {
    Vec3f wi;
    Rgb radiance;
};

/// The light samples that add_direct_light traces, but those that add nothing.
std::vector<LightSample> sample_direct_light(const Scene& scene, LightSampling strategy,
                                             std::span<const Vertex> vertices, std::span<std::uint8_t> shares);

}  // namespace pivot
