// Numbers and colours that are as random as the bits of the point they are of.
#include "core/shaders/ops/hash.h"
#include "core/shaders/ops/tables.h"

namespace pivot {
namespace {

constexpr std::array ops{
    op<[](const Point<1>& at) { return random_number(at); }>("white_noise_1d"),
    op<[](const Point<2>& at) { return random_number(at); }>("white_noise_2d"),
    op<[](const Point<3>& at) { return random_number(at); }>("white_noise_3d"),
    op<[](const Point<4>& at) { return random_number(at); }>("white_noise_4d"),
    op<random_color<1>>("white_noise_color_1d"),
    op<random_color<2>>("white_noise_color_2d"),
    op<random_color<3>>("white_noise_color_3d"),
    op<random_color<4>>("white_noise_color_4d"),
};

}  // namespace

std::span<const OpKind> white_noise_ops() { return ops; }

}  // namespace pivot
