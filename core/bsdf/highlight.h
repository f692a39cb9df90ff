// What of a lobe has closed forms over caps: GGX lobes of which the sum is about the lobe, for light samples to follow.
// Over float or batches.
#pragma once

#include <array>

#include "core/bsdf/base.h"
#include "core/math/frame.h"

namespace pivot {

template <class T>
struct HighlightOf {
    Frame<T> frame;  ///< of the shading frame: its z the highlight's own normal, where its GGX distribution is common
    T alpha_x, alpha_y;
    T fresnel_f0, fresnel_f90;  ///< about, what its microfacets reflect; means over the colours
};

/// As rough along x as along y, about the surface's normal.
template <class T>
HighlightOf<T> highlight_about_normal(T alpha, const LobeFresnelOf<T>& fresnel) {
    const T zero(0), one(1);
    return {{{one, zero, zero}, {zero, one, zero}, {zero, zero, one}},
            alpha,
            alpha,
            mean_component(fresnel.schlick_f0 + fresnel.dielectric_f0),
            mean_component(fresnel.schlick_f90 + fresnel.dielectric_f90)};
}

/// Those of a surface's lobes, and what they leave out.
template <class T>
class HighlightsOf {
   public:
    T beside = T(0);                   ///< reflectance that is spread more evenly
    Mask<T> are_close = T(0) >= T(0);  ///< nowhere are the lobes much more than these and what is beside

    void add_beside(T reflectance, const Mask<T>& where) { beside += select(where, reflectance, T(0)); }

    /// In the lanes of a mask; the others' stays dark.
    void add(const HighlightOf<T>& highlight, const Mask<T>& where) {
        const Mask<T> shines = where && highlight.fresnel_f0 + highlight.fresnel_f90 > T(0);
        if (!any(shines)) return;
        if (count_ == highlights_.size()) {
            are_close = are_close && !shines;
            return;
        }
        highlights_[count_] = highlight;
        highlights_[count_].fresnel_f0 = select(shines, highlight.fresnel_f0, T(0));
        highlights_[count_++].fresnel_f90 = select(shines, highlight.fresnel_f90, T(0));
    }
    std::size_t count() const { return count_; }
    const HighlightOf<T>* begin() const { return highlights_.data(); }
    const HighlightOf<T>* end() const { return highlights_.data() + count_; }

    /// As many as a fit of microfacets has, and more than there are in a batch of lobes.
    static constexpr std::size_t most = 13;

   private:
    std::array<HighlightOf<T>, most> highlights_;
    std::size_t count_ = 0;
};

}  // namespace pivot
