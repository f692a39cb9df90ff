// What a lobe reflects of light from all sides, where no formula says it: the mean over a few of its own samples.
#pragma once

#include "core/bsdf/lobe_record.h"
#include "core/sampling/warp.h"

namespace pivot {

/// lobe: samples wi_local by pdf_omega. shape: (wi_local) -> its BRDF times cosine for white light.
template <std::size_t count, class T, class Lobe, class Shape>
T sampled_reflectance(const Lobe& lobe, const Vec3<T>& wo_local, const Shape& shape) {
    T sum(0);
    for (std::size_t k = 0; k < count; ++k) {
        const Vec3<T> wi_local = lobe.sample(wo_local, T(0), golden_point(T(static_cast<float>(k)), count));
        const T pdf_omega = lobe.pdf_omega(wo_local, wi_local);
        sum += select(pdf_omega > T(0), shape(wi_local) / max(pdf_omega, tiny<T>), T(0));
    }
    return sum * T(1.0f / static_cast<float>(count));
}

}  // namespace pivot
