#include "core/scene/media.h"

#include <algorithm>
#include <ranges>

namespace pivot {
namespace {

/// The corners of a mesh that is a box along the axes of its space, seen from outside; nothing of others.
std::optional<std::array<Vec3f, 2>> box_of(const Mesh& mesh) {
    if (mesh.vertex_count() != 8 || mesh.triangles.size() != 12) return std::nullopt;
    std::array<Vec3f, 2> box{mesh.positions[0], mesh.positions[0]};
    for (std::size_t i = 0; i < 8; ++i) {
        box[0] = glm::min(box[0], mesh.positions[i]);
        box[1] = glm::max(box[1], mesh.positions[i]);
    }
    const Vec3f center = 0.5f * (box[0] + box[1]);
    std::uint32_t corners = 0;
    for (std::size_t i = 0; i < 8; ++i) {
        std::uint32_t corner = 0;
        for (int axis = 0; axis < 3; ++axis) {
            const float at = mesh.positions[i][axis];
            if (at != box[0][axis] && at != box[1][axis]) return std::nullopt;
            if (at == box[1][axis]) corner |= 1u << axis;
        }
        corners |= 1u << corner;
    }
    for (const Triangle& t : mesh.triangles) {
        const Vec3f a = mesh.positions[t.x], across = cross(mesh.positions[t.y] - a, mesh.positions[t.z] - a);
        if (!(dot(across, a - center) > 0.0f)) return std::nullopt;
    }
    return corners == 0xff ? std::optional(box) : std::nullopt;
}

/// The box around a mesh where it stands.
PlacedMedium place(const std::shared_ptr<const Medium>& medium, const Mesh& mesh, const Transform& world_from_object) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    PlacedMedium placed{medium,      {}, Vec3f(infinity), Vec3f(-infinity), medium->sigma_s(), medium->sigma_t(),
                        std::nullopt};
    if (world_from_object.is_invertible()) {
        placed.object_from_world = world_from_object.inverse();
        placed.box = box_of(mesh);
    }
    for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
        const Vec3f p = world_from_object.point(mesh.positions[i]);
        placed.low = glm::min(placed.low, p);
        placed.high = glm::max(placed.high, p);
    }
    return placed;
}

}  // namespace

Media::Media(const std::shared_ptr<const Medium>& world, std::span<const std::shared_ptr<const Mesh>> meshes,
             std::span<const std::optional<Instance>> instances, std::span<const Shader> shaders) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    if (world) {
        placed_.push_back(
            {world, {}, Vec3f(-infinity), Vec3f(infinity), world->sigma_s(), world->sigma_t(), std::nullopt});
        has_world_ = true;
    }
    for (const std::optional<Instance>& instance : instances) {
        const auto has_medium = [&](std::uint32_t material) { return shaders[material].medium != nullptr; };
        if (!instance || std::ranges::none_of(instance->materials, has_medium)) continue;
        const Mesh& mesh = *meshes[instance->mesh];
        if (mesh.curves) continue;  // they surround nothing
        Boundary& boundary = boundaries_.emplace_back(Boundary{&mesh, &*instance, {}});
        for (const std::uint32_t material : instance->materials) {
            const std::shared_ptr<const Medium>& medium = shaders[material].medium;
            boundary.medium_of_slot.push_back(medium ? static_cast<std::uint32_t>(placed_.size()) : no_medium);
            if (medium) placed_.push_back(place(medium, mesh, instance->world_from_object));
        }
    }
    are_even_boxes_ = std::ranges::all_of(placed_, [&](const PlacedMedium& placed) {
        return !placed.varies() && (placed.box || (has_world_ && &placed == placed_.data()));
    });
    for (const Boundary& boundary : boundaries_)
        are_even_boxes_ = are_even_boxes_ && boundary.medium_of_slot.size() == 1;
    std::size_t triangles = 0;
    for (const Boundary& boundary : boundaries_) triangles += boundary.mesh->triangles.size();
    if (triangles > FewTriangles::most) tracer_ = std::make_unique<RayTracer>(nullptr, true);
    for (std::uint32_t id = 0; id < boundaries_.size(); ++id) {
        const auto& [mesh, instance, media] = boundaries_[id];
        if (tracer_) {
            tracer_->set_mesh(instance->mesh, meshes[instance->mesh]);
            tracer_->set_instance(id, instance->mesh, instance->world_from_object, visible_to_all);
            continue;
        }
        const Transform& to_world = instance->world_from_object;
        const auto corner = [&](std::uint32_t at) { return to_world.point(mesh->positions[at]); };
        const bool is_mirrored = dot(instance->normal_matrix[0], cross(to_world.linear[1], to_world.linear[2])) < 0.0f;
        for (std::uint32_t i = 0; i < mesh->triangles.size(); ++i) {
            const Triangle& t = mesh->triangles[i];
            const Vec3f b = corner(t.y), c = corner(t.z);
            if (const std::uint32_t medium = medium_of(boundaries_[id], i); medium != no_medium)
                few_triangles_.add(corner(t.x), is_mirrored ? c : b, is_mirrored ? b : c, medium);
        }
    }
    if (tracer_) tracer_->commit();
}

