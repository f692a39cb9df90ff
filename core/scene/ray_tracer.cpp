#include "core/scene/ray_tracer.h"

#if __has_include(<embree3/rtcore.h>)
#include <embree3/rtcore.h>
#else
#include <embree4/rtcore.h>
#endif

#include <new>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <unordered_set>

namespace pivot {
namespace {

struct Release {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
    void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
};

template <class Handle>
using Owned = std::unique_ptr<std::remove_pointer_t<Handle>, Release>;

void intersect1(RTCScene scene, RTCRayHit& ray_hit) {
#if RTC_VERSION_MAJOR >= 4
    rtcIntersect1(scene, &ray_hit);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene, &context, &ray_hit);
#endif
}

void occluded1(RTCScene scene, RTCRay& ray) {
#if RTC_VERSION_MAJOR >= 4
    rtcOccluded1(scene, &ray);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded1(scene, &context, &ray);
#endif
}

RTCRay to_embree(const Ray& ray, std::uint32_t mask) {
    RTCRay r{};
    r.org_x = ray.origin.x, r.org_y = ray.origin.y, r.org_z = ray.origin.z;
    r.dir_x = ray.direction.x, r.dir_y = ray.direction.y, r.dir_z = ray.direction.z;
    r.tnear = ray.near_m;
    r.tfar = ray.far_m;
    r.mask = mask;
    return r;
}

}  // namespace

struct RayTracer::Implementation {
    Owned<RTCDevice> device;
    Owned<RTCScene> world;
    struct BuiltMesh {
        const Mesh* mesh;
        Owned<RTCScene> scene;
    };
    std::unordered_map<std::uint32_t, BuiltMesh> meshes;
    /// World-space vertices of the instances that are scaled flat, by instance id.
    std::unordered_map<std::uint32_t, std::vector<Vec3f>> flattened;
    std::vector<std::uint32_t> unbuilt;          ///< mesh ids; commit() builds their BVHs: adding a mesh is quick
    std::unordered_set<std::uint32_t> attached;  ///< instance ids; asking Embree for an unused one aborts
    bool changed = true;

    void check() const {
        const RTCError error = rtcGetDeviceError(device.get());
        if (error == RTC_ERROR_NONE) return;
        if (error == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
        throw std::runtime_error("Embree failed with error " + std::to_string(error));
    }

    Owned<RTCScene> make_scene(const Mesh& mesh, const std::vector<Vec3f>& positions) const {
        Owned<RTCScene> scene(rtcNewScene(device.get()));
        rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
        const Owned<RTCGeometry> geometry(rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_TRIANGLE));
        rtcSetSharedGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, positions.data(), 0,
                                   sizeof(Vec3f), mesh.vertex_count());
        rtcSetSharedGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, mesh.triangles.data(), 0,
                                   sizeof(Triangle), mesh.triangles.size());
        rtcSetGeometryMask(geometry.get(), visible_to_all);
        rtcCommitGeometry(geometry.get());
        rtcAttachGeometryByID(scene.get(), geometry.get(), 0);
        check();
        return scene;
    }
};

RayTracer::RayTracer() : implementation_(std::make_unique<Implementation>()) {
    auto& self = *implementation_;
    self.device.reset(rtcNewDevice(nullptr));
    if (!self.device)
        throw std::runtime_error("Embree could not start: error " + std::to_string(rtcGetDeviceError(nullptr)));
    self.world.reset(rtcNewScene(self.device.get()));
    // Exact at shared edges: no light leaks between triangles.
    rtcSetSceneFlags(self.world.get(), RTC_SCENE_FLAG_ROBUST);
    self.check();
}

RayTracer::~RayTracer() = default;

void RayTracer::set_mesh(std::uint32_t mesh_id, const Mesh& mesh) {
    auto& self = *implementation_;
    self.meshes[mesh_id] = {&mesh, self.make_scene(mesh, mesh.positions)};
    self.unbuilt.push_back(mesh_id);
    self.changed = true;
}

void RayTracer::set_instance(std::uint32_t instance_id, std::uint32_t mesh_id, const Transform& world_from_object,
                             std::uint32_t visibility) {
    auto& self = *implementation_;
    remove_instance(instance_id);
    const auto& built = self.meshes.at(mesh_id);
    const Owned<RTCGeometry> geometry(rtcNewGeometry(self.device.get(), RTC_GEOMETRY_TYPE_INSTANCE));
    Transform transform = world_from_object;
    if (transform.is_invertible()) {
        rtcSetGeometryInstancedScene(geometry.get(), built.scene.get());
    } else {
        // Embree traces an instance in its own space, which an object scaled flat does not have.
        std::vector<Vec3f>& positions = self.flattened[instance_id];
        for (const Vec3f& p : built.mesh->positions) positions.push_back(transform.point(p));
        transform = {};
        const auto flat = self.make_scene(*built.mesh, positions);
        rtcCommitScene(flat.get());
        rtcSetGeometryInstancedScene(geometry.get(), flat.get());
    }
    const Mat3<float>& m = transform.linear;
    const Vec3f& t = transform.translation;
    const float columns[12] = {m[0].x, m[0].y, m[0].z, m[1].x, m[1].y, m[1].z, m[2].x, m[2].y, m[2].z, t.x, t.y, t.z};
    rtcSetGeometryTransform(geometry.get(), 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns);
    rtcSetGeometryMask(geometry.get(), visibility);
    rtcCommitGeometry(geometry.get());
    rtcAttachGeometryByID(self.world.get(), geometry.get(), instance_id);
    self.attached.insert(instance_id);
    self.check();
    self.changed = true;
}

void RayTracer::remove_instance(std::uint32_t instance_id) {
    auto& self = *implementation_;
    if (self.attached.erase(instance_id) == 0) return;
    rtcDetachGeometry(self.world.get(), instance_id);
    self.flattened.erase(instance_id);
    self.check();
    self.changed = true;
}

void RayTracer::commit() {
    auto& self = *implementation_;
    if (!self.changed) return;
    for (const std::uint32_t mesh_id : self.unbuilt) rtcCommitScene(self.meshes.at(mesh_id).scene.get());
    self.unbuilt.clear();
    rtcCommitScene(self.world.get());
    self.check();
    self.changed = false;
}

std::optional<RayHit> RayTracer::intersect(const Ray& ray, Visibility from) const {
    RTCRayHit r{};
    r.ray = to_embree(ray, from);
    r.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    r.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    intersect1(implementation_->world.get(), r);
    if (r.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    return RayHit{r.ray.tfar, r.hit.instID[0], r.hit.primID, {r.hit.u, r.hit.v}};
}

bool RayTracer::occluded(const Ray& ray) const {
    RTCRay r = to_embree(ray, visible_to_light);
    occluded1(implementation_->world.get(), r);
    return r.tfar < 0.0f;
}

}  // namespace pivot
