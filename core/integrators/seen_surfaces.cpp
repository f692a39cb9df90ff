#include "core/integrators/seen_surfaces.h"

#include "core/bsdf/surface_parts.h"
#include "core/integrators/passage.h"
#include "core/simd/pack.h"

namespace pivot {
namespace {

/// What a camera ray shows of a surface.
struct Seen {
    Arrival arrival;
    std::size_t ray;
    Rgb worth;
    bool is_told;  ///< of those on a ray the one that stands for it
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
                              ProgramMemory& memory, std::span<SurfacePasses> passes) {
    std::vector<std::optional<RayHit>> hits(rays.size());
    scene.intersect(rays, visible_to_camera, hits);
    const PixelWidth width = scene.camera().pixel_width() * part_of_pixel(settings);
    const std::vector<Passage> passages =
        scene.has_transparency() ? find_passages(scene, settings.max_path_passages, straight_rays(rays, hits, width), 0,
                                                 {.least_part = 0.0f, .u = {}}, memory)
                                 : std::vector<Passage>();
    std::span<const Passage> left = passages;
    std::vector<Seen> seen;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        Rgb worth(1.0f);
        const auto show = [&](const RayHit& hit, std::uint32_t material, std::uint32_t ray_kind, bool is_told) {
            if (scene.is_holdout(hit)) return;
            seen.push_back({{.direction = rays[i].direction,
                             .hit = hit,
                             .material = material,
                             .footprint_m = width.at(hit.distance_m),
                             .ray_kind = ray_kind},
                            i,
                            worth,
                            is_told});
        };
        bool ends = false;
        if (scene.has_transparency()) {
            const std::span<const Passage> way = take_passages(left, i);
            const Passage* told = told_of(way);
            for (const Passage& passage : way) {
                if (passage.shown > 0.0f && !passage.only_shines)
                    show(passage.hit, passage.material, passage.ray_kind, &passage == told);
                worth *= passage.passed;
                ends = passage.ends();
            }
        } else if (hits[i]) {
            show(*hits[i], scene.material_of(*hits[i]), camera_ray, true);
            ends = true;
        }
        if (!ends && !passes.empty())
            passes[i].environment =
                worth * world_radiance(scene.world_view(), rays[i].direction, camera_ray, 0, memory.registers);
    }
    return seen;
}

}  // namespace

void see_surfaces(const Scene& scene, const RenderSettings& settings, std::span<const Ray> camera_rays,
                  std::span<SurfacePasses> passes, std::vector<SeenMatte>& mattes) {
    ProgramMemory memory;
    const bool tells_motion = scene.moves() && !scene.camera().blurs;
    std::vector<Seen> seen = surfaces_on(scene, settings, camera_rays, memory, passes);
    std::ranges::stable_sort(seen, {}, [](const Seen& s) { return s.arrival.material; });
    const auto arrival_of = [](const Seen& s) -> const Arrival& { return s.arrival; };
    for_each_arrival_batch<Seen>(
        scene, seen, arrival_of, [&](std::span<const Arrival* const> arrivals, std::span<const Seen> of_batch) {
            Lanes passing{};
            if (scene.has_transparency())
                passing = store(mean_component(transparency_of(scene, arrivals, 0, memory).color));
            const ArrivalBatch batch = make_arrivals(scene, arrivals, 0, memory);
            const auto colors = unpack<ColorPartsOf>(color_parts(make_surface(batch.material, batch.point.wo_local)));
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
                if (!s.is_told) continue;
                pass.uv = uv_of(scene, settings.uv_attribute, s.arrival.hit);
                if (tells_motion) tell_motion(scene, s.arrival, pass);
            }
        });
    std::ranges::stable_sort(mattes, {}, &SeenMatte::ray);
}

}  // namespace pivot
