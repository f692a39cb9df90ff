// The scene as it is edited: meshes, instances, materials, lights, world, camera. Bad input throws
// std::invalid_argument that names the thing. Ids are small integers and stay valid until removed. An edit that throws
// has changed nothing; while a SceneHold lives every edit throws std::logic_error.
#pragma once

#include <mutex>
#include <string>
#include <vector>

#include "core/lights/light_tree.h"
#include "core/scene/bent_cones.h"
#include "core/scene/camera.h"
#include "core/scene/inner_rays.h"
#include "core/scene/light_rules.h"
#include "core/scene/media.h"
#include "core/scene/triangle_lights.h"
#include "core/shaders/lamp.h"
#include "core/shaders/world.h"

namespace pivot {

struct NamedLight {
    std::string name;
    std::optional<Light> light;  ///< none: removed
    LightRules rules;
    std::uint32_t group = no_light_group;
    std::shared_ptr<const Shader> shader;  ///< what its own nodes leave of it; null: all, everywhere
};

/// What scenes share that are made one after the other, as edits ask for, of meshes that are mostly the same.
struct SharedMeshes {
    std::shared_ptr<MeshBvhs> bvhs = std::make_shared<MeshBvhs>();
    std::vector<std::string> attribute_names;  ///< an id is a place
};

class Scene {
   public:
    Scene() = default;
    explicit Scene(std::shared_ptr<SharedMeshes> shared)
        : shared_(std::move(shared)), ray_tracer_(shared_->bvhs), inner_rays_(shared_->bvhs) {}

    std::uint32_t add_mesh(Mesh mesh);
    /// One that another scene has, by the same SharedMeshes.
    std::uint32_t add_mesh(std::shared_ptr<const Mesh> mesh);
    std::shared_ptr<const Mesh> mesh(std::uint32_t id) const;
    /// The id of a mesh's attribute by its name, the same for all meshes.
    std::uint32_t attribute_id(const std::string& name);
    std::uint32_t add_material(const std::string& name, Shader shader);
    /// An instance for each transform and its facts, else like the one given. Returns the first of their ids, which are
    /// consecutive.
    std::uint32_t add_instances(const Instance& like, std::span<const Transform> world_from_objects,
                                std::span<const ObjectFacts> facts);
    /// shader: its emission is what is left of the light, from each place of the lamp.
    std::uint32_t add_light(const std::string& name, const Light& light, const LightRules& rules = {},
                            std::uint32_t group = no_light_group, std::shared_ptr<const Shader> shader = nullptr);
    void set_material(std::uint32_t id, Shader shader);
    void set_light(std::uint32_t id, const Light& light, const LightRules& rules = {});
    void set_instance_transform(std::uint32_t id, const Transform& world_from_object);
    /// Where an instance is while the shutter is open; until its transform is set again, which is where it stands in
    /// the middle of that. One that is scaled flat then stays where it is.
    void set_instance_motion(std::uint32_t id, std::shared_ptr<const MovingTransform> motion);
    /// How a mesh deforms meanwhile: steps at even times, at least two, of as many vertices and corners as it has.
    void set_mesh_motion(std::uint32_t id, std::vector<MeshStep> steps);
    void set_instance_visibility(std::uint32_t id, std::uint32_t visibility);
    void set_instance_materials(std::uint32_t id, const std::vector<std::uint32_t>& materials);
    void remove_instance(std::uint32_t id);
    void remove_light(std::uint32_t id);
    /// Its emission is the light from everywhere.
    void set_world(Shader shader);
    void set_world_light_group(std::uint32_t group);
    void set_world_rules(const LightRules& rules);
    /// Passes show what the emission of a material, of value_material, would be in its place; or of the world.
    void set_aov(std::uint32_t material, std::uint32_t aov, std::uint32_t value_material);
    void set_world_aov(std::uint32_t aov, Shader value);
    /// Fills all space; none: nothing does.
    void set_world_medium(std::shared_ptr<const Medium> medium);
    void set_camera(const Camera& camera);

