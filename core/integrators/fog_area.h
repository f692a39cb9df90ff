// An area light as places in fog see it: what phase functions make of its parts, on a square that is stretched to fit
// both. Over float or batches.
//
// With m = (wi - f) sqrt(|g|) / (1 - |g|), f where the phase function points, Henyey and Greenstein's is (1 +
// |m|^2)^-3/2 and the pivot phase function (1 + |m|^2)^-2, exactly; the solid angle of the light's parts is (1 +
// |m|^2)^-3/2 of their offset in its plane by the distance from that. Such are the lobes that area_map.h fits, and near
// its peak their product is one too.
//
// Relative variance of a sample, of rectangles and disks from beside them to six half-sizes away, g -0.5 to 0.95: 0.10,
// by 4 x 4 cells of one value each 2.2. Mean error of the integral by 6 x 6 nodes 0.4 %, by 4 x 4 1 %, by caps in the
// place of the 4 x 4 cells 12 %.
#pragma once

#include "core/integrators/area_grid.h"
#include "core/math/frame.h"
#include "core/math/quadrature.h"
#include "core/scene/medium_mix.h"

namespace pivot {

/// In a frame whose z points from the place to the light's plane: all of the light is above.
template <class T>
class FogAreaView {
   public:
    /// direction: of travel. g: typical of the phase functions there.
    FogAreaView(const AreaLight& light, const Vec3<T>& position, const Vec3<T>& direction, float g) {
        const Frame<float> own = frame_from_z(-light.normal);
        const Vec3<T> to_center = wide(light.center) - position, normal = wide(own.z);
        const T side = T(light.is_two_sided() ? 1.0f : 0.0f);
        const T turn = select(side > T(0) && dot(to_center, normal) < T(0), T(-1), T(1));
        frame_ = {wide(own.x), wide(own.y), normal * turn};
        const auto in_plane = [&](const Vec3f& v) { return Vec3<T>(T(dot(v, own.x)), T(dot(v, own.y)), T(0)); };
        light_ = {.center = frame_.to_local(to_center),
                  .half_u = in_plane(light.half_u),
                  .half_v = in_plane(light.half_v),
                  .normal = Vec3<T>(T(0), T(0), T(-1)),
                  .parallelogram_m2 = T(parallelogram_m2(light)),
                  .ellipse = T(light.shape == AreaShape::ellipse ? 1.0f : 0.0f) > T(0),
                  .triangle = T(light.shape == AreaShape::triangle ? 1.0f : 0.0f) > T(0),
                  .inverse_tan_spread = T(light.inverse_tan_spread)};
        if (light.inverse_tan_spread > 0.0f) narrow(light_);
        direction_ = frame_.to_local(direction);
        forward_ = g < 0.0f ? -direction_ : direction_;
        per_width_ = std::sqrt(std::abs(g)) / (1.0f - std::abs(g));
        // From the place nearest to where the plane is nearest, or to where the phase function meets it.
        const T height = max(light_.center.z, T(0));
        const detail::AreaSpan<T> whole{T(-1), T(1)};
        const Vec3<T> met = forward_ * (height * inverse(max(forward_.z, T(1e-4f))));
        const Vec2<T> below = detail::nearest_place(light_, whole, -light_.center);
        const Vec2<T> ahead = detail::nearest_place(light_, whole, met - light_.center);
        const auto off = [&](const Vec2<T>& at) {
            return (T(1) + fit_phase(at).mm) * (T(1) + detail::fit_diffuse(light_, at).mm);
        };
        const Mask<T> is_ahead = off(ahead) < off(below);
        const Vec2<T> from(select(is_ahead, ahead.x, below.x), select(is_ahead, ahead.y, below.y));
        const Vec2<T> center = fit(from).least(light_, whole, from);
        map_ = {light_, whole, center, fit(center)};
    }

    const AreaView<T>& light() const { return light_; }
    const Frame<T>& frame() const { return frame_; }
    const Vec3<T>& direction() const { return direction_; }
    const detail::AreaMap<T>& map() const { return map_; }

