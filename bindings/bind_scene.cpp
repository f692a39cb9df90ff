// pivot_core.Scene, Material and the lights.
#include <pybind11/stl.h>

#include <cstring>

#include "bindings/arrays.h"
#include "bindings/register.h"
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
    if (mesh.corner_normals.empty() && mesh.corner_uvs.empty()) mesh.triangle_corners = {};
}

std::uint32_t add_mesh(Scene& scene, const string& name, const FloatArray& positions, const IntArray& corner_vertices,
                       const IntArray& triangle_corners, const optional<FloatArray>& corner_normals,
                       const optional<FloatArray>& vertex_normals, const optional<FloatArray>& corner_uvs,
                       const optional<IntArray>& triangle_slots) {
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
    if (corner_uvs) {
        require_shape(*corner_uvs, prefix + "corner_uvs", {corners, 2});
        mesh.corner_uvs = copy_rows<Vec2f>(*corner_uvs);
    }
    set_triangles(mesh, corner_vertices, triangle_corners);
    if (triangle_slots) {
        require_shape(*triangle_slots, prefix + "triangle_slots", {triangle_corners.shape(0)});
        const std::int32_t* slots = triangle_slots->data();
        mesh.triangle_slots.assign(slots, slots + triangle_slots->size());
    }
    const py::gil_scoped_release release;
    return scene.add_mesh(std::move(mesh));
}

std::uint32_t visibility_of(bool camera_visible) { return camera_visible ? visible_to_all : visible_to_light; }

std::uint32_t add_instances(Scene& scene, const string& name, std::uint32_t mesh, const FloatArray& object_to_world,
                            const std::vector<std::uint32_t>& materials, bool camera_visible) {
    require_shape(object_to_world, "object '" + name + "': object_to_world", {-1, 4, 4});
    if (object_to_world.shape(0) == 0) throw py::value_error("object '" + name + "': object_to_world is empty");
    std::vector<Transform> transforms;
    for (py::ssize_t i = 0; i < object_to_world.shape(0); ++i)
        transforms.push_back(to_transform(object_to_world.data(i)));
    const py::gil_scoped_release release;
    return scene.add_instances({name, mesh, {}, materials, visibility_of(camera_visible)}, transforms);
}

void set_camera(Scene& scene, const FloatArray& camera_to_world, const std::array<float, 4>& view_plane, int width,
                int height, const optional<std::array<int, 4>>& window, float clip_start_m, float clip_end_m) {
    require_shape(camera_to_world, "camera: camera_to_world", {4, 4});
    Camera camera;
    camera.world_from_camera = to_transform(camera_to_world.data());
    camera.left = view_plane[0], camera.right = view_plane[1];
    camera.bottom = view_plane[2], camera.top = view_plane[3];
    camera.width = width, camera.height = height;
    camera.window =
        window ? Window{(*window)[0], (*window)[1], (*window)[2], (*window)[3]} : Window{0, 0, width, height};
    camera.clip_start_m = clip_start_m;
    camera.clip_end_m = clip_end_m;
    scene.set_camera(camera);
}

void register_material(py::module_& module) {
    py::class_<Material>(
        module, "Material",
        "A Lambert lobe beneath one GGX lobe, and emission; colours are linear RGB.\n\n"
        "The lobe's Fresnel is a Schlick curve from conductor_f0 to conductor_f90, in which conductor_weight is "
        "multiplied, plus, times "
        "dielectric_weight, the curve of a dielectric of dielectric_ior whose reflectance at normal "
        "incidence is scaled by dielectric_tint. alpha must be in [0, 1], dielectric_ior at least 1.")
        .def(py::init([](const Triple& diffuse, float alpha, const Triple& conductor_f0, const Triple& conductor_f90,
                         float conductor_weight, float dielectric_weight, float dielectric_ior,
                         const Triple& dielectric_tint, bool multiscatter, const Triple& emission) {
                 return Material{.diffuse = to_vec3(diffuse),
                                 .alpha = alpha,
                                 .conductor_f0 = to_vec3(conductor_f0),
                                 .conductor_f90 = to_vec3(conductor_f90),
                                 .conductor_weight = conductor_weight,
                                 .dielectric_weight = dielectric_weight,
                                 .dielectric_ior = dielectric_ior,
                                 .dielectric_tint = to_vec3(dielectric_tint),
                                 .multiscatter = multiscatter ? 1.0f : 0.0f,
                                 .emission = to_vec3(emission)};
             }),
             py::kw_only(), py::arg("diffuse") = Triple{}, py::arg("alpha") = 0.5f, py::arg("conductor_f0") = Triple{},
             py::arg("conductor_f90") = Triple{}, py::arg("conductor_weight") = 1.0f,
             py::arg("dielectric_weight") = 0.0f, py::arg("dielectric_ior") = 1.5f,
             py::arg("dielectric_tint") = Triple{1, 1, 1}, py::arg("multiscatter") = false,
             py::arg("emission") = Triple{});
}

