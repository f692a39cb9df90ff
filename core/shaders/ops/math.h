// What several files of ops need of arithmetic that has no answer everywhere.
#pragma once

#include "core/simd/batch.h"

namespace pivot {

/// a / b, and 0 where b is 0.
inline Batch divided(Batch a, Batch b) {
    const BatchMask there = b != Batch(0.0f);
    return select(there, a / select(there, b, Batch(1.0f)), Batch(0.0f));
}

inline Batch fraction(Batch a) { return a - floor(a); }

/// a^b, and 0 for the root of a negative number.
inline Batch power(Batch a, Batch b) {
    const Batch zero(0.0f), one(1.0f);
    const BatchMask whole = b == trunc(b);
    const BatchMask odd = abs(b - Batch(2.0f) * floor(b * Batch(0.5f))) > Batch(0.5f);
    const Batch size = select(a != zero, pow(abs(a), b),
                              select(b == zero, one, select(b < zero, std::numeric_limits<Batch>::infinity(), zero)));
    return select(a < zero, select(whole, select(odd, -size, size), zero), size);
}

/// The rest of a / b, with the sign of a and exact but for quotients beyond 2^24; 0 where b is 0.
inline Batch modulo(Batch a, Batch b) {
    const Batch zero(0.0f), dividend = abs(a), divisor = abs(b);
    const Batch rest = xsimd::fnma(floor(divided(dividend, divisor)), divisor, dividend);
    // A quotient that was rounded to the next whole number is one off; that of an infinite divisor has no rest.
    const Batch corrected = select(dividend < divisor, dividend, select(rest < zero, rest + divisor, rest));
    return select(b != zero, xsimd::copysign(corrected, a), zero);
}

inline Batch wrap(Batch a, Batch upper, Batch lower) {
    const Batch span = upper - lower;
    return select(span != Batch(0.0f), a - span * floor(divided(a - lower, span)), lower);
}

}  // namespace pivot
