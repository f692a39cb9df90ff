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
// value at their centre, which do not end at the horizon, 2 to 50; 3 x 3 nodes 2, 4 x 4 (these) 1, 5 x 5 0.6, 6 columns
// of 5 (these at grazing views) 0.5 for 1.4 times the time of 4 x 4, 8 x 8 0.25 for 2.5 times; nodes about where the
// lobe's ridge leaves the light, as they are, 0.8, and a third in the worst cases at grazing views; nodes even in z /
// sqrt(1 + z^2), Student's own, 1, but 8 in the worst cases, all at grazing views; fitting the stretched half vector in
// the place of its slopes 1; fitting where the mirrored view meets the light's plane, without the step to the least
// slope, 2 to 5 beside the highlight. By relMSE x CPU of three lights over glossy spheres: eight patches cut in eight
// again, chosen by ggx_cap, 4 times that of 3 x 3 cells, for u jumps between patches.
#pragma once

#include "core/bsdf/surface.h"
#include "core/integrators/area_grid.h"
#include "core/integrators/joint_sampling.h"

namespace pivot {

/// What samples of area lights follow of a surface: highlights, its base's first, and what is spread.
template <class T>
struct AreaLobes {
    Vec3<T> wo_local;
    T diffuse;  ///< 0: no such lobe
    HighlightsOf<T> highlights;
    bool first_is_of_base;  ///< the first highlight is about the surface's normal and as rough all around
    Mask<T> are_close;      ///< whether they are the surface's lobes, nearly

    explicit AreaLobes(const SurfaceOf<T>& surface) : wo_local(surface.wo_local) {
        const JointSurface<T> joint = joint_surface(surface);
        diffuse = joint.diffuse;
        first_is_of_base = any(joint.fresnel_f0 + joint.fresnel_f90 > T(0));
        highlights.add(highlight_about_normal(surface.alpha, surface.fresnel), T(0) >= T(0));
        const Mask<T> is_plain = is_like_base(surface);
        are_close = is_plain;
        if (!any(!is_plain)) return;
        const HighlightsOf<T> beside = highlights_of(surface);
        for (const HighlightOf<T>& highlight : beside) highlights.add(highlight, !is_plain);
        diffuse += beside.beside;
        are_close = is_plain || (beside.are_close && highlights.are_close);
    }
    Mask<T> has_highlight() const {
        Mask<T> result = T(0) > T(0);
        for (const HighlightOf<T>& highlight : highlights)
            result = result || highlight.fresnel_f0 + highlight.fresnel_f90 > T(0);
        return result;
    }
};

/// Whether samples of the light would vary without bound, so that BSDF samples must share: very near the light, and at
/// grazing views, where slopes are far from linear in the place, if the light is much wider than the lobe. And always
/// of a mesh's triangles: their choice among many knows less of the lobe than the lobe does.
template <class T>
Mask<T> needs_bsdf_samples(const AreaView<T>& light, const AreaLobes<T>& lobes) {
    const T reach_m = length(light.half_u) + length(light.half_v), distance2 = length_squared(light.center);
    Mask<T> result = light.triangle || distance2 < sqr(T(0.6f) * reach_m) || lobes.wo_local.z < T(0.05f);
    for (const HighlightOf<T>& h : lobes.highlights) {
        const T wo_z = dot(h.frame.z, lobes.wo_local);
        result = result || (h.fresnel_f0 + h.fresnel_f90 > T(0) && wo_z < T(0.15f) &&
                            sqr(reach_m) > sqr(T(10) * min(h.alpha_x, h.alpha_y)) * distance2);
    }
    return result || !lobes.are_close;
}

/// Whether it is a triangle so far away, for its size, that its samples may be even by area: what a lobe makes of it is
/// left to BSDF samples.
template <class T>
Mask<T> is_even_enough(const AreaView<T>& light) {
    const T reach_m = length(light.half_u) + length(light.half_v);
    return light.triangle && sqr(reach_m) < length_squared(light.center);
}

/// Whether a view is so grazing that a highlight's grid needs more nodes: there slopes bend over the light.
template <class T>
Mask<T> needs_finer_grid(const AreaLobes<T>& lobes) {
    return lobes.wo_local.z < T(0.2f) && lobes.has_highlight();
}

/// Joint samples of an area light that shines on the lit point, dot(center, normal) < 0. A highlight's grid has so many
/// nodes along x and along y.
template <class T, std::size_t columns = 4, std::size_t rows = 4>
class AreaSampler {
   public:
    AreaSampler(const AreaLobes<T>& lobes, const AreaView<T>& light) : light_(light) {
        const Mask<T> has_diffuse = lobes.diffuse > T(0), has_highlight = lobes.has_highlight();
        uses_diffuse_ = any(!has_highlight || has_diffuse);
        const detail::AreaSpan<T> x_span = detail::x_above(light);
        const T x = x_span.nearest(T(0));
        const Vec2<T> middle(x, detail::y_above(light, x).nearest(T(0)));
        T diffuse(0);
        if (uses_diffuse_) {
            const Vec2<T> center = detail::fit_diffuse(light, middle).least(light, x_span, middle);
            diffuse_.map = {light, x_span, center, detail::fit_diffuse(light, center)};
            diffuse_.fill(light, [&](const Vec3<T>& wi) { return max(wi.z, T(0)) * light.spread_weight(wi); });
            diffuse = lobes.diffuse * diffuse_.integral * T(1.0f / pi<float>);
        }
        const T least_weight(1e-20f);
        for (const HighlightOf<T>& highlight : lobes.highlights) {
            Part& part = parts_[count_];
            const T reflected = count_ == 0 && lobes.first_is_of_base
                                    ? fit_highlight<false>(highlight, lobes.wo_local, x_span, part.grid)
                                    : fit_highlight<true>(highlight, lobes.wo_local, x_span, part.grid);
            const Mask<T> is_there = highlight.fresnel_f0 + highlight.fresnel_f90 > T(0);
            part.before = before_diffuse_;
            // Also where the fit finds nothing, or is none.
            part.weight = select(is_there, select(reflected > least_weight, reflected, least_weight), T(0));
            before_diffuse_ += part.weight;
            ++count_;
        }
        constexpr float odds = (1.0f - min_lobe_probability) / min_lobe_probability;
        const T both = min(max(diffuse, before_diffuse_ * T(1.0f / odds)), before_diffuse_ * T(odds));
        diffuse_weight_ = select(has_highlight, select(has_diffuse, both, T(0)), T(1));
        all_ = before_diffuse_ + diffuse_weight_;
    }

