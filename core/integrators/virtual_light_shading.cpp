#include "core/integrators/virtual_light_shading.h"

#include "core/integrators/light_view.h"
#include "core/integrators/passage.h"
#include "core/integrators/turning_light.h"
#include "core/sampling/sobol.h"
#include "core/shading/ggx_gaussian_light.h"

namespace pivot {
namespace {

/// Lights are seen as one where the variance of the directions that they come from is below this, in rad^2.
constexpr float largest_variance = 0.005f;
/// Or below this part of a lobe's own, and of the squared angle between it and them.
constexpr float part_of_lobe = 0.2f, part_of_distance = 0.1f;
/// What of all its light a light gives a point: from where on its error counts, it is worth caps, and a ray.
constexpr float share_to_open = 0.005f, share_for_caps = 0.004f, share_for_rays = 0.002f;
/// All of these are for this error budget, relative.
constexpr float usual_budget = 0.02f;
/// What lights seen as one are off by, relative to their light, where their variance is as much as is allowed: of
/// clusters, and of leaves, which are no finer.
constexpr float error_of_cluster = 0.08f, most_error_of_cluster = 0.4f;
/// And what lights that glossy surfaces send on are off by in any case: a Gaussian of places and one of directions do
/// not know that the one goes with the other.
constexpr float error_of_glossy_cell = 0.07f;
/// What mean_clamped_cosine is off by.
constexpr float error_of_cosine = 0.02f;
/// A leaf that gives more than share_to_open is seen as its quarters where it is nearer than this, rad^2, and these as
/// theirs, so often at most: as a Gaussian it shines from where it is not, and not enough from where it touches.
constexpr float near_variance = 0.1f;
/// And where they are wider than this part of a lobe's variance, that it sends on or that reflects it, and of the
/// squared angle between this one and them.
constexpr float near_part_of_lobe = 0.3f, near_part_of_distance = 0.03f;
constexpr int most_quarterings = 3;
/// What of lights' light is taken to be further than a deviation from their mean.
constexpr float part_of_few = 0.1f;
/// And for a first look at how much light there is.
constexpr float rough_variance = 0.3f;
constexpr std::uint32_t rays_per_light = 2;
/// No light seems smaller than this, rad^2: sharpness has an end.
constexpr float least_variance = 1e-7f;

/// A light of the cut, with what each lane reflects of one watt of it.
struct CutLight {
    const VirtualLight* light;
    SphericalGaussian<Batch> seen;  ///< in the shading frame
    Batch scale;                    ///< of its radiance
    Batch diffuse;
    LobeSums<Batch> glossy;
    Batch visible = Batch(1.0f);
    Batch glossy_error = Batch(0.0f);   ///< of the closed form, relative
    Batch cluster_error = Batch(0.0f);  ///< of taking lights together, relative
};

class LightCut {
   public:
    LightCut(const SurfaceBatch& batch, const RenderSettings& settings, std::uint32_t turn)
        : batch_(batch),
          budget_(budget_of(settings)),
          fineness_(std::clamp(0.01f * settings.error_budget_percent / usual_budget, 0.05f, 10.0f)),
          method_(settings.virtual_light_method),
          turn_(turn) {
        if (batch.has_glossy) receiver_.emplace(batch.lobe);
        for (std::size_t i = 0; i < batch_size; ++i) normals_[i] = batch.lanes[i]->surface.bump.normal;
        normal_ = gather_vector([&](std::size_t i) { return normals_[i]; });
        normal_geometric_ = gather_vector([&](std::size_t i) { return batch.lanes[i]->point.normal_geometric; });
        const auto mean_f = [](const Base& s) {
            return s.has_glossy() ? mean_component(s.fresnel.schlick_f0 + s.fresnel.dielectric_f0) : 0.0f;
        };
        glossy_weight_ = gather([&](std::size_t i) { return mean_f(batch.lanes[i]->surface); });
        diffuse_weight_ = gather([&](std::size_t i) { return mean_component(batch.lanes[i]->surface.diffuse); });
        size_ = glossy_weight_ + diffuse_weight_;
    }

