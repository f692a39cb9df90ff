#include "core/integrators/direct_light.h"

#include "core/integrators/vertex_lanes.h"

namespace pivot {
namespace {

static_assert(RayPacket::width % batch_size == 0);

/// A vertex's light sample: of which light, chosen how often, as which of the vertex' samples. Never: no sample.
struct LightPick {
    std::size_t light;
    float expected_samples;
    std::size_t place;
};

/// Light samples of a packet of vertices, that wait for their rays; of no length where there is none.
struct LightPacket {
    RayPacket rays;
    std::array<RayPacket::Values, 3> radiance;

    void clear() {
        rays.far_m.fill(0.0f);
        for (auto& component : radiance) component.fill(0.0f);
    }

    void set(std::size_t lane, const SurfacePoint& point, const LightPoint& place, float reach_m, const Rgb& added) {
        const Vec3f origin = point.ray_origin(place.wi);
        rays.origin_x[lane] = origin.x, rays.origin_y[lane] = origin.y, rays.origin_z[lane] = origin.z;
        rays.direction_x[lane] = place.wi.x, rays.direction_y[lane] = place.wi.y, rays.direction_z[lane] = place.wi.z;
        rays.far_m[lane] = max_component(abs(added)) > 0.0f ? reach_m : 0.0f;
        for (int k = 0; k < 3; ++k) radiance[static_cast<std::size_t>(k)][lane] = added[k];
    }

