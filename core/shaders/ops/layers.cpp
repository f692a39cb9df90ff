// What layers of a surface leave of all beneath them, as it is seen: 1 less what they reflect. Normals in world space.
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

/// Beneath the base's dielectric of this alpha and index; the tint is of its reflectance at normal incidence. settings:
/// whether its microfacets scatter light on.
Batch under_dielectric(Settings<1> settings, const Place& place, const Vec3b& normal, Batch alpha, Batch ior,
                       const Vec3b& tint) {
    const BaseMaterialOf<Batch> material{.diffuse = Vec3b(Batch(1.0f)),
                                         .alpha = alpha,
                                         .dielectric_weight = Batch(1.0f),
                                         .dielectric_ior = max(ior, Batch(1.0f)),
                                         .dielectric_tint = tint,
                                         .multiscatter = Batch(settings[0])};
    const Batch cos_o = cosine(place, normal);
    return make_base(material, Vec3b(safe_sqrt(Batch(1.0f) - cos_o * cos_o), Batch(0.0f), cos_o)).diffuse.x;
}

constexpr std::array ops{
    op<sheen_albedo>("sheen_albedo"),
    op<under_dielectric>("under_dielectric"),
};

}  // namespace

std::span<const OpKind> layer_ops() { return ops; }

}  // namespace pivot
