// pivot_core.TabulatedNdf.
#include <pybind11/stl.h>

#include "bindings/arrays.h"
#include "bindings/register.h"
#include "core/bsdf/tabulated_ndf.h"

namespace pivot::bindings {
namespace {

std::shared_ptr<TabulatedNdf> make_ndf(const FloatArray& pixels) {
    if (pixels.ndim() != 2 || pixels.shape(0) != pixels.shape(1)) throw py::value_error("it must be square");
    const auto size = static_cast<std::size_t>(pixels.shape(0));
    std::vector<float> values(pixels.data(), pixels.data() + pixels.size());
    const py::gil_scoped_release release;
    return std::make_shared<TabulatedNdf>(size, std::move(values));
}

/// of(row) of each row of (n, 3), unit.
template <class Of>
py::array_t<float> map_directions(const FloatArray& directions, const Of& of) {
    require_shape(directions, "directions", {-1, 3});
    py::array_t<float> result(directions.shape(0));
    for (py::ssize_t i = 0; i < directions.shape(0); ++i) {
        const Vec3f direction(directions.at(i, 0), directions.at(i, 1), directions.at(i, 2));
        if (!(direction.z >= 0.0f && length_squared(direction) > 0.0f))
            throw py::value_error("directions must be above the surface: z >= 0");
        result.mutable_at(i) = of(normalize(direction));
    }
    return result;
}

py::list lobes_of(const TabulatedNdf& ndf) {
    py::list lobes;
    for (const TiltedGgx& d : ndf.fit().lobes)
        lobes.append(py::make_tuple(d.weight, py::make_tuple(d.shift.x, d.shift.y), py::make_tuple(d.xx, d.yx, d.yy)));
    return lobes;
}

}  // namespace

void register_ndf(py::module_& module) {
    py::class_<TabulatedNdf, std::shared_ptr<TabulatedNdf>>(
        module, "TabulatedNdf",
        "A distribution of microfacet normals as a picture: what the lobe 'tabulated' takes as its ndf. Immutable.")
        .def(py::init(&make_ndf), py::arg("pixels"),
             "pixels (n, n): D of the normal h whose x is the column's and y the row's, from -1 to 1; of any scale. "
             "Raises ValueError where they are no density.")
        .def(
            "density",
            [](const TabulatedNdf& ndf, const FloatArray& h) {
                return map_directions(h, [&](const Vec3f& v) { return ndf.image().density(v); });
            },
            py::arg("h_local"), "D (n,), 1/sr, of normals (n, 3).")
        .def(
            "sigma",
            [](const TabulatedNdf& ndf, const FloatArray& w) {
                return map_directions(w, [&](const Vec3f& v) { return ndf.sigma(v); });
            },
            py::arg("w_local"), "The integral of max(w.h, 0) D(h) dw, (n,), of directions (n, 3) above the surface.")
        .def(
            "g1",
            [](const TabulatedNdf& ndf, const FloatArray& w) {
                return map_directions(w, [&](const Vec3f& v) { return ndf.g1(v); });
            },
            py::arg("w_local"), "The part of what faces each direction (n, 3) that it sees, (n,).")
        .def(
            "albedo",
            [](const TabulatedNdf& ndf, const FloatArray& w) {
                return map_directions(w, [&](const Vec3f& v) { return ndf.albedo(v); });
            },
            py::arg("wo_local"), "What is reflected towards each direction (n, 3) of light that is 1 all around, (n,).")
        .def_property_readonly("alpha", &TabulatedNdf::alpha, "Of a GGX distribution about as rough.")
        .def_property_readonly(
            "fit", &lobes_of,
            "Tilted GGX lobes that it is about the sum of: (weight, (shift of slopes), (A's xx, yx, yy)).")
        .def_property_readonly(
            "fit_error", [](const TabulatedNdf& ndf) { return ndf.fit().error; },
            "The part of the projected area that lies elsewhere.")
        .def_property_readonly("memory_bytes", &TabulatedNdf::memory_bytes);
}

}  // namespace pivot::bindings
