// pivot_core.VoxelGrid and Medium.
#include <pybind11/stl.h>

#include "bindings/arrays.h"
#include "bindings/names.h"
#include "bindings/register.h"
#include "core/media/medium.h"

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
    std::vector<float> copy(values.data(), values.data() + values.size());
    const Transform transform = to_transform(grid_from_object.data());
    const py::gil_scoped_release release;
    return std::make_shared<VoxelGrid>(size, values.ndim() == 4 ? 3 : 1, std::move(copy), transform);
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
        "j, "
        "i] stands at the point (i, j, k) of grid space, and beyond the outermost they fall to 0 within one voxel. "
        "grid_from_object: (4, 4).")
        .def(py::init(&make_grid), py::arg("values"), py::arg("grid_from_object"));
    py::class_<Medium, std::shared_ptr<Medium>>(
        module, "Medium",
        "Fog. scattering: a list of (sigma_s in 1/m as RGB, anisotropy, phase), phase HENYEY_GREENSTEIN, whose "
        "anisotropy "
        "is the mean cosine, or PIVOT, whose anisotropy is g_p. absorption: sigma_a in 1/m; emission: radiance per m. "
        "density multiplies scattering and absorption, emission_grid the emission.")
        .def(py::init(&make), py::kw_only(), py::arg("scattering") = std::vector<LobeTuple>{},
             py::arg("absorption") = Triple{}, py::arg("emission") = Triple{}, py::arg("density") = py::none(),
             py::arg("emission_grid") = py::none());
}

}  // namespace pivot::bindings