    const AreaView<T>& light() const { return light_; }

    /// u.x also chooses the lobe.
    AreaSample<T> sample(const Vec2<T>& u) const {
        if (count_ == 0) return diffuse_.sample(light_, u);
        if (count_ == 1 && !uses_diffuse_) return parts_[0].grid.sample(light_, u);
        const T at = u.x * all_;
        const auto left_in = [&](T before, T weight) {
            return Vec2<T>(min(max((at - before) / max(weight, tiny<T>), T(0)), T(1.0f - 0x1p-24f)), u.y);
        };
        Vec2<T> place(T(0), T(0));
        if (uses_diffuse_) place = diffuse_.sample(light_, left_in(before_diffuse_, diffuse_weight_)).place;
        for (std::size_t i = 0; i < count_; ++i) {
            const Part& part = parts_[i];
            const Mask<T> is_chosen = at >= part.before && at < part.before + part.weight;
            if (!any(is_chosen)) continue;
            const Vec2<T> chosen = part.grid.sample(light_, left_in(part.before, part.weight)).place;
            place = {select(is_chosen, chosen.x, place.x), select(is_chosen, chosen.y, place.y)};
        }
        return {place, pdf(place)};
    }

    /// Density of sample() by (x, y).
    T pdf(const Vec2<T>& at) const {
        if (count_ == 0) return diffuse_.pdf(light_, at);
        T sum = uses_diffuse_ ? diffuse_weight_ * diffuse_.pdf(light_, at) : T(0);
        for (std::size_t i = 0; i < count_; ++i) {
            const Part& part = parts_[i];
            sum += select(part.weight > T(0), part.weight * part.grid.pdf(light_, at), T(0));
        }
        return sum / all_;
    }

