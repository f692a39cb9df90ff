#include "core/integrators/light_lanes.h"

#include "core/integrators/area_sampling.h"
#include "core/integrators/cap_mixture.h"

namespace pivot {
namespace {

/// A cap-shaped light as all kinds of them are.
template <class T>
struct CapLightOf {
    Vec3<T> center;  ///< of a sun: the direction towards it
    T radius_m;
    T is_facing_disk;  ///< 0 or 1
    T sun_versine;     ///< above 0: this is a sun
    Vec3<T> radiance;
    Vec3<T> spot_direction;  ///< 0: not a spot
    T cos_edge;              ///< where a spot's falloff starts
    T falloff_width;
    T is_cosine;  ///< 0 or 1: whether a spot's cosine counts too
};

CapLightOf<float> cap_light(const Light& light) {
    constexpr float below_all = -2.0f;  // cosines: other lights fall off nowhere
    if (const auto* sun = std::get_if<SunLight>(&light))
        return {sun->cap.axis, 0.0f, 0.0f, sun->cap.versine, sun->radiance, Vec3f(0.0f), below_all, 1.0f, 0.0f};
    const SphereLight& sphere = *sphere_of(light);
    CapLightOf<float> cap{sphere.center,
                          sphere.radius_m,
                          sphere.is_facing_disk ? 1.0f : 0.0f,
                          0.0f,
                          sphere.radiance,
                          Vec3f(0.0f),
                          below_all,
                          1.0f,
                          0.0f};
    if (const auto* spot = std::get_if<SpotLight>(&light)) {
        cap.spot_direction = spot->direction;
        cap.cos_edge = spot->cos_half_angle;
        cap.falloff_width = spot_falloff_width(*spot);
        cap.is_cosine = spot->is_cosine ? 1.0f : 0.0f;
    }
    return cap;
}

/// Each lane's light as numbers.
template <template <class> class Numbers, class NumbersOf>
Numbers<Batch> pack_lights(const std::array<const Light*, batch_size>& lights, const NumbersOf& numbers_of) {
    std::array<Numbers<float>, batch_size> each;
    std::array<const Numbers<float>*, batch_size> lanes;
    for (std::size_t i = 0; i < batch_size; ++i) {
        const bool again = i > 0 && lights[i] == lights[i - 1];
        if (!again) each[i] = numbers_of(*lights[i]);
        lanes[i] = again ? lanes[i - 1] : &each[i];
    }
    return pack<Numbers>(lanes);
}

/// Cap-shaped lights as the lanes' points see them.
class SeenCaps {
   public:
    SeenCaps(const SurfacePointOf<Batch>& point, const std::array<const Light*, batch_size>& lights)
        : light_(pack_lights<CapLightOf>(lights, cap_light)),
          to_center_(light_.center - point.position),
          is_sun_(light_.sun_versine > Batch(0.0f)),
          is_disk_(light_.is_facing_disk > Batch(0.0f)) {
        Cap<Batch> seen = cap_of_sphere(to_center_, light_.radius_m);
        if (any(is_disk_)) {
            const Cap<Batch> disk = cap_of_facing_disk(to_center_, light_.radius_m);
            seen = {select(is_disk_, disk.axis, seen.axis), select(is_disk_, disk.versine, seen.versine)};
        }
        const Vec3b axis = select(is_sun_, light_.center, seen.axis);
        local_ = {point.frame.to_local(axis), select(is_sun_, light_.sun_versine, seen.versine)};
    }

    /// In the points' frames.
    const Cap<Batch>& local() const { return local_; }

    /// What comes from a direction in the cap, if nothing is in the way.
    Vec3b radiance(const Vec3b& wi) const {
        const Batch cos_spot = -dot(wi, light_.spot_direction);
        const Batch falloff = falloff_of((cos_spot - light_.cos_edge) / light_.falloff_width) *
                              lerp(Batch(1.0f), max(cos_spot, Batch(0.0f)), light_.is_cosine);
        return light_.radiance * falloff;
    }
    Batch reach_m(const Vec3b& wi) const {
        Batch distance = distance_to_sphere(to_center_, light_.radius_m, wi);
        if (any(is_disk_)) distance = select(is_disk_, distance_to_facing_disk(to_center_, wi), distance);
        return select(is_sun_, std::numeric_limits<Batch>::infinity(), distance * Batch(shadow_reach));
    }

