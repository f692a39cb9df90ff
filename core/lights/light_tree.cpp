#include "core/lights/light_tree.h"

#include <algorithm>
#include <numeric>

#include "core/distributions/spherical_gaussian.h"

namespace pivot {
namespace {

/// A light as its groups sum it up.
struct LightMoments {
    Vec3f mean;        ///< place, or direction of a sun
    float scatter_m2;  ///< mean squared distance of its parts from the mean
    float bound_m;     ///< no part is further from the mean
    float intensity;   ///< W/sr, the mean over all directions
    Vec3f direction;   ///< mean of the directions that it shines in, at most 1 long
};

LightMoments moments_of(const Light& light) {
    if (const auto* sun = std::get_if<SunLight>(&light)) {
        const float sin2 = sin2_half_angle(sun->cap);
        return {sun->cap.axis, 0.5f * sin2, std::sqrt(2.0f * sun->cap.versine),
                mean_component(abs(sun->radiance)) * pi<float> * sin2, Vec3f(0.0f)};
    }
    if (const SphereLight* sphere = sphere_of(light)) {
        const float radius2 = sqr(sphere->radius_m);
        const float intensity = mean_component(abs(sphere->radiance)) * pi<float> * radius2;
        const LightMoments all_around{sphere->center, 0.5f * radius2, sphere->radius_m, intensity, Vec3f(0.0f)};
        const auto* spot = std::get_if<SpotLight>(&light);
        if (!spot) return all_around;
        // As if it shone evenly up to where it has fallen off by half.
        const float cosine = spot->cos_half_angle + 0.5f * spot_falloff_width(*spot);
        LightMoments in_cone = all_around;
        in_cone.intensity *= 0.5f * (1.0f - cosine);
        in_cone.direction = spot->direction * (0.5f * (1.0f + cosine));
        return in_cone;
    }
    const auto& area = std::get<AreaLight>(light);
    const float u2 = length_squared(area.half_u), v2 = length_squared(area.half_v);
    const float flux = mean_component(abs(area.radiance)) * area.area_m2;
    const float bound_m = std::sqrt(u2) + std::sqrt(v2);
    switch (area.shape) {
        case AreaShape::parallelogram:
            return {area.center, (u2 + v2) / 3.0f, bound_m, 0.25f * flux, area.normal * (2.0f / 3.0f)};
        case AreaShape::ellipse:
            return {area.center, (u2 + v2) / 4.0f, bound_m, 0.25f * flux, area.normal * (2.0f / 3.0f)};
        case AreaShape::triangle:  // shines from both sides
            return {area.center + area.half_u / 3.0f, u2 * (2.0f / 9.0f) + v2 / 6.0f,
                    4.0f / 3.0f * std::sqrt(u2) + std::sqrt(v2), 0.5f * flux, Vec3f(0.0f)};
    }
    return {};
}

LightProxyOf<float> proxy_of(const Light& light) {
    const LightMoments moments = moments_of(light);
    LightProxyOf<float> proxy{.mean = moments.mean,
                              .is_placed = 1.0f,
                              .variance_m2 = 0.5f * moments.scatter_m2,
                              .bound_m = moments.bound_m,
                              .intensity = moments.intensity,
                              .axis = Vec3f(0.0f),
                              .sharpness = 0.0f,
                              .radius_m = 0.0f,
                              .cos_edge = -2.0f,  // falls off nowhere
                              .inverse_falloff_width = 1.0f,
                              .is_smooth = 0.0f,
                              .is_two_sided = 0.0f};
    if (const auto* sun = std::get_if<SunLight>(&light)) {
        proxy.is_placed = 0.0f;
        proxy.radius_m = std::sqrt(sin2_half_angle(sun->cap));
        return proxy;
    }
    if (const auto* area = std::get_if<AreaLight>(&light)) {
        proxy.intensity = mean_component(abs(area->radiance)) * area->area_m2;
        proxy.radius_m = std::sqrt(area->area_m2 / pi<float>);
        proxy.axis = area->normal;
        proxy.cos_edge = 0.0f;
        proxy.is_two_sided = area->is_two_sided() ? 1.0f : 0.0f;
        return proxy;
    }
    const SphereLight& sphere = *sphere_of(light);
    proxy.intensity = mean_component(abs(sphere.radiance)) * pi<float> * sqr(sphere.radius_m);
    proxy.radius_m = sphere.radius_m;
    if (const auto* spot = std::get_if<SpotLight>(&light)) {
        proxy.axis = spot->direction;
        proxy.cos_edge = spot->cos_half_angle;
        proxy.inverse_falloff_width = 1.0f / spot_falloff_width(*spot);
        proxy.is_smooth = 1.0f;
    }
    return proxy;
}

/// Lights together: suns, or lights that are none.
LightProxyOf<float> proxy_of(std::span<const LightMoments> moments, std::span<const std::uint32_t> indices,
                             bool are_suns) {
    Vec3<double> mean(0.0), direction(0.0);
    double intensity = 0.0;
    for (const std::uint32_t i : indices) {
        const double weight = std::max(moments[i].intensity, tiny<float>);
        mean += weight * Vec3<double>(moments[i].mean);
        direction += weight * Vec3<double>(moments[i].direction);
        intensity += weight;
    }
    mean /= intensity;
    direction /= intensity;
    double scatter_m2 = 0.0;
    float bound_m = 0.0f;
    for (const std::uint32_t i : indices) {
        const auto apart2 = static_cast<float>(length_squared(Vec3<double>(moments[i].mean) - mean));
        scatter_m2 += double(std::max(moments[i].intensity, tiny<float>)) * double(apart2 + moments[i].scatter_m2);
        bound_m = std::max(bound_m, std::sqrt(apart2) + moments[i].bound_m);
    }
    const Vec3f axis(direction);
    const float mean_length = length(axis), sharpness = sharpness_of_mean(mean_length);
    // The Gaussian's peak over its mean.
    const float peak = sharpness > 1e-3f ? 2.0f * sharpness / -std::expm1(-2.0f * sharpness) : 1.0f;
    return {.mean = Vec3f(mean),
            .is_placed = are_suns ? 0.0f : 1.0f,
            .variance_m2 = 0.5f * static_cast<float>(scatter_m2 / intensity),
            .bound_m = bound_m,
            .intensity = peak * static_cast<float>(intensity),
            .axis = mean_length > 1e-3f ? axis / mean_length : Vec3f(0.0f),
            .sharpness = mean_length > 1e-3f ? sharpness : 0.0f,
            .radius_m = 0.0f,
            .cos_edge = -2.0f,
            .inverse_falloff_width = 1.0f,
            .is_smooth = 0.0f,
            .is_two_sided = 0.0f};
}

}  // namespace

LightProxyOf<float> LightProxies::operator[](std::size_t child) const {
    std::array<float, numbers> of_child;
    for (std::size_t i = 0; i < numbers; ++i) of_child[i] = values_[i][child];
    return std::bit_cast<LightProxyOf<float>>(of_child);
}

void LightProxies::set(std::size_t child, const LightProxyOf<float>& proxy) {
    const auto of_child = std::bit_cast<std::array<float, numbers>>(proxy);
    for (std::size_t i = 0; i < numbers; ++i) values_[i][child] = of_child[i];
}

namespace {

/// How far light scatters about its mean place, summed up.
struct Scatter {
    double weight = 0.0, square = 0.0;
    Vec3<double> place{0.0};

