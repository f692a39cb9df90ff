// Which lights a path's vertex samples: all where they are few, else some of them, chosen down the light tree by about
// what the surface reflects of each child: a glossy surface finds the light it mirrors. (The closed form of a GGX lobe
// over a cap in the place of the lobe's density at its centre, widened by the cap: noise 3 % less, CPU 25 % more with
// 64 lights.)
#pragma once

#include "core/integrators/vertex.h"
#include "core/lights/light_tree.h"

namespace pivot {

/// A light for each vertex of a batch.
struct LightChoices {
    std::array<std::size_t, batch_size> light;
    Lanes probability;  ///< 0: none reaches the vertex
};

/// choices.size() lights for each vertex, each by the probability it says; u in [0, 1) places them all, evenly.
void choose_lights(const LightTree& tree, const VertexBatch& vertices, const Batch& u, std::span<LightChoices> choices);

/// With which probability each choice takes this light.
float choice_probability(const LightTree& tree, const Vertex& vertex, std::size_t light);

/// The same for a place that scatters light from all around alike: a light and its probability, 0 where none reaches
/// it.
std::pair<std::size_t, float> choose_light(const LightTree& tree, const Vec3f& position, float u);
float choice_probability(const LightTree& tree, const Vec3f& position, std::size_t light);

}  // namespace pivot
