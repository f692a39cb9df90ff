// How much of a light, or of lights together, a vertex reflects if nothing is in the way, nearly: what light_choice.h
// chooses by.
//
// A light, and lights together, are a Gaussian about their mean direction, by which GGX, as SGGX, is widened
// [Tokuyoshi24]. In place of the paper's fits of error functions, and of products of Gaussians, are algebraic forms: a
// few operations, with tails that no float loses. Only a light by itself is known to shine from one side, or in a cone.
// (GGX's closed form over the light's cap in the place of its Gaussian: no less noise, with 60 spheres in view.)
//   [Tokuyoshi24] "Hierarchical Light Sampling with Accurate Spherical Gaussian Lighting"
//   [Heitz15]     "The SGGX Microflake Distribution"
#pragma once

#include "core/integrators/joint_sampling.h"
#include "core/integrators/vertex.h"
#include "core/lights/light_tree.h"

namespace pivot {

/// A vertex, or a place in fog, as lights are weighed for it.
template <class T>
struct LightReceiverOf {
    Vec3<T> position;
    Frame<T> frame;  ///< z the normal; the viewer at wo.y = 0
    T wo_x, wo_z, alpha2;
    T wide, across;  ///< how much light's variance widens the lobe's squared slopes along wo and across
    T diffuse;
    T fresnel_f0, fresnel_f90;  ///< both 0: no glossy lobe
    T above, below;             ///< what further lobes send on, by the side that it comes from
    T around;                   ///< what fog scatters alike from all sides
};
using LightReceiver = LightReceiverOf<Batch>;

LightReceiver light_receiver(const VertexOf<Batch>& vertices);
/// The same in each lane.
LightReceiver light_receiver(const Vec3f& position);

struct LightImportance {
    Batch reflected;  ///< relative to each other only; above 0 for each light that may reach the receiver
    Batch variance;   ///< of the directions that it comes from
};

namespace detail {

// The instruction set's estimates, to 11 bits: more would change no choice that matters.
inline Batch about_inverse(const Batch& x) { return xsimd::reciprocal(x); }
inline Batch about_inverse_sqrt(const Batch& x) { return xsimd::rsqrt(x); }

/// Of a Gaussian of directions, its mean's cosine z and variance (of either angle): the mean of its clamped cosine,
/// about.
inline Batch mean_cosine(const Batch& z, const Batch& variance) {
    const Batch one(1.0f), zero(0.0f), spread = Batch(2.0f / pi<float>) * max(variance, Batch(1e-12f));
    const Batch c = z * about_inverse(one + variance), tail = spread * about_inverse(one + Batch(4.0f) * spread);
    const Batch root = sqrt(c * c + tail);
    // Below the horizon the difference would be lost to rounding.
    return Batch(0.5f) * select(c < zero, tail * about_inverse(root - min(c, zero)), c + root);
}

/// GGX's reflection density towards wi, its normals widened by what light of that variance spreads half vectors: by 1/2
/// along the plane of incidence and 1 / (2 cos_o) across [Tokuyoshi24, Heitz15]. By half of the paper's variance, as
/// SGGX has longer tails than light has: choices vary a third less.
inline Batch widened_ggx(const LightReceiver& r, const Vec3b& wi, const Batch& variance) {
    const Batch one(1.0f), wide = r.wide * variance, across = r.across * variance;
    const Batch s1 = (r.alpha2 + wide) * about_inverse(one + wide);
    const Batch s2 = (r.alpha2 + across) * about_inverse(one + across);
    const Vec3b h(r.wo_x + wi.x, wi.y, r.wo_z + wi.z);
    const Batch h2 = dot(h, h), s12 = s1 * s2;
    const Batch slope = h.x * h.x * s2 + h.y * h.y * s1 + h.z * h.z * s12;
    const Batch ndf = s12 * sqrt(s12) * sqr(h2 * about_inverse(max(slope, Batch(1e-18f))));
    return ndf * Batch(0.25f / pi<float>) * about_inverse_sqrt(s1 * r.wo_x * r.wo_x + r.wo_z * r.wo_z);
}

/// Its masking towards light at that cosine.
inline Batch masked_towards(const LightReceiver& r, const Batch& cos_i) {
    const Batch one(1.0f), c2 = cos_i * cos_i;
    return Batch(2.0f) * cos_i * about_inverse(cos_i + sqrt(r.alpha2 + (one - r.alpha2) * c2));
}

}  // namespace detail

/// Lanes are receivers, or lights.
[[gnu::always_inline]] inline LightImportance light_importance(const LightReceiver& r,
                                                               const LightProxyOf<Batch>& light) {
    using namespace detail;
    const Batch zero(0.0f), one(1.0f);
    const Vec3b to_mean = light.mean - r.position * light.is_placed;
    const Batch distance2 = max(dot(to_mean, to_mean), Batch(1e-20f)), inverse_distance = inverse_sqrt(distance2);
    const Vec3b towards = to_mean * inverse_distance;
    const auto is_alone = light.radius_m > zero;

    // What it shines this way.
    Batch lit = one;
    if (any(light.axis.x != zero || light.axis.y != zero || light.axis.z != zero)) {
        const Batch facing = -dot(towards, light.axis);
        Batch together = one;
        // Some of them may shine where most do not.
        if (any(light.sharpness > zero)) together = exp(light.sharpness * (facing - one)) + Batch(0.01f);
        // A sphere of some size is lit in part where its centre is dark.
        const Batch spread = light.is_smooth * light.radius_m * inverse_distance;
        const Batch cosine = select(light.is_two_sided > zero, abs(facing), facing);
        const Batch part = clamp01((cosine + spread - light.cos_edge) * light.inverse_falloff_width);
        const Batch smooth = max(falloff_of(part), Batch(0.01f));
        const Batch alone = select(light.is_smooth > zero, smooth, part);
        lit = select(is_alone, alone, together);
    }
    const Batch variance = light.variance_m2 * inverse_distance * inverse_distance;
    // Irradiance of a surface that faces it: finite also in its midst.
    const Batch irradiance = light.intensity * lit * about_inverse(distance2 + Batch(0.5f) * light.variance_m2);
    const Vec3b wi = r.frame.to_local(towards);
    const Batch cosine = mean_cosine(wi.z, variance);
    Batch reflected = (r.diffuse + r.above) * cosine * Batch(1.0f / pi<float>);
    if (any(r.fresnel_f0 + r.fresnel_f90 > zero)) {
        const Vec3b h(r.wo_x + wi.x, wi.y, r.wo_z + wi.z);
        const Batch fresnel = lerp(r.fresnel_f0, r.fresnel_f90, schlick_weight(Batch(0.5f) * sqrt(dot(h, h))));
        reflected += fresnel * widened_ggx(r, wi, variance) * masked_towards(r, cosine);
    }
    reflected = select(wi.z + light.bound_m * inverse_distance > zero, reflected, zero);
    if (any(r.below > zero)) {
        const auto reaches = light.bound_m * inverse_distance - wi.z > zero;
        reflected += select(reaches, r.below * mean_cosine(-wi.z, variance) * Batch(1.0f / pi<float>), zero);
    }
    reflected += r.around;
    // Where there is no light, what is above has no meaning.
    return {select(light.intensity > zero, reflected * irradiance, zero), variance};
}

}  // namespace pivot