    /// Of value(wi in the frame), by solid angle over the light: by so many nodes of Gauss and Legendre's each way. 0
    /// where the light's back is.
    template <int count, class Value>
    auto integrate(const Value& value) const {
        const T plane_m3 = max(light_.center.z, T(0)) * light_.parallelogram_m2;
        decltype(value(light_.center)) sum(T(0));
        for (const GaussNode& i : gauss_rule<count>) {
            const auto [x, width] = map_.x_place(light_, T(i.x));
            const detail::AreaWarp<T> warp = map_.y_warp(light_, x);
            for (const GaussNode& j : gauss_rule<count>) {
                const auto [y, height] = warp.place(T(j.x));
                const Vec3<T> d = light_.center + x * light_.half_u + y * light_.half_v;
                const T per_distance = inverse_sqrt(max(dot(d, d), tiny<T>));
                const T omega = select(light_.is_on({x, y}), plane_m3 * (width * height), T(0)) *
                                (per_distance * sqr(per_distance));
                sum += value(d * per_distance) * (omega * T(i.weight * j.weight));
            }
        }
        return sum;
    }

   private:
    static Vec3<T> wide(const Vec3f& v) { return {T(v.x), T(v.y), T(v.z)}; }

    detail::AreaFit<T> fit_phase(const Vec2<T>& at) const {
        const Vec3<T> d = light_.center + at.x * light_.half_u + at.y * light_.half_v;
        const T inverse_d = inverse_sqrt(max(dot(d, d), tiny<T>));
        const Vec3<T> wi = d * inverse_d;
        const auto change = [&](const Vec3<T>& along) {
            return (along - dot(along, wi) * wi) * (inverse_d * T(per_width_));
        };
        return detail::fit_of((wi - forward_) * T(per_width_), change(light_.half_u), change(light_.half_v));
    }
    /// Of the product, relative to its value at the place.
    detail::AreaFit<T> fit(const Vec2<T>& at) const {
        const detail::AreaFit<T> a = fit_phase(at), b = detail::fit_diffuse(light_, at);
        const T of_a = inverse(T(1) + a.mm), of_b = inverse(T(1) + b.mm);
        const auto both = [&](T detail::AreaFit<T>::*part) { return of_a * a.*part + of_b * b.*part; };
        using Fit = detail::AreaFit<T>;
        return {T(0), both(&Fit::um), both(&Fit::vm), both(&Fit::uu), both(&Fit::uv), both(&Fit::vv)};
    }

    Frame<T> frame_;
    AreaView<T> light_;
    Vec3<T> direction_, forward_;
    float per_width_;
    detail::AreaMap<T> map_;
};

/// A place on an area light that is sampled from one in fog.
template <class T>
struct FogAreaSample {
    Vec3<T> wi;
    T distance_m;
    T pdf_omega;
    T spread;  ///< what the light's spread leaves of its radiance
};

/// Samples of an area light in proportion to what the media scatter of its parts.
template <class T>
class FogAreaSampler {
   public:
    FogAreaSampler(const AreaLight& light, const MediumMix& mix, const Vec3<T>& position, const Vec3<T>& direction)
        : view_(light, position, direction, mix.typical_g()) {
        grid_.map = view_.map();
        grid_.fill(view_.light(), [&](const Vec3<T>& wi) {
            T scattered(0);
            for (const ScatterLobe& lobe : mix.lobes)
                scattered += T(MediumMix::weight(lobe)) * eval(lobe.phase, view_.direction(), wi);
            return scattered * view_.light().spread_weight(wi);
        });
    }

    /// pdf_omega: 0 where the light's back is.
    FogAreaSample<T> sample(const Vec2<T>& u) const {
        const AreaSample<T> at = grid_.sample(view_.light(), u);
        const SeenPlace<T> seen = see(view_.light(), at.place);
        const T inverse_tan_spread = view_.light().inverse_tan_spread;
        return {view_.frame().to_world(seen.wi), seen.distance_m,
                select(seen.omega_per_xy > T(0), at.pdf / max(seen.omega_per_xy, tiny<T>), T(0)),
                any(inverse_tan_spread > T(0))
                    ? select(view_.light().is_on(at.place), spread_falloff(inverse_tan_spread, seen.wi.z), T(0))
                    : T(1)};
    }
    /// Density of sample() at a place (x, y) of the light.
    T pdf_omega(const Vec2<T>& own) const {
        const Vec2<T> place = view_.light().from_own(own);
        const T omega_per_xy = see(view_.light(), place).omega_per_xy;
        const Mask<T> is_there = omega_per_xy > T(0) && abs(place.x) <= T(1) && abs(place.y) <= T(1);
        return select(is_there, grid_.pdf(view_.light(), place) / max(omega_per_xy, tiny<T>), T(0));
    }

   private:
    FogAreaView<T> view_;
    detail::AreaGrid<T, 4, 4> grid_;
};

}  // namespace pivot
