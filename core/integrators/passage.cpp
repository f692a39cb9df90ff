#include "core/integrators/passage.h"

#include <algorithm>
#include <numeric>

#include "core/simd/pack.h"

namespace pivot {
namespace {

/// Whether two hits of a ray are one: where it meets an edge, which is both triangles'.
bool is_same(const RayHit& a, const RayHit& b) {
    return a.instance == b.instance && a.distance_m < behind(b.distance_m) && b.distance_m < behind(a.distance_m);
}

/// Takes out what is on rays that end, and all but one of what is met twice.
void keep_first(std::vector<RayTracer::Filtered>& filters, const Lanes& open) {
    std::vector<RayTracer::Filtered> kept;
    for (const RayTracer::Filtered& filter : filters) {
        const auto is_again = [&](const auto& other) {
            return other.lane == filter.lane && is_same(other.hit, filter.hit);
        };
        if (open[filter.lane] > 0.0f && std::ranges::none_of(kept, is_again)) kept.push_back(filter);
    }
    filters.swap(kept);
}

/// What each of the surfaces lets through where rays arrive, whatever its material.
std::vector<Transparency> transparencies(const Scene& scene, std::span<const Arrival> arrivals, std::uint32_t bounce,
                                         ProgramMemory& memory) {
    std::vector<Transparency> found(arrivals.size());
    std::vector<std::size_t> order(arrivals.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return arrivals[i].material; });
    const auto arrival_of = [&](std::size_t i) -> const Arrival& { return arrivals[i]; };
    for_each_arrival_batch<std::size_t>(
        scene, order, arrival_of, [&](std::span<const Arrival* const> batch, std::span<const std::size_t> places) {
            const auto lanes = unpack<TransparencyOf>(transparency_of(scene, batch, bounce, memory));
            for (std::size_t i = 0; i < places.size(); ++i) found[places[i]] = lanes[i];
        });
    return found;
}

/// A ray that has come as far as a surface.
struct Going {
    std::uint32_t ray;
    RayHit hit;
    Rgb worth;
    std::uint32_t passed;
};

/// Decides whether a path stays at a surface, passes it, or does both.
void choose(const Transparency& surface, const PassageChoice& choice, const Going& going, Passage& passage) {
    const float passing = mean_component(surface.color), all = passing + surface.opacity;
    passage.opacity = surface.opacity;
    if (!(passing > 0.0f)) return;
    passage.passed = surface.color;
    if (!(surface.opacity > 0.0f)) {
        passage.shown = 0.0f;
        return;
    }
    const float worth = mean_component(going.worth);
    if (worth * std::min(passing, surface.opacity) >= choice.least_part) return;
    const float p = passing / all;
    if (choice.u(going.ray, going.passed) < p) {
        passage.passed /= p;
        passage.shown = 0.0f;
    } else {
        passage.passed = Rgb(0.0f);
        passage.shown = 1.0f / (1.0f - p);
    }
}

std::uint32_t passed_by(std::uint32_t ray_kind) { return ray_kind / passed_one; }

/// A surface that a ray meets, as long as nothing is known of light that passes it.
Passage opaque(std::uint32_t ray, const RayHit& hit, std::uint32_t material, std::uint32_t ray_kind) {
    return {.ray = ray,
            .hit = hit,
            .material = material,
            .ray_kind = ray_kind,
            .opacity = 1.0f,
            .shown = 1.0f,
            .passed = Rgb(0.0f),
            .only_shines = false};
}

}  // namespace

