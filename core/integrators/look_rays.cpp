#include "core/integrators/look_rays.h"

namespace pivot {
namespace {

/// What is worth less is not looked at: a second reflection in glass.
constexpr float least_worth = 1.0f / 512.0f;

void look(const LookedAt& from, const FacetRayOf<float>& facet, bool is_smooth, bool meets_lamps,
          std::vector<LookRay>& rays) {
    const Rgb worth = from.worth * facet.worth;
    if (!(mean_component(worth) > least_worth)) return;
    const Vec3f wi = from.point.frame.to_world(facet.wi_local);
    const bool is_refracted = facet.wi_local.z < 0.0f;
    if (!from.point.faces(is_refracted ? -wi : wi)) return;
    rays.push_back({.ray = {.origin = from.point.ray_origin(wi), .direction = wi, .time = from.point.time},
                    .sample = from.sample,
                    .worth = worth,
                    .ray_kind = (is_refracted ? transmission_ray : glossy_ray) | (from.arrival.ray_kind & ~ray_kinds),
                    .footprint_m = from.arrival.footprint_m,
                    .spread = from.spread,
                    .meets_lamps = meets_lamps && is_smooth && !from.is_spread,
                    .is_spread = from.is_spread || !is_smooth,
                    .from = from.arrival.hit.instance});
}

}  // namespace

void look_on(const LookedAt& from, const Vec2f& u, std::vector<LookRay>& rays) {
    if (is_mirror(from.surface)) look(from, facet_ray<float>(from.surface, u), true, false, rays);
    for_each_lobe(from.surface, [&]<class L>(const L& lobe, const LobeOf<float>&, bool) {
        if constexpr (requires { lobe.facet_rays(from.surface.wo_local, u); }) {
            const auto [mirrored, refracted] = lobe.facet_rays(from.surface.wo_local, u);
            const bool smooth = is_smooth(lobe.alpha), within = is_seen_from_within(lobe);
            if (smooth || within) look(from, mirrored, smooth, within, rays);
            look(from, refracted, smooth, true, rays);
        } else if constexpr (L::has_closed_form && L::reflects) {
            const Base base = lobe.closed_form(from.surface.wo_local);
            if (is_mirror(base)) look(from, facet_ray(base, u), true, false, rays);
        }
    });
}

}  // namespace pivot
