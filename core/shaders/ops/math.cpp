// The operations of Blender's Math node, lane by lane. Where one has no answer these give Cycles'. [Cycles 4.5
// kernel/svm/math_util.h]
#include "core/shaders/ops/math.h"

#include "core/shaders/ops/tables.h"

namespace pivot {
namespace {

const Batch zero(0.0f), one(1.0f);

Batch truth(const BatchMask& condition) { return select(condition, one, zero); }

Batch logarithm(Batch a, Batch base) {
    const BatchMask positive = a > zero && base > zero;
    return select(positive, divided(log(select(positive, a, one)), log(select(positive, base, one))), zero);
}

Batch compare(Batch a, Batch b, Batch epsilon) {
    return truth(a == b || abs(a - b) <= max(epsilon, std::numeric_limits<Batch>::epsilon()));
}

Batch smooth_min(Batch a, Batch b, Batch distance) {
    const Batch overlap = max(distance - abs(a - b), zero) / select(distance != zero, distance, one);
    return min(a, b) - select(distance != zero, overlap * overlap * overlap * distance * Batch(1.0f / 6.0f), zero);
}

Batch smooth_max(Batch a, Batch b, Batch distance) { return -smooth_min(-a, -b, distance); }

Batch ping_pong(Batch a, Batch scale) {
    return select(scale != zero, abs(fraction(divided(a - scale, scale * Batch(2.0f))) * scale * Batch(2.0f) - scale),
                  zero);
}

constexpr std::array ops{
    op<[](Batch a, Batch b) { return a + b; }>("math_add"),
    op<[](Batch a, Batch b) { return a - b; }>("math_subtract"),
    op<[](Batch a, Batch b) { return a * b; }>("math_multiply"),
    op<[](Batch a, Batch b) { return divided(a, b); }>("math_divide"),
    op<[](Batch a, Batch b, Batch c) { return a * b + c; }>("math_multiply_add"),
    op<power>("math_power"),
    op<logarithm>("math_logarithm"),
    op<[](Batch a) { return sqrt(max(a, zero)); }>("math_sqrt"),
    op<[](Batch a) { return select(a > zero, one / sqrt(select(a > zero, a, one)), zero); }>("math_inverse_sqrt"),
    op<[](Batch a) { return abs(a); }>("math_absolute"),
    op<[](Batch a) { return exp(a); }>("math_exponent"),
    op<[](Batch a, Batch b) { return min(a, b); }>("math_minimum"),
    op<[](Batch a, Batch b) { return max(a, b); }>("math_maximum"),
    op<[](Batch a, Batch b) { return truth(a < b); }>("math_less_than"),
    op<[](Batch a, Batch b) { return truth(a > b); }>("math_greater_than"),
    op<[](Batch a) { return select(a == zero, zero, select(a < zero, -one, one)); }>("math_sign"),
    op<compare>("math_compare"),
    op<smooth_min>("math_smooth_min"),
    op<smooth_max>("math_smooth_max"),
    op<[](Batch a) { return floor(a + Batch(0.5f)); }>("math_round"),
    op<[](Batch a) { return floor(a); }>("math_floor"),
    op<[](Batch a) { return ceil(a); }>("math_ceil"),
    op<[](Batch a) { return trunc(a); }>("math_trunc"),
    op<[](Batch a) { return fraction(a); }>("math_fract"),
    op<modulo>("math_modulo"),
    op<[](Batch a, Batch b) { return select(b != zero, a - floor(divided(a, b)) * b, zero); }>("math_floored_modulo"),
    op<wrap>("math_wrap"),
    op<[](Batch a, Batch b) { return floor(divided(a, b)) * b; }>("math_snap"),
    op<ping_pong>("math_pingpong"),
    op<[](Batch a) { return sin(a); }>("math_sine"),
    op<[](Batch a) { return cos(a); }>("math_cosine"),
    op<[](Batch a) { return tan(a); }>("math_tangent"),
    op<[](Batch a) { return asin(min(max(a, -one), one)); }>("math_arcsine"),
    op<[](Batch a) { return acos(min(max(a, -one), one)); }>("math_arccosine"),
    op<[](Batch a) { return atan(a); }>("math_arctangent"),
    op<[](Batch a, Batch b) { return select(a == zero && b == zero, zero, atan2(a, b)); }>("math_arctan2"),
    op<[](Batch a) { return sinh(a); }>("math_sinh"),
    op<[](Batch a) { return cosh(a); }>("math_cosh"),
    op<[](Batch a) { return tanh(a); }>("math_tanh"),
    op<[](Batch a) { return a * Batch(pi<float> / 180.0f); }>("math_radians"),
    op<[](Batch a) { return a * Batch(180.0f / pi<float>); }>("math_degrees"),
    op<[](Batch a) { return clamp01(a); }>("math_clamp01"),
};

}  // namespace

std::span<const OpKind> math_ops() { return ops; }

}  // namespace pivot
