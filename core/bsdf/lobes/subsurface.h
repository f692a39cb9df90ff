// Light that goes beneath a surface and comes out elsewhere. As a lobe it is what that comes to where nothing near is
// lit differently: Lambert's, in the colour of all that comes out. Paths that walk beneath the surface (core/
// integrators/subsurface.h) take from it the part that enters, and leave what reflects at once.
//
// Before Blender 4.0 Principled's was shaped like Disney's diffuse lobe: light leaves as that lets it through at
// grazing angles, and what it sends back along the light never enters. [Burley15] Extending the Disney BRDF to a BSDF
// with Integrated Subsurface Scattering, section 4
#pragma once

#include "core/bsdf/lobes/disney_diffuse.h"

namespace pivot {

template <class T>
struct Subsurface {
    struct Parameters {
        Vec3<T> color{T(1)};        ///< of all that comes out, over all that arrives
        Vec3<T> albedo{T(0.8f)};    ///< the same of a surface that is nothing else: how much the inside absorbs
        Vec3<T> radius_m{T(0.1f)};  ///< the inside's mean free path, or see is_diffusion_length
        T anisotropy = T(0);        ///< mean cosine of a scattering
        T ior = T(1.4f);
        T entry_alpha = T(1);          ///< GGX alpha by which paths are refracted where they enter
        T cosine_entry = T(0);         ///< the share of them that enter by the cosine instead
        T is_diffusion_length = T(0);  ///< 1: radius_m is how far light gets beneath a boundary of that ior
        T is_similar = T(0);           ///< 1: albedo holds at any anisotropy by similarity; 0: by a fit for it
        T is_always_walked = T(1);     ///< 0: only by paths that nothing diffuse has reflected before
        T disney = T(0);               ///< 1: shaped like Disney's diffuse lobe
        T roughness = T(0.5f);         ///< of that
    };
    static constexpr std::string_view name = "subsurface";
    static constexpr float most = std::numeric_limits<float>::max();
    static constexpr std::array parameters{
        LobeParameter{"color", 3, 0.0f, most},        LobeParameter{"albedo", 3, 0.0f, 1.0f},
        LobeParameter{"radius_m", 3, 0.0f, most},     LobeParameter{"anisotropy", 1, -0.99f, 0.99f},
        LobeParameter{"ior", 1, 1.01f, 3.8f},         LobeParameter{"entry_alpha", 1, 0.0f, 1.0f},
        LobeParameter{"cosine_entry", 1, 0.0f, 1.0f}, LobeParameter{"is_diffusion_length", 1, 0.0f, 1.0f},
        LobeParameter{"is_similar", 1, 0.0f, 1.0f},   LobeParameter{"is_always_walked", 1, 0.0f, 1.0f},
        LobeParameter{"disney", 1, 0.0f, 1.0f},       LobeParameter{"roughness", 1, 0.0f, 1.0f}};
    static constexpr bool reflects = true, transmits = false, has_closed_form = false, is_diffuse = true;

    Parameters inside;
    Vec3<T> enters;     ///< of the colour, once walks() was called; before, nothing does
    T entering = T(0);  ///< of what samples this lobe, the share that goes beneath the surface

    static Subsurface seen(const Parameters& material, const Vec3<T>&) { return {material, Vec3<T>(T(0))}; }

    /// Has paths of the lanes of a mask walk beneath the surface. A colour whose radius is next to nothing never does.
    void walks(const Vec3<T>& wo_local, const Mask<T>& by) {
        constexpr float min_radius_m = 1e-8f;
        const auto channel = [&](const T& color, const T& radius_m) {
            return select(by && radius_m >= T(min_radius_m), color, T(0));
        };
        enters = {channel(inside.color.x, inside.radius_m.x), channel(inside.color.y, inside.radius_m.y),
                  channel(inside.color.z, inside.radius_m.z)};
        const Vec3<T> black(T(0)), white(T(1));
        const T leaving = select(inside.disney > T(0), DisneyDiffuse<T>{white, T(0), black}.albedo(wo_local).x, T(1));
        const T below = mean_component(enters), stays = mean_component(albedo(wo_local)) - below * leaving;
        entering = below / max(below + max(stays, T(0)), tiny<T>);
    }

    Vec3<T> eval(const Vec3<T>& wo_local, const Vec3<T>& wi_local) const {
        const T lambert = max(wi_local.z, T(0)) * T(1.0f / pi<float>);
        const Vec3<T> stays = inside.color - enters;
        if (!any(inside.disney > T(0))) return stays * lambert;
        const Vec3<T> black(T(0)), white(T(1));
        const T whole = DisneyDiffuse<T>{white, inside.roughness, black}.eval(wo_local, wi_local).x;
        const T leaving = DisneyDiffuse<T>{white, T(0), black}.eval(wo_local, wi_local).x;
        return select(inside.disney > T(0), inside.color * whole - enters * leaving, stays * lambert);
    }
    T pdf_omega(const Vec3<T>&, const Vec3<T>& wi_local) const {
        return (T(1) - entering) * max(wi_local.z, T(0)) * T(1.0f / pi<float>);
    }
    /// Where u_lobe is below `entering` nobody goes there.
    Vec3<T> sample(const Vec3<T>&, T, const Vec2<T>& u) const { return sample_cosine_hemisphere(u); }
    Vec3<T> albedo(const Vec3<T>& wo_local) const {
        if (!any(inside.disney > T(0))) return inside.color;
        const DisneyDiffuse<T> shape{inside.color, inside.roughness, Vec3<T>(T(0))};
        return select(inside.disney > T(0), shape.albedo(wo_local), inside.color);
    }
    Vec3<T> diffuse() const { return inside.color; }
    BaseOf<T> closed_form(const Vec3<T>& wo_local) const {
        return make_base(BaseMaterialOf<T>{.diffuse = albedo(wo_local)}, wo_local);
    }
    Subsurface blurred(T) const { return *this; }
};

}  // namespace pivot
