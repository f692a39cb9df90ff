// What layers of a surface reflect of light, and what they leave to those beneath them. Normals in world space.
#include "core/bsdf/base.h"
#include "core/bsdf/thin_film.h"
#include "core/shaders/ops/tables.h"
#include "core/tables/ggx_albedo.h"
#include "core/tables/sheen_ltc.h"

namespace pivot {
namespace {

Batch cosine(const Place& place, const Vec3b& normal) {
    return min(max(abs(dot(place.lanes.wo, normal)), Batch(1e-5f)), Batch(1.0f));
}

/// What a layer of fibres reflects where all light around is 1.
Batch sheen_albedo(const Place& place, const Vec3b& normal, Batch roughness) {
    return sheen_ltc(roughness, cosine(place, normal)).albedo;
}

/// Of a rough dielectric that lies over something else, as the viewer sees it.
struct Layer {
    BaseMaterialOf<Batch> material;
    Vec3b wo_local;

    Layer(const Place& place, const Vec3b& normal, Batch alpha, Batch ior, const Vec3b& f0_tint, Batch multiscatter)
        : material{.diffuse = Vec3b(Batch(1.0f)),
                   .alpha = alpha,
                   .dielectric_weight = Batch(1.0f),
                   .dielectric_ior = ior,
                   .dielectric_tint = f0_tint,
                   .multiscatter = multiscatter} {
        const Batch one(1.0f), most(1.0f - 0x1p-24f), least(1e-4f);
        const Vec3b& wo = place.lanes.wo;
        const Batch cosine = min(max(dot(wo, reflecting_normal(place.normal_geometric, wo, normal)), least), one);
        wo_local = {sqrt(one - min(cosine * cosine, most)), Batch(0.0f), cosine};
    }
};

/// What a rough dielectric about a normal leaves of light beneath it, as a base leaves it to its diffuse lobe; and how
/// far light from the viewer goes in it, over its thickness.
std::tuple<Batch, Batch> dielectric_layer(const Place& place, const Vec3b& normal, Batch alpha, Batch ior,
                                          const Vec3b& f0_tint, Batch multiscatter) {
    const Batch one(1.0f), most(1.0f - 0x1p-24f);
    const Layer layer(place, normal, alpha, max(ior, one), f0_tint, multiscatter);
    const Batch cosine = layer.wo_local.z;
    const Batch sine2 = (one - cosine * cosine) / (layer.material.dielectric_ior * layer.material.dielectric_ior);
    return {make_base(layer.material, layer.wo_local).diffuse.x, one / sqrt(one - min(sine2, most))};
}

/// The first of these where a thin film is on the dielectric: as if that mirrored at its normal alone, but keeps as
/// much light as without a film. [Cycles 4.5 closure/bsdf_microfacet.h, bsdf_microfacet_estimate_albedo]
Batch thin_film_layer(const Place& place, const Vec3b& normal, Batch alpha, Batch ior, const Vec3b& f0_tint,
                      Batch multiscatter, Batch film_ior, Batch film_nm) {
    const Batch one(1.0f);
    const Layer layer(place, normal, alpha, max(ior, Batch(1.0001f)), f0_tint, multiscatter);
    const BaseOf<Batch> base = make_base(layer.material, layer.wo_local);
    const Batch single = select(multiscatter > Batch(0.0f), ggx_albedo(base.alpha, layer.wo_local.z), one);
    const ThinFilmOf<Batch> film{film_ior, film_nm};
    const Vec3b mirrored = thin_film_reflectance(layer.wo_local.z, base.fresnel.ior, film, f0_tint);
    return max(one - max_component(mirrored * base.fresnel.dielectric_f90) * single, Batch(0.0f));
}

/// What a wall of glass, too thin to bend light, mirrors and lets through, with all that its two sides mirror to each
/// other; tint: what of light that crosses it straight is left. [Cycles 5.2 closure/bsdf_microfacet.h,
/// bsdf_thin_glass_fresnel]
std::tuple<Vec3b, Vec3b> thin_wall(const Place& place, const Vec3b& normal, Batch ior, const Vec3b& f0_tint,
                                   const Vec3b& tint, Batch film_ior, Batch film_nm) {
    const Batch one(1.0f);
    const Vec3b white(one);
    const Batch cos_i = cosine(place, normal), eta = select(abs(ior - one) < Batch(1e-4f), Batch(1.0001f), ior);
    const ThinFilmOf<Batch> film{film_ior, film_nm};
    const Vec3b f0 = min(f0_from_ior(eta) * f0_tint, white);
    const Vec3b bare = f0 + (white - f0) * fresnel_dielectric_weight(cos_i, eta);
    const Vec3b once = select(film.is_there(), thin_film_reflectance(cos_i, eta, film, f0_tint), bare);
    const Batch cos_t = sqrt(max(one - (one - cos_i * cos_i) / (eta * eta), Batch(0.0f)));
    const auto crossed = [&](Batch straight) {
        return select(cos_t > Batch(1e-4f), exp(log(max(straight, Batch(1e-6f))) / max(cos_t, Batch(1e-4f))),
                      Batch(0.0f));
    };
    const Vec3b left(crossed(tint.x), crossed(tint.y), crossed(tint.z)), again = once * left;
    const Vec3b through = left * (white - once) * (white - once) / max(white - again * again, Vec3b(Batch(1e-6f)));
    return {once + through * again, through};
}

constexpr std::array ops{
    op<sheen_albedo>("sheen_albedo"),
    op<thin_wall>("thin_wall"),
    op<dielectric_layer>("dielectric_layer"),
    op<thin_film_layer>("thin_film_layer"),
};

}  // namespace

std::span<const OpKind> layer_ops() { return ops; }

}  // namespace pivot
