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

#include "core/scene/mesh_bvhs.h"

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
};

/// A mesh in its own space.
struct MeshBvh {
    Owned<RTCScene> scene;

    /// The mesh is read in place.
    MeshBvh(const EmbreeDevice& device, const Mesh& mesh, bool filters);
};

}  // namespace pivot
