// What BSDF samples meet of lights that their vertices sample, too: each weighted beside the light samples.
#pragma once

#include "core/integrators/direct_light.h"
#include "core/integrators/fog.h"

namespace pivot {

/// Of the lamps that the vertex of a path, a batch's lane, sampled on the sample's way on. fog: may be null.
Rgb lamps_met(const Work& work, Fog* fog, std::uint32_t bounce, std::span<const SharedLamp> lamps, const Vertex& vertex,
              const Vec3f& wi, float bsdf_pdf_omega, const WayOn& way, const Path& path, std::size_t lane);

/// The weight of the emission that a lane's BSDF sample meets on a surface: less than 1 if its triangle is sampled too.
float emission_weight(const Work& work, std::uint32_t bounce, const VertexBatch& vertices, const VertexLights& lights,
                      std::size_t lane, const Vec3f& wi, float bsdf_pdf_omega, const RayHit& hit);

/// Whether what a surface shines counts where a BSDF sample from an instance meets it.
bool counts_where_it_is_met(const Scene& scene, const RayHit& hit, std::uint32_t instance);

/// What the BSDF sample of a path, a batch's lane, meets of surfaces whose light has blockers of its own: others are
/// not in its way, so that all along the ray count.
Rgb shining_past_others_met(const Work& work, Fog* fog, std::uint32_t bounce, const Path& path,
                            const VertexBatch& vertices, const VertexLights& lights, std::size_t lane, const Ray& from,
                            std::uint32_t ray_kind, float bsdf_pdf_omega);

/// The world's light on the way to a bounce, weighted where it is sampled too.
Vec3b world_met(const Work& work, const Vec3b& wi, const Batch& bsdf_pdf_omega, const WordBatch& ray_kind,
                std::uint32_t bounce);

}  // namespace pivot
