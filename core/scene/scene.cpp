#include "core/scene/scene.h"

#include <algorithm>
#include <stdexcept>
#include <thread>
#include <utility>

#include "core/bsdf/subsurface_entry.h"
#include "core/geometry/curves.h"

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

/// Steps have as much of all as the mesh.
void require_steps(const Mesh& mesh) {
    const auto is_like_mesh = [&](const MeshStep& step) {
        return step.positions.size() == mesh.positions.size() &&
               step.corner_normals.size() == mesh.corner_normals.size() &&
               step.vertex_normals.size() == mesh.vertex_normals.size();
    };
    if (mesh.steps.size() < 2 || mesh.steps.size() > MovingTransform::max_steps ||
        !std::ranges::all_of(mesh.steps, is_like_mesh))
        throw std::invalid_argument("mesh '" + mesh.name +
                                    "': its motion needs 2 to 129 steps of as many vertices and corners as it has");
    for (const MeshStep& step : mesh.steps)
        if (!std::ranges::all_of(step.positions, is_finite))
            throw std::invalid_argument("mesh '" + mesh.name + "': a vertex is not finite as it moves");
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

std::uint32_t Scene::add_light(const std::string& name, const Light& light, const LightRules& rules) {
    const auto edit = begin_edit();
    added_lights_.push_back(NamedLight{name, light, rules});
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
    Mesh moving = *mesh;
    moving.steps = std::move(steps);
    require_steps(moving);
    mesh = std::make_shared<const Mesh>(std::move(moving));
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

void Scene::commit() {
    const std::lock_guard lock(committing_);
    if (is_committed_) return;
    if (camera_.width == 0) throw std::invalid_argument("the scene has no camera: call set_camera");
    commit_visibility();
    commit_motion();
    media_ = std::make_unique<const Media>(world_medium_, meshes_, instances_, shaders_);
    ray_tracer_.commit();
    commit_inner_rays();
    for (const Shader& shader : shaders_) shader.program.make_image_levels();
    world_.program.make_image_levels();
    commit_lamps();
    commit_triangle_lights();
    commit_light_rules();
    is_committed_ = true;
}

bool Scene::is_moving(std::uint32_t instance) const {
    const auto& present = instances_[instance];
    return present && (present->motion || !meshes_[present->mesh]->steps.empty());
}

void Scene::commit_motion() {
    moves_ = camera_.motion != nullptr;
    for (std::uint32_t i = 0; i < instances_.size() && !moves_; ++i) moves_ = is_moving(i);
}

Light Scene::light_at(std::size_t place, float time) const {
    if (!is_moving_light(place)) return light(place);
    const auto [id, triangle] = scene_triangles_[place - lamps_.size()];
    const HitTriangleOf<float> at = triangle_at(*instances_[id], *meshes_[instances_[id]->mesh], triangle, time);
    const Transform& world = at.world_from_object;
    const auto moved =
        make_triangle_light({world.point(at.corner_a), world.point(at.corner_b), world.point(at.corner_c)},
                            std::get<AreaLight>(light(place)).radiance);
    return moved ? *moved : light(place);
}

void Scene::commit_visibility() {
    has_transparency_ = has_holdouts_ = false;
    for (std::size_t i = 0; i < instances_.size(); ++i) {
        if (!instances_[i]) continue;
        const auto any_is = [&](const auto& what) {
            return std::ranges::any_of(instances_[i]->materials, [&](std::uint32_t id) { return what(shaders_[id]); });
        };
        // Faces that only bound a medium are met by no ray but the media's own.
        const bool is_met = any_is([](const Shader& shader) { return shader.has_surface; });
        const bool is_transparent = any_is([](const Shader& shader) { return shader.is_transparent(); });
        std::uint32_t visibility = is_met ? instances_[i]->visibility : 0;
        if (visibility & casts_shadows) visibility |= is_transparent ? filters_light : hides_light;
        has_holdouts_ = has_holdouts_ || instances_[i]->is_holdout;
        has_transparency_ = has_transparency_ || (visibility != 0 && is_transparent);
        ray_tracer_.set_visibility(static_cast<std::uint32_t>(i), visibility);
    }
}

Batch Scene::filtered(const RayOf<Batch>& rays, const std::array<std::uint32_t, batch_size>& most,
                      std::vector<RayTracer::Filtered>& found) const {
    const RayTracer::IsOpaque is_opaque = [this](std::uint32_t id, std::uint32_t triangle) {
        const Instance& instance = *instances_[id];
        return !shaders_[pivot::material_of(instance, *meshes_[instance.mesh], triangle)].is_transparent();
    };
    return ray_tracer_.filtered(rays, most, is_opaque, found);
}

void Scene::commit_inner_rays() {
    std::vector<bool> has_inside(instances_.size());
    for (std::size_t i = 0; i < instances_.size(); ++i)
        has_inside[i] = instances_[i] && std::ranges::any_of(instances_[i]->materials, [&](std::uint32_t id) {
                            return has_subsurface(shaders_[id].constants);
                        });
    inner_rays_.set(meshes_, instances_, has_inside);
}

void Scene::commit_lamps() {
    if (!are_lamps_stale_) return;
    lamps_.clear();
    for (const NamedLight& named : added_lights_) {
        if (named.light) lamps_.push_back(*named.light);
    }
    lamp_tree_ = LightTree(lamps_);
    are_lamps_stale_ = false;
}

void Scene::commit_triangle_lights() {
    bool changes = false;
    has_emissive_mesh_ = false;
    for (std::size_t i = 0; i < instances_.size(); ++i) {
        InstanceLights& own = instance_lights_[i];
        if (own.is_stale) {
            own.shines = shines(i);
            own.is_stale = own.count > 0 || own.shines;
        }
        changes = changes || own.is_stale;
        has_emissive_mesh_ = has_emissive_mesh_ || own.shines;
    }
    if (!changes) return;
    std::vector<Light> lights;
    std::vector<SceneTriangle> triangles;
    has_varying_lights_ = false;
    for (std::size_t i = 0; i < instances_.size(); ++i) {
        InstanceLights& own = instance_lights_[i];
        const std::size_t first = lights.size();
        if (own.is_stale && own.shines) {
            const Instance& instance = *instances_[i];
            TriangleLights made = make_triangle_lights(*meshes_[instance.mesh], instance, shaders_, camera_facts_);
            lights.insert(lights.end(), made.lights.begin(), made.lights.end());
            for (const std::uint32_t triangle : made.triangle_of_light)
                triangles.push_back({static_cast<std::uint32_t>(i), triangle});
            own.any_varies = made.any_varies;
            own.light_of_triangle = std::move(made.light_of_triangle);
        } else if (own.is_stale) {
            own = InstanceLights{};
        } else {
            const auto range = [&](const auto& of_all) { return std::span(of_all).subspan(own.first, own.count); };
            lights.insert(lights.end(), range(triangle_lights_).begin(), range(triangle_lights_).end());
            triangles.insert(triangles.end(), range(scene_triangles_).begin(), range(scene_triangles_).end());
        }
        own.is_stale = false;
        own.first = first;
        own.count = lights.size() - first;
        has_varying_lights_ = has_varying_lights_ || own.any_varies;
    }
    triangle_lights_ = std::move(lights);
    scene_triangles_ = std::move(triangles);
    triangle_tree_ = LightTree(triangle_lights_);
}

void Scene::commit_light_rules() {
    light_rules_.clear();
    for (const NamedLight& named : added_lights_)
        if (named.light) light_rules_.push_back(named.rules);
    for (const SceneTriangle& triangle : scene_triangles_)
        light_rules_.push_back({.lights = instances_[triangle.instance]->visibility & visible_to_paths});
    has_light_rules_ = std::ranges::any_of(light_rules_, [](const LightRules& rules) { return rules != LightRules{}; });
    if (!has_light_rules_) light_rules_.clear();
}

bool Scene::shines(std::size_t instance) const {
    const auto& present = instances_[instance];
    if (!present || (present->visibility & visible_to_paths) == 0) return false;
    return std::ranges::any_of(present->materials, [&](std::uint32_t id) { return shaders_[id].is_emissive(); });
}

std::uint32_t Scene::material_of(const RayHit& hit) const {
    return pivot::material_of(*instances_[hit.instance], mesh_of(hit), hit.triangle);
}

std::optional<std::size_t> Scene::light_of(const RayHit& hit) const {
    const InstanceLights& own = instance_lights_[hit.instance];
    if (own.light_of_triangle.empty() || own.light_of_triangle[hit.triangle] == TriangleLights::no_light)
        return std::nullopt;
    return lamps_.size() + own.first + own.light_of_triangle[hit.triangle];
}

std::optional<SceneTriangle> Scene::varying_triangle(std::size_t place) const {
    if (!has_varying_lights_ || place < lamps_.size()) return std::nullopt;
    const SceneTriangle found = scene_triangles_[place - lamps_.size()];
    const Instance& instance = *instances_[found.instance];
    const Shader& shader = shaders_[pivot::material_of(instance, *meshes_[instance.mesh], found.triangle)];
    return shader.has_varying_emission() ? std::optional(found) : std::nullopt;
}

LightReach Scene::light_reach() const {
    LightReach reach{.positions = {}, .is_infinite = has_world()};
    for (const Light& light : lamps_) {
        if (const auto* sphere = std::get_if<SphereLight>(&light)) reach.positions.push_back(sphere->center);
        if (const auto* spot = std::get_if<SpotLight>(&light)) reach.positions.push_back(spot->sphere.center);
        if (const auto* area = std::get_if<AreaLight>(&light)) reach.positions.push_back(area->center);
        reach.is_infinite = reach.is_infinite || std::holds_alternative<SunLight>(light);
    }
    return reach;
}

void Scene::trace_bent_cones(const std::function<bool()>& should_stop) {
    std::unique_lock lock(tracing_bent_cones_, std::defer_lock);
    while (!lock.try_lock()) {
        if (should_stop()) return;
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    LightReach reach = light_reach();
    if (!bent_cones_.empty() && reach == bent_cone_reach_) return;
    std::vector<std::shared_ptr<const BentConeSites>> sites(meshes_.size());
    std::vector<std::optional<BentCones>> cones(instances_.size());
    for (std::size_t i = 0; i < instances_.size(); ++i) {
        if (!instances_[i]) continue;
        const Mesh& mesh = *meshes_[instances_[i]->mesh];
        if (mesh.curves) continue;
        auto& of_mesh = sites[instances_[i]->mesh];
        if (!of_mesh) of_mesh = std::make_shared<const BentConeSites>(mesh);
        cones[i].emplace(ray_tracer_, mesh, of_mesh, instances_[i]->world_from_object, reach, should_stop);
        if (should_stop()) return;
    }
    bent_cones_ = std::move(cones);
    bent_cone_reach_ = std::move(reach);
}

HitTriangleOf<float> Scene::hit_triangle(const RayHit& hit, const Vec3f& direction) const {
    const Instance& instance = *instances_[hit.instance];
    const Mesh& mesh = *meshes_[instance.mesh];
    if (!mesh.curves) return triangle_at(instance, mesh, hit.triangle, hit.time);
    const Vec3f direction_object = glm::inverse(instance.world_from_object.linear) * direction;
    HitTriangleOf<float> triangle = touching_triangle(*mesh.curves, hit.triangle, hit.barycentric, direction_object);
    triangle.world_from_object = instance.world_from_object;
    triangle.normal_matrix = instance.normal_matrix;
    return triangle;
}

}  // namespace pivot
