// What the core knows of a material: its base, a Lambert lobe beneath one GGX lobe; further lobes; emission; and what
// it lets through.
#pragma once

#include "core/bsdf/lobe_record.h"

namespace pivot {

/// What a surface does with light beside reflecting and emitting: some of it goes straight on.
template <class T>
struct TransparencyOf {
    Vec3<T> color{T(0)};  ///< of light that goes on
    T opacity = T(1);     ///< how much of a surface there is beside, for paths that choose; multiplied into all else
};

template <class T>
struct MaterialOf : BaseMaterialOf<T> {
    Vec3<T> emission{T(0)};                  ///< radiance, both sides; negative: subtracted
    std::array<LobeOf<T>, max_lobes> lobes;  ///< their kinds' Parameters
    TransparencyOf<T> transparency;          ///< read where rays pass; a surface that is shaded knows nothing of it

    Mask<T> is_emissive() const { return max_component(abs(emission)) > T(0); }
};

using Material = MaterialOf<float>;
using Transparency = TransparencyOf<float>;

// Where a material's numbers stand, counted in floats: the base's from 0 on.
inline constexpr std::size_t emission_place = sizeof(BaseMaterialOf<float>) / sizeof(float);
inline constexpr std::size_t lobes_place = emission_place + 3;
inline constexpr std::size_t transparency_place = lobes_place + max_lobes * sizeof(LobeOf<float>) / sizeof(float);
static_assert(sizeof(Material) == transparency_place * sizeof(float) + sizeof(Transparency));

}  // namespace pivot
