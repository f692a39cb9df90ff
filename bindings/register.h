// What formulas.cpp and module.cpp call, one function per bind_*.cpp.
#pragma once

#include <pybind11/pybind11.h>

namespace pivot::bindings {

void register_caps(pybind11::module_& distributions);
void register_pivot(pybind11::module_& distributions);
void register_ggx(pybind11::module_& distributions);
void register_ltsd(pybind11::module_& distributions);
void register_gaussian(pybind11::module_& distributions);
void register_pixels(pybind11::module_& distributions);
void register_media(pybind11::module_& distributions);
void register_sampling(pybind11::module_& sampling);
void register_bsdf(pybind11::module_& bsdf);
void register_tables(pybind11::module_& tables);
void register_shading(pybind11::module_& shading);
void register_film(pybind11::module_& film);

void register_medium(pybind11::module_& module);
void register_ndf(pybind11::module_& module);
void register_material(pybind11::module_& module);
void register_images(pybind11::module_& module);
void register_shaders(pybind11::module_& module);
void register_camera(pybind11::module_& module);
void register_lights(pybind11::module_& module);
void register_scene(pybind11::module_& module);
void register_meshes(pybind11::module_& module);
void register_rays(pybind11::module_& module);
void register_light_samples(pybind11::module_& module);
void register_occlusion(pybind11::module_& module);
void register_render(pybind11::module_& module);

}  // namespace pivot::bindings
