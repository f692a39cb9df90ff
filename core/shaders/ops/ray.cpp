// How a place is seen: by what ray, and how much of it a boundary would reflect.
#include "core/shaders/ops/spaces.h"
#include "core/shaders/ops/tables.h"

namespace pivot {
namespace {

const Batch zero(0.0f), one(1.0f);

/// settings: the kinds of rays, a sum of RayKind.
Batch ray_is(Settings<1> settings, const Place& place) {
    const WordBatch kinds(static_cast<std::uint32_t>(settings[0]));
    return select(equal(place.lanes.ray_kind & kinds, WordBatch(0u)), zero, one);
}

/// How much of a camera's ray it does not see. [Cycles 4.5 kernel/camera/camera.h, camera_sample_perspective etc.]
Batch unseen_m(const Perspective&, const Place& place) {
    return divided(Batch(place.lanes.camera->clip_start_m) * place.lanes.ray_length_m,
                   camera_from_world_point(place, place.position).z);
}
Batch unseen_m(const Orthographic&, const Place&) { return zero; }
template <class AnyPanorama>
Batch unseen_m(const AnyPanorama&, const Place& place) {
    return Batch(place.lanes.camera->clip_start_m);
}

Batch ray_length(const Place& place) {
    if (place.lanes.is_world()) return place.lanes.ray_length_m;
    const Batch whole = place.lanes.ray_length_m;
    const Batch unseen =
        std::visit([&](const auto& kind) { return unseen_m(kind, place); }, place.lanes.camera->projection);
    return select(equal(place.lanes.ray_kind & WordBatch(ray_kinds), WordBatch(camera_ray)), whole - unseen, whole);
}

/// The light that the world sheds counts as one further. [Cycles 4.5 svm/light_path.h:61-70]
Batch ray_depth(const Place& place) {
    const Batch bounce = xsimd::to_float(std::bit_cast<IndexBatch>(place.lanes.bounce));
    return place.lanes.is_world() ? bounce + one : bounce;
}

/// How many transparent surfaces the ray's path has passed.
Batch transparent_depth(const Place& place) {
    return xsimd::to_float(std::bit_cast<IndexBatch>(place.lanes.ray_kind >> 5));
}

/// Reflectance of a dielectric boundary by the cosine of either side, 1 where all is reflected.
Batch reflectance(Batch cosine, Batch ior) {
    const Batch c = abs(cosine), g2 = ior * ior - one + c * c, g = sqrt(max(g2, zero));
    const Batch s = (g - c) / (g + c), p = (c * (g + c) - one) / (c * (g - c) + one);
    return select(g2 > zero, Batch(0.5f) * s * s * (one + p * p), one);
}

/// [Cycles 4.5 svm/fresnel.h]
Batch fresnel(const Place& place, const Vec3b& normal, Batch ior) {
    const Batch outside = max(ior, Batch(1e-5f));
    return reflectance(dot(place.lanes.wo, normal), select(place.lanes.front < zero, one / outside, outside));
}

Batch layer_weight_fresnel(const Place& place, const Vec3b& normal, Batch blend) {
    return fresnel(place, normal, one / max(one - blend, Batch(1e-5f)));
}

Batch layer_weight_facing(const Place& place, const Vec3b& normal, Batch blend) {
    const Batch facing = abs(dot(place.lanes.wo, normal)), half(0.5f);
    const Batch share = min(max(blend, zero), Batch(1.0f - 1e-5f));
    const Batch exponent = select(share < half, share + share, half / (one - share));
    return one - select(blend == half, facing, power(facing, exponent));
}

/// settings: how many rays tell, whether those into the surface, and whether the object hides itself alone.
/// [Cycles 4.5 svm/ao.h]
Batch openness(Settings<3> settings, const Place& place, const Vec3b& normal, Batch distance_m) {
    const auto ray_count = static_cast<std::uint32_t>(settings[0]);
    if (!place.lanes.openness || ray_count == 0) return one;
    const Vec3b out = unit(settings[1] != 0.0f ? -normal : normal);
    return (*place.lanes.openness)({out, distance_m, ray_count, settings[2] != 0.0f});
}

constexpr std::array ops{
    op<ray_is>("ray_is"),
    op<ray_length>("ray_length"),
    op<ray_depth>("ray_depth"),
    op<transparent_depth>("transparent_depth"),
    op<fresnel>("fresnel"),
    op<layer_weight_fresnel>("layer_weight_fresnel"),
    op<layer_weight_facing>("layer_weight_facing"),
    op<openness>("openness"),
};

}  // namespace

std::span<const OpKind> ray_ops() { return ops; }

}  // namespace pivot
