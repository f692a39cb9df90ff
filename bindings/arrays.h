// NumPy arrays and tuples to the core's types, with errors that name the argument.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <array>
#include <string>

#include "core/math/transform.h"

namespace pivot::bindings {

namespace py = pybind11;

using FloatArray = py::array_t<float, py::array::c_style | py::array::forcecast>;
using IntArray = py::array_t<std::int32_t, py::array::c_style | py::array::forcecast>;
using Triple = std::array<float, 3>;

inline Vec3f to_vec3(const Triple& t) { return {t[0], t[1], t[2]}; }

/// Throws ValueError unless the array's shape is `shape`; -1 matches any length.
inline void require_shape(const py::array& array, const std::string& name, const std::vector<py::ssize_t>& shape) {
    bool matches = array.ndim() == static_cast<py::ssize_t>(shape.size());
    for (std::size_t i = 0; matches && i < shape.size(); ++i) {
        matches = shape[i] < 0 || array.shape(static_cast<py::ssize_t>(i)) == shape[i];
    }
    if (matches) return;
    std::string wanted;
    for (const py::ssize_t n : shape)
        wanted += (wanted.empty() ? "" : ", ") + (n < 0 ? std::string("n") : std::to_string(n));
    throw py::value_error(name + " must have shape (" + wanted + ")");
}

/// From a row-major 4 x 4 matrix; the last row is taken to be (0, 0, 0, 1).
inline Transform to_transform(const float* rows) {
    Transform t;
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) t.linear[column][row] = rows[4 * row + column];
        t.translation[row] = rows[4 * row + 3];
    }
    return t;
}

}  // namespace pivot::bindings
