// Samples of an area light in proportion to what a surface reflects of its parts. Each lobe has a grid of nodes on what
// of the light is above the surface; samples follow the integrand at the nodes, bilinear between them. The grid is fit
// to the lobe, so few nodes do. Shading frame about the lit point, over float or SIMD batches.
//
// The GGX lobe is Student's t distribution of half-vector slopes, (1 + |m|^2 / alpha^2)^-2. Near the light's place that
// comes nearest to the mirrored view its slopes are linear in the place (x, y) on the light, so the lobe is such a
// distribution there too: of x, and of y given x about a sheared centre. The diffuse lobe under an area light,
// cos cos / d^2, is cos_i times the same distribution of d, and exactly. Nodes are even in the half angle's tangent
// q = z / (1 + sqrt(1 + z^2)) of z = (x - center) / scale, whose tail is that of 1 / z^2: heavier than Student's, as
// lobes are at grazing views. u.x and u.y move the sample monotonously along x and y: stratification lasts.
//
// Tried, by the variance of samples (tests/benchmark/area_light_samples.py), the smaller the better: 3 x 3 cells of one
// value at their centre, which do not end at the horizon, 2 to 50; 3 x 3 nodes 2, 4 x 4 (these) 1, 5 x 5 0.5; nodes
// even in z / sqrt(1 + z^2), Student's own, 1, but 8 in the worst cases, all at grazing views; fitting the stretched
// half vector in the place of its slopes 1; fitting where the mirrored view meets the light's plane, without the step
// to the least slope, 2 to 5 beside the highlight. By relMSE x CPU of three lights over glossy spheres: eight patches
// cut in eight again, chosen by ggx_cap, 4 times that of 3 x 3 cells, for u jumps between patches.
#pragma once

#include "core/bsdf/surface.h"
#include "core/integrators/area_grid.h"
#include "core/integrators/joint_sampling.h"

namespace pivot {

/// Whether samples of the light would vary without bound, so that BSDF samples must share: very near the light, and at
/// grazing views, where slopes are far from linear in the place, if the light is much wider than the lobe. And always
/// of a mesh's triangles: their choice among many knows less of the lobe than the lobe does.
template <class T>
Mask<T> needs_bsdf_samples(const AreaView<T>& light, const JointSurface<T>& surface) {
    const T reach_m = length(light.half_u) + length(light.half_v), distance2 = length_squared(light.center);
    const Mask<T> is_wide = surface.fresnel_f0 + surface.fresnel_f90 > T(0) && surface.wo_local.z < T(0.15f) &&
                            sqr(reach_m) > sqr(T(10) * surface.alpha) * distance2;
    return light.triangle || distance2 < sqr(T(0.6f) * reach_m) || is_wide || surface.wo_local.z < T(0.05f);
}

/// Whether it is a triangle so far away, for its size, that its samples may be even by area: what a lobe makes of it is
/// left to BSDF samples.
template <class T>
Mask<T> is_even_enough(const AreaView<T>& light) {
    const T reach_m = length(light.half_u) + length(light.half_v);
    return light.triangle && sqr(reach_m) < length_squared(light.center);
}

/// Joint samples of an area light that shines on the lit point, dot(center, normal) < 0.
template <class T>
class AreaSampler {
   public:
    AreaSampler(const JointSurface<T>& surface, const AreaView<T>& light) : light_(light) {
        const Mask<T> has_diffuse = surface.diffuse > T(0);
        const Mask<T> has_glossy = surface.fresnel_f0 + surface.fresnel_f90 > T(0);
        uses_diffuse_ = any(!has_glossy || has_diffuse);
        uses_glossy_ = any(has_glossy);
        const detail::AreaSpan<T> x_span = detail::x_above(light);
        const T x = x_span.nearest(T(0));
        const Vec2<T> middle(x, detail::y_above(light, x).nearest(T(0)));
        T diffuse(0), glossy(0);
        if (uses_diffuse_) {
            const Vec2<T> center = detail::fit_diffuse(light, middle).least(light, x_span, middle);
            diffuse_ = {light, x_span, center, detail::fit_diffuse(light, center)};
            diffuse_.fill(light, [&](const Vec3<T>& wi) { return max(wi.z, T(0)) * light.spread_weight(wi); });
            diffuse = surface.diffuse * diffuse_.integral * T(1.0f / pi<float>);
        }
        if (uses_glossy_) glossy = fit_highlight(surface, x_span);
        const T share = glossy * inverse(max(diffuse + glossy, tiny<T>));
        const T both = max(min(share, T(1.0f - min_lobe_probability)), T(min_lobe_probability));
        glossy_probability_ = select(has_glossy, select(has_diffuse, both, T(1)), T(0));
    }

