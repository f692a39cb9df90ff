#include "core/integrators/seen_surfaces.h"

#include "core/bsdf/surface_parts.h"
#include "core/integrators/passage.h"
#include "core/sampling/warp.h"
#include "core/simd/pack.h"

namespace pivot {
namespace {

constexpr std::uint32_t occlusion_dimension = 3u << 24;  // of samplers, past those of paths

/// What a camera ray shows of a surface.
struct Seen {
    Arrival arrival;
    std::size_t ray;
    Rgb worth;
    bool is_told;  ///< of those on a ray the one that stands for it
};

/// A ray that is to tell whether a surface is occluded, and what it counts.
struct OcclusionRay {
    Ray ray;
    std::size_t sample;
    float weight;
};

/// By the cosine about the shading normal. [Cycles 4.5 integrator/shade_surface.h]
OcclusionRay occlusion_ray(const SurfacePoint& point, const Sampler& sampler, const RenderSettings& settings,
                           std::size_t sample, float weight) {
    const Vec3f wi = point.frame.to_world(sample_cosine_hemisphere(sampler.point(occlusion_dimension)));
    return {{.origin = point.ray_origin(wi),
             .direction = wi,
             .near_m = 0.0f,
             .far_m = settings.occlusion_distance_m,
             .time = point.time},
            sample,
            weight};
}

void add_occlusion(const Scene& scene, const RenderSettings& settings, std::span<const OcclusionRay> occlusion_rays,
                   std::span<SurfacePasses> passes, ProgramMemory& memory) {
    std::vector<Ray> rays;
    for (const OcclusionRay& each : occlusion_rays) rays.push_back(each.ray);
    std::vector<Rgb> left(rays.size());
    light_along(scene, settings.max_passages, {}, rays, left, memory);
    for (std::size_t i = 0; i < rays.size(); ++i)
        passes[occlusion_rays[i].sample].ambient_occlusion += occlusion_rays[i].weight * left[i];
}

/// What the shaders of surfaces give that rays meet up to the first which hides at least half of what is behind it, or
/// the world's behind none; as often as rays get there. [Cycles 4.5 svm/aov.h, film/data_passes.h]
class SeenValues {
   public:
    SeenValues(const Scene& scene, const RenderSettings& settings, std::span<Rgb> named)
        : scene_(scene),
          first_(settings.light_groups),
          stride_(settings.named_passes()),
          is_wanted_(settings.aovs > 0),
          named_(named) {}

    bool is_wanted() const { return is_wanted_; }

    /// weight: how much of the ray's light comes from there.
    void meet(const Arrival& arrival, std::size_t ray, float weight) {
        for (const auto& [aov, material] : scene_.shaders()[arrival.material].aovs) {
            met_.push_back({arrival, place_of(ray, aov), weight});
            met_.back().arrival.material = material;
        }
    }

    void meet_world(const Vec3f& direction, std::size_t ray, float weight, Registers& registers) {
        for (const auto& [aov, value] : scene_.world_aovs())
            put(place_of(ray, aov), weight,
                world_radiance({value, scene_.camera_facts()}, direction, camera_ray, 0, registers));
    }

    /// Adds what was met of surfaces.
    void add(ProgramMemory& memory) {
        std::ranges::stable_sort(met_, {}, [](const Met& met) { return met.arrival.material; });
        const auto arrival_of = [](const Met& met) -> const Arrival& { return met.arrival; };
        for_each_arrival_batch<Met>(
            scene_, met_, arrival_of, [&](std::span<const Arrival* const> arrivals, std::span<const Met> of_batch) {
                const Vec3b values = make_arrivals(scene_, arrivals, 0, memory).material.emission;
                const Lanes r = store(values.x), g = store(values.y), b = store(values.z);
                for (std::size_t i = 0; i < of_batch.size(); ++i)
                    put(of_batch[i].place, of_batch[i].weight, {r[i], g[i], b[i]});
            });
    }

   private:
    struct Met {
        Arrival arrival;
        std::size_t place;
        float weight;
    };

    std::size_t place_of(std::size_t ray, std::uint32_t aov) const {
        return ray * stride_ + first_ + colors_of_aov * aov;
    }
    void put(std::size_t place, float weight, const Rgb& value) {
        named_[place] += weight * value;
        named_[place + 1].x += weight;
    }

