#include "core/scene/media.h"

#include <algorithm>
#include <ranges>

namespace pivot {
namespace {

/// The box around a mesh where it stands.
PlacedMedium place(std::shared_ptr<const Medium> medium, const Mesh& mesh, const Transform& world_from_object) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    PlacedMedium placed{std::move(medium), {}, Vec3f(infinity), Vec3f(-infinity)};
    if (world_from_object.is_invertible()) placed.object_from_world = world_from_object.inverse();
    for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
        const Vec3f p = world_from_object.point(mesh.positions[i]);
        placed.low = glm::min(placed.low, p);
        placed.high = glm::max(placed.high, p);
    }
    return placed;
}

}  // namespace

Media::Media(std::shared_ptr<const Medium> world, std::span<const std::unique_ptr<const Mesh>> meshes,
             std::span<const std::optional<Instance>> instances, std::span<const Shader> shaders) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    if (world) {
        placed_.push_back({std::move(world), {}, Vec3f(-infinity), Vec3f(infinity)});
        has_world_ = true;
    }
    for (const std::optional<Instance>& instance : instances) {
        if (!instance) continue;
        const Mesh& mesh = *meshes[instance->mesh];
        Boundary boundary{&mesh, &*instance, {}};
        bool has_any = false;
        for (const std::uint32_t material : instance->materials) {
            const std::shared_ptr<const Medium>& medium = shaders[material].medium;
            boundary.medium_of_slot.push_back(medium ? static_cast<std::uint32_t>(placed_.size()) : no_medium);
            if (!medium) continue;
            placed_.push_back(place(medium, mesh, instance->world_from_object));
            has_any = true;
        }
        if (!has_any) continue;
        if (!tracer_) tracer_ = std::make_unique<RayTracer>(true);
        const auto id = static_cast<std::uint32_t>(boundaries_.size());
        tracer_->set_mesh(instance->mesh, mesh);
        tracer_->set_instance(id, instance->mesh, instance->world_from_object, visible_to_all);
        boundaries_.push_back(std::move(boundary));
    }
    if (tracer_) tracer_->commit();
}

MediaAlong::Passage Media::passage(const Ray& ray, const Crossing& crossing) const {
    const Boundary& boundary = boundaries_[crossing.instance];
    const Mesh& mesh = *boundary.mesh;
    const std::size_t slot = mesh.triangle_slots.empty() ? 0 : mesh.triangle_slots[crossing.triangle];
    const std::uint32_t medium = boundary.medium_of_slot[std::min(slot, boundary.medium_of_slot.size() - 1)];
    const Triangle& t = mesh.triangles[crossing.triangle];
    const Vec3f a = mesh.positions[t.x];
    const Vec3f normal = boundary.instance->normal_matrix * cross(mesh.positions[t.y] - a, mesh.positions[t.z] - a);
    return {crossing.distance_m, medium, dot(normal, ray.direction) < 0.0f};
}

void Media::find_along(const Ray& ray, MediaAlong& along) const {
    along.intervals.clear();
    along.active.clear();
    if (!tracer_) {
        along.active.push_back(0);
        along.intervals.push_back({0.0f, ray.far_m, 0, 1});
        return;
    }
    // What a ray is within when it starts, what it meets later tells: it must be followed to its end.
    along.crossings.clear();
    tracer_->crossings({.origin = ray.origin, .direction = ray.direction}, along.crossings);
    along.passages.clear();
    for (const Crossing& crossing : along.crossings)
        if (const MediaAlong::Passage found = passage(ray, crossing); found.medium != no_medium)
            along.passages.push_back(found);
    std::ranges::sort(along.passages, {}, &MediaAlong::Passage::distance_m);
    // In reverse, so that the first passage decides. An edge is crossed once or twice: passages set what is, and do not
    // count.
    along.is_inside.resize(placed_.size());
    for (const MediaAlong::Passage& passage : std::views::reverse(along.passages))
        along.is_inside[passage.medium] = !passage.enters;

    const auto add_interval = [&](float near_m, float far_m) {
        const auto first = static_cast<std::uint32_t>(along.active.size());
        if (has_world_) along.active.push_back(0);
        for (const MediaAlong::Passage& passage : along.passages) {
            const auto added = std::span(along.active).subspan(first);
            if (along.is_inside[passage.medium] && std::ranges::find(added, passage.medium) == added.end())
                along.active.push_back(passage.medium);
        }
        const auto count = static_cast<std::uint32_t>(along.active.size()) - first;
        if (count > 0) along.intervals.push_back({near_m, far_m, first, count});
    };
    float start_m = 0.0f;
    for (const MediaAlong::Passage& passage : along.passages) {
        const float end_m = std::min(passage.distance_m, ray.far_m);
        if (end_m > start_m) {
            add_interval(start_m, end_m);
            start_m = end_m;
        }
        along.is_inside[passage.medium] = passage.enters;
    }
    if (ray.far_m > start_m) add_interval(start_m, ray.far_m);
}

}  // namespace pivot
