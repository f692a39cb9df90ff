// A light sample by each lane of a batch of vertices.
#pragma once

#include "core/integrators/joint_sampling.h"
#include "core/integrators/vertex.h"
#include "core/lights/light.h"

namespace pivot {

/// What light samples add, and the rays that decide.
template <class T>
struct LightSampleOf {
    Vec3<T> radiance;  ///< 0: nothing
    Vec3<T> wi;
    T reach_m;  ///< of the shadow ray
};

using LightSample = LightSampleOf<float>;

/// The lane's light samples and, for weights, how they were drawn.
struct LaneSamples {
    LightSampleOf<Batch> sample;
    BatchMask valid;       ///< elsewhere the lane must be sampled otherwise
    Batch pdf_omega;       ///< of area lights
    BatchMask needs_bsdf;  ///< whether BSDF samples must share
};

/// Samples of cap-shaped lights, one a lane, jointly with the lobes; u: of each lane.
LaneSamples sample_cap_lights(const VertexBatch& vertices, const std::array<const Light*, batch_size>& lights,
                              const Vec2b& u);

/// The same for surfaces with lobes beside the base (see cap_mixture.h), which has_common_highlights().
LaneSamples sample_cap_lights_by_lobes(const VertexBatch& vertices, const std::array<const Light*, batch_size>& lights,
                                       const Vec2b& u);

/// Samples of area lights, even by area: or, triangles where they are near and lamps where wanted, jointly with the
/// lobes.
LaneSamples sample_area_lights(const VertexBatch& vertices, const std::array<const Light*, batch_size>& lights,
                               const Vec2b& u, bool lamps_jointly);

}  // namespace pivot
