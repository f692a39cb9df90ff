// A hair: a rough dielectric cylinder with absorption within and scales that lean towards its tip. What it reflects
// (R), lets through (TT), mirrors within (TRT), and all that stays longer. Blender's Principled Hair BSDF after Chiang.
// Shading frame: x along the hair, z the normal of its round surface.
//
// [Chiang16]     A Practical and Controllable Hair and Fur Model for Production Path Tracing
// [dEon11]       An Energy-Conserving Hair Reflectance Model
// [Abramowitz64] Handbook of Mathematical Functions, 9.8.1 and 9.8.2
//
// The scales turn the viewer's direction, not the light's, so that each part's density is exact.
#pragma once

#include "core/bsdf/base.h"
#include "core/bsdf/fresnel.h"
#include "core/bsdf/highlight.h"
#include "core/bsdf/lobe_record.h"

namespace pivot {

/// exp(-x) I0(x), the modified Bessel function, x >= 0. [Abramowitz64]
template <class T>
T bessel_i0_scaled(T x) {
    const T t = sqr(x * T(1.0f / 3.75f)), r = T(3.75f) / max(x, T(3.75f));
    const T low =
        T(1) +
        t * (T(3.5156229f) +
             t * (T(3.0899424f) + t * (T(1.2067492f) + t * (T(0.2659732f) + t * (T(0.0360768f) + t * T(0.0045813f))))));
    const T high = T(0.39894228f) +
                   r * (T(0.01328592f) +
                        r * (T(0.00225319f) +
                             r * (T(-0.00157565f) +
                                  r * (T(0.00916281f) +
                                       r * (T(-0.02057706f) +
                                            r * (T(0.02635537f) + r * (T(-0.01647633f) + r * T(0.00392377f))))))));
    return select(x < T(3.75f), low * exp(-min(x, T(3.75f))), high * inverse_sqrt(max(x, T(3.75f))));
}

template <class T>
struct Hair {
    struct Parameters {
        Vec3<T> color{T(1)};            ///< scales what it scatters
        Vec3<T> absorption{T(1)};       ///< within, of each radius
        T variance = T(0.05f);          ///< of directions along the hair
        T primary_variance = T(0.05f);  ///< likewise, of what it reflects at once
        T scale = T(0.2f);              ///< of the logistic distribution of directions around the hair
        T tilt_rad = T(0.035f);         ///< of its scales
        T ior = T(1.55f);
    };
    static constexpr std::string_view name = "hair";
    static constexpr float most = std::numeric_limits<float>::max(), least = 1e-6f;
    static constexpr std::array parameters{
        LobeParameter{"color", 3, 0.0f, most},     LobeParameter{"absorption", 3, 0.0f, most},
        LobeParameter{"variance", 1, least, most}, LobeParameter{"primary_variance", 1, least, most},
        LobeParameter{"scale", 1, 1e-3f, most},    LobeParameter{"tilt_rad", 1, -1.6f, 1.6f},
        LobeParameter{"ior", 1, 1.0f, most}};
    static constexpr bool reflects = true, transmits = true, has_closed_form = false, is_of_strands = true;
    static constexpr std::size_t part_count = 4;  // R, TT, TRT, and what is left

    std::array<Vec3<T>, part_count> shares;  ///< of the light, by part
    T variance, primary_variance, scale, tilt_rad;
    T gamma_o, gamma_t;  ///< angles to the normal across the hair: of the viewer, and within

