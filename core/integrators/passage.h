// Rays that go straight on through transparent surfaces. What lets all light through in part is one surface among
// others of a path: the path stays there, or passes, or becomes two. Light that a vertex samples is weakened on its
// way, and BSDF samples go the same way, so that what they meet behind is weighted as if nothing were between.
#pragma once

#include <functional>

#include "core/integrators/arrival.h"
#include "core/sampling/sobol.h"

namespace pivot {

/// A surface on a ray's straight way.
struct Passage {
    std::uint32_t ray;  ///< of those asked for
    RayHit hit;
    std::uint32_t material;
    std::uint32_t ray_kind;  ///< with what was passed before
    float opacity;
    float shown;       ///< what the surface counts where a path stays there: one over how often; 0: none stays
    Rgb passed;        ///< likewise what comes from behind it; 0: nothing
    bool only_shines;  ///< too many were passed: no path goes on from here

    bool ends() const { return !(max_component(passed) > 0.0f); }
};

/// A ray that is to go straight on, and what it meets first.
struct StraightRay {
    Ray ray;
    std::optional<RayHit> hit;
    std::uint32_t met_by;  ///< as a Visibility
    std::uint32_t ray_kind;
    float footprint_m, spread;  ///< at the origin, and how much it grows for each m
};

inline std::vector<StraightRay> straight_rays(std::span<const Ray> camera_rays,
                                              std::span<const std::optional<RayHit>> hits, const PixelWidth& width) {
    std::vector<StraightRay> rays;
    rays.reserve(hits.size());
    for (std::size_t i = 0; i < hits.size(); ++i)
        rays.push_back({camera_rays[i], hits[i], visible_to_camera, camera_ray, width.at(0.0f), width.per_m});
    return rays;
}

/// Where a ray goes on behind a surface: far enough not to meet it again.
inline float behind(float distance_m) { return distance_m * (1.0f + 2e-6f); }

/// A ray's part that begins behind a surface, or all of it up to there.
inline Ray part_of(const Ray& ray, float from_m, float to_m) {
    if (!(from_m > 0.0f)) return {ray.origin, ray.direction, ray.near_m, to_m, ray.time};
    return {ray.origin + from_m * ray.direction, ray.direction, 0.0f, to_m - from_m, ray.time};
}

/// How paths choose between a surface and what is behind it.
struct PassageChoice {
    float least_part;  ///< where each brings at least so much of the ray's light a path becomes two; above 1: never
    std::function<float(std::size_t ray, std::uint32_t passed)> u;  ///< else a number in [0, 1) chooses
};

/// The surfaces on the rays' ways, by ray and then by distance: those that are passed, and one behind unless there is
/// none. bounce: of what comes next. Where the scene has no transparent surfaces, what each ray meets.
std::vector<Passage> find_passages(const Scene& scene, std::uint32_t max_path_passages,
                                   std::span<const StraightRay> rays, std::uint32_t bounce, const PassageChoice& choice,
                                   ProgramMemory& memory);

/// Those of one ray, the next; all: as found, less what was taken.
std::span<const Passage> take_passages(std::span<const Passage>& all, std::size_t ray);

/// Whether a way has an end, behind which the ray meets nothing.
inline bool ends(std::span<const Passage> way) { return !way.empty() && way.back().ends(); }

/// The surface on a camera ray's way that passes tell of: the first that hides at least half of what is behind it, or
/// else the last that is shown; null: none is.
const Passage* told_of(std::span<const Passage> way);

/// Past all other dimensions of samplers.
inline std::uint32_t passage_dimension(std::uint32_t bounce, std::uint32_t passed) {
    return (1u << 24) + (bounce << 12) + passed;
}

/// How often a path passes, by its sampler. sample_of(ray): its sample.
template <class SampleOf>
PassageChoice chosen_by(std::span<const Sampler> samplers, std::uint32_t bounce, float least_part,
                        const SampleOf& sample_of) {
    return {least_part, [=](std::size_t ray, std::uint32_t passed) {
                return samplers[sample_of(ray)].point(passage_dimension(bounce, passed)).x;
            }};
}
inline constexpr float never_two = 2.0f;  ///< a least part

/// The way of a path that never becomes two.
struct WayOn {
    std::span<const Passage> passages;  ///< none where the scene has no transparent surfaces
    std::optional<RayHit> hit;          ///< where it ends; nothing: at none

    /// What light from its end is worth at its origin; from a distance, up to which it goes.
    Rgb worth() const { return worth_from(std::numeric_limits<float>::infinity()); }
    Rgb worth_from(float distance_m) const {
        Rgb worth(1.0f);
        for (const Passage& passage : passages)
            if (passage.hit.distance_m < distance_m) worth *= passage.ends() ? Rgb(passage.shown) : passage.passed;
        return worth;
    }
    std::uint32_t ray_kind(std::uint32_t at_origin) const {
        if (passages.empty()) return at_origin;
        const Passage& last = passages.back();
        return last.ray_kind + (last.ends() ? 0 : passed_one);
    }
    bool only_shines() const { return !passages.empty() && passages.back().only_shines; }
};

/// hits: of each ray, the first. all: find_passages of them.
std::vector<WayOn> ways_on(std::span<const Passage> all, std::span<const std::optional<RayHit>> hits);

/// Each a batch of shadow rays that meet nothing opaque.
struct ShadowPath {
    std::uint32_t max_passages;
    std::uint32_t bounce;
    WordBatch ray_kind;  ///< of the ray to where the shadow ray begins: what was passed counts on
    WordBatch instance = WordBatch(no_instance);  ///< that is lit; of media none
};

/// What transparent surfaces leave of light along shadow rays, of which none meets what hides it.
Vec3b light_through(const Scene& scene, const RayOf<Batch>& rays, const ShadowPath& path, ProgramMemory& memory);

/// What is left along one shadow ray to a light that has blockers of its own: it passes whatever is none.
Rgb light_past_others(const Scene& scene, const Ray& ray, const LightLinks& links, const ShadowPath& path,
                      std::size_t lane, ProgramMemory& memory);

/// What is left along shadow rays, whatever is in their way: 0 where it is opaque. links: of the light that they go to.
Vec3b light_left(const Scene& scene, RayOf<Batch> rays, const LightLinks& links, const ShadowPath& path,
                 ProgramMemory& memory);

/// The same of rays from surfaces that a camera sees; what the camera looked through does not count among the passages.
void light_along(const Scene& scene, std::uint32_t max_passages, const LightLinks& links, std::span<const Ray> rays,
                 std::span<Rgb> left, ProgramMemory& memory);

}  // namespace pivot
