// How a camera's picture is of the directions around it, or, of an orthographic one, of a plane. A place is one of the
// picture's own plane. Directions are in the space that shaders know as the camera's: a perspective or orthographic one
// looks down +z with y up, a panorama down +x with z up, a mirror ball down -y with z up. [Cycles 4.5
// kernel/camera/projection.h, blender/camera.cpp blender_camera_matrix]
#pragma once

#include <array>
#include <variant>

#include "core/math/vector.h"

namespace pivot {

/// Places are those of the plane z = 1.
struct Perspective {
    static Vec3f in_camera(const Vec3f& v) { return {v.x, v.y, -v.z}; }
};

/// Places are x and y in m.
struct Orthographic {
    static Vec3f in_camera(const Vec3f& v) { return {v.x, v.y, -v.z}; }
};

/// A panorama looks down +x. Places of the whole picture are those of the unit square.
struct Panorama {
    /// To a camera that looks down -z, y up.
    static Vec3f in_camera(const Vec3f& v) { return {-v.y, v.z, -v.x}; }
};

/// Even in longitude and latitude.
struct Equirectangular : Panorama {
    float longitude_min = -pi<float>, longitude_max = pi<float>;
    float latitude_min = -0.5f * pi<float>, latitude_max = 0.5f * pi<float>;

    bool sees(const Vec2f&) const { return true; }
    Vec3f direction(const Vec2f& place) const {
        const float longitude = lerp(longitude_min, longitude_max, place.x);
        const float latitude = lerp(latitude_min, latitude_max, place.y);
        return {cos(latitude) * cos(longitude), -cos(latitude) * sin(longitude), sin(latitude)};
    }
    template <class T>
    Vec2<T> place(const Vec3<T>& direction) const {
        const T longitude = atan2(-direction.y, direction.x);
        const T latitude = asin(min(max(direction.z, T(-1)), T(1)));
        return {(longitude - T(longitude_min)) * T(1.0f / (longitude_max - longitude_min)),
                (latitude - T(latitude_min)) * T(1.0f / (latitude_max - latitude_min))};
    }
};

/// A cylinder around the camera, even in longitude and height.
struct CentralCylindrical : Panorama {
    float longitude_min = -pi<float>, longitude_max = pi<float>;
    float height_min = -1.0f, height_max = 1.0f;  ///< over the radius

    bool sees(const Vec2f&) const { return true; }
    Vec3f direction(const Vec2f& place) const {
        const float longitude = lerp(longitude_min, longitude_max, place.x);
        return normalize(Vec3f(cos(longitude), -sin(longitude), lerp(height_min, height_max, place.y)));
    }
    template <class T>
    Vec2<T> place(const Vec3<T>& direction) const {
        const T longitude = atan2(-direction.y, direction.x);
        const T level = sqrt(max(sqr(direction.x) + sqr(direction.y), tiny<T>));
        return {(longitude - T(longitude_min)) * T(1.0f / (longitude_max - longitude_min)),
                (direction.z / level - T(height_min)) * T(1.0f / (height_max - height_min))};
    }
};

/// Rotationally symmetric about the axis: what its kinds share. size: of the picture, in the measure of its radius.
struct Fisheye : Panorama {
    static Vec2f from_middle(const Vec2f& place, const Vec2f& size) { return (place - Vec2f(0.5f)) * size; }
    static float radius(const Vec2f& from_middle) { return sqrt(dot(from_middle, from_middle)); }
    static Vec3f direction_at(float angle, const Vec2f& from_middle) {
        const Vec2f side = from_middle * (sin(angle) / max(radius(from_middle), tiny<float>));
        return {cos(angle), -side.x, side.y};
    }
    template <class T>
    static T angle(const Vec3<T>& direction) {
        return atan2(sqrt(sqr(direction.y) + sqr(direction.z)), direction.x);
    }
    template <class T>
    static Vec2<T> place_at(const T& radius, const Vec3<T>& direction, const Vec2f& size) {
        const T scale = radius / sqrt(max(sqr(direction.y) + sqr(direction.z), tiny<T>));
        return {T(0.5f) - direction.y * scale * T(1.0f / size.x), T(0.5f) + direction.z * scale * T(1.0f / size.y)};
    }
};

/// The angle from the axis grows evenly, to half the field of view at the square's sides.
struct FisheyeEquidistant : Fisheye {
    float fov_rad = pi<float>;