    static Hair seen(const Parameters& p, const Vec3<T>& wo_local) {
        const T sin_o = wo_local.x, cos_o = safe_sqrt(T(1) - sqr(sin_o));
        const T across = inverse_sqrt(max(sqr(wo_local.y) + sqr(wo_local.z), tiny<T>));
        const T sin_gamma_o = min(max(-wo_local.y * across, T(-1)), T(1));
        const T cos_gamma_o = safe_sqrt(T(1) - sqr(sin_gamma_o));
        const T sin_gamma_t =
            min(max(sin_gamma_o * cos_o * inverse_sqrt(max(sqr(p.ior) - sqr(sin_o), tiny<T>)), T(-1)), T(1));
        const T cos_gamma_t = safe_sqrt(T(1) - sqr(sin_gamma_t));
        const T cos_t = safe_sqrt(T(1) - sqr(sin_o / p.ior));
        const T fresnel = clamp01(fresnel_dielectric(cos_o * cos_gamma_o, max(p.ior, T(1.0001f))));
        const Vec3<T> depth = p.absorption * (T(2) * cos_gamma_t / max(cos_t, T(1e-4f)));
        const Vec3<T> left(exp(-depth.x), exp(-depth.y), exp(-depth.z));  // [Chiang16 (13)]
        const Vec3<T> through = p.color * sqr(T(1) - fresnel) * left, again = left * fresnel;
        const Vec3<T> rest = through * again * again;
        return {{p.color * fresnel, through, through * again, rest / max(Vec3<T>(T(1)) - again, Vec3<T>(T(1e-4f)))},
                max(p.variance, T(least)),
                max(p.primary_variance, T(least)),
                max(p.scale, T(1e-3f)),
                p.tilt_rad,
                asin(sin_gamma_o),
                asin(sin_gamma_t)};
    }
    Vec3<T> eval(const Vec3<T>& wo_local, const Vec3<T>& wi_local) const {
        Vec3<T> value(T(0));
        for_each_part(wo_local, wi_local, [&](std::size_t part, T density) { value += shares[part] * density; });
        return value;
    }
    T pdf_omega(const Vec3<T>& wo_local, const Vec3<T>& wi_local) const {
        const std::array<T, part_count> chances = probabilities();
        T pdf(0);
        for_each_part(wo_local, wi_local, [&](std::size_t part, T density) { pdf += chances[part] * density; });
        return pdf;
    }
    Vec3<T> sample(const Vec3<T>& wo_local, T u_lobe, const Vec2<T>& u) const {
        const std::array<T, part_count> chances = probabilities();
        T left = u_lobe, u_cone(0), part_variance(0), turn(0), center(0);
        Mask<T> is_open = T(0)<T(1), is_even = T(0)> T(1);
        for (std::size_t part = 0; part < part_count; ++part) {
            const bool is_last = part + 1 == part_count;
            const Mask<T> is_chosen = is_open && (left < chances[part] || T(is_last ? 1 : 0) > T(0));
            u_cone = select(is_chosen, clamp01(left / max(chances[part], tiny<T>)), u_cone);
            part_variance = select(is_chosen, variance_of(part), part_variance);
            turn = select(is_chosen, turn_of(part), turn);
            center = select(is_chosen, center_of(part), center);
            if (is_last) is_even = is_chosen;
            is_open = is_open && !is_chosen;
            left -= chances[part];
        }
        const auto [sin_o, cos_o] = turned(wo_local, turn);
        // About the cone that is turned from wo's. [dEon11, Importance Sampling]
        const T u_kept = max(u_cone, T(1e-6f));
        const T cos_cone =
            max(T(1) + part_variance * log(u_kept + (T(1) - u_kept) * exp(T(-2) / part_variance)), T(-1));
        const T sin_i =
            min(max(safe_sqrt(T(1) - sqr(cos_cone)) * cos(T(2) * pi<T> * u.x) * cos_o - cos_cone * sin_o, T(-1)), T(1));
        const T cos_i = safe_sqrt(T(1) - sqr(sin_i));
        const T start = logistic_below(T(-1) * pi<T>);
        const T u_kept_around = min(max(start + u.y * (T(1) - T(2) * start), T(1e-7f)), T(1.0f - 1e-7f));
        const T offset = min(max(T(-1) * scale * log(T(1) / u_kept_around - T(1)), T(-1) * pi<T>), pi<T>);
        const T phi = phi_of_viewer() + select(is_even, T(2) * pi<T> * u.y, center + offset);
        return {sin_i, cos_i * cos(phi), cos_i * sin(phi)};
    }
    Vec3<T> albedo(const Vec3<T>&) const { return shares[0] + shares[1] + shares[2] + shares[3]; }
    Vec3<T> diffuse() const { return Vec3<T>(T(0)); }
    BaseOf<T> closed_form(const Vec3<T>& wo_local) const {
        return make_base(BaseMaterialOf<T>{.diffuse = albedo(wo_local)}, wo_local);
    }
    Hair blurred(T least_alpha) const {
        Hair result = *this;
        result.variance = max(variance, least_alpha);
        result.primary_variance = max(primary_variance, least_alpha);
        result.scale = max(scale, least_alpha);
        return result;
    }

