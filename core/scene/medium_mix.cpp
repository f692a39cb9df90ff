#include "core/scene/medium_mix.h"

namespace pivot {

void set_mix(MediumMix& mix, const Media& media, std::span<const std::uint32_t> ids, const Vec3f& position) {
    mix.sigma_s = mix.sigma_t = mix.emission = Rgb(0.0f);
    mix.total_weight = 0.0f;
    mix.lobes.clear();
    for (const std::uint32_t id : ids) {
        const PlacedMedium& placed = media.at(id);
        const Medium& medium = *placed.medium;
        const auto value_of = [&](const VoxelGrid* grid) {
            return grid ? grid->at(grid->grid_from_object().point(placed.object_from_world.point(position)))
                        : Rgb(1.0f);
        };
        const Rgb density = value_of(medium.density.get());
        for (const ScatterLobe& lobe : medium.lobes) {
            mix.lobes.push_back({density * lobe.sigma_s, lobe.phase});
            mix.sigma_s += mix.lobes.back().sigma_s;
            mix.total_weight += MediumMix::weight(mix.lobes.back());
        }
        mix.sigma_t += density * medium.sigma_a;
        mix.emission += medium.emission * value_of(medium.emission_grid.get());
    }
    mix.sigma_t += mix.sigma_s;
}

bool are_homogeneous(const Media& media, std::span<const std::uint32_t> ids) {
    return std::ranges::all_of(ids, [&](std::uint32_t id) { return media.at(id).medium->is_homogeneous(); });
}

}  // namespace pivot