    const Scene& scene_;
    std::size_t first_, stride_;
    bool is_wanted_;
    std::span<Rgb> named_;
    std::vector<Met> met_;
};

float nearness_of(const Mist& mist, float distance_m) {
    const float part = mist.depth_m > 0.0f ? (distance_m - mist.start_m) / mist.depth_m : 0.0f;
    return 1.0f - std::pow(std::clamp(part, 0.0f, 1.0f), mist.falloff);
}

Vec3f uv_of(const Scene& scene, int attribute, const RayHit& hit) {
    const Mesh& mesh = scene.mesh_of(hit);
    const Attribute* uv = attribute < 0 ? nullptr : mesh.attribute(static_cast<std::uint32_t>(attribute));
    if (!uv || uv->width < 2) return Vec3f(0.0f);
    const Triangle& corners = (uv->at_corners ? mesh.triangle_corners : mesh.triangles)[hit.triangle];
    const Vec2f& b = hit.barycentric;
    const std::array<float, 3> weights{1.0f - b.x - b.y, b.x, b.y};
    Vec3f sum(0.0f, 0.0f, 1.0f);
    for (int corner = 0; corner < 3; ++corner)
        for (int c = 0; c < 2; ++c)
            sum[c] += weights[static_cast<std::size_t>(corner)] *
                      uv->values[corners[corner] * uv->width + static_cast<std::uint32_t>(c)];
    return sum;
}

/// Tells where in the picture a surface was when the shutter opened, and will be when it closes.
void tell_motion(const Scene& scene, const Arrival& arrival, SurfacePasses& pass) {
    const auto pixel_at = [&](float time) {
        RayHit then = arrival.hit;
        then.time = time;
        const HitTriangleOf<float> at = scene.hit_triangle(then, arrival.direction);
        const Vec2f& b = then.barycentric;
        const Vec3f place = at.corner_a + b.x * (at.corner_b - at.corner_a) + b.y * (at.corner_c - at.corner_a);
        return scene.camera().pixel_at(at.world_from_object.point(place), time);
    };
    const Vec2f now = pixel_at(middle_time);
    pass.from_before = now - pixel_at(0.0f);
    pass.to_after = pixel_at(1.0f) - now;
    pass.moving_weight = 1.0f;
}

std::vector<Seen> surfaces_on(const Scene& scene, const RenderSettings& settings, std::span<const Ray> rays,
                              ProgramMemory& memory, std::span<SurfacePasses> passes, SeenValues& values) {
    std::vector<std::optional<RayHit>> hits(rays.size());
    scene.intersect(rays, visible_to_camera, hits);
    const PixelWidth width = scene.camera().pixel_width() * part_of_pixel(settings);
    const std::vector<Passage> passages = find_passages(
        scene, settings.max_path_passages, straight_rays(rays, hits, width), 0, {.least_part = 0.0f, .u = {}}, memory);
    std::span<const Passage> left = passages;
    std::vector<Seen> seen;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        Rgb worth(1.0f);
        const auto arrival_at = [&](const Passage& passage) {
            return Arrival{.direction = rays[i].direction,
                           .hit = passage.hit,
                           .material = passage.material,
                           .footprint_m = width.at(passage.hit.distance_m),
                           .ray_kind = passage.ray_kind};
        };
        bool is_hidden = false;
        const std::span<const Passage> way = take_passages(left, i);
        const Passage* told = told_of(way);
        for (const Passage& passage : way) {
            const Arrival arrival = arrival_at(passage);
            if (values.is_wanted() && !is_hidden) values.meet(arrival, i, mean_component(worth));
            is_hidden = is_hidden || passage.opacity >= 0.5f;
            if (passage.shown > 0.0f && !passage.only_shines && !scene.is_holdout(passage.hit))
                seen.push_back({arrival, i, worth, &passage == told});
            worth *= passage.passed;
        }
        if (ends(way)) continue;
        if (values.is_wanted() && !is_hidden)
            values.meet_world(rays[i].direction, i, mean_component(worth), memory.registers);
        if (!passes.empty())
            passes[i].environment =
                worth * world_radiance(scene.world_view(), rays[i].direction, camera_ray, 0, memory.registers);
    }
    return seen;
}

}  // namespace

void see_surfaces(const Scene& scene, const RenderSettings& settings, std::span<const Ray> camera_rays,
                  std::span<const Sampler> samplers, std::span<SurfacePasses> passes, std::vector<SeenMatte>& mattes,
                  std::span<Rgb> named) {
    ProgramMemory memory;
    SeenValues values(scene, settings, named);
    std::vector<Seen> seen = surfaces_on(scene, settings, camera_rays, memory, passes, values);
    values.add(memory);
    if (passes.empty() && !settings.mattes) return;
    std::vector<OcclusionRay> occlusion_rays;
    const bool tells_motion = scene.moves() && !scene.camera().blurs;
    std::ranges::stable_sort(seen, {}, [](const Seen& s) { return s.arrival.material; });
    const auto arrival_of = [](const Seen& s) -> const Arrival& { return s.arrival; };
    for_each_arrival_batch<Seen>(
        scene, seen, arrival_of, [&](std::span<const Arrival* const> arrivals, std::span<const Seen> of_batch) {
            Lanes passing{};
            if (scene.has_transparency())
                passing = store(mean_component(transparency_of(scene, arrivals, 0, memory).color));
            const ArrivalBatch batch = make_arrivals(scene, arrivals, 0, memory);
            const auto colors = unpack<ColorPartsOf>(color_parts(make_surface(batch.material, batch.point.wo_local)));
            const bool sees_occlusion = !passes.empty() && settings.occlusion_distance_m > 0.0f;
            std::array<SurfacePoint, batch_size> points;
            if (sees_occlusion) points = unpack<SurfacePointOf>(batch.point);
            for (std::size_t i = 0; i < of_batch.size(); ++i) {
                const Seen& s = of_batch[i];
                const float weight = mean_component(s.worth) * (1.0f - std::min(passing[i], 1.0f));
                if (settings.mattes && weight > 0.0f) {
                    const auto [object, material, asset] = scene.matte_ids_of(s.arrival.hit);
                    mattes.push_back({s.ray, {{object, material, asset}, weight}});
                }
                if (passes.empty()) continue;
                SurfacePasses& pass = passes[s.ray];
                pass.diffuse_color += s.worth * colors[i].diffuse;
                pass.glossy_color += s.worth * colors[i].glossy;
                pass.transmission_color += s.worth * colors[i].transmission;
                pass.nearness += weight * nearness_of(settings.mist, s.arrival.hit.distance_m);
                if (sees_occlusion)
                    occlusion_rays.push_back(occlusion_ray(points[i], samplers[s.ray], settings, s.ray, weight));
                if (!s.is_told) continue;
                pass.uv = uv_of(scene, settings.uv_attribute, s.arrival.hit);
                if (tells_motion) tell_motion(scene, s.arrival, pass);
            }
        });
    add_occlusion(scene, settings, occlusion_rays, passes, memory);
    std::ranges::stable_sort(mattes, {}, &SeenMatte::ray);
}

}  // namespace pivot
