#include "core/scene/ray_tracer.h"

#if __has_include(<embree3/rtcore.h>)
#include <embree3/rtcore.h>
#else
#include <embree4/rtcore.h>
#endif

#include <algorithm>
#include <new>
#include <stdexcept>
#include <string>
#include <unordered_map>

namespace pivot {
namespace {

struct Release {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
    void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
};

template <class Handle>
using Owned = std::unique_ptr<std::remove_pointer_t<Handle>, Release>;

constexpr std::uint32_t still_id = 0;
/// So many triangles of meshes with several instances are traced as if each were a mesh of its own: some 50 MB.
constexpr std::size_t max_copied_triangles = 1u << 19;

/// The instance that a hit's ids name; no_instance where nothing was hit.
std::uint32_t instance_of(std::uint32_t world_id, std::uint32_t geometry_id) {
    return world_id == still_id || world_id == no_instance ? geometry_id : world_id - 1;
}

/// Calls one of Embree's rtcIntersect* and rtcOccluded*; version 3 wants a context before the rays.
template <class Call, class Rays, class... Valid>
void trace(Call call, RTCScene scene, Rays& rays, Valid... valid) {
#if RTC_VERSION_MAJOR >= 4
    call(valid..., scene, &rays, nullptr);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    call(valid..., scene, &context, &rays);
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

/// How many rays an Embree packet holds, by the type of one of its fields.
template <class Packet>
constexpr std::size_t width_of = std::extent_v<decltype(Packet::tfar)>;

/// Fills a packet with the first rays there are; `valid` is -1 for those and 0 for lanes left over.
template <class Packet>
void fill_packet(Packet& packet, int* valid, std::span<const Ray> rays, std::uint32_t mask) {
    for (std::size_t i = 0; i < width_of<Packet>; ++i) {
        valid[i] = i < rays.size() ? -1 : 0;
        const Ray& ray = rays[std::min(i, rays.size() - 1)];
        packet.org_x[i] = ray.origin.x, packet.org_y[i] = ray.origin.y, packet.org_z[i] = ray.origin.z;
        packet.dir_x[i] = ray.direction.x, packet.dir_y[i] = ray.direction.y, packet.dir_z[i] = ray.direction.z;
        packet.tnear[i] = ray.near_m;
        packet.tfar[i] = ray.far_m;
        packet.time[i] = 0.0f;
        packet.mask[i] = mask;
        packet.flags[i] = 0;
    }
}

template <class Packet, class PacketHit, class Call>
void intersect_packets(Call call, RTCScene scene, std::span<const Ray> rays, std::uint32_t mask,
                       std::span<std::optional<RayHit>> hits) {
    constexpr std::size_t width = width_of<Packet>;
    for (std::size_t first = 0; first < rays.size(); first += width) {
        alignas(64) int valid[width];
        PacketHit r;
        const std::size_t count = std::min(width, rays.size() - first);
        fill_packet(r.ray, valid, rays.subspan(first, count), mask);
        for (std::size_t i = 0; i < width; ++i) {
            r.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
            r.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
        }
        trace(call, scene, r, valid);
        for (std::size_t i = 0; i < count; ++i) {
            hits[first + i].reset();
            if (r.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) continue;
            hits[first + i] = RayHit{r.ray.tfar[i],
                                     instance_of(r.hit.instID[0][i], r.hit.geomID[i]),
                                     r.hit.primID[i],
                                     {r.hit.u[i], r.hit.v[i]}};
        }
    }
}

template <class Packet, class Call>
void occluded_packets(Call call, RTCScene scene, std::span<const Ray> rays, std::span<std::uint8_t> occluded) {
    constexpr std::size_t width = width_of<Packet>;
    for (std::size_t first = 0; first < rays.size(); first += width) {
        alignas(64) int valid[width];
        Packet r;
        const std::size_t count = std::min(width, rays.size() - first);
        fill_packet(r, valid, rays.subspan(first, count), visible_to_light);
        trace(call, scene, r, valid);
        for (std::size_t i = 0; i < count; ++i) occluded[first + i] = r.tfar[i] < 0.0f;
    }
}

#ifdef __AVX2__
using BatchRays = RTCRay8;
using BatchHits = RTCRayHit8;
constexpr auto intersect_batch = rtcIntersect8;
constexpr auto occluded_batch = rtcOccluded8;
#else
using BatchRays = RTCRay4;
using BatchHits = RTCRayHit4;
constexpr auto intersect_batch = rtcIntersect4;
constexpr auto occluded_batch = rtcOccluded4;
#endif
static_assert(width_of<BatchRays> == batch_size && no_instance == RTC_INVALID_GEOMETRY_ID);

/// Those of the batch that are rays, into `packet`; `valid` as in fill_packet. Returns whether any is.
bool fill_packet(BatchRays& packet, int* valid, const RayOf<Batch>& rays, std::uint32_t mask) {
    const auto put = [](const Batch& from, float* to) { from.store_unaligned(to); };
    put(rays.origin.x, packet.org_x), put(rays.origin.y, packet.org_y), put(rays.origin.z, packet.org_z);
    put(rays.direction.x, packet.dir_x), put(rays.direction.y, packet.dir_y), put(rays.direction.z, packet.dir_z);
    put(rays.near_m, packet.tnear), put(rays.far_m, packet.tfar), put(Batch(0.0f), packet.time);
    bool any = false;
    for (std::size_t i = 0; i < batch_size; ++i) {
        valid[i] = packet.tfar[i] > 0.0f ? -1 : 0;
        any = any || valid[i];
        packet.mask[i] = mask;
        packet.flags[i] = 0;
    }
    return any;
}

void set_transform(RTCGeometry geometry, const Transform& transform) {
    const Mat3<float>& m = transform.linear;
    const Vec3f& t = transform.translation;
    const float columns[12] = {m[0].x, m[0].y, m[0].z, m[1].x, m[1].y, m[1].z, m[2].x, m[2].y, m[2].z, t.x, t.y, t.z};
    rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns);
}

}  // namespace

struct RayTracer::Implementation {
    struct Placed {
        std::uint32_t mesh;
        Transform world_from_object;
        std::uint32_t visibility;
        bool has_moved;
    };
    enum class Side { still, moving };