   private:
    using HighlightGrid = detail::AreaGrid<T, columns, rows>;

    /// Fits a highlight's grid; returns about what the lobe reflects. turned: whether it has axes of its own.
    template <bool turned>
    T fit_highlight(const HighlightOf<T>& highlight, const Vec3<T>& wo_local, const detail::AreaSpan<T>& x_span,
                    HighlightGrid& grid) const {
        const auto own = [&](const Vec3<T>& v) {
            if constexpr (turned) return highlight.frame.to_local(v);
            return v;
        };
        AreaView<T> light = light_;
        if constexpr (turned) {
            light.center = own(light.center), light.normal = own(light.normal);
            light.half_u = own(light.half_u), light.half_v = own(light.half_v);
        }
        Vec3<T> wo = own(wo_local);
        if constexpr (turned) wo.z = max(wo.z, T(1e-4f));
        const T alpha_x = highlight.alpha_x, alpha_y = turned ? highlight.alpha_y : alpha_x;
        const Vec3<T> per_alpha(inverse(alpha_x), turned ? inverse(alpha_y) : inverse(alpha_x), T(0));
        // From the light's place nearest to where the mirrored view meets its plane.
        const Vec3<T> mirrored(-wo.x, -wo.y, wo.z);
        const T towards = max(-dot(mirrored, light.normal), T(1e-4f));
        Vec3<T> offset = mirrored * (-dot(light.center, light.normal) / towards) - light.center;
        if constexpr (turned) offset = highlight.frame.to_world(offset);
        const Vec2<T> from = detail::nearest_place(light_, x_span, offset);
        const Vec2<T> center = detail::fit_glossy(light, wo, per_alpha, from).least(light_, x_span, from);
        grid.map = {light_, x_span, center, detail::fit_glossy(light, wo, per_alpha, center)};

        const T alpha2 = alpha_x * alpha_y, room = T(1) - alpha2;
        const T ratio = turned ? alpha_y * per_alpha.x : T(1), inverse_ratio = turned ? alpha_x * per_alpha.y : T(1);
        // 1 + 2 Lambda, times the cosine.
        const auto unmasked = [&](const Vec3<T>& w, T cosine) {
            if constexpr (turned) return sqrt(sqr(alpha_x * w.x) + sqr(alpha_y * w.y) + sqr(cosine));
            return sqrt(alpha2 + room * sqr(cosine));
        };
        const T masked_view = unmasked(wo, wo.z) * inverse(wo.z);
        grid.fill(light_, [&](const Vec3<T>& wi_local) {
            const Vec3<T> wi = own(wi_local), h = wo + wi;
            const T x2 = sqr(h.x), y2 = sqr(h.y), up2 = sqr(h.z), cos_i = max(wi.z, T(0));
            const T across2 = turned ? ratio * x2 + inverse_ratio * y2 : x2 + y2;
            const T shadowed = cos_i * masked_view + unmasked(wi, cos_i);
            return sqr(x2 + y2 + up2) * cos_i * inverse(sqr(across2 + alpha2 * up2) * shadowed) *
                   light_.spread_weight(wi_local);
        });
        const Vec3<T> h = wo_local + see(light_, center).wi;
        const T cos_oh = min(dot(wo_local, h) * inverse_sqrt(max(dot(h, h), tiny<T>)), T(1));
        const T fresnel = lerp(highlight.fresnel_f0, highlight.fresnel_f90, schlick_weight(cos_oh));
        return fresnel * grid.integral * alpha2 * inverse(T(2.0f * pi<float>) * wo.z);
    }

    struct Part {
        HighlightGrid grid;
        T before, weight;  ///< of choosing it, and those before it
    };

    AreaView<T> light_;
    detail::AreaGrid<T, 3, 3> diffuse_;
    std::array<Part, HighlightsOf<T>::most> parts_;
    std::size_t count_ = 0;
    T before_diffuse_ = T(0), diffuse_weight_, all_;
    bool uses_diffuse_;
};

/// Where needs_finer_grid() says so.
template <class T>
using FinerAreaSampler = AreaSampler<T, 6, 5>;

}  // namespace pivot
