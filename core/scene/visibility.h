// Whom rays meet: bits of an instance's mask.
#pragma once

#include <cstdint>

namespace pivot {

/// Which rays meet an instance: those of a camera, and of paths by how they were last reflected or scattered. Shadow
/// rays of what casts shadows end at what hides light, and pass what filters it.
enum Visibility : std::uint32_t {
    visible_to_camera = 1,
    visible_to_diffuse = 2,
    visible_to_glossy = 4,
    visible_to_transmission = 8,
    visible_to_scatter = 16,
    visible_to_paths = 30,  ///< all kinds of them
    casts_shadows = 32,
    visible_to_all = 63,
    hides_light = 64,
    filters_light = 128,
};

}  // namespace pivot