    Owned<RTCDevice> device;
    Owned<RTCScene> world;  ///< still_id is the still scene; id + 1 an instance that is traced in its own space
    Owned<RTCScene> still;  ///< instances in world space: one BVH, and no transforms on the way
    std::unordered_map<std::uint32_t, const Mesh*> meshes;
    std::unordered_map<std::uint32_t, Owned<RTCScene>> mesh_scenes;  ///< of the meshes that instances need
    std::unordered_map<std::uint32_t, Placed> placed;
    std::unordered_map<std::uint32_t, Side> attached;  ///< asking Embree for an unused id aborts
    std::unordered_map<std::uint32_t, std::vector<Vec3f>> still_positions;
    std::vector<std::uint32_t> waiting;  ///< placed, for commit() to attach: adding is quick
    std::size_t copied_triangles = 0;
    bool has_still = false, has_moving = false, still_changed = true, changed = true;
    std::size_t packet_width = 1;  ///< rays that Embree traces together on this machine

    void check() const {
        const RTCError error = rtcGetDeviceError(device.get());
        if (error == RTC_ERROR_NONE) return;
        if (error == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
        throw std::runtime_error("Embree failed with error " + std::to_string(error));
    }

    /// What rays are traced in: where nothing moves, the still scene needs no other around it.
    RTCScene traced() const { return has_moving ? world.get() : still.get(); }

    Owned<RTCScene> make_scene() const {
        Owned<RTCScene> scene(rtcNewScene(device.get()));
        // Exact at shared edges: no light leaks between triangles.
        rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
        return scene;
    }

    Owned<RTCGeometry> make_triangles(const Mesh& mesh, const std::vector<Vec3f>& positions) const {
        Owned<RTCGeometry> geometry(rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_TRIANGLE));
        rtcSetSharedGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, positions.data(), 0,
                                   sizeof(Vec3f), mesh.vertex_count());
        rtcSetSharedGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, mesh.triangles.data(), 0,
                                   sizeof(Triangle), mesh.triangles.size());
        return geometry;
    }

    RTCScene scene_of_mesh(std::uint32_t mesh_id) {
        Owned<RTCScene>& scene = mesh_scenes[mesh_id];
        if (!scene) {
            const Mesh& mesh = *meshes.at(mesh_id);
            const auto geometry = make_triangles(mesh, mesh.positions);
            rtcSetGeometryMask(geometry.get(), visible_to_all);
            rtcCommitGeometry(geometry.get());
            scene = make_scene();
            rtcAttachGeometryByID(scene.get(), geometry.get(), 0);
            rtcCommitScene(scene.get());
        }
        return scene.get();
    }

    void attach_still(std::uint32_t id, const Placed& instance) {
        const Mesh& mesh = *meshes.at(instance.mesh);
        std::vector<Vec3f>& positions = still_positions[id];
        positions.reserve(mesh.positions.size());
        for (const Vec3f& p : mesh.positions) positions.push_back(instance.world_from_object.point(p));
        const auto geometry = make_triangles(mesh, positions);
        rtcSetGeometryMask(geometry.get(), instance.visibility);
        rtcCommitGeometry(geometry.get());
        rtcAttachGeometryByID(still.get(), geometry.get(), id);
        still_changed = true;
    }

    void attach_moving(std::uint32_t id, const Placed& instance) {
        const Owned<RTCGeometry> geometry(rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_INSTANCE));
        rtcSetGeometryInstancedScene(geometry.get(), scene_of_mesh(instance.mesh));
        set_transform(geometry.get(), instance.world_from_object);
        rtcSetGeometryMask(geometry.get(), instance.visibility);
        rtcCommitGeometry(geometry.get());
        rtcAttachGeometryByID(world.get(), geometry.get(), id + 1);
    }

    void detach(std::uint32_t id) {
        const auto found = attached.find(id);
        if (found == attached.end()) return;
        const bool is_still = found->second == Side::still;
        rtcDetachGeometry(is_still ? still.get() : world.get(), is_still ? id : id + 1);
        still_changed = still_changed || is_still;
        still_positions.erase(id);
        attached.erase(found);
    }

    void attach_waiting() {
        std::unordered_map<std::uint32_t, std::size_t> uses;
        for (const auto& [id, instance] : placed) ++uses[instance.mesh];
        for (const std::uint32_t id : waiting) {
            const auto found = placed.find(id);
            if (found == placed.end() || attached.contains(id)) continue;
            const Placed& instance = found->second;
            const std::size_t copied = uses[instance.mesh] > 1 ? meshes.at(instance.mesh)->triangles.size() : 0;
            const bool has_room = copied_triangles + copied <= max_copied_triangles;
            // What is scaled flat has no space of its own to be traced in.
            const bool is_still = !instance.world_from_object.is_invertible() || (!instance.has_moved && has_room);
            if (is_still) attach_still(id, instance);
            if (is_still) copied_triangles += copied;
            if (!is_still) attach_moving(id, instance);
            attached[id] = is_still ? Side::still : Side::moving;
        }
        waiting.clear();
    }
};

