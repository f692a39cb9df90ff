// Paths through media. On each part of a path between surfaces what the media scatter of the lamps is sampled by
// itself: along the ray by a table of what they scatter, over the lamp jointly with the phase function. Where more
// light is to come, the path also scatters: a camera's ray goes on to the surface as well, later ones do either.
#pragma once

#include "core/integrators/fog_lamp.h"
#include "core/integrators/passage.h"
#include "core/integrators/path.h"
#include "core/integrators/scatter_table.h"

namespace pivot {

/// A path that has met a particle of a medium, but not yet chosen where to go.
struct FogVertex {
    Vec3f position, direction;  ///< direction: of travel so far
    Phase phase;
    Rgb throughput;
    float footprint_m, spread;
    float time;
    std::uint32_t sample, bounces;
    LinkSets link_sets;
};

/// The sampler's dimensions that media take of a bounce, past those of surfaces. part: of a ray that passes surfaces.
struct FogDimensions {
    std::uint32_t base;

    explicit FogDimensions(std::uint32_t bounce, std::uint32_t part = 0)
        : base((1u << 16) + (part << 20) + bounce * (8 + 3 * max_lamp_samples)) {}

    std::uint32_t collision() const { return base; }
    std::uint32_t lobe() const { return base + 1; }
    std::uint32_t direction() const { return base + 2; }
    std::uint32_t lamp_choice() const { return base + 3; }
    std::uint32_t triangle_choice() const { return base + 4; }
    std::uint32_t triangle_place() const { return base + 5; }
    std::uint32_t world() const { return base + 6; }
    std::uint32_t survival() const { return base + 7; }
    std::uint32_t lamp(std::uint32_t place) const { return base + 8 + 3 * place; }  ///< three
};

/// Densities may underflow.
inline bool is_usable(float pdf) { return pdf > 0.0f && std::isfinite(pdf); }

class Fog {
   public:
    /// fog_sample: added to a path's sample where it first scatters in fog, so that its light is counted apart.
    Fog(const Work& work, std::uint32_t fog_sample)
        : work_(work), fog_sample_(fog_sample), ray_(work.scene.media()), shadow_ray_(work.scene.media()) {}

    /// Adds what a path brings of the media along a ray, up to a surface or to no end, and returns what it is worth
    /// there: 0 where it goes on within the media alone. bounce: of what comes next. path: its throughput, sample and
    /// footprint at the ray's origin. part: of a ray that goes straight on behind surfaces, which one.
    Rgb cross(const Ray& ray, std::uint32_t bounce, const Path& path, std::uint32_t part = 0);

    /// The same along a way straight on through surfaces; of these too, what the path is worth behind them.
    Rgb cross(const Ray& ray, const WayOn& way, std::uint32_t bounce, const Path& path);

    /// What the media leave of light along a ray of a sample's. dimension: apart for each ray.
    Rgb transmittance(const Ray& ray, std::uint32_t sample, std::uint32_t dimension);

    /// Whether there are paths that scatter() would send on.
    bool has_paths() const { return !vertices_.empty(); }

    /// Sends all paths that have scattered on, to vertices of the next bounce: those on surfaces are appended.
    void scatter(std::uint32_t bounce, Paths& next);

    /// Traces the shadow rays that are left and adds what they bring.
    void finish();

   private:
    /// What a lamp scatters along one of the ray's intervals.
    struct Candidate {
        const Light* lamp;
        std::size_t interval;
        ScatterTable table;
    };
    /// A sample of light that a shadow ray decides.
    struct Shadow {
        Ray ray;
        Rgb light;
        std::uint32_t bounce, sample, dimension, group;
        LightLinks links{};
        bool is_open = false;  ///< whatever is in its way
    };

    // fog_lamp_samples.cpp
    void sample_lamps(std::uint32_t bounce, const Path& path);
    void add_candidates(const Light& lamp, const Path& path);
    void sample_candidates(std::span<const Candidate> candidates, std::uint32_t bounce, const Path& path, float weight,
                           std::uint32_t place, std::uint32_t count);
    /// Whether samples of mix_'s phase functions must share anywhere on the ray.
    bool is_sharp_along_ray(const Candidate& candidate) const;
    /// batch_size places at once in an even medium of one lobe: mix_. first: of so many places.
    void sample_places(const Candidate& candidate, const Vec2f& u, const Vec2f& u_light, std::uint32_t first,
                       std::uint32_t count, std::uint32_t bounce, const Path& path, std::uint32_t dimension);
    /// At a place of the ray that mix_ is of.
    void sample_place(const Candidate& candidate, float distance_m, float weight, const Vec2f& u, std::uint32_t bounce,
                      const Path& path, std::uint32_t dimension);
    std::size_t place_of(const Light& lamp) const;
    bool casts_shadows(const Light& lamp) const;
    std::pair<std::size_t, float> choose_lamp(float u, float u_place);
    // fog.cpp
    Rgb sample_collision(std::uint32_t bounce, const Path& path, RandomStream& stream);
    Rgb sample_collision_evenly(std::uint32_t bounce, const Path& path, std::optional<MediaRay::Collided>& collided);
    void sample_shining(const FogVertex& vertex, std::uint32_t bounce);
    void add_emitted(std::uint32_t bounce, const Path& path);
    Rgb shining_met(const FogVertex& vertex, std::uint32_t bounce, const Ray& ray, const std::optional<RayHit>& hit,
                    float pdf_omega);
    /// Whether a light, by its place, is there for what scatters at a bounce; and what it is linked to.
    bool is_lit_by(std::size_t light, std::uint32_t bounce) const;
    LightLinks links_of(std::size_t light) const;
    /// group: whose light it is.
    void add_light(std::uint32_t bounce, std::uint32_t sample, std::uint32_t group, const Rgb& light);

    const Work& work_;
    std::uint32_t fog_sample_, part_ = 0;
    MediaRay ray_, shadow_ray_;
    MediumMix mix_;
    std::vector<Candidate> candidates_;
    std::vector<Shadow> shadows_;
    std::vector<FogVertex> vertices_;
};

}  // namespace pivot