    /// Cuts both trees: roughly, for about how much light there is in all, and then as that says.
    void cut(const VirtualLightTree& diffuse, const VirtualLightTree& glossy) {
        const Batch one(1.0f);
        const auto in_both = [&](const auto& of_tree) {
            if (!diffuse.empty()) of_tree(diffuse, false);
            if (!glossy.empty()) of_tree(glossy, true);
        };
        total_ = Batch(0.0f);
        Batch sum(0.0f);
        in_both([&](const VirtualLightTree& tree, bool is_glossy) {
            cut_tree(
                tree, tree.lights[0], is_glossy, one,
                [&](const VirtualLight&, const LightView&) { return Batch(rough_variance); },
                [&](const VirtualLight& light, const LightView& view, const Batch& weight) {
                    sum += weight * estimate(light, is_glossy, view);
                });
        });
        total_ = sum;
        in_both([&](const VirtualLightTree& tree, bool is_glossy) {
            cut_tree(
                tree, tree.lights[0], is_glossy, one,
                [&](const VirtualLight& light, const LightView& view) {
                    return allowed_variance(light, is_glossy, view);
                },
                [&](const VirtualLight& light, const LightView& view, const Batch& weight) {
                    add_near(tree.pieces_of(light), light, is_glossy, view, weight);
                });
        });
    }

    /// What both lobes reflect of each light, the better the more it is of all.
    void refine() {
        Batch total(0.0f);
        for (const CutLight& cut : cut_) total += size_of(cut);
        total_ = total;
        if (!receiver_ || method_ != VirtualLightMethod::automatic) return;
        const Batch least = Batch(share_for_caps * fineness_) * total;
        for (CutLight& cut : cut_) {
            const BatchMask wide = is_wide(*receiver_, cut.seen);
            const BatchMask matters = !wide && glossy_size_of(cut) > least && least > Batch(0.0f);
            if (!any(matters)) continue;
            const LobeSums<Batch> caps = integrate_by_caps(*receiver_, cut.seen, budget_) * cut.scale;
            cut.glossy = select<Batch>(matters, caps, cut.glossy);
            cut.glossy_error = select(matters, Batch(error_of_gaussian_caps), cut.glossy_error);
        }
    }

    /// A few shadow rays to each light that matters; the rest is seen as these are in the mean.
    void trace(const Scene& scene, std::uint32_t max_passages, const LightLinks& links) {
        const ShadowPath shadow_path{max_passages, 0, WordBatch(camera_ray)};
        ProgramMemory memory;
        const Batch zero(0.0f);
        Batch seen(0.0f), all(0.0f);
        std::vector<BatchMask> asked(cut_.size());
        const Batch error_m = gather([&](std::size_t i) { return batch_.lanes[i]->point.error_m; });
        const Batch time = gather([&](std::size_t i) { return batch_.lanes[i]->point.time; });
        const Vec3b origin = batch_.position + normal_geometric_ * error_m;
        for (std::size_t first = 0, last = 0; first < cut_.size(); first = last) {
            // Pieces of a light share its rays.
            const VirtualLight& light = *cut_[first].light;
            Batch size(0.0f), visible(0.0f);
            for (; last < cut_.size() && cut_[last].light == &light; ++last) size += size_of(cut_[last]);
            const BatchMask wanted = size > Batch(share_for_rays * fineness_) * total_ && first_lanes(batch_.count);
            std::fill(asked.begin() + std::ptrdiff_t(first), asked.begin() + std::ptrdiff_t(last), wanted);
            if (!any(wanted)) continue;
            for (std::uint32_t ray = 0; ray < rays_per_light; ++ray) {
                const PlaceInView place =
                    place_in_view(batch_, normal_geometric_, light, wanted, turn_ * rays_per_light + ray);
                RayOf<Batch> rays{origin, place.wi, zero,
                                  select(place.is_faced && wanted, place.distance_m * Batch(0.999f), zero), time};
                // Light from places that are all behind the surface comes through it.
                const Vec3b left = light_left(scene, rays, links, shadow_path, memory);
                visible += select(place.is_faced, mean_component(left), zero) * Batch(1.0f / rays_per_light);
            }
            for (std::size_t k = first; k < last; ++k) cut_[k].visible = visible;
            seen += select(wanted, size * visible, zero);
            all += select(wanted, size, zero);
        }
        share_seen_ = select(all > zero, seen / max(all, tiny<Batch>), Batch(1.0f));
        for (std::size_t k = 0; k < cut_.size(); ++k) cut_[k].visible = select(asked[k], cut_[k].visible, share_seen_);
    }

