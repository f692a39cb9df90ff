// Light samples: a batch of paths' vertices, one light for each lane, and the rays that decide.
#pragma once

#include "core/integrators/light_lanes.h"
#include "core/integrators/settings.h"
#include "core/scene/scene.h"

namespace pivot {

BouncePlan plan_bounce(const Scene& scene, std::uint32_t bounce);

/// How many samples of this light a vertex takes, on average.
float expected_samples(const Scene& scene, const BouncePlan& plan, const Vertex& vertex, std::size_t light);

/// MIS by the balance heuristic.
template <class T>
T balance(T pdf, T other_pdf) {
    return pdf / (pdf + other_pdf);
}

/// Which lanes' BSDF samples must be traced for some lamp.
using LaneFlags = std::array<std::uint8_t, batch_size>;

/// What the vertices reflect of the lights that they see.
Vec3b direct_light(const Scene& scene, LightSampling strategy, const BouncePlan& plan, const VertexBatch& vertices,
                   LaneFlags& shares);

/// The light samples that direct_light traces, but those that add nothing.
std::vector<LightSample> light_samples_of(const Scene& scene, LightSampling strategy, const BouncePlan& plan,
                                          const VertexBatch& vertices, LaneFlags& shares);

}  // namespace pivot
