// pivot_core.Material.
#include "bindings/lobes.h"
#include "bindings/register.h"

namespace pivot::bindings {
namespace {

float opacity_beside(const Triple& transparency) {
    return std::max(0.0f, 1.0f - mean_component(to_vec3(transparency)));
}

}  // namespace

void register_material(py::module_& module) {
    py::class_<OwnedMaterial>(
        module, "Material",
        "A Lambert lobe beneath one GGX lobe, further lobes, and emission; colours are linear RGB.\n\n"
        "The lobe's Fresnel is a Schlick curve from conductor_f0 to conductor_f90, less conductor_dip times the weight "
        "of "
        "F82, cos (1 - cos)^6, in which conductor_weight is multiplied, plus, times "
        "dielectric_weight, the curve of a dielectric of dielectric_ior whose reflectance at normal "
        "incidence is scaled by dielectric_tint. alpha must be in [0, 1], dielectric_ior at least 1. weight: the share "
        "of "
        "the surface that these are, multiplied into them. transparency: the colour of light that goes straight on; "
        "opacity: how much of the surface there is beside, which "
        "tells paths how often to pass and is multiplied into all else already; None: what transparency leaves of "
        "1.\n\n"
        "lobes: up to MAX_LOBES beside these, each a kind and its parameters, as LOBES names them; what is not given "
        "is "
        "as here, or 1.")
        .def(py::init([](const Triple& diffuse, float alpha, const Triple& conductor_f0, const Triple& conductor_f90,
                         float conductor_weight, float dielectric_weight, float dielectric_ior,
                         const Triple& dielectric_tint, bool multiscatter, float weight, const Triple& emission,
                         const LobeArguments& lobes, const Triple& transparency, std::optional<float> opacity,
                         const Triple& conductor_dip) {
                 OwnedMaterial material{{{.diffuse = to_vec3(diffuse),
                                          .alpha = alpha,
                                          .conductor_f0 = to_vec3(conductor_f0),
                                          .conductor_f90 = to_vec3(conductor_f90),
                                          .conductor_weight = conductor_weight,
                                          .dielectric_weight = dielectric_weight,
                                          .dielectric_ior = dielectric_ior,
                                          .dielectric_tint = to_vec3(dielectric_tint),
                                          .multiscatter = multiscatter ? 1.0f : 0.0f,
                                          .weight = weight,
                                          .conductor_dip = to_vec3(conductor_dip)},
                                         to_vec3(emission),
                                         {},
                                         {to_vec3(transparency), opacity.value_or(opacity_beside(transparency))}},
                                        {}};
                 set_lobes(material, lobes);
                 return material;
             }),
             py::kw_only(), py::arg("diffuse") = Triple{}, py::arg("alpha") = 0.5f, py::arg("conductor_f0") = Triple{},
             py::arg("conductor_f90") = Triple{}, py::arg("conductor_weight") = 1.0f,
             py::arg("dielectric_weight") = 0.0f, py::arg("dielectric_ior") = 1.5f,
             py::arg("dielectric_tint") = Triple{1, 1, 1}, py::arg("multiscatter") = false, py::arg("weight") = 1.0f,
             py::arg("emission") = Triple{}, py::arg("lobes") = LobeArguments{}, py::arg("transparency") = Triple{},
             py::arg("opacity") = py::none(), py::arg("conductor_dip") = Triple{});
    register_lobes(module);
}

}  // namespace pivot::bindings
