// The analytic integrator's shadows: what share of a light is seen, by rays towards fixed points of it. The points are
// the same for every pixel and on every run, so that what they leave out does not flicker.
//
// Evenly spread points are off by sqrt(s (1 - s)) n^(-3/4) where an edge hides 1 - s of a light. So for a light that
// gives some share of a pixel's light, (share sqrt(s (1 - s)) / budget)^(4/3) points keep a penumbra's steps below the
// error budget. The samples of a pixel take these together, each a part. A pixel's only sample asks half of its points
// of every light first, and some on the light's rim, and goes on where these disagree. Samples that have few points
// each ask all of them: to go on by what so few say, and to believe them where they agree, would shift a penumbra.
#pragma once

#include <functional>

#include "core/integrators/passage.h"
#include "core/integrators/surface_batch.h"
#include "core/sampling/sobol.h"
#include "core/scene/scene.h"

namespace pivot {

/// Which of the fixed sets a point belongs to.
enum class PointSet : std::uint32_t {
    light_diffuse = 1,
    light_glossy = 2,
    world_diffuse = 3,
    world_glossy = 4,
    lobe_light = 5,
    lobe_direction = 6,
    lobe_world = 7,
    fog_place = 8,
    fog_lamp = 9,
    first_facet = 10,  ///< and one for each bounce
};

/// The share of a light that is seen, so far.
struct VisibleShare {
    float seen = 0.0f, all = 0.0f, squares = 0.0f;
    Rgb seen_color{0.0f};  ///< of which `seen` is the mean

    /// left: of the light, on its way.
    void add(float weight, const Rgb& left) {
        if (weight == 0.0f) return;  // a ray tells of one lobe, mostly
        all += weight;
        squares += weight * weight;
        seen += weight * mean_of(left);
        seen_color += weight * left;
    }
    float value() const { return all > 0.0f ? seen / all : 1.0f; }
    Rgb color() const { return all > 0.0f ? seen_color / all : Rgb(1.0f); }
    bool is_mixed() const { return seen > 0.0f && seen < all; }
    /// How many points of equal weight say as much.
    float count() const { return squares > 0.0f ? all * all / squares : 0.0f; }
    /// Variance of value() by evenly spread points, whose error falls like count^(-3/4) at an edge.
    float variance() const {
        const bool says_much = is_mixed() && squares > 0.0f;  // which a light too weak for floats leaves 0
        return says_much ? value() * (1.0f - value()) * std::pow(count(), -1.5f) : 0.0f;
    }

   private:
    /// Exact where nothing or all is left.
    static float mean_of(const Rgb& left) {
        return left.x == left.y && left.x == left.z ? left.x : mean_component(left);
    }
};

/// Of one lane, by each lobe's points, and by a few on the light's rim, which an edge that comes over it crosses first.
struct LaneShares {
    VisibleShare diffuse, glossy, rim;

    bool is_mixed() const {
        bool sees = false, misses = false;
        for (const VisibleShare& share : {diffuse, glossy, rim}) {
            sees |= share.seen > 0.0f;
            misses |= share.seen < share.all;
        }
        return sees && misses;
    }
    /// How many of the points are wanted, which are as many as a penumbra wants in the mean.
    float wanted_part() const {
        const auto wanted = [](const VisibleShare& share) {
            return std::pow(6.0f * share.value() * (1.0f - share.value()), 2.0f / 3.0f);
        };
        const bool by_points = diffuse.is_mixed() || glossy.is_mixed();
        return by_points ? std::max(wanted(diffuse), wanted(glossy)) : static_cast<float>(is_mixed());
    }
};

constexpr std::uint32_t rim_points = 8;
/// Point k of a circle's rim, just within the unit circle.
inline Vec2f rim_point(std::uint32_t k) {
    const float angle = 2.0f * pi<float> * static_cast<float>(k) / rim_points;
    return 0.99f * Vec2f(std::cos(angle), std::sin(angle));
}

/// Some of a sample's points, from 0 to 1 in their order.
struct PartOfPoints {
    float begin, end;
    /// More follow if these and the rim do not agree.
    bool asks_rim() const { return begin == 0.0f && end < 1.0f; }
};

/// The part of the sets that one camera sample takes.
class ShadowPoints {
   public:
    ShadowPoints(const RenderSettings& settings, std::uint32_t sample_index)
        : ShadowPoints(points_for(100.0f / settings.error_budget_percent), 0.01f * settings.error_budget_percent,
                       usual_samples(settings), sample_index, settings.max_passages) {}

    /// The same points of a light that casts the shadows of some objects only.
    ShadowPoints past_others(const LightLinks& links) const {
        ShadowPoints points = *this;
        points.links_ = links;
        return points;
    }
    const LightLinks& links() const { return links_; }

    /// Transparent surfaces that a ray to them may pass, and one.
    std::uint32_t max_passages() const { return max_passages_; }

    /// For a light that gives this share of all light.
    ShadowPoints for_share(float share) const {
        ShadowPoints points = *this;
        points.pixel_count_ = pixel_count_ * std::pow(share, 4.0f / 3.0f);
        return points;
    }
    /// The same for points whose weights differ much: a sample's mean of few is shifted, by up to an eighth of a point
    /// or so, which other samples do not make good for. Not so of four.
    ShadowPoints for_share_of_unequal(float share) const {
        const float least_of_sample = std::min(0.125f * share / budget_, 4.0f);
        ShadowPoints points = for_share(share);
        points.pixel_count_ = std::max(points.pixel_count_, least_of_sample * static_cast<float>(samples_));
        return points;
    }

