// The blend types of Blender's Mix nodes: a factor and two colors, which may be of any size. [Cycles 4.5
// kernel/svm/color_util.h]
#include "core/shaders/ops/color.h"
#include "core/shaders/ops/tables.h"

namespace pivot {
namespace {

const Batch zero(0.0f), one(1.0f), two(2.0f);

Vec3b mixed(Batch factor, const Vec3b& a, const Vec3b& b) { return a + factor * (b - a); }

/// Of each part by itself.
template <class Part>
Vec3b each(const Vec3b& a, const Vec3b& b, const Part& part) {
    return {part(a.x, b.x), part(a.y, b.y), part(a.z, b.z)};
}

Vec3b screen(Batch factor, const Vec3b& a, const Vec3b& b) {
    return one - ((one - factor) + factor * (one - b)) * (one - a);
}

Vec3b overlay(Batch factor, const Vec3b& a, const Vec3b& b) {
    const Batch rest = one - factor;
    return each(a, b, [&](Batch x, Batch y) {
        return select(x < Batch(0.5f), x * (rest + two * factor * y),
                      one - (rest + two * factor * (one - y)) * (one - x));
    });
}

Vec3b divide(Batch factor, const Vec3b& a, const Vec3b& b) {
    return each(a, b,
                [&](Batch x, Batch y) { return select(y != zero, (one - factor) * x + divided(factor * x, y), x); });
}

Vec3b exclusion(Batch factor, const Vec3b& a, const Vec3b& b) {
    return max(mixed(factor, a, a + b - two * a * b), Vec3b(zero));
}

Vec3b dodge(Batch factor, const Vec3b& a, const Vec3b& b) {
    return each(a, b, [&](Batch x, Batch y) {
        const Batch rest = one - factor * y;
        return select(x != zero, select(rest <= zero, one, min(divided(x, rest), one)), x);
    });
}

Vec3b burn(Batch factor, const Vec3b& a, const Vec3b& b) {
    return each(a, b, [&](Batch x, Batch y) {
        const Batch kept = (one - factor) + factor * y;
        return select(kept <= zero, zero, clamp01(one - divided(one - x, kept)));
    });
}

Vec3b hue(Batch factor, const Vec3b& a, const Vec3b& b) {
    const Vec3b of_a = hsv_from_rgb(a), of_b = hsv_from_rgb(b);
    return select(of_b.y != zero, mixed(factor, a, rgb_from_hsv({of_b.x, of_a.y, of_a.z})), a);
}

Vec3b saturation(Batch factor, const Vec3b& a, const Vec3b& b) {
    const Vec3b of_a = hsv_from_rgb(a);
    const Batch mixture = (one - factor) * of_a.y + factor * hsv_from_rgb(b).y;
    return select(of_a.y != zero, rgb_from_hsv({of_a.x, mixture, of_a.z}), a);
}

Vec3b value(Batch factor, const Vec3b& a, const Vec3b& b) {
    const Vec3b of_a = hsv_from_rgb(a);
    return rgb_from_hsv({of_a.x, of_a.y, (one - factor) * of_a.z + factor * hsv_from_rgb(b).z});
}

Vec3b color(Batch factor, const Vec3b& a, const Vec3b& b) {
    const Vec3b of_b = hsv_from_rgb(b);
    return select(of_b.y != zero, mixed(factor, a, rgb_from_hsv({of_b.x, of_b.y, hsv_from_rgb(a).z})), a);
}

Vec3b soft_light(Batch factor, const Vec3b& a, const Vec3b& b) {
    const Vec3b screened = one - (one - b) * (one - a);
    return (one - factor) * a + factor * ((one - a) * b * a + a * screened);
}

constexpr std::array ops{
    op<[](Batch t, Batch a, Batch b) { return a * (one - t) + b * t; }>("mix"),
    op<mixed>("blend_mix"),
    op<[](Batch t, const Vec3b& a, const Vec3b& b) { return mixed(t, a, a + b); }>("blend_add"),
    op<[](Batch t, const Vec3b& a, const Vec3b& b) { return mixed(t, a, a - b); }>("blend_subtract"),
    op<[](Batch t, const Vec3b& a, const Vec3b& b) { return mixed(t, a, a * b); }>("blend_multiply"),
    op<divide>("blend_divide"),
    op<[](Batch t, const Vec3b& a, const Vec3b& b) { return mixed(t, a, abs(a - b)); }>("blend_difference"),
    op<exclusion>("blend_exclusion"),
    op<[](Batch t, const Vec3b& a, const Vec3b& b) { return mixed(t, a, min(a, b)); }>("blend_darken"),
    op<[](Batch t, const Vec3b& a, const Vec3b& b) { return mixed(t, a, max(a, b)); }>("blend_lighten"),
    op<screen>("blend_screen"),
    op<overlay>("blend_overlay"),
    op<dodge>("blend_dodge"),
    op<burn>("blend_burn"),
    op<soft_light>("blend_soft_light"),
    op<[](Batch t, const Vec3b& a, const Vec3b& b) { return a + t * (two * b - one); }>("blend_linear_light"),
    op<hue>("blend_hue"),
    op<saturation>("blend_saturation"),
    op<value>("blend_value"),
    op<color>("blend_color"),
};

}  // namespace

std::span<const OpKind> blend_ops() { return ops; }

}  // namespace pivot
