// What a light is there for: an artist may have it light some reflections only, or cast no shadows.
#pragma once

#include <cstdint>

#include "core/scene/light_links.h"
#include "core/scene/ray_tracer.h"

namespace pivot {

struct LightRules {
    std::uint32_t lights = visible_to_paths;  ///< which reflections, as Visibility has the rays that these would send
    std::uint32_t max_bounces = ~0u;          ///< the last bounce of a path that it lights; 0: what a camera sees
    bool casts_shadows = true;
    LightLinks links{};

    bool operator==(const LightRules&) const = default;
};

}  // namespace pivot
