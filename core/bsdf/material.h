// What the core knows of a material: a Lambert lobe beneath one GGX lobe, and emission. Principled, Diffuse, Glossy and
// Emission are settings of these numbers; the exporter chooses them.
#pragma once

#include "core/bsdf/ggx.h"

namespace pivot {

struct Material {
    Rgb diffuse{0.0f};   ///< Lambert reflectance, before the dielectric above it takes its share
    float alpha = 0.5f;  ///< GGX alpha, roughness squared, in [0, 1]; the smoothest is min_alpha
    // The GGX lobe's Fresnel is the sum of two curves, each with its weight multiplied in.
    Rgb conductor_f0{0.0f};         ///< Schlick at normal incidence
    Rgb conductor_f90{0.0f};        ///< Schlick at grazing incidence
    float conductor_weight = 1.0f;  ///< the weight in both: over it they are what the conductor itself reflects
    float dielectric_weight = 0.0f;
    float dielectric_ior = 1.5f;  ///< at least 1
    Rgb dielectric_tint{1.0f};    ///< scales the reflectance at normal incidence
    bool multiscatter = false;    ///< give back what single scattering loses between microfacets
    Rgb emission{0.0f};           ///< radiance, both sides; negative: subtracted

    bool has_glossy() const {
        return dielectric_weight > 0.0f || max_component(max(conductor_f0, conductor_f90)) > 0.0f;
    }
    bool is_emissive() const { return max_component(abs(emission)) > 0.0f; }
};

}  // namespace pivot
