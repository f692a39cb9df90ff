// Solid angles of image pixels: of a hemisphere seen orthographically (an image of a lobe or an NDF over the
// unit disc), and of a cube map's face.
//
// [Patapom] "Solid angle of a pixel", Wakapon wiki; the cube map's part after Manne Ohrstrom's thesis.
//
// Departures: the corner formula [Patapom (2)] is replaced by the shorter x atan2(y, s) + y atan2(x, s) -
// atan2(xy, s), which also holds outside the disc and sums to pi / 2 (the seed's slow convergence is its
// dropped rim pixels); a pixel is integrated, for differences of four corners leave float32 no digits in a
// small pixel.
#pragma once

#include <utility>

#include "core/distributions/spherical_polygon.h"
#include "core/math/quadrature.h"

namespace pivot {

/// Solid angle of the part of the hemisphere z > 0 over [0, x] x [0, y]; odd in x and in y. What lies outside
/// the unit disc counts nothing.
template <class T>
T orthographic_corner_solid_angle(T x, T y) {
    x = max(min(x, T(1)), T(-1));
    y = max(min(y, T(1)), T(-1));
    const T s = safe_sqrt((T(1) - x) * (T(1) + x) - y * y);
    return x * atan2(y, s) + y * atan2(x, s) - atan2(x * y, s);
}

namespace detail {

/// The pixel's part in one quadrant, 0 <= x0 <= x1 <= 1 and likewise y: the integral over y of the angle that
/// its chord subtends in the half-circle of radius sqrt(1 - y^2). The chord meets the rim at y_near with its
/// end x1 and at y_far with x0. The square roots there vanish by w = sqrt(y_rim - y).
inline double orthographic_quadrant_solid_angle(double x0, double x1, double y0, double y1) {
    if ((x1 - x0) * (x1 + x0) < (y1 - y0) * (y1 + y0)) {  // keeps y_near and y_far apart
        std::swap(x0, y0);
        std::swap(x1, y1);
    }
    const double y_near = sqrt((1 - x1) * (1 + x1)), y_far = sqrt((1 - x0) * (1 + x0));
    // What stands under the integrals turns within `turn` of w = 0: w = turn sinh(t).
    const auto over_w = [](double rim, double low, double high, double turn, const auto& chord) {
        if (!(high > low)) return 0.0;
        turn = max(turn, 1e-6 * sqrt(rim - low));
        const double a = sqrt(max(rim - high, 0.0)) / turn, b = sqrt(rim - low) / turn;
        const double width = asinh((high - low) / (turn * turn * (b * sqrt(1 + a * a) + a * sqrt(1 + b * b))));
        return gauss_legendre(asinh(a), width, 1 + static_cast<int>(width), [&](double t) {
            const double w = turn * sinh(t);
            return 2 * w * turn * cosh(t) * chord(w, rim - w * w);
        });
    };
    const double span_squared = (x1 - x0) * (x1 + x0);
    const double inside = over_w(y_near, y0, min(y1, y_near), sqrt(span_squared), [&](double w, double y) {
        const double c1 = w * sqrt(y_near + y), c0 = sqrt(c1 * c1 + span_squared);
        return atan2(span_squared / (x1 * c0 + x0 * c1), (c0 * c1 + x0 * x1) / ((1 - y) * (1 + y)));
    });
    const double across = over_w(y_far, max(y0, y_near), min(y1, y_far), x0,
                                 [&](double w, double y) { return atan2(w * sqrt(y_far + y), x0); });
    return inside + across;
}

/// Calls f with the parts of [low, high] at either side of 0, as 0 <= a <= b <= 1.
template <class T, class F>
void for_each_side(T low, T high, const F& f) {
    const T right = min(high, T(1)), left = min(-low, T(1));
    if (right > T(0)) f(max(low, T(0)), right);
    if (left > T(0)) f(max(-high, T(0)), left);
}

}  // namespace detail

/// Solid angle of the hemisphere z > 0 over the pixel [x0, x1] x [y0, y1], cut by the unit disc. In double whatever T:
/// what the rim leaves of a pixel can be as small as float's rounding.
template <class T>
T orthographic_pixel_solid_angle(T x0, T x1, T y0, T y1) {
    double sum = 0;
    detail::for_each_side<double>(x0, x1, [&](double a0, double a1) {
        detail::for_each_side<double>(y0, y1, [&](double b0, double b1) {
            if (a1 > a0 && b1 > b0) sum += detail::orthographic_quadrant_solid_angle(a0, a1, b0, b1);
        });
    });
    return T(sum);
}

/// Solid angle of [0, x] x [0, y] on the plane z = 1; odd in x and in y [Patapom (1)].
template <class T>
T cubemap_corner_solid_angle(T x, T y) {
    return atan2(x * y, sqrt(T(1) + x * x + y * y));
}

/// Solid angle of the pixel [x0, x1] x [y0, y1] on the plane z = 1.
template <class T>
T cubemap_pixel_solid_angle(T x0, T x1, T y0, T y1) {
    // As seen from its first corner's direction, tan of the solid angle of either half is a ratio of products:
    // exact widths.
    const auto half = [&](T xa, T ya, T xb, T yb) {
        const T a = sqrt(T(1) + x0 * x0 + y0 * y0), b = sqrt(T(1) + xa * xa + ya * ya);
        const T c = sqrt(T(1) + xb * xb + yb * yb);
        const T ab = T(1) + x0 * xa + y0 * ya, bc = T(1) + xa * xb + ya * yb, ca = T(1) + xb * x0 + yb * y0;
        const T volume = (x1 - x0) * (y1 - y0);
        return T(2) * atan2(volume, a * b * c + ab * c + bc * a + ca * b);
    };
    return half(x1, y0, x1, y1) + half(x1, y1, x0, y1);
}

}  // namespace pivot
