// What paths bring of each group of lights, for passes that show these apart.
#pragma once

#include <span>
#include <vector>

#include "core/math/vector.h"
#include "core/simd/batch.h"

namespace pivot {

/// Sums of samples by light group, and what a batch's paths bring before it is known what they are worth.
class GroupLight {
   public:
    /// sums: of each sample `stride` colours, of which the groups' are the first.
    GroupLight(std::size_t groups, std::size_t stride, std::span<Rgb> sums)
        : groups_(groups), stride_(stride), sums_(sums), of_lanes_(groups * batch_size, Rgb(0.0f)) {}

    void add(std::size_t sample, std::uint32_t group, const Rgb& light) {
        if (group < groups_) sums_[sample * stride_ + group] += light;
    }

    /// Notes what a lane brings.
    void note(std::size_t lane, std::uint32_t group, const Rgb& light) {
        if (group < groups_) of_lanes_[lane * groups_ + group] += light;
    }
    /// The same of all lanes. group_of(lane)
    template <class GroupOf>
    void note(const Vec3b& light, const GroupOf& group_of) {
        const Lanes r = store(light.x), g = store(light.y), b = store(light.z);
        for (std::size_t i = 0; i < batch_size; ++i)
            if (r[i] != 0.0f || g[i] != 0.0f || b[i] != 0.0f) note(i, group_of(i), {r[i], g[i], b[i]});
    }
    /// Adds what the first `count` lanes brought, each times its worth, to their samples, and forgets it.
    template <class SampleOf>
    void add_noted(std::size_t count, const Vec3b& worth, const SampleOf& sample_of) {
        const Lanes r = store(worth.x), g = store(worth.y), b = store(worth.z);
        for (std::size_t i = 0; i < count; ++i)
            for (std::size_t k = 0; k < groups_; ++k)
                if (const Rgb& light = of_lanes_[i * groups_ + k]; light != Rgb(0.0f))
                    sums_[sample_of(i) * stride_ + k] += Rgb(r[i], g[i], b[i]) * light;
        std::ranges::fill(of_lanes_, Rgb(0.0f));
    }

   private:
    std::size_t groups_, stride_;
    std::span<Rgb> sums_;
    std::vector<Rgb> of_lanes_;
};

}  // namespace pivot
