// What bumps make of the diffuse lobe's closed forms, which know the shading frame's normal alone.
#pragma once

#include "core/bsdf/base.h"
#include "core/distributions/cap.h"
#include "core/sampling/warp.h"

namespace pivot {

struct BumpShare {
    float value = 1.0f;  ///< of the closed form
    float error = 0.0f;  ///< predicted, relative to that
};

/// Of light over a cap of the shading frame, by so many points of it; radiance(wi_local): relative.
template <class Radiance>
BumpShare bump_share(const DiffuseBumpOf<float>& bump, const Cap<float>& light_local, std::uint32_t count,
                     const Radiance& radiance) {
    struct Sums {
        float bumped = 0.0f, plain = 0.0f;
        float share() const { return plain > 0.0f ? bumped / plain : 1.0f; }
    };
    std::array<Sums, 2> halves;  // of every second point, whose difference tells the error
    for (std::uint32_t i = 0; i < count; ++i) {
        const Vec3f wi = sample(light_local, golden_point(static_cast<float>(i), count));
        const float light = radiance(wi);
        halves[i % 2].bumped += light * bump.cosine(wi);
        halves[i % 2].plain += light * std::max(wi.z, 0.0f);
    }
    const float value = Sums{halves[0].bumped + halves[1].bumped, halves[0].plain + halves[1].plain}.share();
    const float difference = std::abs(halves[0].share() - halves[1].share());
    return {value, value > 0.0f ? 0.5f * difference / value : 0.0f};
}

}  // namespace pivot
