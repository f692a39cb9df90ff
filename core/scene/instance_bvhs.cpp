#include "core/scene/instance_bvhs.h"

#include <algorithm>
#include <utility>

#include "core/scene/visibility.h"

namespace pivot {
namespace {

/// So many triangles of meshes with several instances are traced as if each were a mesh of its own: some 50 MB. Of a
/// mesh with more in all its instances none are, for those few would be memory and hardly faster.
constexpr std::size_t max_copied_triangles = 1u << 19;
/// Where meshes have shared BVHs, so many triangles of small ones are put into one BVH anew for each scene: some 5 ms.
constexpr std::size_t max_rebuilt_triangles = 1u << 15;

void set_transform(RTCGeometry geometry, unsigned step, const Transform& transform) {
    const Mat3<float>& m = transform.linear;
    const Vec3f& t = transform.translation;
    const float columns[12] = {m[0].x, m[0].y, m[0].z, m[1].x, m[1].y, m[1].z, m[2].x, m[2].y, m[2].z, t.x, t.y, t.z};
    rtcSetGeometryTransform(geometry, step, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns);
}

}  // namespace

InstanceBvhs::InstanceBvhs(std::shared_ptr<MeshBvhs> shared, bool finds_crossings)
    : finds_crossings_(finds_crossings),
      shared_(std::move(shared)),
      device_(shared_ ? shared_->device() : std::make_shared<const EmbreeDevice>()),
      world_(device_->make_scene()),
      still_(device_->make_scene()),
      still_in_world_(make_instance(still_.get(), {})) {
    rtcSetGeometryMask(still_in_world_.get(), ~0u);
    rtcAttachGeometryByID(world_.get(), still_in_world_.get(), still_id);
    device_->check();
}

void InstanceBvhs::set_mesh(std::uint32_t mesh_id, std::shared_ptr<const Mesh> mesh) {
    if (meshes_.contains(mesh_id)) {
        for (auto& [id, instance] : placed_)
            if (instance.mesh == mesh_id) detach(id, instance);
        mesh_bvhs_.erase(mesh_id);
        changed_ = true;
    }
    meshes_[mesh_id] = std::move(mesh);
}

void InstanceBvhs::set_instance(std::uint32_t instance_id, std::uint32_t mesh_id, const Transform& world_from_object,
                                std::uint32_t visibility) {
    const bool was_placed = placed_.contains(instance_id);
    remove_instance(instance_id);
    placed_[instance_id] = {mesh_id, world_from_object, visibility, was_placed};
    changed_ = true;
}

void InstanceBvhs::set_instance_motion(std::uint32_t instance_id, std::shared_ptr<const MovingTransform> motion) {
    Placed& instance = placed_.at(instance_id);
    detach(instance_id, instance);
    instance.motion = std::move(motion);
    changed_ = true;
}

void InstanceBvhs::set_visibility(std::uint32_t instance_id, std::uint32_t visibility) {
    Placed& instance = placed_.at(instance_id);
    if (std::exchange(instance.visibility, visibility) == visibility || instance.side == Side::none) return;
    const bool is_still = instance.side == Side::still;
    const RTCGeometry geometry =
        rtcGetGeometry(is_still ? still_.get() : world_.get(), is_still ? instance_id : instance_id + 1);
    // Embree reads masks as it traces: no BVH holds them, and none is committed for them.
    rtcSetGeometryMask(geometry, visibility);
    rtcCommitGeometry(geometry);
    device_->check();
}

void InstanceBvhs::remove_instance(std::uint32_t instance_id) {
    const auto found = placed_.find(instance_id);
    if (found == placed_.end()) return;
    detach(instance_id, found->second);
    placed_.erase(found);
    device_->check();
    changed_ = true;
}

void InstanceBvhs::commit() {
    set_filters();
    if (!changed_) return;
    attach_all();
    if (still_changed_) {
        device_->build(still_.get(), still_triangles(), filters_);
        rtcCommitGeometry(still_in_world_.get());
    }
    device_->build(world_.get(), 0, filters_);
    device_->check();
    changed_ = still_changed_ = false;
}

Owned<RTCGeometry> InstanceBvhs::make_instance(RTCScene scene, const Transform& world_from_object) const {
    Owned<RTCGeometry> geometry(rtcNewGeometry(device_->handle.get(), RTC_GEOMETRY_TYPE_INSTANCE));
    rtcSetGeometryInstancedScene(geometry.get(), scene);
    set_transform(geometry.get(), 0, world_from_object);
    return geometry;
}

RTCScene InstanceBvhs::scene_of_mesh(std::uint32_t mesh_id) {
    std::shared_ptr<const MeshBvh>& bvh = mesh_bvhs_[mesh_id];
    if (!bvh) {
        const auto& mesh = meshes_.at(mesh_id);
        bvh = shared_ ? shared_->bvh_of(mesh, filters_) : std::make_shared<const MeshBvh>(*device_, *mesh, filters_);
    }
    return bvh->scene.get();
}

void InstanceBvhs::attach_still(std::uint32_t id, Placed& instance) {
    const Mesh& mesh = *meshes_.at(instance.mesh);
    instance.positions.reserve(mesh.positions.size());
    for (const Vec3f& p : mesh.positions) instance.positions.push_back(instance.world_from_object.point(p));
    const auto geometry = device_->make_triangles(mesh, instance.positions);
    rtcSetGeometryMask(geometry.get(), instance.visibility);
    rtcCommitGeometry(geometry.get());
    rtcAttachGeometryByID(still_.get(), geometry.get(), id);
    instance.side = Side::still;
    still_changed_ = true;
}

void InstanceBvhs::attach_moving(std::uint32_t id, Placed& instance) {
    const Owned<RTCGeometry> geometry = make_instance(scene_of_mesh(instance.mesh), instance.world_from_object);
    if (instance.motion) {
        const std::span<const Transform> steps = instance.motion->steps();
        rtcSetGeometryTimeStepCount(geometry.get(), static_cast<unsigned>(steps.size()));
        for (unsigned i = 0; i < steps.size(); ++i) set_transform(geometry.get(), i, steps[i]);
    }
    rtcSetGeometryMask(geometry.get(), instance.visibility);
    rtcCommitGeometry(geometry.get());
    rtcAttachGeometryByID(world_.get(), geometry.get(), id + 1);
    instance.side = Side::moving;
    ++moving_count_;
}

void InstanceBvhs::attach_all() {
    std::unordered_map<std::uint32_t, std::size_t> uses;
    for (const auto& [id, instance] : placed_) ++uses[instance.mesh];
    for (auto& [id, instance] : placed_) {
        if (instance.side != Side::none) continue;
        if (meshes_.at(instance.mesh)->curves) {  // whose thickness is of their own space: flat there is none
            if (instance.world_from_object.is_invertible()) attach_moving(id, instance);
            continue;
        }
        const std::size_t copied = shared_ || uses[instance.mesh] > 1 ? meshes_.at(instance.mesh)->triangles.size() : 0;
        const std::size_t most = shared_ ? max_rebuilt_triangles : max_copied_triangles;
        const bool has_room = copied_triangles_ + copied <= most && copied * uses[instance.mesh] <= most;
        // What is scaled flat has no space of its own to be traced in.
        const bool is_kept = !instance.has_moved && !instance.motion && meshes_.at(instance.mesh)->steps.empty();
        if (!instance.world_from_object.is_invertible() || (is_kept && has_room)) {
            attach_still(id, instance);
            copied_triangles_ += instance.copied_triangles = copied;
        } else {
            attach_moving(id, instance);
        }
    }
}

void InstanceBvhs::detach(std::uint32_t id, Placed& instance) {
    if (instance.side == Side::still) {
        rtcDetachGeometry(still_.get(), id);
        copied_triangles_ -= std::exchange(instance.copied_triangles, 0);
        instance.positions = {};
        still_changed_ = true;
    } else if (instance.side == Side::moving) {
        rtcDetachGeometry(world_.get(), id + 1);
        --moving_count_;
    }
    instance.side = Side::none;
}

/// BVHs know when they are built whether callbacks filter hits, which costs where none does.
void InstanceBvhs::set_filters() {
    const auto is_filter = [](const auto& entry) { return (entry.second.visibility & filters_light) != 0; };
    const bool wanted = finds_crossings_ || std::ranges::any_of(placed_, is_filter);
    if (std::exchange(filters_, wanted) == wanted) return;
    for (auto& [id, instance] : placed_) detach(id, instance);
    mesh_bvhs_.clear();
    changed_ = still_changed_ = true;
}

std::size_t InstanceBvhs::still_triangles() const {
    std::size_t count = 0;
    for (const auto& [id, instance] : placed_) {
        if (instance.side == Side::still) count += meshes_.at(instance.mesh)->triangles.size();
    }
    return count;
}

}  // namespace pivot
