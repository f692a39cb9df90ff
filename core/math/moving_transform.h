// A transform that changes while a shutter is open: what a camera or an object that moves has in place of one.
//
// [Shoemake92]  Matrix Animation and Polar Decomposition
#pragma once

#include <span>
#include <vector>

#include "core/math/transform.h"

namespace pivot {

/// Times run from 0, where the shutter opens, to 1, where it closes.
inline constexpr float middle_time = 0.5f;

/// What is between the entries of an even series over all times: two that follow each other, and how far from the first
/// to the second.
struct BetweenSteps {
    std::size_t first;
    float part;

    /// count: of the entries, at least two.
    BetweenSteps(float time, std::size_t count) {
        const float at = time * static_cast<float>(count - 1);
        first = std::min(static_cast<std::size_t>(std::max(at, 0.0f)), count - 2);
        part = at - static_cast<float>(first);
    }

    template <class Value>
    Value of(const Value& a, const Value& b) const {
        return a + part * (b - a);
    }
};

class MovingTransform {
   public:
    /// So many steps are kept at most; as many may be given.
    static constexpr std::size_t max_steps = 129;

    /// steps: at even times, the first at 0, the last at 1; at least two. Between them what turns turns evenly, and all
    /// else changes evenly.
    explicit MovingTransform(std::span<const Transform> steps);

    Transform at(float time) const;
    /// At even times, so near each other that between them all may change evenly, as it does in at().
    std::span<const Transform> steps() const { return steps_; }

   private:
    std::vector<Transform> steps_;
};

}  // namespace pivot
