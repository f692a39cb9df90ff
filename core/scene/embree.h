// Embree's handles, owned, and how its geometry and BVHs are made. Seen by the files of BVHs and by ray_tracer.cpp
// alone.
#pragma once

#if __has_include(<embree3/rtcore.h>)
#include <embree3/rtcore.h>
#else
#include <embree4/rtcore.h>
#endif

#include <memory>
#include <type_traits>
#include <vector>

#include "core/scene/ray_tracer.h"

namespace pivot {

struct ReleaseEmbree {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
    void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
};

template <class Handle>
using Owned = std::unique_ptr<std::remove_pointer_t<Handle>, ReleaseEmbree>;

struct EmbreeDevice {
    Owned<RTCDevice> handle;

    /// Throws std::runtime_error where Embree does not start.
    EmbreeDevice();
    /// Throws std::bad_alloc, or std::runtime_error with Embree's message, if something failed since the last call.
    void check() const;
    Owned<RTCScene> make_scene() const { return Owned<RTCScene>(rtcNewScene(handle.get())); }
    /// filters: whether rays stop at what a callback says.
    void build(RTCScene scene, std::size_t triangle_count, bool filters) const;
    /// positions: of the mesh's vertices. They and the mesh are read in place.
    Owned<RTCGeometry> make_triangles(const Mesh& mesh, const std::vector<Vec3f>& positions) const;
    /// They are read in place.
    Owned<RTCGeometry> make_curves(const Curves& curves) const;
};

/// A mesh in its own space.
struct MeshBvh {
    Owned<RTCScene> scene;

    /// The mesh is read in place.
    MeshBvh(const EmbreeDevice& device, const Mesh& mesh, bool filters);
};

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

inline RTCRay to_embree(const Ray& ray, std::uint32_t mask) {
    RTCRay r{};
    r.org_x = ray.origin.x, r.org_y = ray.origin.y, r.org_z = ray.origin.z;
    r.dir_x = ray.direction.x, r.dir_y = ray.direction.y, r.dir_z = ray.direction.z;
    r.tnear = ray.near_m;
    r.tfar = ray.far_m;
    r.time = ray.time;
    r.mask = mask;
    return r;
}

}  // namespace pivot
