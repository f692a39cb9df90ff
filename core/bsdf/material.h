// What the core knows of a material: its base, a Lambert lobe beneath one GGX lobe; further lobes; and emission.
#pragma once

#include "core/bsdf/lobe_record.h"

namespace pivot {

template <class T>
struct MaterialOf : BaseMaterialOf<T> {
    Vec3<T> emission{T(0)};                  ///< radiance, both sides; negative: subtracted
    std::array<LobeOf<T>, max_lobes> lobes;  ///< their kinds' Parameters

    Mask<T> is_emissive() const { return max_component(abs(emission)) > T(0); }
};

using Material = MaterialOf<float>;

// Where a material's numbers stand, counted in floats: the base's from 0 on.
inline constexpr std::size_t emission_place = sizeof(BaseMaterialOf<float>) / sizeof(float);
inline constexpr std::size_t lobes_place = emission_place + 3;
static_assert(sizeof(Material) == lobes_place * sizeof(float) + max_lobes * sizeof(LobeOf<float>));

}  // namespace pivot
