// What is added to a scene, changed and taken away.
#include <algorithm>
#include <stdexcept>
#include <utility>

#include "core/geometry/curves.h"
#include "core/scene/scene.h"

namespace pivot {
namespace {

bool is_finite(const Vec3f& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

void require_finite(const Transform& t, const std::string& object) {
    const Mat3<float>& m = t.linear;
    if (!is_finite(m[0]) || !is_finite(m[1]) || !is_finite(m[2]) || !is_finite(t.translation)) {
        throw std::invalid_argument("object '" + object +
                                    "': its transform is not finite; check its location, rotation, "
                                    "scale, drivers and constraints");
    }
}

void require_valid(const Mesh& mesh) {
    if (mesh.curves) return;  // make_curves() has looked at them
    const auto fail = [&](const std::string& what) {
        throw std::invalid_argument("mesh '" + mesh.name + "': " + what);
    };
    for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
        if (!is_finite(mesh.positions[i])) fail("vertex " + std::to_string(i) + " is not finite");
    }
    const auto check_indices = [&](const std::vector<Triangle>& triangles, std::size_t limit, const char* what) {
        for (std::size_t i = 0; i < triangles.size(); ++i) {
            const Triangle& t = triangles[i];
            if (std::max({t.x, t.y, t.z}) >= limit) {
                fail("triangle " + std::to_string(i) + " has a " + what + " past the end of " + std::to_string(limit));
            }
        }
    };
    check_indices(mesh.triangles, mesh.vertex_count(), "vertex");
    if (!mesh.corner_normals.empty()) check_indices(mesh.triangle_corners, mesh.corner_normals.size(), "corner");
    for (const Attribute& attribute : mesh.attributes)
        check_indices(attribute.at_corners ? mesh.triangle_corners : mesh.triangles,
                      attribute.values.size() / attribute.width, attribute.at_corners ? "corner" : "vertex");
    const auto check_normals = [&](const std::vector<Vec3f>& normals, const char* what) {
        for (std::size_t i = 0; i < normals.size(); ++i) {
            if (!is_finite(normals[i]))
                fail("the normal of " + std::string(what) + " " + std::to_string(i) + " is not finite");
        }
    };
    check_normals(mesh.corner_normals, "corner");
    check_normals(mesh.vertex_normals, "vertex");
}

void require_valid(const std::string& name, const Material& material) {
    const auto valid = [](const Rgb& c) { return is_finite(c) && std::min({c.x, c.y, c.z}) >= 0.0f; };
    if (!valid(material.diffuse) || !valid(material.conductor_f0) || !valid(material.conductor_f90) ||
        !valid(material.conductor_dip) || !valid(material.dielectric_tint) || !is_finite(material.emission) ||
        !std::isfinite(material.alpha) || !std::isfinite(material.dielectric_ior) ||
        !(material.dielectric_weight >= 0.0f) || !(material.conductor_weight >= 0.0f) || !(material.weight >= 0.0f) ||
        !valid(material.transparency.color) || !(material.transparency.opacity >= 0.0f) ||
        !std::isfinite(material.transparency.opacity)) {
        throw std::invalid_argument("material '" + name + "': a value is negative or not finite");
    }
    if (material.alpha < 0.0f || material.alpha > 1.0f)
        throw std::invalid_argument("material '" + name + "': alpha must be in [0, 1]");
    if (material.dielectric_ior < 1.0f)
        throw std::invalid_argument("material '" + name + "': dielectric_ior must be at least 1");
}

/// The value an id stands for, or an error that names what was asked for.
template <class Items>
auto& at(Items& items, std::uint32_t id, const char* what) {
    if (id >= items.size())
        throw std::invalid_argument(std::string(what) + " " + std::to_string(id) + " is not in the scene");
    return items[id];
}

template <class T>
T& at_present(std::vector<std::optional<T>>& items, std::uint32_t id, const char* what) {
    auto& item = at(items, id, what);
    if (!item) throw std::invalid_argument(std::string(what) + " " + std::to_string(id) + " was removed");
    return *item;
}

}  // namespace

SceneHold::SceneHold(Scene& scene) : scene_(scene) {
    const std::lock_guard lock(scene_.editing_);
    ++scene_.holders_;
}

SceneHold::~SceneHold() {
    const std::lock_guard lock(scene_.editing_);
    --scene_.holders_;
}

std::unique_lock<std::mutex> Scene::begin_edit() {
    std::unique_lock lock(editing_);
    if (holders_ > 0) throw std::logic_error("the scene is being rendered: wait for the session to end, then edit it");
    is_committed_ = false;
    return lock;
}

std::optional<Light>& Scene::light_at(std::uint32_t id) {
    NamedLight& named = at(added_lights_, id, "light");
    if (!named.light) throw std::invalid_argument("light '" + named.name + "' was removed");
    return named.light;
}

std::uint32_t Scene::add_mesh(Mesh mesh) {
    require_valid(mesh);
    return add_mesh(std::make_shared<const Mesh>(std::move(mesh)));
}

std::uint32_t Scene::add_mesh(std::shared_ptr<const Mesh> mesh) {
    const auto edit = begin_edit();
    const auto id = static_cast<std::uint32_t>(meshes_.size());
    ray_tracer_.set_mesh(id, mesh);
    meshes_.push_back(std::move(mesh));
    return id;
}

std::shared_ptr<const Mesh> Scene::mesh(std::uint32_t id) const { return at(meshes_, id, "mesh"); }

std::uint32_t Scene::attribute_id(const std::string& name) {
    std::vector<std::string>& names = shared_ ? shared_->attribute_names : attribute_names_;
    const auto id = static_cast<std::uint32_t>(std::ranges::find(names, name) - names.begin());
    if (id == names.size()) names.push_back(name);
    return id;
}

std::uint32_t Scene::add_material(const std::string& name, Shader shader) {
    const auto edit = begin_edit();
    require_valid(name, shader.constants);
    shader.set_transparency();
    shaders_.push_back(std::move(shader));
    return static_cast<std::uint32_t>(shaders_.size() - 1);
}

void Scene::require_materials(const Instance& instance) const {
    if (instance.materials.empty()) throw std::invalid_argument("object '" + instance.name + "' has no material id");
    for (const std::uint32_t material : instance.materials) at(shaders_, material, "material");
}

std::uint32_t Scene::add_instances(const Instance& like, std::span<const Transform> world_from_objects,
                                   std::span<const ObjectFacts> facts) {
    const auto edit = begin_edit();
    for (const Transform& transform : world_from_objects) require_finite(transform, like.name);
    at(meshes_, like.mesh, "mesh");
    require_materials(like);
    const auto first = static_cast<std::uint32_t>(instances_.size());
    for (const Transform& transform : world_from_objects) {
        ray_tracer_.set_instance(static_cast<std::uint32_t>(instances_.size()), like.mesh, transform, like.visibility);
        Instance& instance = *instances_.emplace_back(like);
        instance.world_from_object = transform;
        instance.normal_matrix = transform.normal_matrix();
        instance.facts = facts[instances_.size() - 1 - first];
    }
    instance_lights_.resize(instances_.size());
    bent_cones_.clear();
    return first;
}

std::uint32_t Scene::add_light(const std::string& name, const Light& light, const LightRules& rules,
                               std::uint32_t group, std::shared_ptr<const Shader> shader) {
    const auto edit = begin_edit();
    if (shader) shader->program.make_image_levels();
    added_lights_.push_back(NamedLight{name, light, rules, group, std::move(shader)});
    are_lamps_stale_ = true;
    return static_cast<std::uint32_t>(added_lights_.size() - 1);
}

void Scene::set_material(std::uint32_t id, Shader shader) {
    const auto edit = begin_edit();
    require_valid(std::to_string(id), shader.constants);
    Shader& edited = at(shaders_, id, "material");
    const bool changes_lights = edited.constants.emission != shader.constants.emission ||
                                edited.has_varying_emission() || shader.has_varying_emission();
    shader.set_transparency();
    edited = std::move(shader);
    if (!changes_lights) return;
    for (std::size_t i = 0; i < instances_.size(); ++i) {
        if (instances_[i] && std::ranges::find(instances_[i]->materials, id) != instances_[i]->materials.end())
            instance_lights_[i].is_stale = true;
    }
}

void Scene::set_light(std::uint32_t id, const Light& light, const LightRules& rules) {
    const auto edit = begin_edit();
    light_at(id) = light;
    added_lights_[id].rules = rules;
    are_lamps_stale_ = true;
}

void Scene::set_instance_transform(std::uint32_t id, const Transform& world_from_object) {
    const auto edit = begin_edit();
    Instance& instance = at_present(instances_, id, "instance");
    require_finite(world_from_object, instance.name);
    instance.world_from_object = world_from_object;
    instance.normal_matrix = world_from_object.normal_matrix();
    instance.motion.reset();
    ray_tracer_.set_instance(id, instance.mesh, world_from_object, instance.visibility);
    instance_lights_[id].is_stale = true;
    bent_cones_.clear();
}

void Scene::set_instance_motion(std::uint32_t id, std::shared_ptr<const MovingTransform> motion) {
    const auto edit = begin_edit();
    Instance& instance = at_present(instances_, id, "instance");
    for (const Transform& step : motion->steps()) require_finite(step, instance.name);
    if (!instance.world_from_object.is_invertible()) return;
    ray_tracer_.set_instance_motion(id, motion);
    instance.motion = std::move(motion);
    instance_lights_[id].is_stale = true;
}

void Scene::set_mesh_motion(std::uint32_t id, std::vector<MeshStep> steps) {
    const auto edit = begin_edit();
    std::shared_ptr<const Mesh>& mesh = at(meshes_, id, "mesh");
    if (mesh->curves) {
        mesh = std::make_shared<const Mesh>(moving_curves(*mesh, steps));
    } else {
        Mesh moving = *mesh;
        moving.steps = std::move(steps);
        require_steps(moving);
        mesh = std::make_shared<const Mesh>(std::move(moving));
    }
    ray_tracer_.set_mesh(id, mesh);
}

void Scene::set_instance_visibility(std::uint32_t id, std::uint32_t visibility) {
    const auto edit = begin_edit();
    const std::uint32_t before = std::exchange(at_present(instances_, id, "instance").visibility, visibility);
    ray_tracer_.set_visibility(id, visibility);
    if (((before ^ visibility) & ~std::uint32_t{visible_to_camera}) == 0) return;
    instance_lights_[id].is_stale = true;
    bent_cones_.clear();
}

void Scene::set_instance_materials(std::uint32_t id, const std::vector<std::uint32_t>& materials) {
    const auto edit = begin_edit();
    Instance edited = at_present(instances_, id, "instance");
    edited.materials = materials;
    require_materials(edited);
    instances_[id] = std::move(edited);
    instance_lights_[id].is_stale = true;
}

void Scene::remove_instance(std::uint32_t id) {
    const auto edit = begin_edit();
    at_present(instances_, id, "instance");
    instances_[id].reset();
    ray_tracer_.remove_instance(id);
    instance_lights_[id].is_stale = true;
    bent_cones_.clear();
}

void Scene::remove_light(std::uint32_t id) {
    const auto edit = begin_edit();
    light_at(id).reset();
    are_lamps_stale_ = true;
}

void Scene::set_world(Shader shader) {
    const auto edit = begin_edit();
    WorldLight light = measure_world({shader, camera_facts_});
    shader.constants.emission = light.mean;
    if (!is_finite(shader.constants.emission)) throw std::invalid_argument("world: its radiance is not finite");
    world_ = std::move(shader);
    environment_ = std::move(light.environment);
}

void Scene::set_world_rules(const LightRules& rules) {
    const auto edit = begin_edit();
    world_rules_ = rules;
}

void Scene::set_world_light_group(std::uint32_t group) {
    const auto edit = begin_edit();
    world_light_group_ = group;
}

void Scene::set_aov(std::uint32_t material, std::uint32_t aov, std::uint32_t value_material) {
    const auto edit = begin_edit();
    at(shaders_, value_material, "material");
    at(shaders_, material, "material").aovs.emplace_back(aov, value_material);
}

void Scene::set_world_aov(std::uint32_t aov, Shader value) {
    const auto edit = begin_edit();
    world_aovs_.emplace_back(aov, std::move(value));
}

void Scene::set_world_medium(std::shared_ptr<const Medium> medium) {
    const auto edit = begin_edit();
    world_medium_ = std::move(medium);
}

void Scene::set_camera(const Camera& camera) {
    const auto edit = begin_edit();
    require_finite(camera.world_from_camera, "camera");
    const Window& w = camera.window;
    if (camera.width < 1 || camera.height < 1)
        throw std::invalid_argument("camera: the frame needs at least one pixel");
    if (w.x0 < 0 || w.y0 < 0 || w.x1 > camera.width || w.y1 > camera.height || w.width() < 1 || w.height() < 1) {
        throw std::invalid_argument("camera: window must lie within the frame and hold at least one pixel");
    }
    if (!(camera.right > camera.left) || !(camera.top > camera.bottom)) {
        throw std::invalid_argument(
            "camera: view_plane must be (left, right, bottom, top) with left < right, bottom < top");
    }
    const Lens& lens = camera.lens;
    if (!(lens.radius_m >= 0.0f) || !(lens.focus_m > 0.0f) || !(lens.ratio > 0.0f) || !std::isfinite(lens.radius_m) ||
        !std::isfinite(lens.focus_m) || !std::isfinite(lens.ratio) || !std::isfinite(lens.rotation_rad)) {
        throw std::invalid_argument("camera: its lens must be finite, with its focus and its ratio above 0");
    }
    if (camera.motion)
        for (const Transform& step : camera.motion->steps()) require_finite(step, "camera");
    const Ray middle = camera.ray(0.5f * Vec2f(static_cast<float>(camera.width), static_cast<float>(camera.height)));
    if (!is_finite(middle.origin) || !is_finite(middle.direction) || std::isnan(camera.clip_end_m) ||
        !std::isfinite(camera.clip_start_m) || !std::isfinite(camera.pixel_width().at(1.0f))) {
        throw std::invalid_argument("camera: its projection or clip distances are not finite");
    }
    camera_ = camera;
    camera_facts_ = camera.facts();
}

}  // namespace pivot
