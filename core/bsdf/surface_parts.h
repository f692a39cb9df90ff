// What a surface sends to the viewer by kind of reflection, as Cycles' passes and its lights' visibility tell them
// apart: over float or batches, shading frame.
#pragma once

#include "core/bsdf/surface.h"

namespace pivot {

/// Parts of eval(), or of what else is summed over lobes.
template <class T>
struct SurfacePartsOf {
    Vec3<T> diffuse{T(0)};  ///< through the surface too
    Vec3<T> glossy{T(0)};   ///< by what only mirrors
    Vec3<T> glass{T(0)};    ///< by what mirrors and refracts: either, by the side that the light comes from

    Vec3<T> sum() const { return diffuse + glossy + glass; }
};

/// The parts of eval(surface, wi_local).
template <class T>
SurfacePartsOf<T> eval_parts(const SurfaceOf<T>& surface, const Vec3<T>& wi_local) {
    SurfacePartsOf<T> parts;
    parts.diffuse = eval_diffuse<T>(surface, wi_local);
    if (const Mask<T> has_glossy = surface.has_glossy(); any(has_glossy))
        parts.glossy = select(has_glossy, eval_glossy<T>(surface, wi_local), Vec3<T>(T(0)));
    for_each_lobe(surface, [&]<class L>(const L& lobe, const LobeOf<T>&, const Mask<T>& is_kind) {
        const Vec3<T> black(T(0));
        const Vec3<T> all = select(is_kind, lobe.eval(surface.wo_local, wi_local), black);
        Vec3<T> diffuse = black;
        if constexpr (DiffuseLobe<L>)
            diffuse = all;
        else if constexpr (requires { lobe.eval_diffuse(wi_local, wi_local); })
            diffuse = select(is_kind, lobe.eval_diffuse(surface.wo_local, wi_local), black);
        parts.diffuse += diffuse;
        (L::transmits ? parts.glass : parts.glossy) += all - diffuse;
    });
    return parts;
}

/// What of light from one direction is by diffuse and by glossy reflection; the rest comes through the surface.
template <class T>
struct LightSharesOf {
    Vec3<T> diffuse{T(0)}, glossy{T(0)};
};

template <class T>
LightSharesOf<T> light_shares(const SurfaceOf<T>& surface, const Vec3<T>& wi_local) {
    const SurfacePartsOf<T> parts = eval_parts(surface, wi_local);
    const Vec3<T> black(T(0)), all = max(parts.sum(), Vec3<T>(tiny<T>));
    return {parts.diffuse / all, (parts.glossy + select(wi_local.z > T(0), parts.glass, black)) / all};
}

/// What each kind of reflection sends to the viewer where all light around is 1.
template <class T>
struct ColorPartsOf {
    Vec3<T> diffuse{T(0)}, glossy{T(0)}, transmission{T(0)};
};

template <class T>
ColorPartsOf<T> color_parts(const SurfaceOf<T>& surface) {
    ColorPartsOf<T> parts;
    parts.diffuse = diffuse_color(surface);
    if (const Mask<T> has_glossy = surface.has_glossy(); any(has_glossy))
        parts.glossy = select(has_glossy, glossy_albedo<T>(surface), Vec3<T>(T(0)));
    for_each_lobe(surface, [&]<class L>(const L& lobe, const LobeOf<T>&, const Mask<T>& is_kind) {
        if constexpr (DiffuseLobe<L>) return;
        const Vec3<T> beside = select(is_kind, lobe.albedo(surface.wo_local) - lobe.diffuse(), Vec3<T>(T(0)));
        if constexpr (requires { lobe.refracted; }) {
            const Vec3<T> refracted = select(is_kind, lobe.refracted, Vec3<T>(T(0)));
            parts.transmission += refracted;
            parts.glossy += beside - refracted;
        } else {
            (L::reflects ? parts.glossy : parts.transmission) += beside;
        }
    });
    return parts;
}

}  // namespace pivot
