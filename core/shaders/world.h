// The world's light: its shader asked along directions.
#pragma once

#include "core/lights/environment.h"
#include "core/shaders/shader.h"

namespace pivot {

/// The world's shader, and the camera that it may ask of.
struct WorldView {
    const Shader& shader;
    const CameraFacts& camera;
};

/// The world's radiance along directions, unit.
Vec3b world_radiance(const WorldView& world, const Vec3b& directions, const WordBatch& ray_kind, std::uint32_t bounce,
                     Registers& registers);

/// One direction's.
Rgb world_radiance(const WorldView& world, const Vec3f& direction, std::uint32_t ray_kind, std::uint32_t bounce,
                   Registers& registers);

/// What comes from all directions: the mean, and where it comes from. Dark where it is the same all around: BSDF
/// samples find that as well.
struct WorldLight {
    Rgb mean;
    Environment environment;
};
WorldLight measure_world(const WorldView& world);

}  // namespace pivot
