#include "core/scene/mesh_bvhs.h"

#include <new>
#include <stdexcept>
#include <string>

#include "core/scene/embree.h"

namespace pivot {
namespace {

/// A BVH of more triangles is compact: it takes 50 bytes a triangle less, and rays take a quarter to a third longer.
constexpr std::size_t max_fast_triangles = 1u << 22;

}  // namespace

EmbreeDevice::EmbreeDevice() : handle(rtcNewDevice(nullptr)) {
    if (!handle)
        throw std::runtime_error("Embree could not start: error " + std::to_string(rtcGetDeviceError(nullptr)));
}

void EmbreeDevice::check() const {
    const RTCError error = rtcGetDeviceError(handle.get());
    if (error == RTC_ERROR_NONE) return;
    if (error == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
    throw std::runtime_error("Embree failed with error " + std::to_string(error));
}

void EmbreeDevice::build(RTCScene scene, std::size_t triangle_count, bool filters) const {
    // Exact at shared edges: no light leaks between triangles.
    int flags = RTC_SCENE_FLAG_ROBUST | (triangle_count > max_fast_triangles ? RTC_SCENE_FLAG_COMPACT : 0);
#if RTC_VERSION_MAJOR >= 4
    if (filters) flags |= RTC_SCENE_FLAG_FILTER_FUNCTION_IN_ARGUMENTS;
#else
    if (filters) flags |= RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION;
#endif
    rtcSetSceneFlags(scene, static_cast<RTCSceneFlags>(flags));
    rtcCommitScene(scene);
}

Owned<RTCGeometry> EmbreeDevice::make_triangles(const Mesh& mesh, const std::vector<Vec3f>& positions) const {
    Owned<RTCGeometry> geometry(rtcNewGeometry(handle.get(), RTC_GEOMETRY_TYPE_TRIANGLE));
    rtcSetSharedGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, positions.data(), 0,
                               sizeof(Vec3f), mesh.vertex_count());
    rtcSetSharedGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, mesh.triangles.data(), 0,
                               sizeof(Triangle), mesh.triangles.size());
    return geometry;
}

MeshBvh::MeshBvh(const EmbreeDevice& device, const Mesh& mesh, bool filters) : scene(device.make_scene()) {
    const auto geometry = mesh.curves ? device.make_curves(*mesh.curves) : device.make_triangles(mesh, mesh.positions);
    const bool deforms = !mesh.curves && !mesh.steps.empty();
    if (deforms) rtcSetGeometryTimeStepCount(geometry.get(), static_cast<unsigned>(mesh.steps.size()));
    for (unsigned i = 0; deforms && i < mesh.steps.size(); ++i)
        rtcSetSharedGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_VERTEX, i, RTC_FORMAT_FLOAT3,
                                   mesh.steps[i].positions.data(), 0, sizeof(Vec3f), mesh.vertex_count());
    rtcSetGeometryMask(geometry.get(), ~0u);
    rtcCommitGeometry(geometry.get());
    rtcAttachGeometryByID(scene.get(), geometry.get(), 0);
    device.build(scene.get(), mesh.triangles.size(), filters);
}

MeshBvhs::MeshBvhs() : device_(std::make_shared<const EmbreeDevice>()) {}

MeshBvhs::~MeshBvhs() = default;

std::shared_ptr<const MeshBvh> MeshBvhs::bvh_of(const std::shared_ptr<const Mesh>& mesh, bool filters) {
    const std::lock_guard lock(mutex_);
    std::erase_if(bvhs_, [](const auto& entry) { return entry.second.mesh.expired(); });
    Entry& entry = bvhs_[{mesh.get(), filters}];
    if (!entry.bvh) entry = {mesh, std::make_shared<const MeshBvh>(*device_, *mesh, filters)};
    return entry.bvh;
}

}  // namespace pivot
