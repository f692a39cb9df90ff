#include "core/integrators/light_sampler.h"

#include "core/tables/ggx_sptd.h"

namespace pivot {
namespace {

const Vec3f normal_local(0.0f, 0.0f, 1.0f);
constexpr float below_one = 1.0f - 0x1p-24f;

/// The diffuse lobes as one, and the strongest of the highlights.
JointSurface<float> joint_surface_of_all(const Surface& surface) {
    JointSurface<float> joint = joint_surface(surface);
    for_each_lobe(surface, [&]<class L>(const L& lobe, const LobeOf<float>&, bool) {
        if constexpr (!DiffuseLobe<L>) {
            Surface alone(lobe.closed_form(surface.wo_local));
            const JointSurface<float> other = joint_surface(alone);
            const float diffuse = joint.diffuse + other.diffuse;
            if (other.fresnel_f0 + other.fresnel_f90 > joint.fresnel_f0 + joint.fresnel_f90) joint = other;
            joint.diffuse = diffuse;
        }
    });
    return joint;
}

}  // namespace

LightSampler::LightSampler(const Light& light, const SurfacePoint& point, const Surface& surface,
                           LightSampling strategy)
    : light_(light),
      point_(point),
      cap_(cap_from(light, point.position)),
      shares_with_bsdf_(strategy != LightSampling::light) {
    if (strategy == LightSampling::bsdf) return;
    diffuse_technique_ = glossy_technique_ = Technique::uniform;
    const bool has_lobes = surface.has_lobes(), transmits = surface.transmits();
    const auto* area = std::get_if<AreaLight>(&light);
    if (area && strategy == LightSampling::joint && !transmits) {
        const AreaView<float> view = view_from(numbers_of(*area), point);
        const JointSurface<float> whole = joint_surface_of_all(surface);
        if (!(dot(view.center, view.normal) < 0.0f))
            diffuse_technique_ = Technique::none;
        else if (!is_even_enough(view))
            area_.emplace(whole, view);
        const Highlights highlights = highlights_of(surface);
        const bool has_one_highlight =
            highlights.is_empty() || (!surface.has_glossy() && highlights.is_one_of_a_base());
        const bool is_as_of_base = is_like_base(surface) || (has_one_highlight && highlights.are_close);
        shares_with_bsdf_ = !is_as_of_base || needs_bsdf_samples(view, whole);
    }
    if (!cap_) return;
    cap_local_ = {point.frame.to_local(cap_->axis), cap_->versine};
    if (strategy != LightSampling::joint && strategy != LightSampling::sptd) return;

    // What each lobe reflects of the light, to choose between their techniques.
    float diffuse_share = 0.0f;
    float glossy_share = 0.0f;
    // What covers all that lights the diffuse lobe is also for the lobes beside the base.
    if (surface.has_diffuse() || has_lobes) {
        diffuse_share = mean_component(surface.diffuse) * clamped_cosine_integral(cap_local_, normal_local) / pi<float>;
        if (strategy == LightSampling::joint && !transmits) {
            diffuse_technique_ = Technique::projected;
            // From inside a sphere light the cap is all directions; those that count are the hemisphere.
            const bool inside = cap_local_.versine > 1.0f;
            projected_cap_ = projected_cap(inside ? Cap<float>{normal_local, 1.0f} : cap_local_, normal_local);
        }
    }
    if (surface.has_glossy()) {
        const Vec3f h = normalize(surface.wo_local + cap_local_.axis);
        // As sample_jointly has it, whose density this is.
        const LobeFresnel& f = surface.fresnel;
        const float fresnel =
            lerp(mean_component(f.schlick_f0 + f.dielectric_f0), mean_component(f.schlick_f90 + f.dielectric_f90),
                 schlick_weight(std::abs(dot(surface.wo_local, h))));
        if (strategy == LightSampling::sptd) {
            glossy_technique_ = Technique::pivot;
            const GgxSptd lobe = ggx_sptd(surface.alpha, surface.wo_local);
            pivot_ = {lobe.pivot_local, lobe.delta};
            glossy_share = fresnel * lobe.amplitude() * integrate_uniform(pivot_, cap_local_);
        } else {
            ggx_cap_ = ggx_cap(surface.wo_local, cap_local_, surface.alpha);
            if (is_valid(ggx_cap_)) {
                glossy_technique_ = Technique::exact;
                glossy_share = fresnel * integral(ggx_cap_) * ggx_g1(surface.wo_local, surface.alpha, surface.alpha);
            } else {
                glossy_share = fresnel * std::min(1.0f, cap_local_.versine);
            }
        }
    }
    shares_with_bsdf_ = has_lobes || strategy == LightSampling::sptd || glossy_technique_ == Technique::uniform;
    if (strategy == LightSampling::joint && !surface.has_glossy() && !has_lobes) shares_with_bsdf_ = false;
    const float total = diffuse_share + glossy_share;
    glossy_probability_ = total > 0.0f ? glossy_share / total : 0.5f;
    if (surface.has_diffuse() && surface.has_glossy())
        glossy_probability_ = std::clamp(glossy_probability_, 0.05f, 0.95f);
    if (!has_lobes) return;
    glossy_probability_ = surface.has_glossy() ? std::min(glossy_probability_, 0.5f) : 0.0f;
    if (strategy == LightSampling::joint && follow_highlights(surface, total))
        shares_with_bsdf_ = surface.has_glossy() && glossy_technique_ == Technique::uniform;
}

bool LightSampler::follow_highlights(const Surface& surface, float share_of_base) {
    const Highlights highlights = highlights_of(surface);
    float total = 0.0f;
    bool are_all = highlights.are_close;
    for (const auto& [frame, alpha_x, alpha_y, reflectance] : highlights) {
        CapHighlight& over = highlights_[highlight_count_];
        over.frame = frame;
        const Cap<float> cap{frame.to_local(cap_local_.axis), cap_local_.versine};
        over.cap = ggx_cap(frame.to_local(surface.wo_local), cap, alpha_x, alpha_y);
        over.probability = reflectance * projected_integral(over.cap) / surface.wo_local.z;
        if (is_cone(over.cap) && over.probability > 0.0f) {
            total += over.probability;
            ++highlight_count_;
        } else {
            are_all = false;
        }
    }
    for (std::size_t i = 0; i < highlight_count_; ++i) highlights_[i].probability /= total;
    const float beside = share_of_base + highlights.beside * 2.0f * std::min(cap_local_.versine, 1.0f);
    if (total > 0.0f) highlights_probability_ = total / (total + beside);
    return are_all;
}

Vec3f LightSampler::sample_in_cap(Technique technique, const Vec2f& u) const {
    switch (technique) {
        case Technique::projected:
            return pivot::sample(projected_cap_, u);
        case Technique::pivot:
            return sample_uniform(pivot_, cap_local_, u);
        case Technique::exact:
            return pivot::sample(ggx_cap_, u).omega_i;
        default:
            return pivot::sample(cap_local_, u);
    }
}

float LightSampler::pdf_in_cap(Technique technique, const Vec3f& wi_local) const {
    switch (technique) {
        case Technique::none:
            return 0.0f;
        case Technique::projected:
            return pdf_omega_inside(projected_cap_, wi_local);
        case Technique::pivot:
            return pdf_omega_uniform_inside(pivot_, cap_local_, wi_local);
        case Technique::exact:
            return pdf_omega_inside(ggx_cap_, wi_local);
        case Technique::uniform:
            return 1.0f / solid_angle(cap_local_);
    }
    return 0.0f;
}

std::optional<LightPoint> LightSampler::sample(const Vec2f& u) const {
    if (diffuse_technique_ == Technique::none) return std::nullopt;
    if (area_) {
        const auto [at, pdf] = area_->sample(u);
        const SeenPlace<float> seen = see(area_->light(), at);
        if (!(seen.omega_per_xy > 0.0f)) return std::nullopt;
        const auto& light = std::get<AreaLight>(light_);
        const float falloff = light.inverse_tan_spread > 0.0f
                                  ? spread_falloff(light.inverse_tan_spread, -dot(seen.wi, area_->light().normal))
                                  : 1.0f;
        return LightPoint{point_.frame.to_world(seen.wi), seen.distance_m, light.radiance * falloff,
                          pdf / seen.omega_per_xy};
    }
    if (!cap_) return sample_light(light_, point_.position, u);
    // The first number chooses the technique, and what is left of it the place: points stay evenly spread.
    float left = u.x;
    const auto chooses = [&](float probability) {
        if (left < probability) {
            left /= probability;
            return true;
        }
        left = std::min((left - probability) / (1.0f - probability), below_one);
        return false;
    };
    const auto draw = [&] {
        if (!chooses(highlights_probability_)) {
            const Technique technique = chooses(glossy_probability_) ? glossy_technique_ : diffuse_technique_;
            return sample_in_cap(technique, {left, u.y});
        }
        float rest = 1.0f;
        std::size_t chosen = 0;
        while (chosen + 1 < highlight_count_ && !chooses(highlights_[chosen].probability / rest))
            rest = std::max(rest - highlights_[chosen++].probability, tiny<float>);
        const CapHighlight& over = highlights_[chosen];
        return over.frame.to_world(pivot::sample(over.cap, {left, u.y}).omega_i);
    };
    const Vec3f wi_local = draw();
    LightPoint place = light_point_in_cap(light_, *cap_, point_.position, point_.frame.to_world(wi_local));
    place.pdf_omega = pdf_omega(place);
    return place;
}

float LightSampler::pdf_omega(const LightPoint& place) const {
    if (area_) {
        const auto& light = std::get<AreaLight>(light_);
        const Vec2f at = area_coordinates(light, point_.position + place.distance_m * place.wi);
        return area_->pdf(at) / see(area_->light(), at).omega_per_xy;
    }
    if (!cap_) return diffuse_technique_ == Technique::none ? 0.0f : place.pdf_omega;
    const Vec3f wi_local = point_.frame.to_local(place.wi);
    float of_highlights = 0.0f;
    for (std::size_t i = 0; i < highlight_count_; ++i)
        of_highlights +=
            highlights_[i].probability * pdf_omega_inside(highlights_[i].cap, highlights_[i].frame.to_local(wi_local));
    return lerp(
        lerp(pdf_in_cap(diffuse_technique_, wi_local), pdf_in_cap(glossy_technique_, wi_local), glossy_probability_),
        of_highlights, highlights_probability_);
}

}  // namespace pivot
