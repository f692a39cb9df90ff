// Where paths go beneath a surface: which of its lobes they enter by, and what they are worth then.
#pragma once

#include "core/bsdf/surface.h"

namespace pivot {

/// The place of the list of lobes at which Subsurface is, from 1.
template <class T>
T subsurface_kind() {
    T result(0);
    for_each_lobe_kind<T>([&]<class L>(T kind) {
        if constexpr (std::same_as<L, Subsurface<T>>) result = kind;
    });
    return result;
}

/// Whether some of the light goes beneath a surface of the material.
inline bool has_subsurface(const Material& material) {
    return std::ranges::any_of(material.lobes,
                               [](const LobeOf<float>& lobe) { return lobe.kind == subsurface_kind<float>(); });
}

/// Whether light that comes out of a material leaves by Disney's diffuse lobe.
inline bool leaves_by_disney(const Material& material) {
    return std::ranges::any_of(material.lobes, [](const LobeOf<float>& lobe) {
        const bool is_kind = lobe.kind == subsurface_kind<float>();
        return is_kind && lobe.read<Subsurface<float>::Parameters>(is_kind).disney > 0.0f;
    });
}

/// Has paths walk beneath the surface, in the lanes where that has an inside: all that may always, and in the lanes of
/// the other mask all.
template <class T>
void open_to_walks(SurfaceOf<T>& surface, const Mask<T>& has_inside, const Mask<T>& is_first) {
    for (LobeOf<T>& record : surface.lobes) {
        const Mask<T> is_kind = record.kind == subsurface_kind<T>();
        if (!any(is_kind)) continue;
        auto lobe = record.template read<Subsurface<T>>(is_kind);
        lobe.walks(surface.wo_local, has_inside && (is_first || lobe.inside.is_always_walked > T(0)));
        record.write(lobe, is_kind);
    }
}

/// Calls visit(lobe, probability, u, mask) for each lobe by which paths enter in some lane, by the u_lobe by which
/// sample() chooses: by how likely that is, and what is left of u_lobe, [0, 1). The density of what else sample() draws
/// leaves them out.
template <class T, class Visit>
void visit_entry(const SurfaceOf<T>& surface, T u_lobe, const Visit& visit) {
    T left(u_lobe);
    for_each_lobe(surface, [&]<class L>(const L& lobe, const LobeOf<T>& record, const Mask<T>& is_kind) {
        if constexpr (std::same_as<L, Subsurface<T>>) {
            const T probability = record.probability * lobe.entering;
            const Mask<T> is_chosen = is_kind && left >= T(0) && left < probability;
            if (any(is_chosen))
                visit(lobe, probability, min(left / max(probability, tiny<T>), T(1.0f - 0x1p-24f)), is_chosen);
        }
        left -= select(is_kind, record.probability, T(0));
    });
}

}  // namespace pivot