    /// The lanes where `chosen`, from `first` on.
    void set(std::size_t first, const VertexLanes& lanes, const LaneSamples& samples, const BatchMask& chosen,
             Batch scale) {
        const auto put = [&](Batch value, RayPacket::Values& to) {
            select(chosen, value, Batch::load_unaligned(&to[first])).store_unaligned(&to[first]);
        };
        const auto put3 = [&](const Vec3b& v, RayPacket::Values& x, RayPacket::Values& y, RayPacket::Values& z) {
            put(v.x, x), put(v.y, y), put(v.z, z);
        };
        const Vec3b added(samples.radiance.x * scale, samples.radiance.y * scale, samples.radiance.z * scale);
        const Batch far_m =
            select(max(max(abs(added.x), abs(added.y)), abs(added.z)) > Batch(0.0f), samples.reach_m, Batch(0.0f));
        put3(lanes.position + lanes.error_m * lanes.normal_geometric, rays.origin_x, rays.origin_y, rays.origin_z);
        put3(samples.wi, rays.direction_x, rays.direction_y, rays.direction_z);
        put3(added, radiance[0], radiance[1], radiance[2]);
        put(far_m, rays.far_m);
    }
};

/// How far a light sample's shadow ray goes.
float reach_m(const Light& light, const SurfacePoint& point, const LightPoint& place) {
    const auto* area = std::get_if<AreaLight>(&light);
    const float error_m = area ? surface_error_m(*area) : 0.0f;
    if (error_m == 0.0f) return place.distance_m * shadow_reach;
    return place.distance_m * shadow_reach - (error_m + point.error_m) / std::abs(dot(place.wi, area->normal));
}

/// A light sample of one vertex; whether BSDF samples must be traced for this lamp.
bool sample_light_at(const Scene& scene, LightSampling strategy, const Vertex& vertex, const LightPick& pick,
                     std::size_t lane, LightPacket& samples) {
    if (!(pick.expected_samples > 0.0f)) return false;
    const LightSampler light(scene.lights()[pick.light], vertex.point, vertex.surface, strategy);
    const auto place = light.sample(vertex.sampler.point(vertex.dimensions.light_place(pick.place)));
    const bool shares = light.shares_with_bsdf(), is_lamp_shared = shares && pick.light < scene.lamps().size();
    if (!place || !(place->pdf_omega > 0.0f) || !vertex.point.faces(place->wi)) return is_lamp_shared;
    const float pdf = pick.expected_samples * place->pdf_omega;
    const Vec3f wi_local = vertex.point.frame.to_local(place->wi);
    const float weight = shares ? balance(pdf, pdf_omega(vertex.surface, wi_local)) : 1.0f;
    samples.set(lane, vertex.point, *place, reach_m(scene.lights()[pick.light], vertex.point, *place),
                weight * eval(vertex.surface, wi_local) * place->radiance / pdf);
    return is_lamp_shared;
}

/// Kinds of light as batches tell them apart.
enum class Kind { none, cap, area };

Kind kind_of(const Light& light) { return std::holds_alternative<AreaLight>(light) ? Kind::area : Kind::cap; }

/// The weights of area lights' samples beside BSDF samples, where the light wants these. Whether a lamp does is noted
/// in shares; BSDF samples that meet emissive meshes count whatever is there.
Batch weight_beside_bsdf(const Scene& scene, const VertexLanes& lanes, std::span<const Vertex> vertices,
                         std::span<const LightPick> picks, const Lanes& chosen, const LaneSamples& lit, Batch expected,
                         std::span<std::uint8_t> shares) {
    Lanes shared{};
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        if (chosen[i] == 0.0f) continue;
        const std::size_t light = picks[i].light;
        if (!needs_bsdf_samples(std::get<AreaLight>(scene.lights()[light]), vertices[i].point)) continue;
        shared[i] = 1.0f;
        if (light < scene.lamps().size()) shares[i] = 1;
    }
    const BatchMask is_shared = load(shared) > Batch(0.0f);
    if (!any(is_shared)) return Batch(1.0f);
    const Batch pdf = expected * lit.pdf_omega, other = lanes.bsdf_pdf_omega(lanes.frame.to_local(lit.wi));
    // The density of a light seen edge-on is infinite.
    return select(is_shared, Batch(1.0f) / (Batch(1.0f) + other / pdf), Batch(1.0f));
}

/// A joint sample by each of a batch of vertices, each of its own light, from lane `first` of the packet on; those
/// that the closed forms leave out are sampled one by one.
void sample_batch(const Scene& scene, const VertexLanes& lanes, std::span<const Vertex> vertices,
                  std::span<const LightPick> picks, std::size_t first, LightPacket& samples,
                  std::span<std::uint8_t> shares) {
    const Vec2b u = lanes.sampler.point(vertices[0].dimensions.light_place(picks[0].place));
    std::array<Kind, batch_size> kinds{};
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        if (picks[i].expected_samples > 0.0f) kinds[i] = kind_of(scene.lights()[picks[i].light]);
    }
    Lanes done{};
    const auto sample_kind = [&](Kind kind, const auto& light_of, const auto& sample_lights) {
        const auto found = std::find(kinds.begin(), kinds.end(), kind);
        if (found == kinds.end()) return;
        // Of lanes of another kind, the batch computes what nobody reads.
        const LightPick& pick = picks[static_cast<std::size_t>(found - kinds.begin())];
        const auto own = [&](std::size_t i) -> const LightPick& { return kinds[i] == kind ? picks[i] : pick; };
        Lanes chosen{}, expected{};
        LaneValues<decltype(light_of(scene.lights()[0]))> lights{.values = {}, .same = true};
        for (std::size_t i = 0; i < batch_size; ++i) {
            chosen[i] = kinds[i] == kind ? 1.0f : 0.0f;
            expected[i] = own(i).expected_samples;
            lights.same = lights.same && own(i).light == pick.light;
        }
        for (std::size_t i = 0; i < (lights.same ? 1 : batch_size); ++i)
            lights.values[i] = light_of(scene.lights()[own(i).light]);
        const LaneSamples lit = sample_lights(lanes, lights, u);
        const BatchMask sampled = lit.valid && load(chosen) > Batch(0.0f);
        Batch weight = Batch(1.0f) / load(expected);
        if (kind == Kind::area)
            weight *= weight_beside_bsdf(scene, lanes, vertices, picks, chosen, lit, load(expected), shares);
        samples.set(first, lanes, lit, sampled, weight);
        done = store(select(sampled, Batch(1.0f), load(done)));
    };
    sample_kind(
        Kind::cap, [](const Light& light) { return &light; }, sample_cap_lights);
    sample_kind(
        Kind::area, [](const Light& light) { return &std::get<AreaLight>(light); }, sample_area_lights);
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        if (kinds[i] != Kind::none && done[i] == 0.0f)
            shares[i] |= sample_light_at(scene, LightSampling::joint, vertices[i], picks[i], first + i, samples);
    }
}

/// Some of the lights from `first` on, which a tree holds: all, or as many as there are picks, u choosing among them.
/// place: the first sample's. Of picks that find nothing none are expected.
void pick_some(const LightTree& tree, std::size_t first, std::size_t count, const Vertex& vertex, float u,
               std::size_t place, std::span<LightPick> picks) {
    if (picks.size() == count) {
        for (std::size_t i = 0; i < count; ++i) picks[i] = {first + i, 1.0f, place + i};
        return;
    }
    std::array<LightChoice, max_light_samples> choices;
    const std::size_t found =
        choose_lights(tree, vertex.point, vertex.surface, u, std::span(choices).first(picks.size()));
    const auto samples = static_cast<float>(picks.size());
    for (std::size_t i = 0; i < picks.size(); ++i) {
        const LightChoice choice = i < found ? choices[i] : LightChoice{0, 0.0f};
        picks[i] = {first + choice.light, samples * choice.probability, place + i};
    }
}

