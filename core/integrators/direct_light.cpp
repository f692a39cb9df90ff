#include "core/integrators/direct_light.h"

#include "core/simd/batch.h"
// clang-format off: templates that follow must see batches
#include "core/integrators/joint_sampling.h"
// clang-format on

namespace pivot {
namespace {

float mean_component(const Rgb& c) { return (c.x + c.y + c.z) * (1.0f / 3.0f); }

Ray shadow_ray(const SurfacePoint& point, const LightPoint& place) {
    // The light's own surface is no occluder; a mesh that touches it should not become one by rounding.
    return {point.ray_origin(place.wi), place.wi, 0.0f, place.distance_m * (1.0f - 1e-5f)};
}

/// Rays that wait for each other, and what each adds where.
class ShadowQueue {
   public:
    void push(std::size_t vertex, const LightCandidate& candidate) {
        if (!(max_component(candidate.radiance) > 0.0f)) return;
        rays_.push_back(candidate.ray);
        added_.push_back({vertex, candidate.radiance});
    }

    void trace(const Scene& scene, std::span<Rgb> radiance) {
        std::vector<std::uint8_t> occluded(rays_.size());
        scene.occluded(rays_, occluded);
        for (std::size_t i = 0; i < rays_.size(); ++i) {
            if (!occluded[i]) radiance[added_[i].vertex] += added_[i].radiance;
        }
        rays_.clear();
        added_.clear();
    }

   private:
    struct Added {
        std::size_t vertex;
        Rgb radiance;
    };
    std::vector<Ray> rays_;
    std::vector<Added> added_;
};

/// Vertices as the lanes of a batch; lanes past the end repeat the last.
struct VertexLanes {
    std::span<const Vertex> vertices;
    JointSurface<Batch> surface;
    Vec3b position;
    Frame<Batch> frame;

    explicit VertexLanes(std::span<const Vertex> lanes) : vertices(lanes) {
        surface.wo_local = gather([](const Vertex& v) { return v.point.wo_local; });
        surface.alpha = gather_number([](const Vertex& v) { return v.surface.alpha; });
        surface.diffuse = gather_number([](const Vertex& v) { return mean_component(v.surface.diffuse); });
        surface.fresnel_f0 = gather_number([](const Vertex& v) {
            return mean_component(v.surface.fresnel.schlick_f0 + v.surface.fresnel.dielectric_f0);
        });
        surface.fresnel_f90 = gather_number([](const Vertex& v) {
            return mean_component(v.surface.fresnel.schlick_f90 + v.surface.fresnel.dielectric_f90);
        });
        position = gather([](const Vertex& v) { return v.point.position; });
        frame = {gather([](const Vertex& v) { return v.point.frame.x; }),
                 gather([](const Vertex& v) { return v.point.frame.y; }),
                 gather([](const Vertex& v) { return v.point.frame.z; })};
    }

