#include "bindings/register.h"
#include "bindings/vectorize.h"
#include "core/bsdf/fresnel.h"
#include "core/bsdf/ggx.h"

namespace pivot::bindings {

namespace {

constexpr Number positive_alpha{.name = "alpha", .low = 0, .open_low = true};
constexpr Number cos_spec{.name = "cos_theta", .low = 0, .high = 1};
constexpr Number ior_spec{.name = "ior", .low = 0, .open_low = true};

/// A unit vector above the surface, z > 0.
struct Above : Direction {
    template <class T>
    void check(const T* value, py::ssize_t size) const {
        Direction::check(value, size);
        if (!(value[2] > T(0))) fail(name, "must lie above the surface, z > 0");
    }
};

}  // namespace

void register_bsdf(py::module_& bsdf) {
    define(
        bsdf, "ggx_eval",
        "ggx_eval(alpha, wo_local, wi_local): D G2 / (4 cos_o), the GGX BRDF times cos_i without Fresnel, per "
        "steradian; 0 for\n"
        "wi_local below the surface.\n\n"
        "alpha (...) > 0; wo_local (..., 3), unit, z > 0; wi_local (..., 3), unit. Height-correlated Smith. [Heitz14]",
        []<class T>(T alpha, const Vec3<T>& wo, const Vec3<T>& wi) {
            return wi.z > T(0) ? ggx_eval(wo, wi, alpha, alpha) : T(0);
        },
        positive_alpha, Above{{"wo_local"}}, Direction{"wi_local"});
    define(
        bsdf, "ggx_pdf", "ggx_pdf(alpha, wo_local, wi_local): the pdf per steradian of ggx_sample.",
        []<class T>(T alpha, const Vec3<T>& wo, const Vec3<T>& wi) { return ggx_pdf_omega(wo, wi, alpha, alpha); },
        positive_alpha, Above{{"wo_local"}}, Direction{"wi_local"});
    define(
        bsdf, "ggx_sample",
        "ggx_sample(alpha, wo_local, u): wo_local mirrored at a visible normal, (..., 3); may lie below the surface, "
        "where the\n"
        "lobe is 0.\n\n"
        "u (..., 2) in [0, 1). [Dupuy23]",
        []<class T>(T alpha, const Vec3<T>& wo, const Vec2<T>& u) { return ggx_sample(wo, alpha, alpha, u); },
        positive_alpha, Above{{"wo_local"}}, UnitSquare{"u"});
    define(
        bsdf, "fresnel_dielectric",
        "fresnel_dielectric(cos_theta, ior): unpolarised reflectance, cos_theta (...) in [0, 1]; ior (...) > 0: of the "
        "other side,\n"
        "over that of the side where the light is.",
        [](auto cos_theta, auto ior) { return fresnel_dielectric(cos_theta, ior); }, cos_spec, ior_spec);
    define(
        bsdf, "f0_from_ior", "f0_from_ior(ior): reflectance at normal incidence, ((ior - 1) / (ior + 1))^2.",
        [](auto ior) { return f0_from_ior(ior); }, ior_spec);
}

}  // namespace pivot::bindings