   private:
    CapLightOf<Batch> light_;
    Vec3b to_center_;
    BatchMask is_sun_, is_disk_;
    Cap<Batch> local_;
};

}  // namespace

LaneSamples sample_cap_lights(const VertexBatch& vertices, const std::array<const Light*, batch_size>& lights,
                              const Vec2b& u) {
    const SurfacePointOf<Batch>& point = vertices.point;
    const SurfaceOf<Batch>& surface = vertices.surface;
    const SeenCaps caps(point, lights);
    const JointSample<Batch> s = sample_jointly(joint_surface(surface), caps.local(), u);
    const Batch cos_oh = Batch(0.5f) * length(surface.wo_local + s.wi_local);
    const Vec3b wi = point.frame.to_world(s.wi_local);
    const BatchMask faces = dot(wi, point.normal_geometric) > Batch(0.0f) && s.wi_local.z > Batch(0.0f);
    // What is sampled is the cosine from the frame's normal.
    const Batch bumped = surface.bump.cosine(s.wi_local) / max(s.wi_local.z, Batch(1e-4f));
    Vec3b reflected = surface.diffuse * (s.diffuse * bumped);
    if (any(surface.has_lobes()))
        reflected +=
            eval_diffuse_lobes(surface, s.wi_local) * (pi<Batch> * s.diffuse / max(s.wi_local.z, Batch(1e-4f)));
    if (any(surface.has_glossy())) reflected += surface.fresnel.at(cos_oh) * s.glossy;
    return {.sample = {.radiance = select(faces, reflected * caps.radiance(wi), Vec3b(Batch(0.0f))),
                       .wi = wi,
                       .reach_m = caps.reach_m(wi)},
            .valid = s.valid,
            .pdf_omega = Batch(0.0f),
            .needs_bsdf = BatchMask(false)};
}

LaneSamples sample_cap_lights_by_lobes(const VertexBatch& vertices, const std::array<const Light*, batch_size>& lights,
                                       const Vec2b& u) {
    const SurfacePointOf<Batch>& point = vertices.point;
    const SurfaceOf<Batch>& surface = vertices.surface;
    const SeenCaps caps(point, lights);
    const CapMixture<Batch> mixture(surface, caps.local());
    const Vec3b wi_local = mixture.sample(u), wi = point.frame.to_world(wi_local);
    const Batch pdf = mixture.pdf_omega(wi_local);
    return {.sample = {.radiance = select(vertices.is_open_to(wi) && pdf > Batch(0.0f),
                                          eval(surface, wi_local) * caps.radiance(wi) / max(pdf, tiny<Batch>),
                                          Vec3b(Batch(0.0f))),
                       .wi = wi,
                       .reach_m = caps.reach_m(wi)},
            .valid = mixture.holds(),
            .pdf_omega = pdf,
            .needs_bsdf = mixture.needs_bsdf_samples()};
}

LaneSamples sample_area_lights(const VertexBatch& vertices, const std::array<const Light*, batch_size>& lights,
                               const Vec2b& u, bool lamps_jointly) {
    const SurfacePointOf<Batch>& point = vertices.point;
    const SurfaceOf<Batch>& surface = vertices.surface;
    const auto light =
        pack_lights<AreaLightOf>(lights, [](const Light& of_lane) { return numbers_of(std::get<AreaLight>(of_lane)); });
    const Batch zero(0.0f);
    const AreaView<Batch> view = view_from(light, point);
    const BatchMask is_triangle = view.triangle, reached = dot(view.center, view.normal) < zero;
    const BatchMask transmits = surface.transmits(), is_alone = BatchMask(!lamps_jointly) && !is_triangle;
    const AreaLobes<Batch> lobes(surface);
    LaneSamples lit{.sample = {Vec3b(zero), point.frame.z, zero},
                    .valid = BatchMask(true),
                    .pdf_omega = Batch(1.0f),
                    .needs_bsdf = needs_bsdf_samples(view, lobes) || transmits || BatchMask(!lamps_jointly)};
    if (!any(reached)) return lit;
    Vec2b place = even_place(view, u);
    Batch pdf_xy = inverse(relative_area(view));
    if (const BatchMask even = is_even_enough(view) || is_alone || transmits; any(!even)) {
        const BatchMask finer = needs_finer_grid(lobes);
        AreaSample<Batch> joint{place, pdf_xy};
        if (any(!finer)) joint = AreaSampler<Batch>(lobes, view).sample(u);
        if (any(finer)) {
            const AreaSample<Batch> fine = FinerAreaSampler<Batch>(lobes, view).sample(u);
            joint.place = {select(finer, fine.place.x, joint.place.x), select(finer, fine.place.y, joint.place.y)};
            joint.pdf = select(finer, fine.pdf, joint.pdf);
        }
        place = {select(even, place.x, joint.place.x), select(even, place.y, joint.place.y)};
        pdf_xy = select(even, pdf_xy, max(joint.pdf, tiny<Batch>));
    }
    const auto seen = see(view, place);
    lit.sample.wi = point.frame.to_world(seen.wi);
    lit.sample.reach_m = seen.distance_m * Batch(shadow_reach);
    const Batch cosine = max(-dot(seen.wi, view.normal), tiny<Batch>);
    lit.sample.reach_m -= select(is_triangle, (light.surface_error_m + point.error_m) / cosine, zero);
    const BatchMask faces = reached && vertices.is_open_to(lit.sample.wi) && view.is_on(place);
    lit.pdf_omega = pdf_xy / max(seen.omega_per_xy, tiny<Batch>);
    const Vec3b open(seen.wi.x, seen.wi.y, select(transmits, seen.wi.z, max(seen.wi.z, Batch(1e-6f))));
    lit.sample.radiance = eval(surface, open) * light.radiance * select(faces, seen.omega_per_xy / pdf_xy, zero);
    if (any(light.inverse_tan_spread > zero))
        lit.sample.radiance = lit.sample.radiance * spread_falloff(light.inverse_tan_spread, cosine);
    return lit;
}

}  // namespace pivot
