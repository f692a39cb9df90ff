// A lamp's own nodes: a shader whose emission is what they leave of its light, asked at places of the lamp.
#pragma once

#include "core/lights/light.h"
#include "core/shaders/shader.h"

namespace pivot {

/// A lamp's shader, and the camera that it may ask of.
struct LampView {
    const Shader& shader;
    const CameraFacts& camera;
};

/// What is left of the lamp's light from where it is met along wi from points, at that bounce of a path. Of such rays,
/// as in Cycles, Light Path says that they are of no kind.
Vec3b lamp_share(const LampView& lamp, const Light& light, const Vec3b& from, const Vec3b& wi, std::uint32_t bounce,
                 Registers& registers);

/// The same of one ray.
Rgb lamp_share(const LampView& lamp, const Light& light, const Vec3f& from, const Vec3f& wi, std::uint32_t bounce,
               Registers& registers);

}  // namespace pivot
