#include "core/integrators/vertex_lights.h"

#include <algorithm>

namespace pivot {
namespace {

/// The vertices of a batch share a cut of so many nodes for each light that they choose. First ones, mostly of one
/// pixel, choose eight lamps: with 1000 of them 64 nodes leave a tenth less noise than 32 for no more time. Later ones
/// choose one, and share the weighing of the nodes next to the root.
constexpr std::size_t cut_nodes_of_choice = 8;

}  // namespace

BouncePlan plan_bounce(const Scene& scene, std::uint32_t bounce) {
    return {.bounce = bounce,
            .dimensions = Dimensions(bounce),
            .lamp_samples = std::min(scene.lamps().size(), bounce == 0 ? max_lamp_samples : 1),
            .triangle_samples = std::min(scene.triangle_lights().size(), bounce == 0 ? max_triangle_samples : 1)};
}

VertexLights::VertexLights(const Scene& scene, const BouncePlan& plan, const VertexBatch& vertices)
    : lamp_count_(scene.lamps().size()),
      lamp_samples_(plan.lamp_samples),
      samples_(plan.lamp_samples + plan.triangle_samples) {
    const bool takes_all_lamps = plan.lamp_samples == lamp_count_;
    const bool takes_all_triangles = plan.triangle_samples == scene.triangle_lights().size();
    const auto take_all = [](std::size_t first, std::span<LightPicks> picks) {
        for (std::size_t k = 0; k < picks.size(); ++k) {
            picks[k].light.fill(first + k);
            picks[k].expected_samples.fill(1.0f);
        }
    };
    const std::span<LightPicks> of_lamps(picks_.data(), lamp_samples_),
        of_triangles(picks_.data() + lamp_samples_, plan.triangle_samples);
    if (takes_all_lamps) take_all(0, of_lamps);
    if (takes_all_triangles) take_all(lamp_count_, of_triangles);
    if (takes_all_lamps && takes_all_triangles) return;
    const LightReceiver receivers = light_receiver(vertices);
    const Vec2b u = vertices.sampler.point(plan.dimensions.light_choice());
    const auto choose = [&](std::optional<LightChoice>& choice, const LightTree& tree, std::size_t first,
                            const Batch& u_choice, std::span<LightPicks> picks) {
        if (picks.empty()) return;
        choice.emplace(tree, receivers, vertices.count(), cut_nodes_of_choice * picks.size());
        std::array<LightChoices, max_light_samples> choices;
        choice->choose(u_choice, std::span(choices).first(picks.size()));
        for (std::size_t k = 0; k < picks.size(); ++k) {
            for (std::size_t i = 0; i < vertices.count(); ++i) {
                picks[k].light[i] = first + choices[k].light[i];
                picks[k].expected_samples[i] = static_cast<float>(picks.size()) * choices[k].probability[i];
            }
        }
    };
    if (!takes_all_lamps) choose(lamps_, scene.lamp_tree(), 0, u.x, of_lamps);
    if (!takes_all_triangles) choose(triangles_, scene.triangle_tree(), lamp_count_, u.y, of_triangles);
}

float VertexLights::expected_samples(std::size_t lane, std::size_t light) const {
    const bool is_lamp = light < lamp_count_;
    const std::optional<LightChoice>& choice = is_lamp ? lamps_ : triangles_;
    const std::size_t samples = is_lamp ? lamp_samples_ : samples_ - lamp_samples_;
    if (!choice) return samples > 0 ? 1.0f : 0.0f;
    return static_cast<float>(samples) * choice->probability(lane, is_lamp ? light : light - lamp_count_);
}

}  // namespace pivot
