// Rays that have met surfaces, and what these are made of there: where both integrators begin.
#pragma once

#include <span>

#include "core/bsdf/surface.h"
#include "core/scene/scene.h"
#include "core/shaders/surface_places.h"

namespace pivot {

/// How a ray arrives at a surface.
template <class T>
struct ArrivalOf {
    Vec3<T> direction;  ///< of the ray
    RayHitOf<T> hit;
    Word<T> material;
    T footprint_m;  ///< how wide the ray's part of a pixel is there
    Word<T> ray_kind;
};

using Arrival = ArrivalOf<float>;

/// A batch of arrivals: the surfaces, and what they are made of there. Lanes past the last arrival repeat it.
struct ArrivalBatch {
    SurfacePointOf<Batch> point;
    MaterialOf<Batch> material;
    DiffuseBumpOf<Batch> bump{};
};

/// How many of the first arrivals may share a batch: a program runs for one material.
std::size_t batch_count(const Scene& scene, std::span<const Arrival* const> arrivals);

/// What surfaces let through where arrivals meet them: as many as batch_count allows, at least one.
TransparencyOf<Batch> transparency_of(const Scene& scene, std::span<const Arrival* const> arrivals,
                                      std::uint32_t bounce, ProgramMemory& memory);

/// As many arrivals as batch_count allows, at least one.
ArrivalBatch make_arrivals(const Scene& scene, std::span<const Arrival* const> arrivals, std::uint32_t bounce,
                           ProgramMemory& memory);

}  // namespace pivot
