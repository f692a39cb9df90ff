#include "core/integrators/lit_share.h"

namespace pivot {

Rgb lit_share(const LightRules& rules, const Surface& surface, const Vec3f& wi_local) {
    constexpr std::uint32_t glass = visible_to_glossy | visible_to_transmission, all = visible_to_diffuse | glass;
    if ((rules.lights & all) == all) return Rgb(1.0f);
    const SurfacePartsOf<float> parts = eval_parts(surface, wi_local);
    Rgb lit(0.0f);
    if (rules.lights & visible_to_diffuse) lit += parts.diffuse;
    if (rules.lights & visible_to_glossy) lit += parts.glossy;
    if (rules.lights & glass) lit += parts.glass;
    return lit / max(parts.sum(), Rgb(tiny<float>));
}

BatchMask obey_rules(const Scene& scene, std::uint32_t bounce, const VertexBatch& vertices, const WordBatch& instances,
                     const LightPicks& picks, LightSampleOf<Batch>& samples) {
    std::array<std::uint32_t, batch_size> instance;
    instances.store_unaligned(instance.data());
    const Lanes brought = store(max_component(abs(samples.radiance)));
    const Lanes x = store(samples.wi.x), y = store(samples.wi.y), z = store(samples.wi.z);
    Lanes shadowed;
    shadowed.fill(1.0f);
    const Vec3b left = gather_vector([&](std::size_t i) {
        if (i >= vertices.count() || !(brought[i] > 0.0f)) return Rgb(0.0f);
        const LightRules& rules = scene.rules_of(picks.light[i]);
        if (!rules.casts_shadows) shadowed[i] = 0.0f;
        if (bounce > rules.max_bounces || !is_for(scene, rules.links, instance[i])) return Rgb(0.0f);
        const Vertex& vertex = vertices.lane(i);
        return lit_share(rules, vertex.surface, vertex.point.frame.to_local({x[i], y[i], z[i]}));
    });
    samples.radiance = samples.radiance * left;
    return load(shadowed) < Batch(0.5f);
}

}  // namespace pivot
