// What several media are together.
#pragma once

#include "core/scene/media.h"

namespace pivot {

/// Coefficients and lobes at a place, or anywhere in homogeneous media.
struct MediumMix {
    Rgb sigma_s, sigma_t;  ///< 1/m
    Rgb emission;          ///< radiance per m
    std::vector<ScatterLobe> lobes;
    float total_weight = 0.0f;  ///< of all lobes, see weight()

    /// How often a lobe is chosen, relative to each other.
    static float weight(const ScatterLobe& lobe) { return mean_component(lobe.sigma_s); }
    bool scatters() const { return total_weight > 0.0f; }
    /// Of the phase functions; nearer to 0 where lobes differ.
    float typical_g() const {
        float sum = 0.0f;
        for (const ScatterLobe& lobe : lobes) sum += weight(lobe) * lobe.phase.g;
        return std::clamp(sum / total_weight, -0.98f, 0.98f);
    }
    /// The lobe that a number in [0, 1) chooses.
    const ScatterLobe& choose(float u) const {
        std::size_t i = 0;
        for (float left = u * total_weight; i + 1 < lobes.size() && left >= weight(lobes[i]);)
            left -= weight(lobes[i++]);
        return lobes[i];
    }
    /// Of all lobes, towards wi for a ray along direction: sigma_s times phase function, 1/(m sr).
    Rgb scattered(const Vec3f& direction, const Vec3f& wi) const {
        Rgb sum(0.0f);
        for (const ScatterLobe& lobe : lobes) sum += eval(lobe.phase, direction, wi) * lobe.sigma_s;
        return sum;
    }
    /// The density of directions of a lobe that is chosen by its weight.
    float pdf_omega(const Vec3f& direction, const Vec3f& wi) const {
        float sum = 0.0f;
        for (const ScatterLobe& lobe : lobes) sum += weight(lobe) * eval(lobe.phase, direction, wi);
        return sum / total_weight;
    }
};

/// A grid's value at a place of world space, or 1 without a grid.
Rgb value_at(const VoxelGrid* grid, const PlacedMedium& placed, const Vec3f& position);

/// Starts a mix with nothing.
void clear(MediumMix& mix);
/// Adds a medium where its density and its emission's grid have these values.
void add(MediumMix& mix, const Medium& medium, float density, const Rgb& emission_factor);

/// Sets a mix to what the media are at a place.
void set_mix(MediumMix& mix, const Media& media, std::span<const std::uint32_t> ids, const Vec3f& position);

}  // namespace pivot
