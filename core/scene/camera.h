// A pinhole camera: what Blender's perspective camera sees.
#pragma once

#include "core/math/transform.h"
#include "core/scene/ray_tracer.h"
#include "core/shaders/place.h"

namespace pivot {

/// A rectangle of pixels of the full frame, counted from the bottom left.
struct Window {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;

    int width() const { return x1 - x0; }
    int height() const { return y1 - y0; }
};

/// Camera space looks down -z, y up. The view plane lies at z = -1 and holds the full frame.
struct Camera {
    Transform world_from_camera;
    float left = -1, right = 1, bottom = -1, top = 1;
    int width = 0, height = 0;
    Window window;
    float clip_start_m = 0.0f;
    float clip_end_m = std::numeric_limits<float>::infinity();

    /// Through a place of the full frame, in pixels from the bottom left (a pixel's centre is at .5).
    Ray ray(const Vec2f& pixel) const {
        const Vec3f through{lerp(left, right, pixel.x / static_cast<float>(width)),
                            lerp(bottom, top, pixel.y / static_cast<float>(height)), -1.0f};
        const float slant = length(through);
        return {world_from_camera.translation, normalize(world_from_camera.vector(through)), clip_start_m * slant,
                clip_end_m * slant};
    }

    /// What shaders ask of it.
    CameraFacts facts() const {
        const Vec2f scale(1.0f / (right - left), 1.0f / (top - bottom));
        return {world_from_camera, world_from_camera.inverse(), scale, Vec2f(-left, -bottom) * scale, clip_start_m};
    }

    /// How wide a pixel is, per m from the camera.
    float pixel_spread() const { return (right - left) / static_cast<float>(width); }

    /// Distance in front of the camera along its axis.
    float depth_m(const Vec3f& point) const {
        return -dot(normalize(world_from_camera.linear[2]), point - world_from_camera.translation);
    }
};

}  // namespace pivot
