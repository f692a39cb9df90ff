// The lights of pivot_core that a scene is given.
#include "bindings/arrays.h"
#include "bindings/register.h"
#include "core/lights/light.h"

namespace pivot::bindings {

void register_lights(py::module_& module) {
    py::class_<SphereLight>(module, "SphereLight",
                            "A sphere of radius_m; intensity in W/sr, Blender's power / (4 pi). facing_disk: a disk "
                            "turned to each point it lights instead, Blender's soft falloff.")
        .def(py::init([](const Triple& position, float radius_m, const Triple& intensity, bool facing_disk) {
                 return make_sphere_light(to_vec3(position), radius_m, to_vec3(intensity), facing_disk);
             }),
             py::arg("position"), py::arg("radius_m"), py::arg("intensity"), py::arg("facing_disk") = false);
    py::class_<SpotLight>(module, "SpotLight",
                          "A sphere that shines along direction, with a smooth step from the cone's edge inwards over "
                          "the share blend of its versine; with cosine, times the cosine from the axis.")
        .def(py::init([](const Triple& position, float radius_m, const Triple& intensity, const Triple& direction,
                         float cos_half_angle, float blend, bool facing_disk, bool cosine) {
                 return make_spot_light(make_sphere_light(to_vec3(position), radius_m, to_vec3(intensity), facing_disk),
                                        to_vec3(direction), cos_half_angle, blend, cosine);
             }),
             py::arg("position"), py::arg("radius_m"), py::arg("intensity"), py::arg("direction"),
             py::arg("cos_half_angle"), py::arg("blend"), py::arg("facing_disk") = false, py::arg("cosine") = false);
    py::class_<SunLight>(
        module, "SunLight",
        "Light from a cap of directions around direction (towards the sun); irradiance of a surface that "
        "faces it.")
        .def(py::init([](const Triple& direction, float half_angle_rad, const Triple& irradiance) {
                 return make_sun_light(to_vec3(direction), half_angle_rad, to_vec3(irradiance));
             }),
             py::arg("direction"), py::arg("half_angle_rad"), py::arg("irradiance"));
    py::class_<AreaLight>(module, "AreaLight",
                          "A parallelogram center +- half_u +- half_v, or the ellipse in it, shining towards "
                          "cross(half_u, half_v) with the given radiance, as if behind slats where spread_rad is less "
                          "than pi.")
        .def(py::init([](const Triple& center, const Triple& half_u, const Triple& half_v, const Triple& radiance,
                         bool ellipse, float spread_rad) {
                 return make_area_light(to_vec3(center), to_vec3(half_u), to_vec3(half_v), to_vec3(radiance), ellipse,
                                        spread_rad);
             }),
             py::arg("center"), py::arg("half_u"), py::arg("half_v"), py::arg("radiance"), py::arg("ellipse") = false,
             py::arg("spread_rad") = pi<float>);
}

}  // namespace pivot::bindings
