// pivot_core.VoxelGrid and Medium.
#include <pybind11/stl.h>

#include "bindings/arrays.h"
#include "bindings/names.h"
#include "bindings/register.h"
#include "core/media/medium.h"
#include "core/media/tracking.h"

namespace pivot::bindings {
namespace {

using std::string;
using Grid = std::shared_ptr<VoxelGrid>;
using LobeTuple = std::tuple<Triple, float, string>;

Grid make_grid(const FloatArray& values, const FloatArray& grid_from_object) {
    if (values.ndim() != 3) require_shape(values, "values", {-1, -1, -1, 3});
    require_shape(grid_from_object, "grid_from_object", {4, 4});
    const std::array size{static_cast<int>(values.shape(2)), static_cast<int>(values.shape(1)),
                          static_cast<int>(values.shape(0))};
    const std::span numbers(values.data(), static_cast<std::size_t>(values.size()));
    const Transform transform = to_transform(grid_from_object.data());
    const py::gil_scoped_release release;
    return std::make_shared<VoxelGrid>(size, values.ndim() == 4 ? 3 : 1, numbers, transform);
}

/// evaluate(point) of each row.
template <class Evaluate>
py::array_t<float> at_points(const FloatArray& points, const Evaluate& evaluate) {
    require_shape(points, "points", {-1, 3});
    const auto rows = points.unchecked<2>();
    py::array_t<float> result({points.shape(0), py::ssize_t{3}});
    const auto batch = static_cast<py::ssize_t>(batch_size);
    for (py::ssize_t first = 0; first < points.shape(0); first += batch) {
        const auto row = [&](std::size_t lane) {
            return std::min(first + static_cast<py::ssize_t>(lane), points.shape(0) - 1);
        };
        const Vec3b values = evaluate(gather_vector([&](std::size_t lane) {
            const py::ssize_t i = row(lane);
            return Vec3f(rows(i, 0), rows(i, 1), rows(i, 2));
        }));
        const std::array lanes{store(values.x), store(values.y), store(values.z)};
        for (std::size_t lane = 0; lane < batch_size; ++lane)
            for (std::size_t axis = 0; axis < 3; ++axis) result.mutable_at(row(lane), axis) = lanes[axis][lane];
    }
    return result;
}

/// evaluate(point) of each lane.
template <class Evaluate>
Vec3b each_lane(const Vec3b& points, const Evaluate& evaluate) {
    const std::array lanes{store(points.x), store(points.y), store(points.z)};
    return gather_vector([&](std::size_t i) { return evaluate(Vec3f(lanes[0][i], lanes[1][i], lanes[2][i])); });
}

GridRay to_ray(const Triple& origin, const Triple& direction, float near_m, float far_m) {
    return {to_vec3(origin), to_vec3(direction), near_m, far_m};
}

/// (near_m, far_m, majorant) of each brick.
std::vector<Triple> cells(const VoxelGrid& grid, const Triple& origin, const Triple& direction, float near_m,
                          float far_m) {
    std::vector<Triple> result;
    grid.for_each_cell(to_vec3(origin), to_vec3(direction), near_m, far_m, [&](float from_m, float to_m, float most) {
        result.push_back({from_m, to_m, most});
        return true;
    });
    return result;
}

RandomStream stream_of(std::uint32_t seed, py::ssize_t index) {
    return {hash(seed, static_cast<std::uint32_t>(index))};
}

py::array_t<float> transmittances(const VoxelGrid& grid, const Triple& origin, const Triple& direction, float near_m,
                                  float far_m, const Triple& sigma_t, std::uint32_t seed, py::ssize_t count) {
    const GridRay ray = to_ray(origin, direction, near_m, far_m);
    py::array_t<float> result({count, py::ssize_t{3}});
    for (py::ssize_t i = 0; i < count; ++i) {
        RandomStream stream = stream_of(seed, i);
        const Rgb value = transmittance(grid, ray, to_vec3(sigma_t), stream);
        for (int channel = 0; channel < 3; ++channel) result.mutable_at(i, channel) = value[channel];
    }
    return result;
}

py::array_t<float> collisions(const VoxelGrid& grid, const Triple& origin, const Triple& direction, float near_m,
                              float far_m, const Triple& sigma_t, const Triple& throughput, std::uint32_t seed,
                              py::ssize_t count) {
    const GridRay ray = to_ray(origin, direction, near_m, far_m);
    py::array_t<float> result({count, py::ssize_t{4}});
    for (py::ssize_t i = 0; i < count; ++i) {
        RandomStream stream = stream_of(seed, i);
        const Collision found = sample_collision(grid, ray, to_vec3(sigma_t), to_vec3(throughput), stream);
        result.mutable_at(i, 0) = found.distance_m.value_or(std::numeric_limits<float>::infinity());
        for (int channel = 0; channel < 3; ++channel) result.mutable_at(i, channel + 1) = found.throughput[channel];
    }
    return result;
}

std::shared_ptr<Medium> make(const std::vector<LobeTuple>& scattering, const Triple& absorption, const Triple& emission,
                             const std::optional<Grid>& density, const std::optional<Grid>& emission_grid) {
    std::vector<ScatterLobe> lobes;
    for (const auto& [sigma_s, anisotropy, phase] : scattering) {
        const PhaseKind kind = from_name<PhaseKind>(
            "phase", phase, {{"HENYEY_GREENSTEIN", PhaseKind::henyey_greenstein}, {"PIVOT", PhaseKind::pivot}});
        lobes.push_back({to_vec3(sigma_s), {kind, anisotropy}});
    }
    return std::make_shared<Medium>(make_medium(std::move(lobes), to_vec3(absorption), to_vec3(emission),
                                                density.value_or(nullptr), emission_grid.value_or(nullptr)));
}

}  // namespace

void register_medium(py::module_& module) {
    py::class_<VoxelGrid, Grid>(
        module, "VoxelGrid",
        "Numbers on a regular grid, interpolated linearly. values: (z, y, x) or (z, y, x, 3), at least 0; that at [k, "
        "j, i] stands at the point (i, j, k) of grid space, and beyond the outermost they fall to 0 within one voxel. "
        "They are kept with 16 bits, in parts of the largest of 8^3 around, and not where that is 0. grid_from_object: "
        "(4, 4). Rays are in grid space: origin, and direction by metre.")
        .def(py::init(&make_grid), py::arg("values"), py::arg("grid_from_object"))
        .def_property_readonly("memory_bytes", &VoxelGrid::memory_bytes)
        .def_property_readonly("most", &VoxelGrid::most, "No value is above it.")
        .def(
            "at",
            [](const VoxelGrid& grid, const FloatArray& points) {
                return at_points(points, [&](const Vec3b& p) { return grid.at(p); });
            },
            py::arg("points"), "The values (N, 3) at points (N, 3) of grid space; of one channel, the same thrice.")
        .def(
            "at_each",
            [](const VoxelGrid& grid, const FloatArray& points) {
                return at_points(
                    points, [&](const Vec3b& p) { return each_lane(p, [&](const Vec3f& q) { return grid.at(q); }); });
            },
            py::arg("points"), "The same, point by point.")
        .def("cells", &cells, py::arg("origin"), py::arg("direction"), py::arg("near_m"), py::arg("far_m"),
             "(near_m, far_m, majorant) of each part of a ray where the grid is not empty, in order.")
        .def(
            "density_integral",
            [](const VoxelGrid& grid, const Triple& origin, const Triple& direction, float near_m, float far_m) {
                return density_integral(grid, to_ray(origin, direction, near_m, far_m));
            },
            py::arg("origin"), py::arg("direction"), py::arg("near_m"), py::arg("far_m"),
            "The integral of the density along a ray.")
        .def("transmittances", &transmittances, py::arg("origin"), py::arg("direction"), py::arg("near_m"),
             py::arg("far_m"), py::arg("sigma_t"), py::arg("seed"), py::arg("count"),
             "(count, 3): unbiased estimates of exp(-sigma_t density_integral).")
        .def("sample_collisions", &collisions, py::arg("origin"), py::arg("direction"), py::arg("near_m"),
             py::arg("far_m"), py::arg("sigma_t"), py::arg("throughput"), py::arg("seed"), py::arg("count"),
             "(count, 4): distances in m, infinite where a ray goes through, and the throughput from there on.");
    py::class_<Medium, std::shared_ptr<Medium>>(
        module, "Medium",
        "Fog. scattering: a list of (sigma_s in 1/m as RGB, anisotropy, phase), phase HENYEY_GREENSTEIN, whose "
        "anisotropy is the mean cosine, or PIVOT, whose anisotropy is g_p. absorption: sigma_a in 1/m; emission: "
        "radiance per m. "
        "density multiplies scattering and absorption, emission_grid the emission.")
        .def(py::init(&make), py::kw_only(), py::arg("scattering") = std::vector<LobeTuple>{},
             py::arg("absorption") = Triple{}, py::arg("emission") = Triple{}, py::arg("density") = py::none(),
             py::arg("emission_grid") = py::none());
}

}  // namespace pivot::bindings
