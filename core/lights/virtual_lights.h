// Virtual spherical Gaussian lights: what surfaces send on of light that came to them, summed up in cells that ride on
// the objects. A light is a Gaussian of places that shines like a clamped cosine about a normal, or like a Gaussian of
// directions about a reflection; trees of them stand for many by the same sums.
//   [Tokuyoshi15] "Virtual Spherical Gaussian Lights for Real-time Glossy Indirect Illumination"
//   [Banerjee05]  "Clustering on the Unit Hypersphere using von Mises-Fisher Distributions"
//
// A deposit of light goes to the cells around it by weights that rise and fall linearly, to one of six directions by
// the squares of its axis, and to two sizes of cell by how far apart the lights are to be: each adds up to 1, so that
// no light is lost, and none jumps as it moves.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/lights/light_pieces.h"
#include "core/math/vector.h"

namespace pivot {

/// A place of a surface, world space, and the side of it that shines.
struct LightPlace {
    Vec3f position, normal;
};

/// Light that a surface sends on from a place.
struct LightDeposit {
    LightPlace place;
    Vec3f axis;  ///< world: the normal of a diffuse lobe; a direction that a glossy one reflects to, its length the
                 ///< mean vector's of the part of the lobe that it stands for
    Rgb power_w;
    std::uint32_t id;     ///< a number of its own, the same while it moves
    std::uint32_t owner;  ///< an object: cells hold the light of one
    Vec3f cell_position;  ///< in its own space, metres
    Vec3f cell_axis;      ///< likewise, unit
    int flat_axis;        ///< that one of its object's that the place's surface faces most
};

/// How the axis of a light turns from place to place, as it does where a surface is curved or lit from nearby: light
/// that comes together, as that of a caustic does, is spread no wider than its axes are about this.
struct LightTurn {
    Mat3<float> axis_from_place{0.0f};  ///< what is added to the axis, per metre from the mean place
    float axis_variance = 0.0f;         ///< of axes about that, across, rad^2
};

/// Lights together, or one: the leaf of a tree has no children.
struct VirtualLight {
    static constexpr std::size_t place_count = 4;
    static constexpr std::uint32_t no_pieces = ~0u;

    Vec3f mean;
    float variance_m2;     ///< of places, about the mean across any line of sight
    Vec3f axis;            ///< unit
    float sharpness;       ///< of the Gaussian of axes
    float lobe_sharpness;  ///< and of those of the leaves below, in the mean
    float bound_m;         ///< no leaf's mean, and little of its light, is further from the mean
    float lowest_m;        ///< of the leaves' means, along the axis from the mean
    Rgb power_w;
    std::uint32_t first_child = 0, child_count = 0;
    std::uint32_t pieces = no_pieces;            ///< of a leaf, among its tree's
    LightTurn turn;                              ///< of what glossy lobes reflect
    std::array<LightPlace, place_count> places;  ///< spread as its light is: where shadow rays end
};

/// A tree of lights, the root first; empty where there is no light.
struct VirtualLightTree {
    std::vector<VirtualLight> lights;
    std::vector<LightPieces> pieces;

    bool empty() const { return lights.empty(); }
    const LightPieces* pieces_of(const VirtualLight& light) const {
        return light.pieces == VirtualLight::no_pieces ? nullptr : &pieces[light.pieces];
    }
};

struct VirtualLights {
    VirtualLightTree diffuse, glossy;
    std::uint32_t light_group = ~0u;  ///< that it all comes of; what no group is asked for: of any
    std::size_t light_count = 0;      ///< leaves of both
    std::size_t photon_count = 0;
    float build_s = 0.0f;  ///< of all that are made together, the first one's; of the others 0

    bool is_empty() const { return diffuse.empty() && glossy.empty(); }
};

/// How many of all cells some of the deposits get.
inline std::size_t cells_of_share(std::size_t cells, std::size_t deposits, std::size_t all_deposits) {
    return deposits == all_deposits
               ? cells
               : std::max<std::size_t>(1, cells * deposits / std::max<std::size_t>(1, all_deposits));
}

/// About so many cells of light, as the deposits' places fill them.
VirtualLightTree build_virtual_lights(std::span<const LightDeposit> deposits, std::size_t cell_count);

}  // namespace pivot
