// The intersection of several spherical caps, by its boundary: solid angle, clamped-cosine integral and sampling.
//   [Dupuy17] "A Spherical Cap Preserving Parameterization for Spherical Distributions", Sec 4.2, 5.4
//
// [Dupuy17 (23)] intersects light and bent cone; to clip that at the horizon takes the three caps here. For three caps
// that meet the solid angle has no form as short as that of two, so the boundary's arcs are found and summed, each
// relative to the smallest cap's axis: nothing cancels when that cap is small. Branches: for float and double only.
#pragma once

#include <array>

#include "core/distributions/cap_intersection.h"

namespace pivot {

/// An arc of a cap's rim: azimuths mid - half .. mid + half in the frame about the cap's axis.
template <class T>
struct Arc {
    Frame<T> frame;
    T versine, mid, half;

    Vec3<T> at(T azimuth) const {
        const T radius = safe_sqrt(versine * (T(2) - versine));
        return frame.to_world({radius * cos(azimuth), radius * sin(azimuth), T(1) - versine});
    }
};

/// The azimuths of a rim inside another cap: from `begin` on, counterclockwise about the rim's axis.
template <class T>
struct Stretch {
    T begin, length;

    bool contains(T azimuth) const { return turn(azimuth - begin) <= length; }

    /// Into [0, 2 pi).
    static T turn(T angle) { return angle - T(2) * pi<T> * floor(angle / (T(2) * pi<T>)); }
};

/// The stretches of rim 1 inside cap 2 and of rim 2 inside cap 1, cap 1 no larger than cap 2 and than a hemisphere.
/// Where the rims cross, both run between the same two points, so that boundaries close even where two rims nearly
/// coincide.
template <class T>
std::array<Stretch<T>, 2> stretches_inside(const Cap<T>& cap1, const Frame<T>& frame1, const Cap<T>& cap2,
                                           const Frame<T>& frame2) {
    const Separation<T> between = separation(cap1.axis, cap2.axis);
    const RimInside<T> rim = rim_inside(cap1.versine, cap2.versine, between);
    const Stretch<T> none{T(0), T(-1)}, all{T(0), T(2) * pi<T>};
    if (rim.azimuth == T(0)) return {none, none};
    if (rim.azimuth == pi<T>) {
        // cap 1 lies in cap 2, or coincides with its complement, or holds that
        const bool coincide = rim.cosine == T(0) && between.cosine < T(0);
        return {coincide ? none : all, !coincide && contains(cap1, -cap2.axis) ? all : none};
    }
    const Vec3<T> local2 = frame1.to_local(cap2.axis);
    const T center = atan2(local2.y, local2.x);
    const auto on_rim2 = [&](T azimuth) {
        const Vec3<T> local = frame2.to_local(Arc<T>{frame1, cap1.versine, T(0), T(0)}.at(azimuth));
        return atan2(local.y, local.x);
    };
    const T begin2 = on_rim2(center + rim.azimuth), end2 = on_rim2(center - rim.azimuth);
    return {Stretch<T>{center - rim.azimuth, T(2) * rim.azimuth}, Stretch<T>{begin2, Stretch<T>::turn(end2 - begin2)}};
}

/// Calls visit(i, arc) for the arcs of rim i inside all the other caps, in pieces of at most a quarter turn, between
/// whose ends the geodesic is unique. Of any two caps, one is no larger than a hemisphere.
template <class T, size_t N, class Visit>
void for_each_boundary_arc(const std::array<Cap<T>, N>& caps, const Visit& visit) {
    std::array<Frame<T>, N> frames;
    std::array<std::array<Stretch<T>, N>, N> inside;  // [i][j]: of rim i in cap j
    for (size_t i = 0; i < N; ++i) {
        frames[i] = frame_from_z(caps[i].axis);
        for (size_t j = 0; j < i; ++j) {
            const size_t a = caps[j].versine <= caps[i].versine ? j : i, b = i + j - a;
            const auto stretches = stretches_inside(caps[a], frames[a], caps[b], frames[b]);
            inside[a][b] = stretches[0];
            inside[b][a] = stretches[1];
        }
    }
    for (size_t i = 0; i < N; ++i) {
        std::array<T, 2 * N> ends;
        size_t count = 0;
        for (size_t j = 0; j < N; ++j) {
            if (j == i || inside[i][j].length < T(0) || inside[i][j].length == T(2) * pi<T>) continue;
            for (const T end : {inside[i][j].begin, inside[i][j].begin + inside[i][j].length}) {
                size_t k = count++;
                for (ends[k] = Stretch<T>::turn(end); k > 0 && ends[k] < ends[k - 1]; --k)
                    std::swap(ends[k], ends[k - 1]);
            }
        }
        if (count == 0) ends[count++] = T(0);
        for (size_t k = 0; k < count; ++k) {
            const T begin = ends[k], end = k + 1 < count ? ends[k + 1] : ends[0] + T(2) * pi<T>;
            bool within = end > begin;
            for (size_t j = 0; j < N && within; ++j) within = j == i || inside[i][j].contains((begin + end) / T(2));
            if (!within) continue;
            const int pieces = 1 + static_cast<int>((end - begin) / (T(0.5) * pi<T>));
            const T half = (end - begin) / T(2 * pieces);
            for (int piece = 0; piece < pieces; ++piece)
                visit(i, Arc<T>{frames[i], caps[i].versine, begin + T(2 * piece + 1) * half, half});
        }
    }
}

/// f(caps) for a measure f that takes no cap beyond a hemisphere: such a cap is all but its complement.
template <class T, size_t N, class F>
T by_complements(const std::array<Cap<T>, N>& caps, T whole, const F& f) {
    for (size_t k = 0; k < N; ++k) {
        if (caps[k].versine <= T(1)) continue;
        std::array<Cap<T>, N> replaced = caps;
        replaced[k] = complement(caps[k]);
        if constexpr (N == 1) {
            return whole - f(replaced);
        } else {
            std::array<Cap<T>, N - 1> rest;
            for (size_t i = 0; i < N - 1; ++i) rest[i] = caps[i < k ? i : i + 1];
            return max(by_complements(rest, whole, f) - by_complements(replaced, whole, f), T(0));
        }
    }
    return f(caps);
}

template <class T, size_t N>
Vec3<T> axis_of_smallest(const std::array<Cap<T>, N>& caps) {
    return std::min_element(caps.begin(), caps.end(),
                            [](const Cap<T>& a, const Cap<T>& b) { return a.versine < b.versine; })
        ->axis;
}

/// The solid angle inside all the caps, in steradians.
template <class T, size_t N>
T intersection_solid_angle(const std::array<Cap<T>, N>& caps) {
    return by_complements(caps, T(4) * pi<T>, []<size_t M>(const std::array<Cap<T>, M>& small_caps) {
        if constexpr (M == 1) return solid_angle(small_caps[0]);
        const Vec3<T> p = axis_of_smallest(small_caps);
        T sum = T(0);
        for_each_boundary_arc(small_caps, [&](size_t i, const Arc<T>& arc) {
            if (small_caps[i].axis == p) {
                sum += T(2) * arc.half * arc.versine;
                return;
            }
            const Vec3<T> a = arc.at(arc.mid - arc.half), b = arc.at(arc.mid + arc.half);
            const T triangle = T(2) * atan2(dot(p, cross(a - p, b - p)), T(1) + dot(p, a) + dot(a, b) + dot(b, p));
            sum += triangle + segment_solid_angle(arc.versine, arc.half);
        });
        return max(sum, T(0));
    });
}

/// The integral of max(0, omega . normal) inside all the caps: by Stokes' theorem, normal . 1/2 oint (omega - p) x d
/// omega.
template <class T, size_t N>
T clamped_cosine_integral(const std::array<Cap<T>, N>& caps, const Vec3<T>& normal) {
    return by_complements(caps, pi<T>, [&]<size_t M>(const std::array<Cap<T>, M>& small_caps) {
        std::array<Cap<T>, M + 1> above;
        std::copy(small_caps.begin(), small_caps.end(), above.begin());
        above[M] = {normal, T(1)};
        const Vec3<T> p = axis_of_smallest(above);
        Vec3<T> sum(T(0));
        for_each_boundary_arc(above, [&](size_t, const Arc<T>& arc) {
            const Vec3<T> chord = arc.at(arc.mid + arc.half) - arc.at(arc.mid - arc.half);
            const T sin2 = arc.versine * (T(2) - arc.versine);
            sum += cross(arc.at(arc.mid) - p, chord) * T(0.5) + arc.frame.z * (sin2 * x_minus_sin(arc.half));
        });
        return max(dot(normal, sum), T(0));
    });
}

/// A direction inside all the caps and above the horizon, by its cosine to the normal; if there is none, the normal.
///
/// Circles about the normal are picked by inverting the integral within them, whose derivative in the circle's versine
/// is the cosine times the azimuth inside the caps; then that is uniform.
template <class T, size_t N>
Vec3<T> sample_clamped_cosine(const std::array<Cap<T>, N>& caps, const Vec3<T>& normal, const Vec2<T>& u) {
    const T whole = clamped_cosine_integral(caps, normal), wanted = u.x * whole;
    const T rounding = T(2) * std::numeric_limits<T>::epsilon();
    std::array<Cap<T>, N + 1> within;
    std::copy(caps.begin(), caps.end(), within.begin());
    std::array<Arc<T>, 2 * N + 6> arcs;  // up to N + 1 of them, which four quarter turns cut
    size_t count = 0;
    T azimuth = T(0);
    const auto cut_circle = [&](T versine) {
        within[N] = {normal, versine};
        count = 0;
        azimuth = T(0);
        for_each_boundary_arc(within, [&](size_t i, const Arc<T>& arc) {
            if (i != N) return;
            arcs[count++] = arc;
            azimuth += T(2) * arc.half;
        });
    };

    T low = T(0), high = T(1), versine = T(0.5);
    for (int i = 0; i < 60; ++i) {
        cut_circle(versine);
        const T excess = clamped_cosine_integral(within, normal) - wanted, slope = azimuth * (T(1) - versine);
        if (slope > T(0) && abs(excess) <= rounding * whole) break;
        (excess > T(0) ? high : low) = versine;
        const T newton = slope > T(0) ? versine - excess / slope : low;
        const T next = newton > low && newton < high ? newton : (low + high) / T(2);
        const T step = abs(next - versine);
        versine = next;
        if (step <= rounding * versine) break;
    }
    cut_circle(versine);
    T turn = u.y * azimuth;
    for (size_t k = 0; k < count; ++k) {
        if (turn <= T(2) * arcs[k].half || k + 1 == count) return arcs[k].at(arcs[k].mid - arcs[k].half + turn);
        turn -= T(2) * arcs[k].half;
    }
    return normal;
}

}  // namespace pivot
