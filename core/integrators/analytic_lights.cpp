#include "core/integrators/analytic_lights.h"

#include <tuple>

#include "core/integrators/cell_space.h"
#include "core/integrators/photons.h"
#include "core/sampling/sobol.h"
#include "core/sampling/warp.h"

namespace pivot {
namespace {

/// A triangle that gives this part of what all of them do is a light by itself: there are few.
constexpr double part_of_exact = 1.0 / 32.0;
constexpr double deposits_per_cell = 8.0;
constexpr std::uint32_t triangle_seed = 0x74726961u;

double power_of(const AreaLight& light) {
    return static_cast<double>(mean_component(abs(light.radiance)) * light.area_m2);
}

/// What a triangle sends out on a side, 1 or -1, of its normal, by so many places of it.
void deposit(const AreaLight& light, float side, std::uint32_t index, std::uint32_t owner, const CellSpace& cells,
             std::uint32_t count, std::vector<LightDeposit>& deposits) {
    const Rgb power_w = light.radiance * (pi<float> * light.area_m2 / static_cast<float>(count));
    const std::uint32_t seed = hash(triangle_seed, index);
    const Vec3f normal = side * light.normal;
    for (std::uint32_t k = 0; k < count; ++k) {
        const LightPlace place{place_on(light, Sampler{seed, k}.point(0)), normal};
        deposits.push_back(cells.deposit(hash(seed, k), owner, place, normal, power_w));
    }
}

}  // namespace

AnalyticLights gather_lights(const Scene& scene, const RenderSettings& settings) {
    AnalyticLights lights;
    const auto rules_of = [&](std::size_t place) {
        return scene.has_light_rules() ? scene.rules_of(place) : LightRules{};
    };
    const auto add_exact = [&](std::size_t place) {
        lights.exact.push_back({scene.light(place), rules_of(place), scene.light_group_of(place)});
    };
    for (std::size_t i = 0; i < scene.lamps().size(); ++i) add_exact(i);
    const std::span<const Light> triangles = scene.triangle_lights();
    double all = 0.0;
    for (const Light& light : triangles) all += power_of(std::get<AreaLight>(light));
    const double wanted = deposits_per_cell * static_cast<double>(settings.virtual_lights);
    std::vector<std::array<std::vector<LightDeposit>, 2>> deposits;  // of each of lights.emitted
    const auto deposits_of = [&](std::size_t place) -> std::array<std::vector<LightDeposit>, 2>& {
        const LightRules rules = rules_of(place);
        const std::uint32_t group = scene.light_group_of(place);
        const auto found = std::ranges::find_if(
            lights.emitted, [&](const EmittedLights& e) { return e.rules == rules && e.group == group; });
        const auto at = static_cast<std::size_t>(found - lights.emitted.begin());
        if (at == deposits.size()) {
            lights.emitted.push_back({.rules = rules, .group = group, .sides = {}});
            deposits.emplace_back();
        }
        return deposits[at];
    };
    std::size_t all_deposits = 0;
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
        const auto& light = std::get<AreaLight>(triangles[i]);
        const double part = all > 0.0 ? power_of(light) / all : 1.0;
        if (part >= part_of_exact) {
            add_exact(scene.lamps().size() + i);
            continue;
        }
        const std::uint32_t owner = scene.shining_triangle(i).instance;
        const CellSpace cells(scene.world_from_object(owner));
        const auto count = static_cast<std::uint32_t>(std::ceil(part * wanted));
        auto& [front, back] = deposits_of(scene.lamps().size() + i);
        deposit(light, 1.0f, i, owner, cells, count, front);
        deposit(light, -1.0f, i, owner, cells, count, back);
        all_deposits += count;
    }
    for (std::size_t of = 0; of < deposits.size(); ++of)
        for (std::size_t side = 0; side < 2; ++side)
            lights.emitted[of].sides[side] = build_virtual_lights(
                deposits[of][side], cells_of_share(settings.virtual_lights, deposits[of][side].size(), all_deposits));
    if (settings.indirect == Indirect::virtual_lights) lights.bounced = trace_virtual_lights(scene, settings);
    return lights;
}

bool gather_the_same(const RenderSettings& settings, const RenderSettings& others) {
    const auto read = [](const RenderSettings& s) {
        return std::tuple(s.virtual_lights, s.indirect, s.max_bounces, s.max_path_passages, s.light_groups);
    };
    return read(settings) == read(others);
}

}  // namespace pivot
