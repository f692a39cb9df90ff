// Where a texture is looked up, in 1 to 4 dimensions.
#pragma once

#include "core/simd/batch.h"

namespace pivot {

template <std::size_t n>
struct Point {
    std::array<Batch, n> x;
};

/// f(i), a number, of each dimension.
template <std::size_t n, class F>
Point<n> make_point(const F& f) {
    Point<n> result;
    for (std::size_t i = 0; i < n; ++i) result.x[i] = f(i);
    return result;
}

template <std::size_t n>
Point<n> operator+(const Point<n>& a, const Point<n>& b) {
    return make_point<n>([&](std::size_t i) { return a.x[i] + b.x[i]; });
}
template <std::size_t n>
Point<n> operator-(const Point<n>& a, const Point<n>& b) {
    return make_point<n>([&](std::size_t i) { return a.x[i] - b.x[i]; });
}
template <std::size_t n>
Point<n> operator*(const Point<n>& a, const Batch& scale) {
    return make_point<n>([&](std::size_t i) { return a.x[i] * scale; });
}
template <std::size_t n>
Point<n> floor(const Point<n>& a) {
    return make_point<n>([&](std::size_t i) { return floor(a.x[i]); });
}
template <std::size_t n>
Point<n> select(const BatchMask& condition, const Point<n>& a, const Point<n>& b) {
    return make_point<n>([&](std::size_t i) { return select(condition, a.x[i], b.x[i]); });
}
template <std::size_t n>
Batch dot(const Point<n>& a, const Point<n>& b) {
    Batch sum = a.x[0] * b.x[0];
    for (std::size_t i = 1; i < n; ++i) sum += a.x[i] * b.x[i];
    return sum;
}

}  // namespace pivot
