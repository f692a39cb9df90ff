// A part of a ray mapped to [0, 1] so that what a lamp scatters along it is smooth there. Over float or batches.
//
// Seen from the lamp the ray is a half-circle of angles phi from the direction of travel; taken evenly they undo the
// lamp's 1 / r^2. The pivot of the circle, tan(phi' / 2) = k tan(phi / 2) with k = (1 + g) / (1 - g), also undoes a
// phase function's peak, and tan(phi / 2) is rational along the ray. Where the medium is dense, half of [0, 1] goes by
// its transmittance.
//   [Kulla12] Kulla and Fajardo, "Importance Sampling Techniques for Path Tracing in Participating Media"
#pragma once

#include "core/math/vector.h"

namespace pivot {

class DistanceMap {
   public:
    /// By transmittance alone. sigma_t: 1/m, roughly.
    DistanceMap(float near_m, float far_m, float sigma_t)
        : near_m_(near_m), far_m_(far_m), sigma_t_(sigma_t), escapes_(-std::expm1(-sigma_t * (far_m - near_m))) {}

    /// along_m: where the lamp's centre is nearest; off_m: how far then, above 0; g: of the phase function.
    DistanceMap(float near_m, float far_m, float sigma_t, float along_m, float off_m, float g)
        : DistanceMap(near_m, far_m, sigma_t) {
        along_m_ = along_m;
        off_m_ = off_m;
        k_ = (1.0f + g) / (1.0f - g);
        const float near_x = k_ * half_tangent(near_m);
        near_angle_ = std::atan(near_x);
        if (std::isinf(far_m)) {
            angles_ = std::atan2(1.0f, near_x);
        } else {
            const float far_x = k_ * half_tangent(far_m);
            angles_ = std::atan2(far_x - near_x, 1.0f + near_x * far_x);
        }
        if (!(angles_ > 1e-6f)) return;  // seen from the lamp the part is a point
        // Where the lamp is within a few free paths its angles are enough.
        const float reach_m = std::min(far_m, std::max(along_m, near_m) + 3.0f * off_m) - near_m;
        angular_share_ = sigma_t * reach_m > 4.0f ? 0.5f : 1.0f;
    }

    float far_m() const { return far_m_; }

    template <class T>
    T distance_m(const T& u) const {
        if (angular_share_ == 0.0f) return within(by_transmittance(u));
        if (angular_share_ == 1.0f) return within(by_angle(u));
        // The share of angles at the place, by Newton's method within what bounds it: where the medium is dense, one of
        // the two shares is nearly all there is on one side of the place, and starts close to it.
        const T of_angles(angular_share_), of_transmittance(1.0f - angular_share_);
        const T by_either = min(u / of_angles, angle_share(by_transmittance(min(u / of_transmittance, T(1)))));
        T low = max((u - of_transmittance) / of_angles, T(0)), high = min(max(by_either, low), T(1));
        T v = select(u < of_transmittance, high, low);
        for (int i = 0; i < 10; ++i) {
            const T t = within(by_angle(v));
            const T excess = of_angles * v + of_transmittance * transmittance_share(t) - u;
            low = select(excess < T(0), v, low);
            high = select(excess > T(0), v, high);
            const T slope = of_angles + of_transmittance * transmittance_density(t) / max(angle_density(t), tiny<T>);
            const T next = v - excess / slope;
            v = select(next > low && next < high, next, T(0.5f) * (low + high));
        }
        return within(by_angle(v));
    }

    /// du / dt, 1/m.
    template <class T>
    T density(const T& distance_m) const {
        if (angular_share_ == 0.0f) return transmittance_density(distance_m);
        if (angular_share_ == 1.0f) return angle_density(distance_m);
        return T(angular_share_) * angle_density(distance_m) +
               T(1.0f - angular_share_) * transmittance_density(distance_m);
    }

   private:
    template <class T>
    T within(const T& t) const {
        return min(max(t, T(near_m_)), T(far_m_));
    }

    /// tan(phi / 2) at a place of the ray, and its root.
    template <class T>
    T half_tangent(const T& t) const {
        const T s = t - T(along_m_), r = sqrt(s * s + T(off_m_ * off_m_));
        return select(s > T(0), (s + r) / T(off_m_), T(off_m_) / (r - s));
    }
    template <class T>
    T by_angle(const T& v) const {
        constexpr float below_right_angle = 1.570796f;
        const T y = tan(min(T(near_angle_) + v * T(angles_), T(below_right_angle))) / T(k_);
        return T(along_m_) + T(0.5f * off_m_) * (y - T(1) / max(y, tiny<T>));
    }
    /// What by_angle() takes there.
    template <class T>
    T angle_share(const T& t) const {
        return min(max((atan(T(k_) * half_tangent(within(t))) - T(near_angle_)) / T(angles_), T(0)), T(1));
    }
    template <class T>
    T angle_density(const T& t) const {
        const T s = t - T(along_m_), r2 = s * s + T(off_m_ * off_m_), y = half_tangent(t), x = T(k_) * y;
        return x / ((T(1) + x * x) * sqrt(r2) * T(angles_));
    }

    bool is_thin() const { return !(escapes_ > 1e-4f); }
    template <class T>
    T by_transmittance(const T& u) const {
        if (is_thin()) return T(near_m_) + u * T(far_m_ - near_m_);
        return T(near_m_) - log1p(-u * T(escapes_)) / T(sigma_t_);
    }
    template <class T>
    T transmittance_share(const T& t) const {
        if (is_thin()) return (t - T(near_m_)) / T(far_m_ - near_m_);
        return (T(1) - exp(T(-sigma_t_) * (t - T(near_m_)))) / T(escapes_);
    }
    template <class T>
    T transmittance_density(const T& t) const {
        if (is_thin()) return T(1.0f / (far_m_ - near_m_));
        return T(sigma_t_ / escapes_) * exp(T(-sigma_t_) * (t - T(near_m_)));
    }

    float near_m_, far_m_, sigma_t_;
    float escapes_;  ///< the share of light that the part does not let through
    float along_m_ = 0.0f, off_m_ = 1.0f, k_ = 1.0f, near_angle_ = 0.0f, angles_ = 0.0f;
    float angular_share_ = 0.0f;  ///< of [0, 1]
};

}  // namespace pivot
