// A pixel of an image of the hemisphere z > 0 seen orthographically: what of its square the unit disk leaves, column by
// column. Along a column, a chord of the half-circle of radius s = sqrt(1 - x^2), directions are even in asin(y / s):
// so integrals over a column have closed forms, and no pixel at the rim is too thin for them.
#pragma once

#include "core/distributions/orthographic.h"
#include "core/math/vector.h"

namespace pivot {

struct NdfPixel {
    double x0, x1, y0, y1;

    /// Pixel (column, row) of size * size, row 0 at y = -1.
    static NdfPixel at(std::size_t size, std::size_t column, std::size_t row) {
        const double side = 2.0 / static_cast<double>(size);
        const auto edge = [&](std::size_t i) { return side * static_cast<double>(i) - 1.0; };
        return {edge(column), edge(column + 1), edge(row), edge(row + 1)};
    }

    /// The columns that meet the disk; none if high <= low.
    struct Range {
        double low, high;
    };
    Range columns() const {
        const double near = y0 < 0.0 && y1 > 0.0 ? 0.0 : std::min(std::abs(y0), std::abs(y1));
        const double reach = safe_sqrt((1.0 - near) * (1.0 + near));
        return {std::max(x0, -reach), std::min(x1, reach)};
    }

    /// A column's part of the disk, and the angles asin(y / s) of its ends.
    struct Column {
        double radius, low, high, angle_low, angle_high;
    };
    Column column(double x) const {
        const double radius = safe_sqrt((1.0 - x) * (1.0 + x));
        const double low = std::clamp(y0, -radius, radius), high = std::clamp(y1, -radius, radius);
        const auto angle = [&](double y) { return std::atan2(y, safe_sqrt((radius - y) * (radius + y))); };
        return {radius, low, high, angle(low), angle(high)};
    }

    /// Whether a corner of it is as far from the middle.
    bool reaches(double radius) const {
        const double x = std::max(std::abs(x0), std::abs(x1)), y = std::max(std::abs(y0), std::abs(y1));
        return x * x + y * y > radius * radius;
    }
};

/// Integrals over the part of a pixel in the disk.
struct NdfPixelMoments {
    double solid_angle = 0.0;  ///< of dw
    Vec3<double> h{0.0};       ///< of h dw; its z is the area within the disk
};

inline NdfPixelMoments moments(const NdfPixel& pixel) {
    NdfPixelMoments sum;
    const double half = 0.5 * (pixel.x1 - pixel.x0);
    if (!pixel.reaches(1.0 - 6.0 * half)) {
        // Far from the rim 1 / z hardly bends within a pixel: Gauss and Legendre's 2 x 2 points.
        const double x = 0.5 * (pixel.x0 + pixel.x1), y = 0.5 * (pixel.y0 + pixel.y1), step = half * 0.5773502691896258;
        const double area = 4.0 * half * half;
        for (const double at_x : {x - step, x + step})
            for (const double at_y : {y - step, y + step}) {
                const double weight = 0.25 * area / std::sqrt(1.0 - at_x * at_x - at_y * at_y);
                sum.solid_angle += weight;
                sum.h += weight * Vec3<double>(at_x, at_y, 0.0);
            }
        sum.h.z = area;
        return sum;
    }
    const auto add = [&](double low, double high) {
        if (!(high > low)) return;
        for (const auto& node : gauss_rule<8>) {
            const double x = low + (high - low) * static_cast<double>(node.x);
            const double weight = (high - low) * static_cast<double>(node.weight);
            const NdfPixel::Column c = pixel.column(x);
            const double angle = c.angle_high - c.angle_low;
            const auto z = [&](double y) { return safe_sqrt((c.radius - y) * (c.radius + y)); };
            sum.solid_angle += weight * angle;
            sum.h += weight * Vec3<double>(x * angle, z(c.low) - z(c.high), c.high - c.low);
        }
    };
    const auto [low, high] = pixel.columns();

    // Columns that the rim cuts short, and those that it does not, meet where the rim leaves the pixel.
    const double far = std::max(std::abs(pixel.y0), std::abs(pixel.y1)), rim = safe_sqrt((1.0 - far) * (1.0 + far));
    const double left = std::clamp(-rim, low, std::max(low, high)), right = std::clamp(rim, low, std::max(low, high));
    add(low, left), add(left, right), add(right, high);
    const double exact = orthographic_pixel_solid_angle(pixel.x0, pixel.x1, pixel.y0, pixel.y1);
    sum.h.x *= sum.solid_angle > 0.0 ? exact / sum.solid_angle : 1.0;
    sum.solid_angle = exact;
    return sum;
}

/// A direction of the pixel: its columns evenly, and each of these evenly in solid angle.
inline Vec3f sample(const NdfPixel& pixel, const Vec2f& u) {
    const auto [low, high] = pixel.columns();
    const double x = low + (high - low) * static_cast<double>(u.x);
    const NdfPixel::Column c = pixel.column(x);
    const double angle = c.angle_low + (c.angle_high - c.angle_low) * static_cast<double>(u.y);
    return {static_cast<float>(x), static_cast<float>(c.radius * std::sin(angle)),
            static_cast<float>(c.radius * std::cos(angle))};
}

/// Density of sample() at a direction of the pixel, 1/sr.
inline double pdf_omega(const NdfPixel& pixel, double x) {
    const auto [low, high] = pixel.columns();
    const NdfPixel::Column c = pixel.column(std::clamp(x, low, std::max(low, high)));
    const double size = (high - low) * (c.angle_high - c.angle_low);
    return size > 0.0 ? 1.0 / size : 0.0;
}

}  // namespace pivot
