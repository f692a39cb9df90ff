// The passes that every film has, by name, and how a pixel writes them.
#pragma once

#include <string_view>

#include "core/film/pixel.h"

namespace pivot {

/// A pass by Blender's name, its channels, and how a pixel writes them.
struct Pass {
    std::string_view name;
    int channels;
    void (*write)(const Pixel& pixel, const OwnSum& own, const SurfacePixel& surfaces, float* out);
    FilmParts needs{};
};

/// Throws std::invalid_argument, which lists the passes there are.
const Pass& find_pass(std::string_view name);

}  // namespace pivot
