#include "core/integrators/transmittance.h"

#include "core/simd/pack.h"

namespace pivot {

Rgb transmittance(const Media& media, const Ray& ray, MediaAlong& along, MediumMix& mix) {
    media.find_along(ray, along);
    Rgb depth(0.0f);
    for (const MediumInterval& interval : along.intervals) {
        set_mix(mix, media, along.active_in(interval), ray.origin);
        // Endless where there is nothing to lose is not 0 times infinity.
        const float length_m = interval.far_m - interval.near_m;
        for (int c = 0; c < 3; ++c)
            if (mix.sigma_t[c] > 0.0f) depth[c] += mix.sigma_t[c] * length_m;
    }
    return exp(-depth);
}

Vec3b transmittance(const Media& media, const RayOf<Batch>& rays) {
    MediaAlong along;
    MediumMix mix;
    std::array<Ray, batch_size> each = unpack<RayOf>(rays);
    std::array<Rgb, batch_size> left;
    for (std::size_t i = 0; i < batch_size; ++i)
        left[i] = each[i].far_m > 0.0f ? transmittance(media, each[i], along, mix) : Rgb(1.0f);
    return gather_vector([&](std::size_t i) { return left[i]; });
}

}  // namespace pivot
