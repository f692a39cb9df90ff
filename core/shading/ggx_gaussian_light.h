// GGX under light whose radiance is a spherical Gaussian of directions. Shading frame, z the normal.
//
// A Gaussian is a stack of caps: e^(-l h) of the versine h has the integral sum w_i C(x_i / l) over GGX, where C is the
// exact core's integral over the cap of a versine and x_i, w_i are Gauss's and Laguerre's. Light much wider than the
// lobe is asked for at the lobe's own points instead, and light that gives little is taken by a lobe that is widened by
// it.
//   [Tokuyoshi15] "Virtual Spherical Gaussian Lights for Real-time Glossy Indirect Illumination", supplement
//   [Tokuyoshi24] "Hierarchical Light Sampling with Accurate Spherical Gaussian Lighting"
//   [Heitz15]     "The SGGX Microflake Distribution"
#pragma once

#include "core/distributions/spherical_gaussian.h"
#include "core/sampling/warp.h"
#include "core/shading/ggx_cap_light.h"

namespace pivot {

/// Versines times the sharpness, and weights, of the caps that a Gaussian is a stack of.
struct LaguerreNode {
    float versine, weight;
};
inline constexpr std::array<LaguerreNode, 3> gaussian_caps{
    {{0.41577456f, 0.71109301f}, {2.2942804f, 0.27851773f}, {6.2899451f, 0.010389257f}}};

/// What each of the ways is off by: the most of 19 in 20 lights, relative to a twentieth at least of what the light
/// gives in the highlight. In the mean 1.9 % (with points where they serve, 1.5 %), 15 % and 22 %:
/// test_ggx_gaussian_light.py. Caps and points, chosen as is_wide() says, are off by a quarter at the worst: where a
/// light of sharpness 3 to 20 has its axis below the horizon.
inline constexpr float error_of_gaussian_caps = 0.1f;
inline constexpr float error_of_gaussian_points = 0.1f;
inline constexpr float error_of_widened_lobe = 0.5f;
inline constexpr float error_of_anisotropic_lobe = 0.65f;

/// A lobe made ready for many such lights.
template <class T>
struct GgxGaussianReceiver {
    static constexpr std::size_t point_count = 16;

    GgxLobe<T> lobe;
    IsotropicG2<T> g2;
    T sharpness;                                  ///< of the Gaussian nearest to the lobe
    Vec3<T> along;                                ///< in the surface, where the viewer leans; any where it does not
    std::array<Vec3<T>, point_count> directions;  ///< spread as the lobe is
    std::array<LobeSums<T>, point_count> values;  ///< the lobe there, over how densely they are spread

