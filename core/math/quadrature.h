// Fixed quadrature rules.
#pragma once

#include <array>
#include <utility>

#include "core/math/vector.h"

namespace pivot {

/// The integral of f, a number or a vector, over [0, length] by Gauss and Legendre's eight points: exact for
/// polynomials of degree 15.
template <class T, class F>
auto gauss_legendre8(T length, const F& f) {
    constexpr std::array<double, 4> node{0.18343464249564980494, 0.52553240991632898582, 0.79666647741362673959,
                                         0.96028985649753623168};
    constexpr std::array<double, 4> weight{0.36268378337836198297, 0.31370664587788728734, 0.22238103445337447054,
                                           0.10122853629037625915};
    const T half = length * T(0.5);
    decltype(f(length)) sum(T(0));
    for (size_t i = 0; i < node.size(); ++i)
        sum += T(weight[i]) * (f(half * (T(1) - T(node[i]))) + f(half * (T(1) + T(node[i]))));
    return sum * half;
}

namespace detail {
inline constexpr int gauss_pairs = 8;
/// Positive nodes of the 16-point rule on [-1, 1], and their weights.
template <class T>
inline constexpr T gauss_nodes[gauss_pairs] = {T(0.0950125098376374401853193), T(0.2816035507792589132304605),
                                               T(0.4580167776572273863424194), T(0.6178762444026437484466718),
                                               T(0.7554044083550030338951012), T(0.8656312023878317438804679),
                                               T(0.9445750230732325760779884), T(0.9894009349916499325961542)};
template <class T>
inline constexpr T gauss_weights[gauss_pairs] = {T(0.1894506104550684962853967), T(0.1826034150449235888667637),
                                                 T(0.1691565193950025381893121), T(0.1495959888165767320815017),
                                                 T(0.1246289712555338720524763), T(0.0951585116824927848099251),
                                                 T(0.0622535239386478928628438), T(0.0271524594117540948517806)};
}  // namespace detail

/// The integral of f over [low, low + width] by sixteen points, exact for polynomials of degree 31: the width is given,
/// since a difference of close ends loses its bits.
template <class T, class F>
T gauss_legendre(T low, T width, const F& f) {
    const T half = width * T(0.5), middle = low + half;
    T sum = T(0);
    for (int i = 0; i < detail::gauss_pairs; ++i) {
        const T offset = half * detail::gauss_nodes<T>[i];
        sum += detail::gauss_weights<T>[i] * (f(middle - offset) + f(middle + offset));
    }
    return sum * half;
}

/// The same over `panels` equal parts.
template <class T, class F>
T gauss_legendre(T low, T width, int panels, const F& f) {
    const T step = width / T(panels);
    T sum = T(0);
    for (int i = 0; i < panels; ++i) sum += gauss_legendre(low + T(i) * step, step, f);
    return sum;
}

/// A node of Gauss and Legendre's rule on [0, 1], and the same in an angle: for an integrand that ends like a circle's
/// chords do, [-1, 1] is swept by the sine of an angle, and the cosine is in the weight.
struct GaussNode {
    float x, weight;
    float sine, sine_weight;
};

/// n nodes, by Newton's method on the Legendre polynomial.
template <int n>
std::array<GaussNode, n> make_gauss_rule() {
    std::array<GaussNode, n> rule;
    for (int i = 0; i < n; ++i) {
        double z = cos(pi<double> * (i + 0.75) / (n + 0.5)), slope = 0;
        for (int step = 0; step < 20; ++step) {
            double p = 1, previous = 0;
            for (int j = 0; j < n; ++j) {
                const double before = std::exchange(previous, p);
                p = ((2 * j + 1) * z * p - j * before) / (j + 1);
            }
            slope = n * (z * p - previous) / (z * z - 1);
            z -= p / slope;
        }
        const double weight = 1 / ((1 - z * z) * slope * slope), angle = 0.5 * pi<double> * z;
        rule[static_cast<size_t>(i)] = {static_cast<float>(0.5 * (1 - z)), static_cast<float>(weight),
                                        static_cast<float>(-sin(angle)),
                                        static_cast<float>(pi<double> * weight * cos(angle))};
    }
    return rule;
}

template <int n>
inline const std::array<GaussNode, n> gauss_rule = make_gauss_rule<n>();

/// N points of equal weight in the unit disk: exact for polynomials of degree 1, 3, 3 and 7.
template <class T, size_t N>
std::array<Vec2<T>, N> disk_rule() {
    static_assert(N == 1 || N == 4 || N == 8 || N == 16);
    if constexpr (N == 1) {
        return {Vec2<T>(T(0))};
    } else {
        // rings at Gauss and Legendre's points in r^2, which is uniform in [0, 1]; every other one turned by half a
        // step
        constexpr size_t rings = N == 4 ? 1 : 2, spokes = N / rings;
        const std::array<T, 2> r2 = rings == 1 ? std::array<T, 2>{T(0.5)}
                                               : std::array<T, 2>{T(0.21132486540518711775), T(0.78867513459481288225)};
        std::array<Vec2<T>, N> points;
        for (size_t i = 0; i < N; ++i) {
            const T phi = T(2) * pi<T> * (T(i % spokes) + T(0.5) * T(i / spokes)) / T(spokes);
            points[i] = sqrt(r2[i / spokes]) * Vec2<T>(cos(phi), sin(phi));
        }
        return points;
    }
}

}  // namespace pivot
