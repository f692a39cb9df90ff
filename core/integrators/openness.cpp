#include "core/integrators/openness.h"

#include "core/sampling/warp.h"
#include "core/shaders/ops/hash.h"
#include "core/simd/pack.h"

namespace pivot {
namespace {

/// Whether the instance that a ray leaves is in its way, whatever of others is.
bool meets_own(const Scene& scene, Ray ray, std::uint32_t instance) {
    while (const std::optional<RayHit> hit = scene.intersect(ray, visible_to_all)) {
        if (hit->instance == instance) return true;
        ray.near_m = std::nextafter(hit->distance_m, ray.far_m);
        if (!(ray.near_m < ray.far_m)) return false;
    }
    return false;
}

}  // namespace

Batch openness_around(const Scene& scene, const SurfacePointOf<Batch>& point,
                      const std::array<std::uint32_t, batch_size>& instances, const OpennessQuestion& question) {
    const Frame<Batch> frame = frame_from_z(question.normal);
    const Point<3> place{{point.position.x, point.position.y, point.position.z}};
    const Vec2b turn(random_number(place, 0.0f), random_number(place, 1.0f));
    Lanes open{};
    std::array<std::uint8_t, batch_size> hidden{};
    for (std::uint32_t k = 0; k < question.ray_count; ++k) {
        const Vec2b even = golden_point(Batch(static_cast<float>(k)), question.ray_count) + turn;
        const Vec2b u(even.x - floor(even.x), even.y - floor(even.y));
        const Vec3b wi = frame.to_world(sample_cosine_hemisphere(u));
        const std::array<Ray, batch_size> rays = unpack<RayOf>(RayOf<Batch>{.origin = point.ray_origin(wi),
                                                                            .direction = wi,
                                                                            .near_m = Batch(0.0f),
                                                                            .far_m = question.distance_m,
                                                                            .time = point.time});
        if (!question.only_own) scene.occluded(rays, hidden);
        for (std::size_t i = 0; i < batch_size; ++i) {
            const bool is_hidden = question.only_own ? meets_own(scene, rays[i], instances[i]) : hidden[i] != 0;
            open[i] += is_hidden ? 0.0f : 1.0f;
        }
    }
    const Batch share = load(open) * Batch(1.0f / static_cast<float>(question.ray_count));
    return select(question.distance_m > Batch(0.0f), share, Batch(1.0f));
}

}  // namespace pivot
