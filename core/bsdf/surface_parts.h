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
        if constexpr (requires { lobe.eval_diffuse(wi_local, wi_local); })
            diffuse = select(is_kind, lobe.eval_diffuse(surface.wo_local, wi_local), black);
        parts.diffuse += diffuse;
        (L::transmits ? parts.glass : parts.glossy) += all - diffuse;
    });
    return parts;
}

}  // namespace pivot
