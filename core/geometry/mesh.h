// A triangle mesh in object space, with data per face corner as Blender keeps it.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/math/vector.h"

namespace pivot {

using Triangle = glm::vec<3, std::uint32_t>;

/// Numbers over a mesh that shaders read: at its vertices, or at its face corners. Interpolated between them.
struct Attribute {
    std::uint32_t id;  ///< of its name, in the scene
    bool at_corners;
    std::uint32_t width;  ///< 1 to 4 numbers each
    std::vector<float> values;
};

struct Curves;

struct Mesh {
    std::string name;
    /// One more than the mesh has: Embree reads 16 bytes at each vertex.
    std::vector<Vec3f> positions;
    std::vector<Triangle> triangles;         ///< vertex indices
    std::vector<Triangle> triangle_corners;  ///< corner indices; empty when no corner data is kept
    std::vector<Vec3f> corner_normals;       ///< empty: those of the vertices
    std::vector<Vec3f> vertex_normals;       ///< empty: none; shading is flat where no corner has one either
    std::vector<Attribute> attributes;
    std::vector<std::uint16_t> triangle_slots;  ///< material slot; empty: all 0
    std::shared_ptr<const Curves> curves;       ///< then there are no positions, see curves.h; none: a mesh

    std::size_t vertex_count() const { return positions.size() - 1; }
    const Attribute* attribute(std::uint32_t id) const {
        const auto found = std::ranges::find(attributes, id, &Attribute::id);
        return found == attributes.end() ? nullptr : &*found;
    }
    /// At a triangle's corners; 0: flat shading.
    std::array<Vec3f, 3> normals(std::size_t triangle) const {
        const bool of_corners = !corner_normals.empty();
        const std::vector<Vec3f>& normals = of_corners ? corner_normals : vertex_normals;
        if (normals.empty()) return {Vec3f(0.0f), Vec3f(0.0f), Vec3f(0.0f)};
        const Triangle& at = (of_corners ? triangle_corners : triangles)[triangle];
        return {normals[at.x], normals[at.y], normals[at.z]};
    }
};

}  // namespace pivot
