// What layers of a surface reflect of light, and what they leave to those beneath them. Normals in world space.
#include "core/bsdf/base.h"
#include "core/shaders/ops/tables.h"
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

/// What a rough dielectric about a normal leaves of light beneath it, as a base leaves it to its diffuse lobe; and how
/// far light from the viewer goes in it, over its thickness.
std::tuple<Batch, Batch> dielectric_layer(const Place& place, const Vec3b& normal, Batch alpha, Batch ior,
                                          const Vec3b& f0_tint, Batch multiscatter) {
    const Batch one(1.0f), most(1.0f - 0x1p-24f), least(1e-4f);
    const Vec3b& wo = place.lanes.wo;
    const Batch cosine = min(max(dot(wo, reflecting_normal(place.normal_geometric, wo, normal)), least), one);
    const BaseMaterialOf<Batch> layer{.diffuse = Vec3b(one),
                                      .alpha = alpha,
                                      .dielectric_weight = one,
                                      .dielectric_ior = max(ior, one),
                                      .dielectric_tint = f0_tint,
                                      .multiscatter = multiscatter};
    const Vec3b wo_local(sqrt(one - min(cosine * cosine, most)), Batch(0.0f), cosine);
    const Batch sine2 = (one - cosine * cosine) / (layer.dielectric_ior * layer.dielectric_ior);
    return {make_base(layer, wo_local).diffuse.x, one / sqrt(one - min(sine2, most))};
}

constexpr std::array ops{
    op<sheen_albedo>("sheen_albedo"),
    op<dielectric_layer>("dielectric_layer"),
};

}  // namespace

std::span<const OpKind> layer_ops() { return ops; }

}  // namespace pivot
