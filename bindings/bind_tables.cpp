#include "bindings/register.h"
#include "bindings/vectorize.h"
#include "core/tables/axes.h"
#include "core/tables/ggx_albedo.h"
#include "core/tables/ggx_dielectric.h"
#include "core/tables/ggx_glass.h"
#include "core/tables/ggx_ltc.h"
#include "core/tables/ggx_sptd.h"

namespace pivot::bindings {

namespace {

constexpr Number table_alpha{.name = "alpha", .low = 1e-3 * (1 - 1e-6), .high = 1};
constexpr Number table_cos{.name = "cos_o", .low = 0, .high = 1};
constexpr Number eta_spec{.name = "eta", .low = 0, .open_low = true};

/// The values at the nodes of an axis, as the tables' own lookup places them.
template <class Value>
py::array_t<float> nodes(int count, Value value) {
    py::array_t<float> values(Shape{count});
    for (int i = 0; i < count; ++i)
        values.mutable_data()[i] = value(static_cast<float>(i) / static_cast<float>(count - 1));
    return values;
}

/// As a binding returns it.
template <class T>
std::array<Vec3<T>, 3> rows(const Mat3<T>& m) {
    const Mat3<T> t = glm::transpose(m);
    return {t[0], t[1], t[2]};
}

}  // namespace

void register_tables(py::module_& tables) {
    tables.def(
        "alpha_nodes", [](int count) { return nodes(count, alpha_at); }, py::arg("count"),
        "alpha_nodes(count): alpha at the nodes of a table of that size, 1e-3 to 1, even in its square root.");
    tables.def(
        "cos_nodes", [](int count) { return nodes(count, cos_at); }, py::arg("count"),
        "cos_nodes(count): cosine at the nodes of a table of that size, 0 to 1, even in its square root.");
    tables.def(
        "ior_nodes", [](int count) { return nodes(count, ior_at); }, py::arg("count"),
        "ior_nodes(count): index of refraction at the nodes of a table of that size, 1 to 3, dense at 1.");
    tables.def(
        "eta_nodes", [](int count) { return nodes(count, eta_at); }, py::arg("count"),
        "eta_nodes(count): relative index of refraction at the nodes of a table of that size, 1 in the middle.");
    define(
        tables, "ggx_sptd_from_node",
        "ggx_sptd_from_node(alpha, wo_local, shift, width): (pivot_local (..., 3), delta (...)) that a node of the "
        "SPTD table\n"
        "stands for. The pivot lies 2 atan(alpha shift sin_o / 2) from the mirror direction towards the horizon; delta "
        "= alpha width.",
        []<class T>(T alpha, const Vec3<T>& wo, T shift, T width) {
            const GgxSptd lobe = ggx_sptd_from_node(static_cast<float>(alpha), Vec3f(wo), static_cast<float>(shift),
                                                    static_cast<float>(width), 1.f);
            return std::tuple(Vec3<T>(lobe.pivot_local), static_cast<T>(lobe.delta));
        },
        table_alpha, Direction{"wo_local"}, Number{.name = "shift"},
        Number{.name = "width", .low = 0, .open_low = true});
    define(
        tables, "ggx_sptd",
        "ggx_sptd(alpha, wo_local): the SPTD nearest to the GGX lobe, from the table: (pivot_local (..., 3), delta "
        "(...),\n"
        "albedo (...), amplitude (...)). amplitude times the SPTD integrates to albedo over the hemisphere.\n\n"
        "alpha (...) in [1e-3, 1]; wo_local (..., 3), unit. [Dupuy17, 5.2]",
        []<class T>(T alpha, const Vec3<T>& wo) {
            const GgxSptd lobe = ggx_sptd(static_cast<float>(alpha), Vec3f(wo));
            return std::tuple(Vec3<T>(lobe.pivot_local), static_cast<T>(lobe.delta), static_cast<T>(lobe.albedo),
                              static_cast<T>(lobe.amplitude()));
        },
        table_alpha, Direction{"wo_local"});
    define(
        tables, "ggx_ltc_from_node",
        "ggx_ltc_from_node(alpha, wo_local, shift, width_x, width_y, skew): the matrix (..., 3, 3) that a node of the "
        "LTC\n"
        "table stands for.",
        []<class T>(T alpha, const Vec3<T>& wo, T shift, T width_x, T width_y, T skew) {
            return rows(ggx_ltc_matrix(alpha, wo, shift, width_x, width_y, skew));
        },
        table_alpha, Direction{"wo_local"}, Number{.name = "shift"},
        Number{.name = "width_x", .low = 0, .open_low = true}, Number{.name = "width_y", .low = 0, .open_low = true},
        Number{.name = "skew"});
    define(
        tables, "ggx_ltc",
        "ggx_ltc(alpha, wo_local): the linearly transformed cosine nearest to the GGX lobe, from the table: (m (..., "
        "3, 3),\n"
        "albedo (...), amplitude (...)). amplitude times the LTC integrates to albedo over the hemisphere.\n\n"
        "alpha (...) in [1e-3, 1]; wo_local (..., 3), unit. [Heitz16]",
        []<class T>(T alpha, const Vec3<T>& wo) {
            const GgxLtc lobe = ggx_ltc(static_cast<float>(alpha), Vec3f(wo));
            return std::tuple(rows(Mat3<T>(lobe.lobe_local.m)), static_cast<T>(lobe.albedo),
                              static_cast<T>(lobe.amplitude()));
        },
        table_alpha, Direction{"wo_local"});
    define(
        tables, "ggx_albedo",
        "ggx_albedo(alpha, cos_o): the integral of GGX BRDF * cos over the hemisphere, F = 1, from the table.",
        []<class T>(T alpha, T cos_o) {
            return static_cast<T>(ggx_albedo(static_cast<float>(alpha), static_cast<float>(cos_o)));
        },
        table_alpha, table_cos);
    define(
        tables, "ggx_average_albedo", "ggx_average_albedo(alpha): 2 int E cos dcos of ggx_albedo's E, from the table.",
        []<class T>(T alpha) { return static_cast<T>(ggx_average_albedo(static_cast<float>(alpha))); }, table_alpha);
    define(
        tables, "ggx_dielectric_weight",
        "ggx_dielectric_weight(alpha, cos_o, ior): s such that the GGX lobe under the dielectric Fresnel curve has "
        "albedo\n"
        "lerp(F0, 1, s) * ggx_albedo, from the table. ior (...) >= 1, held at 3 above that.",
        []<class T>(T alpha, T cos_o, T ior) {
            return static_cast<T>(
                ggx_dielectric_weight(static_cast<float>(alpha), static_cast<float>(cos_o), static_cast<float>(ior)));
        },
        table_alpha, table_cos, Number{.name = "ior", .low = 1});
    define(
        tables, "ggx_glass_albedo",
        "ggx_glass_albedo(alpha, cos_o, eta): (reflected (...), refracted (...)), what a rough dielectric boundary "
        "sends "
        "to the\n"
        "viewer by single scattering where all light around is 1, by the side that it comes from, from the table. eta: "
        "the other\n"
        "side's index of refraction over the viewer's.",
        []<class T>(T alpha, T cos_o, T eta) {
            const auto albedo =
                ggx_glass_albedo(static_cast<float>(alpha), static_cast<float>(cos_o), static_cast<float>(eta));
            return std::tuple(static_cast<T>(albedo.reflected), static_cast<T>(albedo.refracted));
        },
        table_alpha, table_cos, eta_spec);
    define(
        tables, "ggx_glass_average_albedo",
        "ggx_glass_average_albedo(alpha, eta): 2 int E cos dcos of both of ggx_glass_albedo's together, from the "
        "table.",
        []<class T>(T alpha, T eta) {
            return static_cast<T>(ggx_glass_average_albedo(static_cast<float>(alpha), static_cast<float>(eta)));
        },
        table_alpha, eta_spec);
}

}  // namespace pivot::bindings