RayTracer::RayTracer() : implementation_(std::make_unique<Implementation>()) {
    auto& self = *implementation_;
    self.device.reset(rtcNewDevice(nullptr));
    if (!self.device)
        throw std::runtime_error("Embree could not start: error " + std::to_string(rtcGetDeviceError(nullptr)));
    const auto supports = [&](RTCDeviceProperty property) { return rtcGetDeviceProperty(self.device.get(), property); };
    if (supports(RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED) != 0) {
        self.packet_width = 16;
    } else if (supports(RTC_DEVICE_PROPERTY_NATIVE_RAY8_SUPPORTED) != 0) {
        self.packet_width = 8;
    }
    self.world = self.make_scene();
    self.still = self.make_scene();
    self.check();
}

RayTracer::~RayTracer() = default;

void RayTracer::set_mesh(std::uint32_t mesh_id, const Mesh& mesh) { implementation_->meshes[mesh_id] = &mesh; }

void RayTracer::set_instance(std::uint32_t instance_id, std::uint32_t mesh_id, const Transform& world_from_object,
                             std::uint32_t visibility) {
    auto& self = *implementation_;
    const bool was_placed = self.placed.contains(instance_id);
    remove_instance(instance_id);
    self.placed[instance_id] = {mesh_id, world_from_object, visibility, was_placed};
    self.waiting.push_back(instance_id);
    self.changed = true;
}

void RayTracer::remove_instance(std::uint32_t instance_id) {
    auto& self = *implementation_;
    self.placed.erase(instance_id);
    self.detach(instance_id);
    self.check();
    self.changed = true;
}

