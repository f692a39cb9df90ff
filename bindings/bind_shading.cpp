#include <pybind11/stl.h>

#include "bindings/names.h"
#include "bindings/register.h"
#include "bindings/vectorize.h"
#include "core/shading/ggx_area_light.h"
#include "core/shading/ggx_gaussian_light.h"
#include "core/simd/batch.h"

namespace pivot::bindings {
namespace {

constexpr Number shaded_alpha{.name = "alpha", .low = double(min_alpha) * (1 - 1e-6), .high = 1};
constexpr Number half_angle_spec{.name = "half_angle", .low = 0, .high = 1.5707964, .open_low = true};
constexpr Number budget_spec{.name = "error_budget", .low = 0, .high = 100, .open_low = true};

/// A direction above the surface.
struct UpperDirection : Direction {
    template <class T>
    void check(const T* value, py::ssize_t size) const {
        Direction::check(value, size);
        if (!(value[2] > 0)) fail(name, "must be above the surface: z > 0");
    }
};

/// Values of n elements, gathered eight at a time.
struct Gather {
    const Input<float>& input;
    const Shape& common;
    py::ssize_t first, count;

    Batch operator()(int component) const {
        return gather([&](size_t lane) {
            return input.at(std::min(first + static_cast<py::ssize_t>(lane), count - 1), common)[component];
        });
    }
    Vec3b direction() const { return {(*this)(0), (*this)(1), (*this)(2)}; }
};

GgxLobe<Batch> gather_lobe(const Gather& alpha, const Gather& wo) {
    return {wo.direction(), max(alpha(0), Batch(min_alpha)), Batch(1.0f), false};
}

/// The leading axes of all inputs together.
Shape common_shape(std::initializer_list<std::pair<const char*, const Input<float>*>> inputs) {
    Shape common;
    for (const auto& [name, input] : inputs) broadcast(common, input->leading, name);
    return common;
}

/// integral(gather): of the lanes that gather(input) reads. Returns (value, error, method).
template <class Integral>
py::tuple evaluate_batches(const Shape& common, const Integral& integral) {
    const py::ssize_t count = product(common), step = static_cast<py::ssize_t>(batch_size);
    py::array_t<float> values(common), errors(common);
    py::array_t<int> methods(common);
    for (py::ssize_t first = 0; first < count; first += step) {
        const LobeIntegral<Batch> lanes = integral([&](const Input<float>& input) {
            return Gather{input, common, first, count};
        });
        const Lanes value = store(lanes.sums.plain), error = store(lanes.predicted_error), method = store(lanes.method);
        for (py::ssize_t i = first; i < std::min(first + step, count); ++i) {
            const auto lane = static_cast<size_t>(i - first);
            values.mutable_data()[i] = value[lane];
            errors.mutable_data()[i] = error[lane];
            methods.mutable_data()[i] = static_cast<int>(method[lane]);
        }
    }
    return py::make_tuple(values[py::tuple()], errors[py::tuple()], methods[py::tuple()]);
}

py::tuple ggx_sphere_light(const py::object& alpha, const py::object& wo, const py::object& cap_axis,
                           const py::object& half_angle, double error_budget) {
    budget_spec.check(&error_budget, 1);
    const UpperDirection wo_spec{{"wo"}};
    const Direction axis_spec{"cap_axis"};
    const Input<float> alphas(shaded_alpha, alpha), wos(wo_spec, wo), axes(axis_spec, cap_axis);
    const Input<float> half_angles(half_angle_spec, half_angle);
    const Shape common =
        common_shape({{"alpha", &alphas}, {"wo", &wos}, {"cap_axis", &axes}, {"half_angle", &half_angles}});
    const auto cap_integral = [&](const auto& gather) {
        const GgxLobe<Batch> lobe = gather_lobe(gather(alphas), gather(wos));
        const Cap<Batch> cap{gather(axes).direction(), versine_of_angle(gather(half_angles)(0))};
        return integrate(ggx_cap_light(lobe, cap), Batch(static_cast<float>(error_budget / 100)));
    };
    return evaluate_batches(common, cap_integral);
}

py::tuple ggx_area_light(const py::object& alpha, const py::object& wo, const py::object& center,
                         const py::object& half_u, const py::object& half_v, bool ellipse, double error_budget) {
    budget_spec.check(&error_budget, 1);
    const UpperDirection wo_spec{{"wo"}};
    const Vector center_spec{"center"}, u_spec{"half_u"}, v_spec{"half_v"};
    const Input<float> alphas(shaded_alpha, alpha), wos(wo_spec, wo), centers(center_spec, center), us(u_spec, half_u),
        vs(v_spec, half_v);
    const Shape common =
        common_shape({{"alpha", &alphas}, {"wo", &wos}, {"center", &centers}, {"half_u", &us}, {"half_v", &vs}});
    const auto area_integral = [&](const auto& gather) {
        const GgxLobe<Batch> lobe = gather_lobe(gather(alphas), gather(wos));
        const AreaOutline<Batch> outline{gather(centers).direction(), gather(us).direction(), gather(vs).direction(),
                                         ellipse ? AreaShape::ellipse : AreaShape::parallelogram};
        return integrate(lobe, outline, Batch(static_cast<float>(error_budget / 100)));
    };
    return evaluate_batches(common, area_integral);
}

enum class GaussianWay { chosen, caps, points, widened, anisotropic };

py::tuple ggx_gaussian_light(const py::object& alpha, const py::object& wo, const py::object& axis,
                             const py::object& sharpness, const std::string& way_name) {
    const auto way = from_name<GaussianWay>("way", way_name,
                                            {{"AUTO", GaussianWay::chosen},
                                             {"CAPS", GaussianWay::caps},
                                             {"POINTS", GaussianWay::points},
                                             {"WIDENED", GaussianWay::widened},
                                             {"ANISOTROPIC", GaussianWay::anisotropic}});
    const UpperDirection wo_spec{{"wo"}};
    const Direction axis_spec{"axis"};
    const Number sharpness_spec{.name = "sharpness", .low = 0};
    const Input<float> alphas(shaded_alpha, alpha), wos(wo_spec, wo), axes(axis_spec, axis);
    const Input<float> sharpnesses(sharpness_spec, sharpness);
    const Shape common = common_shape({{"alpha", &alphas}, {"wo", &wos}, {"axis", &axes}, {"sharpness", &sharpnesses}});
    return evaluate_batches(common, [&](const auto& gather) {
        const GgxGaussianReceiver<Batch> receiver(gather_lobe(gather(alphas), gather(wos)));
        const SphericalGaussian<Batch> light{gather(axes).direction(), gather(sharpnesses)(0), Batch(0.0f)};
        const BatchMask points = way == GaussianWay::chosen
                                     ? is_wide(receiver, light)
                                     : Batch(way == GaussianWay::points ? 1.0f : 0.0f) > Batch(0.0f);
        LobeIntegral<Batch> result;
        result.method = detail::number_of<Batch>(Method::virtual_lights);
        if (way == GaussianWay::widened) {
            result.sums = integrate_widened(receiver, light);
            result.predicted_error = Batch(error_of_widened_lobe);
        } else if (way == GaussianWay::anisotropic) {
            result.sums = integrate_anisotropic(receiver, light);
            result.predicted_error = Batch(error_of_anisotropic_lobe);
        } else {
            const LobeSums<Batch> caps = integrate_by_caps(receiver, light, Batch(0.002f));
            result.sums = select<Batch>(points, integrate_by_points(receiver, light), caps);
            result.predicted_error = select(points, Batch(error_of_gaussian_points), Batch(error_of_gaussian_caps));
        }
        return result;
    });
}

}  // namespace

void register_shading(py::module_& shading) {
    py::list names;
    for (const std::string_view name : method_names) names.append(py::str(name.data(), name.size()));
    shading.attr("METHODS") = py::tuple(names);
    shading.def("ggx_sphere_light", &ggx_sphere_light, py::arg("alpha"), py::arg("wo"), py::arg("cap_axis"),
                py::arg("half_angle"), py::arg("error_budget"),
                R"(ggx_sphere_light(alpha, wo, cap_axis, half_angle, error_budget): (value, error, method).

GGX (F = 1, height-correlated masking-shadowing) over a spherical light of radiance 1, cut at the horizon, by the
cheapest method whose predicted error meets the budget: what the analytic integrator computes. Shading frame, z the
normal. alpha (n,) in [1e-3, 1]; wo and cap_axis (n, 3), unit, wo above the surface; half_angle (n,) in radians, at
most pi/2; error_budget in percent, relative to max(value, 1e-3). All broadcast.
value: reflected over emitted radiance, float32. error: the predicted relative error. method: an index into METHODS.)");
    shading.def("ggx_area_light", &ggx_area_light, py::arg("alpha"), py::arg("wo"), py::arg("center"),
                py::arg("half_u"), py::arg("half_v"), py::arg("ellipse"), py::arg("error_budget"),
                R"(ggx_area_light(alpha, wo, center, half_u, half_v, ellipse, error_budget): (value, error, method).

The same for a parallelogram, or the ellipse in it: center (n, 3) from the shaded point, half_u and half_v (n, 3) from
the centre to the middle of two sides, in the shading frame.)");
    shading.def("ggx_gaussian_light", &ggx_gaussian_light, py::arg("alpha"), py::arg("wo"), py::arg("axis"),
                py::arg("sharpness"), py::arg("way") = "AUTO",
                R"(ggx_gaussian_light(alpha, wo, axis, sharpness, way): (value, error, method).

The same for a spherical Gaussian of radiance, 1 on its axis (n, 3): by CAPS of the exact core, by POINTS of the lobe,
by the WIDENED lobe of [Tokuyoshi24], by the ANISOTROPIC Gaussian of [Tokuyoshi15], or, AUTO, by points where the light
is much wider than the lobe, else caps.)");
}

}  // namespace pivot::bindings
