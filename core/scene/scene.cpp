#include "core/scene/scene.h"

#include <stdexcept>
#include <thread>

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
    for (std::size_t i = 0; i < mesh.corner_normals.size(); ++i) {
        if (!is_finite(mesh.corner_normals[i])) fail("the normal of corner " + std::to_string(i) + " is not finite");
    }
}

void require_valid(const std::string& name, const Material& material) {
    const auto valid = [](const Rgb& c) { return is_finite(c) && std::min({c.x, c.y, c.z}) >= 0.0f; };
    if (!valid(material.diffuse) || !valid(material.conductor_f0) || !valid(material.conductor_f90) ||
        !valid(material.dielectric_tint) || !is_finite(material.emission) || !std::isfinite(material.alpha) ||
        !std::isfinite(material.dielectric_ior) || !(material.dielectric_weight >= 0.0f) ||
        !(material.conductor_weight >= 0.0f)) {
        throw std::invalid_argument("material '" + name + "': a value is negative or not finite");
    }
    if (material.alpha < 0.0f || material.alpha > 1.0f)
        throw std::invalid_argument("material '" + name + "': alpha must be in [0, 1]");
    if (material.dielectric_ior < 1.0f)
        throw std::invalid_argument("material '" + name + "': dielectric_ior must be at least 1");
}

constexpr std::uint32_t no_light = ~0u;

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

void Scene::begin_edit() {
    if (holders_ > 0) throw std::logic_error("the scene is being rendered: wait for the session to end, then edit it");
    is_committed_ = false;
}

std::optional<Light>& Scene::light_at(std::uint32_t id) {
    NamedLight& named = at(lights_, id, "light");
    if (!named.light) throw std::invalid_argument("light '" + named.name + "' was removed");
    return named.light;
}

std::uint32_t Scene::add_mesh(Mesh mesh) {
    begin_edit();
    require_valid(mesh);
    const auto id = static_cast<std::uint32_t>(meshes_.size());
    meshes_.push_back(std::make_unique<const Mesh>(std::move(mesh)));
    ray_tracer_.set_mesh(id, *meshes_.back());
    return id;
}

std::uint32_t Scene::add_material(const std::string& name, const Material& material) {
    begin_edit();
    require_valid(name, material);
    materials_.push_back(material);
    return static_cast<std::uint32_t>(materials_.size() - 1);
}

std::uint32_t Scene::add_instance(Instance instance) {
    begin_edit();
    bent_cones_.clear();
    require_finite(instance.world_from_object, instance.name);
    at(meshes_, instance.mesh, "mesh");
    if (instance.materials.empty()) throw std::invalid_argument("object '" + instance.name + "' has no material id");
    for (const std::uint32_t material : instance.materials) at(materials_, material, "material");
    const auto id = static_cast<std::uint32_t>(instances_.size());
    instance.normal_matrix = instance.world_from_object.normal_matrix();
    ray_tracer_.set_instance(id, instance.mesh, instance.world_from_object, instance.visibility);
    instances_.push_back(std::move(instance));
    return id;
}

std::uint32_t Scene::add_light(const std::string& name, const Light& light) {
    begin_edit();
    bent_cones_.clear();
    lights_.push_back(NamedLight{name, light});
    return static_cast<std::uint32_t>(lights_.size() - 1);
}

void Scene::set_material(std::uint32_t id, const Material& material) {
    begin_edit();
    require_valid(std::to_string(id), material);
    at(materials_, id, "material") = material;
}

void Scene::set_light(std::uint32_t id, const Light& light) {
    begin_edit();
    bent_cones_.clear();
    light_at(id) = light;
}

void Scene::set_instance_transform(std::uint32_t id, const Transform& world_from_object) {
    begin_edit();
    bent_cones_.clear();
    Instance& instance = at_present(instances_, id, "instance");
    require_finite(world_from_object, instance.name);
    instance.world_from_object = world_from_object;
    instance.normal_matrix = world_from_object.normal_matrix();
    ray_tracer_.set_instance(id, instance.mesh, world_from_object, instance.visibility);
}

void Scene::remove_instance(std::uint32_t id) {
    begin_edit();
    bent_cones_.clear();
    at_present(instances_, id, "instance");
    instances_[id].reset();
    ray_tracer_.remove_instance(id);
}

void Scene::remove_light(std::uint32_t id) {
    begin_edit();
    bent_cones_.clear();
    light_at(id).reset();
}

void Scene::set_world(const Rgb& radiance) {
    begin_edit();
    bent_cones_.clear();
    if (!is_finite(radiance)) throw std::invalid_argument("world: its radiance is not finite");
    world_ = radiance;
}

void Scene::set_camera(const Camera& camera) {
    begin_edit();
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
    camera_ = camera;
}

