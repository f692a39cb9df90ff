// How far a camera's shutter is open while it takes a picture.
#pragma once

#include <span>
#include <vector>

namespace pivot {

class Shutter {
   public:
    /// Open all the time.
    Shutter() = default;
    /// openness: at even times, the first when it begins to open, the last when it is closed; two or more, none below
    /// 0. Throws std::invalid_argument. One that is closed all the time counts as open all the time.
    explicit Shutter(std::span<const float> openness);

    /// A time of [0, 1], as likely as the shutter is open then. u in [0, 1).
    float time(float u) const;

   private:
    std::vector<float> openness_;      ///< empty: open all the time
    std::vector<float> passed_share_;  ///< of all light, how much came before each time
};

}  // namespace pivot
