#include "core/media/medium.h"

#include <algorithm>
#include <stdexcept>

namespace pivot {

Medium make_medium(std::vector<ScatterLobe> lobes, const Rgb& sigma_a, const Rgb& emission,
                   std::shared_ptr<const VoxelGrid> density, std::shared_ptr<const VoxelGrid> emission_grid) {
    const auto is_finite = [](const Rgb& c) { return std::isfinite(c.x) && std::isfinite(c.y) && std::isfinite(c.z); };
    const auto is_positive = [](const Rgb& c) { return std::min({c.x, c.y, c.z}) >= 0.0f; };
    const auto require = [](bool ok, const char* message) {
        if (!ok) throw std::invalid_argument(message);
    };
    for (ScatterLobe& lobe : lobes) {
        require(is_finite(lobe.sigma_s) && is_positive(lobe.sigma_s),
                "medium: scattering must be finite and not negative");
        require(std::abs(lobe.phase.g) <= 1.0f, "medium: anisotropy must be in [-1, 1]");
        lobe.phase.g = std::clamp(lobe.phase.g, -max_abs_phase_g, max_abs_phase_g);
    }
    require(is_finite(sigma_a) && is_positive(sigma_a), "medium: absorption must be finite and not negative");
    require(is_finite(emission), "medium: emission must be finite");
    require(!density || density->channels() == 1, "medium: a density grid has one channel");
    return {std::move(lobes), sigma_a, emission, std::move(density), std::move(emission_grid)};
}

}  // namespace pivot
