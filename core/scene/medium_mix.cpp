#include "core/scene/medium_mix.h"

namespace pivot {

Rgb value_at(const VoxelGrid* grid, const PlacedMedium& placed, const Vec3f& position) {
    return grid ? grid->at(grid->grid_from_object().point(placed.object_from_world.point(position))) : Rgb(1.0f);
}

void clear(MediumMix& mix) {
    mix.sigma_s = mix.sigma_t = mix.emission = Rgb(0.0f);
    mix.total_weight = 0.0f;
    mix.lobes.clear();
}

void add(MediumMix& mix, const Medium& medium, float density, const Rgb& emission_factor) {
    for (const ScatterLobe& lobe : medium.lobes) {
        const ScatterLobe& added = mix.lobes.emplace_back(density * lobe.sigma_s, lobe.phase);
        mix.sigma_s += added.sigma_s;
        mix.sigma_t += added.sigma_s;
        mix.total_weight += MediumMix::weight(added);
    }
    mix.sigma_t += density * medium.sigma_a;
    mix.emission += medium.emission * emission_factor;
}

void set_mix(MediumMix& mix, const Media& media, std::span<const std::uint32_t> ids, const Vec3f& position) {
    clear(mix);
    for (const std::uint32_t id : ids) {
        const PlacedMedium& placed = media.at(id);
        const Medium& medium = *placed.medium;
        add(mix, medium, value_at(medium.density.get(), placed, position).x,
            value_at(medium.emission_grid.get(), placed, position));
    }
}

}  // namespace pivot