    void add(const LightMoments& light) {
        const double w = std::max(light.intensity, tiny<float>);
        const Vec3<double> mean(light.mean);
        weight += w;
        place += w * mean;
        square += w * (length_squared(mean) + static_cast<double>(light.scatter_m2));
    }
    void add(const Scatter& other) {
        weight += other.weight;
        place += other.place;
        square += other.square;
    }
    float total() const {
        return weight > 0.0 ? static_cast<float>(std::max(square - length_squared(place) / weight, 0.0)) : 0.0f;
    }
};

/// Lights below one child of a node, and what that child, if it is a node, has as children.
struct Group {
    std::span<std::uint32_t> lights;
    std::vector<Group> children;  ///< none: a light by itself
};

}  // namespace

/// Builds a tree from the root on.
class LightTree::Builder {
   public:
    Builder(LightTree& tree, std::span<const Light> lights) : tree_(tree), lights_(lights) {
        moments_.reserve(lights.size());
        for (const Light& light : lights) moments_.push_back(moments_of(light));
    }

    void build(std::span<std::uint32_t> indices) {
        const auto suns = std::partition(indices.begin(), indices.end(), [&](std::uint32_t i) { return is_sun(i); });
        add_node(halves_joined(indices, static_cast<std::size_t>(suns - indices.begin())));
    }

   private:
    bool is_sun(std::uint32_t i) const { return std::holds_alternative<SunLight>(lights_[i]); }