void Scene::commit() {
    const std::lock_guard lock(committing_);
    if (is_committed_) return;
    if (camera_.width == 0) throw std::invalid_argument("the scene has no camera: call set_camera");
    ray_tracer_.commit();
    active_lights_.clear();
    for (const NamedLight& named : lights_) {
        if (named.light) active_lights_.push_back(*named.light);
    }
    lamp_count_ = active_lights_.size();
    has_unsampled_light_ = has_world();
    triangle_lights_.assign(instances_.size(), {});
    for (std::size_t i = 0; i < instances_.size(); ++i) {
        if (!instances_[i]) continue;
        const auto& materials = instances_[i]->materials;
        const auto is_emissive = [&](std::uint32_t material) { return materials_[material].is_emissive(); };
        if (std::none_of(materials.begin(), materials.end(), is_emissive)) continue;
        has_unsampled_light_ = true;
        add_triangle_lights(*instances_[i], triangle_lights_[i]);
    }
    lamp_tree_ = LightTree(lamps());
    triangle_tree_ = LightTree(triangle_lights());
    is_committed_ = true;
}

std::uint32_t Scene::material_of(const RayHit& hit) const {
    return material_of(*instances_[hit.instance], hit.triangle);
}

std::uint32_t Scene::material_of(const Instance& instance, std::uint32_t triangle) const {
    const Mesh& mesh = *meshes_[instance.mesh];
    const std::size_t slot = mesh.triangle_slots.empty() ? 0 : mesh.triangle_slots[triangle];
    return instance.materials[std::min(slot, instance.materials.size() - 1)];
}

void Scene::add_triangle_lights(const Instance& instance, std::vector<std::uint32_t>& light_of_triangle) {
    if ((instance.visibility & visible_to_light) == 0) return;
    const Mesh& mesh = *meshes_[instance.mesh];
    light_of_triangle.assign(mesh.triangles.size(), no_light);
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
        const Material& material = materials_[material_of(instance, i)];
        if (!material.is_emissive()) continue;
        const Triangle& t = mesh.triangles[i];
        const auto corner = [&](std::uint32_t v) { return instance.world_from_object.point(mesh.positions[v]); };
        const auto light = make_triangle_light({corner(t.x), corner(t.y), corner(t.z)}, material.emission);
        if (!light) continue;
        light_of_triangle[i] = static_cast<std::uint32_t>(active_lights_.size());
        active_lights_.push_back(*light);
    }
}

std::optional<std::size_t> Scene::light_of(const RayHit& hit) const {
    const auto& lights = triangle_lights_[hit.instance];
    if (lights.empty() || lights[hit.triangle] == no_light) return std::nullopt;
    return lights[hit.triangle];
}

void Scene::trace_bent_cones(const std::function<bool()>& should_stop) {
    std::unique_lock lock(tracing_bent_cones_, std::defer_lock);
    while (!lock.try_lock()) {
        if (should_stop()) return;
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    if (!bent_cones_.empty()) return;
    LightReach reach{.positions = {}, .is_infinite = has_world()};
    for (const Light& light : lamps()) {
        if (const auto* sphere = std::get_if<SphereLight>(&light)) reach.positions.push_back(sphere->center);
        if (const auto* spot = std::get_if<SpotLight>(&light)) reach.positions.push_back(spot->sphere.center);
        if (const auto* area = std::get_if<AreaLight>(&light)) reach.positions.push_back(area->center);
        reach.is_infinite = reach.is_infinite || std::holds_alternative<SunLight>(light);
    }
    std::vector<std::shared_ptr<const BentConeSites>> sites(meshes_.size());
    std::vector<std::optional<BentCones>> cones(instances_.size());
    for (std::size_t i = 0; i < instances_.size(); ++i) {
        if (!instances_[i]) continue;
        const Mesh& mesh = *meshes_[instances_[i]->mesh];
        auto& of_mesh = sites[instances_[i]->mesh];
        if (!of_mesh) of_mesh = std::make_shared<const BentConeSites>(mesh);
        cones[i].emplace(ray_tracer_, mesh, of_mesh, instances_[i]->world_from_object, reach, should_stop);
        if (should_stop()) return;
    }
    bent_cones_ = std::move(cones);
}

std::size_t Scene::memory_bytes() const {
    std::size_t bytes = instances_.size() * sizeof(Instance);
    // Embree keeps about 60 bytes a triangle of its own.
    for (const auto& mesh : meshes_) bytes += mesh->memory_bytes() + 60 * mesh->triangles.size();
    return bytes;
}

HitTriangleOf<float> Scene::hit_triangle(const RayHit& hit) const {
    const Instance& instance = *instances_[hit.instance];
    const Mesh& mesh = *meshes_[instance.mesh];
    const Triangle& t = mesh.triangles[hit.triangle];
    HitTriangleOf<float> triangle{.corner_a = mesh.positions[t.x],
                                  .corner_b = mesh.positions[t.y],
                                  .corner_c = mesh.positions[t.z],
                                  .normal_a = Vec3f(0.0f),
                                  .normal_b = Vec3f(0.0f),
                                  .normal_c = Vec3f(0.0f),
                                  .world_from_object = instance.world_from_object,
                                  .normal_matrix = instance.normal_matrix};
    if (!mesh.corner_normals.empty()) {
        const Triangle& corner = mesh.triangle_corners[hit.triangle];
        triangle.normal_a = mesh.corner_normals[corner.x];
        triangle.normal_b = mesh.corner_normals[corner.y];
        triangle.normal_c = mesh.corner_normals[corner.z];
    }
    return triangle;
}

}  // namespace pivot
