// The module a render needs, its table of contents: one register_* function per area, each in a bind_*.cpp beside this
// file.
#include <pybind11/pybind11.h>

#include "bindings/register.h"

#define PIVOT_STRING_(name) #name
#define PIVOT_STRING(name) PIVOT_STRING_(name)

PYBIND11_MODULE(PIVOT_MODULE, module) {
    using namespace pivot::bindings;
    module.doc() = "Pivot's core, one build per x86-64 level.";
    module.attr("arch") = std::string(PIVOT_STRING(PIVOT_MODULE)).substr(6);
    module.attr("version") = PIVOT_VERSION;

    register_medium(module);
    register_ndf(module);
    register_material(module);
    register_images(module);
    register_lights(module);
    register_shaders(module);
    register_camera(module);
    register_scene(module);
    register_meshes(module);
    register_rays(module);
    register_light_samples(module);
    register_occlusion(module);
    register_render(module);
}
