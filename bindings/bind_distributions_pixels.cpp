#include "bindings/register.h"
#include "bindings/vectorize.h"
#include "core/distributions/orthographic.h"

namespace pivot::bindings {

namespace {

constexpr Number x_spec{.name = "x"}, y_spec{.name = "y"};
constexpr Number x0_spec{.name = "x0"}, x1_spec{.name = "x1"}, y0_spec{.name = "y0"}, y1_spec{.name = "y1"};

}  // namespace

void register_pixels(py::module_& distributions) {
    define(
        distributions, "orthographic_corner_solid_angle",
        "orthographic_corner_solid_angle(x, y): solid angle of the hemisphere z > 0 over [0, x] x [0, y], odd "
        "in x and in y.\n\n"
        "What lies outside the unit disc counts nothing. Absolute error: rounding. [Patapom (2), in a shorter "
        "form]",
        [](auto x, auto y) { return orthographic_corner_solid_angle(x, y); }, x_spec, y_spec);
    define(
        distributions, "orthographic_pixel_solid_angle",
        "orthographic_pixel_solid_angle(x0, x1, y0, y1): solid angle of the hemisphere z > 0 over the pixel "
        "[x0, x1] x [y0, y1],\n"
        "cut by the unit disc.\n\n"
        "0 if x0 >= x1 or y0 >= y1. Relative error 1e-11 in float64, rounding in float32.",
        [](auto x0, auto x1, auto y0, auto y1) { return orthographic_pixel_solid_angle(x0, x1, y0, y1); }, x0_spec,
        x1_spec, y0_spec, y1_spec);
    define(
        distributions, "cubemap_corner_solid_angle",
        "cubemap_corner_solid_angle(x, y): solid angle of [0, x] x [0, y] on the plane z = 1, odd in x and in "
        "y. "
        "[Patapom (1)]",
        [](auto x, auto y) { return cubemap_corner_solid_angle(x, y); }, x_spec, y_spec);
    define(
        distributions, "cubemap_pixel_solid_angle",
        "cubemap_pixel_solid_angle(x0, x1, y0, y1): solid angle of the pixel [x0, x1] x [y0, y1] on the plane "
        "z = 1.\n\n"
        "To rounding for pixels of any size.",
        [](auto x0, auto x1, auto y0, auto y1) { return cubemap_pixel_solid_angle(x0, x1, y0, y1); }, x0_spec, x1_spec,
        y0_spec, y1_spec);
}

}  // namespace pivot::bindings
