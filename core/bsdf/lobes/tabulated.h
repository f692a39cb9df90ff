// A base whose microfacets' normals are distributed as a picture says: its diffuse lobe beneath a highlight of any
// form. The base's alpha means nothing here.
#pragma once

#include "core/bsdf/lobe_record.h"
#include "core/bsdf/lobes/further_base.h"
#include "core/bsdf/tabulated_ndf.h"
#include "core/simd/batch.h"

namespace pivot {

template <class T>
struct Tabulated {
    using Table = TabulatedNdf;
    struct Parameters {
        BaseMaterialOf<T> base;
        AddressOf<T> ndf;
    };
    static constexpr std::string_view name = "tabulated";
    static constexpr auto parameters = FurtherBase<T>::parameters;
    static constexpr bool reflects = true, transmits = false, has_closed_form = false;

    AddressOf<T> ndf;
    Vec3<T> diffuse_color;
    LobeFresnelOf<T> fresnel;
    T glossy_probability;
    Vec3<T> glossy_albedo;

    static Tabulated seen(const Parameters& material, const Vec3<T>& wo_local) {
        const Vec3<T> facets = of_tables(
            material.ndf,
            [](const TabulatedNdf& table, const Vec3f& wo) {
                return Vec3f(table.albedo(wo), table.average_albedo(), table.alpha());
            },
            wo_local);
        BaseMaterialOf<T> as_rough = material.base;
        as_rough.alpha = facets.z;
        const T towards_wo = max(facets.x, T(1e-3f));
        const BaseOf<T> base = make_base(as_rough, wo_local, FacetAlbedoOf<T>{towards_wo, facets.y});
        return {material.ndf, base.diffuse, base.fresnel, base.glossy_probability,
                select(base.has_glossy(), pivot::glossy_albedo(base, towards_wo), Vec3<T>(T(0)))};
    }

    Vec3<T> eval(const Vec3<T>& wo_local, const Vec3<T>& wi_local) const {
        const T facets =
            of_tables(
                ndf, [](const TabulatedNdf& t, const Vec3f& wo, const Vec3f& wi) { return Vec3f(t.eval(wo, wi)); },
                wo_local, wi_local)
                .x;
        const T cos_oh = dot(wo_local, normalize(wo_local + wi_local));
        return eval_diffuse(wo_local, wi_local) + select(facets > T(0), fresnel.at(cos_oh) * facets, Vec3<T>(T(0)));
    }
    Vec3<T> eval_diffuse(const Vec3<T>&, const Vec3<T>& wi_local) const {
        return diffuse_color * (max(wi_local.z, T(0)) * T(1.0f / pi<float>));
    }
    T pdf_omega(const Vec3<T>& wo_local, const Vec3<T>& wi_local) const {
        const T facets = of_tables(
                             ndf,
                             [](const TabulatedNdf& t, const Vec3f& wo, const Vec3f& wi) {
                                 return Vec3f(wi.z > 0.0f ? t.pdf_omega(wo, wi) : 0.0f);
                             },
                             wo_local, wi_local)
                             .x;
        return lerp(max(wi_local.z, T(0)) * T(1.0f / pi<float>), facets, glossy_probability);
    }
    Vec3<T> sample(const Vec3<T>& wo_local, T u_lobe, const Vec2<T>& u) const {
        const Mask<T> is_glossy = u_lobe < glossy_probability;
        const T u_part = clamp01(u_lobe / max(glossy_probability, tiny<T>));
        const Vec3<T> glossy = of_tables(
            ndf,
            [](const TabulatedNdf& t, const Vec3f& wo, const Vec3f& numbers) {
                return t.sample(wo, numbers.x, {numbers.y, numbers.z});
            },
            wo_local, Vec3<T>(u_part, u.x, u.y));
        return select(is_glossy, glossy, sample_cosine_hemisphere(u));
    }
    Vec3<T> albedo(const Vec3<T>&) const { return diffuse_color + glossy_albedo; }
    Vec3<T> diffuse() const { return diffuse_color; }
    BaseOf<T> closed_form(const Vec3<T>& wo_local) const {
        const T alpha = of_tables(ndf, [](const TabulatedNdf& t) { return Vec3f(t.alpha()); }).x;
        return {.wo_local = wo_local,
                .diffuse = diffuse_color,
                .alpha = max(alpha, T(min_alpha)),
                .fresnel = fresnel,
                .glossy_probability = glossy_probability};
    }
    T highlight_probability() const { return glossy_probability; }
    /// A picture stays as sharp as it is.
    Tabulated blurred(T) const { return *this; }

    void add_highlights(HighlightsOf<T>& highlights, const Vec3<T>&, bool) const requires std::same_as<T, float> {
        const auto* table = ndf.template pointer<TabulatedNdf>();
        highlights.beside += mean_component(diffuse_color);
        if (!table || !(glossy_probability > 0.0f)) return;
        constexpr float most_over_fit = 5.0f;
        const HighlightOf<float> all = highlight_about_normal(table->alpha(), fresnel);
        highlights.beside += mean_component(glossy_albedo) * table->fit().error;
        highlights.are_close = highlights.are_close && table->fit().worst < most_over_fit;
        for (const OwnAxes& lobe : table->fit_axes())
            highlights.add(
                {lobe.frame, lobe.alpha_x, lobe.alpha_y, all.fresnel_f0 * lobe.weight, all.fresnel_f90 * lobe.weight},
                true);
    }

   private:
    /// of(table, vectors of a lane...) of each lane that has a table; 0 in the others.
    template <class Of, class... Vectors>
    static Vec3<T> of_tables(const AddressOf<T>& address, const Of& of, const Vectors&... vectors) {
        if constexpr (std::same_as<T, float>) {
            const auto* table = address.template pointer<TabulatedNdf>();
            return table ? of(*table, vectors...) : Vec3f(0.0f);
        } else {
            const auto lanes_of = [](const Vec3b& v) { return std::array{store(v.x), store(v.y), store(v.z)}; };
            const auto pointers = address.template pointers<TabulatedNdf>();
            const auto lanes = std::make_tuple(lanes_of(vectors)...);
            return gather_vector([&](std::size_t i) {
                if (!pointers[i]) return Vec3f(0.0f);
                return std::apply(
                    [&](const auto&... v) { return of(*pointers[i], Vec3f(v[0][i], v[1][i], v[2][i])...); }, lanes);
            });
        }
    }
};

}  // namespace pivot