std::vector<Passage> find_passages(const Scene& scene, std::uint32_t max_path_passages,
                                   std::span<const StraightRay> rays, std::uint32_t bounce, const PassageChoice& choice,
                                   ProgramMemory& memory) {
    std::vector<Passage> passages;
    passages.reserve(rays.size());
    if (!scene.has_transparency()) {
        for (std::uint32_t i = 0; i < rays.size(); ++i)
            if (const auto& hit = rays[i].hit)
                passages.push_back(opaque(i, *hit, scene.material_of(*hit), rays[i].ray_kind));
        return passages;
    }
    std::vector<Going> going;
    for (std::uint32_t i = 0; i < rays.size(); ++i)
        if (rays[i].hit) going.push_back({i, *rays[i].hit, Rgb(1.0f), passed_by(rays[i].ray_kind)});
    while (!going.empty()) {
        const std::size_t first = passages.size();
        std::vector<Arrival> arrivals;
        std::vector<std::size_t> asked;  // places in `going`
        for (std::size_t k = 0; k < going.size(); ++k) {
            const auto& [i, hit, worth, passed] = going[k];
            const StraightRay& ray = rays[i];
            passages.push_back(
                opaque(i, hit, scene.material_of(hit), (ray.ray_kind & ray_kinds) + passed * passed_one));
            passages.back().only_shines = passed >= max_path_passages;
            const Passage& passage = passages.back();
            if (passage.only_shines || !scene.shaders()[passage.material].is_transparent()) continue;
            arrivals.push_back({.direction = ray.ray.direction,
                                .hit = hit,
                                .material = passage.material,
                                .footprint_m = ray.footprint_m + ray.spread * hit.distance_m,
                                .ray_kind = passage.ray_kind});
            asked.push_back(k);
        }
        const std::vector<Transparency> found = transparencies(scene, arrivals, bounce, memory);
        for (std::size_t k = 0; k < asked.size(); ++k)
            choose(found[k], choice, going[asked[k]], passages[first + asked[k]]);
        std::vector<Going> further;
        std::vector<Ray> onwards;
        std::vector<std::uint32_t> met_by;
        for (std::size_t k = 0; k < going.size(); ++k) {
            const Passage& passage = passages[first + k];
            if (passage.ends()) continue;
            Going next = going[k];
            next.worth *= passage.passed;
            ++next.passed;
            further.push_back(next);
            Ray ray = rays[passage.ray].ray;
            ray.near_m = behind(passage.hit.distance_m);
            onwards.push_back(ray);
            met_by.push_back(rays[passage.ray].met_by);
        }
        std::vector<std::optional<RayHit>> hits(onwards.size());
        scene.intersect(onwards, met_by, hits);
        going.clear();
        for (std::size_t k = 0; k < further.size(); ++k) {
            if (!hits[k]) continue;
            going.push_back(further[k]);
            going.back().hit = *hits[k];
        }
    }
    std::ranges::stable_sort(passages, {}, &Passage::ray);
    return passages;
}

std::span<const Passage> take_passages(std::span<const Passage>& all, std::size_t ray) {
    std::size_t count = 0;
    while (count < all.size() && all[count].ray == ray) ++count;
    const std::span<const Passage> own = all.first(count);
    all = all.subspan(count);
    return own;
}

const Passage* told_of(std::span<const Passage> way) {
    const Passage* told = nullptr;
    for (const Passage& passage : way) {
        if (!(passage.shown > 0.0f)) continue;
        told = &passage;
        if (passage.opacity >= 0.5f) break;
    }
    return told;
}

std::vector<WayOn> ways_on(std::span<const Passage> all, std::span<const std::optional<RayHit>> hits) {
    std::vector<WayOn> ways;
    for (std::size_t i = 0; i < hits.size(); ++i) {
        const std::span<const Passage> own = take_passages(all, i);
        const bool passes_all = !own.empty() && !own.back().ends();
        ways.push_back({own, own.empty() ? hits[i] : passes_all ? std::nullopt : std::optional(own.back().hit)});
    }
    return ways;
}

Vec3b light_through(const Scene& scene, const RayOf<Batch>& rays, const ShadowPath& path, ProgramMemory& memory) {
    std::array<std::uint32_t, batch_size> ray_kind, most;
    path.ray_kind.store_unaligned(ray_kind.data());
    for (std::size_t i = 0; i < batch_size; ++i) {
        const std::uint32_t passed = passed_by(ray_kind[i]);
        most[i] = path.max_passages > passed ? path.max_passages - passed : 0;
    }
    std::vector<RayTracer::Filtered> filters;
    const Batch is_open = scene.filtered(rays, most, filters);
    const Lanes open = store(is_open);
    keep_first(filters, open);
    if (filters.empty()) return Vec3b(is_open);
    const Lanes x = store(rays.direction.x), y = store(rays.direction.y), z = store(rays.direction.z);
    std::vector<Arrival> arrivals;
    for (const auto& [lane, hit] : filters)
        arrivals.push_back({.direction = {x[lane], y[lane], z[lane]},
                            .hit = hit,
                            .material = scene.material_of(hit),
                            .footprint_m = 0.0f,
                            .ray_kind = shadow_ray + passed_by(ray_kind[lane]) * passed_one});
    const std::vector<Transparency> found = transparencies(scene, arrivals, path.bounce, memory);
    std::array<Rgb, batch_size> left;
    for (std::size_t i = 0; i < batch_size; ++i) left[i] = Rgb(open[i]);
    for (std::size_t k = 0; k < filters.size(); ++k) left[filters[k].lane] *= found[k].color;
    return gather_vector([&](std::size_t i) { return left[i]; });
}

