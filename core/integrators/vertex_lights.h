// Which lights the vertices of a batch sample: all, or as many as the plan says, chosen among the lamps and, apart,
// among the triangles that shine.
#pragma once

#include "core/integrators/light_choice.h"
#include "core/scene/scene.h"

namespace pivot {

BouncePlan plan_bounce(const Scene& scene, std::uint32_t bounce);

/// A light for each vertex of a batch, and how many samples of it the vertex takes, on average.
struct LightPicks {
    std::array<std::size_t, batch_size> light;
    Lanes expected_samples{};  ///< 0: no sample
};

class VertexLights {
   public:
    VertexLights(const Scene& scene, const BouncePlan& plan, const VertexBatch& vertices);

    /// As many as the plan's samples, lamps first.
    std::span<const LightPicks> picks() const { return {picks_.data(), samples_}; }

    /// How many samples of a light a vertex takes, on average: also of one that it did not pick.
    float expected_samples(std::size_t lane, std::size_t light) const;

   private:
    std::size_t lamp_count_, lamp_samples_, samples_;
    std::optional<LightChoice> lamps_, triangles_;  ///< where not all of them are sampled
    std::array<LightPicks, max_light_samples> picks_;
};

}  // namespace pivot
