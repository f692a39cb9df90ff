// Independent uniform numbers for what asks for an unknown count of them: the steps of a walk through fog.
#pragma once

#include "core/sampling/sobol.h"

namespace pivot {

struct RandomStream {
    std::uint32_t seed;
    std::uint32_t count = 0;  ///< of the numbers taken so far

    /// [0, 1).
    float next() { return to_unit(hash(seed, count++)); }
    /// Exponential of mean 1.
    float next_depth() { return -log(1.0f - next()); }
};

}  // namespace pivot
