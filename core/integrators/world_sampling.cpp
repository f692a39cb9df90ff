#include "core/integrators/world_sampling.h"

#include "core/integrators/direct_light.h"

namespace pivot {

WorldSampler::WorldSampler(const Scene& scene, LightSampling strategy, const BouncePlan& plan,
                           const VertexBatch& vertices)
    : scene_(scene), plan_(WorldPlan::at(plan.bounce)), bounce_(plan.bounce) {
    const Vec2b u = vertices.sampler.point(plan.dimensions.world());
    u_choice_ = vertices.sampler.point(plan.dimensions.world_choice()).x;
    const auto count = static_cast<float>(plan_.candidates);
    constexpr float golden = 0.61803399f;
    Batch sum(0.0f);
    for (std::uint32_t k = 0; k < plan_.candidates; ++k) {
        const auto place = static_cast<float>(k);
        const Batch turned = u.x + Batch(place * golden - std::floor(place * golden));
        const Batch u_x = select(turned >= Batch(1.0f), turned - Batch(1.0f), turned);
        const auto [wi, pdf] = scene.environment().sample({u_x, (u.y + Batch(place)) * Batch(1.0f / count)});
        const Vec3b wi_local = vertices.point.frame.to_local(wi);
        const Vec3b reflected = eval(vertices.surface, wi_local);
        const Batch mean = select(vertices.is_open_to(wi), mean_component(reflected), Batch(0.0f));
        Batch weight = mean;
        if (strategy != LightSampling::light)
            weight *= balance(Batch(count) * pdf, pdf_omega(vertices.surface, wi_local));
        sum += select(mean > Batch(0.0f), weight, Batch(0.0f));
        sums_[k] = sum;
        const Vec3b worth = reflected / max(mean * pdf, tiny<Batch>);
        for (int axis = 0; axis < 3; ++axis) {
            const auto at = static_cast<std::size_t>(axis);
            wi_[at][k] = wi[axis], worth_[at][k] = worth[axis];
        }
    }
}

Vec3b WorldSampler::chosen(const std::array<Column, 3>& columns, const IndexBatch& candidate) const {
    std::array<std::int32_t, batch_size> lane;
    for (std::size_t i = 0; i < batch_size; ++i) lane[i] = static_cast<std::int32_t>(i);
    const IndexBatch index =
        candidate * IndexBatch(static_cast<std::int32_t>(batch_size)) + IndexBatch::load_unaligned(lane.data());
    const auto number = [&](const Column& column) {
        return fetch(reinterpret_cast<const float*>(column.data()), index);
    };
    return {number(columns[0]), number(columns[1]), number(columns[2])};
}

LightSampleOf<Batch> WorldSampler::sample(std::uint32_t ray, Registers& registers) const {
    const Batch sum = sums_[plan_.candidates - 1];
    const Batch at = (u_choice_ + Batch(static_cast<float>(ray))) * sum * Batch(1.0f / static_cast<float>(plan_.rays));
    IndexBatch candidate(0);
    for (std::uint32_t k = 0; k + 1 < plan_.candidates; ++k)
        candidate = select(at >= sums_[k], IndexBatch(static_cast<std::int32_t>(k + 1)), candidate);
    const Vec3b wi = chosen(wi_, candidate);
    // One bounce on, as a BSDF sample would meet it.
    const Vec3b light = world_radiance(scene_.world_view(), wi, WordBatch(diffuse_ray), bounce_ + 1, registers);
    const Batch share = sum * Batch(1.0f / static_cast<float>(plan_.candidates * plan_.rays));
    return {.radiance = select(sum > Batch(0.0f), chosen(worth_, candidate) * light * share, Vec3b(Batch(0.0f))),
            .wi = wi,
            .reach_m = std::numeric_limits<Batch>::infinity()};
}

}  // namespace pivot