    /// What the node above these lights has as children. Lights are cut in two down to single ones; on the way back
    /// the halves are joined as long as one node holds both. So most nodes are nearly full: of one that is, eight
    /// children are weighed at once for the price of one.
    std::vector<Group> grouped(std::span<std::uint32_t> lights) const {
        if (lights.size() == 1) return {Group{lights, {}}};
        return halves_joined(lights, cut(lights));
    }

    /// Of the first lights and of those after them.
    std::vector<Group> halves_joined(std::span<std::uint32_t> lights, std::size_t count) const {
        if (count == 0 || count == lights.size()) return grouped(lights);
        std::vector<Group> first = grouped(lights.first(count)), second = grouped(lights.subspan(count));
        if (first.size() + second.size() > light_tree_width) {
            const auto make_node = [](std::vector<Group>& groups, std::span<std::uint32_t> of) {
                if (groups.size() > light_tree_width / 2) groups = {Group{of, std::move(groups)}};
            };
            make_node(first, lights.first(count)), make_node(second, lights.subspan(count));
        }
        std::ranges::move(second, std::back_inserter(first));
        return first;
    }

    std::int32_t add_node(const std::vector<Group>& groups) {
        const auto index = static_cast<std::int32_t>(tree_.nodes_.size());
        tree_.nodes_.emplace_back();
        Node node;
        node.count = groups.size();
        for (std::size_t i = 0; i < groups.size(); ++i) {
            const std::span<const std::uint32_t> lights = groups[i].lights;
            if (lights.size() == 1) {
                node.proxies.set(i, proxy_of(lights_[lights[0]]));
                node.child[i] = ~static_cast<std::int32_t>(lights[0]);
                tree_.leaves_[lights[0]] = {index, i};
            } else {
                node.proxies.set(i, proxy_of(moments_, lights, is_sun(lights[0])));
                node.child[i] = add_node(groups[i].children);
                tree_.nodes_[static_cast<std::size_t>(node.child[i])].parent = index;
                tree_.nodes_[static_cast<std::size_t>(node.child[i])].place_in_parent = i;
            }
        }
        node.parent = tree_.nodes_[static_cast<std::size_t>(index)].parent;
        tree_.nodes_[static_cast<std::size_t>(index)] = node;
        return index;
    }

    /// Sorts lights into two parts, along the longest side, where light scatters least within both; how many are in
    /// the first.
    std::size_t cut(std::span<std::uint32_t> lights) const {
        Vec3f low(std::numeric_limits<float>::infinity()), high = -low;
        for (const std::uint32_t i : lights) {
            low = min(low, moments_[i].mean);
            high = max(high, moments_[i].mean);
        }
        const Vec3f size = high - low;
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        constexpr std::size_t bins = 16;
        const auto bin_of = [&](std::uint32_t i) {
            const float part = (moments_[i].mean[axis] - low[axis]) / std::max(size[axis], tiny<float>);
            return std::min(static_cast<std::size_t>(part * bins), bins - 1);
        };
        std::array<Scatter, bins> in_bin;
        for (const std::uint32_t i : lights) in_bin[bin_of(i)].add(moments_[i]);
        std::array<float, bins> after{};  // of the bins from one on
        Scatter sum;
        for (std::size_t bin = bins - 1; bin > 0; --bin) {
            sum.add(in_bin[bin]);
            after[bin] = sum.total();
        }
        sum = {};
        float least = std::numeric_limits<float>::infinity();
        std::size_t best = 1;
        for (std::size_t bin = 1; bin < bins; ++bin) {
            sum.add(in_bin[bin - 1]);
            if (const float total = sum.total() + after[bin]; total < least) least = total, best = bin;
        }
        const auto second =
            std::partition(lights.begin(), lights.end(), [&](std::uint32_t i) { return bin_of(i) < best; });
        const auto count = static_cast<std::size_t>(second - lights.begin());
        return count > 0 && count < lights.size() ? count : lights.size() / 2;
    }

    LightTree& tree_;
    std::span<const Light> lights_;
    std::vector<LightMoments> moments_;
};

LightTree::LightTree(std::span<const Light> lights) : leaves_(lights.size()) {
    std::vector<std::uint32_t> indices(lights.size());
    std::iota(indices.begin(), indices.end(), 0u);
    if (!lights.empty()) Builder(*this, lights).build(indices);
}

}  // namespace pivot
