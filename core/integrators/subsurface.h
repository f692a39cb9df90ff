// Light that walks beneath a surface: a path that enters scatters in the medium there until it meets the surface of the
// same object again, and goes on from there as from a white Lambert lobe.
//
// [Chiang16]   Practical and Controllable Subsurface Scattering for Production Path Tracing
// [Wyman89]    Similarity relations for the interaction parameters in radiation transport
#pragma once

#include "core/integrators/path.h"

namespace pivot {

/// Lets paths walk that enter by the u_lobe by which their surfaces are sampled, and appends them, as they arrive where
/// they come out from outside, to `exits`. Returns the lanes that entered.
BatchMask walk_beneath(const Work& work, const BouncePlan& plan, std::span<const Path> paths,
                       const VertexBatch& vertices, const Batch& u_lobe, Paths& exits);

/// How vertices are sampled where paths come out at a bounce: as those where they enter, by other numbers.
inline BouncePlan plan_exits(BouncePlan plan) {
    plan.dimensions = Dimensions(plan.bounce + (1u << 24));
    return plan;
}

/// What surfaces are made of where light comes out of them: as many arrivals as a batch may have, past the last it
/// again.
MaterialOf<Batch> exit_material(const Scene& scene, std::span<const Arrival* const> arrivals);

}  // namespace pivot
