#include "core/integrators/photons.h"

#include <tbb/parallel_for.h>

#include <chrono>
#include <numeric>

#include "core/distributions/spherical_gaussian.h"
#include "core/integrators/cell_space.h"
#include "core/integrators/lit_share.h"
#include "core/integrators/passage.h"
#include "core/sampling/sobol.h"
#include "core/sampling/warp.h"
#include "core/simd/pack.h"

namespace pivot {
namespace {

constexpr std::uint32_t photons_per_light = 64;  ///< of the virtual lights asked for
constexpr std::uint32_t directions_per_reflection = 4;
constexpr std::uint32_t photon_seed = 0x70686f74;

/// Which of the sampler's dimensions a photon takes.
enum Dimension : std::uint32_t { emission_direction, emission_place, bounce_first };
constexpr std::uint32_t dimensions_per_bounce = 3;

struct Photon {
    Ray ray;
    Rgb power_w;
    Sampler sampler;
    LightRules rules{};   ///< its light's
    std::size_t set = 0;  ///< of those that are told apart
};

/// A sphere around all that photons may meet.
struct Bounds {
    Vec3f center;
    float radius_m;
};

Bounds bounds_of(const Scene& scene) {
    const auto [low, high] = scene.bounds();
    return {0.5f * (low + high), 0.5f * length(high - low)};
}

/// Of photons that come in parallel from `from`: their start on a disk around the scene.
Ray ray_from_far(const Bounds& bounds, const Vec3f& from, const Vec2f& u) {
    const Frame<float> frame = frame_from_z(from);
    const Vec2f disk = sample_disk(u) * bounds.radius_m;
    return {bounds.center + frame.to_world({disk.x, disk.y, bounds.radius_m}), -from};
}

/// A light's photons: where one starts, and its power were it alone.
struct Emitter {
    const Bounds& bounds;
    Vec2f u_direction, u_place;

    struct Emission {
        Ray ray;
        Rgb power_w;
    };

