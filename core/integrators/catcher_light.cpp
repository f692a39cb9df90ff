#include "core/integrators/catcher_light.h"

#include "core/integrators/media_ray.h"
#include "core/integrators/passage.h"

namespace pivot {
namespace {

/// Past those of passages.
constexpr std::uint32_t media_dimension = 1u << 30;

/// What media on a camera ray make of a picture, up to a catcher.
struct Before {
    Rgb emitted, through;
};

Before media_before(MediaRay& media, const Ray& ray, float distance_m, const Sampler& sampler) {
    RandomStream stream{stream_seed(sampler, media_dimension)};
    media.follow(part_of(ray, ray.near_m, distance_m), &stream);
    return {media.emitted(), media.through()};
}

/// The light of a sample that comes from surfaces first.
Rgb of_surfaces(const Sample& sample) { return sample.radiance - sample.volume_direct - sample.volume_indirect; }

}  // namespace

RenderSettings settings_of_catchers(const RenderSettings& settings) {
    RenderSettings alone = settings;
    alone.light_groups = alone.aovs = 0;
    alone.shadow_catchers = alone.surface_passes = alone.mattes = false;
    return alone;
}

void tell_catchers(const Scene& scene, const RenderSettings& settings, std::span<const Ray> rays,
                   std::span<const Sampler> samplers, std::span<const Sample> samples, const FollowAlone& follow_alone,
                   std::span<Rgb> named) {
    const auto passes_of = [&](std::size_t i) {
        return named.subspan(i * settings.named_passes() + settings.first_catcher_pass(), catcher_pass::count);
    };
    std::vector<std::optional<RayHit>> hits(rays.size());
    scene.intersect(rays, visible_to_camera, hits);
    std::vector<std::size_t> met;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        if (hits[i] && scene.is_shadow_catcher(*hits[i])) {
            met.push_back(i);
        } else {
            passes_of(i)[catcher_pass::matte] = samples[i].radiance;
            passes_of(i)[catcher_pass::shares].x = samples[i].alpha;
        }
    }
    if (met.empty()) return;
    std::vector<Sample> of_catchers(met.size());
    follow_alone(met, of_catchers);
    Registers registers;
    MediaRay media(scene.media());
    for (std::size_t k = 0; k < met.size(); ++k) {
        const std::size_t i = met[k];
        Before before{Rgb(0.0f), Rgb(1.0f)};
        if (!scene.media().is_empty()) before = media_before(media, rays[i], hits[i]->distance_m, samplers[i]);
        const std::span<Rgb> passes = passes_of(i);
        passes[catcher_pass::alone] = before.through * of_surfaces(of_catchers[k]);
        passes[catcher_pass::among_all] = of_surfaces(samples[i]) - before.emitted;
        passes[catcher_pass::matte] = samples[i].radiance - passes[catcher_pass::among_all];
        passes[catcher_pass::shares] = {1.0f - mean_component(before.through), 1.0f, 0.0f};
        // Cycles has it behind the media, and then under their alpha. [Cycles 4.5 kernel/film/read.h]
        const Rgb behind = before.through * mean_component(before.through);
        passes[catcher_pass::world] =
            behind * world_radiance(scene.world_view(), rays[i].direction, camera_ray, 0, registers);
    }
}

}  // namespace pivot
