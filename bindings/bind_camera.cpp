// The camera's projections and its lens.
#include <pybind11/stl.h>

#include "bindings/arrays.h"
#include "bindings/register.h"
#include "core/scene/camera.h"

namespace pivot::bindings {
namespace {

using Pair = std::array<float, 2>;

Equirectangular equirectangular(const Pair& longitude, const Pair& latitude) {
    Equirectangular made;
    made.longitude_min = longitude[0], made.longitude_max = longitude[1];
    made.latitude_min = latitude[0], made.latitude_max = latitude[1];
    return made;
}

CentralCylindrical central_cylindrical(const Pair& longitude, const Pair& height) {
    CentralCylindrical made;
    made.longitude_min = longitude[0], made.longitude_max = longitude[1];
    made.height_min = height[0], made.height_max = height[1];
    return made;
}

FisheyeEquidistant fisheye_equidistant(float fov_rad) {
    FisheyeEquidistant made;
    made.fov_rad = fov_rad;
    return made;
}

FisheyeEquisolid fisheye_equisolid(float lens_mm, float fov_rad, const Pair& sensor_mm) {
    FisheyeEquisolid made;
    made.lens_mm = lens_mm;
    made.fov_rad = fov_rad;
    made.sensor_mm = {sensor_mm[0], sensor_mm[1]};
    return made;
}

FisheyePolynomial fisheye_polynomial(const std::array<float, 5>& coefficients, float fov_rad, const Pair& sensor_mm) {
    FisheyePolynomial made;
    made.coefficients = coefficients;
    made.fov_rad = fov_rad;
    made.sensor_mm = {sensor_mm[0], sensor_mm[1]};
    return made;
}

}  // namespace

void register_camera(py::module_& module) {
    py::class_<Perspective>(module, "Perspective", "Places are those of the plane at z = -1 in camera space.")
        .def(py::init<>());
    py::class_<Orthographic>(module, "Orthographic", "Places are x and y of camera space, in m.").def(py::init<>());
    py::class_<Equirectangular>(
        module, "Equirectangular",
        "Longitude, to the right of the camera's axis, and latitude (from, to) over the unit square, in radians.")
        .def(py::init(&equirectangular), py::arg("longitude"), py::arg("latitude"));
    py::class_<CentralCylindrical>(module, "CentralCylindrical",
                                   "Longitude in radians, and height over the radius (from, to) over the unit square.")
        .def(py::init(&central_cylindrical), py::arg("longitude"), py::arg("height"));
    py::class_<FisheyeEquidistant>(module, "FisheyeEquidistant",
                                   "The angle from the axis, even over the disk in the unit square.")
        .def(py::init(&fisheye_equidistant), py::arg("fov_rad"));
    py::class_<FisheyeEquisolid>(module, "FisheyeEquisolid",
                                 "Solid angle around the axis, even over a sensor (width, height).")
        .def(py::init(&fisheye_equisolid), py::arg("lens_mm"), py::arg("fov_rad"), py::arg("sensor_mm"));
    py::class_<FisheyePolynomial>(module, "FisheyePolynomial",
                                  "The angle from the axis, its sign turned, as a polynomial of the radius on a sensor "
                                  "(width, height): radians per mm^k.")
        .def(py::init(&fisheye_polynomial), py::arg("coefficients"), py::arg("fov_rad"), py::arg("sensor_mm"));
    py::class_<CubeMapFace>(module, "CubeMapFace", "A quarter turn each way, even in both angles.").def(py::init<>());
    py::class_<MirrorBall>(module, "MirrorBall", "What a ball of mirror shows from afar.").def(py::init<>());
    py::class_<Lens>(module, "Lens",
                     "A thin lens in focus at a distance; blades: sides of its stop, below 3 it is round; ratio: how "
                     "much narrower it is along x.")
        .def(py::init([](float radius_m, float focus_m, int blades, float rotation_rad, float ratio) {
                 return Lens{radius_m, focus_m, blades, rotation_rad, ratio};
             }),
             py::arg("radius_m"), py::arg("focus_m"), py::arg("blades") = 0, py::arg("rotation_rad") = 0.0f,
             py::arg("ratio") = 1.0f);
}

}  // namespace pivot::bindings
