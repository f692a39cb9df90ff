// One sample of a surface under a cap-shaped light, in proportion to BSDF times light: GGX by the exact core, the
// diffuse lobe by projected solid angle, one of them chosen by what each reflects in closed form. Shading frame. Over
// float or SIMD batches; where a closed form does not hold, `valid` says so and the caller samples otherwise.
#pragma once

#include "core/bsdf/surface.h"
#include "core/distributions/elliptic_cone.h"

namespace pivot {

/// What the choice between the lobes needs of a surface; reflectances are means over the colours.
template <class T>
struct JointSurface {
    Vec3<T> wo_local;
    T alpha;
    T diffuse;                  // 0: no such lobe
    T fresnel_f0, fresnel_f90;  // both 0: no glossy lobe
};

/// Of the base and of lobes that are about as even as Lambert's, which are found with that.
template <class T>
JointSurface<T> joint_surface(const SurfaceOf<T>& surface) {
    const LobeFresnelOf<T>& f = surface.fresnel;
    T diffuse = mean_component(surface.diffuse);
    for_each_lobe(surface, [&]<class L>(const L& lobe, const LobeOf<T>&, const Mask<T>& is_kind) {
        if constexpr (DiffuseLobe<L>) diffuse += select(is_kind, mean_component(lobe.albedo(surface.wo_local)), T(0));
    });
    return {.wo_local = surface.wo_local,
            .alpha = surface.alpha,
            .diffuse = diffuse,
            .fresnel_f0 = mean_component(f.schlick_f0 + f.dielectric_f0),
            .fresnel_f90 = mean_component(f.schlick_f90 + f.dielectric_f90)};
}

template <class T>
struct JointSample {
    Vec3<T> wi_local;
    T diffuse;  // cos / pi over the sample's density
    T glossy;   // D G2 / (4 cos_o) over the sample's density; Fresnel is the caller's
    Mask<T> valid;
};

/// Neither lobe is drawn less often than this where there are both.
inline constexpr float min_lobe_probability = 0.05f;

namespace detail {

/// The point of a cap above the horizon that lies over a point of the unit disk: uniform points give pdf_omega =
/// cos / (pi sin^2 psi axis.z) [Peters19, case 1].
template <class T>
Vec3<T> project_to_cap(const Cap<T>& cap, const Vec2<T>& disk, T room) {
    const T sin_psi = sqrt(sin2_half_angle(cap)), cos_psi = T(1) - cap.versine;
    const T across2 = cap.axis.x * cap.axis.x + cap.axis.y * cap.axis.y;
    const T across = sqrt(max(across2, tiny<T>));
    const Vec2<T> towards(select(across2 > tiny<T>, cap.axis.x / across, T(1)), cap.axis.y / across);
    const T along = across * cos_psi + cap.axis.z * sin_psi * disk.x, aside = sin_psi * disk.y;
    const T plane = cap.axis.z * cos_psi - across * sin_psi * disk.x;
    return {along * towards.x - aside * towards.y, along * towards.y + aside * towards.x,
            sqrt(plane * plane + sin_psi * sin_psi * room)};
}

}  // namespace detail

/// u in [0, 1)^2; its first number also chooses the lobe. A lobe that no lane has costs nothing.
template <class T>
JointSample<T> sample_jointly(const JointSurface<T>& surface, const Cap<T>& cap, const Vec2<T>& u) {
    const Mask<T> has_diffuse = surface.diffuse > T(0), has_glossy = surface.fresnel_f0 + surface.fresnel_f90 > T(0);
    const bool any_diffuse = any(has_diffuse || !has_glossy);
    const T sin2_psi = sin2_half_angle(cap);
    const Mask<T> above = cap.axis.z > T(0) && cap.axis.z * cap.axis.z >= sin2_psi && cap.versine < T(1);
    const auto in_disk = [](T u_x, T u_y) {
        const T radius = sqrt(u_x), phi = T(2) * pi<T> * u_y;
        return Vec2<T>(radius * cos(phi), radius * sin(phi));
    };
    JointSample<T> s;
    if (!any(has_glossy)) {
        s.wi_local = detail::project_to_cap(cap, in_disk(u.x, u.y), T(1) - u.x);
        s.diffuse = select(has_diffuse, sin2_psi * cap.axis.z, T(0));
        s.glossy = T(0);
        s.valid = above || !has_diffuse;
        return s;
    }
    const GgxCap<T> g = ggx_cap(surface.wo_local, cap, surface.alpha);
    const auto masked = [&](T d) {
        return select(has_glossy && s.wi_local.z > T(0),
                      d * ggx_g2(surface.wo_local, s.wi_local, surface.alpha, surface.alpha), T(0));
    };
    if (!any_diffuse) {  // the density cancels
        const GgxCapPoint<T> lit = disk_point(g, ellipse_axes(g), in_disk(u.x, u.y), T(1) - u.x);
        s.wi_local = lit.omega_i;
        s.diffuse = T(0);
        s.glossy = masked(lit.weight);
        s.valid = is_valid(g);
        return s;
    }

    const T diffuse_share = surface.diffuse * cap.axis.z * sin2_psi;
    const T fresnel = lerp(surface.fresnel_f0, surface.fresnel_f90, schlick_weight(g.cos_half));
    const T glossy_share = fresnel * integral(g) * ggx_g1(surface.wo_local, surface.alpha, surface.alpha);
    const T share = glossy_share / max(diffuse_share + glossy_share, tiny<T>);
    const T both = max(min(share, T(1.0f - min_lobe_probability)), T(min_lobe_probability));
    const T p_glossy = select(has_glossy, select(has_diffuse, both, T(1)), T(0));

    const Mask<T> is_glossy = u.x < p_glossy;
    const T u_x = select(is_glossy, u.x / max(p_glossy, tiny<T>), (u.x - p_glossy) / max(T(1) - p_glossy, tiny<T>));
    const Vec2<T> disk = in_disk(u_x, u.y);
    const GgxCapPoint<T> lit = disk_point(g, ellipse_axes(g), disk, T(1) - u_x);

    s.wi_local = select(is_glossy, lit.omega_i, detail::project_to_cap(cap, disk, T(1) - u_x));
    s.valid = (above || !has_diffuse) && (is_valid(g) || !has_glossy);
    const T cos_i = max(s.wi_local.z, T(0));
    const T pdf_diffuse = cos_i / (pi<T> * max(sin2_psi * cap.axis.z, tiny<T>));
    const T pdf_glossy = select(is_glossy, lit.pdf_omega, pdf_omega_inside(g, s.wi_local));
    const T ndf = select(
        is_glossy, lit.weight * lit.pdf_omega,
        ggx_ndf(normalize(surface.wo_local + s.wi_local), surface.alpha, surface.alpha) / (T(4) * surface.wo_local.z));
    const T pdf = select(has_diffuse, lerp(pdf_diffuse, select(has_glossy, pdf_glossy, T(0)), p_glossy), pdf_glossy);
    const T safe_pdf = max(pdf, tiny<T>);
    // Of the glossy lobe alone the density cancels.
    const T d = select(has_diffuse, ndf / safe_pdf, lit.weight);
    s.diffuse = select(has_diffuse, cos_i / (pi<T> * safe_pdf), T(0));
    s.glossy = masked(d);
    return s;
}

}  // namespace pivot