    explicit GgxGaussianReceiver(const GgxLobe<T>& of) : lobe(of), g2(of.wo_local, of.alpha) {
        const Vec3<T>& wo = lobe.wo_local;
        sharpness = ggx_lobe(lobe.alpha, wo).sharpness;
        const T across2 = sqr(wo.x) + sqr(wo.y);
        const auto leans = across2 > T(1e-12f);
        const T scale = inverse_sqrt(max(across2, T(1e-12f)));
        along = {select(leans, wo.x * scale, T(1)), select(leans, wo.y * scale, T(0)), T(0)};
        const T g1 = T(2) * inverse(T(1) + g2.view_weight);
        for (std::size_t k = 0; k < point_count; ++k) {
            const Vec2<T> u = golden_point(T(static_cast<float>(k)), point_count);
            // The golden point's even axis is the one that sets how far from the highlight a point lies.
            directions[k] = ggx_sample(wo, lobe.alpha, lobe.alpha, Vec2<T>(u.y, u.x));
            const T cos_oh = sqrt(T(0.5) * max(T(1) + dot(wo, directions[k]), T(0)));
            values[k] = {};
            add(values[k], lobe, cos_oh, g2(directions[k].z) * inverse(g1) * T(1.0f / point_count));
        }
    }
};

/// By points of the lobe.
template <class T>
LobeSums<T> integrate_by_points(const GgxGaussianReceiver<T>& receiver, const SphericalGaussian<T>& light) {
    LobeSums<T> sums;
    for (std::size_t k = 0; k < receiver.point_count; ++k)
        sums += receiver.values[k] * eval(light, receiver.directions[k]);
    return sums;
}

/// By the exact core's caps.
template <class T>
LobeSums<T> integrate_by_caps(const GgxGaussianReceiver<T>& receiver, const SphericalGaussian<T>& light, T budget) {
    LobeSums<T> sums;
    const T scale = inverse(max(light.sharpness, T(1e-6f))), amplitude = exp(light.log_amplitude);
    for (const LaguerreNode& node : gaussian_caps) {
        const Cap<T> cap{light.axis, min(T(node.versine) * scale, T(1))};
        sums += integrate(ggx_cap_light(receiver.lobe, cap), budget).sums * (amplitude * T(node.weight));
    }
    return sums;
}

/// By GGX as SGGX, its normals widened by what the light spreads half vectors: by 1/2 along the plane of incidence and
/// 1 / (2 cos_o) across, times the share of the light that is above the horizon [Tokuyoshi24, Heitz15].
template <class T>
LobeSums<T> integrate_widened(const GgxGaussianReceiver<T>& receiver, const SphericalGaussian<T>& light) {
    const Vec3<T>& wo = receiver.lobe.wo_local;
    const T alpha2 = sqr(receiver.lobe.alpha), rest = T(1) - alpha2;
    const T lambda = max(light.sharpness, T(1e-6f));
    const T in_plane = T(0.5) * inverse(lambda), across = in_plane * inverse(max(sqr(wo.z), T(1e-6f)));
    const T s1 = (alpha2 + rest * in_plane) * inverse(T(1) + rest * in_plane);
    const T s2 = (alpha2 + rest * across) * inverse(T(1) + rest * across);
    const Vec3<T> h = wo + light.axis;
    const T h2 = dot(h, h);
    const T h_along = h.x * receiver.along.x + h.y * receiver.along.y;
    const T h_across = h.y * receiver.along.x - h.x * receiver.along.y;
    const T s12 = s1 * s2;
    const T slope = sqr(h_along) * s2 + sqr(h_across) * s1 + sqr(h.z) * s12;
    const T ndf = s12 * sqrt(s12) * sqr(h2 * inverse(max(slope, T(1e-18f)))) * T(1.0f / pi<float>);
    const T wo_x2 = T(1) - sqr(wo.z);
    const T lobe = ndf * T(0.25) * inverse_sqrt(max(s1 * wo_x2 + sqr(wo.z), T(1e-12f)));

    // What of the light's product with the lobe is above the horizon.
    const Vec3<T> mirror(-wo.x, -wo.y, wo.z);
    const SphericalGaussian<T> both = product(light, SphericalGaussian<T>{mirror, receiver.sharpness});
    const T l = max(both.sharpness, T(1e-3f));
    const T s = l * sqrt((T(0.5) * l + T(0.65173288f)) / ((l + T(1.341828f)) * l + T(7.2216688f)));
    const T fading = exp(-l), part = T(0.5) * (T(1) + erf(s * both.axis.z) / erf(s));
    const T above = lerp(fading, T(1), clamp01(part)) * inverse(T(1) + fading);

    const T cos_oh = T(0.5) * sqrt(h2);
    LobeSums<T> sums;
    add(sums, receiver.lobe, min(cos_oh, T(1)), integrate(light) * lobe * above);
    return sums;
}

/// By the lobe as an anisotropic Gaussian, what else it is made of taken at the light's middle [Tokuyoshi15, appendix
/// B]: for comparison.
template <class T>
LobeSums<T> integrate_anisotropic(const GgxGaussianReceiver<T>& receiver, const SphericalGaussian<T>& light) {
    const Vec3<T>& wo = receiver.lobe.wo_local;
    const Vec3<T> mirror(-wo.x, -wo.y, wo.z), across(-receiver.along.y, receiver.along.x, T(0));
    const T alpha2 = sqr(receiver.lobe.alpha), eta = T(0.25) * inverse(alpha2);
    // Half vectors move half as far as directions do, and 1 / (2 cos_o) as far across the plane of incidence.
    const AnisotropicSphericalGaussian<T> lobe{cross(across, mirror), across, mirror, eta,
                                               eta * inverse(max(sqr(wo.z), T(1e-6f)))};
    const T peak = T(0.25f / pi<float>) * inverse(alpha2 * wo.z);
    const T cos_oh = T(0.5) * length(wo + light.axis);
    LobeSums<T> sums;
    add(sums, receiver.lobe, min(cos_oh, T(1)), peak * receiver.g2(light.axis.z) * integrate_product(lobe, light));
    return sums;
}

/// Whether the lobe's points see all of the light: it is five times as wide as the lobe is at its widest, whatever the
/// view's cosine narrows, or nearly the whole sphere.
template <class T>
Mask<T> is_wide(const GgxGaussianReceiver<T>& receiver, const SphericalGaussian<T>& light) {
    return light.sharpness < max(T(0.1f) * inverse(sqr(receiver.lobe.alpha)), T(5.5f));
}

}  // namespace pivot
