// Hue, saturation and value as Blender's nodes reckon with them, of colors of any size, negative too. [Cycles 4.5
// util/color.h]
#pragma once

#include "core/shaders/ops/math.h"

namespace pivot {

/// Hue and saturation are 0 for greys.
inline Vec3b hsv_from_rgb(const Vec3b& rgb) {
    const Batch zero(0.0f), largest = max_component(rgb), span = largest - min(rgb.x, min(rgb.y, rgb.z));
    const Batch saturation = divided(span, largest);
    const auto below = [&](Batch part) { return divided(largest - part, span); };
    const Batch red = below(rgb.x), green = below(rgb.y), blue = below(rgb.z);
    const Batch sixths = select(rgb.x == largest, blue - green,
                                select(rgb.y == largest, Batch(2.0f) + red - blue, Batch(4.0f) + green - red));
    const Batch hue = sixths / Batch(6.0f);
    return {select(saturation != zero, select(hue < zero, hue + Batch(1.0f), hue), zero), saturation, largest};
}

/// Hues beyond 0..1 have the shape of the last sixth.
inline Vec3b rgb_from_hsv(const Vec3b& hsv) {
    const Batch one(1.0f), saturation = hsv.y, value = hsv.z;
    const Batch turn = select(hsv.x == one, Batch(0.0f), hsv.x) * Batch(6.0f), sector = floor(turn);
    const Batch part = turn - sector;
    const Batch low = value * (one - saturation), falling = value * (one - saturation * part),
                rising = value * (one - saturation * (one - part));
    const auto of_sector = [&](const std::array<Batch, 6>& choices) {
        Batch result = choices[5];
        for (std::size_t i = 0; i < 5; ++i) result = select(sector == Batch(static_cast<float>(i)), choices[i], result);
        return select(saturation != Batch(0.0f), result, value);
    };
    return {of_sector({value, falling, low, low, rising, value}), of_sector({rising, value, value, falling, low, low}),
            of_sector({low, low, rising, value, value, falling})};
}

}  // namespace pivot
