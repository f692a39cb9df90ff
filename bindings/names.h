// Names that stand for the values of an enum.
#pragma once

#include <pybind11/pybind11.h>

#include <string>

#include "core/integrators/settings.h"

namespace pivot::bindings {

template <class Enum>
using Names = std::initializer_list<std::pair<const char*, Enum>>;

/// The value that a name stands for; ValueError lists the names there are.
template <class Enum>
Enum from_name(const char* argument, const std::string& name, Names<Enum> names) {
    std::string known;
    for (const auto& [key, value] : names) {
        if (name == key) return value;
        known += (known.empty() ? "" : ", ") + std::string(key);
    }
    throw pybind11::value_error(std::string(argument) + " must be one of " + known + ", not '" + name + "'");
}

inline LightSampling light_sampling_from(const std::string& name) {
    return from_name<LightSampling>("light_sampling", name,
                                    {{"JOINT", LightSampling::joint},
                                     {"SPTD", LightSampling::sptd},
                                     {"MIS", LightSampling::mis},
                                     {"LIGHT", LightSampling::light},
                                     {"BSDF", LightSampling::bsdf}});
}

inline PixelFilterShape pixel_filter_from(const std::string& name) {
    return from_name<PixelFilterShape>(
        "pixel_filter", name, {{"BLACKMAN_HARRIS", PixelFilterShape::blackman_harris}, {"BOX", PixelFilterShape::box}});
}

}  // namespace pivot::bindings
