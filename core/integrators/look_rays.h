// The rays by which the analytic integrator looks at surfaces: the camera's, and those that go on from mirrors and
// through glass, where closed forms of lights show lamps and virtual lights and leave out what else is to be seen.
//
// A mirror's ray is one of the few that its lobe spreads to; a rough boundary's likewise, which shows as many images of
// what is behind it as the pixel has samples: not of lamps, which would each be seen. The places are fixed, the same
// for every pixel and on every run.
#pragma once

#include <span>
#include <vector>

#include "core/bsdf/surface.h"
#include "core/film/film.h"
#include "core/integrators/arrival.h"

namespace pivot {

struct LookRay {
    Ray ray;
    std::size_t sample;  ///< that it is of
    Rgb worth{1.0f};     ///< of the light along it
    std::uint32_t ray_kind = camera_ray;
    float footprint_m = 0.0f, spread;  ///< how wide its part of a pixel is at the origin, and how much more for each m
    bool meets_lamps = false;          ///< where no closed form shows them and they are seen whole
    bool is_spread = false;            ///< whether a rough boundary might have sent it elsewhere
    std::uint32_t from = no_instance;  ///< whose surface it comes to, for what lights that one
};

/// A surface that a ray met.
struct LookedAt {
    Arrival arrival;
    std::size_t sample;
    Rgb worth;
    float spread;
    bool is_spread;
    SurfacePoint point;
    Surface surface;
};

/// Adds what a ray brings. is_spread: the ray's; then as much may be missing, or too much, in one sample.
inline void add_light(const Rgb& light, bool is_spread, Sample& sample) {
    sample.radiance += light;
    if (is_spread) sample.shadow_variance += sqr(mean_component(abs(light)));
}

/// Where few rays tell of all that a lobe reflects.
inline bool is_smooth(float alpha) { return alpha <= 0.01f; }

/// Whether rays show what a base's highlight reflects of surfaces and the world.
inline bool is_mirror(const Base& base) { return base.has_glossy() && is_smooth(base.alpha); }

/// Whether a lobe is the inner side of a boundary, to which no light comes straight from without: rays alone show what
/// it reflects.
template <class L>
bool is_seen_from_within(const L& lobe) {
    if constexpr (requires { lobe.eta; })
        return lobe.eta < 1.0f;
    else
        return false;
}

/// Appends the rays that go on from a surface. u: in [0, 1)^2, which facets they go by.
void look_on(const LookedAt& from, const Vec2f& u, std::vector<LookRay>& rays);

}  // namespace pivot
