// A picture of microfacet normals as a few tilted GGX lobes: in the plane of slopes each of these is a bivariate
// Student distribution of two degrees of freedom, and their mixture is found by expectation and maximisation [Peel00].
// A lobe is added where the mixture lacks most, until what it misses is small or there are `most` of them.
//
// [Peel00]  "Robust Mixture Modelling Using the t Distribution"
#pragma once

#include <vector>

#include "core/distributions/ndf_image.h"
#include "core/distributions/tilted_ggx.h"

namespace pivot {

inline constexpr std::size_t max_ndf_lobes = 8;

struct NdfFit {
    std::vector<TiltedGgx> lobes;  ///< weights sum to 1
    float error;                   ///< the part of the projected area that lies elsewhere, 0..1
    float worst;                   ///< the most that D is over what the lobes sum to
};

NdfFit fit(const NdfImage& image);

}  // namespace pivot
