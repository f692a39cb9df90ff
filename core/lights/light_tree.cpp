#include "core/lights/light_tree.h"

#include <algorithm>
#include <numeric>

namespace pivot {
namespace {

/// Where a light stands that is no sun.
Vec3f center_of(const Light& light) {
    const SphereLight* sphere = sphere_of(light);
    return sphere ? sphere->center : std::get<AreaLight>(light).center;
}

float radius_of(const Light& light) {
    if (const SphereLight* sphere = sphere_of(light)) return sphere->radius_m;
    const auto& area = std::get<AreaLight>(light);
    return length(area.half_u) + length(area.half_v);
}

/// Radiance times the area that faces a point: what it gives far away.
float intensity_of(const Light& light) {
    const SphereLight* sphere = sphere_of(light);
    if (sphere) return mean_component(abs(sphere->radiance)) * pi<float> * sqr(sphere->radius_m);
    const auto& area = std::get<AreaLight>(light);
    return mean_component(abs(area.radiance)) * area.area_m2;
}

void set_light(LightProxies& proxies, std::size_t child, const Light& light) {
    if (const auto* sun = std::get_if<SunLight>(&light)) {
        proxies.set_sphere(child, sun->cap.axis, 0.0f, mean_component(abs(sun->radiance)));
        proxies.sun_versine[child] = sun->cap.versine;
    } else if (const auto* area = std::get_if<AreaLight>(&light)) {
        proxies.set_flat(child, *area);
    } else {
        const SphereLight& sphere = *sphere_of(light);
        proxies.set_sphere(child, sphere.center, sphere.radius_m, mean_component(abs(sphere.radiance)));
        if (const auto* spot = std::get_if<SpotLight>(&light)) {
            proxies.normal_x[child] = spot->direction.x;
            proxies.normal_y[child] = spot->direction.y;
            proxies.normal_z[child] = spot->direction.z;
            proxies.cos_cone[child] = spot->cos_half_angle;
            proxies.least_lit[child] = 0.01f;  // a sphere of some size is lit in part where its centre is dark
        }
    }
}

/// Suns, or lights that are none.
void set_group(LightProxies& proxies, std::size_t child, std::span<const Light> lights,
               std::span<const std::uint32_t> indices) {
    Vec3f low(std::numeric_limits<float>::infinity()), high = -low;
    float intensity = 0.0f, irradiance = 0.0f;
    for (const std::uint32_t i : indices) {
        if (const auto* sun = std::get_if<SunLight>(&lights[i])) {
            irradiance += mean_component(abs(sun->radiance)) * sin2_half_angle(sun->cap);
            continue;
        }
        low = min(low, center_of(lights[i]) - radius_of(lights[i]));
        high = max(high, center_of(lights[i]) + radius_of(lights[i]));
        intensity += intensity_of(lights[i]);
    }
    if (irradiance > 0.0f) {  // from anywhere above
        proxies.set_sphere(child, Vec3f(0.0f, 0.0f, 1.0f), 0.0f, irradiance);
        proxies.sun_versine[child] = 2.0f;
        return;
    }
    const float radius = std::max(0.5f * length(high - low), 1e-6f);
    proxies.set_sphere(child, 0.5f * (low + high), radius, intensity / (pi<float> * sqr(radius)));
}

}  // namespace

void LightProxies::set_sphere(std::size_t child, const Vec3f& center, float radius, float mean_radiance) {
    center_x[child] = center.x, center_y[child] = center.y, center_z[child] = center.z;
    radius_m[child] = radius;
    radiance[child] = mean_radiance;
    least_lit[child] = 1.0f;
}

void LightProxies::set_flat(std::size_t child, const AreaLight& light) {
    set_sphere(child, light.center, sqrt(light.area_m2 / pi<float>), mean_component(abs(light.radiance)));
    normal_x[child] = light.normal.x, normal_y[child] = light.normal.y, normal_z[child] = light.normal.z;
    least_lit[child] = 0.0f;
    two_sided[child] = light.is_two_sided() ? 1.0f : 0.0f;
}

LightTree::LightTree(std::span<const Light> lights) : leaves_(lights.size()) {
    std::vector<std::uint32_t> indices(lights.size());
    std::iota(indices.begin(), indices.end(), 0u);
    if (!lights.empty()) build(lights, indices);
}

std::int32_t LightTree::build(std::span<const Light> lights, std::span<std::uint32_t> indices) {
    const auto index = static_cast<std::int32_t>(nodes_.size());
    nodes_.emplace_back();
    // Suns apart from the rest; then halved along the longest side until there are eight parts, or single lights.
    const auto is_sun = [&](std::uint32_t i) { return std::holds_alternative<SunLight>(lights[i]); };
    const auto suns = std::partition(indices.begin(), indices.end(), is_sun);
    const auto sun_count = static_cast<std::size_t>(suns - indices.begin());
    std::vector<std::span<std::uint32_t>> parts;
    for (const auto& part : {indices.first(sun_count), indices.subspan(sun_count)}) {
        if (!part.empty()) parts.push_back(part);
    }
    while (parts.size() < light_tree_width) {
        const auto largest = std::max_element(parts.begin(), parts.end(),
                                              [](const auto& x, const auto& y) { return x.size() < y.size(); });
        const std::span<std::uint32_t> part = *largest;
        if (part.size() < 2) break;
        *largest = part.first(part.size() / 2);
        parts.push_back(part.subspan(part.size() / 2));
        if (is_sun(part[0])) continue;  // which way to halve suns matters little
        Vec3f low(std::numeric_limits<float>::infinity()), high = -low;
        for (const std::uint32_t i : part) {
            low = min(low, center_of(lights[i]));
            high = max(high, center_of(lights[i]));
        }
        const Vec3f size = high - low;
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        const auto middle = part.begin() + static_cast<std::ptrdiff_t>(part.size() / 2);
        std::nth_element(part.begin(), middle, part.end(), [&](std::uint32_t x, std::uint32_t y) {
            return center_of(lights[x])[axis] < center_of(lights[y])[axis];
        });
    }
    Node node;
    node.count = parts.size();
    for (std::size_t i = 0; i < parts.size(); ++i) {
        if (parts[i].size() == 1) {
            set_light(node.proxies, i, lights[parts[i][0]]);
            node.child[i] = ~static_cast<std::int32_t>(parts[i][0]);
            leaves_[parts[i][0]] = {index, i};
        } else {
            set_group(node.proxies, i, lights, parts[i]);
            node.child[i] = build(lights, parts[i]);
            nodes_[static_cast<std::size_t>(node.child[i])].parent = index;
            nodes_[static_cast<std::size_t>(node.child[i])].place_in_parent = i;
        }
    }
    node.parent = nodes_[static_cast<std::size_t>(index)].parent;
    nodes_[static_cast<std::size_t>(index)] = node;
    return index;
}

}  // namespace pivot
