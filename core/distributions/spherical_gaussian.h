// Spherical Gaussians, isotropic and anisotropic, and the shading of virtual spherical Gaussian lights
// (VSGLs) by them.
//
// [Tokuyoshi15] Tokuyoshi, "Virtual Spherical Gaussian Lights for Real-time Glossy Indirect Illumination",
// Computer
//               Graphics Forum 34(7), 2015, supplemental material.
// [Tokuyoshi24] Tokuyoshi, Ikeda, Kulkarni, Harada, "Hierarchical Light Sampling with Accurate Spherical Gaussian
//               Lighting", SIGGRAPH Asia 2024.
// [Banerjee05]  Banerjee, Dhillon, Ghosh, Sra, "Clustering on the Unit Hypersphere using von Mises-Fisher
//               Distributions", JMLR 6, 2005.
// [Xu13]        Xu, Sun, Dong, Zhao, Wu, Hu, "Anisotropic Spherical Gaussians", ACM TOG 32(6), 2013.
//
// Exponents are taken from differences of unit vectors, 1 - a.b = |a - b|^2 / 2: at a sharpness of 1e7 the
// dot product's own rounding would be the result. Products carry their amplitude as its logarithm for the
// same reason. [Tokuyoshi15] prints the diffuse term with the cosine pulled out of the integral; `irradiance`
// is the exact one, and `irradiance_estimate` a closed form near it.
#pragma once

#include "core/math/quadrature.h"
#include "core/math/vector.h"

