// What pivot_core.Scene takes of meshes and curves.
#include <pybind11/stl.h>

#include <cstring>
#include <map>

#include "bindings/arrays.h"
#include "bindings/names.h"
#include "bindings/register.h"
#include "core/geometry/curves.h"
#include "core/scene/scene.h"

namespace pivot::bindings {
namespace {

using std::optional;
using std::string;

template <class Element, class Array>
std::vector<Element> copy_rows(const Array& array, std::size_t padding = 0) {
    std::vector<Element> values(static_cast<std::size_t>(array.shape(0)) + padding);
    std::memcpy(static_cast<void*>(values.data()), array.data(), static_cast<std::size_t>(array.nbytes()));
    return values;
}

/// What the mesh keeps of `triangle_corners`: vertex indices always, corner indices where there is corner data.
void set_triangles(Mesh& mesh, const IntArray& corner_vertices, const IntArray& triangle_corners) {
    mesh.triangle_corners = copy_rows<Triangle>(triangle_corners);
    mesh.triangles.reserve(mesh.triangle_corners.size());
    const auto corner_count = static_cast<std::uint32_t>(corner_vertices.shape(0));
    const std::int32_t* vertices = corner_vertices.data();
    for (std::size_t i = 0; i < mesh.triangle_corners.size(); ++i) {
        const Triangle& t = mesh.triangle_corners[i];
        if (std::max({t.x, t.y, t.z}) >= corner_count) {
            throw py::value_error("mesh '" + mesh.name + "': triangle " + std::to_string(i) +
                                  " has a corner past the end of " + std::to_string(corner_count));
        }
        mesh.triangles.emplace_back(vertices[t.x], vertices[t.y], vertices[t.z]);
    }
    const auto at_corners = [](const Attribute& attribute) { return attribute.at_corners; };
    if (mesh.corner_normals.empty() && std::ranges::none_of(mesh.attributes, at_corners)) mesh.triangle_corners = {};
}

/// Arrays (count, 1..4) by name.
using AttributeArrays = std::map<string, FloatArray>;

void add_attributes(Scene& scene, Mesh& mesh, const AttributeArrays& attributes, py::ssize_t count, bool at_corners) {
    for (const auto& [name, values] : attributes) {
        const string what = "mesh '" + mesh.name + "': attribute '" + name + "'";
        require_shape(values, what, {count, -1});
        if (values.shape(1) < 1 || values.shape(1) > 4) throw py::value_error(what + " must have 1 to 4 numbers each");
        mesh.attributes.push_back({.id = scene.attribute_id(name),
                                   .at_corners = at_corners,
                                   .width = static_cast<std::uint32_t>(values.shape(1)),
                                   .values = std::vector<float>(values.data(), values.data() + values.size())});
    }
}

std::uint32_t add_mesh(Scene& scene, const string& name, const FloatArray& positions, const IntArray& corner_vertices,
                       const IntArray& triangle_corners, const optional<FloatArray>& corner_normals,
                       const optional<FloatArray>& vertex_normals, const optional<IntArray>& triangle_slots,
                       const AttributeArrays& vertex_attributes, const AttributeArrays& corner_attributes) {
    const string prefix = "mesh '" + name + "': ";
    require_shape(positions, prefix + "positions", {-1, 3});
    require_shape(corner_vertices, prefix + "corner_vertices", {-1});
    require_shape(triangle_corners, prefix + "triangle_corners", {-1, 3});
    Mesh mesh;
    mesh.name = name;
    mesh.positions = copy_rows<Vec3f>(positions, 1);
    const py::ssize_t corners = corner_vertices.shape(0);
    if (corner_normals) {
        require_shape(*corner_normals, prefix + "corner_normals", {corners, 3});
        mesh.corner_normals = copy_rows<Vec3f>(*corner_normals);
    }
    if (vertex_normals) {
        if (corner_normals) throw py::value_error(prefix + "give corner_normals or vertex_normals, not both");
        require_shape(*vertex_normals, prefix + "vertex_normals", {positions.shape(0), 3});
        mesh.vertex_normals = copy_rows<Vec3f>(*vertex_normals);
    }
    add_attributes(scene, mesh, vertex_attributes, positions.shape(0), false);
    add_attributes(scene, mesh, corner_attributes, corners, true);
    set_triangles(mesh, corner_vertices, triangle_corners);
    if (triangle_slots) {
        require_shape(*triangle_slots, prefix + "triangle_slots", {triangle_corners.shape(0)});
        const std::int32_t* slots = triangle_slots->data();
        mesh.triangle_slots.assign(slots, slots + triangle_slots->size());
    }
    const py::gil_scoped_release release;
    return scene.add_mesh(std::move(mesh));
}

std::uint32_t add_curves(Scene& scene, const string& name, const FloatArray& positions, const FloatArray& radii_m,
                         const IntArray& offsets, const string& shape, std::uint32_t subdivisions,
                         const AttributeArrays& point_attributes, const optional<IntArray>& segment_slots) {
    const string prefix = "curves '" + name + "': ";
    require_shape(positions, prefix + "positions", {-1, 3});
    require_shape(radii_m, prefix + "radii_m", {positions.shape(0)});
    require_shape(offsets, prefix + "offsets", {-1});
    const CurveSettings settings{
        from_name<CurveShape>(
            "shape", shape, {{"RIBBON", CurveShape::ribbon}, {"ROUND", CurveShape::round}, {"BALL", CurveShape::ball}}),
        subdivisions};
    Mesh mesh = make_curves(
        name, {reinterpret_cast<const Vec3f*>(positions.data()), static_cast<std::size_t>(positions.shape(0))},
        {radii_m.data(), static_cast<std::size_t>(radii_m.size())},
        {offsets.data(), static_cast<std::size_t>(offsets.size())}, settings);
    add_attributes(scene, mesh, point_attributes, positions.shape(0), false);
    if (segment_slots) {
        require_shape(*segment_slots, prefix + "segment_slots", {static_cast<py::ssize_t>(mesh.triangles.size())});
        mesh.triangle_slots.assign(segment_slots->data(), segment_slots->data() + segment_slots->size());
    }
    const py::gil_scoped_release release;
    return scene.add_mesh(std::move(mesh));
}

void set_mesh_motion(Scene& scene, std::uint32_t id, const std::vector<FloatArray>& positions,
                     const optional<std::vector<FloatArray>>& corner_normals,
                     const optional<std::vector<FloatArray>>& vertex_normals) {
    const auto rows_of = [&](const optional<std::vector<FloatArray>>& steps, std::size_t i, const string& what) {
        if (!steps) return std::vector<Vec3f>();
        if (steps->size() != positions.size()) throw py::value_error(what + " must have as many steps as positions");
        require_shape((*steps)[i], what, {-1, 3});
        return copy_rows<Vec3f>((*steps)[i]);
    };
    std::vector<MeshStep> steps;
    for (std::size_t i = 0; i < positions.size(); ++i) {
        require_shape(positions[i], "positions", {-1, 3});
        steps.push_back({.positions = copy_rows<Vec3f>(positions[i], 1),
                         .corner_normals = rows_of(corner_normals, i, "corner_normals"),
                         .vertex_normals = rows_of(vertex_normals, i, "vertex_normals")});
    }
    scene.set_mesh_motion(id, std::move(steps));
}

}  // namespace

void register_meshes(py::module_& module) {
    py::class_<Mesh, std::shared_ptr<Mesh>>(module, "Mesh", "A scene's mesh, for scenes to come.");
    py::class_<Scene, std::shared_ptr<Scene>>(module.attr("Scene"))
        .def(
            "mesh", [](const Scene& scene, std::uint32_t id) { return std::const_pointer_cast<Mesh>(scene.mesh(id)); },
            py::arg("id"))
        .def(
            "add_shared_mesh", [](Scene& scene, const std::shared_ptr<Mesh>& mesh) { return scene.add_mesh(mesh); },
            py::arg("mesh"),
            "A mesh of another scene that was made with the same SharedMeshes. Returns its id in this one.")
        .def("add_mesh", &add_mesh, py::arg("name"), py::arg("positions"), py::arg("corner_vertices"),
             py::arg("triangle_corners"), py::arg("corner_normals") = py::none(),
             py::arg("vertex_normals") = py::none(), py::arg("triangle_slots") = py::none(),
             py::arg("vertex_attributes") = AttributeArrays{}, py::arg("corner_attributes") = AttributeArrays{},
             "positions (V, 3), corner_vertices (C,), triangle_corners (T, 3), corner_normals (C, 3) or vertex_normals "
             "(V, 3), without both flat shading, triangle_slots (T,) material slots; attributes by name, (V, 1..4) and "
             "(C, 1..4): what shaders read. Returns the mesh's id.")
        .def("add_curves", &add_curves, py::arg("name"), py::arg("positions"), py::arg("radii_m"), py::arg("offsets"),
             py::arg("shape") = "RIBBON", py::arg("subdivisions") = CurveSettings{}.subdivisions,
             py::arg("point_attributes") = AttributeArrays{}, py::arg("segment_slots") = py::none(),
             "Catmull-Rom splines through positions (P, 3), as thick as radii_m (P,) say; offsets (C + 1,): where each "
             "curve starts, and P. shape: RIBBON, which faces each ray, in so many straight subdivisions a segment, or "
             "ROUND; of BALL each point is one. point_attributes by name, (P, 1..4); segment_slots (S,): material "
             "slots. Returns the id of what "
             "is a mesh to all other functions.")
        .def("attribute_id", &Scene::attribute_id, py::arg("name"), "What programs call a mesh's attribute.")
        .def("set_mesh_motion", &set_mesh_motion, py::arg("id"), py::arg("positions"),
             py::arg("corner_normals") = py::none(), py::arg("vertex_normals") = py::none(),
             "Of each step, likewise, what add_mesh or add_curves was given, which is the middle of the motion.");
}

}  // namespace pivot::bindings
