#include "core/integrators/direct_light.h"

#include "core/simd/batch.h"
// clang-format off: templates that follow must see batches
#include "core/integrators/joint_sampling.h"
// clang-format on

namespace pivot {
namespace {

Ray shadow_ray(const SurfacePoint& point, const LightPoint& place) {
    // The light's own surface is no occluder; a mesh that touches it should not become one by rounding.
    return {point.ray_origin(place.wi), place.wi, 0.0f, place.distance_m * (1.0f - 1e-5f)};
}

/// What a light sample adds if its ray is free.
struct LightCandidate {
    Rgb radiance{0.0f};  ///< 0: there is no ray to trace
    Ray ray;
    bool shares_with_bsdf = false;  ///< whether BSDF samples must be traced for this light
};

/// A vertex's light sample: of which light, chosen how often, as which of the vertex' samples. Never: no sample.
struct LightPick {
    std::size_t light;
    float expected_samples;
    std::size_t place;
};

void push(LightSamples& samples, std::size_t vertex, const LightCandidate& candidate) {
    if (!(max_component(candidate.radiance) > 0.0f)) return;
    samples.rays.push_back(candidate.ray);
    samples.vertices.push_back(vertex);
    samples.radiance.push_back(candidate.radiance);
}

/// Vertices as the lanes of a batch; lanes past the end repeat the last.
struct VertexLanes {
    std::span<const Vertex> vertices;
    JointSurface<Batch> surface;

