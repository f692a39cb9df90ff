#include "core/integrators/vertex_lanes.h"

namespace pivot {
namespace {

/// A cap-shaped light as all kinds of them are.
struct CapLight {
    Vec3f center;  ///< of a sun: the direction towards it
    float radius_m;
    float is_facing_disk;  ///< 0 or 1
    float sun_versine;     ///< above 0: this is a sun
    Rgb radiance;
    Vec3f spot_direction;  ///< 0: not a spot
    float cos_edge;        ///< where a spot's falloff starts
    float falloff_width;
    float is_cosine;  ///< 0 or 1: whether a spot's cosine counts too
};

CapLight cap_light(const Light& light) {
    constexpr float below_all = -2.0f;  // cosines: other lights fall off nowhere
    if (const auto* sun = std::get_if<SunLight>(&light))
        return {sun->cap.axis, 0.0f, 0.0f, sun->cap.versine, sun->radiance, Vec3f(0.0f), below_all, 1.0f, 0.0f};
    const SphereLight& sphere = *sphere_of(light);
    CapLight cap{sphere.center,
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

Vec3b times(const Vec3b& color, Batch factor) { return {color.x * factor, color.y * factor, color.z * factor}; }

}  // namespace

VertexLanes vertex_lanes(std::span<const Vertex> vertices) {
    // As loads from one vertex to the next: filling a batch by way of memory waits for each store.
    static_assert(sizeof(Vertex) % sizeof(float) == 0);
    const auto lane = [&](std::size_t i) -> const Vertex& { return vertices[std::min(i, vertices.size() - 1)]; };
    using Indices = xsimd::batch<std::int32_t>;
    std::array<std::int32_t, batch_size> places;
    for (std::size_t i = 0; i < batch_size; ++i)
        places[i] = static_cast<std::int32_t>(std::min(i, vertices.size() - 1) * (sizeof(Vertex) / sizeof(float)));
    const Indices indices = Indices::load_unaligned(places.data());
    const auto number = [&](const float& of_first) { return Batch::gather(&of_first, indices); };
    const auto vector = [&](const Vec3f& of_first) {
        return Vec3b(number(of_first.x), number(of_first.y), number(of_first.z));
    };
    const SurfacePoint& point = vertices[0].point;
    const Surface& surface = vertices[0].surface;
    const LobeFresnel& fresnel = surface.fresnel;
    VertexLanes lanes;
    lanes.position = vector(point.position);
    lanes.normal_geometric = vector(point.normal_geometric);
    lanes.frame = {vector(point.frame.x), vector(point.frame.y), vector(point.frame.z)};
    lanes.error_m = number(point.error_m);
    lanes.diffuse = vector(surface.diffuse);
    lanes.schlick_f0 = vector(fresnel.schlick_f0);
    lanes.schlick_f90 = vector(fresnel.schlick_f90);
    lanes.has_dielectric = std::any_of(vertices.begin(), vertices.end(), [](const Vertex& v) {
        return max_component(v.surface.fresnel.dielectric_f90) > 0.0f;
    });
    lanes.dielectric_f0 = lanes.dielectric_f90 = Vec3b(Batch(0.0f));
    lanes.ior = Batch(1.5f);
    if (lanes.has_dielectric) {
        lanes.dielectric_f0 = vector(fresnel.dielectric_f0);
        lanes.dielectric_f90 = vector(fresnel.dielectric_f90);
        lanes.ior = number(fresnel.ior);
    }
    const auto mean = [](const Vec3b& c) { return (c.x + c.y + c.z) * Batch(1.0f / 3.0f); };
    lanes.surface = {.wo_local = vector(point.wo_local),
                     .alpha = number(surface.alpha),
                     .diffuse = mean(lanes.diffuse),
                     .fresnel_f0 = mean(lanes.schlick_f0 + lanes.dielectric_f0),
                     .fresnel_f90 = mean(lanes.schlick_f90 + lanes.dielectric_f90)};
    lanes.glossy_probability = number(surface.glossy_probability);
    std::array<Sampler, batch_size> samplers;
    for (std::size_t i = 0; i < batch_size; ++i) samplers[i] = lane(i).sampler;
    lanes.sampler = sampler_lanes(samplers);
    return lanes;
}

Batch VertexLanes::bsdf_pdf_omega(const Vec3b& wi_local) const {
    const Batch zero(0.0f), cosine = max(wi_local.z, zero);
    Batch pdf = (Batch(1.0f) - glossy_probability) * cosine * Batch(1.0f / pi<float>);
    if (any(glossy_probability > zero)) {
        const Batch glossy = ggx_pdf_omega(surface.wo_local, wi_local, surface.alpha, surface.alpha);
        pdf += select(glossy_probability > zero && wi_local.z > zero, glossy_probability * glossy, zero);
    }
    return pdf;
}

LaneSamples sample_cap_lights(const VertexLanes& lanes, const LaneValues<const Light*>& lights, const Vec2b& u) {
    LaneValues<CapLight> of_caps;
    of_caps.same = lights.same;
    for (std::size_t i = 0; i < (lights.same ? 1 : batch_size); ++i) of_caps.values[i] = cap_light(*lights.values[i]);
    const auto number = [&](auto field) { return of_caps.number([&](const CapLight& l) { return l.*field; }); };
    const auto vector = [&](auto field) { return of_caps.vector([&](const CapLight& l) { return l.*field; }); };
    const Vec3b center = vector(&CapLight::center), to_center = center - lanes.position;
    const Batch radius = number(&CapLight::radius_m), sun_versine = number(&CapLight::sun_versine);
    const BatchMask is_sun = sun_versine > Batch(0.0f);
    const BatchMask is_disk = number(&CapLight::is_facing_disk) > Batch(0.0f);
    Cap<Batch> seen = cap_of_sphere(to_center, radius);
    if (any(is_disk)) {
        const Cap<Batch> disk = cap_of_facing_disk(to_center, radius);
        seen = {select(is_disk, disk.axis, seen.axis), select(is_disk, disk.versine, seen.versine)};
    }
    const Cap<Batch> cap{select(is_sun, center, seen.axis), select(is_sun, sun_versine, seen.versine)};

    const JointSample<Batch> s =
        sample_jointly(lanes.surface, Cap<Batch>{lanes.frame.to_local(cap.axis), cap.versine}, u);
    const Batch cos_oh = Batch(0.5f) * length(lanes.surface.wo_local + s.wi_local);
    const Vec3b wi = lanes.frame.to_world(s.wi_local);
    const BatchMask faces = dot(wi, lanes.normal_geometric) > Batch(0.0f) && s.wi_local.z > Batch(0.0f);
    const Batch cos_spot = -dot(wi, vector(&CapLight::spot_direction));
    const Batch falloff = falloff_of((cos_spot - number(&CapLight::cos_edge)) / number(&CapLight::falloff_width)) *
                          lerp(Batch(1.0f), max(cos_spot, Batch(0.0f)), number(&CapLight::is_cosine));
    const Vec3b reflected = times(lanes.diffuse, s.diffuse) + times(lanes.fresnel(cos_oh), s.glossy);
    Batch distance = distance_to_sphere(to_center, radius, wi);
    if (any(is_disk)) distance = select(is_disk, distance_to_facing_disk(to_center, wi), distance);
    return {.radiance = times(reflected * vector(&CapLight::radiance), select(faces, falloff, Batch(0.0f))),
            .wi = wi,
            .reach_m = select(is_sun, std::numeric_limits<Batch>::infinity(), distance * Batch(shadow_reach)),
            .valid = s.valid,
            .pdf_omega = Batch(0.0f)};
}

LaneSamples sample_area_lights(const VertexLanes& lanes, const LaneValues<const AreaLight*>& lights, const Vec2b& u) {
    const auto vector = [&](auto field) { return lights.vector([&](const AreaLight* l) { return l->*field; }); };
    const Batch shape = lights.number([](const AreaLight* l) { return static_cast<float>(l->shape); });
    const auto is_shape = [&](AreaShape s) { return shape == Batch(static_cast<float>(s)); };
    AreaView<Batch> view{
        .center = lanes.frame.to_local(vector(&AreaLight::center) - lanes.position),
        .half_u = lanes.frame.to_local(vector(&AreaLight::half_u)),
        .half_v = lanes.frame.to_local(vector(&AreaLight::half_v)),
        .normal = lanes.frame.to_local(vector(&AreaLight::normal)),
        .parallelogram_m2 = lights.number([](const AreaLight* l) { return parallelogram_m2(*l); }),
        .ellipse = is_shape(AreaShape::ellipse),
        .triangle = is_shape(AreaShape::triangle),
    };
    const Batch zero(0.0f),
        two_sided = lights.number([](const AreaLight*l) { return l->is_two_sided() ? 1.0f : 0.0f; });
    const Batch facing = dot(view.center, view.normal);
    view.normal = select(two_sided > zero && facing > zero, -view.normal, view.normal);
    const BatchMask reached = facing < zero || (two_sided > zero && facing > zero);
    LaneSamples samples{
        .radiance = Vec3b(zero), .wi = lanes.frame.z, .reach_m = zero, .valid = zero == zero, .pdf_omega = Batch(1.0f)};
    if (!any(reached)) return samples;
    const AreaSampler<Batch> sampler(lanes.surface, view);
    const Vec2b place = sampler.sample(u);
    const auto seen = sampler.see(place.x, place.y);
    samples.wi = lanes.frame.to_world(seen.wi);
    samples.reach_m = seen.distance_m * Batch(shadow_reach);
    if (const Batch error_m = lights.number([](const AreaLight* l) { return surface_error_m(*l); });
        any(error_m > zero)) {
        const Batch cosine = max(-dot(seen.wi, view.normal), tiny<Batch>);
        samples.reach_m -= select(error_m > zero, (error_m + lanes.error_m) / cosine, zero);
    }
    const BatchMask lit = reached && seen.wi.z > zero && dot(samples.wi, lanes.normal_geometric) > zero;
    const Batch pdf_xy = max(sampler.pdf(place), tiny<Batch>);
    const Batch weight = select(lit, seen.omega_per_xy / pdf_xy, zero);
    samples.pdf_omega = pdf_xy / max(seen.omega_per_xy, tiny<Batch>);
    const Vec3b& wo = lanes.surface.wo_local;
    const Batch alpha = lanes.surface.alpha, cos_i = max(seen.wi.z, Batch(1e-6f));
    Vec3b reflected = times(lanes.diffuse, cos_i * Batch(1.0f / pi<float>));
    if (any(lanes.surface.fresnel_f0 + lanes.surface.fresnel_f90 > zero)) {
        const Vec3b above(seen.wi.x, seen.wi.y, cos_i);
        const Batch cos_oh = Batch(0.5f) * length(wo + above);
        reflected += times(lanes.fresnel(cos_oh), ggx_eval(wo, above, alpha, alpha));
    }
    samples.radiance = times(reflected * vector(&AreaLight::radiance), weight);
    return samples;
}

}  // namespace pivot