void RayTracer::commit() {
    auto& self = *implementation_;
    if (!self.changed) return;
    self.attach_waiting();
    const auto has = [&](Implementation::Side side) {
        return std::any_of(self.attached.begin(), self.attached.end(),
                           [&](const auto& one) { return one.second == side; });
    };
    self.has_moving = has(Implementation::Side::moving);
    if (self.still_changed) {
        rtcCommitScene(self.still.get());
        if (self.has_still) rtcDetachGeometry(self.world.get(), still_id);
        self.has_still = has(Implementation::Side::still);
        if (self.has_still) {
            const Owned<RTCGeometry> geometry(rtcNewGeometry(self.device.get(), RTC_GEOMETRY_TYPE_INSTANCE));
            rtcSetGeometryInstancedScene(geometry.get(), self.still.get());
            set_transform(geometry.get(), {});
            rtcSetGeometryMask(geometry.get(), visible_to_all);
            rtcCommitGeometry(geometry.get());
            rtcAttachGeometryByID(self.world.get(), geometry.get(), still_id);
        }
    }
    rtcCommitScene(self.world.get());
    self.check();
    self.changed = self.still_changed = false;
}

std::optional<RayHit> RayTracer::intersect(const Ray& ray, Visibility from) const {
    RTCRayHit r{};
    r.ray = to_embree(ray, from);
    r.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    r.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    trace(rtcIntersect1, implementation_->traced(), r);
    if (r.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    return RayHit{r.ray.tfar, instance_of(r.hit.instID[0], r.hit.geomID), r.hit.primID, {r.hit.u, r.hit.v}};
}

bool RayTracer::occluded(const Ray& ray) const {
    RTCRay r = to_embree(ray, visible_to_light);
    trace(rtcOccluded1, implementation_->traced(), r);
    return r.tfar < 0.0f;
}

void RayTracer::intersect(std::span<const Ray> rays, Visibility from, std::span<std::optional<RayHit>> hits) const {
    const auto& self = *implementation_;
    if (self.packet_width == 16)
        return intersect_packets<RTCRay16, RTCRayHit16>(rtcIntersect16, self.traced(), rays, from, hits);
    if (self.packet_width == 8)
        return intersect_packets<RTCRay8, RTCRayHit8>(rtcIntersect8, self.traced(), rays, from, hits);
    for (std::size_t i = 0; i < rays.size(); ++i) hits[i] = intersect(rays[i], from);
}

void RayTracer::occluded(std::span<const Ray> rays, std::span<std::uint8_t> occluded_rays) const {
    const auto& self = *implementation_;
    if (self.packet_width == 16) return occluded_packets<RTCRay16>(rtcOccluded16, self.traced(), rays, occluded_rays);
    if (self.packet_width == 8) return occluded_packets<RTCRay8>(rtcOccluded8, self.traced(), rays, occluded_rays);
    for (std::size_t i = 0; i < rays.size(); ++i) occluded_rays[i] = occluded(rays[i]);
}

RayHitOf<Batch> RayTracer::intersect(const RayOf<Batch>& rays, Visibility from) const {
    alignas(64) int valid[batch_size];
    BatchHits r;
    const bool any = fill_packet(r.ray, valid, rays, from);
    for (std::size_t i = 0; i < batch_size; ++i) {
        r.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
        r.hit.instID[0][i] = no_instance;
    }
    if (any) trace(intersect_batch, implementation_->traced(), r, valid);
    std::array<std::uint32_t, batch_size> instances;
    for (std::size_t i = 0; i < batch_size; ++i) instances[i] = instance_of(r.hit.instID[0][i], r.hit.geomID[i]);
    return {.distance_m = Batch::load_unaligned(r.ray.tfar),
            .instance = WordBatch::load_unaligned(instances.data()),
            .triangle = WordBatch::load_unaligned(r.hit.primID),
            .barycentric = {Batch::load_unaligned(r.hit.u), Batch::load_unaligned(r.hit.v)}};
}

Batch RayTracer::visibility(const RayOf<Batch>& rays) const {
    alignas(64) int valid[batch_size];
    BatchRays r;
    if (fill_packet(r, valid, rays, visible_to_light)) trace(occluded_batch, implementation_->traced(), r, valid);
    return select(Batch::load_unaligned(r.tfar) > Batch(0.0f), Batch(1.0f), Batch(0.0f));
}

}  // namespace pivot
