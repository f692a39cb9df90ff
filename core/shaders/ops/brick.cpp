// Blender's Brick texture: rows of bricks in the plane of x and y. [Cycles 4.5 kernel/svm/brick.h 13-67]
#include "core/shaders/ops/math.h"
#include "core/shaders/ops/tables.h"

namespace pivot {
namespace {

/// [0, 1] of a brick.
Batch brick_noise(const IndexBatch& row, const IndexBatch& brick) {
    const WordBatch positive(0x7fffffffu);
    WordBatch n = std::bit_cast<WordBatch>((row << 16) + (brick & IndexBatch(0xffff)));
    n = (n + WordBatch(1013u)) & positive;
    n ^= n >> 13;
    n = (n * (n * n * WordBatch(60493u) + WordBatch(19990303u)) + WordBatch(1376312589u)) & positive;
    return xsimd::to_float(std::bit_cast<IndexBatch>(n)) * Batch(0x1p-31f);
}

/// How much a brick is of its second colour, and how much mortar there is. settings: by what part of a brick every
/// how-many-eth row is offset, and by how much it is squashed every how-many-eth row: offset, its frequency, squash,
/// its frequency.
Vec2b brick(Settings<4> settings, const Vec2b& at, Batch mortar_size, Batch mortar_smooth, Batch bias, Batch width,
            Batch height) {
    const Batch zero(0.0f), one(1.0f);
    const Batch row = floor(at.y / height);
    const auto is_nth = [&](float n) { return modulo(row, Batch(n)) == zero; };
    width *= select(is_nth(settings[3]), Batch(settings[2]), one);
    const Batch along = at.x + select(is_nth(settings[1]), width * Batch(settings[0]), zero);
    const Batch number = floor(along / width);
    const Batch x = along - width * number, y = at.y - height * row;
    const Batch tint = clamp01(brick_noise(to_index(row), to_index(number)) + bias);
    const Batch to_side = min(min(x, y), min(width - x, height - y));
    const Batch t = clamp01(divided(one - divided(to_side, mortar_size), mortar_smooth));
    const Batch mortar = select(mortar_smooth == zero, one, t * t * (Batch(3.0f) - Batch(2.0f) * t));
    return {tint, select(to_side >= mortar_size, zero, mortar)};
}

constexpr std::array ops{op<brick>("brick")};

}  // namespace

std::span<const OpKind> brick_ops() { return ops; }

}  // namespace pivot
