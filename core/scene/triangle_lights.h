// The triangles of an instance that shine, as lights.
#pragma once

#include <vector>

#include "core/lights/light.h"
#include "core/scene/instance.h"
#include "core/shaders/shader.h"

namespace pivot {

/// A triangle of an instance of the scene.
struct SceneTriangle {
    std::uint32_t instance, triangle;
};

struct TriangleLights {
    static constexpr std::uint32_t no_light = ~0u;
    std::vector<Light> lights;
    std::vector<std::uint32_t> triangle_of_light;
    std::vector<std::uint32_t> light_of_triangle;  ///< or no_light
    bool any_varies = false;  ///< of those whose emission is a program's: their radiance is grey, a few places' mean
};

/// A light for each triangle that spans an area and, as far as its program was asked, shines. Those in one place, of
/// which rays meet one, are one light.
TriangleLights make_triangle_lights(const Mesh& mesh, const Instance& instance, std::span<const Shader> shaders,
                                    const CameraFacts& camera);

}  // namespace pivot