    /// At least so many of each sample.
    ShadowPoints at_least(std::uint32_t of_sample) const {
        ShadowPoints points = *this;
        points.pixel_count_ = std::max(points.pixel_count_, static_cast<float>(of_sample * samples_));
        return points;
    }

    std::uint32_t count() const {
        return std::max(1u, static_cast<std::uint32_t>(std::ceil(pixel_count_ / static_cast<float>(samples_))));
    }

    struct Range {
        std::uint32_t begin, end;
    };
    Range range(const PartOfPoints& part) const { return {first_after(part.begin), first_after(part.end)}; }

    /// What tells, with the rim, whether a light is seen in full, in part or not at all: a part of the pixel's points,
    /// and not of the sample's, which many samples make few. All of them where the rim would cost as many as it saves.
    float first_part() const {
        const float part = std::min(0.5f * static_cast<float>(samples_), 1.0f);
        return static_cast<float>(count()) * (1.0f - part) > rim_points ? part : 1.0f;
    }

    /// Something small in front of a light, half a point's worth, is missed by all points: the variance of the share.
    float missed_variance(const VisibleShare& share) const {
        return share.all > 0.0f ? 0.5f / static_cast<float>(samples_) * std::pow(share.count(), -2.5f) : 0.0f;
    }
    /// Whether an edge that runs near lies between two of a pixel's points in more than one place of 20. Errors are
    /// predicted for the other 19.
    bool may_miss_edge(const LaneShares& shares) const {
        return static_cast<float>(samples_) * (shares.diffuse.count() + shares.glossy.count() + shares.rim.count()) <
               20.0f;
    }

    /// Point k of count().
    Vec2f point(PointSet set, std::uint32_t k) const { return point(set, k, count()); }
    /// Point k of `count` points of a set.
    Vec2f point(PointSet set, std::uint32_t k, std::uint32_t count) const {
        return Sampler{0u, sample_index_ * count + k}.point(static_cast<std::uint32_t>(set));
    }

    /// Which facets the sample's rays go on by after so many bounces.
    Vec2f facet_point(std::uint32_t bounce) const {
        return Sampler{0u, sample_index_}.point(static_cast<std::uint32_t>(PointSet::first_facet) + bounce);
    }

   private:
    ShadowPoints(float pixel_count, float budget, std::uint32_t samples, std::uint32_t sample_index,
                 std::uint32_t max_passages)
        : pixel_count_(pixel_count),
          budget_(budget),
          samples_(samples),
          sample_index_(sample_index),
          max_passages_(max_passages) {}

    /// Adaptive sampling gives a penumbra more than the least; how many is not known before.
    static std::uint32_t usual_samples(const RenderSettings& settings) {
        const auto least = static_cast<float>(even_samples(settings)), most = static_cast<float>(settings.samples);
        return static_cast<std::uint32_t>(std::lround(std::cbrt(least * least * most)));
    }
    /// Of a light that gives so many times what is budgeted. Where a penumbra hides it, s (1 - s) is 1/6 in the mean.
    static float points_for(float budgets) { return std::pow(budgets / std::sqrt(6.0f), 4.0f / 3.0f); }
    std::uint32_t first_after(float part) const {
        return static_cast<std::uint32_t>(std::ceil(part * static_cast<float>(count())));
    }

    float pixel_count_;  ///< of all samples together
    float budget_;       ///< relative
    std::uint32_t samples_, sample_index_, max_passages_;
    LightLinks links_{};
};

/// The largest part that a light's reflection has of any lane's total.
float largest_share(std::span<const Rgb> light, std::span<const float> totals);

/// Rays that tell shares of what they see.
class ShadowRays {
   public:
    struct Probe {
        LaneShares* shares;
        float diffuse, glossy;  ///< weights
        float rim = 0.0f;
        float left = 1.0f;  ///< of light from there if nothing is in its way
    };
    using OnSeen = std::function<void(const Ray&, const Probe&, const Rgb& left)>;

    void add(const Ray& ray, bool is_faced, const Probe& probe);
    /// on_seen: is told of the rays that nothing hides; may be empty.
    void trace(const Scene& scene, const ShadowPoints& points, const OnSeen& on_seen = {});
    /// The same as if nothing were in their way.
    void pass();

   private:
    static void tell(const Probe& probe, const Rgb& left);
    void clear();

    std::vector<Ray> rays_;
    std::vector<Probe> probes_;
    ProgramMemory memory_;
};

/// Adds rays of some of the points of the lanes that want them.
using AddPoints = std::function<void(const PartOfPoints&, std::span<const bool> wanted, ShadowRays& rays)>;

/// Asks points for the share that each lane sees, until they are enough. first_part: asked in any case.
/// shares: of at most batch_size lanes. points: what their rays pass. traces_rays: else nothing is in their way.
void ask_points(const Scene& scene, const ShadowPoints& points, float first_part, std::span<LaneShares> shares,
                const AddPoints& add, const ShadowRays::OnSeen& on_seen = {}, bool traces_rays = true);

/// What each lane reflects of a light towards the viewer, and how far off that may be.
struct Reflection {
    std::array<Rgb, batch_size> diffuse, glossy;
    Lanes diffuse_error, glossy_error;  ///< predicted, relative to each
    Lanes shadow_variance;              ///< what the rays leave of the share that is seen: radiance squared
    std::array<Method, batch_size> method;
};

/// What is left of a reflection where each lane's lobes see these shares.
Reflection seen_in_part(const Reflection& whole, std::span<const LaneShares> shares, const ShadowPoints& points);

}  // namespace pivot
