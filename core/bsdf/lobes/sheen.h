// A thin layer of upright fibres that scatter light among them: bright towards the edges. Blender's Sheen BSDF,
// microfiber, and Principled's sheen from 4.0 on; what is beneath is darkened by whoever puts it there.
//
// [Zeltner22]  Practical Multiple-Scattering Sheen Using Linearly Transformed Cosines; the table is our own fit of its
// layer.
#pragma once

#include "core/bsdf/base.h"
#include "core/bsdf/highlight.h"
#include "core/bsdf/lobe_record.h"
#include "core/tables/sheen_ltc.h"

namespace pivot {

template <class T>
struct Sheen {
    struct Parameters {
        Vec3<T> color{T(1)};  ///< what of the light that it scatters back is left
        T roughness = T(0.5f);
    };
    static constexpr std::string_view name = "sheen";
    static constexpr std::array parameters{LobeParameter{"color", 3, 0.0f, std::numeric_limits<float>::max()},
                                           LobeParameter{"roughness", 1, 0.0f, 1.0f}};
    static constexpr bool reflects = true, transmits = false, has_closed_form = false, is_diffuse = true;

    Vec3<T> reflected;
    SheenLtc<T> ltc;

    static Sheen seen(const Parameters& material, const Vec3<T>& wo_local) {
        const SheenLtc<T> ltc = sheen_ltc(material.roughness, wo_local.z);
        return {material.color * ltc.albedo, ltc};
    }
    Vec3<T> eval(const Vec3<T>& wo_local, const Vec3<T>& wi_local) const {
        return reflected * pdf_omega(wo_local, wi_local);
    }
    T pdf_omega(const Vec3<T>& wo_local, const Vec3<T>& wi_local) const {
        const Vec2<T> x = towards(wo_local);
        const T along = wi_local.x * x.x + wi_local.y * x.y, across = wi_local.y * x.x - wi_local.x * x.y;
        const T z = max(wi_local.z, T(0));
        const T length2 = sqr(ltc.a * along + ltc.b * z) + sqr(ltc.a * across) + z * z;
        return z * T(1.0f / pi<float>) * sqr(ltc.a / max(length2, T(1e-12f)));
    }
    Vec3<T> sample(const Vec3<T>& wo_local, T, const Vec2<T>& u) const {
        const Vec2<T> x = towards(wo_local);
        const Vec3<T> cosine = sample_cosine_hemisphere(u);
        const Vec3<T> turned =
            normalize(Vec3<T>(cosine.x - ltc.b * cosine.z, cosine.y, ltc.a * max(cosine.z, T(1e-6f))));
        return {turned.x * x.x - turned.y * x.y, turned.x * x.y + turned.y * x.x, turned.z};
    }
    Vec3<T> albedo(const Vec3<T>&) const { return reflected; }
    Vec3<T> diffuse() const { return reflected; }
    BaseOf<T> closed_form(const Vec3<T>& wo_local) const {
        return make_base(BaseMaterialOf<T>{.diffuse = reflected}, wo_local);
    }
    void add_highlights(HighlightsOf<T>& highlights, const Vec3<T>&, const Mask<T>& where) const {
        constexpr float least_a = 0.3f;  // the lobe is up to 1 / a^2 times Lambert's
        highlights.are_close = highlights.are_close && !(where && ltc.a < T(least_a));
    }
    Sheen blurred(T) const { return *this; }

   private:
    /// Where the viewer is, along the surface.
    static Vec2<T> towards(const Vec3<T>& wo_local) {
        const T length2 = wo_local.x * wo_local.x + wo_local.y * wo_local.y;
        const Mask<T> is_tilted = length2 > T(1e-12f);
        const T scale = T(1) / sqrt(select(is_tilted, length2, T(1)));
        return {select(is_tilted, wo_local.x * scale, T(1)), select(is_tilted, wo_local.y * scale, T(0))};
    }
};

}  // namespace pivot