    std::array<VirtualReflection, batch_size> result() const {
        std::array<VirtualReflection, batch_size> result;
        std::array<Batch, 3> diffuse;
        std::array<LobeSums<Batch>, 3> glossy;
        diffuse.fill(Batch(0.0f));
        Batch error(0.0f), shadow_variance(0.0f), all(0.0f);
        for (const CutLight& cut : cut_) {
            for (int c = 0; c < 3; ++c) {
                const auto channel = static_cast<std::size_t>(c);
                const Batch power = Batch(cut.light->power_w[c]) * cut.visible;
                diffuse[channel] += power * cut.diffuse;
                glossy[channel] += cut.glossy * power;
            }
            const Batch size = size_of(cut), of_glossy = glossy_size_of(cut);
            all += size * cut.visible;
            error += cut.visible * (of_glossy * cut.glossy_error + Batch(error_of_cosine) * (size - of_glossy) +
                                    size * cut.cluster_error);
            shadow_variance += sqr(size) * share_seen_ * (Batch(1.0f) - share_seen_);
        }
        const Batch scale = inverse(max(all, tiny<Batch>));
        const Lanes errors = store(error * scale), deviations = store(sqrt(shadow_variance) * scale);
        for (std::size_t i = 0; i < batch_size; ++i)
            result[i].error = errors[i], result[i].shadow_deviation = deviations[i];
        for (std::size_t c = 0; c < 3; ++c) {
            const Lanes d = store(diffuse[c]), plain = store(glossy[c].plain), schlick = store(glossy[c].schlick),
                        dielectric = store(glossy[c].dielectric);
            for (std::size_t i = 0; i < batch_size; ++i) {
                result[i].diffuse[c] = d[i];
                result[i].glossy[c] = {plain[i], schlick[i], dielectric[i]};
            }
        }
        return result;
    }

   private:
    Batch glossy_size_of(const CutLight& cut) const {
        return cut.glossy.plain * glossy_weight_ * Batch(mean_component(abs(cut.light->power_w)));
    }
    Batch size_of(const CutLight& cut) const {
        return glossy_size_of(cut) +
               cut.diffuse * diffuse_weight_ * Batch(mean_component(abs(cut.light->power_w)) / pi<float>);
    }
    /// The squared distance of a light's direction from the mirrored view's, on the sphere.
    Batch from_mirror2(const LightView& view) const {
        const Vec3b& wo = batch_.lobe.wo_local;
        return length_squared(view.wi - Vec3b(-wo.x, -wo.y, wo.z));
    }
    /// About the most that lights reflect.
    Batch estimate(const VirtualLight& light, bool is_glossy, const LightView& view) const {
        const Batch one(1.0f), zero(0.0f), deviation = sqrt(view.variance);
        Batch emitted;
        if (is_glossy) {
            const Batch width = inverse(Batch(1.0f / std::max(light.sharpness, 0.1f)) + view.variance);
            emitted = Batch(light.sharpness / (2.0f * pi<float>)) * exp(width * (view.facing - one));
        } else {
            const Batch spread(1.0f / std::sqrt(std::max(light.sharpness, 1.0f)));
            emitted = Batch(1.0f / pi<float>) * clamp01(view.facing + deviation + spread);
        }
        // Few of the lights together may be before the surface while most are behind it.
        const Batch few = light.child_count > 0 ? Batch(part_of_few) * clamp01(view.wi.z + view.reach) : zero;
        Batch reflected = Batch(1.0f / pi<float>) * diffuse_weight_ * max(clamp01(view.wi.z + deviation), few);
        if (receiver_) {
            const Batch apart2 = from_mirror2(view);
            const Batch width = inverse(inverse(receiver_->sharpness) + view.variance);
            // GGX's tails are longer than a Gaussian's.
            reflected +=
                glossy_weight_ * width * Batch(0.5f / pi<float>) * inverse(sqr(one + Batch(0.25f) * width * apart2));
        }
        return select(size_ > zero,
                      Batch(mean_component(abs(light.power_w))) * emitted * reflected *
                          inverse(view.distance2 * (one + view.variance)),
                      zero);
    }

