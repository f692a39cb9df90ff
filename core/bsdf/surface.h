// A material as seen from one direction: what a shading point needs to evaluate and sample its BSDF, over float or
// batches. Shading frame, z the normal. Its base's product with lights has closed forms; what further lobes it has are
// evaluated and sampled by what all lobes share.
#pragma once

#include "core/bsdf/lobe.h"
#include "core/bsdf/material.h"

namespace pivot {

template <class T>
struct SurfaceOf : BaseOf<T> {
    std::array<LobeOf<T>, max_lobes> lobes;

    SurfaceOf() = default;
    explicit SurfaceOf(const BaseOf<T>& base) : BaseOf<T>(base) {}

    Mask<T> has_lobes() const { return lobes[0].kind > T(0); }

    /// Whether light comes through it.
    Mask<T> transmits() const {
        Mask<T> result = T(0) > T(0);
        for_each_lobe(*this, [&]<class L>(const L&, const LobeOf<T>&, const Mask<T>& is_kind) {
            if constexpr (L::transmits) result = result || is_kind;
        });
        return result;
    }
};

using Surface = SurfaceOf<float>;

/// Calls visit(lobe, its record, mask) for each lobe beside the base that some lane has: in the lanes of the mask.
template <class T, class Visit>
void for_each_lobe(const SurfaceOf<T>& surface, const Visit& visit) {
    for (const LobeOf<T>& record : surface.lobes) {
        if (!any(record.kind > T(0))) return;
        visit_lobe(record, [&](const auto& lobe, const Mask<T>& is_kind) { visit(lobe, record, is_kind); });
    }
}

/// wo_local.z > 0. A black material gives a surface with no lobe's weight; sampling it yields zero.
template <class T>
SurfaceOf<T> make_surface(const MaterialOf<T>& material, const Vec3<T>& wo_local);

/// The surface, the GGX alpha of all its lobes at least so much; sample() chooses among them as before.
template <class T>
SurfaceOf<T> blurred(const SurfaceOf<T>& surface, T least_alpha) {
    SurfaceOf<T> result(blurred<T>(static_cast<const BaseOf<T>&>(surface), least_alpha));
    result.lobes = surface.lobes;
    for (LobeOf<T>& record : result.lobes)
        visit_lobe(record,
                   [&](const auto& lobe, const Mask<T>& is_kind) { record.write(lobe.blurred(least_alpha), is_kind); });
    return result;
}

/// What eval() has of diffuse lobes beside the base.
template <class T>
Vec3<T> eval_diffuse_lobes(const SurfaceOf<T>& surface, const Vec3<T>& wi_local) {
    Vec3<T> value(T(0));
    for_each_lobe(surface, [&]<class L>(const L& lobe, const LobeOf<T>&, const Mask<T>& is_kind) {
        if constexpr (DiffuseLobe<L>) {
            Vec3<T> of_lobe = lobe.eval(surface.wo_local, wi_local);
            if (any(surface.bump.is_turned())) of_lobe *= surface.bump.cosine(wi_local) / max(wi_local.z, T(1e-3f));
            value += select(is_kind, of_lobe, Vec3<T>(T(0)));
        }
    });
    return value;
}

/// BSDF times |cos|, 1/sr.
template <class T>
Vec3<T> eval(const SurfaceOf<T>& surface, const Vec3<T>& wi_local) {
    Vec3<T> value = eval_base(surface, wi_local);
    for_each_lobe(surface, [&]<class L>(const L& lobe, const LobeOf<T>&, const Mask<T>& is_kind) {
        if constexpr (!DiffuseLobe<L>) value += select(is_kind, lobe.eval(surface.wo_local, wi_local), Vec3<T>(T(0)));
    });
    return value + eval_diffuse_lobes(surface, wi_local);
}

/// What eval() is to light that is found by samples of the BSDF: the same but of few kinds of lobes, see Lobe.
template <class T>
Vec3<T> eval_sampled(const SurfaceOf<T>& surface, const Vec3<T>& wi_local) {
    Vec3<T> value = eval(surface, wi_local);
    for_each_lobe(surface, [&]<class L>(const L& lobe, const LobeOf<T>&, const Mask<T>& is_kind) {
        if constexpr (requires { lobe.eval_sampled(surface.wo_local, wi_local); }) {
            const Vec3<T> more = lobe.eval_sampled(surface.wo_local, wi_local) - lobe.eval(surface.wo_local, wi_local);
            value += select(is_kind, more, Vec3<T>(T(0)));
        }
    });
    return value;
}

/// Density of sample(), all lobes.
template <class T>
T pdf_omega(const SurfaceOf<T>& surface, const Vec3<T>& wi_local) {
    T of_base = pdf_omega_base(surface, wi_local), of_lobes(0), probability(1);
    for_each_lobe(surface, [&](const auto& lobe, const LobeOf<T>& record, const Mask<T>& is_kind) {
        of_lobes += select(is_kind, record.probability * lobe.pdf_omega(surface.wo_local, wi_local), T(0));
        probability -= select(is_kind, record.probability, T(0));
    });
    return max(probability, T(0)) * of_base + of_lobes;
}

/// A direction by one of the lobes: u_lobe chooses it, u places it. Where its density is 0 it may be of any length.
template <class T>
Vec3<T> sample(const SurfaceOf<T>& surface, T u_lobe, const Vec2<T>& u) {
    if (!any(surface.has_lobes())) return sample_base(surface, u_lobe, u);
    constexpr float below_one = 1.0f - 0x1p-24f;
    T left(u_lobe), rest(1);  // the base comes after the lobes: what is left of u_lobe there, and of all probability
    for (const LobeOf<T>& record : surface.lobes) left -= record.probability, rest -= record.probability;
    Vec3<T> wi_local = sample_base(surface, min(clamp01(left / max(rest, tiny<T>)), T(below_one)), u);
    // What a lobe samples on a side where it is 0 is no sample of a lobe that is not: at z = 0 no lobe has a density.
    wi_local.z = max(wi_local.z, T(0));
    left = u_lobe;
    for_each_lobe(surface, [&]<class L>(const L& lobe, const LobeOf<T>& record, const Mask<T>& is_kind) {
        const Mask<T> is_chosen = is_kind && left >= T(0) && left < record.probability;
        const T u_part = min(clamp01(left / max(record.probability, tiny<T>)), T(below_one));
        Vec3<T> chosen = lobe.sample(surface.wo_local, u_part, u);
        if constexpr (!L::transmits) chosen.z = max(chosen.z, T(0));
        if constexpr (!L::reflects) chosen.z = min(chosen.z, T(0));
        wi_local = select(is_chosen, chosen, wi_local);
        left -= select(is_kind, record.probability, T(0));
    });
    return wi_local;
}

/// Whether sample() draws by a highlight, by this u_lobe.
template <class T>
Mask<T> samples_highlight(const SurfaceOf<T>& surface, T u_lobe) {
    if (!any(surface.has_lobes())) return u_lobe < surface.glossy_probability;
    T left(u_lobe), rest(1);
    Mask<T> result = T(0) > T(0);
    for_each_lobe(surface, [&](const auto& lobe, const LobeOf<T>& record, const Mask<T>& is_kind) {
        const T probability = select(is_kind, record.probability, T(0));
        if constexpr (requires { lobe.highlight_probability(); })
            result = result || (left >= T(0) && left < probability * lobe.highlight_probability());
        left -= probability, rest -= probability;
    });
    return result || (left >= T(0) && left < max(rest, T(0)) * surface.glossy_probability);
}

/// Whether its lobes are the base's, or are found with the base's diffuse one.
template <class T>
Mask<T> is_like_base(const SurfaceOf<T>& surface) {
    Mask<T> result = T(0) >= T(0);
    for_each_lobe(surface, [&]<class L>(const L&, const LobeOf<T>&, const Mask<T>& is_kind) {
        if constexpr (!DiffuseLobe<L>) result = result && !is_kind;
    });
    return result;
}

/// What light samples may follow of the lobes beside the base; diffuse ones, which are found with the base's, are not
/// counted as beside.
template <class T>
HighlightsOf<T> highlights_of(const SurfaceOf<T>& surface) {
    HighlightsOf<T> highlights;
    for_each_lobe(surface, [&]<class L>(const L& lobe, const LobeOf<T>&, const Mask<T>& is_kind) {
        if constexpr (requires { lobe.add_highlights(highlights, surface.wo_local, is_kind); }) {
            lobe.add_highlights(highlights, surface.wo_local, is_kind);
        } else if constexpr (!DiffuseLobe<L>) {
            highlights.add_beside(mean_component(lobe.albedo(surface.wo_local)), is_kind);
            highlights.are_close = highlights.are_close && !is_kind;
        }
    });
    return highlights;
}

/// Whether batches know the highlights of all its lobes: of those that read tables each lane has its own.
template <class T>
Mask<T> has_common_highlights(const SurfaceOf<T>& surface) {
    Mask<T> result = T(0) >= T(0);
    for_each_lobe(surface, [&]<class L>(const L&, const LobeOf<T>&, const Mask<T>& is_kind) {
        if constexpr (HasTable<L>) result = result && !is_kind;
    });
    return result;
}

/// What the pass of diffuse colours shows.
template <class T>
Vec3<T> diffuse_color(const SurfaceOf<T>& surface) {
    Vec3<T> color = surface.diffuse;
    for_each_lobe(surface, [&](const auto& lobe, const LobeOf<T>&, const Mask<T>& is_kind) {
        color += select(is_kind, lobe.diffuse(), Vec3<T>(T(0)));
    });
    return color;
}

/// What all lobes send to the viewer where all light around is 1, at most 1, as a denoiser wants it.
template <class T>
Vec3<T> denoising_albedo(const SurfaceOf<T>& surface) {
    Vec3<T> albedo = albedo_base(surface);
    for_each_lobe(surface, [&](const auto& lobe, const LobeOf<T>&, const Mask<T>& is_kind) {
        albedo += select(is_kind, lobe.albedo(surface.wo_local), Vec3<T>(T(0)));
    });
    return min(albedo, Vec3<T>(T(1)));
}

/// The part of denoising_albedo() by which others are seen: what it reflects as a mirror, or lets through as clear
/// glass.
template <class T>
Vec3<T> clear_albedo(const SurfaceOf<T>& surface) {
    const Vec3<T> black(T(0));
    const auto is_clear = [](const T& alpha) { return alpha <= T(0.075f); };
    const auto of_base = [&](const BaseOf<T>& base) {
        return select(base.has_glossy() && is_clear(base.alpha), glossy_albedo(base), black);
    };
    Vec3<T> albedo = of_base(surface);
    for_each_lobe(surface, [&](const auto& lobe, const LobeOf<T>&, const Mask<T>& is_kind) {
        if constexpr (requires { lobe.base; })
            albedo += select(is_kind, of_base(lobe.base), black);
        else if constexpr (requires { lobe.alpha; })
            albedo += select(is_kind && is_clear(lobe.alpha), lobe.albedo(surface.wo_local), black);
    });
    return min(albedo, Vec3<T>(T(1)));
}

/// Means over colours of what the lobes unlike a base's send to the viewer where all light around is 1, by the side
/// that it comes from.
template <class T>
struct LobeAlbedoOf {
    T above, below;
};
template <class T>
LobeAlbedoOf<T> lobe_albedo(const SurfaceOf<T>& surface) {
    LobeAlbedoOf<T> albedo{T(0), T(0)};
    for_each_lobe(surface, [&]<class L>(const L& lobe, const LobeOf<T>&, const Mask<T>& is_kind) {
        if constexpr (!DiffuseLobe<L>) {
            const T mean = select(is_kind, mean_component(lobe.albedo(surface.wo_local)), T(0));
            if constexpr (L::reflects) albedo.above += mean;
            if constexpr (L::transmits) albedo.below += mean;
        }
    });
    return albedo;
}

}  // namespace pivot
