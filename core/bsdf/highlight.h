// What of a lobe has closed forms over caps: GGX lobes of which the sum is about the lobe, for light samples to follow.
#pragma once

#include <array>

#include "core/math/frame.h"

namespace pivot {

struct Highlight {
    Frame<float>
        frame;  ///< of the shading frame: its z the highlight's own normal, where its GGX distribution is common
    float alpha_x, alpha_y;
    float reflectance;  ///< about, what D h.z dw over all normals reflects to wo
};

/// Those of a surface's lobes, and what they leave out.
class Highlights {
   public:
    float beside = 0.0f;    ///< reflectance that is spread more evenly
    bool are_close = true;  ///< nowhere are the lobes much more than these and what is beside

    void add(const Highlight& highlight) {
        if (!(highlight.reflectance > 0.0f)) return;
        if (count_ < highlights_.size())
            highlights_[count_++] = highlight;
        else
            are_close = false;
    }
    const Highlight* begin() const { return highlights_.data(); }
    const Highlight* end() const { return highlights_.data() + count_; }

    bool is_empty() const { return count_ == 0; }

    /// The only one, if it is like a base's: about the surface's normal, and as rough along x as along y.
    bool is_one_of_a_base() const {
        if (count_ != 1) return false;
        const auto& [frame, alpha_x, alpha_y, reflectance] = highlights_[0];
        constexpr float most_unlike = 1.1f;
        return frame.z.z > 0.9999f && alpha_x < most_unlike * alpha_y && alpha_y < most_unlike * alpha_x;
    }

    static constexpr std::size_t most = 12;

   private:
    std::array<Highlight, most> highlights_;
    std::size_t count_ = 0;
};

}  // namespace pivot
