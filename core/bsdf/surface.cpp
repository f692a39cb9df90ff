#include "core/bsdf/surface.h"

#include "core/simd/batch.h"

namespace pivot {
namespace {

/// A lobe that is there is chosen at least as often as if it had this share of the albedo: its peak may be far above
/// its mean.
constexpr float min_albedo_share = 0.1f;

/// A material's lobe as seen from wo; and its mean albedo.
template <class T>
T see_lobe(const LobeOf<T>& material, const Vec3<T>& wo_local, LobeOf<T>& seen) {
    T albedo(0);
    seen = {};
    seen.kind = material.kind;
    for_each_lobe_kind<T>([&]<class L>(T kind) {
        const Mask<T> is_kind = material.kind == kind;
        if (!any(is_kind)) return;
        const L lobe = L::seen(material.template read<typename L::Parameters>(is_kind), wo_local);
        seen.write(lobe, is_kind);
        albedo = select(is_kind, mean_component(lobe.albedo(wo_local)), albedo);
    });
    return albedo;
}

}  // namespace

template <class T>
SurfaceOf<T> make_surface(const MaterialOf<T>& material, const Vec3<T>& wo_local) {
    SurfaceOf<T> surface(make_base(material, wo_local));
    if (!any(material.lobes[0].kind > T(0))) return surface;
    std::array<T, max_lobes> albedo;
    T base = mean_component(albedo_base(surface)), total = base;
    for (std::size_t i = 0; i < max_lobes; ++i) {
        albedo[i] = see_lobe(material.lobes[i], wo_local, surface.lobes[i]);
        total += albedo[i];
    }
    const auto kept = [&](T part) { return select(part > T(0), max(part, T(min_albedo_share) * total), T(0)); };
    T sum = kept(base);
    for (const T& part : albedo) sum += kept(part);
    for (std::size_t i = 0; i < max_lobes; ++i) surface.lobes[i].probability = kept(albedo[i]) / max(sum, tiny<T>);
    return surface;
}

template Surface make_surface(const Material&, const Vec3f&);
template SurfaceOf<Batch> make_surface(const MaterialOf<Batch>&, const Vec3b&);

}  // namespace pivot
