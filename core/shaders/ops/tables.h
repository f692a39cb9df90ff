// The ops of each file beside this one.
#pragma once

#include <span>

#include "core/shaders/op.h"

namespace pivot {

std::span<const OpKind> math_ops();
std::span<const OpKind> vector_math_ops();
std::span<const OpKind> map_range_ops();
std::span<const OpKind> rotation_ops();
std::span<const OpKind> color_ops();
std::span<const OpKind> blend_ops();
std::span<const OpKind> spectrum_ops();
std::span<const OpKind> geometry_ops();
std::span<const OpKind> noise_ops();
std::span<const OpKind> white_noise_ops();
std::span<const OpKind> voronoi_ops();
std::span<const OpKind> magic_ops();
std::span<const OpKind> brick_ops();
std::span<const OpKind> gabor_ops();
std::span<const OpKind> attribute_ops();
std::span<const OpKind> ray_ops();
std::span<const OpKind> normal_ops();
std::span<const OpKind> image_ops();
std::span<const OpKind> layer_ops();
std::span<const OpKind> strand_ops();

}  // namespace pivot
