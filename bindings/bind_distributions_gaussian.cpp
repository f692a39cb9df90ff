#include "bindings/register.h"
#include "bindings/vectorize.h"
#include "core/distributions/spherical_gaussian.h"

namespace pivot::bindings {

namespace {

/// A right- or left-handed orthonormal frame, its rows x, y, z: shape (..., 3, 3).
struct FrameRows {
    const char* name;

    static Shape core() { return {3, 3}; }
    template <class T>
    void check(const T* value, py::ssize_t size) const {
        const Mat3<double> rows(read(value, size));
        const Mat3<double> gram = glm::transpose(rows) * rows;
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j)
                if (!(std::abs(gram[i][j] - (i == j)) < 1e-5)) fail(name, "must have orthonormal rows x, y, z");
    }
    /// Its columns are x, y, z.
    template <class T>
    static Mat3<T> read(const T* v, py::ssize_t /*size*/) {
        return {v[0], v[1], v[2], v[3], v[4], v[5], v[6], v[7], v[8]};
    }
};

/// A unit vector off the tangent plane z = 0.
struct OffHorizon : Direction {
    template <class T>
    void check(const T* value, py::ssize_t size) const {
        Direction::check(value, size);
        if (value[2] == T(0)) fail(name, "must not lie in the plane z = 0");
    }
};

constexpr Number sharpness_spec{.name = "sharpness", .low = 0};
constexpr Number cos_axis_spec{.name = "cos_axis", .low = -1, .high = 1};
constexpr Number eta_x_spec{.name = "eta_x", .low = 0}, eta_y_spec{.name = "eta_y", .low = 0};

}  // namespace

