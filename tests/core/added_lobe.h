// What test_added_lobe.py adds to the list of lobes: a velvet or dusty surface, brighter or darker towards its edges
// than Lambert. Its BRDF is (cos_i cos_o)^(exponent - 1), scaled. [Minnaert41]
//
// [Minnaert41]  The Reciprocity Principle in Lunar Photometry
#pragma once

#include "core/bsdf/lobe_record.h"

namespace pivot {

template <class T>
struct Minnaert {
    struct Parameters {
        Vec3<T> color{T(1)};  ///< its albedo, seen along the normal
        T exponent = T(1);    ///< 1 is Lambert
    };
    static constexpr std::string_view name = "minnaert";
    static constexpr std::array parameters{LobeParameter{"color", 3, 0.0f, 1.0f},
                                           LobeParameter{"exponent", 1, 1.0f, 100.0f}};
    static constexpr bool reflects = true, transmits = false, has_closed_form = false;

    Vec3<T> seen_color;
    T exponent;

    static Minnaert seen(const Parameters& material, const Vec3<T>& wo_local) {
        return {material.color * pow(wo_local.z, material.exponent - T(1)), material.exponent};
    }
    Vec3<T> eval(const Vec3<T>& wo_local, const Vec3<T>& wi_local) const {
        return seen_color * pdf_omega(wo_local, wi_local);
    }
    T pdf_omega(const Vec3<T>&, const Vec3<T>& wi_local) const {
        return (exponent + T(1)) / (T(2) * pi<T>)*pow(max(wi_local.z, T(0)), exponent);
    }
    Vec3<T> sample(const Vec3<T>&, T, const Vec2<T>& u) const {
        const T z = pow(u.x, T(1) / (exponent + T(1))), phi = T(2) * pi<T> * u.y, radius = safe_sqrt(T(1) - z * z);
        return {radius * cos(phi), radius * sin(phi), z};
    }
    Vec3<T> albedo(const Vec3<T>&) const { return seen_color; }
    Vec3<T> diffuse() const { return seen_color; }
    BaseOf<T> closed_form(const Vec3<T>& wo_local) const {
        return make_base(BaseMaterialOf<T>{.diffuse = seen_color}, wo_local);
    }
    Minnaert blurred(T) const { return *this; }
};

}  // namespace pivot
