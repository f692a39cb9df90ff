#include "core/integrators/shadow_points.h"

#include <algorithm>

namespace pivot {
namespace {

/// Whether lanes see neither all nor nothing of a light: then one that does may miss what its neighbours see.
bool is_penumbra(std::span<const LaneShares> shares) {
    float least = 1.0f, most = 0.0f;
    for (const LaneShares& lane : shares) {
        for (const VisibleShare& share : {lane.diffuse, lane.glossy}) {
            if (!(share.all > 0.0f)) continue;
            least = std::min(least, share.value());
            most = std::max(most, share.value());
        }
    }
    return least < 1.0f && most > 0.0f;
}

}  // namespace

float largest_share(std::span<const Rgb> light, std::span<const float> totals) {
    float share = 0.0f;
    for (std::size_t i = 0; i < totals.size(); ++i) {
        const float size = mean_component(abs(light[i]));
        if (size > 0.0f) share = std::max(share, size / std::max(totals[i], size));
    }
    return share;
}

void ShadowRays::add(const Ray& ray, bool is_faced, const Probe& probe) {
    if (is_faced) {
        rays_.push_back(ray);
        probes_.push_back(probe);
    } else {
        tell(probe, Rgb(0.0f));
    }
}

void ShadowRays::tell(const Probe& probe, const Rgb& left) {
    probe.shares->diffuse.add(probe.diffuse, left);
    probe.shares->glossy.add(probe.glossy, left);
    probe.shares->rim.add(probe.rim, left);
}

void ShadowRays::trace(const Scene& scene, const ShadowPoints& points, const OnSeen& on_seen) {
    std::vector<Rgb> left(rays_.size());
    light_along(scene, points.max_passages(), points.links(), rays_, left, memory_);
    for (std::size_t i = 0; i < rays_.size(); ++i) {
        tell(probes_[i], left[i] * probes_[i].left);
        if (on_seen && max_component(left[i]) > 0.0f) on_seen(rays_[i], probes_[i], left[i]);
    }
    clear();
}

void ShadowRays::pass() {
    for (const Probe& probe : probes_) tell(probe, Rgb(probe.left));
    clear();
}

void ShadowRays::clear() {
    rays_.clear();
    probes_.clear();
}

void ask_points(const Scene& scene, const ShadowPoints& points, float first_part, std::span<LaneShares> shares,
                const AddPoints& add, const ShadowRays::OnSeen& on_seen, bool traces_rays) {
    std::array<bool, batch_size> wanted;
    wanted.fill(true);
    ShadowRays rays;
    for (PartOfPoints part{0.0f, first_part};; part = {part.end, std::min(2.0f * part.end, 1.0f)}) {
        add(part, wanted, rays);
        if (traces_rays)
            rays.trace(scene, points, on_seen);
        else
            rays.pass();
        for (std::size_t i = 0; i < shares.size(); ++i) wanted[i] &= shares[i].wanted_part() > part.end;
        if (part.end >= 1.0f || std::none_of(wanted.begin(), wanted.begin() + shares.size(), std::identity())) return;
    }
}

Reflection seen_in_part(const Reflection& whole, std::span<const LaneShares> shares, const ShadowPoints& points) {
    Reflection seen = whole;
    const bool in_penumbra = is_penumbra(shares);
    for (std::size_t i = 0; i < shares.size(); ++i) {
        // A lobe that gives little has no points of its own, and what it sees may be more or less.
        const VisibleShare &diffuse = shares[i].diffuse, &glossy = shares[i].glossy;
        const VisibleShare& of_diffuse = diffuse.all > 0.0f ? diffuse : glossy;
        const VisibleShare& of_glossy = glossy.all > 0.0f ? glossy : diffuse;
        seen.diffuse[i] *= of_diffuse.color();
        seen.glossy[i] *= of_glossy.color();
        if (!(diffuse.all > 0.0f)) seen.diffuse_error[i] += 1.0f - of_diffuse.value();
        if (!(glossy.all > 0.0f)) seen.glossy_error[i] += 1.0f - of_glossy.value();
        const bool may_miss = in_penumbra && points.may_miss_edge(shares[i]);
        const auto deviation = [&](const VisibleShare& share) {
            return std::sqrt(std::max(share.variance(), may_miss ? points.missed_variance(share) : 0.0f));
        };
        seen.shadow_variance[i] = sqr(mean_component(abs(whole.diffuse[i])) * deviation(of_diffuse) +
                                      mean_component(abs(whole.glossy[i])) * deviation(of_glossy));
    }
    return seen;
}

}  // namespace pivot