    explicit VertexLanes(std::span<const Vertex> lanes) : vertices(lanes) {
        const auto vertex = [&](std::size_t i) -> const Vertex& { return lanes[std::min(i, lanes.size() - 1)]; };
        const auto fresnel = [&](std::size_t i) -> const LobeFresnel& { return vertex(i).surface.fresnel; };
        surface.wo_local = gather_vector([&](std::size_t i) { return vertex(i).point.wo_local; });
        surface.alpha = gather([&](std::size_t i) { return vertex(i).surface.alpha; });
        surface.diffuse = gather([&](std::size_t i) { return mean_component(vertex(i).surface.diffuse); });
        surface.fresnel_f0 =
            gather([&](std::size_t i) { return mean_component(fresnel(i).schlick_f0 + fresnel(i).dielectric_f0); });
        surface.fresnel_f90 =
            gather([&](std::size_t i) { return mean_component(fresnel(i).schlick_f90 + fresnel(i).dielectric_f90); });
    }
};

LightCandidate sample_light_at(const Scene& scene, LightSampling strategy, const Vertex& vertex,
                               const LightPick& pick) {
    const LightSampler light(scene.lights()[pick.light], vertex.point, vertex.surface, strategy);
    LightCandidate candidate{.ray = {}, .shares_with_bsdf = light.shares_with_bsdf()};
    const auto place = light.sample(vertex.sampler.point(vertex.dimensions.light_place(pick.place)));
    if (!place || !(place->pdf_omega > 0.0f) || !vertex.point.faces(place->wi)) return candidate;
    const float pdf = pick.expected_samples * place->pdf_omega;
    const Vec3f wi_local = vertex.point.frame.to_local(place->wi);
    const float weight = candidate.shares_with_bsdf ? balance(pdf, pdf_omega(vertex.surface, wi_local)) : 1.0f;
    candidate.radiance = weight * eval(vertex.surface, wi_local) * place->radiance / pdf;
    candidate.ray = shadow_ray(vertex.point, *place);
    return candidate;
}

/// A joint sample by each lane, of its own light; lanes that the closed forms leave out are sampled one by one.
void sample_lanes(const Scene& scene, const VertexLanes& lanes, std::span<const LightPick> picks, std::size_t first,
                  LightSamples& samples, std::span<std::uint8_t> shares) {
    Lanes u_x, u_y, axis_x, axis_y, axis_z, versine;
    std::array<std::optional<Cap<float>>, batch_size> caps;
    for (std::size_t i = 0; i < batch_size; ++i) {
        const std::size_t lane = std::min(i, lanes.vertices.size() - 1);
        const Vertex& v = lanes.vertices[lane];
        const LightPick& pick = picks[lane];
        // Of an area light the lane computes what nobody reads.
        caps[i] = cap_from(scene.lights()[pick.light], v.point.position);
        const Cap<float> cap = caps[i].value_or(Cap<float>{v.point.frame.z, 0.5f});
        const Vec3f axis_local = v.point.frame.to_local(cap.axis);
        axis_x[i] = axis_local.x, axis_y[i] = axis_local.y, axis_z[i] = axis_local.z, versine[i] = cap.versine;
        const Vec2f u = v.sampler.point(v.dimensions.light_place(pick.place));
        u_x[i] = u.x, u_y[i] = u.y;
    }
    const Cap<Batch> cap_local{{load(axis_x), load(axis_y), load(axis_z)}, load(versine)};
    const JointSample<Batch> s = sample_jointly(lanes.surface, cap_local, {load(u_x), load(u_y)});
    const Lanes wi_x = store(s.wi_local.x), wi_y = store(s.wi_local.y), wi_z = store(s.wi_local.z);
    const Lanes cos_oh = store(dot(lanes.surface.wo_local, normalize(lanes.surface.wo_local + s.wi_local)));
    const Lanes diffuse = store(s.diffuse), glossy = store(s.glossy);
    const Lanes valid = store(select(s.valid, Batch(1.0f), Batch(0.0f)));
    for (std::size_t lane = 0; lane < lanes.vertices.size(); ++lane) {
        const Vertex& v = lanes.vertices[lane];
        const LightPick& pick = picks[lane];
        if (!(pick.expected_samples > 0.0f)) continue;
        if (!caps[lane] || valid[lane] == 0.0f) {
            const LightCandidate candidate = sample_light_at(scene, LightSampling::joint, v, pick);
            shares[first + lane] |= candidate.shares_with_bsdf;
            push(samples, first + lane, candidate);
            continue;
        }
        const Vec3f wi = v.point.frame.to_world({wi_x[lane], wi_y[lane], wi_z[lane]});
        if (!v.point.faces(wi)) continue;
        Rgb reflected = v.surface.diffuse * diffuse[lane];
        if (glossy[lane] > 0.0f) reflected += v.surface.fresnel.at(cos_oh[lane]) * glossy[lane];
        const LightPoint place = light_point_in_cap(scene.lights()[pick.light], *caps[lane], v.point.position, wi);
        push(samples, first + lane,
             {.radiance = reflected * place.radiance / pick.expected_samples, .ray = shadow_ray(v.point, place)});
    }
}

/// The lights that a vertex samples, into picks; how many.
std::size_t pick_lights(const Scene& scene, const Vertex& vertex, std::span<LightPick> picks) {
    if (vertex.light_samples == scene.lights().size()) {
        for (std::size_t i = 0; i < vertex.light_samples; ++i) picks[i] = {i, 1.0f, i};
        return vertex.light_samples;
    }
    std::array<LightChoice, max_light_samples> choices;
    const std::size_t count = choose_lights(scene.light_tree(), vertex.point, vertex.surface,
                                            vertex.sampler.number(vertex.dimensions.light_choice()),
                                            std::span(choices).first(vertex.light_samples));
    const auto samples = static_cast<float>(vertex.light_samples);
    for (std::size_t i = 0; i < count; ++i) picks[i] = {choices[i].light, samples * choices[i].probability, i};
    return count;
}

}  // namespace

float expected_samples(const Scene& scene, const Vertex& vertex, std::size_t light) {
    if (vertex.light_samples == scene.lights().size()) return 1.0f;
    return static_cast<float>(vertex.light_samples) *
           choice_probability(scene.light_tree(), vertex.point, vertex.surface, light);
}

LightSamples sample_direct_light(const Scene& scene, LightSampling strategy, std::span<const Vertex> vertices,
                                 std::span<std::uint8_t> shares) {
    LightSamples samples;
    for (std::size_t first = 0; first < vertices.size(); first += batch_size) {
        const auto group = vertices.subspan(first, std::min(batch_size, vertices.size() - first));
        std::array<std::array<LightPick, max_light_samples>, batch_size> picks;
        std::array<std::size_t, batch_size> counts{};
        for (std::size_t lane = 0; lane < group.size(); ++lane) {
            counts[lane] = pick_lights(scene, group[lane], picks[lane]);
        }
        if (strategy == LightSampling::joint) {
            const VertexLanes lanes(group);
            const std::size_t rounds = *std::max_element(counts.begin(), counts.end());
            for (std::size_t k = 0; k < rounds; ++k) {
                std::array<LightPick, batch_size> round;
                for (std::size_t lane = 0; lane < group.size(); ++lane) {
                    round[lane] = k < counts[lane] ? picks[lane][k] : LightPick{0, 0.0f, k};
                }
                sample_lanes(scene, lanes, round, first, samples, shares);
            }
            continue;
        }
        for (std::size_t lane = 0; lane < group.size(); ++lane) {
            for (std::size_t k = 0; k < counts[lane]; ++k) {
                const LightCandidate candidate = sample_light_at(scene, strategy, group[lane], picks[lane][k]);
                shares[first + lane] |= candidate.shares_with_bsdf;
                push(samples, first + lane, candidate);
            }
        }
    }
    return samples;
}

void add_direct_light(const Scene& scene, LightSampling strategy, std::span<const Vertex> vertices,
                      std::span<Rgb> radiance, std::span<std::uint8_t> shares) {
    const LightSamples samples = sample_direct_light(scene, strategy, vertices, shares);
    std::vector<std::uint8_t> occluded(samples.rays.size());
    scene.occluded(samples.rays, occluded);
    for (std::size_t i = 0; i < samples.rays.size(); ++i) {
        if (!occluded[i]) radiance[samples.vertices[i]] += samples.radiance[i];
    }
}

}  // namespace pivot
