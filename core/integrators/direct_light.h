// Light samples: a batch of paths' vertices, one light for each lane, and the rays that decide.
#pragma once

#include "core/bsdf/surface_parts.h"
#include "core/integrators/arrival.h"
#include "core/integrators/group_light.h"
#include "core/integrators/light_lanes.h"
#include "core/integrators/passage.h"
#include "core/integrators/settings.h"
#include "core/integrators/vertex_lights.h"

namespace pivot {

/// MIS by the balance heuristic.
template <class T>
T balance(T pdf, T other_pdf) {
    return T(1) / (T(1) + other_pdf / pdf);
}

/// A lamp that a vertex sampled, and for which its BSDF sample counts too: over expected_samples, as it does so only
/// where the lamp was picked.
struct SharedLamp {
    std::size_t light;
    float expected_samples;
};

/// Each lane's.
class SharedLamps {
   public:
    void add(std::size_t lane, const SharedLamp& lamp) { lamps_[lane][count_[lane]++] = lamp; }
    std::span<const SharedLamp> at(std::size_t lane) const { return {lamps_[lane].data(), count_[lane]}; }

   private:
    std::array<std::array<SharedLamp, max_lamp_samples>, batch_size> lamps_;
    std::array<std::size_t, batch_size> count_{};
};

/// What the vertices reflect of the lights that they see, by light samples; shared: what is left to BSDF samples.
/// shares: by which reflection; groups: to be told of which light group; both may be null.
Vec3b direct_light(const Scene& scene, LightSampling strategy, const BouncePlan& plan, const VertexBatch& vertices,
                   const VertexLights& lights, SharedLamps& shared, const ShadowPath& shadow_path,
                   ProgramMemory& memory, LightSharesOf<Batch>* shares = nullptr, GroupLight* groups = nullptr);

/// The light samples that direct_light traces on surfaces that every light is for, but those that add nothing.
std::vector<LightSample> light_samples_of(const Scene& scene, LightSampling strategy, const BouncePlan& plan,
                                          const VertexBatch& vertices, const VertexLights& lights, SharedLamps& shared,
                                          ProgramMemory& memory);

}  // namespace pivot
