// What is beneath a surface, from what an artist sets: the colour that comes out of it, and how far light gets.
//
// [Wrenninge17]  Path Traced Subsurface Scattering using Anisotropic Phase Functions and Non-Exponential Free Flights:
//                the fit of the single-scattering albedo for a half-space's, at mean cosines from 0 to 0.9
// [dEon22]       A Hitchhiker's Guide to Multiple Scattering, v0.3.2: the same of isotropic scattering, and similarity
// [Jensen01]     A Practical Model for Subsurface Light Transport
#pragma once

#include "core/math/vector.h"

namespace pivot {

/// Homogeneous; of each colour: 1/m, and the share of a collision that is scattered.
struct SubsurfaceMedium {
    Rgb sigma_t, albedo;
    float g;  ///< Henyey-Greenstein's mean cosine
};

/// Single-scattering albedos keep below 1: nothing real does not absorb.
inline constexpr float max_scattering_albedo = 0.999999f;

namespace detail {

/// Coefficients from the constant one on.
template <std::size_t n>
float polynomial(const float (&coefficients)[n], float x) {
    float sum = 0.0f;
    for (std::size_t i = n; i-- > 0;) sum = sum * x + coefficients[i];
    return sum;
}

}  // namespace detail

/// The albedo of single scattering of a medium whose half-space sends back `albedo` of a furnace's light, at g in [0,
/// 0.9] [Wrenninge17].
inline float scattering_albedo_by_fit(float albedo, float g) {
    constexpr float a[] = {1.8260523782f,   -1.28451056436f, -1.79904629312f, 9.19393289202f,
                           -22.8215585862f, 32.0234874259f,  -23.6264803333f, 7.21067002658f};
    constexpr float b[] = {0.0f,           31.1491581433f,  -201.847017512f, 841.576016723f, -2018.09288505f,
                           2731.71560286f, -1935.41424244f, 559.009054474f};
    constexpr float c[] = {1.09686102424f, -0.394704063468f, 1.05258115941f, -8.83963712726f,
                           28.8643230661f, -46.8802913581f,  38.5402837518f, -12.7181042538f};
    constexpr float d[] = {0.496310210422f, 0.360146581622f, -2.15139309747f, 17.8896899217f,
                           -55.2984010333f, 82.065982243f,   -58.5106008578f, 15.8478295021f};
    constexpr float e[] = {0.0f,           76.7316253952f,  -594.356773233f, 2448.8834203f, -5576.68528998f,
                           7116.60171912f, -4763.54467887f, 1303.5318055f};
    constexpr float f[] = {2.40602999408f, -2.51814844609f, 9.18494908356f, -79.2191708682f,
                           259.082868209f, -403.613804597f, 302.85712436f,  -87.4370473567f};
    using detail::polynomial;
    const float inner_b = 4.98511194385f + 0.127355959438f * std::exp(polynomial(b, g));
    const float inner_e = 4.23190299701f + 0.00310603949088f * std::exp(polynomial(e, g));
    const float low = polynomial(a, g) * std::pow(std::atan(inner_b * albedo), polynomial(c, g));
    const float high = polynomial(d, g) * std::pow(std::atan(inner_e * albedo), polynomial(f, g));
    return std::clamp(lerp(low, high, std::sqrt(std::sqrt(albedo))), 0.0f, max_scattering_albedo);
}

/// The same at any g: the isotropic medium that is similar, inverted [dEon22 (53.7)].
inline float scattering_albedo_by_similarity(float albedo, float g) {
    const float s = 4.20863f * albedo + 4.09712f - std::sqrt(9.59217f + albedo * (41.6808f + albedo * 17.7126f));
    const float absorbed = sqr(s);
    return std::clamp((1.0f - absorbed) / std::max(1.0f - g * absorbed, 1e-6f), 0.0f, max_scattering_albedo);
}

/// The mean free path over the diffusion length, of a medium beneath a boundary of that ior that diffusely reflects
/// `albedo`: sqrt(3 (1 - alpha')), where the dipole's reflectance alpha' / 2 (1 + exp(-4/3 A s)) exp(-s), s that root,
/// is the albedo [Jensen01, 2.3 and (15)].
inline float path_per_diffusion_length(float albedo, float ior) {
    const float inside = -1.44f / sqr(ior) + 0.71f / ior + 0.668f + 0.0636f * ior;  // what the boundary keeps inside
    const float boundary = 4.0f / 3.0f * (1.0f + inside) / (1.0f - inside);
    // The reflectance falls as s grows: halve where it may be.
    float low = 0.0f, high = std::sqrt(3.0f);
    for (int i = 0; i < 24; ++i) {
        const float s = 0.5f * (low + high);
        const float reflected = 0.5f * (1.0f - sqr(s) / 3.0f) * (1.0f + std::exp(-boundary * s)) * std::exp(-s);
        (reflected > albedo ? low : high) = s;
    }
    return std::max(0.5f * (low + high), 1e-3f);
}

}  // namespace pivot
