#include "core/scene/scene.h"

#include <algorithm>
#include <stdexcept>
#include <thread>

#include "core/bsdf/subsurface_entry.h"
#include "core/geometry/curves.h"

namespace pivot {

void Scene::commit() {
    const std::lock_guard lock(committing_);
    if (is_committed_) return;
    if (camera_.width == 0) throw std::invalid_argument("the scene has no camera: call set_camera");
    commit_visibility();
    commit_motion();
    media_ = std::make_unique<const Media>(world_medium_, world_light_group_, meshes_, instances_, shaders_);
    ray_tracer_.commit();
    commit_inner_rays();
    for (const Shader& shader : shaders_) shader.program.make_image_levels();
    world_.program.make_image_levels();
    for (const auto& [aov, value] : world_aovs_) value.program.make_image_levels();
    commit_lamps();
    commit_triangle_lights();
    commit_light_rules();
    is_committed_ = true;
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
        const bool filters = any_is([](const Shader& shader) { return shader.filters_light(); });
        std::uint32_t visibility = is_met ? instances_[i]->visibility : 0;
        if (visibility & casts_shadows) visibility |= filters ? filters_light : hides_light;
        if (has_blockers_of_its_own(instances_[i]->links) && shines(i)) visibility |= shines_past_others;
        has_holdouts_ = has_holdouts_ || instances_[i]->is_holdout;
        has_transparency_ = has_transparency_ || (visibility != 0 && is_transparent);
        ray_tracer_.set_visibility(static_cast<std::uint32_t>(i), visibility);
    }
}

Batch Scene::filtered(const RayOf<Batch>& rays, const std::array<std::uint32_t, batch_size>& most,
                      std::vector<RayTracer::Filtered>& found) const {
    const RayTracer::IsOpaque is_opaque = [this](std::uint32_t id, std::uint32_t triangle) {
        const Instance& instance = *instances_[id];
        return !shaders_[pivot::material_of(instance, *meshes_[instance.mesh], triangle)].filters_light();
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
    lamp_groups_.clear();
    lamp_shaders_.clear();
    has_shaded_lamps_ = false;
    for (const NamedLight& named : added_lights_) {
        if (!named.light) continue;
        lamps_.push_back(*named.light);
        lamp_groups_.push_back(named.group);
        lamp_shaders_.push_back(named.shader);
        has_shaded_lamps_ = has_shaded_lamps_ || named.shader;
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

Rgb Scene::lamp_share(std::size_t place, const Vec3f& from, const Vec3f& wi, std::uint32_t bounce,
                      Registers& registers) const {
    const Shader* shader = lamp_shader(place);
    return shader ? pivot::lamp_share({*shader, camera_facts_}, lamps_[place], from, wi, bounce, registers) : Rgb(1.0f);
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
    const Transform world_from_object = instance.motion ? instance.motion->at(hit.time) : instance.world_from_object;
    const Vec3f direction_object = glm::inverse(world_from_object.linear) * direction;
    HitTriangleOf<float> triangle =
        touching_triangle(*mesh.curves, hit.triangle, hit.barycentric, direction_object, hit.time);
    triangle.world_from_object = world_from_object;
    triangle.normal_matrix = world_from_object.normal_matrix();
    triangle.time = hit.time;
    return triangle;
}

}  // namespace pivot