    /// Makes the scene ready for rays, to be called by who holds it. What no edit has touched stays as it is. Of
    /// several that start together one does it, the others wait. Throws std::invalid_argument without a camera.
    void commit();
    /// Traces the bent cones of all vertices if an edit has changed what any of them sees; after commit(), and shared
    /// as it is. None are there once should_stop has returned true.
    void trace_bent_cones(const std::function<bool()>& should_stop);

    /// Whether anything changes while the shutter is open; elsewhere rays need no time.
    bool moves() const { return moves_; }
    const Camera& camera() const { return camera_; }
    const CameraFacts& camera_facts() const { return camera_facts_; }
    WorldView world_view() const { return {world_, camera_facts_}; }
    /// The world's radiance where it is the same all around, else its mean.
    const Rgb& world() const { return world_.constants.emission; }
    bool has_world() const { return world_.is_emissive(); }
    /// Where the world's light comes from; dark where it is the same all around.
    const Environment& environment() const { return environment_; }
    /// The lights that were added, in that order.
    std::span<const Light> lamps() const { return lamps_; }
    std::span<const Light> triangle_lights() const { return triangle_lights_; }
    /// Every light by its place: the lamps, then the triangles.
    const Light& light(std::size_t place) const {
        return place < lamps_.size() ? lamps_[place] : triangle_lights_[place - lamps_.size()];
    }
    /// The place of the light that a triangle is; nothing where it does not shine or is too small to be sampled.
    std::optional<std::size_t> light_of(const RayHit& hit) const;
    bool has_varying_lights() const { return has_varying_lights_; }
    /// Whether some lamp has a shader; that of a light by its place, null where it has none.
    bool has_shaded_lamps() const { return has_shaded_lamps_; }
    const Shader* lamp_shader(std::size_t place) const {
        return has_shaded_lamps_ && place < lamp_shaders_.size() ? lamp_shaders_[place].get() : nullptr;
    }
    /// What that leaves of the light along a ray.
    Rgb lamp_share(std::size_t place, const Vec3f& from, const Vec3f& wi, std::uint32_t bounce,
                   Registers& registers) const;
    /// Whether any light's rules say anything; elsewhere they need not be asked.
    bool has_light_rules() const { return has_light_rules_; }
    /// Whether a light, by its place, moves: a triangle of what does.
    bool is_moving_light(std::size_t place) const {
        return moves_ && place >= lamps_.size() && is_moving(scene_triangles_[place - lamps_.size()].instance);
    }
    /// A light by its place, where it is at a time.
    Light light_at(std::size_t place, float time) const;
    bool has_links() const { return has_links_; }
    /// Whether some light has blockers of its own.
    bool has_blockers() const { return has_blockers_; }
    /// Whether rays of a Visibility meet an instance.
    bool is_met(std::uint32_t instance, std::uint32_t by) const { return (instances_[instance]->visibility & by) != 0; }
    const LinkSets& link_sets_of(std::uint32_t instance) const { return instances_[instance]->link_sets; }
    const LightLinks& links_of(std::uint32_t instance) const { return instances_[instance]->links; }
    /// Of a light by its place.
    const LightRules& rules_of(std::size_t place) const { return light_rules_[place]; }
    /// The group whose light a light's is, by its place; what a surface shines; and the world's.
    std::uint32_t light_group_of(std::size_t place) const {
        return place < lamps_.size() ? lamp_groups_[place]
                                     : instances_[scene_triangles_[place - lamps_.size()].instance]->light_group;
    }
    std::uint32_t light_group_of(const RayHit& hit) const { return instances_[hit.instance]->light_group; }
    std::uint32_t world_light_group() const { return world_light_group_; }
    const LightRules& world_rules() const { return world_rules_; }
    bool has_world_rules() const { return world_rules_ != LightRules{}; }
    /// Whether some instance is a shadow catcher; a scene of these alone, under the same lights, to be committed.
    bool has_shadow_catchers() const;
    std::shared_ptr<Scene> only_shadow_catchers() const;
    bool is_shadow_catcher(const RayHit& hit) const { return instances_[hit.instance]->is_shadow_catcher; }
    /// What passes show of the world in place of its light.
    std::span<const std::pair<std::uint32_t, Shader>> world_aovs() const { return world_aovs_; }
    /// The triangle that one of triangle_lights() is.
    const SceneTriangle& shining_triangle(std::size_t triangle_light) const { return scene_triangles_[triangle_light]; }
    /// The triangle that a light is whose emission is a program's; nothing of other lights.
    std::optional<SceneTriangle> varying_triangle(std::size_t place) const;
    /// Of the lamps, and of the triangles.
    const LightTree& lamp_tree() const { return lamp_tree_; }
    const LightTree& triangle_tree() const { return triangle_tree_; }
    /// Whether light comes from where no light samples are drawn: the world or an emissive mesh.
    bool has_unsampled_light() const { return has_world() || has_emissive_mesh_; }
    const std::string& instance_name(std::uint32_t id) const { return instances_[id]->name; }

