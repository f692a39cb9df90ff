#include "core/integrators/subsurface.h"

#include "core/bsdf/subsurface_entry.h"
#include "core/integrators/media_ray.h"
#include "core/media/phase.h"
#include "core/media/subsurface_medium.h"

namespace pivot {
namespace {

/// A walk is over after so many collisions, and comes out where it entered: so much light is left of the whitest alone.
constexpr int max_collisions = 1024;
/// After so many, scattering is as good as isotropic, by similarity [Wyman89].
constexpr int max_anisotropic_collisions = 9;
/// Walks that carry less end by Russian roulette.
constexpr float sure_of_survival = 0.25f;

SubsurfaceMedium medium_of(const Subsurface<float>::Parameters& inside) {
    SubsurfaceMedium medium{.sigma_t = Rgb(0.0f), .albedo = Rgb(0.0f), .g = inside.anisotropy};
    // The fit ends at these; beyond, similarity goes on.
    const bool is_fitted = !(inside.is_similar > 0.0f) && medium.g >= 0.0f;
    if (is_fitted) medium.g = std::min(medium.g, 0.9f);
    for (int c = 0; c < 3; ++c) {
        constexpr float least_m = 1e-8f;
        const float albedo = std::min(inside.albedo[c], 1.0f);
        float path_m = std::max(inside.radius_m[c], least_m);
        if (inside.is_diffusion_length > 0.0f) path_m *= path_per_diffusion_length(albedo, inside.ior);
        medium.sigma_t[c] = 1.0f / (path_m * (is_fitted ? 1.0f - medium.g : 1.0f));
        medium.albedo[c] =
            is_fitted ? scattering_albedo_by_fit(albedo, medium.g) : scattering_albedo_by_similarity(albedo, medium.g);
    }
    return medium;
}

/// A walker, and what of each colour it carries.
struct Walker {
    Ray ray;
    Rgb weight;
};

/// Walks from where a path enters until the surface is met, and leaves it along the ray. Nothing: it was lost.
std::optional<RayHit> walk(const InnerRays& inner, const Arrival& entry, SubsurfaceMedium medium, Walker& walker,
                           RandomStream& random) {
    Phase phase{PhaseKind::henyey_greenstein, medium.g};
    for (int collision = 0; collision < max_collisions; ++collision) {
        if (collision == max_anisotropic_collisions && phase.g != 0.0f) {
            const Rgb scattered = medium.sigma_t * medium.albedo;
            const Rgb similar = scattered * (1.0f - phase.g);
            medium.sigma_t += similar - scattered;
            medium.albedo = similar / medium.sigma_t;
            phase.g = 0.0f;
        }
        // One colour's distance serves all of them [Chiang16, 3]; which is chosen by what goes on of it.
        const Rgb wanted = walker.weight * medium.albedo;
        const float total = wanted.x + wanted.y + wanted.z;
        if (!(total > 0.0f)) return std::nullopt;
        const Rgb share = wanted / total;
        const float u = random.next();
        const int color = u < share.x ? 0 : (u < share.x + share.y || !(share.z > 0.0f) ? 1 : 2);
        const float distance_m = random.next_depth() / medium.sigma_t[color];
        walker.ray.far_m = distance_m;
        const auto hit = inner.intersect(walker.ray, entry.hit.instance);
        const Rgb through = glm::exp(-medium.sigma_t * (hit ? hit->distance_m : distance_m));
        if (hit) {
            walker.weight *= through / std::max(dot(share, through), tiny<float>);
            return hit;
        }
        const Rgb density = medium.sigma_t * through;
        walker.weight *= medium.albedo * density / std::max(dot(share, density), tiny<float>);
        const float carried = max_component(walker.weight);
        if (carried < sure_of_survival) {
            if (random.next() * sure_of_survival >= carried) return std::nullopt;
            walker.weight *= sure_of_survival / carried;
        }
        walker.ray.origin += distance_m * walker.ray.direction;
        walker.ray.direction = sample(phase, walker.ray.direction, {random.next(), random.next()});
    }
    walker.ray.direction = -entry.direction;
    return entry.hit;
}

/// Which way a path enters: refracted by a rough boundary, or by the cosine. From the side of wo, into the other.
Vec3f entry_direction(const SurfacePoint& point, const Vec3f& wo_local, const Subsurface<float>::Parameters& inside,
                      float u_kind, const Vec2f& u) {
    Vec3f wi_local;
    if (u_kind < inside.cosine_entry) {
        wi_local = -sample_cosine_hemisphere(u);
    } else {
        const float alpha = std::max(inside.entry_alpha, min_alpha), eta = 1.0f / inside.ior;
        const Vec3f h = ggx_sample_normal(wo_local, alpha, alpha, u);
        const float cos_o = dot(wo_local, h);
        wi_local = (eta * cos_o - safe_sqrt(1.0f - sqr(eta) * (1.0f - sqr(cos_o)))) * h - eta * wo_local;
    }
    const Vec3f wi = point.frame.to_world(wi_local);
    // Few lie outside, of what leans one way in shading and another in truth: these enter mirrored.
    return wi - std::max(2.0f * dot(wi, point.normal_geometric), 0.0f) * point.normal_geometric;
}

}  // namespace

BatchMask walk_beneath(const Work& work, const BouncePlan& plan, std::span<const Path> paths,
                       const VertexBatch& vertices, const Batch& u_lobe, Paths& exits) {
    BatchMask entered(false);
    visit_entry(vertices.surface, u_lobe,
                [&](const Subsurface<Batch>&, const Batch&, const Batch&, const BatchMask& by_this) {
                    entered = entered || by_this;
                });
    entered = entered && vertices.is_vertex();
    if (!any(entered)) return entered;
    const auto have_entered = store(entered);
    const Lanes u_lobes = store(u_lobe);
    for (std::size_t i = 0; i < paths.size(); ++i) {
        if (!have_entered[i]) continue;
        const Vertex& vertex = vertices.lane(i);
        const Path& path = paths[i];
        visit_entry(vertex.surface, u_lobes[i], [&](const Subsurface<float>& lobe, float probability, float u, bool) {
            const Sampler& sampler = work.samplers[path.sample];
            RandomStream random{stream_seed(sampler, plan.dimensions.lobe())};
            const Vec3f wi = entry_direction(vertex.point, vertex.surface.wo_local, lobe.inside, u,
                                             sampler.point(plan.dimensions.direction()));
            const auto each = [&](auto of) { return Rgb(of(0), of(1), of(2)); };
            Walker walker{{.origin = vertex.point.ray_origin(wi), .direction = wi, .time = vertex.point.time},
                          each([&](int c) { return lobe.enters[c] > 0.0f ? 1.0f : 0.0f; })};
            const auto hit = walk(work.scene.inner_rays(), path.arrival, medium_of(lobe.inside), walker, random);
            if (!hit) return;
            Path exit = path;
            exit.arrival.direction = -walker.ray.direction;
            exit.arrival.hit = *hit;
            exit.arrival.material = work.scene.material_of(*hit);
            // The walk itself absorbs what makes the albedo.
            exit.throughput *= walker.weight * lobe.enters / (max(lobe.inside.albedo, Vec3f(1e-6f)) * probability);
            exits.push_back(exit);
        });
    }
    return entered;
}

MaterialOf<Batch> exit_material(const Scene& scene, std::span<const Arrival* const> arrivals) {
    MaterialOf<Batch> material;
    material.diffuse = Vec3b(Batch(1.0f));
    const BatchMask is_disney = gather([&](std::size_t i) {
                                    const Arrival& arrival = *arrivals[std::min(i, arrivals.size() - 1)];
                                    return leaves_by_disney(scene.shaders()[arrival.material].constants) ? 1.0f : 0.0f;
                                }) > Batch(0.0f);
    if (!any(is_disney)) return material;
    // Without roughness it is what light leaves by; the way that it takes is not wo's.
    for_each_lobe_kind<Batch>([&]<class L>(const Batch& kind) {
        if constexpr (std::same_as<L, DisneyDiffuse<Batch>>) {
            material.lobes[0].kind = select(is_disney, kind, Batch(0.0f));
            material.lobes[0].write(DisneyDiffuse<Batch>::Parameters{.roughness = Batch(0.0f)});
        }
    });
    material.diffuse = select(is_disney, Vec3b(Batch(0.0f)), material.diffuse);
    return material;
}

}  // namespace pivot