    Emission from_sphere(const SphereLight& light, const Cap<float>& directions) const {
        const Vec3f direction = sample(directions, u_direction);
        const Frame<float> frame = frame_from_z(direction);
        const Vec2f disk = sample_disk(u_place) * light.radius_m;
        const float ahead = light.is_facing_disk ? 0.0f : safe_sqrt(sqr(light.radius_m) - dot(disk, disk));
        const Vec3f start = light.center + frame.to_world({disk.x, disk.y, ahead});
        return {{start, direction}, light.radiance * (solid_angle(directions) * pi<float> * sqr(light.radius_m))};
    }
    Emission operator()(const SphereLight& light) const { return from_sphere(light, {Vec3f(0.0f, 0.0f, 1.0f), 2.0f}); }
    Emission operator()(const SpotLight& light) const {
        Emission emission = from_sphere(light.sphere, {light.direction, 1.0f - light.cos_half_angle});
        emission.power_w *= spot_falloff(light, dot(emission.ray.direction, light.direction));
        return emission;
    }
    Emission operator()(const SunLight& light) const {
        const Vec3f from = sample(light.cap, u_direction);
        const float irradiance = pi<float> * sin2_half_angle(light.cap);
        return {ray_from_far(bounds, from, u_place), light.radiance * (irradiance * pi<float> * sqr(bounds.radius_m))};
    }
    Emission operator()(const AreaLight& light) const {
        const Frame<float> frame = frame_from_z(light.normal);
        Vec2f u = u_direction;
        Rgb power = light.radiance * (pi<float> * light.area_m2);
        float side = 1.0f;
        if (light.is_two_sided()) {
            side = u.x < 0.5f ? 1.0f : -1.0f;
            u.x = 2.0f * u.x - (u.x < 0.5f ? 0.0f : 1.0f);
            power *= 2.0f;
        }
        const Vec3f local = sample_cosine_hemisphere(u);
        const Vec3f direction = side * frame.to_world(local);
        if (light.inverse_tan_spread > 0.0f) power *= spread_falloff(light.inverse_tan_spread, local.z);
        const Vec3f start = place_on(light, u_place) + light.normal * (side * surface_error_m(light));
        return {{start, direction}, power};
    }
};

float power_of(const Light& light, const Bounds& bounds) {
    // A spot's power falls off from its axis, and that of a spread from the normal: what photons carry at most, for its
    // share of them.
    const auto emission = std::visit(Emitter{bounds, Vec2f(0.5f), Vec2f(0.5f)}, light);
    return mean_component(abs(emission.power_w));
}

/// Which set what comes of a light group is of: the last that of all groups which nobody asks for.
std::size_t set_of(std::uint32_t group, std::uint32_t groups) { return std::min(group, groups); }

/// Photons with even shares of their light's power, as many of each light as its power is of all.
std::vector<Photon> emit(const Scene& scene, std::uint32_t count, std::uint32_t groups) {
    const Bounds bounds = bounds_of(scene);
    if (!(bounds.radius_m > 0.0f && std::isfinite(bounds.radius_m))) return {};
    const std::size_t light_count = scene.lamps().size() + scene.triangle_lights().size();
    const Rgb world = scene.has_world() && scene.world_rules().max_bounces > 0 ? scene.world() : Rgb(0.0f);
    const Rgb world_power = world * (pi<float> * 4.0f * pi<float> * sqr(bounds.radius_m));
    std::vector<double> powers;
    for (std::size_t i = 0; i < light_count; ++i)
        powers.push_back(static_cast<double>(power_of(scene.light(i), bounds)));
    powers.push_back(static_cast<double>(mean_component(abs(world_power))));
    const double all = std::accumulate(powers.begin(), powers.end(), 0.0);
    if (!(all > 0.0)) return {};
    std::vector<Photon> photons;
    for (std::size_t i = 0; i < powers.size(); ++i) {
        const auto own = static_cast<std::uint32_t>(std::ceil(powers[i] / all * static_cast<double>(count)));
        if (!(powers[i] > 0.0)) continue;
        const std::uint32_t seed = hash(photon_seed, static_cast<std::uint32_t>(i));
        for (std::uint32_t k = 0; k < own; ++k) {
            const Sampler sampler{seed, k};
            const Vec2f u_direction = sampler.point(emission_direction), u_place = sampler.point(emission_place);
            const float share = 1.0f / static_cast<float>(own);
            if (i < light_count) {
                const auto [ray, power] = std::visit(Emitter{bounds, u_direction, u_place}, scene.light(i));
                const LightRules rules = scene.has_light_rules() ? scene.rules_of(i) : LightRules{};
                if (rules.max_bounces > 0)
                    photons.push_back({ray, power * share, sampler, rules, set_of(scene.light_group_of(i), groups)});
            } else {
                const Vec3f from = sample(Cap<float>{Vec3f(0.0f, 0.0f, 1.0f), 2.0f}, u_direction);
                photons.push_back({ray_from_far(bounds, from, u_place), world_power * share, sampler,
                                   scene.world_rules(), set_of(scene.world_light_group(), groups)});
            }
        }
    }
    return photons;
}

struct Deposits {
    std::vector<LightDeposit> diffuse, glossy;
};

bool carries_light(const Rgb& power) { return max_component(abs(power)) > 0.0f; }

/// What one base of a surface sends on: its diffuse part towards everywhere, and its glossy one towards a few
/// directions that its lobe chooses.
void deposit_base(const Base& base, const SurfacePoint& point, const Photon& photon, std::uint32_t owner,
                  const CellSpace& cells, std::uint32_t bounce, Deposits& deposits) {
    const Vec3f& normal = point.frame.z;
    const LightPlace place{point.position, point.normal_geometric};
    const std::uint32_t id = hash(hash(photon.sampler.pixel_seed, photon.sampler.sample), bounce);
    // A light's rules are of what it lights straight.
    const std::uint32_t lights = bounce == 0 ? photon.rules.lights : visible_to_paths;
    if (const Rgb power = base.diffuse * photon.power_w;
        base.has_diffuse() && (lights & visible_to_diffuse) && carries_light(power))
        deposits.diffuse.push_back(cells.deposit(id, owner, place, normal, power));
    if (!base.has_glossy() || !(lights & visible_to_glossy)) return;
    // Each direction stands for a part of the lobe: one alone would shine without bound.
    const float concentration = 1.0f - 1.0f / (8.0f * ggx_lobe(base.alpha, base.wo_local).sharpness + 1.0f);
    for (std::uint32_t k = 0; k < directions_per_reflection; ++k) {
        const std::uint32_t dimension = bounce_first + bounce * dimensions_per_bounce + 2;
        const Vec2f u =
            Sampler{photon.sampler.pixel_seed, photon.sampler.sample * directions_per_reflection + k}.point(dimension);
        const Vec3f wi_local = ggx_sample(base.wo_local, base.alpha, base.alpha, u);
        const Vec3f wi = point.frame.to_world(wi_local);
        if (!(wi_local.z > 0.0f) || !point.faces(wi)) continue;
        const float pdf = ggx_pdf_omega(base.wo_local, wi_local, base.alpha, base.alpha);
        const Rgb share = eval_glossy(base, wi_local) / (pdf * static_cast<float>(directions_per_reflection));
        if (const Rgb power = share * photon.power_w; pdf > 0.0f && carries_light(power))
            deposits.glossy.push_back(cells.deposit(hash(id, k), owner, place, wi * concentration, power));
    }
}

void deposit(const Surface& surface, const SurfacePoint& point, const Photon& photon, std::uint32_t owner,
             const CellSpace& cells, std::uint32_t bounce, Deposits& deposits) {
    deposit_base(surface, point, photon, owner, cells, bounce, deposits);
    for_each_lobe(surface, [&]<class L>(const L& lobe, const LobeOf<float>&, bool) {
        deposit_base(lobe.closed_form(surface.wo_local), L::reflects ? point : turned_over(point), photon, owner, cells,
                     bounce, deposits);
    });
}

/// The photon after a reflection; nothing where it carries no light.
std::optional<Photon> scattered(const Surface& surface, const SurfacePoint& point, const Photon& photon,
                                std::uint32_t bounce) {
    const std::uint32_t dimension = bounce_first + bounce * dimensions_per_bounce;
    const Vec3f wi_local = sample(surface, photon.sampler.point(dimension).x, photon.sampler.point(dimension + 1));
    const float pdf = pdf_omega(surface, wi_local);
    if (!(pdf > 0.0f)) return std::nullopt;
    const Vec3f wi = point.frame.to_world(wi_local);
    Rgb power = photon.power_w * eval_sampled(surface, wi_local) / pdf;
    if (bounce == 0) power *= lit_share(photon.rules, surface, wi_local);
    const bool is_open = point.faces(wi) || (surface.transmits() && point.faces(-wi));
    if (!carries_light(power) || !is_open) return std::nullopt;
    return Photon{{point.ray_origin(wi), wi}, power, photon.sampler, photon.rules, photon.set};
}

/// Has photons go straight on through transparent surfaces from what they first met: sets that to where they end.
void go_on(const Scene& scene, std::uint32_t max_path_passages, std::vector<Photon>& photons, std::uint32_t bounce,
           ProgramMemory& memory, std::vector<std::optional<RayHit>>& hits) {
    std::vector<StraightRay> straight;
    for (std::size_t i = 0; i < photons.size(); ++i)
        straight.push_back({photons[i].ray, hits[i], visible_to_diffuse, diffuse_ray, 0.0f, 0.0f});
    const auto u = [&](std::size_t i, std::uint32_t passed) {
        return photons[i].sampler.point(passage_dimension(bounce, passed)).x;
    };
    const std::vector<Passage> passages =
        find_passages(scene, max_path_passages, straight, bounce + 1, {never_two, u}, memory);
    const std::vector<WayOn> ways = ways_on(passages, hits);
    for (std::size_t i = 0; i < photons.size(); ++i) {
        hits[i] = ways[i].only_shines() ? std::nullopt : ways[i].hit;
        photons[i].power_w *= ways[i].worth();
    }
}

/// Photons of lights that light and are hidden by some objects only, straight from these: takes away the hits of those
/// that they do not light, and returns the photons behind those that do not hide them.
std::vector<Photon> obey_links(const Scene& scene, std::span<const Photon> photons,
                               std::span<std::optional<RayHit>> hits) {
    std::vector<Photon> behind_others;
    for (std::size_t i = 0; i < hits.size(); ++i) {
        if (!hits[i]) continue;
        const LightLinks& links = photons[i].rules.links;
        const LinkSets& met = scene.link_sets_of(hits[i]->instance);
        if (!is_blocker(links, met)) {
            behind_others.push_back(photons[i]);
            behind_others.back().ray.near_m = behind(hits[i]->distance_m);
        }
        if (!is_receiver(links, met)) hits[i].reset();
    }
    return behind_others;
}

/// Follows photons to the surfaces that they meet, where they leave light. further: gets those that surfaces send on.
/// Returns those that still come straight from their lights.
std::vector<Photon> meet(const Scene& scene, std::uint32_t max_path_passages, std::vector<Photon> photons,
                         std::uint32_t bounce, std::uint32_t bounces, ProgramMemory& memory,
                         std::vector<Photon>& further, std::span<Deposits> deposits) {
    std::vector<Ray> rays;
    for (const Photon& photon : photons) rays.push_back(photon.ray);
    std::vector<std::optional<RayHit>> hits(rays.size());
    scene.intersect(rays, visible_to_diffuse, hits);
    if (scene.has_transparency()) go_on(scene, max_path_passages, photons, bounce, memory, hits);
    std::vector<Photon> straight_on;
    if (bounce == 0 && scene.has_links()) straight_on = obey_links(scene, photons, hits);
    using Arrived = std::pair<Arrival, std::size_t>;  // and its photon
    std::vector<Arrived> arrivals;
    for (std::size_t i = 0; i < hits.size(); ++i)
        if (hits[i])
            arrivals.push_back({{.direction = rays[i].direction,
                                 .hit = *hits[i],
                                 .material = scene.material_of(*hits[i]),
                                 .footprint_m = 0.0f,
                                 .ray_kind = diffuse_ray},
                                i});
    std::ranges::stable_sort(arrivals, {}, [&](const auto& a) { return a.first.material; });
    const auto arrival_of = [](const Arrived& a) -> const Arrival& { return a.first; };
    for_each_arrival_batch<Arrived>(
        scene, arrivals, arrival_of, [&](std::span<const Arrival* const> met, std::span<const Arrived> of_batch) {
            const ArrivalBatch batch = make_arrivals(scene, met, bounce + 1, memory);
            const auto points = unpack<SurfacePointOf>(batch.point);
            const auto surfaces = unpack<SurfaceOf>(make_surface(batch.material, batch.point.wo_local));
            for (std::size_t i = 0; i < of_batch.size(); ++i) {
                const Photon& photon = photons[of_batch[i].second];
                const std::uint32_t owner = met[i]->hit.instance;
                const CellSpace cells(scene.world_from_object(owner));
                deposit(surfaces[i], points[i], photon, owner, cells, bounce, deposits[photon.set]);
                if (bounce + 1 == std::min(bounces, photon.rules.max_bounces)) continue;
                if (const auto next = scattered(surfaces[i], points[i], photon, bounce)) further.push_back(*next);
            }
        });
    return straight_on;
}

/// Follows photons from surface to surface. deposits: of each set.
void trace(const Scene& scene, std::uint32_t max_path_passages, std::vector<Photon> photons, std::uint32_t bounces,
           std::span<Deposits> deposits) {
    ProgramMemory memory;
    for (std::uint32_t bounce = 0; bounce < bounces && !photons.empty(); ++bounce) {
        std::vector<Photon> further;
        while (!photons.empty())
            photons = meet(scene, max_path_passages, std::move(photons), bounce, bounces, memory, further, deposits);
        photons = std::move(further);
    }
}

void append(std::vector<LightDeposit>& to, const std::vector<LightDeposit>& from) {
    to.insert(to.end(), from.begin(), from.end());
}

std::size_t leaf_count(const VirtualLightTree& tree) {
    return static_cast<std::size_t>(std::ranges::count(tree.lights, 0u, &VirtualLight::child_count));
}

}  // namespace

std::vector<VirtualLights> trace_virtual_lights(const Scene& scene, const RenderSettings& settings) {
    const auto start = std::chrono::steady_clock::now();
    if (settings.max_bounces == 0) return {};
    const std::uint32_t groups = settings.light_groups;
    const std::vector<Photon> photons = emit(scene, settings.virtual_lights * photons_per_light, groups);
    constexpr std::size_t chunk = 512;
    std::vector<std::vector<Deposits>> parts((photons.size() + chunk - 1) / chunk,
                                             std::vector<Deposits>(std::size_t{groups} + 1));
    tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t i) {
        const auto own = std::span(photons).subspan(i * chunk, std::min(chunk, photons.size() - i * chunk));
        trace(scene, settings.max_path_passages, {own.begin(), own.end()}, settings.max_bounces, parts[i]);
    });
    std::vector<VirtualLights> all;
    for (std::uint32_t set = 0; set <= groups; ++set) {
        const auto count = static_cast<std::size_t>(std::ranges::count(photons, set, &Photon::set));
        Deposits deposits;
        for (const std::vector<Deposits>& part : parts) {
            append(deposits.diffuse, part[set].diffuse);
            append(deposits.glossy, part[set].glossy);
        }
        const std::size_t cells = cells_of_share(settings.virtual_lights, count, photons.size());
        const std::size_t kinds = !deposits.diffuse.empty() && !deposits.glossy.empty() ? 2 : 1;
        VirtualLights result;
        result.diffuse = build_virtual_lights(deposits.diffuse, cells / kinds);
        result.glossy = build_virtual_lights(deposits.glossy, cells / kinds);
        if (result.is_empty()) continue;
        if (set < groups) result.light_group = set;
        result.light_count = leaf_count(result.diffuse) + leaf_count(result.glossy);
        result.photon_count = count;
        all.push_back(std::move(result));
    }
    if (!all.empty())
        all.front().build_s = std::chrono::duration<float>(std::chrono::steady_clock::now() - start).count();
    return all;
}

}  // namespace pivot