    const AreaView<T>& light() const { return light_; }

    /// u.x also chooses the lobe.
    AreaSample<T> sample(const Vec2<T>& u) const {
        if (!uses_glossy_) return diffuse_.sample(light_, u);
        if (!uses_diffuse_) return glossy_.sample(light_, u);
        const Mask<T> is_glossy = u.x < glossy_probability_;
        const T u_x = select(is_glossy, u.x / max(glossy_probability_, tiny<T>),
                             (u.x - glossy_probability_) / max(T(1) - glossy_probability_, tiny<T>));
        const Vec2<T> glossy = glossy_.sample(light_, {u_x, u.y}).place;
        const Vec2<T> diffuse = diffuse_.sample(light_, {u_x, u.y}).place;
        const Vec2<T> place(select(is_glossy, glossy.x, diffuse.x), select(is_glossy, glossy.y, diffuse.y));
        return {place, pdf(place)};
    }

    /// Density of sample() by (x, y).
    T pdf(const Vec2<T>& at) const {
        const T diffuse = uses_diffuse_ ? diffuse_.pdf(light_, at) : T(0);
        return uses_glossy_ ? lerp(diffuse, glossy_.pdf(light_, at), glossy_probability_) : diffuse;
    }

   private:
    /// Fits the highlight's grid; returns about what the lobe reflects.
    T fit_highlight(const JointSurface<T>& surface, const detail::AreaSpan<T>& x_span) {
        const Vec3<T>& wo = surface.wo_local;
        // From the light's place nearest to where the mirrored view meets its plane.
        const Vec3<T> mirrored(-wo.x, -wo.y, wo.z);
        const T towards = max(-dot(mirrored, light_.normal), T(1e-4f));
        const Vec3<T> offset = mirrored * (-dot(light_.center, light_.normal) / towards) - light_.center;
        const T per_m2 = inverse(light_.parallelogram_m2);
        const T x = x_span.nearest(dot(offset, cross(light_.half_v, light_.normal)) * per_m2);
        const T y = detail::y_above(light_, x).nearest(dot(offset, cross(light_.normal, light_.half_u)) * per_m2);
        const Vec2<T> center =
            detail::fit_glossy(light_, wo, surface.alpha, Vec2<T>(x, y)).least(light_, x_span, Vec2<T>(x, y));
        glossy_ = {light_, x_span, center, detail::fit_glossy(light_, wo, surface.alpha, center)};

        const T alpha2 = sqr(surface.alpha), room = T(1) - alpha2;
        const T masked_view = sqrt(alpha2 + room * sqr(wo.z)) * inverse(wo.z);  // 1 + 2 Lambda
        glossy_.fill(light_, [&](const Vec3<T>& wi) {
            const Vec3<T> h = wo + wi;
            const T across2 = sqr(h.x) + sqr(h.y), up2 = sqr(h.z), cos_i = max(wi.z, T(0));
            const T shadowed = cos_i * masked_view + sqrt(alpha2 + room * sqr(cos_i));
            return sqr(across2 + up2) * cos_i * inverse(sqr(across2 + alpha2 * up2) * shadowed) *
                   light_.spread_weight(wi);
        });
        const Vec3<T> h = wo + see(light_, center).wi;
        const T cos_oh = min(dot(wo, h) * inverse_sqrt(max(dot(h, h), tiny<T>)), T(1));
        const T fresnel = lerp(surface.fresnel_f0, surface.fresnel_f90, schlick_weight(cos_oh));
        return fresnel * glossy_.integral * alpha2 * inverse(T(2.0f * pi<float>) * wo.z);
    }

    AreaView<T> light_;
    detail::AreaGrid<T, 3> diffuse_;
    detail::AreaGrid<T, 4> glossy_;
    T glossy_probability_;
    bool uses_diffuse_, uses_glossy_;
};

}  // namespace pivot