namespace pivot {

/// exp(log_amplitude + sharpness (omega . axis - 1)).
template <class T>
struct SphericalGaussian {
    Vec3<T> axis;
    T sharpness;
    T log_amplitude = T(0);
};

template <class T>
T eval(const SphericalGaussian<T>& sg, const Vec3<T>& omega) {
    return exp(sg.log_amplitude - sg.sharpness * T(0.5) * length_squared(omega - sg.axis));
}

/// The integral over the sphere of a Gaussian of amplitude 1, in steradians: A(lambda) = 2 pi (1 - exp(-2
/// lambda)) / lambda, 4 pi at lambda = 0.
template <class T>
T gaussian_solid_angle(T sharpness) {
    const T x = T(2) * max(sharpness, std::numeric_limits<T>::min());
    return T(4) * pi<T> * (-expm1(-x) / x);
}

template <class T>
T integrate(const SphericalGaussian<T>& sg) {
    return exp(sg.log_amplitude) * gaussian_solid_angle(sg.sharpness);
}

/// The product of two is one again. Where they cancel (opposite axes, equal sharpness) it is constant, its
/// axis a's.
template <class T>
SphericalGaussian<T> product(const SphericalGaussian<T>& a, const SphericalGaussian<T>& b) {
    const Vec3<T> sum = a.sharpness * a.axis + b.sharpness * b.axis;
    const T sharpness = length(sum);
    const T total = max(sharpness + a.sharpness + b.sharpness, std::numeric_limits<T>::min());
    const T loss = a.sharpness * (b.sharpness / total) * length_squared(a.axis - b.axis);
    const Vec3<T> axis = select(sharpness > T(0), sum / max(sharpness, std::numeric_limits<T>::min()), a.axis);
    return {axis, sharpness, a.log_amplitude + b.log_amplitude - loss};
}

/// The integral of a Gaussian times the clamped cosine to a normal at `cos_axis` from its axis. Exact to
/// 1e-12 in double: rings around the axis, whose clamped cosine integrates in closed form, by Gauss-Legendre.
template <class T>
T irradiance(const SphericalGaussian<T>& sg, T cos_axis) {
    const T c = cos_axis, lambda = sg.sharpness;
    const T s = safe_sqrt((T(1) - c) * (T(1) + c));
    const T depth = T(45) / max(lambda, std::numeric_limits<T>::min());  // exp(-45) is below rounding

    // Rings that lie above the horizon as a whole: around the axis if that is above, else around its opposite. v runs
    // from where the Gaussian is largest.
    const T whole = sqr(c) / (T(1) + s);
    const auto ahead = c > T(0);
    const T nearest = select(ahead, T(0), T(1) + s);  // 1 - cos to the axis at v = 0
    const T above = gauss_legendre(T(0), min(whole, depth), 4,
                                   [&](T v) { return exp(-lambda * (nearest + v)) * select(ahead, T(1) - v, s + v); }) *
                    pi<T> * abs(c);
    // Rings that cross it, at cos = s cos(tau); the part of each that is above spans 2 atan2(sin tau, -c cos tau),
    // which turns fast within |c| of tau = 0 and pi: tau = turn sinh(y) from either end.
    const T half_end = asin(sqrt(clamp01(depth / max(T(2) * s, std::numeric_limits<T>::min()))));
    const T tau_end = min(T(2) * half_end, pi<T> / T(2));
    const T turn = max(abs(c), T(1e-4) * tau_end), y_end = asinh(tau_end / turn);
    const auto ring = [&](T sine, T cosine, T sine_half) {
        return exp(-lambda * (T(2) * s * sqr(sine_half))) * (c * cosine * atan2(sine, -c * cosine) + sine) * sine;
    };
    const T crossing = gauss_legendre(T(0), y_end, 8, [&](T y) {
        const T tau = turn * sinh(y), sine = sin(tau), cosine = cos(tau), half = tau * T(0.5);
        return turn * cosh(y) * (ring(sine, cosine, sin(half)) + ring(sine, -cosine, cos(half)));
    });
    return T(2) * exp(sg.log_amplitude) * (above + exp(-lambda * whole) * sqr(s) * crossing);
}

/// The same within 2 % of the Gaussian's solid angle: between what a Gaussian about the zenith and one about the nadir
/// give, by an error function of the cosine, nearly [Tokuyoshi24].
template <class T>
T irradiance_estimate(T sharpness, T cos_axis) {
    const T lambda = max(sharpness, T(1e-6f)), c = cos_axis;
    const T t = lambda * sqrt(T(0.5) * ((lambda + T(2.7360832f)) * lambda + T(17.021298f)) /
                              (((lambda + T(4.0100827f)) * lambda + T(15.219156f)) * lambda + T(76.087896f)));
    const T gap = sqr(t) * (T(1) - c) * (T(1) + c);  // expm1 of -gap
    const T share = T(0.5) * (c * erfc(-t * c) + erfc(t)) - exp(-sqr(t * c)) * expm1(-gap) / (T(2) * sqrt(pi<T>) * t);
    const T fading = exp(-lambda), mean = -expm1(-lambda) / lambda;
    // Near 0 what is left of two differences: their series.
    const auto is_wide = lambda < T(0.5f);
    const T up = select(is_wide, T(0.5f) - lambda * (T(1.0f / 6) - lambda * (T(1.0f / 24) - lambda * T(1.0f / 120))),
                        (T(1) - mean) / lambda);
    const T down =
        select(is_wide, fading * (T(0.5f) - lambda * (T(1.0f / 3) - lambda * (T(0.125f) - lambda * T(1.0f / 30)))),
               fading * (mean - fading) / lambda);
    return T(2) * pi<T> * lerp(down, up, share);
}

/// Of the von Mises-Fisher distribution, a Gaussian of directions, whose mean vector is so long [Banerjee05 (4.4)].
template <class T>
T sharpness_of_mean(T mean_length) {
    const T r = min(mean_length, T(1.0f - 1e-6f));
    return r * (T(3) - r * r) / ((T(1) - r) * (T(1) + r));
}

/// Diffuse shading by a VSGL, without the factor reflectance / pi: the cosine pulled out of the integral
/// [Tokuyoshi15, appendix B].
template <class T>
T irradiance_vsgl(const SphericalGaussian<T>& light, T cos_axis) {
    return integrate(light) * max(cos_axis, T(0));
}

/// max(omega.z, 0) exp(-eta_x (omega.x)^2 - eta_y (omega.y)^2) for the frame x, y, z.
template <class T>
struct AnisotropicSphericalGaussian {
    Vec3<T> x, y, z;
    T eta_x, eta_y;
};

template <class T>
T eval(const AnisotropicSphericalGaussian<T>& asg, const Vec3<T>& omega) {
    const T exponent = asg.eta_x * sqr(dot(omega, asg.x)) + asg.eta_y * sqr(dot(omega, asg.y));
    return max(dot(omega, asg.z), T(0)) * exp(-exponent);
}

/// The integral of the product with a Gaussian, near enough for lobes that overlap: 5 % while the axes are
/// within 0.3 rad [Xu13 (9)], [Tokuyoshi15, appendix B]. Specular shading by a VSGL, without its factor M.
template <class T>
T integrate_product(const AnisotropicSphericalGaussian<T>& asg, const SphericalGaussian<T>& sg) {
    const T nu = max(sg.sharpness * T(0.5), std::numeric_limits<T>::min());
    const AnisotropicSphericalGaussian<T> blurred{asg.x, asg.y, asg.z, asg.eta_x * (nu / (asg.eta_x + nu)),
                                                  asg.eta_y * (nu / (asg.eta_y + nu))};
    return pi<T> * exp(sg.log_amplitude) * eval(blurred, sg.axis) / (sqrt(asg.eta_x + nu) * sqrt(asg.eta_y + nu));
}

/// The Gaussian of amplitude 1 nearest to a GGX or Beckmann reflection lobe: NDF sharpness 2 / alpha^2,
/// spread by reflection, around the mirror direction [Tokuyoshi15, appendix A]. The normal is z.
template <class T>
SphericalGaussian<T> ggx_lobe(T alpha, const Vec3<T>& wo_local) {
    const T ndf_sharpness = T(2) / sqr(alpha);
    return {{-wo_local.x, -wo_local.y, wo_local.z}, ndf_sharpness / (T(4) * abs(wo_local.z))};
}

}  // namespace pivot