    static Vec2f size() { return Vec2f(2.0f); }
    bool sees(const Vec2f& place) const { return radius(from_middle(place, size())) <= 1.0f; }
    Vec3f direction(const Vec2f& place) const {
        const Vec2f p = from_middle(place, size());
        return direction_at(0.5f * fov_rad * radius(p), p);
    }
    template <class T>
    Vec2<T> place(const Vec3<T>& direction) const {
        return place_at(angle(direction) * T(2.0f / fov_rad), direction, size());
    }
};

/// The solid angle around the axis grows with the area on the sensor.
struct FisheyeEquisolid : Fisheye {
    float lens_mm = 10.5f, fov_rad = pi<float>;
    Vec2f sensor_mm{36.0f, 24.0f};

    bool sees(const Vec2f& place) const {
        return radius(from_middle(place, sensor_mm)) <= 2.0f * lens_mm * sin(0.25f * fov_rad);
    }
    Vec3f direction(const Vec2f& place) const {
        const Vec2f p = from_middle(place, sensor_mm);
        return direction_at(2.0f * asin(min(radius(p) / (2.0f * lens_mm), 1.0f)), p);
    }
    template <class T>
    Vec2<T> place(const Vec3<T>& direction) const {
        return place_at(T(2.0f * lens_mm) * sin(angle(direction) * T(0.5f)), direction, sensor_mm);
    }
};

/// The angle from the axis is a polynomial of the radius on the sensor, with its sign turned.
struct FisheyePolynomial : Fisheye {
    std::array<float, 5> coefficients{};  ///< rad, per mm^k
    float fov_rad = pi<float>;
    Vec2f sensor_mm{36.0f, 24.0f};

    float angle_at(float radius_mm) const {
        const auto& k = coefficients;
        return -(k[0] + radius_mm * (k[1] + radius_mm * (k[2] + radius_mm * (k[3] + radius_mm * k[4]))));
    }
    bool sees(const Vec2f& place) const {
        return abs(angle_at(radius(from_middle(place, sensor_mm)))) <= 0.5f * fov_rad;
    }
    Vec3f direction(const Vec2f& place) const {
        const Vec2f p = from_middle(place, sensor_mm);
        return direction_at(angle_at(radius(p)), p);
    }
    /// By Newton's method from the radius of the polynomial's straight part.
    template <class T>
    Vec2<T> place(const Vec3<T>& direction) const {
        const auto k = [&](std::size_t i) { return T(coefficients[i]); };
        const T wanted = -acos(min(max(direction.x, T(-1)), T(1)));
        T r = (wanted - k(0)) / k(1);
        for (int step = 0; step < 20; ++step) {
            const T value = k(0) + r * (k(1) + r * (k(2) + r * (k(3) + r * k(4))));
            const T slope = k(1) + r * (T(2) * k(2) + r * (T(3) * k(3) + r * (T(4) * k(4))));
            r += (wanted - value) / slope;
        }
        return place_at(r, direction, sensor_mm);
    }
};

/// One side of a cube around the camera, even in both angles.
struct CubeMapFace : Panorama {
    bool sees(const Vec2f&) const { return true; }
    Vec3f direction(const Vec2f& place) const {
        const auto slope = [](float x) { return tan((x - 0.5f) * (0.5f * pi<float>)); };
        return normalize(Vec3f(1.0f, -slope(place.x), slope(place.y)));
    }
    template <class T>
    Vec2<T> place(const Vec3<T>& direction) const {
        const auto angle = [&](const T& side) { return atan2(side, direction.x) * T(2 / pi<float>); };
        return {T(0.5f) - angle(direction.y), T(0.5f) + angle(direction.z)};
    }
};

/// What a ball of mirror shows from afar.
struct MirrorBall {
    static Vec3f in_camera(const Vec3f& v) { return {v.x, v.z, v.y}; }

    bool sees(const Vec2f& place) const { return Fisheye::radius(2.0f * place - Vec2f(1.0f)) <= 1.0f; }
    Vec3f direction(const Vec2f& place) const {
        const Vec2f p = 2.0f * place - Vec2f(1.0f);
        const float facing = safe_sqrt(1.0f - dot(p, p));
        return {2.0f * facing * p.x, 1.0f - 2.0f * sqr(facing), 2.0f * facing * p.y};
    }
    template <class T>
    Vec2<T> place(const Vec3<T>& direction) const {
        const T scale = T(2) * sqrt(max(T(0.5f) * (T(1) - direction.y), tiny<T>));
        return {T(0.5f) * (direction.x / scale + T(1)), T(0.5f) * (direction.z / scale + T(1))};
    }
};

using Projection = std::variant<Perspective, Orthographic, Equirectangular, CentralCylindrical, FisheyeEquidistant,
                                FisheyeEquisolid, FisheyePolynomial, CubeMapFace, MirrorBall>;

}  // namespace pivot
