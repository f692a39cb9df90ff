// What Blender's camera sees, of every kind, and through a lens of some width.
#pragma once

#include "core/geometry/projection.h"
#include "core/math/moving_transform.h"
#include "core/scene/ray_tracer.h"
#include "core/scene/shutter.h"
#include "core/shaders/place.h"

namespace pivot {

/// A rectangle of pixels of the full frame, counted from the bottom left.
struct Window {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;

    int width() const { return x1 - x0; }
    int height() const { return y1 - y0; }
};

/// A thin lens, in focus on a plane, or at a distance from a panorama's one point of view.
struct Lens {
    float radius_m = 0.0f;  ///< 0: a pinhole
    float focus_m = 1.0f;
    int blades = 0;  ///< sides of its stop, a regular polygon; fewer than 3: it is round
    float rotation_rad = 0.0f;
    float ratio = 1.0f;  ///< how much narrower the stop is made along x

    /// A place of the stop, even over its area. u in [0, 1)^2.
    Vec2f sample_m(const Vec2f& u) const;
};

/// How wide a pixel is where rays start, and how much wider for each m from there.
struct PixelWidth {
    float start_m, per_m;

    float at(float distance_m) const { return start_m + per_m * distance_m; }
    PixelWidth operator*(float part) const { return {start_m * part, per_m * part}; }
};

/// Camera space looks down -z, y up.
struct Camera {
    Transform world_from_camera;
    std::shared_ptr<const MovingTransform> motion{};  ///< of world_from_camera; null: it stays where it is
    std::shared_ptr<const Shutter> shutter{};         ///< null: open all the time
    Projection projection;
    Lens lens;
    float left = -1, right = 1, bottom = -1, top = 1;  ///< the full frame, in places of the projection
    int width = 0, height = 0;
    Window window;
    float clip_start_m = 0.0f;
    float clip_end_m = std::numeric_limits<float>::infinity();

    /// Through a place of the full frame, in pixels from the bottom left (a pixel's centre is at .5), and the middle of
    /// the lens. Where a fisheye sees nothing there is no such ray: its far_m is 0.
    Ray ray(const Vec2f& pixel, float time = middle_time) const { return ray_from(pixel, Vec2f(0.0f), time); }
    /// Through a place of the lens too. u_lens in [0, 1)^2.
    Ray ray(const Vec2f& pixel, const Vec2f& u_lens, float time = middle_time) const {
        return ray_from(pixel, lens.sample_m(u_lens), time);
    }
    /// When it takes a sample. u in [0, 1).
    float time(float u) const { return shutter ? shutter->time(u) : u; }

    /// What shaders ask of it.
    CameraFacts facts() const;

    /// In the middle of the frame.
    PixelWidth pixel_width() const;

    /// Distance in front of the camera along its axis, or from a panorama.
    float depth_m(const Vec3f& point) const;

   private:
    Ray ray_from(const Vec2f& pixel, const Vec2f& lens_place_m, float time) const;
};

}  // namespace pivot
