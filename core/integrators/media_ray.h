// A ray through media: its intervals, what they let through and emit, and where it may collide.
#pragma once

#include "core/media/tracking.h"
#include "core/scene/medium_mix.h"
#include "core/scene/scene.h"

namespace pivot {

class MediaRay {
   public:
    explicit MediaRay(const Media& media) : media_(media) {}

    /// Finds what there is from the ray's origin to its far_m. stream: for estimates where densities vary, without
    /// bias; none: they are integrated, which takes longer.
    void follow(const Ray& ray, RandomStream* stream);

    const Ray& ray() const { return ray_; }
    const Media& media() const { return media_; }
    std::size_t size() const { return along_.intervals.size(); }
    const MediumInterval& interval(std::size_t i) const { return along_.intervals[i]; }
    std::span<const std::uint32_t> ids(std::size_t i) const { return along_.active_in(along_.intervals[i]); }
    Vec3f position(float distance_m) const { return ray_.origin + distance_m * ray_.direction; }

    /// What is left of light from the ray's origin to where interval i starts; i = size(): beyond the last.
    const Rgb& before(std::size_t i) const { return before_[i]; }
    const Rgb& through() const { return before_.back(); }
    /// Of a part of interval i.
    Rgb transmittance(std::size_t i, float near_m, float far_m) const;
    /// The radiance that the media emit towards the ray's origin.
    Rgb emitted() const;
    /// Of that what comes from interval i, to where it starts; and its light group: that of the first medium that
    /// emits.
    Rgb emitted_in(std::size_t i) const;
    std::uint32_t light_group_in(std::size_t i) const;
    /// By which lights find what interval i is full of: the first medium's. There is one.
    const LinkSets& link_sets_at(float distance_m) const;
    const LinkSets& link_sets_in(std::size_t i) const { return media_.at(ids(i).front()).link_sets; }
    /// Whether any of it scatters.
    bool scatters() const { return scatters_; }
    bool is_homogeneous() const { return is_homogeneous_; }
    bool is_homogeneous(std::size_t i) const;

    /// What interval i is made of: the same everywhere, or as in the mean, with something of all that it may be.
    void set_typical_mix(std::size_t i, MediumMix& mix) const;
    /// At a place of interval i.
    void set_mix_at(std::size_t i, float distance_m, MediumMix& mix) const {
        set_mix(mix, media_, ids(i), position(distance_m));
    }
    /// How much denser places of interval i are than is typical. mix: the typical one.
    Batch relative_density(std::size_t i, const MediumMix& typical, const Batch& distance_m) const;

    struct Collided {
        float distance_m;
        Rgb throughput;  ///< in the mean the path's times sigma_s T per m
    };
    /// Where a path collides with something that scatters, first of all; mix: what it is made of. Without a collision
    /// `throughput`, which is the path's, is what it goes on with, in the mean times T; with one that absorbs, 0.
    std::optional<Collided> collide(Rgb& throughput, RandomStream& stream, MediumMix& mix) const;

   private:
    GridRay grid_ray(const PlacedMedium& placed, const VoxelGrid& grid, float near_m, float far_m) const;
    /// The sum of what does not vary in interval i.
    void set_even_mix(std::size_t i, MediumMix& mix) const;
    bool emits(std::uint32_t id) const { return max_component(abs(media_.at(id).medium->emission)) > 0.0f; }

    const Media& media_;
    Ray ray_{};
    RandomStream* stream_ = nullptr;
    MediaAlong along_;
    mutable MediumMix mix_;
    std::vector<Rgb> before_;
    bool scatters_ = false, is_homogeneous_ = true;
};

/// exp(-sigma_t length_m), where nothing is lost of an endless length of nothing.
Rgb transmittance_over(const Rgb& sigma_t, float length_m);
Vec3b transmittance_over(const Rgb& sigma_t, const Batch& length_m);

/// What media leave of light along each ray of a batch. seed: of each ray's estimates.
Vec3b transmittance(const Media& media, const RayOf<Batch>& rays, const WordBatch& seeds);

/// Of a sample's estimates, apart by dimension.
template <class U>
U stream_seed(const SamplerOf<U>& sampler, std::uint32_t dimension) {
    return hash(hash(sampler.pixel_seed, sampler.sample), U(dimension));
}

}  // namespace pivot
