// The BVHs of meshes, for ray tracers that come one after the other: a mesh's is built once.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <utility>

#include "core/geometry/mesh.h"

namespace pivot {

struct EmbreeDevice;
struct MeshBvh;

class MeshBvhs {
   public:
    MeshBvhs();
    ~MeshBvhs();
    MeshBvhs(const MeshBvhs&) = delete;
    MeshBvhs& operator=(const MeshBvhs&) = delete;

    const std::shared_ptr<const EmbreeDevice>& device() const { return device_; }
    /// Kept for as long as anybody has the mesh. filters: whether rays stop at what a callback says.
    std::shared_ptr<const MeshBvh> bvh_of(const std::shared_ptr<const Mesh>& mesh, bool filters);

   private:
    std::shared_ptr<const EmbreeDevice> device_;
    std::mutex mutex_;
    struct Entry {
        std::weak_ptr<const Mesh> mesh;
        std::shared_ptr<const MeshBvh> bvh;
    };
    std::map<std::pair<const Mesh*, bool>, Entry> bvhs_;
};

}  // namespace pivot
