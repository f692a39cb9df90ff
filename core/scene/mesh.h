// A triangle mesh in object space, with data per face corner as Blender keeps it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/math/vector.h"

namespace pivot {

using Triangle = glm::vec<3, std::uint32_t>;

struct Mesh {
    std::string name;
    /// One more than the mesh has: Embree reads 16 bytes at each vertex.
    std::vector<Vec3f> positions;
    std::vector<Triangle> triangles;            ///< vertex indices
    std::vector<Triangle> triangle_corners;     ///< corner indices; empty when no corner data is kept
    std::vector<Vec3f> corner_normals;          ///< empty: flat shading
    std::vector<Vec2f> corner_uvs;              ///< empty: none
    std::vector<std::uint16_t> triangle_slots;  ///< material slot; empty: all 0

    std::size_t vertex_count() const { return positions.size() - 1; }
    std::size_t memory_bytes() const {
        return positions.size() * sizeof(Vec3f) + (triangles.size() + triangle_corners.size()) * sizeof(Triangle) +
               corner_normals.size() * sizeof(Vec3f) + corner_uvs.size() * sizeof(Vec2f) +
               triangle_slots.size() * sizeof(std::uint16_t);
    }
};

}  // namespace pivot
