#include "core/scene/camera.h"

#include "core/sampling/warp.h"

namespace pivot {
namespace {

/// Where rays begin and where they go, in the projection's space, and how much longer they are than deep.
struct LensRay {
    Vec3f origin, direction;
    float slant = 1.0f;
    float near_m = 0.0f;  ///< how far the origin is from where depth counts from
};

/// From a place of the lens to where the ray through its middle is in focus.
LensRay refracted(const Vec3f& middle, const Vec3f& on_lens, const Vec3f& focus, float slant) {
    return {middle + on_lens, normalize(focus - on_lens), slant};
}

LensRay lens_ray(const Perspective&, const Camera& camera, const Vec2f& place, const Vec2f& lens_m) {
    const Vec3f through(place.x, place.y, 1.0f);
    const float slant = length(through);
    if (!(camera.lens.radius_m > 0.0f)) return {Vec3f(0.0f), normalize(through), slant};
    return refracted(Vec3f(0.0f), Vec3f(lens_m, 0.0f), through * camera.lens.focus_m, slant);
}

/// Rays start at the near plane, which lies behind the camera in an orthographic view.
LensRay lens_ray(const Orthographic&, const Camera& camera, const Vec2f& place, const Vec2f& lens_m) {
    const Vec3f middle(place.x, place.y, 0.0f), forward(0.0f, 0.0f, 1.0f);
    LensRay ray = refracted(middle, Vec3f(lens_m, 0.0f), forward * camera.lens.focus_m, 1.0f);
    ray.origin += ray.direction * (camera.clip_start_m / ray.direction.z);
    ray.near_m = camera.clip_start_m;
    return ray;
}

/// The lens faces where its ray goes; x is the projection's own.
template <class AnyPanorama>
LensRay lens_ray(const AnyPanorama& panorama, const Camera& camera, const Vec2f& place, const Vec2f& lens_m) {
    const Vec3f forward = panorama.direction(place);
    if (!(camera.lens.radius_m > 0.0f)) return {Vec3f(0.0f), forward};
    const Vec3f aside = Vec3f(1.0f, 0.0f, 0.0f) - forward.x * forward;
    const Vec3f x = length_squared(aside) > 0.0f ? normalize(aside) : Vec3f(0.0f, 1.0f, 0.0f);
    const Vec3f on_lens = x * lens_m.x + cross(forward, x) * lens_m.y;
    return refracted(Vec3f(0.0f), on_lens, forward * camera.lens.focus_m, 1.0f);
}

bool sees(const Perspective&, const Vec2f&) { return true; }
bool sees(const Orthographic&, const Vec2f&) { return true; }
template <class AnyPanorama>
bool sees(const AnyPanorama& panorama, const Vec2f& place) {
    return panorama.sees(place);
}

}  // namespace

Vec2f Lens::sample_m(const Vec2f& u) const {
    Vec2f place = sample_disk(u);
    if (blades >= 3) {
        // A triangle of the polygon, which has the middle for one corner.
        const auto sides = static_cast<float>(blades);
        const float side = floor(u.x * sides), along = u.x * sides - side, half_angle = pi<float> / sides;
        const auto corner = [&](float number) {
            const float angle = rotation_rad + (2.0f * number - 1.0f) * half_angle;
            return Vec2f(cos(angle), sin(angle));
        };
        place = sqrt(u.y) * (corner(side) * (1.0f - along) + corner(side + 1.0f) * along);
    }
    return radius_m * Vec2f(place.x / ratio, place.y);
}

Ray Camera::ray_from(const Vec2f& pixel, const Vec2f& lens_place_m, float time) const {
    const Vec2f place(lerp(left, right, pixel.x / static_cast<float>(width)),
                      lerp(bottom, top, pixel.y / static_cast<float>(height)));
    const Transform placed = motion ? motion->at(time) : world_from_camera;
    return std::visit(
        [&](const auto& kind) -> Ray {
            if (!sees(kind, place)) return {placed.translation, -placed.linear[2], 0.0f, 0.0f, time};
            const LensRay ray = lens_ray(kind, *this, place, lens_place_m);
            return {placed.point(kind.in_camera(ray.origin)), normalize(placed.vector(kind.in_camera(ray.direction))),
                    (clip_start_m - ray.near_m) * ray.slant, (clip_end_m - ray.near_m) * ray.slant, time};
        },
        projection);
}

CameraFacts Camera::facts() const {
    const Mat3<float> camera_from_space = std::visit(
        [](const auto& kind) {
            return Mat3<float>(kind.in_camera(Vec3f(1.0f, 0.0f, 0.0f)), kind.in_camera(Vec3f(0.0f, 1.0f, 0.0f)),
                               kind.in_camera(Vec3f(0.0f, 0.0f, 1.0f)));
        },
        projection);
    const Transform world_from_space{world_from_camera.linear * camera_from_space, world_from_camera.translation};
    const Vec2f scale(1.0f / (right - left), 1.0f / (top - bottom));
    return {world_from_space, world_from_space.inverse(), projection, scale, Vec2f(-left, -bottom) * scale,
            clip_start_m};
}

PixelWidth Camera::pixel_width() const {
    const float wide = (right - left) / static_cast<float>(width);
    const auto width_of = [&]<class Kind>(const Kind& kind) -> PixelWidth {
        if constexpr (std::is_same_v<Kind, Perspective>) {
            return {0.0f, wide};
        } else if constexpr (std::is_same_v<Kind, Orthographic>) {
            return {wide, 0.0f};
        } else {
            const Vec2f middle(0.5f * (left + right), 0.5f * (bottom + top));
            return {0.0f, length(kind.direction(middle + Vec2f(wide, 0.0f)) - kind.direction(middle))};
        }
    };
    return std::visit(width_of, projection);
}

float Camera::depth_m(const Vec3f& point) const {
    const Vec3f from_camera = point - world_from_camera.translation;
    const auto depth_of = [&]<class Kind>(const Kind&) {
        constexpr bool has_axis = std::is_same_v<Kind, Perspective> || std::is_same_v<Kind, Orthographic>;
        return has_axis ? -dot(normalize(world_from_camera.linear[2]), from_camera) : length(from_camera);
    };
    return std::visit(depth_of, projection);
}

}  // namespace pivot