Rgb light_past_others(const Scene& scene, const Ray& ray, const LightLinks& links, const ShadowPath& path,
                      std::size_t lane, ProgramMemory& memory) {
    std::array<std::uint32_t, batch_size> ray_kind;
    path.ray_kind.store_unaligned(ray_kind.data());
    const std::uint32_t passed = passed_by(ray_kind[lane]);
    std::vector<Arrival> arrivals;
    Ray onwards = ray;
    while (const auto hit = scene.intersect(onwards, static_cast<Visibility>(hides_light | filters_light))) {
        onwards.near_m = behind(hit->distance_m);
        if (!is_blocker(links, scene.link_sets_of(hit->instance))) continue;
        const std::uint32_t material = scene.material_of(*hit);
        if (!scene.shaders()[material].filters_light() || passed + arrivals.size() >= path.max_passages)
            return Rgb(0.0f);
        arrivals.push_back({.direction = ray.direction,
                            .hit = *hit,
                            .material = material,
                            .footprint_m = 0.0f,
                            .ray_kind = shadow_ray + passed * passed_one});
    }
    Rgb left(1.0f);
    for (const Transparency& passing : transparencies(scene, arrivals, path.bounce, memory)) left *= passing.color;
    return left;
}

Vec3b light_left(const Scene& scene, RayOf<Batch> rays, const LightLinks& links, const ShadowPath& path,
                 ProgramMemory& memory) {
    if (has_blockers_of_its_own(links)) {
        const std::array<Ray, batch_size> each = unpack<RayOf>(rays);
        return gather_vector([&](std::size_t i) {
            return each[i].far_m > 0.0f ? light_past_others(scene, each[i], links, path, i, memory) : Rgb(0.0f);
        });
    }
    const Batch visible = scene.visibility(rays), zero(0.0f);
    if (!scene.has_transparency()) return Vec3b(visible);
    rays.far_m = select(visible > zero, rays.far_m, zero);
    return light_through(scene, rays, path, memory) * visible;
}

void light_along(const Scene& scene, std::uint32_t max_passages, const LightLinks& links, std::span<const Ray> rays,
                 std::span<Rgb> left, ProgramMemory& memory) {
    if (!scene.has_transparency() && !has_blockers_of_its_own(links)) {
        std::vector<std::uint8_t> hidden(rays.size());
        scene.occluded(rays, hidden);
        for (std::size_t i = 0; i < rays.size(); ++i) left[i] = Rgb(hidden[i] ? 0.0f : 1.0f);
        return;
    }
    constexpr Ray no_ray{.origin = Vec3f(0.0f), .direction = Vec3f(0.0f), .near_m = 0.0f, .far_m = 0.0f};
    const ShadowPath path{max_passages, 0, WordBatch(camera_ray)};
    for (std::size_t first = 0; first < rays.size(); first += batch_size) {
        const std::size_t count = std::min(batch_size, rays.size() - first);
        std::array<const Ray*, batch_size> lanes;
        for (std::size_t i = 0; i < batch_size; ++i) lanes[i] = i < count ? &rays[first + i] : &no_ray;
        const Vec3b light = light_left(scene, pack<RayOf>(lanes), links, path, memory);
        const Lanes r = store(light.x), g = store(light.y), b = store(light.z);
        for (std::size_t i = 0; i < count; ++i) left[first + i] = {r[i], g[i], b[i]};
    }
}

}  // namespace pivot
