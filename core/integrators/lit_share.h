// What the rules of lights leave of their light.
#pragma once

#include "core/bsdf/surface_parts.h"
#include "core/integrators/light_lanes.h"
#include "core/integrators/vertex_lights.h"

namespace pivot {

/// The share of what a surface reflects of light from wi that is by reflections which the light is there for. Glass is
/// lit unless it is to be lit neither way, as in Cycles.
Rgb lit_share(const LightRules& rules, const Surface& surface, const Vec3f& wi_local);

/// Whether a light is there for what it would light.
inline bool is_for(const Scene& scene, const LightLinks& light, std::uint32_t instance) {
    return instance == no_instance || is_receiver(light, scene.link_sets_of(instance));
}

/// Takes from samples of the picked lights, at vertices of a bounce on those instances, what the lights' rules say.
/// Returns where light comes through whatever is in its way.
BatchMask obey_rules(const Scene& scene, std::uint32_t bounce, const VertexBatch& vertices, const WordBatch& instances,
                     const LightPicks& picks, LightSampleOf<Batch>& samples);

}  // namespace pivot
