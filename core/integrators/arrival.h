// Rays that have met surfaces, and what these are made of there: where both integrators begin.
#pragma once

#include <span>
#include <vector>

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

/// What a ray of a kind meets, as a Visibility: rays through a surface are of one kind, however they left it.
inline WordBatch met_by(const WordBatch& ray_kind) {
    const WordBatch through = ray_kind & WordBatch(transmission_ray), no(0u);
    return select(equal(through, no), ray_kind & WordBatch(camera_ray | diffuse_ray | glossy_ray), through);
}
inline std::uint32_t met_by(std::uint32_t ray_kind) {
    return ray_kind & transmission_ray ? std::uint32_t{transmission_ray}
                                       : ray_kind & (camera_ray | diffuse_ray | glossy_ray);
}
static_assert(std::uint32_t{visible_to_camera} == camera_ray && std::uint32_t{visible_to_diffuse} == diffuse_ray &&
              std::uint32_t{visible_to_glossy} == glossy_ray &&
              std::uint32_t{visible_to_transmission} == transmission_ray);

/// A batch of arrivals: the surfaces, and what they are made of there. Lanes past the last arrival repeat it.
struct ArrivalBatch {
    SurfacePointOf<Batch> point;
    MaterialOf<Batch> material;
    DiffuseBumpOf<Batch> bump{};
};

/// How many of the first arrivals may share a batch: a program runs for one material.
std::size_t batch_count(const Scene& scene, std::span<const Arrival* const> arrivals);

/// Calls visit(arrivals, items) with as many items, at least one, as batch_count allows, until all had their turn.
/// items: what materials have in common stands together. arrival_of(item): its Arrival.
template <class Item, class ToArrival, class Visit>
void for_each_arrival_batch(const Scene& scene, std::span<const Item> items, const ToArrival& arrival_of,
                            const Visit& visit) {
    std::vector<const Arrival*> arrivals;
    for (const Item& item : items) arrivals.push_back(&arrival_of(item));
    for (std::size_t first = 0, count = 0; first < items.size(); first += count) {
        const auto rest = std::span<const Arrival* const>(arrivals).subspan(first);
        count = batch_count(scene, rest);
        visit(rest.first(count), items.subspan(first, count));
    }
}

/// What surfaces let through where arrivals meet them: as many as batch_count allows, at least one.
TransparencyOf<Batch> transparency_of(const Scene& scene, std::span<const Arrival* const> arrivals,
                                      std::uint32_t bounce, ProgramMemory& memory);

/// As many arrivals as batch_count allows, at least one.
ArrivalBatch make_arrivals(const Scene& scene, std::span<const Arrival* const> arrivals, std::uint32_t bounce,
                           ProgramMemory& memory);

}  // namespace pivot
