#include "core/scene/inner_rays.h"

#include "core/scene/embree.h"

namespace pivot {

InnerRays::InnerRays(std::shared_ptr<MeshBvhs> shared) : bvhs_(std::move(shared)) {}

InnerRays::~InnerRays() = default;

void InnerRays::set(std::span<const std::shared_ptr<const Mesh>> meshes,
                    std::span<const std::optional<Instance>> instances, const std::vector<bool>& has_inside) {
    insides_.clear();
    if (std::ranges::find(has_inside, true) == has_inside.end()) return;
    if (!bvhs_) bvhs_ = std::make_shared<MeshBvhs>();
    insides_.resize(instances.size());
    for (std::size_t i = 0; i < instances.size(); ++i) {
        if (!has_inside[i] || !instances[i]->world_from_object.is_invertible()) continue;
        if (meshes[instances[i]->mesh]->curves) continue;
        insides_[i] = {bvhs_->bvh_of(meshes[instances[i]->mesh], false), instances[i]->world_from_object.inverse(),
                       instances[i]->motion};
    }
    bvhs_->device()->check();
}

std::optional<RayHit> InnerRays::intersect(const Ray& ray, std::uint32_t instance) const {
    const Inside& inside = insides_[instance];
    // The direction keeps the length that the transform gives it: distances are the world's.
    const Transform object_from_world =
        inside.world_from_moving ? inside.world_from_moving->at(ray.time).inverse() : inside.object_from_world;
    const Ray ray_object{object_from_world.point(ray.origin), object_from_world.vector(ray.direction), ray.near_m,
                         ray.far_m, ray.time};
    RTCRayHit r{};
    r.ray = to_embree(ray_object, ~0u);
    r.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    r.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    trace(rtcIntersect1, inside.bvh->scene.get(), r);
    if (r.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    return RayHit{r.ray.tfar, instance, r.hit.primID, {r.hit.u, r.hit.v}, ray.time};
}

}  // namespace pivot
