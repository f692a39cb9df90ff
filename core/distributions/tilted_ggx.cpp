#include "core/distributions/tilted_ggx.h"

#include <algorithm>
#include <array>

namespace pivot {
namespace {

using Vec3d = Vec3<double>;

struct Eigen {
    std::array<Vec3d, 3> axes;
    Vec3d values;
};

/// Of a symmetric matrix, by Jacobi's rotations.
Eigen eigen(Mat3<double> m) {
    Mat3<double> axes(1.0);
    for (int sweep = 0; sweep < 12; ++sweep)
        for (int p = 0; p < 2; ++p)
            for (int q = p + 1; q < 3; ++q) {
                if (std::abs(m[p][q]) <= 1e-300) continue;
                const double theta = (m[q][q] - m[p][p]) / (2.0 * m[p][q]);
                const double t = std::copysign(1.0, theta) / (std::abs(theta) + std::sqrt(theta * theta + 1.0));
                const double c = 1.0 / std::sqrt(t * t + 1.0), s = t * c;
                Mat3<double> rotation(1.0);
                rotation[p][p] = rotation[q][q] = c;
                rotation[q][p] = s, rotation[p][q] = -s;
                m = glm::transpose(rotation) * m * rotation;
                axes = axes * rotation;
            }
    return {{axes[0], axes[1], axes[2]}, {m[0][0], m[1][1], m[2][2]}};
}

}  // namespace

OwnAxes own_axes(const TiltedGgx& d) {
    const Mat3<double> m(Vec3d(d.xx, d.yx, 0.0), Vec3d(0.0, d.yy, 0.0), Vec3d(d.shift.x, d.shift.y, 1.0));
    const Eigen e = eigen(m * glm::transpose(m));
    std::array<int, 3> order{0, 1, 2};
    std::ranges::sort(order, [&](int a, int b) { return e.values[a] < e.values[b]; });
    const auto [x, y, z] = order;
    const auto length_of = [&](int i) { return std::sqrt(std::max(e.values[i], 1e-12)); };
    const Vec3d axis = e.axes[z] * (e.axes[z].z < 0.0 ? -1.0 : 1.0);
    const Vec3f own_z = normalize(Vec3f(axis)), own_x = normalize(Vec3f(e.axes[x]));
    return {{own_x, cross(own_z, own_x), own_z},
            static_cast<float>(length_of(x) / length_of(z)),
            static_cast<float>(length_of(y) / length_of(z)),
            d.weight * static_cast<float>(length_of(z))};
}

}  // namespace pivot