    std::optional<RayHit> intersect(const Ray& ray, Visibility from) const { return ray_tracer_.intersect(ray, from); }
    bool occluded(const Ray& ray) const { return ray_tracer_.occluded(ray); }
    /// Many at once, see RayTracer.
    void intersect(std::span<const Ray> rays, Visibility from, std::span<std::optional<RayHit>> hits) const {
        ray_tracer_.intersect(rays, from, hits);
    }
    void occluded(std::span<const Ray> rays, std::span<std::uint8_t> occluded_rays) const {
        ray_tracer_.occluded(rays, occluded_rays);
    }
    /// The lowest and the highest corner of a box around all surfaces.
    std::array<Vec3f, 2> bounds() const { return ray_tracer_.bounds(); }
    /// Whether light passes straight through some surface; elsewhere it need not be asked.
    bool has_transparency() const { return has_transparency_; }
    /// What filters light along shadow rays that nothing hides, see RayTracer; a batch of rays, and of each how many
    /// surfaces it may pass.
    Batch filtered(const RayOf<Batch>& rays, const std::array<std::uint32_t, batch_size>& most,
                   std::vector<RayTracer::Filtered>& found) const;
    /// What fills space; empty in most scenes.
    const Media& media() const { return *media_; }
    RayHitOf<Batch> intersect(const RayOf<Batch>& rays, const WordBatch& from) const {
        return ray_tracer_.intersect(rays, from);
    }
    void intersect(std::span<const Ray> rays, std::span<const std::uint32_t> from,
                   std::span<std::optional<RayHit>> hits) const {
        ray_tracer_.intersect(rays, from, hits);
    }
    /// Inside those instances beneath whose surface light goes; of no instance in most scenes.
    const InnerRays& inner_rays() const { return inner_rays_; }
    bool has_holdouts() const { return has_holdouts_; }
    bool is_holdout(const RayHit& hit) const { return instances_[hit.instance]->is_holdout; }
    Batch visibility(const RayOf<Batch>& rays) const { return ray_tracer_.visibility(rays); }
    /// direction: of the ray, world, of any length.
    HitTriangleOf<float> hit_triangle(const RayHit& hit, const Vec3f& direction) const;
    SurfacePoint surface_point(const Ray& ray, const RayHit& hit) const {
        return pivot::surface_point(hit_triangle(hit, ray.direction), hit.barycentric, -ray.direction);
    }
    /// What every material means; an id is its place.
    std::span<const Shader> shaders() const { return shaders_; }
    std::uint32_t material_of(const RayHit& hit) const;
    /// The object's, the material's and the asset's.
    std::array<float, 3> matte_ids_of(const RayHit& hit) const {
        const Instance& instance = *instances_[hit.instance];
        return {instance.matte_object, shaders_[material_of(hit)].matte, instance.matte_asset};
    }
    float material_index_of(const RayHit& hit) const { return shaders_[material_of(hit)].pass_index; }
    const Mesh& mesh_of(const RayHit& hit) const { return *meshes_[instances_[hit.instance]->mesh]; }
    const Transform& world_from_object(std::uint32_t instance) const { return instances_[instance]->world_from_object; }
    const ObjectFacts& facts_of(const RayHit& hit) const { return instances_[hit.instance]->facts; }
    /// What surrounding geometry leaves free, in world space; after trace_bent_cones().
    Cap<float> bent_cone(const RayHit& hit, const SurfacePoint& point) const {
        const std::optional<BentCones>& cones = bent_cones_[hit.instance];  // none of curves
        return cones ? cones->at(hit, point.front > 0.0f) : Cap<float>{point.frame.z, 1.0f};
    }

