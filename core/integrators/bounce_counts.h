// How often a path was reflected or scattered in each way, where an artist limits that: a word, seven bits a kind.
#pragma once

#include <algorithm>
#include <cstdint>

#include "core/integrators/settings.h"
#include "core/shaders/place.h"

namespace pivot {

inline constexpr std::uint32_t path_ends = 1u << 31;  ///< of what it meets only what shines counts

namespace bounce_counts {
inline constexpr std::uint32_t diffuse = 0, glossy = 7, transmission = 14, scatter = 21, most = 127;  // first bits
}

/// The counts with one more of a kind, by its first bit. [Cycles 4.5 integrator/path_state.h]
inline std::uint32_t counted(std::uint32_t counts, std::uint32_t kind, std::uint32_t limit) {
    const std::uint32_t count = std::min((counts >> kind & bounce_counts::most) + 1, bounce_counts::most);
    counts = (counts & ~(bounce_counts::most << kind)) | count << kind;
    return count > limit ? counts | path_ends : counts;
}

/// With one more reflection, by the kind of the ray that leaves it.
inline std::uint32_t counted_ray(std::uint32_t counts, const BounceLimits& limits, std::uint32_t ray_kind) {
    if (ray_kind & transmission_ray) return counted(counts, bounce_counts::transmission, limits.transmission);
    if (ray_kind & glossy_ray) return counted(counts, bounce_counts::glossy, limits.glossy);
    return counted(counts, bounce_counts::diffuse, limits.diffuse);
}

}  // namespace pivot