    /// The variance of directions up to which lights that are all there is may be taken together.
    Batch usual_variance(const VirtualLight& light, bool is_glossy, const LightView& view) const {
        Batch allowed(largest_variance);
        if (receiver_) {
            const Batch apart2 = from_mirror2(view);
            const Batch of_lobe =
                Batch(part_of_lobe) * inverse(receiver_->sharpness) + Batch(part_of_distance) * apart2;
            allowed = select(glossy_weight_ > Batch(0.0f), min(allowed, of_lobe), allowed);
        }
        if (is_glossy) {
            // Further from where they shine than their axes reach, all give nothing.
            const Batch apart2 = Batch(2.0f) - Batch(2.0f) * view.facing;
            const Batch beyond = max(apart2 - Batch(8.0f / std::max(light.sharpness, 1e-3f)), Batch(0.0f));
            allowed = min(allowed, Batch(part_of_lobe / light.lobe_sharpness) + Batch(part_of_distance) * beyond);
        }
        return allowed;
    }

    /// The same by the budget. What is little of all may be off by more.
    Batch allowed_variance(const VirtualLight& light, bool is_glossy, const LightView& view) const {
        const Batch little =
            Batch(share_to_open) * total_ * inverse(max(estimate(light, is_glossy, view), tiny<Batch>));
        return Batch(fineness_) * usual_variance(light, is_glossy, view) * max(Batch(1.0f), little);
    }

    /// visit(light, view, weight): each light of a cut, and how much it counts in each lane.
    template <class Allowed, class Visit>
    void cut_tree(const VirtualLightTree& tree, const VirtualLight& light, bool is_glossy, const Batch& weight,
                  const Allowed& allowed, const Visit& visit) const {
        const Batch zero(0.0f), one(1.0f);
        const LightView view = view_of(batch_, light);
        if (is_dark(light, is_glossy, view, size_ > Batch(0.0f))) return;
        Batch together = weight;
        if (light.child_count > 0) {
            const Batch apart = smoothstep(Batch(2.0f) * view.variance * inverse(allowed(light, view)) - one);
            together = weight * (one - apart);
            const Batch below = weight * apart;
            if (any(below > zero))
                for (std::uint32_t i = 0; i < light.child_count; ++i)
                    cut_tree(tree, tree.lights[light.first_child + i], is_glossy, below, allowed, visit);
        }
        if (any(together > zero)) visit(light, view, together);
    }

    /// Up to which variance of directions a leaf is one Gaussian.
    Batch near_variance_of(const VirtualLight& light, bool is_glossy, const LightView& view) const {
        Batch near(is_glossy ? std::min(near_variance, near_part_of_lobe / light.sharpness) : near_variance);
        if (receiver_) {
            const Batch of_lobe = Batch(near_part_of_lobe) * inverse(receiver_->sharpness) +
                                  Batch(near_part_of_distance) * from_mirror2(view);
            near = select(glossy_weight_ > Batch(0.0f), min(near, of_lobe), near);
        }
        return near;
    }

    /// A light as its pieces where it is near; `piece` is one, of which there are 4^quarterings.
    void add_near(const LightPieces* pieces, const VirtualLight& light, bool is_glossy, const LightView& view,
                  const Batch& weight, int quarterings = 0, std::size_t index = 0, const LightPiece& piece = {}) {
        const Batch zero(0.0f), one(1.0f);
        Batch together = weight;
        if (pieces && quarterings < most_quarterings) {
            const BatchMask matters = weight * estimate(light, is_glossy, view) > Batch(share_to_open) * total_;
            const Batch near =
                smoothstep(Batch(2.0f) * view.variance * inverse(near_variance_of(light, is_glossy, view)) - one);
            const Batch below = select(matters, weight * near, zero);
            together = weight - below;
            for (std::size_t k = 0; k < 4 && any(below > zero); ++k) {
                const std::size_t part_index = 4 * index + k;
                const LightPiece part = quarterings == 0   ? pieces->quarters[part_index]
                                        : quarterings == 1 ? pieces->sixteenths[part_index]
                                                           : pieces->part_of(piece, k, quarterings - 2);
                if (!(part.share > 0.0f)) continue;
                const LightView of_part = view_of(batch_, light, is_glossy, part);
                const float of_whole = quarterings == 0 ? 1.0f : piece.share;
                if (!is_dark(light, is_glossy, of_part, size_ > zero))
                    add_near(pieces, light, is_glossy, of_part, below * Batch(part.share / of_whole), quarterings + 1,
                             part_index, part);
            }
        }
        if (any(together > zero)) add(light, is_glossy, view, together);
    }

