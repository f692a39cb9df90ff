// An anisotropic GGX distribution of microfacet normals about a normal other than the surface's: shifted in the plane
// of slopes q = (h.x, h.y) / h.z, D(h) = 1 / (pi det A h.z^4 (1 + |A^-1 (q - t)|^2)^2). Every distribution of normals
// is nearly a sum of a few of these.
//
// It is the uniform distribution of the sphere under M = [A t; 0 1]: its integrals are those of elliptic_cone.h, and
// what a direction sees of it, over the hemisphere, is that of an ellipsoid [Heitz15] and half of its outline. About
// M M' 's own axes, the longest of which is z, it is a common GGX distribution times that axis' length.
//
// [Heitz15]  "The SGGX Microflake Distribution"
// [Dupuy23]  "Sampling Visible GGX Normals with Spherical Caps"
#pragma once

#include "core/math/frame.h"

namespace pivot {

struct TiltedGgx {
    float weight = 1.0f;  ///< its projected area, the integral of D h.z dw
    Vec2f shift{0.0f};    ///< t
    // A, of slopes: (xx, 0; yx, yy)
    float xx = 1.0f, yx = 0.0f, yy = 1.0f;
};

namespace detail {

/// M' w: what w is where the distribution is uniform.
inline Vec3f stretch(const TiltedGgx& d, const Vec3f& w) {
    return {d.xx * w.x + d.yx * w.y, d.yy * w.y, w.z + d.shift.x * w.x + d.shift.y * w.y};
}

}  // namespace detail

/// D(h), 1/sr, weight included; h unit, h.z > 0.
inline float ndf(const TiltedGgx& d, const Vec3f& h) {
    const float x = (h.x - d.shift.x * h.z) / d.xx, y = (h.y - d.shift.y * h.z - d.yx * x) / d.yy;
    return d.weight / (pi<float> * d.xx * d.yy * sqr(x * x + y * y + h.z * h.z));
}

/// int max(w.h, 0) D dh over the hemisphere of normals, weight included.
inline float projected_area(const TiltedGgx& d, const Vec3f& w) {
    const Vec3f s = detail::stretch(d, w);
    const float across2 = sqr(s.x) + sqr(s.y), size = std::sqrt(across2 + sqr(s.z));
    return 0.5f * d.weight * (s.z > 0.0f ? size + s.z : across2 / std::max(size - s.z, tiny<float>));
}

/// A normal that w sees, of density max(w.h, 0) D / projected_area [Dupuy23].
inline Vec3f sample_visible(const TiltedGgx& d, const Vec3f& w, const Vec2f& u) {
    const Vec3f s = normalize(detail::stretch(d, w));
    const float phi = 2.0f * pi<float> * u.x, z = (1.0f - u.y) * (1.0f + s.z) - s.z;
    const float sine = safe_sqrt(1.0f - z * z);
    const Vec3f h = Vec3f(sine * std::cos(phi), sine * std::sin(phi), z) + s;
    return normalize(
        Vec3f(d.xx * h.x + d.shift.x * h.z, d.yx * h.x + d.yy * h.y + d.shift.y * h.z, std::max(h.z, tiny<float>)));
}

/// The same distribution as a common one: in `frame`, weight times that of ggx.h with these alphas.
struct OwnAxes {
    Frame<float> frame;
    float alpha_x, alpha_y, weight;
};
OwnAxes own_axes(const TiltedGgx& d);

}  // namespace pivot
