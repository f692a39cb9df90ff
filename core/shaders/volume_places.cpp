#include "core/shaders/volume_places.h"

#include <tbb/parallel_for.h>

namespace pivot {
namespace {

Mat3<Batch> in_each_lane(const Mat3<float>& m) { return {broadcast(m[0]), broadcast(m[1]), broadcast(m[2])}; }

/// A mesh whose triangles are points.
Mesh mesh_of(VolumePoints& points) {
    Mesh mesh;
    mesh.attributes = std::move(points.attributes);
    mesh.triangles.resize(points.positions_object.size());
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) mesh.triangles[i] = Triangle(static_cast<std::uint32_t>(i));
    return mesh;
}

}  // namespace

std::vector<float> run_in_volume(const Program& program, VolumePoints points,
                                 std::span<const std::uint32_t> registers) {
    program.make_image_levels();
    const Mesh mesh = mesh_of(points);
    const CameraFacts no_camera;
    PlaceLanes of_all{};
    of_all.meshes.fill(&mesh);
    of_all.objects.fill(&points.object);
    of_all.corners.world_from_object = {in_each_lane(points.world_from_object.linear),
                                        broadcast(points.world_from_object.translation)};
    of_all.corners.normal_matrix = in_each_lane(points.world_from_object.normal_matrix());
    of_all.front = Batch(1.0f);
    of_all.camera = &no_camera;

    const std::size_t count = points.positions_object.size();
    std::vector<float> result(count * registers.size());
    const auto run = [&](const tbb::blocked_range<std::size_t>& range) {
        Registers memory;
        PlaceLanes lanes = of_all;
        for (std::size_t first = range.begin(); first < range.end(); first += batch_size) {
            const std::size_t filled = std::min(batch_size, range.end() - first);
            for (std::size_t lane = 0; lane < batch_size; ++lane)
                lanes.triangles[lane] = static_cast<std::uint32_t>(first + std::min(lane, filled - 1));
            const Vec3b position_object =
                gather_vector([&](std::size_t lane) { return points.positions_object[lanes.triangles[lane]]; });
            const Place place{.lanes = lanes,
                              .position = lanes.corners.world_from_object.point(position_object),
                              .normal = Vec3b(Batch(0.0f)),
                              .normal_geometric = Vec3b(Batch(0.0f)),
                              .barycentric = Vec2b(Batch(0.0f)),
                              .position_object = position_object};
            program.run({&place, 1}, memory);
            for (std::size_t i = 0; i < registers.size(); ++i) {
                const Lanes values = store(memory[registers[i]]);
                for (std::size_t lane = 0; lane < filled; ++lane)
                    result[(first + lane) * registers.size() + i] = values[lane];
            }
        }
    };
    constexpr std::size_t points_of_task = 64 * batch_size;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, points_of_task), run);
    return result;
}

}  // namespace pivot
