// Places within a volume, where a program runs that is at no surface and of no ray.
#pragma once

#include "core/shaders/program.h"

namespace pivot {

/// Points of an object's volume, and what a shader may ask of them and of the object.
struct VolumePoints {
    std::vector<Vec3f> positions_object;
    std::vector<Attribute> attributes;  ///< what shaders read as the mesh's: a row for each point, not at_corners
    Transform world_from_object;
    ObjectFacts object;
};

/// The chosen registers at each point: as many numbers for the first, then for the second, and so on. In parallel. What
/// asks for a normal, the ray or the camera gets what it is nowhere in particular.
std::vector<float> run_in_volume(const Program& program, VolumePoints points, std::span<const std::uint32_t> registers);

}  // namespace pivot