/// The lights that a vertex samples, into picks: lamps, then triangles.
void pick_lights(const Scene& scene, const Vertex& vertex, std::span<LightPick> picks) {
    const std::size_t lamps = scene.lamps().size();
    const Vec2f u = vertex.sampler.point(vertex.dimensions.light_choice());
    pick_some(scene.lamp_tree(), 0, lamps, vertex, u.x, 0, picks.first(vertex.lamp_samples));
    pick_some(scene.triangle_tree(), lamps, scene.triangle_lights().size(), vertex, u.y, max_lamp_samples,
              picks.subspan(vertex.lamp_samples, vertex.triangle_samples));
}

/// Calls visit(first vertex, LightPacket) with each packet's light samples.
template <class Visit>
void sample_packets(const Scene& scene, LightSampling strategy, std::span<const Vertex> vertices,
                    std::span<std::uint8_t> shares, const Visit& visit) {
    for (std::size_t begin = 0; begin < vertices.size(); begin += RayPacket::width) {
        const auto packet = vertices.subspan(begin, std::min(RayPacket::width, vertices.size() - begin));
        std::array<std::array<LightPick, RayPacket::width>, max_light_samples> picks;  // [sample][vertex]
        // of all, as they are vertices of one bounce
        const std::size_t rounds = packet[0].lamp_samples + packet[0].triangle_samples;
        for (std::size_t i = 0; i < packet.size(); ++i) {
            std::array<LightPick, max_light_samples> own;
            pick_lights(scene, packet[i], own);
            for (std::size_t k = 0; k < rounds; ++k) picks[k][i] = own[k];
        }
        const auto shared = shares.subspan(begin, packet.size());
        std::array<VertexLanes, RayPacket::width / batch_size> lanes;
        const auto batch_at = [&](std::size_t first) {
            return packet.subspan(first, std::min(batch_size, packet.size() - first));
        };
        for (std::size_t first = 0; first < packet.size() && strategy == LightSampling::joint; first += batch_size)
            lanes[first / batch_size] = vertex_lanes(batch_at(first));
        LightPacket samples{};
        for (std::size_t k = 0; k < rounds; ++k) {
            const std::span<const LightPick> round = picks[k];
            samples.clear();
            for (std::size_t first = 0; first < packet.size(); first += batch_size) {
                if (strategy == LightSampling::joint) {
                    sample_batch(scene, lanes[first / batch_size], batch_at(first), round.subspan(first), first,
                                 samples, shared.subspan(first));
                    continue;
                }
                for (std::size_t i = first; i < first + batch_at(first).size(); ++i)
                    shared[i] |= sample_light_at(scene, strategy, packet[i], round[i], i, samples);
            }
            visit(begin, samples);
        }
    }
}

}  // namespace

float expected_samples(const Scene& scene, const Vertex& vertex, std::size_t light) {
    const std::size_t lamps = scene.lamps().size();
    const auto chosen_of = [&](const LightTree& tree, std::size_t count, std::size_t samples, std::size_t index) {
        if (samples == count) return 1.0f;
        return static_cast<float>(samples) * choice_probability(tree, vertex.point, vertex.surface, index);
    };
    if (light < lamps) return chosen_of(scene.lamp_tree(), lamps, vertex.lamp_samples, light);
    return chosen_of(scene.triangle_tree(), scene.triangle_lights().size(), vertex.triangle_samples, light - lamps);
}

void add_direct_light(const Scene& scene, LightSampling strategy, std::span<const Vertex> vertices,
                      std::span<Rgb> radiance, std::span<std::uint8_t> shares) {
    sample_packets(scene, strategy, vertices, shares, [&](std::size_t begin, const LightPacket& samples) {
        const RayPacket::Values visibility = scene.visibility(samples.rays);
        const std::size_t count = std::min(RayPacket::width, vertices.size() - begin);
        for (std::size_t i = 0; i < count; ++i) {
            for (std::size_t c = 0; c < 3; ++c)
                radiance[begin + i][static_cast<int>(c)] += visibility[i] * samples.radiance[c][i];
        }
    });
}

std::vector<LightSample> sample_direct_light(const Scene& scene, LightSampling strategy,
                                             std::span<const Vertex> vertices, std::span<std::uint8_t> shares) {
    std::vector<LightSample> result;
    sample_packets(scene, strategy, vertices, shares, [&](std::size_t, const LightPacket& samples) {
        const RayPacket& rays = samples.rays;
        for (std::size_t i = 0; i < RayPacket::width; ++i) {
            if (rays.far_m[i] > 0.0f)
                result.push_back({{rays.direction_x[i], rays.direction_y[i], rays.direction_z[i]},
                                  {samples.radiance[0][i], samples.radiance[1][i], samples.radiance[2][i]}});
        }
    });
    return result;
}

}  // namespace pivot
