// Numbers mapped from one range to another, by a formula or by a table of values. [Cycles 4.5 kernel/svm/map_range.h,
// clamp.h, ramp.h]
#include "core/shaders/ops/math.h"
#include "core/shaders/ops/tables.h"

namespace pivot {
namespace {

const Batch zero(0.0f), one(1.0f);

// How a place, 0 to 1 from one end of a range to the other, is bent on the way.
Batch linear(Batch place, Batch) { return place; }
Batch stepped(Batch place, Batch steps) {
    return select(steps > zero, divided(floor(place * (steps + one)), steps), zero);
}
Batch smoothstep(Batch place, Batch) {
    const Batch x = clamp01(place);
    return x * x * (Batch(3.0f) - Batch(2.0f) * x);
}
Batch smootherstep(Batch place, Batch) {
    const Batch x = clamp01(place);
    return x * x * x * (x * (x * Batch(6.0f) - Batch(15.0f)) + Batch(10.0f));
}

/// A vector's part: to_min from a range of no width.
template <Batch (*bent)(Batch, Batch)>
Batch map_range_part(Batch value, Batch from_min, Batch from_max, Batch to_min, Batch to_max, Batch steps) {
    return to_min + bent(divided(value - from_min, from_max - from_min), steps) * (to_max - to_min);
}

/// A number: 0 from a range of no width.
template <Batch (*bent)(Batch, Batch)>
Batch map_range(Batch value, Batch from_min, Batch from_max, Batch to_min, Batch to_max, Batch steps) {
    return select(from_max != from_min, map_range_part<bent>(value, from_min, from_max, to_min, to_max, steps), zero);
}

/// A curve of values at even distances. settings: where the first and the last is; whether it is linear between them,
/// or has the one before; whether it goes on in a straight line beyond, or stays; the values, at least two.
Batch table(SettingsFrom<6> settings, Batch x) {
    constexpr std::size_t header = 4;
    const float first = settings[0], width = settings[1] - settings[0];
    const bool interpolates = settings[2] != 0.0f, extrapolates = settings[3] != 0.0f;
    const float* values = settings.data() + header;
    const auto last_index = static_cast<std::int32_t>(settings.size() - header) - 1;
    const Batch last(static_cast<float>(last_index)), place = (x - Batch(first)) / Batch(width);
    // Its order keeps what is not a number within the table.
    const Batch inside = min(select(place > zero, place, zero), one) * last;
    const Batch before = floor(inside), part = inside - before;
    const Batch a = fetch(values, to_index(before)), b = fetch(values, to_index(min(before + one, last)));
    Batch result = interpolates ? (one - part) * a + part * b : a;
    if (extrapolates) {
        const Batch start(values[0]), end(values[last_index]);
        const Batch start_step(values[1] - values[0]), end_step(values[last_index] - values[last_index - 1]);
        result = select(place < zero, start + start_step * place * last, result);
        result = select(place > one, end + end_step * (place - one) * last, result);
    }
    return result;
}

constexpr std::array ops{
    op<map_range<linear>>("map_range_linear"),
    op<map_range<stepped>>("map_range_stepped"),
    op<map_range<smoothstep>>("map_range_smoothstep"),
    op<map_range<smootherstep>>("map_range_smootherstep"),
    op<map_range_part<linear>>("map_range_vector_linear"),
    op<map_range_part<stepped>>("map_range_vector_stepped"),
    op<map_range_part<smoothstep>>("map_range_vector_smoothstep"),
    op<map_range_part<smootherstep>>("map_range_vector_smootherstep"),
    op<[](Batch value, Batch low, Batch high) { return min(max(value, low), high); }>("clamp_minmax"),
    op<[](Batch value, Batch a, Batch b) { return min(max(value, min(a, b)), max(a, b)); }>("clamp_range"),
    op<table>("table"),
};

}  // namespace

std::span<const OpKind> map_range_ops() { return ops; }

}  // namespace pivot
