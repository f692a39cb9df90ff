// Lobes of a material as Python gives them: (kind, {parameter: number or colour}).
#pragma once

#include <pybind11/stl.h>

#include "bindings/arrays.h"
#include "core/bsdf/surface.h"

namespace pivot::bindings {

using LobeTable = std::shared_ptr<TabulatedNdf>;
using LobeArguments =
    std::vector<std::pair<std::string, std::map<std::string, std::variant<float, Triple, LobeTable>>>>;

/// A material, and what its lobes read.
struct OwnedMaterial : Material {
    std::vector<std::shared_ptr<const TabulatedNdf>> tables;
};

/// Sets a material's lobes. Throws std::invalid_argument naming the kind and the parameter that cannot be.
void set_lobes(OwnedMaterial& material, const LobeArguments& arguments);

/// LOBES, MAX_LOBES and how a material's lobes are evaluated and sampled. Material must be registered.
void register_lobes(py::module_& module);

}  // namespace pivot::bindings
