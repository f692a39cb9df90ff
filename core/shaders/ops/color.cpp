// Colors taken apart, put together and corrected, as Blender's nodes do. [Cycles 4.5 util/color.h, kernel/svm/hsv.h,
// color_util.h, math_util.h, invert.h]
#include "core/shaders/ops/color.h"

#include "core/shaders/ops/tables.h"

namespace pivot {
namespace {

const Batch zero(0.0f), one(1.0f);

Vec3b hsl_from_rgb(const Vec3b& rgb) {
    const Batch two(2.0f), largest = max_component(rgb), smallest = min(rgb.x, min(rgb.y, rgb.z));
    const Batch span = largest - smallest, sum = largest + smallest;
    const Batch lightness = min(one, sum * Batch(0.5f));
    const Batch saturation = divided(span, select(lightness > Batch(0.5f), two - sum, sum));
    const Batch red = divided(rgb.y - rgb.z, span), green = divided(rgb.z - rgb.x, span),
                blue = divided(rgb.x - rgb.y, span);
    const Batch sixths = select(rgb.x == largest, red + select(rgb.y < rgb.z, Batch(6.0f), zero),
                                select(rgb.y == largest, green + two, blue + Batch(4.0f)));
    const BatchMask grey = largest == smallest;
    return {select(grey, zero, sixths / Batch(6.0f)), select(grey, zero, saturation), lightness};
}

Vec3b rgb_from_hsl(const Vec3b& hsl) {
    const Batch sixths = hsl.x * Batch(6.0f), two(2.0f), four(4.0f), half(0.5f);
    const Batch chroma = (one - abs(two * hsl.z - one)) * hsl.y;
    const auto part = [&](Batch pure) { return (clamp01(pure) - half) * chroma + hsl.z; };
    return {part(abs(sixths - Batch(3.0f)) - one), part(two - abs(sixths - two)), part(two - abs(sixths - four))};
}

/// turned: brings the hue back to one turn.
template <Batch (*turned)(Batch)>
Vec3b hue_saturation(const Vec3b& color, Batch hue, Batch saturation, Batch value, Batch factor) {
    const Vec3b hsv = hsv_from_rgb(color);
    const Vec3b changed = rgb_from_hsv({turned(hsv.x + hue + Batch(0.5f)), clamp01(hsv.y * saturation), hsv.z * value});
    return max(factor * changed + (one - factor) * color, Vec3b(zero));
}

/// Before Blender 4.3, and wrong below 0 in the same way.
Batch remainder_of_turn(Batch hue) { return modulo(hue, one); }

Vec3b bright_contrast(const Vec3b& color, Batch bright, Batch contrast) {
    return max((one + contrast) * color + (bright - contrast * Batch(0.5f)), Vec3b(zero));
}

Vec3b gamma(const Vec3b& color, Batch gamma) {
    const auto part = [&](Batch x) { return select(gamma == zero, one, select(x > zero, power(x, gamma), x)); };
    return {part(color.x), part(color.y), part(color.z)};
}

Vec3b invert(const Vec3b& color, Batch factor) { return factor * (one - color) + (one - factor) * color; }

constexpr std::array ops{
    op<[](Batch h, Batch s, Batch v) {
        return rgb_from_hsv({h, s, v});
    }>("combine_hsv"),
    op<[](Batch h, Batch s, Batch l) {
        return rgb_from_hsl({h, s, l});
    }>("combine_hsl"),
    op<hsv_from_rgb>("separate_hsv"),
    op<hsl_from_rgb>("separate_hsl"),
    op<hue_saturation<fraction>>("hue_saturation"),
    op<hue_saturation<remainder_of_turn>>("hue_saturation_remainder"),
    op<bright_contrast>("bright_contrast"),
    op<gamma>("gamma"),
    op<invert>("invert"),
    op<[](const Vec3b& v) { return mean_component(v); }>("mean"),
};

}  // namespace

std::span<const OpKind> color_ops() { return ops; }

}  // namespace pivot