void register_gaussian(py::module_& distributions) {
    define(
        distributions, "sg_eval",
        "sg_eval(axis, sharpness, omega): the spherical Gaussian exp(sharpness (omega . axis - 1)), 1 on its "
        "axis.\n\n"
        "axis, omega (..., 3), unit; sharpness (...) >= 0. [Tokuyoshi15]",
        []<class T>(const Vec3<T>& axis, T sharpness, const Vec3<T>& omega) {
            return eval(SphericalGaussian<T>{axis, sharpness}, omega);
        },
        Direction{"axis"}, sharpness_spec, Direction{"omega"});
    define(
        distributions, "sg_integral",
        "sg_integral(sharpness): the Gaussian's integral over the sphere in steradians, 2 pi (1 - exp(-2 "
        "lambda)) / lambda.\n\n"
        "sharpness (...) >= 0, 0 gives 4 pi. [Tokuyoshi15, A(lambda)]",
        [](auto sharpness) { return gaussian_solid_angle(sharpness); }, sharpness_spec);
    define(
        distributions, "sg_product",
        "sg_product(axis_a, sharpness_a, axis_b, sharpness_b): the product of two Gaussians, itself one.\n\n"
        "Returns (axis (..., 3), sharpness (...), log_amplitude (...)): the product is exp(log_amplitude) "
        "times the Gaussian.\n"
        "log_amplitude = -lambda_a lambda_b |a - b|^2 / (lambda + lambda_a + lambda_b).",
        []<class T>(const Vec3<T>& axis_a, T sharpness_a, const Vec3<T>& axis_b, T sharpness_b) {
            const SphericalGaussian<T> sg =
                product(SphericalGaussian<T>{axis_a, sharpness_a}, SphericalGaussian<T>{axis_b, sharpness_b});
            return std::tuple(sg.axis, sg.sharpness, sg.log_amplitude);
        },
        Direction{"axis_a"}, Number{.name = "sharpness_a", .low = 0}, Direction{"axis_b"},
        Number{.name = "sharpness_b", .low = 0});
    define(
        distributions, "sg_irradiance",
        "sg_irradiance(sharpness, cos_axis): the integral of the Gaussian times the clamped cosine to a "
        "normal.\n\n"
        "cos_axis (...): cosine between the Gaussian's axis and the normal. Error 1e-12 in float64.",
        []<class T>(T sharpness, T cos_axis) {
            return irradiance(SphericalGaussian<T>{{}, sharpness}, cos_axis);
        },
        sharpness_spec, cos_axis_spec);
    define(
        distributions, "sg_irradiance_estimate",
        "sg_irradiance_estimate(sharpness, cos_axis): sg_irradiance within 2 % of the Gaussian's integral, in closed "
        "form.\n\n"
        "[Tokuyoshi24]",
        []<class T>(T sharpness, T cos_axis) { return irradiance_estimate(sharpness, cos_axis); }, sharpness_spec,
        cos_axis_spec);
    define(
        distributions, "sg_sharpness_of_mean",
        "sg_sharpness_of_mean(mean_length): the sharpness of the Gaussian of directions whose mean vector is so "
        "long.\n\n"
        "Within 4 % from a length of 0.9 on, 8 % below. mean_length (...) in [0, 1]. [Banerjee05 (4.4)]",
        [](auto mean_length) { return sharpness_of_mean(mean_length); },
        Number{.name = "mean_length", .low = 0, .high = 1});
    define(
        distributions, "sg_irradiance_vsgl",
        "sg_irradiance_vsgl(sharpness, cos_axis): A(sharpness) max(cos_axis, 0), the VSGL's diffuse shading "
        "before the factor\n"
        "intensity * reflectance / pi. The cosine is taken as constant: for the exact value see "
        "sg_irradiance.\n\n"
        "[Tokuyoshi15, appendix B]",
        []<class T>(T sharpness, T cos_axis) {
            return irradiance_vsgl(SphericalGaussian<T>{{}, sharpness}, cos_axis);
        },
        sharpness_spec, cos_axis_spec);
    define(
        distributions, "sg_ggx_lobe",
        "sg_ggx_lobe(alpha, wo_local): the Gaussian nearest to a GGX reflection lobe over the normal z.\n\n"
        "Returns (axis (..., 3), sharpness (...)): the mirror direction and 2 / alpha^2 / (4 |cos_o|). alpha "
        "(...) in (0, 1],\n"
        "wo_local (..., 3), unit, not in the plane z = 0. [Tokuyoshi15, appendix A]",
        []<class T>(T alpha, const Vec3<T>& wo_local) {
            const SphericalGaussian<T> sg = ggx_lobe(alpha, wo_local);
            return std::tuple(sg.axis, sg.sharpness);
        },
        Number{.name = "alpha", .low = 0, .high = 1, .open_low = true}, OffHorizon{{"wo_local"}});
    define(
        distributions, "asg_eval",
        "asg_eval(frame, eta_x, eta_y, omega): max(omega . z, 0) exp(-eta_x (omega . x)^2 - eta_y (omega . "
        "y)^2).\n\n"
        "frame (..., 3, 3): rows x, y, z, orthonormal; eta_x, eta_y (...) >= 0; omega (..., 3), unit. [Xu13 "
        "(1)]",
        []<class T>(const Mat3<T>& frame, T eta_x, T eta_y, const Vec3<T>& omega) {
            return eval(AnisotropicSphericalGaussian<T>{frame[0], frame[1], frame[2], eta_x, eta_y}, omega);
        },
        FrameRows{"frame"}, eta_x_spec, eta_y_spec, Direction{"omega"});
    define(
        distributions, "asg_integrate_sg",
        "asg_integrate_sg(frame, eta_x, eta_y, axis, sharpness): the integral of the anisotropic Gaussian "
        "times a Gaussian: the\n"
        "VSGL's specular shading before the factor intensity * M.\n\n"
        "An approximation: within 5 % while the axes are within 0.3 rad or the lobes are wide. axis (..., 3), "
        "unit.\n"
        "[Tokuyoshi15, appendix B], [Xu13 (9)]",
        []<class T>(const Mat3<T>& frame, T eta_x, T eta_y, const Vec3<T>& axis, T sharpness) {
            return integrate_product(AnisotropicSphericalGaussian<T>{frame[0], frame[1], frame[2], eta_x, eta_y},
                                     SphericalGaussian<T>{axis, sharpness});
        },
        FrameRows{"frame"}, eta_x_spec, eta_y_spec, Direction{"axis"}, sharpness_spec);
}

}  // namespace pivot::bindings
