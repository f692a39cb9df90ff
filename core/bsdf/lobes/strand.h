// A strand seen as a thin bright line: light leaves it in a cone about it, mirrored along it, towards the viewer's side
// or to the other. Blender's Hair BSDF, Reflection and Transmission. Shading frame: x along the strand, z the normal of
// its round surface.
//
// [Cycles 4.5 closure/bsdf_hair.h], from whose equations this is: along the strand the half angle is distributed as
// Cauchy's, around it as a cosine (Reflection) or Cauchy's (Transmission). Samples of the BSDF, which find worlds and
// other surfaces, carry more of it than lamps do: these do not light Reflection from further around than a quarter
// turn, nor Transmission from above the surface. Behind the surface, where Cycles' light tree chooses no lamp, its
// samples of the BSDF find each at its full weight, so that Reflection has all of that.
#pragma once

#include "core/bsdf/base.h"
#include "core/bsdf/highlight.h"
#include "core/bsdf/lobe_record.h"

namespace pivot {

template <class T>
struct Strand {
    struct Parameters {
        Vec3<T> color{T(1)};          ///< scales what it scatters
        T transmits = T(0);           ///< 1: Transmission; 0: Reflection
        T roughness_along = T(0.1f);  ///< in [0, 1]
        T roughness_around = T(1);    ///< in [0, 1]
        T tilt_rad = T(0);            ///< of the half angle along the strand
    };
    static constexpr std::string_view name = "strand";
    static constexpr std::array parameters{
        LobeParameter{"color", 3, 0.0f, std::numeric_limits<float>::max()}, LobeParameter{"transmits", 1, 0.0f, 1.0f},
        LobeParameter{"roughness_along", 1, 0.0f, 1.0f}, LobeParameter{"roughness_around", 1, 0.0f, 1.0f},
        LobeParameter{"tilt_rad", 1, -1.6f, 1.6f}};
    static constexpr bool reflects = true, transmits = true, has_closed_form = false, is_of_strands = true;

    Vec3<T> color;
    T is_through;  ///< 1: Transmission
    T along, around;
    T tilt_rad;
    T theta_o, gamma_o;  ///< the viewer's angle along the strand, from across it, and around it, from the normal
    T first, range;      ///< of the half angle's arctangent: where it begins, and how far it goes

    static Strand seen(const Parameters& p, const Vec3<T>& wo_local) {
        constexpr float least = 1e-3f;
        Strand lobe;
        lobe.color = p.color;
        lobe.is_through = select(p.transmits > T(0.5f), T(1), T(0));
        lobe.along = min(max(p.roughness_along, T(least)), T(1));
        lobe.around = min(max(p.roughness_around, T(least)), T(1));
        lobe.tilt_rad = p.tilt_rad;
        lobe.theta_o = asin(min(max(wo_local.x, T(-1)), T(1)));
        lobe.gamma_o = atan2(wo_local.z, wo_local.y) - T(0.5f) * pi<T>;
        const T middle = T(0.5f) * lobe.theta_o - lobe.tilt_rad, quarter = T(0.25f) * pi<T>;
        lobe.first = atan((middle - quarter) / lobe.along);
        lobe.range = max(atan((middle + quarter) / lobe.along) - lobe.first, T(1e-6f));
        return lobe;
    }
    /// Of lamps.
    Vec3<T> eval(const Vec3<T>& wo_local, const Vec3<T>& wi_local) const {
        const T phi = phi_of(wi_local);
        const Mask<T> is_below = wi_local.z < T(0);
        const Mask<T> is_lit = is_below || (!is_behind() && abs(phi) < T(0.5f) * pi<T>);
        return select(is_lit, color * (pdf_omega(wo_local, wi_local) * of_all()), Vec3<T>(T(0)));
    }
    /// Of all else.
    Vec3<T> eval_sampled(const Vec3<T>& wo_local, const Vec3<T>& wi_local) const {
        const Mask<T> is_sampled = !is_behind() || abs(phi_of(wi_local)) > T(0.5f) * pi<T>;
        return select(is_sampled, color * (pdf_omega(wo_local, wi_local) * of_all()), Vec3<T>(T(0)));
    }
    T pdf_omega(const Vec3<T>&, const Vec3<T>& wi_local) const {
        const T theta = asin(min(max(wi_local.x, T(-1)), T(1))), phi = abs(phi_of(wi_local));
        const T t = T(0.5f) * (theta + theta_o) - tilt_rad;
        const T cos_theta = safe_sqrt(T(1) - sqr(wi_local.x));
        const T of_theta = along / (T(2) * (sqr(t) + sqr(along)) * range * max(cos_theta, T(1e-3f)));
        const T turn = min(phi / around, pi<T>), off = pi<T> - phi;
        const T of_phi = select(is_behind(), around / (turned_range(T(1)) * (sqr(off) + sqr(around))),
                                max(cos(T(0.5f) * turn), T(0)) * T(0.25f) / around);
        return of_theta * of_phi;
    }
    Vec3<T> sample(const Vec3<T>&, T, const Vec2<T>& u) const {
        const T t = along * tan(first + u.x * range);
        const T theta = T(2) * (t + tilt_rad) - theta_o;
        const T beside = T(2) * around * asin(T(1) - T(2) * u.y);
        const T turned = pi<T> + around * tan(turned_range(T(1)) * (u.y - T(0.5f)));
        const T phi = T(0.5f) * pi<T> + gamma_o + select(is_behind(), turned, beside);
        const T sin_theta = sin(theta), cos_theta = abs(cos(theta));
        return {sin_theta, cos_theta * cos(phi), cos_theta * sin(phi)};
    }
    Vec3<T> albedo(const Vec3<T>&) const {
        const T quarter_turn = T(0.5f) * pi<T>;
        const auto cosine_below = [&](T phi) { return sin(T(0.5f) * min(max(phi / around, T(-1) * pi<T>), pi<T>)); };
        const T above_but_far = cosine_below(quarter_turn + abs(gamma_o)) - cosine_below(quarter_turn);
        const T reflected = T(1) - T(0.5f) * above_but_far;
        const T through =
            (atan((gamma_o + quarter_turn) / around) - atan((gamma_o - quarter_turn) / around)) / turned_range(T(0.5f));
        return color * select(is_behind(), through, reflected);
    }
    Vec3<T> diffuse() const { return Vec3<T>(T(0)); }
    T highlight_probability() const { return T(1); }
    BaseOf<T> closed_form(const Vec3<T>& wo_local) const {
        return make_base(BaseMaterialOf<T>{.diffuse = albedo(wo_local)}, wo_local);
    }
    Strand blurred(T least_alpha) const {
        Strand result = *this;
        result.along = max(along, least_alpha), result.around = max(around, least_alpha);
        return result;
    }

   private:
    Mask<T> is_behind() const { return is_through > T(0.5f); }
    /// How far a direction lies around the strand from the viewer, in [-pi, pi].
    T phi_of(const Vec3<T>& wi_local) const {
        const T phi = atan2(wi_local.z, wi_local.y) - T(0.5f) * pi<T> - gamma_o;
        return phi - T(2) * pi<T> * floor(phi * T(0.5f / pi<float>) + T(0.5f));
    }
    /// Of what goes through, Cycles counts the half turn behind the strand as all.
    T of_all() const { return select(is_behind(), turned_range(T(1)) / turned_range(T(0.5f)), T(1)); }
    /// What of Cauchy's distribution around the strand lies within so many half turns to either side.
    T turned_range(T half_turns) const { return T(2) * atan(half_turns * pi<T> / around); }
};

}  // namespace pivot
