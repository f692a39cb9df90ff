// Samples of a cap-shaped light for a surface with lobes beside its base: a mixture of a technique for each highlight,
// the exact core about its own axes, and of one that is even in the cap, for what is spread. Each is chosen about as
// often as it reflects of the light; the density is that of the mixture, so all lobes are weighed by it. Shading frame,
// over float or batches.
#pragma once

#include "core/distributions/projected_cap.h"
#include "core/integrators/joint_sampling.h"

namespace pivot {

/// Even in the cap: by projected solid angle, or, of surfaces that light comes through, by solid angle.
template <class T>
class EvenInCap {
   public:
    EvenInCap(const Cap<T>& cap, const Mask<T>& transmits) : cap_(cap), transmits_(transmits) {
        const T sin2_psi = sin2_half_angle(cap);
        is_above_ = cap.axis.z > T(0) && cap.axis.z * cap.axis.z >= sin2_psi && cap.versine < T(1);
        projected_ = cap.axis.z * sin2_psi;
        if constexpr (std::same_as<T, float>) {
            if (transmits) return;
            // From inside a sphere light the cap is all directions; those that count are the hemisphere.
            const Vec3f normal(0.0f, 0.0f, 1.0f);
            const Cap<float> seen = cap.versine > 1.0f ? Cap<float>{normal, 1.0f} : cap;
            across_horizon_ = projected_cap(seen, normal);
            if (!is_above_) projected_ = clamped_cosine_integral(cap, normal);
        }
    }

    /// Where there is a body for this: everywhere, but for batches' caps across the horizon.
    Mask<T> holds() const {
        if constexpr (std::same_as<T, float>) return true;
        return is_above_ || transmits_;
    }
    /// The share of light from the cap that comes to a surface as even as this.
    T reflected() const { return select(transmits_, T(2) * min(cap_.versine, T(1)), projected_ * T(1.0f / pi<float>)); }

    Vec3<T> sample(const Vec2<T>& u) const {
        if constexpr (std::same_as<T, float>) {
            return transmits_ ? pivot::sample(cap_, u) : pivot::sample(across_horizon_, u);
        } else {
            const T radius = sqrt(u.x), phi = T(2) * pi<T> * u.y;
            Vec3<T> wi(T(0));
            if (any(!transmits_))
                wi = detail::project_to_cap(cap_, Vec2<T>(radius * cos(phi), radius * sin(phi)), T(1) - u.x);
            if (any(transmits_)) wi = select(transmits_, pivot::sample(cap_, u), wi);
            return wi;
        }
    }
    /// Of a direction in the cap.
    T pdf_omega(const Vec3<T>& wi) const {
        const T uniform = T(1) / solid_angle(cap_);
        if constexpr (std::same_as<T, float>) {
            return transmits_ ? uniform : pdf_omega_inside(across_horizon_, wi);
        } else {
            return select(transmits_, uniform, max(wi.z, T(0)) / (pi<T> * max(projected_, tiny<T>)));
        }
    }

   private:
    Cap<T> cap_;
    Mask<T> transmits_, is_above_;
    T projected_;  ///< the cap's projected solid angle, over the part above the horizon
    ProjectedCap<T> across_horizon_;
};

template <class T>
class CapMixture {
   public:
    CapMixture(const SurfaceOf<T>& surface, const Cap<T>& cap) : even_(cap, surface.transmits()) {
        HighlightsOf<T> highlights = highlights_of(surface);
        T beside = joint_surface(surface).diffuse + highlights.beside;
        highlights.add(highlight_about_normal(surface.alpha, surface.fresnel), surface.has_glossy());
        needs_bsdf_ = !highlights.are_close;
        T followed(0), spread = beside * even_.reflected();
        for (const HighlightOf<T>& highlight : highlights) {
            Part& part = parts_[count_];
            part.frame = highlight.frame;
            const Vec3<T> wo = part.frame.to_local(surface.wo_local);
            part.cap =
                ggx_cap(wo, Cap<T>{part.frame.to_local(cap.axis), cap.versine}, highlight.alpha_x, highlight.alpha_y);
            const T fresnel =
                lerp(highlight.fresnel_f0, highlight.fresnel_f90, schlick_weight(min(part.cap.cos_half, T(1))));
            const T reflected = fresnel * projected_integral(part.cap) / surface.wo_local.z *
                                ggx_g1(wo, highlight.alpha_x, highlight.alpha_y);
            const Mask<T> shines = fresnel > T(0) && wo.z > T(0);
            const Mask<T> is_followed = shines && is_cone(part.cap) && reflected > T(0);
            // What has no cone is left to the others, and to BSDF samples.
            const Mask<T> is_left = shines && !is_cone(part.cap);
            needs_bsdf_ = needs_bsdf_ || is_left;
            spread += select(is_left, fresnel * min(cap.versine, T(1)), T(0));
            part.before = followed;
            part.weight = select(is_followed, reflected, T(0));
            followed += part.weight;
            if (any(is_followed)) ++count_;
        }
        const T most = followed * T((1.0f - min_lobe_probability) / min_lobe_probability),
                least = followed * T(min_lobe_probability / (1.0f - min_lobe_probability));
        const Mask<T> is_followed = followed > T(0);
        before_even_ = followed;
        even_weight_ = select(is_followed, select(spread > T(0), min(max(spread, least), most), T(0)), T(1));
        all_ = followed + even_weight_;
    }

    /// Where there is a body for this (see EvenInCap).
    Mask<T> holds() const { return even_.holds() || !(even_weight_ > T(0)); }
    /// Whether lobes may be much larger than the density.
    Mask<T> needs_bsdf_samples() const { return needs_bsdf_; }

    /// u.x also chooses the technique.
    Vec3<T> sample(const Vec2<T>& u) const {
        const T at = u.x * all_;
        const auto left_in = [&](T before, T weight) {
            return Vec2<T>(min(max((at - before) / max(weight, tiny<T>), T(0)), T(1.0f - 0x1p-24f)), u.y);
        };
        Vec3<T> wi(T(0), T(0), T(1));
        if (any(even_weight_ > T(0))) wi = even_.sample(left_in(before_even_, even_weight_));
        for (std::size_t i = 0; i < count_; ++i) {
            const Part& part = parts_[i];
            const Mask<T> is_chosen = at >= part.before && at < part.before + part.weight;
            if (any(is_chosen))
                wi =
                    select(is_chosen,
                           part.frame.to_world(pivot::sample(part.cap, left_in(part.before, part.weight)).omega_i), wi);
        }
        return wi;
    }

    /// Of a direction in the cap.
    T pdf_omega(const Vec3<T>& wi) const {
        T sum(0);
        if (any(even_weight_ > T(0))) sum = select(even_weight_ > T(0), even_weight_ * even_.pdf_omega(wi), T(0));
        for (std::size_t i = 0; i < count_; ++i) {
            const Part& part = parts_[i];
            sum += select(part.weight > T(0), part.weight * pdf_omega_inside(part.cap, part.frame.to_local(wi)), T(0));
        }
        return sum / all_;
    }

   private:
    /// A highlight over the cap.
    struct Part {
        Frame<T> frame;
        GgxCap<T> cap;
        T before, weight;  ///< of choosing it, and those before it
    };

    EvenInCap<T> even_;
    Mask<T> needs_bsdf_;
    std::array<Part, HighlightsOf<T>::most + 1> parts_;
    std::size_t count_ = 0;
    T before_even_, even_weight_, all_;
};

}  // namespace pivot