    template <class Get>
    Batch gather_number(const Get& get) const {
        Lanes lanes;
        for (std::size_t i = 0; i < batch_size; ++i) lanes[i] = get(vertices[std::min(i, vertices.size() - 1)]);
        return load(lanes);
    }
    template <class Get>
    Vec3b gather(const Get& get) const {
        Lanes x, y, z;
        for (std::size_t i = 0; i < batch_size; ++i) {
            const Vec3f v = get(vertices[std::min(i, vertices.size() - 1)]);
            x[i] = v.x, y[i] = v.y, z[i] = v.z;
        }
        return {load(x), load(y), load(z)};
    }
};

/// The cap of a light as each lane sees it; nothing for an area light.
std::optional<Cap<Batch>> cap_of(const Light& light, const VertexLanes& lanes) {
    const auto broadcast = [](const Vec3f& v) { return Vec3b(Batch(v.x), Batch(v.y), Batch(v.z)); };
    if (const auto* sun = std::get_if<SunLight>(&light)) {
        return Cap<Batch>{broadcast(sun->cap.axis), Batch(sun->cap.versine)};
    }
    const auto* spot = std::get_if<SpotLight>(&light);
    const SphereLight* sphere = spot ? &spot->sphere : std::get_if<SphereLight>(&light);
    if (!sphere) return std::nullopt;
    return cap_of_sphere(broadcast(sphere->center) - lanes.position, Batch(sphere->radius_m));
}

/// A sample of one light by each lane; lanes that the closed forms leave out are sampled one by one.
void sample_light_at_lanes(const Scene& scene, const VertexLanes& lanes, std::size_t light_index, std::size_t first,
                           ShadowQueue& queue, std::span<std::uint8_t> shares) {
    const Light& light = scene.lights()[light_index];
    const auto cap = cap_of(light, lanes);
    const auto sample_alone = [&](std::size_t lane) {
        const LightCandidate candidate =
            sample_light_at(scene, LightSampling::joint, lanes.vertices[lane], light_index, 1.0f);
        shares[first + lane] |= candidate.shares_with_bsdf;
        queue.push(first + lane, candidate);
    };
    if (!cap) {
        for (std::size_t lane = 0; lane < lanes.vertices.size(); ++lane) sample_alone(lane);
        return;
    }
    Lanes u_x, u_y;
    for (std::size_t i = 0; i < batch_size; ++i) {
        const Vertex& v = lanes.vertices[std::min(i, lanes.vertices.size() - 1)];
        const Vec2f u = v.sampler.point(v.dimensions.light_place(light_index));
        u_x[i] = u.x, u_y[i] = u.y;
    }
    const Cap<Batch> cap_local{lanes.frame.to_local(cap->axis), cap->versine};
    const JointSample<Batch> s = sample_jointly(lanes.surface, cap_local, {load(u_x), load(u_y)});
    const Vec3b wi = lanes.frame.to_world(s.wi_local);
    const Lanes wi_x = store(wi.x), wi_y = store(wi.y), wi_z = store(wi.z);
    const Lanes cos_oh = store(dot(lanes.surface.wo_local, normalize(lanes.surface.wo_local + s.wi_local)));
    const Lanes diffuse = store(s.diffuse), glossy = store(s.glossy);
    const Lanes axis_x = store(cap->axis.x), axis_y = store(cap->axis.y), axis_z = store(cap->axis.z);
    const Lanes versine = store(cap->versine);
    const Lanes valid = store(select(s.valid, Batch(1.0f), Batch(0.0f)));
    for (std::size_t lane = 0; lane < lanes.vertices.size(); ++lane) {
        const Vertex& v = lanes.vertices[lane];
        if (valid[lane] == 0.0f) {
            sample_alone(lane);
            continue;
        }
        const Vec3f direction(wi_x[lane], wi_y[lane], wi_z[lane]);
        if (!v.point.faces(direction)) continue;
        Rgb reflected = v.surface.diffuse * diffuse[lane];
        if (glossy[lane] > 0.0f) reflected += v.surface.fresnel.at(cos_oh[lane]) * glossy[lane];
        const Cap<float> lane_cap{{axis_x[lane], axis_y[lane], axis_z[lane]}, versine[lane]};
        const LightPoint place = light_point_in_cap(light, lane_cap, v.point.position, direction);
        queue.push(first + lane, {.radiance = reflected * place.radiance, .ray = shadow_ray(v.point, place)});
    }
}

}  // namespace

bool shares_with_bsdf(const Vertex& vertex, const LightSampler& light, LightSampling strategy) {
    return vertex.samples_all_lights ? light.shares_with_bsdf() : strategy != LightSampling::light;
}

LightCandidate sample_light_at(const Scene& scene, LightSampling strategy, const Vertex& vertex, std::size_t index,
                               float probability) {
    const LightSampler light(scene.lights()[index], vertex.point, vertex.surface, strategy);
    LightCandidate candidate{.ray = {}, .shares_with_bsdf = shares_with_bsdf(vertex, light, strategy)};
    const auto place = light.sample(vertex.sampler.point(vertex.dimensions.light_place(index)));
    if (!place || !(place->pdf_omega > 0.0f) || !vertex.point.faces(place->wi)) return candidate;
    const float pdf = probability * place->pdf_omega;
    const Vec3f wi_local = vertex.point.frame.to_local(place->wi);
    const float weight = candidate.shares_with_bsdf ? balance(pdf, pdf_omega(vertex.surface, wi_local)) : 1.0f;
    candidate.radiance = weight * eval(vertex.surface, wi_local) * place->radiance / pdf;
    candidate.ray = shadow_ray(vertex.point, *place);
    return candidate;
}

void add_all_lights(const Scene& scene, LightSampling strategy, std::span<const Vertex> vertices,
                    std::span<Rgb> radiance, std::span<std::uint8_t> shares) {
    ShadowQueue queue;
    const std::size_t light_count = scene.lights().size();
    if (strategy == LightSampling::joint) {
        for (std::size_t first = 0; first < vertices.size(); first += batch_size) {
            const VertexLanes lanes(vertices.subspan(first, std::min(batch_size, vertices.size() - first)));
            for (std::size_t light = 0; light < light_count; ++light) {
                sample_light_at_lanes(scene, lanes, light, first, queue, shares);
            }
        }
    } else {
        for (std::size_t i = 0; i < vertices.size(); ++i) {
            for (std::size_t light = 0; light < light_count; ++light) {
                const LightCandidate candidate = sample_light_at(scene, strategy, vertices[i], light, 1.0f);
                shares[i] |= candidate.shares_with_bsdf;
                queue.push(i, candidate);
            }
        }
    }
    queue.trace(scene, radiance);
}

}  // namespace pivot
