#include "core/integrators/path_batch.h"

#include "core/bsdf/subsurface_entry.h"
#include "core/integrators/subsurface.h"

namespace pivot {
namespace {

/// The least GGX alpha of what paths meet: the less likely their BSDF samples were, the blurrier. [Cycles 4.5
/// integrator/surface_shader.h:180-202]
Batch least_alpha(const Work& work, const std::array<const Path*, batch_size>& lanes) {
    const Batch pdf = gather([&](std::size_t i) { return work.min_pdf_omega[lanes[i]->sample]; });
    return Batch(0.5f) * safe_sqrt(Batch(1.0f) - pdf / Batch(work.settings.filter_glossy));
}

using VectorLanes = std::array<Vec3f, batch_size>;

VectorLanes lanes_of(const Vec3b& v) {
    const Lanes x = store(v.x), y = store(v.y), z = store(v.z);
    VectorLanes lanes;
    for (std::size_t i = 0; i < batch_size; ++i) lanes[i] = {x[i], y[i], z[i]};
    return lanes;
}

}  // namespace

PathBatch make_batch(const Work& work, std::uint32_t bounce, std::span<const Path> paths, Vertices kind) {
    std::array<const Path*, batch_size> lanes;
    std::array<const Arrival*, batch_size> arrivals;
    std::array<Sampler, batch_size> samplers;
    for (std::size_t i = 0; i < batch_size; ++i) {
        lanes[i] = &paths[std::min(i, paths.size() - 1)];
        arrivals[i] = &lanes[i]->arrival;
        samplers[i] = work.samplers[lanes[i]->sample];
    }
    const std::size_t count = batch_count(work.scene, std::span(arrivals).first(std::min(batch_size, paths.size())));
    ArrivalBatch arrived = make_arrivals(work.scene, std::span(arrivals).first(count), bounce, work.memory);
    if (kind == Vertices::exits) {
        arrived.material = exit_material(work.scene, std::span(arrivals).first(count));
        arrived.point.wo_local = Vec3b(Batch(0.0f), Batch(0.0f), Batch(1.0f));  // it is seen from nowhere
    }
    for (std::size_t i = count; i < batch_size; ++i) lanes[i] = lanes[count - 1], samplers[i] = samplers[count - 1];
    PathBatch batch{paths.first(count), pack<PathOf>(lanes), arrived.material.emission,
                    VertexBatch(sampler_lanes(samplers), arrived.point, arrived.material, arrived.bump, count)};
    if (!work.is_diffused.empty() && any(batch.vertices.surface.has_lobes())) {
        const auto where = [&](const auto& is) {
            return gather([&](std::size_t i) { return is(*lanes[i]) ? 1.0f : 0.0f; }) > Batch(0.0f);
        };
        open_to_walks(batch.vertices.surface, where([&](const Path& path) {
                          return work.scene.inner_rays().has_inside(path.arrival.hit.instance);
                      }),
                      where([&](const Path& path) { return work.is_diffused[path.sample] == 0; }));
    }
    if (!work.min_pdf_omega.empty()) batch.vertices.surface = blurred(batch.vertices.surface, least_alpha(work, lanes));
    return batch;
}

void see_first_hits(const Work& work, const PathBatch& batch) {
    const VectorLanes normal = lanes_of(batch.vertices.point.frame.z),
                      albedo = lanes_of(diffuse_color(batch.vertices.surface)), emission = lanes_of(batch.emission);
    for (std::size_t i = 0; i < batch.paths.size(); ++i) {
        Sample& sample = work.samples[batch.paths[i].sample];
        const Rgb emitted = batch.paths[i].throughput * emission[i];
        sample.radiance += emitted;
        sample.emission += emitted;
        add_to_group(work, batch.paths[i].sample, work.scene.light_group_of(batch.paths[i].arrival.hit), emitted);
        if (!(batch.paths[i].emission_weight > 0.0f)) continue;
        sample.normal = normal[i];
        sample.albedo = albedo[i];
    }
}

void see_features(const Work& work, std::uint32_t bounce, const PathBatch& batch) {
    const auto is_seen = [&](const Path& path) {
        return max_component(work.feature_worths[path.sample]) > 0.0f && (bounce > 0 || path.emission_weight > 0.0f);
    };
    if (std::ranges::none_of(batch.paths, is_seen)) return;
    constexpr float least_clear = 0.75f;
    const Vec3b all = denoising_albedo(batch.vertices.surface), through = clear_albedo(batch.vertices.surface);
    const Lanes is_clear =
        store(select(mean_component(through) > Batch(least_clear) * mean_component(all), Batch(1.0f), Batch(0.0f)));
    const VectorLanes albedo = lanes_of(all), worth = lanes_of(through),
                      normal = lanes_of(batch.vertices.point.frame.z);
    for (std::size_t i = 0; i < batch.paths.size(); ++i) {
        if (!is_seen(batch.paths[i])) continue;
        Sample& sample = work.samples[batch.paths[i].sample];
        Rgb& so_far = work.feature_worths[batch.paths[i].sample];
        sample.denoising_albedo = so_far * albedo[i];
        sample.denoising_normal = normal[i];
        so_far *= is_clear[i] * worth[i];
    }
}

void add_light(const Work& work, std::uint32_t bounce, const PathBatch& batch, const Vec3b& throughput,
               const Vec3b& radiance) {
    const Vec3b unbounded = throughput * radiance;
    const Batch share = bounded_share(work.settings, bounce, unbounded);
    const Vec3b light = unbounded * share;
    if (work.groups)
        work.groups->add_noted(batch.paths.size(), throughput * share,
                               [&](std::size_t i) { return batch.paths[i].sample; });
    const Lanes r = store(light.x), g = store(light.y), b = store(light.z);
    for (std::size_t i = 0; i < batch.paths.size(); ++i) {
        const Rgb added(r[i], g[i], b[i]);
        add_radiance(bounce, added, work.samples[batch.paths[i].sample]);
        add_to_passes(work, bounce, batch.paths[i].sample, added);
    }
}

void set_pass_shares(const Work& work, const PathBatch& batch, const LightSharesOf<Batch>& shares) {
    const auto each = unpack<LightSharesOf>(shares);
    for (std::size_t i = 0; i < batch.paths.size(); ++i)
        if (const std::uint32_t sample = batch.paths[i].sample; sample < work.passes.size())
            work.pass_shares[sample] = each[i];
}

}  // namespace pivot