std::uint32_t Media::medium_of(const Boundary& boundary, std::uint32_t triangle) const {
    const Mesh& mesh = *boundary.mesh;
    const std::size_t slot = mesh.triangle_slots.empty() ? 0 : mesh.triangle_slots[triangle];
    return boundary.medium_of_slot[std::min(slot, boundary.medium_of_slot.size() - 1)];
}

void Media::find_passages(const Ray& ray, MediaAlong& along) const {
    along.passages.clear();
    if (!tracer_) {
        few_triangles_.for_each_crossing(ray, [&](float distance_m, std::uint32_t medium, bool enters) {
            along.passages.push_back({distance_m, medium, enters});
        });
        return;
    }
    along.crossings.clear();
    tracer_->crossings({.origin = ray.origin, .direction = ray.direction}, along.crossings);
    for (const Crossing& crossing : along.crossings) {
        const Boundary& boundary = boundaries_[crossing.instance];
        const std::uint32_t medium = medium_of(boundary, crossing.triangle);
        if (medium == no_medium) continue;
        const Mesh& mesh = *boundary.mesh;
        const Triangle& t = mesh.triangles[crossing.triangle];
        const Vec3f a = mesh.positions[t.x], across = cross(mesh.positions[t.y] - a, mesh.positions[t.z] - a);
        const bool enters = dot(boundary.instance->normal_matrix * across, ray.direction) < 0.0f;
        along.passages.push_back({crossing.distance_m, medium, enters});
    }
}

void Media::leave_boxes(const Ray& ray, MediaAlong& along) const {
    along.is_inside.resize(placed_.size());
    for (const MediaAlong::Passage& passage : along.passages) along.is_inside[passage.medium] = passage.enters;
    const std::size_t count = along.passages.size();
    for (std::size_t k = 0; k < count; ++k) {
        const std::uint32_t medium = along.passages[k].medium;
        if (!along.is_inside[medium]) continue;
        float leaves_m = std::numeric_limits<float>::infinity(), entered_m = 0.0f;
        for (std::size_t i = k; i < count; ++i)
            if (along.passages[i].medium == medium) entered_m = along.passages[i].distance_m;
        for (int axis = 0; axis < 3; ++axis) {
            const float d = ray.direction[axis];
            const float side = d > 0.0f ? placed_[medium].high[axis] : placed_[medium].low[axis];
            if (d != 0.0f) leaves_m = std::min(leaves_m, (side - ray.origin[axis]) / d);
        }
        along.passages.push_back({std::max(leaves_m, entered_m), medium, false});
        along.is_inside[medium] = false;
    }
    if (along.passages.size() > count) std::ranges::stable_sort(along.passages, {}, &MediaAlong::Passage::distance_m);
}

void Media::find_along(const Ray& ray, MediaAlong& along) const {
    along.intervals.clear();
    along.active.clear();
    if (boundaries_.empty()) {
        if (!has_world_) return;
        along.active.push_back(0);
        along.intervals.push_back({0.0f, ray.far_m, 0, 1});
        return;
    }
    // What a ray is within when it starts, what it meets later tells: it must be followed to its end.
    find_passages(ray, along);
    std::ranges::stable_sort(along.passages, {}, &MediaAlong::Passage::distance_m);
    leave_boxes(ray, along);
    // In reverse, so that the first passage decides. An edge is crossed once or twice: passages set what is, and do not
    // count.
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
