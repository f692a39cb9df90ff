// What the core knows of a material: a Lambert lobe beneath one GGX lobe, and emission. Principled, Diffuse, Glossy and
// Emission are settings of these numbers; the exporter chooses them.
#pragma once

#include "core/bsdf/ggx.h"

namespace pivot {

template <class T>
struct MaterialOf {
    Vec3<T> diffuse{T(0)};  ///< Lambert reflectance, before the dielectric above it takes its share
    T alpha = T(0.5f);      ///< GGX alpha, roughness squared, in [0, 1]; the smoothest is min_alpha
    // The GGX lobe's Fresnel is the sum of two curves, each with its weight multiplied in.
    Vec3<T> conductor_f0{T(0)};   ///< Schlick at normal incidence
    Vec3<T> conductor_f90{T(0)};  ///< Schlick at grazing incidence
    T conductor_weight = T(1);    ///< the weight in both: over it they are what the conductor itself reflects
    T dielectric_weight = T(0);
    T dielectric_ior = T(1.5f);     ///< at least 1
    Vec3<T> dielectric_tint{T(1)};  ///< scales the reflectance at normal incidence
    T multiscatter = T(0);          ///< 1: give back what single scattering loses between microfacets; 0: do not
    Vec3<T> emission{T(0)};         ///< radiance, both sides; negative: subtracted

    Mask<T> has_conductor() const { return max(max_component(conductor_f0), max_component(conductor_f90)) > T(0); }
    Mask<T> has_glossy() const { return dielectric_weight > T(0) || has_conductor(); }
    Mask<T> is_emissive() const { return max_component(abs(emission)) > T(0); }
};

using Material = MaterialOf<float>;

}  // namespace pivot
