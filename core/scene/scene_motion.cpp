// What of a scene moves while the shutter is open.
#include "core/scene/scene.h"

namespace pivot {

bool Scene::is_moving(std::uint32_t instance) const {
    const auto& present = instances_[instance];
    return present && (present->motion || !meshes_[present->mesh]->steps.empty());
}

void Scene::commit_motion() {
    moves_ = camera_.motion != nullptr;
    for (std::uint32_t i = 0; i < instances_.size() && !moves_; ++i) moves_ = is_moving(i);
}

Light Scene::light_at(std::size_t place, float time) const {
    if (!is_moving_light(place)) return light(place);
    const auto [id, triangle] = scene_triangles_[place - lamps_.size()];
    const HitTriangleOf<float> at = triangle_at(*instances_[id], *meshes_[instances_[id]->mesh], triangle, time);
    const Transform& world = at.world_from_object;
    const auto moved =
        make_triangle_light({world.point(at.corner_a), world.point(at.corner_b), world.point(at.corner_c)},
                            std::get<AreaLight>(light(place)).radiance);
    return moved ? *moved : light(place);
}

}  // namespace pivot
