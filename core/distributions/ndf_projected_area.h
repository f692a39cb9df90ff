// How much of a microfacet surface each direction sees, were nothing of it hidden: sigma(w) = int max(w.h, 0) D(h) dw,
// the denominator of its masking G1(w) = w.z / sigma(w), as a table over w that does not grow with the image.
//
// Along the elevation nodes are even in z / (z + a sin theta), a the surface's own slope, and what they hold is
// sigma over z + a sin theta: for GGX of any alpha that is one curve between 1/2 and 1, so that a mirror needs no more
// nodes than chalk. A look-up is off by at most 0.1 % of the integral of a smooth image
// (tests/core/test_ndf_image.py).
#pragma once

#include <array>

#include "core/distributions/ndf_image.h"

namespace pivot {

/// Where a direction's elevation stands among a table's nodes, 0 at the horizon and 1 at the normal, on a surface about
/// as rough as GGX of alpha.
inline float elevation_coordinate(const Vec3f& w, float alpha) {
    return w.z / (w.z + alpha * std::sqrt(w.x * w.x + w.y * w.y));
}
/// And its direction.
inline Vec3f direction_at(float elevation_coordinate, float azimuth, float alpha) {
    const float rise = alpha * elevation_coordinate, run = 1.0f - elevation_coordinate;
    const float scale = 1.0f / std::sqrt(rise * rise + run * run);
    return {run * scale * std::cos(azimuth), run * scale * std::sin(azimuth), rise * scale};
}

class NdfProjectedArea {
   public:
    static constexpr std::size_t azimuths = 128, elevations = 64;

    explicit NdfProjectedArea(const NdfImage& image);

    /// w: unit, w.z >= 0.
    float operator()(const Vec3f& w) const;
    /// The alpha of a GGX distribution that is seen as much from the horizon, all around.
    float alpha() const { return alpha_; }

   private:
    /// What the table's numbers are multiplied by.
    float scale_of(const Vec3f& w) const;

    float alpha_;
    std::array<float, azimuths * elevations> table_;
};

}  // namespace pivot
