// Vertices and lights as the lanes of batches, and a light sample by each lane.
#pragma once

#include <span>

#include "core/integrators/area_sampling.h"
#include "core/integrators/joint_sampling.h"
#include "core/integrators/vertex.h"
#include "core/lights/light.h"
#include "core/simd/batch.h"

namespace pivot {

/// One value of each lane's, or the same for all.
template <class Value>
struct LaneValues {
    std::array<Value, batch_size> values;
    bool same;  ///< only the first counts

    template <class Field>
    Batch number(const Field& field) const {
        return same ? Batch(field(values[0])) : gather([&](std::size_t i) { return field(values[i]); });
    }
    template <class Field>
    Vec3b vector(const Field& field) const {
        return same ? broadcast(field(values[0])) : gather_vector([&](std::size_t i) { return field(values[i]); });
    }
};

struct VertexLanes {
    Vec3b position, normal_geometric;
    Frame<Batch> frame;
    Batch error_m;
    JointSurface<Batch> surface;
    Vec3b diffuse, schlick_f0, schlick_f90, dielectric_f0, dielectric_f90;
    Batch ior;
    bool has_dielectric;  ///< in any lane
    Batch glossy_probability;
    SamplerOf<WordBatch> sampler;

    /// Density of the surfaces' own samples.
    Batch bsdf_pdf_omega(const Vec3b& wi_local) const;

    /// The lobe's Fresnel reflectance for cos_oh of each lane.
    Vec3b fresnel(Batch cos_oh) const {
        Vec3b f = schlick_f0 + (schlick_f90 - schlick_f0) * schlick_weight(cos_oh);
        if (has_dielectric)
            f += dielectric_f0 + (dielectric_f90 - dielectric_f0) * fresnel_dielectric_weight(cos_oh, ior);
        return f;
    }
};

/// Lanes past the last vertex repeat it.
VertexLanes vertex_lanes(std::span<const Vertex> vertices);

/// What a light sample by each lane adds, if the way is free.
struct LaneSamples {
    Vec3b radiance;  ///< 0: nothing
    Vec3b wi;
    Batch reach_m;    ///< of its shadow ray
    BatchMask valid;  ///< elsewhere the lane must be sampled otherwise
    Batch pdf_omega;  ///< of area lights
};

/// Of cap-shaped lights, one a lane; u: of each lane.
LaneSamples sample_cap_lights(const VertexLanes& lanes, const LaneValues<const Light*>& lights, const Vec2b& u);

/// Of area lights.
LaneSamples sample_area_lights(const VertexLanes& lanes, const LaneValues<const AreaLight*>& lights, const Vec2b& u);

}  // namespace pivot
