// What fog is made of. Lengths are metres; colours are linear RGB.
#pragma once

#include <memory>
#include <vector>

#include "core/media/phase.h"
#include "core/media/voxel_grid.h"

namespace pivot {

/// One way in which a medium scatters.
struct ScatterLobe {
    Rgb sigma_s;  ///< 1/m
    Phase phase;
};

/// The coefficients of a medium, which a grid of its density multiplies where there is one.
struct Medium {
    std::vector<ScatterLobe> lobes;
    Rgb sigma_a{0.0f};                               ///< 1/m, what is absorbed
    Rgb emission{0.0f};                              ///< radiance per m
    std::shared_ptr<const VoxelGrid> density;        ///< multiplies sigma_s and sigma_a; none: 1 everywhere
    std::shared_ptr<const VoxelGrid> emission_grid;  ///< multiplies the emission, of one channel or three; none: 1

    bool is_homogeneous() const { return !density && !emission_grid; }
    Rgb sigma_s() const {
        Rgb sum(0.0f);
        for (const ScatterLobe& lobe : lobes) sum += lobe.sigma_s;
        return sum;
    }
    Rgb sigma_t() const { return sigma_a + sigma_s(); }
};

/// Throws std::invalid_argument naming the argument that cannot be.
Medium make_medium(std::vector<ScatterLobe> lobes, const Rgb& sigma_a, const Rgb& emission,
                   std::shared_ptr<const VoxelGrid> density, std::shared_ptr<const VoxelGrid> emission_grid);

}  // namespace pivot