    void add(const VirtualLight& light, bool is_glossy, const LightView& view, const Batch& weight) {
        const Batch zero(0.0f);
        const Batch variance = max(view.variance, Batch(least_variance));
        SphericalGaussian<Batch> seen{view.wi, inverse(variance), zero};
        Batch scale = weight;
        if (is_glossy) {
            const TurningLight turning = seen_while_turning(batch_, light, view, variance);
            seen = turning.seen;
            scale *= turning.radiance;
        } else {
            scale *= mean_clamped_cosine(view.facing, Batch(1.0f / std::max(light.sharpness, 0.1f))) *
                     inverse(Batch(2.0f * sqr(pi<float>)) * max(variance * view.distance2, Batch(1e-20f)));
        }
        CutLight cut{&light, seen, scale, zero, {}};
        const Batch apart = view.variance * inverse(usual_variance(light, is_glossy, view));
        cut.cluster_error = min(Batch(error_of_cluster) * apart, Batch(most_error_of_cluster)) +
                            Batch(is_glossy ? error_of_glossy_cell : 0.0f);
        if (batch_.has_diffuse)
            cut.diffuse =
                scale * integrate(seen) * mean_clamped_cosine(dot(seen.axis, normal_), inverse(seen.sharpness));
        if (receiver_) {
            const bool all_alike = method_ != VirtualLightMethod::automatic;
            const BatchMask wide = all_alike ? zero > zero : is_wide(*receiver_, seen);
            if (any(wide)) cut.glossy = integrate_by_points(*receiver_, seen) * scale;
            if (any(!wide)) cut.glossy = select<Batch>(wide, cut.glossy, integrate_widened(*receiver_, seen) * scale);
            cut.glossy_error = select(wide, Batch(error_of_gaussian_points), Batch(error_of_widened_lobe));
        }
        if (method_ == VirtualLightMethod::anisotropic) {
            cut.diffuse = scale * irradiance_vsgl(seen, dot(seen.axis, normal_));
            if (receiver_) cut.glossy = integrate_anisotropic(*receiver_, seen) * scale;
        }
        if (any(size_of(cut) > zero)) cut_.push_back(cut);
    }

    const SurfaceBatch& batch_;
    Batch budget_;
    float fineness_;  ///< 1 for the usual budget, less for a finer cut
    VirtualLightMethod method_;
    std::uint32_t turn_;
    std::optional<GgxGaussianReceiver<Batch>> receiver_;
    std::array<Vec3f, batch_size> normals_;
    Vec3b normal_, normal_geometric_;
    Batch glossy_weight_, diffuse_weight_, size_, total_;
    Batch share_seen_ = Batch(1.0f);  ///< of the lights that rays asked for
    std::vector<CutLight> cut_;
};

}  // namespace

Rgb VirtualReflection::radiance(const Base& surface) const {
    Rgb result;
    for (int c = 0; c < 3; ++c) {
        const auto channel = static_cast<std::size_t>(c);
        result[c] = surface.diffuse[c] * diffuse[channel] / pi<float>;
        if (surface.has_glossy()) result[c] += reflected_by(surface.fresnel, glossy[channel])[c];
    }
    return result;
}

std::array<VirtualReflection, batch_size> reflect_virtual_lights(const Scene& scene, const RenderSettings& settings,
                                                                 const VirtualLightTree& diffuse,
                                                                 const VirtualLightTree& glossy,
                                                                 const SurfaceBatch& batch, std::uint32_t turn,
                                                                 const LightLinks& links) {
    LightCut cut(batch, settings, turn);
    cut.cut(diffuse, glossy);
    cut.refine();
    if (settings.occlusion == Occlusion::ray_traced) cut.trace(scene, settings.max_passages, links);
    return cut.result();
}

}  // namespace pivot
