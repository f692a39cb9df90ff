// Vertices of paths, over float or batches, and which of the sampler's dimensions they take.
#pragma once

#include <optional>

#include "core/bsdf/surface.h"
#include "core/geometry/surface_point.h"
#include "core/sampling/sobol.h"
#include "core/simd/pack.h"

namespace pivot {

/// With more lamps than this, a first vertex samples that many of them, chosen by their importance; with fewer, all.
inline constexpr std::size_t max_lamp_samples = 8;
/// And so many of the triangles of emissive meshes, apart: however many shine, every lamp keeps its samples.
inline constexpr std::size_t max_triangle_samples = 2;
inline constexpr std::size_t max_light_samples = max_lamp_samples + max_triangle_samples;

/// Sampler dimensions of one bounce: the BSDF's two, the choice of lights, one per light sample, the
/// world's.
struct Dimensions {
    std::uint32_t base;

    explicit Dimensions(std::uint32_t bounce) : base(1 + bounce * (4 + max_light_samples)) {}

    std::uint32_t lobe() const { return base; }
    std::uint32_t direction() const { return base + 1; }
    std::uint32_t light_choice() const { return base + 2; }
    std::uint32_t world() const { return base + 3 + max_light_samples; }
    /// Counted from the other end.
    std::uint32_t world_choice() const { return ~base; }
    std::uint32_t light_place(std::size_t light_sample) const {
        return base + 3 + static_cast<std::uint32_t>(light_sample);
    }
};

/// How all vertices of a bounce are sampled.
struct BouncePlan {
    std::uint32_t bounce;
    Dimensions dimensions;
    std::size_t lamp_samples;      ///< as many as there are lamps: one of each; fewer: as chosen
    std::size_t triangle_samples;  ///< likewise
};

/// A path's vertex: what its light samples and its BSDF sample both need.
template <class T>
struct VertexOf {
    SamplerOf<Word<T>> sampler;
    SurfacePointOf<T> point;
    SurfaceOf<T> surface;

    /// Whether light from wi may reach the viewer: from the side where both the shading and the true surface face the
    /// viewer, or, through the surface, from where neither does. Elsewhere light would leak.
    Mask<T> is_open_to(const Vec3<T>& wi) const {
        const Mask<T> faces = point.faces(wi), transmits = surface.transmits();
        return any(transmits) ? faces || (transmits && point.faces(-wi)) : faces;
    }
};

using Vertex = VertexOf<float>;

/// Vertices of one bounce side by side; lanes past `count` repeat the last.
class VertexBatch : public VertexOf<Batch> {
   public:
    VertexBatch(const SamplerOf<WordBatch>& samplers, const SurfacePointOf<Batch>& points,
                const MaterialOf<Batch>& materials, const DiffuseBumpOf<Batch>& bump, std::size_t count)
        : VertexOf<Batch>{samplers, points, make_surface(materials, points.wo_local)}, count_(count) {
        surface.bump = bump;
    }
    VertexBatch(const VertexOf<Batch>& vertices, std::size_t count) : VertexOf<Batch>(vertices), count_(count) {}

    std::size_t count() const { return count_; }
    BatchMask is_vertex() const { return first_lanes(count_); }

    /// One of them.
    const Vertex& lane(std::size_t i) const {
        constexpr std::size_t without_lobes = all_numbers<VertexOf> - max_lobes * all_numbers<LobeOf>,
                              with_one = without_lobes + all_numbers<LobeOf>;
        if (!lanes_) {
            const auto& lobes = surface.lobes;
            if (!any(lobes[0].kind > Batch(0.0f)))
                lanes_ = unpack<VertexOf, without_lobes>(*this);
            else
                lanes_ = any(lobes[1].kind > Batch(0.0f)) ? unpack<VertexOf>(*this) : unpack<VertexOf, with_one>(*this);
        }
        return (*lanes_)[i];
    }

   private:
    std::size_t count_;
    mutable std::optional<std::array<Vertex, batch_size>> lanes_;
};

}  // namespace pivot
