#include "core/integrators/shared_reflections.h"

namespace pivot {
namespace {

/// How far apart the samples of a pixel may be, by its filter.
constexpr float pixels_of_samples = 4.0f;
/// How far a surface's plane may be from another's that stands for it, of the distance between them.
constexpr float slope_apart = 0.2f;
/// And how far its normal; that of a sharp lobe, and where it is seen from, by a part of its width.
constexpr float versine_apart = 0.002f, versine_of_lobe = 0.05f;
constexpr float alpha_apart = 0.05f;

Vec3f bumped_normal(const ShadingPoint& at) { return at.point.frame.to_world(at.surface.bump.normal); }

Vec3f wo_of(const ShadingPoint& at) { return at.point.frame.to_world(at.surface.wo_local); }

float alpha_of(const ShadingPoint& at) { return at.surface.has_glossy() ? at.surface.alpha : 0.0f; }

float reach_m(const Scene& scene, const ShadingPoint& at) {
    const Camera& camera = scene.camera();
    const float distance_m = length(at.point.position - camera.world_from_camera.translation);
    return pixels_of_samples * camera.pixel_width().at(distance_m) / std::max(std::abs(at.surface.wo_local.z), 0.05f);
}

}  // namespace

bool SharedReflections::is_like(const Known& known, const ShadingPoint& at, float reach_m) {
    const float alpha = alpha_of(at);
    if ((known.alpha > 0.0f) != (alpha > 0.0f) || known.has_diffuse != at.surface.has_diffuse()) return false;
    if (std::abs(known.alpha - alpha) > alpha_apart * alpha) return false;
    const Vec3f apart = at.point.position - known.position;
    const float distance_m = length(apart);
    if (distance_m > reach_m || std::abs(dot(apart, at.point.normal_geometric)) > slope_apart * distance_m)
        return false;
    const float of_lobe = alpha > 0.0f ? versine_of_lobe * sqr(alpha) : 2.0f, most = std::min(versine_apart, of_lobe);
    const auto are_near = [](const Vec3f& a, const Vec3f& b, float versine) {
        return 0.5f * length_squared(a - b) < versine;
    };
    return are_near(at.point.frame.z, known.normal, most) && are_near(bumped_normal(at), known.normal_bumped, most) &&
           are_near(wo_of(at), known.wo, of_lobe);
}

const VirtualReflection* SharedReflections::find(std::size_t pixel, const ShadingPoint& at, float reach_m) const {
    for (std::uint32_t i = newest_[pixel]; i != none; i = known_[i].next)
        if (is_like(known_[i], at, reach_m)) return &known_[i].reflection;
    return nullptr;
}

void SharedReflections::add(std::size_t pixel, const ShadingPoint& at, const VirtualReflection& reflection) {
    known_.push_back({at.point.position, at.point.frame.z, bumped_normal(at), wo_of(at), alpha_of(at),
                      at.surface.has_diffuse(), reflection, newest_[pixel]});
    newest_[pixel] = static_cast<std::uint32_t>(known_.size() - 1);
}

std::vector<VirtualReflection> SharedReflections::reflect(const Scene& scene, const RenderSettings& settings,
                                                          const VirtualLights& lights,
                                                          std::span<const ShadingPoint> shading,
                                                          std::span<const std::uint32_t> pixels, std::uint32_t turn) {
    std::vector<VirtualReflection> result(shading.size());
    std::vector<std::size_t> unknown;
    for (std::size_t i = 0; i < shading.size(); ++i) {
        if (!shading[i].surface.has_diffuse() && !shading[i].surface.has_glossy()) continue;
        if (const VirtualReflection* known = find(pixels[i], shading[i], reach_m(scene, shading[i])))
            result[i] = *known;
        else
            unknown.push_back(i);
    }
    for (std::size_t first = 0; first < unknown.size(); first += batch_size) {
        const auto together = std::span(unknown).subspan(first, std::min(batch_size, unknown.size() - first));
        std::vector<ShadingPoint> points;
        for (const std::size_t i : together) points.push_back(shading[i]);
        const auto reflected =
            reflect_virtual_lights(scene, settings, lights.diffuse, lights.glossy, make_batch(points), turn);
        for (std::size_t k = 0; k < together.size(); ++k) {
            result[together[k]] = reflected[k];
            add(pixels[together[k]], points[k], reflected[k]);
        }
    }
    return result;
}

}  // namespace pivot
