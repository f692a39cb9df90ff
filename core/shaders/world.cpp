#include "core/shaders/world.h"

#include <algorithm>
#include <numeric>

namespace pivot {
namespace {

Place at_direction(const PlaceLanes& lanes, const Vec3b& direction) {
    return {.lanes = lanes,
            .position = direction,
            .normal = -direction,
            .normal_geometric = -direction,
            .barycentric = {},
            .position_object = direction};
}

/// Neighbours: the directions next to each, or itself.
Vec3b run(const WorldView& world, const std::array<Vec3b, 3>& directions, const WordBatch& ray_kind,
          std::uint32_t bounce, Registers& registers) {
    const PlaceLanes lanes{.meshes = {},
                           .objects = {},
                           .triangles = {},
                           .corners = {},
                           .wo = -directions[0],
                           .front = Batch(1.0f),
                           .ray_length_m = std::numeric_limits<Batch>::max(),
                           .ray_kind = ray_kind,
                           .bounce = WordBatch(bounce),
                           .camera = &world.camera,
                           .footprint_m = Batch(0.0f)};
    const std::array places{at_direction(lanes, directions[0]), at_direction(lanes, directions[1]),
                            at_direction(lanes, directions[2])};
    world.shader.program.run(places, registers);
    return material_at(world.shader, registers).emission;
}

}  // namespace

Vec3b world_radiance(const WorldView& world, const Vec3b& directions, const WordBatch& ray_kind, std::uint32_t bounce,
                     Registers& registers) {
    if (world.shader.is_constant()) return broadcast(world.shader.constants.emission);
    return run(world, {directions, directions, directions}, ray_kind, bounce, registers);
}

Rgb world_radiance(const WorldView& world, const Vec3f& direction, std::uint32_t ray_kind, std::uint32_t bounce,
                   Registers& registers) {
    if (world.shader.is_constant()) return world.shader.constants.emission;
    const Vec3b radiance = world_radiance(world, broadcast(direction), WordBatch(ray_kind), bounce, registers);
    return {store(radiance.x)[0], store(radiance.y)[0], store(radiance.z)[0]};
}

WorldLight measure_world(const WorldView& world) {
    if (world.shader.is_constant()) return {world.shader.constants.emission, {}};
    constexpr std::uint32_t columns = Environment::columns, rows = Environment::rows;
    static_assert(columns % batch_size == 0);
    std::vector<float> brightness(rows * columns);
    Registers registers;
    Vec3b sum(Batch(0.0f));
    for (std::uint32_t y = 0; y < rows; ++y) {
        for (std::uint32_t x = 0; x < columns; x += batch_size) {
            const auto at = [&](float dx, float dy) {
                const Batch column = gather([&](std::size_t i) { return static_cast<float>(x + i) + 0.5f + dx; });
                return Environment::direction(
                    {column * Batch(1.0f / columns), Batch((static_cast<float>(y) + 0.5f + dy) / rows)});
            };
            const Vec3b radiance = run(world, {at(0, 0), at(1, 0), at(0, 1)}, WordBatch(diffuse_ray), 1, registers);
            sum += radiance;
            const Lanes values = store(mean_component(abs(radiance)));
            std::ranges::copy(values, &brightness[y * columns + x]);
        }
    }
    const auto mean = [](const Batch& b) {
        const Lanes lanes = store(b);
        return std::accumulate(lanes.begin(), lanes.end(), 0.0f) / static_cast<float>(columns * rows);
    };
    return {Rgb(mean(sum.x), mean(sum.y), mean(sum.z)), Environment(brightness)};
}

}  // namespace pivot
