// A vertex of a path, and which of the sampler's dimensions it takes.
#pragma once

#include "core/sampling/sobol.h"
#include "core/scene/surface_point.h"

namespace pivot {

/// With more lamps than this, a first vertex samples that many of them, chosen by their importance; with fewer, all.
inline constexpr std::size_t max_lamp_samples = 8;
/// And so many of the triangles of emissive meshes, apart: however many shine, every lamp keeps its samples.
inline constexpr std::size_t max_triangle_samples = 4;
inline constexpr std::size_t max_light_samples = max_lamp_samples + max_triangle_samples;

/// Sampler dimensions of one bounce: the BSDF's two, the choice of lights, then one per light sample.
struct Dimensions {
    std::uint32_t base;

    explicit Dimensions(std::uint32_t bounce) : base(1 + bounce * (3 + max_light_samples)) {}

    std::uint32_t lobe() const { return base; }
    std::uint32_t direction() const { return base + 1; }
    std::uint32_t light_choice() const { return base + 2; }
    std::uint32_t light_place(std::size_t light_sample) const {
        return base + 3 + static_cast<std::uint32_t>(light_sample);
    }
};

/// A path's vertex: what its light samples and its BSDF sample both need.
struct Vertex {
    Sampler sampler;
    SurfacePoint point;
    Surface surface;
    Dimensions dimensions;
    std::size_t lamp_samples;      ///< as many as there are lamps: one of each; fewer: as chosen
    std::size_t triangle_samples;  ///< likewise
};

}  // namespace pivot