   private:
    friend class SceneHold;
    /// The triangles of an instance that shine: a part of triangle_lights_.
    struct InstanceLights {
        bool is_stale = true;  ///< by an edit since the last commit
        bool shines = false;   ///< with triangles that are sampled, or only found
        bool any_varies = false;
        std::size_t first = 0, count = 0;
        std::vector<std::uint32_t> light_of_triangle;  ///< counted from `first`; empty: none shines
    };

    /// Nobody may hold the scene while the lock lives. Throws std::logic_error where somebody does.
    [[nodiscard]] std::unique_lock<std::mutex> begin_edit();
    std::optional<Light>& light_at(std::uint32_t id);
    void require_materials(const Instance& instance) const;
    bool is_moving(std::uint32_t instance) const;
    void commit_visibility();
    void commit_inner_rays();
    void commit_motion();
    void commit_lamps();
    void commit_triangle_lights();
    void commit_light_rules();
    bool shines(std::size_t instance) const;
    LightReach light_reach() const;

    std::shared_ptr<SharedMeshes> shared_;  ///< none: it is alone
    std::vector<std::shared_ptr<const Mesh>> meshes_;
    std::vector<std::string> attribute_names_;  ///< where it is alone
    std::vector<Shader> shaders_;
    std::vector<std::optional<Instance>> instances_;
    std::vector<NamedLight> added_lights_;
    bool are_lamps_stale_ = false;
    std::vector<Light> lamps_, triangle_lights_;
    std::vector<std::uint32_t> lamp_groups_;                   ///< of each lamp
    std::vector<std::shared_ptr<const Shader>> lamp_shaders_;  ///< likewise
    bool has_shaded_lamps_ = false;
    std::uint32_t world_light_group_ = no_light_group;
    LightRules world_rules_;
    std::vector<std::pair<std::uint32_t, Shader>> world_aovs_;
    std::vector<LightRules> light_rules_;  ///< of each light, by its place; empty: none has any
    bool has_light_rules_ = false, has_links_ = false, has_blockers_ = false;
    std::vector<SceneTriangle> scene_triangles_;  ///< of each triangle light
    bool has_emissive_mesh_ = false, has_varying_lights_ = false;
    LightTree lamp_tree_, triangle_tree_;
    std::vector<InstanceLights> instance_lights_;       ///< of each instance
    std::vector<std::optional<BentCones>> bent_cones_;  ///< of each instance; empty: not traced
    LightReach bent_cone_reach_;                        ///< that these were traced with
    Shader world_{Material{}};
    std::shared_ptr<const Medium> world_medium_;
    Environment environment_;
    Camera camera_;
    CameraFacts camera_facts_;
    RayTracer ray_tracer_;
    InnerRays inner_rays_;
    std::unique_ptr<const Media> media_;
    bool has_transparency_ = false, has_holdouts_ = false, moves_ = false;
    std::mutex editing_;  ///< an edit, or a hold that begins or ends, at a time
    int holders_ = 0;
    std::mutex committing_, tracing_bent_cones_;
    bool is_committed_ = false;
};

/// A share in a scene that is to be read: while one lives, every edit throws. It waits for an edit that has begun.
class SceneHold {
   public:
    explicit SceneHold(Scene& scene);
    ~SceneHold();
    SceneHold(const SceneHold&) = delete;
    SceneHold& operator=(const SceneHold&) = delete;

   private:
    Scene& scene_;
};

}  // namespace pivot