void register_lights(py::module_& module) {
    py::class_<SphereLight>(module, "SphereLight",
                            "A sphere of radius_m; intensity in W/sr, Blender's power / (4 pi). facing_disk: a disk "
                            "turned to each point it lights instead, Blender's soft falloff.")
        .def(py::init([](const Triple& position, float radius_m, const Triple& intensity, bool facing_disk) {
                 return make_sphere_light(to_vec3(position), radius_m, to_vec3(intensity), facing_disk);
             }),
             py::arg("position"), py::arg("radius_m"), py::arg("intensity"), py::arg("facing_disk") = false);
    py::class_<SpotLight>(module, "SpotLight",
                          "A sphere that shines along direction, with a smooth step from the cone's edge inwards over "
                          "the share blend of its versine; with cosine, times the cosine from the axis.")
        .def(py::init([](const Triple& position, float radius_m, const Triple& intensity, const Triple& direction,
                         float cos_half_angle, float blend, bool facing_disk, bool cosine) {
                 return make_spot_light(make_sphere_light(to_vec3(position), radius_m, to_vec3(intensity), facing_disk),
                                        to_vec3(direction), cos_half_angle, blend, cosine);
             }),
             py::arg("position"), py::arg("radius_m"), py::arg("intensity"), py::arg("direction"),
             py::arg("cos_half_angle"), py::arg("blend"), py::arg("facing_disk") = false, py::arg("cosine") = false);
    py::class_<SunLight>(
        module, "SunLight",
        "Light from a cap of directions around direction (towards the sun); irradiance of a surface that "
        "faces it.")
        .def(py::init([](const Triple& direction, float half_angle_rad, const Triple& irradiance) {
                 return make_sun_light(to_vec3(direction), half_angle_rad, to_vec3(irradiance));
             }),
             py::arg("direction"), py::arg("half_angle_rad"), py::arg("irradiance"));
    py::class_<AreaLight>(module, "AreaLight",
                          "A parallelogram center +- half_u +- half_v, or the ellipse in it, shining towards "
                          "cross(half_u, half_v) with the given radiance.")
        .def(py::init([](const Triple& center, const Triple& half_u, const Triple& half_v, const Triple& radiance,
                         bool ellipse) {
                 return make_area_light(to_vec3(center), to_vec3(half_u), to_vec3(half_v), to_vec3(radiance), ellipse);
             }),
             py::arg("center"), py::arg("half_u"), py::arg("half_v"), py::arg("radiance"), py::arg("ellipse") = false);
}

}  // namespace

void register_scene(py::module_& module) {
    register_material(module);
    register_lights(module);
    constexpr float infinity = std::numeric_limits<float>::infinity();
    py::class_<Scene, std::shared_ptr<Scene>>(
        module, "Scene",
        "Meshes, instances, materials, lights, world and camera, edited by id. Metres; world space is z up.")
        .def(py::init<>())
        .def("add_mesh", &add_mesh, py::arg("name"), py::arg("positions"), py::arg("corner_vertices"),
             py::arg("triangle_corners"), py::arg("corner_normals") = py::none(),
             py::arg("vertex_normals") = py::none(), py::arg("corner_uvs") = py::none(),
             py::arg("triangle_slots") = py::none(),
             "positions (V, 3), corner_vertices (C,), triangle_corners (T, 3), corner_normals (C, 3) or vertex_normals "
             "(V, 3), without both flat shading, corner_uvs (C, 2), triangle_slots (T,) material slots. Returns the "
             "mesh's id.")
        .def("add_instances", &add_instances, py::arg("name"), py::arg("mesh"), py::arg("object_to_world"),
             py::arg("materials"), py::arg("camera_visible") = true,
             "object_to_world (N, 4, 4) row-major; materials: an id per slot, a slot past the end uses the last. "
             "Returns the "
             "first of N consecutive ids.")
        .def("add_material", &Scene::add_material, py::arg("name"), py::arg("material"))
        .def("add_light", &Scene::add_light, py::arg("name"), py::arg("light"))
        .def("set_material", &Scene::set_material, py::arg("id"), py::arg("material"))
        .def("set_light", &Scene::set_light, py::arg("id"), py::arg("light"))
        .def(
            "set_instance_transform",
            [](Scene& scene, std::uint32_t id, const FloatArray& object_to_world) {
                require_shape(object_to_world, "object_to_world", {4, 4});
                scene.set_instance_transform(id, to_transform(object_to_world.data()));
            },
            py::arg("id"), py::arg("object_to_world"))
        .def(
            "set_instance_visibility",
            [](Scene& scene, std::uint32_t id, bool camera_visible) {
                scene.set_instance_visibility(id, visibility_of(camera_visible));
            },
            py::arg("id"), py::arg("camera_visible"))
        .def("set_instance_materials", &Scene::set_instance_materials, py::arg("id"), py::arg("materials"),
             "materials: as in add_instances.")
        .def("remove_instance", &Scene::remove_instance, py::arg("id"))
        .def("remove_light", &Scene::remove_light, py::arg("id"))
        .def(
            "set_world", [](Scene& scene, const Triple& radiance) { scene.set_world(to_vec3(radiance)); },
            py::arg("radiance"))
        .def("set_camera", &set_camera, py::arg("camera_to_world"), py::arg("view_plane"), py::arg("width"),
             py::arg("height"), py::arg("window") = py::none(), py::arg("clip_start_m") = 0.0f,
             py::arg("clip_end_m") = infinity,
             "camera_to_world (4, 4): the camera looks down its -z. view_plane: (left, right, bottom, top) of the full "
             "frame "
             "at z = -1. window: (x0, y0, x1, y1), the pixels to render, from the bottom left.");
}

}  // namespace pivot::bindings
