// Which BVHs instances are in: what is still in one of world space, the rest each in its mesh's own.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <unordered_map>
#include <vector>

#include "core/geometry/mesh.h"
#include "core/math/moving_transform.h"
#include "core/scene/embree.h"
#include "core/scene/mesh_bvhs.h"

namespace pivot {

/// Throws std::bad_alloc, or std::runtime_error with Embree's message.
class InstanceBvhs {
   public:
    /// shared: BVHs of large meshes, which are then traced each in its own space. finds_crossings: rays stop at what a
    /// callback says, whether or not anything filters light.
    InstanceBvhs(std::shared_ptr<MeshBvhs> shared, bool finds_crossings);

    /// Also in place of another, of whose instances it is then.
    void set_mesh(std::uint32_t mesh_id, std::shared_ptr<const Mesh> mesh);
    /// visibility: bits of Visibility.
    void set_instance(std::uint32_t instance_id, std::uint32_t mesh_id, const Transform& world_from_object,
                      std::uint32_t visibility);
    void set_instance_motion(std::uint32_t instance_id, std::shared_ptr<const MovingTransform> motion);
    void set_visibility(std::uint32_t instance_id, std::uint32_t visibility);
    void remove_instance(std::uint32_t instance_id);
    /// Builds what has changed.
    void commit();

    /// What rays are traced in: where nothing moves, the still scene needs no other around it.
    RTCScene traced() const { return moving_count_ > 0 ? world_.get() : still_.get(); }
    /// The instance that a hit's ids name; RTC_INVALID_GEOMETRY_ID where nothing was hit.
    static std::uint32_t instance_of(std::uint32_t world_id, std::uint32_t geometry_id) {
        return world_id == still_id || world_id == RTC_INVALID_GEOMETRY_ID ? geometry_id : world_id - 1;
    }

   private:
    static constexpr std::uint32_t still_id = 0;
    enum class Side { none, still, moving };
    struct Placed {
        std::uint32_t mesh;
        Transform world_from_object;
        std::uint32_t visibility;
        bool has_moved;
        std::shared_ptr<const MovingTransform> motion = nullptr;  ///< null: it stays where it is
        Side side = Side::none;             ///< where it is attached; commit() does that: adding is quick
        std::size_t copied_triangles = 0;   ///< of what is still and has copies
        std::vector<Vec3f> positions = {};  ///< of the mesh in world space, of what is still
    };

    Owned<RTCGeometry> make_instance(RTCScene scene, const Transform& world_from_object) const;
    RTCScene scene_of_mesh(std::uint32_t mesh_id);
    void attach_still(std::uint32_t id, Placed& instance);
    void attach_moving(std::uint32_t id, Placed& instance);
    void attach_all();
    void detach(std::uint32_t id, Placed& instance);
    void set_filters();
    std::size_t still_triangles() const;

    bool finds_crossings_;
    bool filters_ = false;              ///< whether rays stop at what a callback says
    std::shared_ptr<MeshBvhs> shared_;  ///< none: it has its own
    std::shared_ptr<const EmbreeDevice> device_;
    Owned<RTCScene> world_;  ///< still_id is the still scene; id + 1 an instance that is traced in its own space
    Owned<RTCScene> still_;  ///< instances in world space: one BVH, and no transforms on the way
    Owned<RTCGeometry> still_in_world_;
    std::unordered_map<std::uint32_t, std::shared_ptr<const Mesh>> meshes_;
    std::unordered_map<std::uint32_t, std::shared_ptr<const MeshBvh>> mesh_bvhs_;  ///< of those that instances need
    std::map<std::uint32_t, Placed> placed_;
    std::size_t copied_triangles_ = 0, moving_count_ = 0;
    bool still_changed_ = true, changed_ = true;
};

}  // namespace pivot