   private:
    /// Azimuth about the hair, from y: wo lies above the surface.
    T phi_of_viewer() const { return gamma_o + T(0.5f) * pi<T>; }
    T variance_of(std::size_t part) const {
        return part == 0 ? primary_variance : variance * T(part == 1 ? 0.25f : 4.0f);
    }
    /// How far scales turn the viewer's direction along the hair. [Chiang16, 2.1]
    T turn_of(std::size_t part) const {
        constexpr std::array<float, part_count> turns{2.0f, -1.0f, -4.0f, 0.0f};
        return T(turns[part]) * tilt_rad;
    }
    /// How much further about the hair a part leaves than it came. [dEon11 (5)]
    T center_of(std::size_t part) const {
        const T passages(static_cast<float>(part));
        return T(2) * passages * gamma_t - T(2) * gamma_o + passages * pi<T>;
    }
    static std::array<T, 2> turned(const Vec3<T>& wo_local, T turn) {
        const T sin_o = wo_local.x, cos_o = safe_sqrt(T(1) - sqr(sin_o)), s = sin(turn), c = cos(turn);
        return {sin_o * c + cos_o * s, abs(cos_o * c - sin_o * s)};
    }
    std::array<T, part_count> probabilities() const {
        std::array<T, part_count> chances;
        T total(tiny<T>);
        for (std::size_t part = 0; part < part_count; ++part) total += chances[part] = mean_component(shares[part]);
        for (T& chance : chances) chance = chance / total;
        return chances;
    }
    /// The logistic distribution's share below x, at most 0.
    T logistic_below(T x) const {
        const T e = exp(max(x / scale, T(-80)));
        return e / (T(1) + e);
    }
    /// Calls visit(part, density over solid angle) for each.
    template <class Visit>
    void for_each_part(const Vec3<T>& wo_local, const Vec3<T>& wi_local, const Visit& visit) const {
        const T sin_i = wi_local.x, cos_i = safe_sqrt(T(1) - sqr(sin_i));
        const T phi = atan2(wi_local.z, wi_local.y) - phi_of_viewer();
        const T kept = T(1) / (T(1) - T(2) * logistic_below(T(-1) * pi<T>));
        for (std::size_t part = 0; part < part_count; ++part) {
            const auto [sin_o, cos_o] = turned(wo_local, turn_of(part));
            const T v = variance_of(part), a = cos_i * cos_o / v;
            const T along = bessel_i0_scaled(a) * exp(max((cos_i * cos_o - sin_i * sin_o - T(1)) / v, T(-80))) /
                            (v * (T(1) - exp(T(-2) / v)));  // [dEon11 (7)]
            T around(0.5f / pi<float>);
            if (part + 1 < part_count) {
                const T from_center = phi - center_of(part);
                const T x = from_center - T(2) * pi<T> * floor(from_center * T(0.5f / pi<float>) + T(0.5f));
                const T e = exp(max(T(-1) * abs(x) / scale, T(-80)));
                around = kept * e / (scale * sqr(T(1) + e));  // [Chiang16 (11)]
            }
            visit(part, along * around);
        }
    }
};

}  // namespace pivot
