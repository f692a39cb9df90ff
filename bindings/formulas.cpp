// The module of formulas over NumPy arrays, its table of contents: one register_* function per area, each in a
// bind_*.cpp beside this file.
#include <pybind11/pybind11.h>

#include "bindings/register.h"

namespace {

constexpr const char* distributions_doc =
    R"(Spherical distributions: eval, integrate, sample and pdf, over NumPy arrays.

Arguments broadcast over their leading axes: a scalar has shape (...), a direction (..., 3), random numbers (..., 2).
Results are float32 if every floating-point array given is float32, else float64. Angles are in radians, solid angles
in steradians, pdfs per steradian. A spherical cap is its unit axis and its versine, 1 - cos(half-angle), in [0, 2]: a
tiny cap keeps all its bits. A pivot is a unit direction and delta = 1 - |r_p| in (0, 1]. Bad input raises ValueError
naming the argument; nothing returns NaN.)";

}  // namespace

PYBIND11_MODULE(PIVOT_MODULE, module) {
    using namespace pivot::bindings;
    module.doc() = "Pivot's distributions, lobes and tables, one build per x86-64 level.";

    auto distributions = module.def_submodule("distributions", distributions_doc);
    register_caps(distributions);
    register_pivot(distributions);
    register_ggx(distributions);
    register_ltsd(distributions);
    register_gaussian(distributions);
    register_pixels(distributions);
    register_media(distributions);

    auto sampling = module.def_submodule("sampling", "Owen-scrambled Sobol points, over NumPy arrays.");
    register_sampling(sampling);

    auto film = module.def_submodule("film", "The pixel filter and the sample counts of adaptive sampling.");
    register_film(film);

    auto bsdf = module.def_submodule("bsdf", "The GGX lobe and Fresnel reflectance, over NumPy arrays.");
    register_bsdf(bsdf);

    auto tables = module.def_submodule("tables", "Tables fitted by lut/, fetched with linear interpolation.");
    register_tables(tables);

    auto shading =
        module.def_submodule("shading", "Lobes under lights within an error budget, as the renderer does it.");
    register_shading(shading);
}
