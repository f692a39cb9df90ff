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
/// What a mesh that deforms has at a time in place of its own; as many of each.
struct MeshStep {
    std::vector<Vec3f> positions;
    std::vector<Vec3f> corner_normals;
    std::vector<Vec3f> vertex_normals;
};

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
    std::vector<MeshStep> steps;                ///< at even times, the first at 0, the last at 1; empty: it is still

    std::size_t vertex_count() const { return positions.size() - 1; }
    const Attribute* attribute(std::uint32_t id) const {
        const auto found = std::ranges::find(attributes, id, &Attribute::id);
        return found == attributes.end() ? nullptr : &*found;
    }
    /// At a triangle's corners; 0: flat shading.
    std::array<Vec3f, 3> normals(std::size_t triangle) const {
        return normals(triangle, corner_normals, vertex_normals);
    }
    /// The same of a step.
    std::array<Vec3f, 3> normals(std::size_t triangle, const MeshStep& step) const {
        return normals(triangle, step.corner_normals, step.vertex_normals);
    }

   private:
    std::array<Vec3f, 3> normals(std::size_t triangle, const std::vector<Vec3f>& of_corners,
                                 const std::vector<Vec3f>& of_vertices) const {
        const bool at_corners = !of_corners.empty();
        const std::vector<Vec3f>& normals = at_corners ? of_corners : of_vertices;
        if (normals.empty()) return {Vec3f(0.0f), Vec3f(0.0f), Vec3f(0.0f)};
        const Triangle& at = (at_corners ? triangle_corners : triangles)[triangle];
        return {normals[at.x], normals[at.y], normals[at.z]};
    }
};

}  // namespace pivot
