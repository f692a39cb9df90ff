#include "core/integrators/light_sampler.h"

#include "core/tables/ggx_sptd.h"

namespace pivot {
namespace {

const Vec3f normal_local(0.0f, 0.0f, 1.0f);
constexpr float below_one = 1.0f - 0x1p-24f;

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
        const AreaLobes<float> lobes(surface);
        if (!(dot(view.center, view.normal) < 0.0f))
            diffuse_technique_ = Technique::none;
        else if (!is_even_enough(view)) {
            area_view_ = view;
            if (needs_finer_grid(lobes))
                area_.emplace<FinerAreaSampler<float>>(lobes, view);
            else
                area_.emplace<AreaSampler<float>>(lobes, view);
        }
        shares_with_bsdf_ = needs_bsdf_samples(view, lobes);
    }
    if (!cap_) return;
    cap_local_ = {point.frame.to_local(cap_->axis), cap_->versine};
    if (strategy != LightSampling::joint && strategy != LightSampling::sptd) return;
    if (strategy == LightSampling::joint && !is_like_base(surface)) {
        mixture_.emplace(surface, cap_local_);
        shares_with_bsdf_ = mixture_->needs_bsdf_samples();
        return;
    }

    // What each lobe reflects of the light, to choose between their techniques.
    float diffuse_share = 0.0f;
    float glossy_share = 0.0f;
    // What covers all that lights the diffuse lobe is also for the lobes beside the base.
    if (surface.has_diffuse() || has_lobes) {
        diffuse_share = joint_surface(surface).diffuse * clamped_cosine_integral(cap_local_, normal_local) / pi<float>;
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
    const bool are_found = !has_lobes || (strategy == LightSampling::joint && highlights_of(surface).are_close);
    shares_with_bsdf_ = !are_found || strategy == LightSampling::sptd ||
                        (surface.has_glossy() && glossy_technique_ == Technique::uniform);
    const float total = diffuse_share + glossy_share;
    glossy_probability_ = total > 0.0f ? glossy_share / total : 0.5f;
    if ((surface.has_diffuse() || has_lobes) && surface.has_glossy())
        glossy_probability_ = std::clamp(glossy_probability_, 0.05f, 0.95f);
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
    if (area_view_) {
        const auto [at, pdf] = with_area([&](const auto& area) { return area.sample(u); });
        const SeenPlace<float> seen = see(*area_view_, at);
        if (!(seen.omega_per_xy > 0.0f) || !area_view_->is_on(at)) return std::nullopt;
        const auto& light = std::get<AreaLight>(light_);
        const float falloff = light.inverse_tan_spread > 0.0f
                                  ? spread_falloff(light.inverse_tan_spread, -dot(seen.wi, area_view_->normal))
                                  : 1.0f;
        return LightPoint{point_.frame.to_world(seen.wi), seen.distance_m, light.radiance * falloff,
                          pdf / seen.omega_per_xy};
    }
    if (!cap_) return sample_light(light_, point_.position, u);
    const auto draw = [&] {
        if (mixture_) return mixture_->sample(u);
        // The first number chooses the technique, and what is left of it the place: points stay evenly spread.
        if (u.x < glossy_probability_) return sample_in_cap(glossy_technique_, {u.x / glossy_probability_, u.y});
        const float left = (u.x - glossy_probability_) / (1.0f - glossy_probability_);
        return sample_in_cap(diffuse_technique_, {std::min(left, below_one), u.y});
    };
    const Vec3f wi_local = draw();
    LightPoint place = light_point_in_cap(light_, *cap_, point_.position, point_.frame.to_world(wi_local));
    place.pdf_omega = pdf_omega(place);
    return place;
}

float LightSampler::pdf_omega(const LightPoint& place) const {
    if (area_view_) {
        const auto& light = std::get<AreaLight>(light_);
        const Vec2f at = area_view_->from_own(area_coordinates(light, point_.position + place.distance_m * place.wi));
        if (std::max(std::abs(at.x), std::abs(at.y)) > 1.0f) return 0.0f;
        const float pdf = with_area([&](const auto& area) { return area.pdf(at); });
        return pdf / see(*area_view_, at).omega_per_xy;
    }
    if (!cap_) return diffuse_technique_ == Technique::none ? 0.0f : place.pdf_omega;
    const Vec3f wi_local = point_.frame.to_local(place.wi);
    if (mixture_) return mixture_->pdf_omega(wi_local);
    return lerp(pdf_in_cap(diffuse_technique_, wi_local), pdf_in_cap(glossy_technique_, wi_local), glossy_probability_);
}

}  // namespace pivot
