// pivot_core.Scene, but for its meshes.
#include <pybind11/stl.h>

#include <map>

#include "bindings/arrays.h"
#include "bindings/names.h"
#include "bindings/register.h"
#include "core/scene/scene.h"

namespace pivot::bindings {
namespace {

using std::optional;
using std::string;

using RayNames = std::vector<string>;
/// Receivers and blockers.
using Masks = std::array<std::uint64_t, 2>;
constexpr Masks all_sets{LightLinks{}.receivers, LightLinks{}.blockers};

/// All but what is named.
std::uint32_t visibility_of(const RayNames& hidden_from) {
    std::uint32_t visibility = visible_to_all;
    for (const string& name : hidden_from)
        visibility &= ~std::uint32_t{from_name<Visibility>("hidden_from", name,
                                                           {{"CAMERA", visible_to_camera},
                                                            {"DIFFUSE", visible_to_diffuse},
                                                            {"GLOSSY", visible_to_glossy},
                                                            {"TRANSMISSION", visible_to_transmission},
                                                            {"VOLUME_SCATTER", visible_to_scatter},
                                                            {"SHADOW", casts_shadows}})};
    return visibility;
}

LightRules rules_of(const RayNames& hidden_from, std::uint32_t max_bounces, const Masks& links = all_sets) {
    const std::uint32_t visibility = visibility_of(hidden_from);
    return {.lights = visibility & visible_to_paths,
            .max_bounces = max_bounces,
            .casts_shadows = (visibility & casts_shadows) != 0,
            .links = {links[0], links[1]}};
}

std::shared_ptr<const std::vector<ObjectAttribute>> object_attributes(
    Scene& scene, const std::map<string, std::array<float, 4>>& attributes) {
    if (attributes.empty()) return nullptr;
    std::vector<ObjectAttribute> result;
    for (const auto& [name, value] : attributes) result.push_back({scene.attribute_id(name), value});
    return std::make_shared<const std::vector<ObjectAttribute>>(std::move(result));
}

std::uint32_t add_instances(Scene& scene, const string& name, std::uint32_t mesh, const FloatArray& object_to_world,
                            const std::vector<std::uint32_t>& materials, const RayNames& hidden_from, bool holdout,
                            const std::array<float, 2>& matte, const std::array<float, 4>& color, float pass_index,
                            const optional<FloatArray>& random, const optional<FloatArray>& particle_index,
                            const optional<FloatArray>& generated, const optional<FloatArray>& uv,
                            const std::map<string, std::array<float, 4>>& attributes,
                            const std::map<string, FloatArray>& own_attributes, int light_group, const Masks& links,
                            const std::array<std::uint8_t, 2>& link_sets, bool shadow_catcher) {
    const string prefix = "object '" + name + "': ";
    require_shape(object_to_world, prefix + "object_to_world", {-1, 4, 4});
    const py::ssize_t count = object_to_world.shape(0);
    if (count == 0) throw py::value_error(prefix + "object_to_world is empty");
    if (random) require_shape(*random, prefix + "random", {count});
    if (particle_index) require_shape(*particle_index, prefix + "particle_index", {count});
    if (generated) require_shape(*generated, prefix + "generated", {count, 3});
    if (uv) require_shape(*uv, prefix + "uv", {count, 2});
    for (const auto& [key, values] : own_attributes) require_shape(values, prefix + key, {count, 4});
    const ObjectFacts of_all{.attributes = object_attributes(scene, attributes),
                             .color = Rgb(color[0], color[1], color[2]),
                             .alpha = color[3],
                             .pass_index = pass_index};
    std::vector<Transform> transforms;
    std::vector<ObjectFacts> facts(static_cast<std::size_t>(count), of_all);
    for (py::ssize_t i = 0; i < count; ++i) {
        transforms.push_back(to_transform(object_to_world.data(i)));
        ObjectFacts& own = facts[static_cast<std::size_t>(i)];
        if (random) own.random = random->at(i);
        if (particle_index) own.particle_index = particle_index->at(i);
        if (generated) own.generated = {generated->at(i, 0), generated->at(i, 1), generated->at(i, 2)};
        if (uv) own.uv = {uv->at(i, 0), uv->at(i, 1)};
        if (own_attributes.empty()) continue;
        auto own_and_shared = attributes;
        for (const auto& [key, values] : own_attributes)
            own_and_shared[key] = {values.at(i, 0), values.at(i, 1), values.at(i, 2), values.at(i, 3)};
        own.attributes = object_attributes(scene, own_and_shared);
    }
    const py::gil_scoped_release release;
    return scene.add_instances({name,
                                mesh,
                                {},
                                materials,
                                visibility_of(hidden_from),
                                matte[0],
                                matte[1],
                                holdout,
                                static_cast<std::uint32_t>(light_group),
                                {links[0], links[1]},
                                {link_sets[0], link_sets[1]},
                                shadow_catcher},
                               transforms, facts);
}

std::shared_ptr<const MovingTransform> to_motion(const FloatArray& steps, const string& what) {
    require_shape(steps, what, {-1, 4, 4});
    if (steps.shape(0) < 2 || static_cast<std::size_t>(steps.shape(0)) > MovingTransform::max_steps)
        throw py::value_error(what + " must have 2 to 129 steps");
    std::vector<Transform> transforms;
    for (py::ssize_t i = 0; i < steps.shape(0); ++i) transforms.push_back(to_transform(steps.data(i)));
    return std::make_shared<const MovingTransform>(transforms);
}

void set_camera(Scene& scene, const FloatArray& camera_to_world, const std::array<float, 4>& view_plane, int width,
                int height, const optional<std::array<int, 4>>& window, float clip_start_m, float clip_end_m,
                const optional<Projection>& projection, const optional<Lens>& lens, const optional<FloatArray>& motion,
                const optional<std::vector<float>>& shutter, bool blurs) {
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
    camera.projection = projection.value_or(Perspective{});
    camera.lens = lens.value_or(Lens{});
    if (motion) camera.motion = to_motion(*motion, "camera: motion");
    if (shutter) camera.shutter = std::make_shared<const Shutter>(*shutter);
    camera.blurs = blurs;
    scene.set_camera(camera);
}

using MediumShare = std::shared_ptr<Medium>;

Shader with_medium(Shader material, const optional<MediumShare>& medium, bool has_surface, float pass_index = 0.0f,
                   float matte = 0.0f, bool filters_shadows = true) {
    material.medium = medium.value_or(nullptr);
    material.has_surface = has_surface;
    material.pass_index = pass_index;
    material.matte = matte;
    material.filters_shadows = filters_shadows;
    return material;
}

}  // namespace

void register_scene(py::module_& module) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    py::class_<SharedMeshes, std::shared_ptr<SharedMeshes>>(
        module, "SharedMeshes", "What scenes share that are made one after the other: meshes and their BVHs.")
        .def(py::init<>());
    py::class_<Scene, std::shared_ptr<Scene>>(
        module, "Scene",
        "Meshes, instances, materials, lights, world and camera, edited by id. Metres; world space is z up.")
        .def(py::init<>())
        .def(py::init<std::shared_ptr<SharedMeshes>>(), py::arg("shared"),
             "One of several that take meshes from each other.")
        .def("add_instances", &add_instances, py::arg("name"), py::arg("mesh"), py::arg("object_to_world"),
             py::arg("materials"), py::arg("hidden_from") = RayNames{}, py::arg("holdout") = false,
             py::arg("matte") = std::array<float, 2>{}, py::arg("color") = std::array<float, 4>{1.0f, 1.0f, 1.0f, 1.0f},
             py::arg("pass_index") = 0.0f, py::arg("random") = py::none(), py::arg("particle_index") = py::none(),
             py::arg("generated") = py::none(), py::arg("uv") = py::none(),
             py::arg("attributes") = std::map<string, std::array<float, 4>>{},
             py::arg("own_attributes") = std::map<string, FloatArray>{}, py::arg("light_group") = -1,
             py::arg("links") = all_sets, py::arg("link_sets") = std::array<std::uint8_t, 2>{},
             py::arg("shadow_catcher") = false,
             "object_to_world (N, 4, 4) row-major; materials: an id per slot, a slot past the end uses the last; "
             "hidden_from: which rays do not meet them, of CAMERA, DIFFUSE, GLOSSY, TRANSMISSION, VOLUME_SCATTER and "
             "SHADOW; holdout: a camera sees a hole in their place; matte: ids of "
             "the object and the asset. What "
             "shaders ask of them: color, pass_index and attributes by name; of each, random and particle_index (N,), "
             "own_attributes (N, 4) by name, and from its instancer generated (N, 3) and uv (N, 2). light_group: of "
             "their emission, which passes show "
             "apart. links: of their light, masks of the sets of receivers that it lights and of blockers whose "
             "shadows it casts; link_sets: their own of both, by number. shadow_catcher: stand-ins for real things. "
             "Returns the first of N consecutive ids.")
        .def(
            "add_material",
            [](Scene& scene, const string& name, const Shader& material, const optional<MediumShare>& medium,
               bool has_surface, float pass_index, float matte, bool filters_shadows) {
                return scene.add_material(
                    name, with_medium(material, medium, has_surface, pass_index, matte, filters_shadows));
            },
            py::arg("name"), py::arg("material"), py::arg("medium") = py::none(), py::arg("has_surface") = true,
            py::arg("pass_index") = 0.0f, py::arg("matte") = 0.0f, py::arg("filters_shadows") = true,
            "A Material or a Shader; medium: a Medium within what it surrounds; without has_surface rays pass, and "
            "nothing but the medium is there; without filters_shadows it hides light, whatever is seen through it.")
        .def(
            "add_light",
            [](Scene& scene, const string& name, const Light& light, const RayNames& hidden_from,
               std::uint32_t max_bounces, int light_group, const Masks& links, const optional<Shader>& shader) {
                return scene.add_light(name, light, rules_of(hidden_from, max_bounces, links),
                                       static_cast<std::uint32_t>(light_group),
                                       shader ? std::make_shared<const Shader>(*shader) : nullptr);
            },
            py::arg("name"), py::arg("light"), py::arg("hidden_from") = RayNames{}, py::arg("max_bounces") = ~0u,
            py::arg("light_group") = -1, py::arg("links") = all_sets, py::arg("shader") = py::none(),
            "hidden_from: what it does not light, of DIFFUSE, GLOSSY and TRANSMISSION, by surfaces, and "
            "VOLUME_SCATTER; "
            "SHADOW: nothing hides it. max_bounces: of a path that it lights; 0: what a camera sees alone. "
            "light_group, links: as in add_instances. shader: by Monte Carlo its emission is what is left of the "
            "light, "
            "from each place of the lamp.")
        .def(
            "set_material",
            [](Scene& scene, std::uint32_t id, const Shader& material, const optional<MediumShare>& medium,
               bool has_surface) { scene.set_material(id, with_medium(material, medium, has_surface)); },
            py::arg("id"), py::arg("material"), py::arg("medium") = py::none(), py::arg("has_surface") = true)
        .def(
            "set_light",
            [](Scene& scene, std::uint32_t id, const Light& light, const RayNames& hidden_from,
               std::uint32_t max_bounces) { scene.set_light(id, light, rules_of(hidden_from, max_bounces)); },
            py::arg("id"), py::arg("light"), py::arg("hidden_from") = RayNames{}, py::arg("max_bounces") = ~0u)
        .def(
            "set_instance_transform",
            [](Scene& scene, std::uint32_t id, const FloatArray& object_to_world) {
                require_shape(object_to_world, "object_to_world", {4, 4});
                scene.set_instance_transform(id, to_transform(object_to_world.data()));
            },
            py::arg("id"), py::arg("object_to_world"))
        .def(
            "set_instance_motion",
            [](Scene& scene, std::uint32_t id, const FloatArray& object_to_world) {
                scene.set_instance_motion(id, to_motion(object_to_world, "object_to_world"));
            },
            py::arg("id"), py::arg("object_to_world"),
            "object_to_world (S, 4, 4), at even times from when the shutter opens to when it closes: 2 to 129 steps.")
        .def(
            "set_instance_visibility",
            [](Scene& scene, std::uint32_t id, const RayNames& hidden_from) {
                scene.set_instance_visibility(id, visibility_of(hidden_from));
            },
            py::arg("id"), py::arg("hidden_from"))
        .def("set_instance_materials", &Scene::set_instance_materials, py::arg("id"), py::arg("materials"),
             "materials: as in add_instances.")
        .def("remove_instance", &Scene::remove_instance, py::arg("id"))
        .def("remove_light", &Scene::remove_light, py::arg("id"))
        .def(
            "set_world",
            [](Scene& scene, const Triple& radiance) {
                Material sky;
                sky.emission = to_vec3(radiance);
                scene.set_world(sky);
            },
            py::arg("radiance"))
        .def("set_world_shader", &Scene::set_world, py::arg("shader"),
             "A Shader whose emission is the light from each direction.")
        .def_property_readonly("has_shadow_catchers", &Scene::has_shadow_catchers)
        .def(
            "set_world_rules",
            [](Scene& scene, const RayNames& hidden_from, std::uint32_t max_bounces) {
                scene.set_world_rules(rules_of(hidden_from, max_bounces));
            },
            py::arg("hidden_from") = RayNames{}, py::arg("max_bounces") = ~0u, "As of lights.")
        .def("set_world_light_group", &Scene::set_world_light_group, py::arg("light_group"))
        .def("set_aov", &Scene::set_aov, py::arg("material"), py::arg("aov"), py::arg("value_material"),
             "An AOV shows what another material would emit where a camera sees this one.")
        .def("set_world_aov", &Scene::set_world_aov, py::arg("aov"), py::arg("value"),
             "The same of a Shader in the world's place.")
        .def(
            "set_world_medium",
            [](Scene& scene, const optional<MediumShare>& medium) { scene.set_world_medium(medium.value_or(nullptr)); },
            py::arg("medium"), "A Medium that fills all space, or None.")
        .def("set_camera", &set_camera, py::arg("camera_to_world"), py::arg("view_plane"), py::arg("width"),
             py::arg("height"), py::arg("window") = py::none(), py::arg("clip_start_m") = 0.0f,
             py::arg("clip_end_m") = infinity, py::arg("projection") = py::none(), py::arg("lens") = py::none(),
             py::arg("motion") = py::none(), py::arg("shutter") = py::none(), py::arg("blurs") = true,
             "camera_to_world (4, 4): the camera looks down its -z. view_plane: (left, right, bottom, top) of the full "
             "frame, in places of the projection, which is a Perspective unless one is given. window: (x0, y0, x1, "
             "y1), the pixels to render, from the bottom left. lens: a pinhole unless one is given. "
             "motion: (S, 4, 4), camera_to_world at even times while the shutter is open. shutter: how far it is open, "
             "at "
             "even times; all the time unless that is given. "
             "Without blurs all is seen in the middle of that, and the Vector pass tells how it moves.");
}

}  // namespace pivot::bindings
