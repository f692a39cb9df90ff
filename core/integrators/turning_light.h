// Light that glossy surfaces send on, as it is seen: where places and axes about them are Gaussians together, and the
// axis turns from place to place. Across the line of sight, to first order: seen from y, the direction from a place at
// the angle u from the mean one to y is off from the axis there by
//   e(u) = e(0) - N u,   N = 1 + D J,   D the distance, J the turn of the axis per metre,
// so that e(0) is a Gaussian's of covariance M = V + S N N^T, V the variance of axes about their turn and S that of u;
// u is then a Gaussian's about S N^T M^-1 e(0), of covariance S - S^2 N^T M^-1 N. Where N vanishes light comes
// together. Where J does, these are the product of two Gaussians on the sphere, and are taken to it on the sphere as
// that is.
#pragma once

#include "core/distributions/spherical_gaussian.h"
#include "core/integrators/light_view.h"
#include "core/math/frame.h"

namespace pivot {

struct TurningLight {
    SphericalGaussian<Batch> seen;  ///< of directions that it comes from, in the shading frame, of amplitude 1
    Batch radiance;                 ///< at its axis, of one watt
};

/// variance: of directions to places, as the view has it, or more.
inline TurningLight seen_while_turning(const SurfaceBatch& batch, const VirtualLight& light, const LightView& view,
                                       const Batch& variance) {
    const Batch zero(0.0f), one(1.0f), least(1e-6f);
    const Vec3b axis = broadcast(view.axis);
    // Both are unit vectors: their difference is across their sum.
    const Vec3b off = -view.towards - axis, sum = axis - view.towards;
    const Batch sum2 = dot(sum, sum);
    const Frame<Batch> across = frame_from_z(select(sum2 > least, sum * inverse_sqrt(max(sum2, least)), axis));
    const Batch e_x = dot(off, across.x), e_y = dot(off, across.y);

    const Mat3<float>& turn = light.turn.axis_from_place;
    const auto turned = [&](const Vec3b& place) {
        return broadcast(turn[0]) * place.x + broadcast(turn[1]) * place.y + broadcast(turn[2]) * place.z;
    };
    const Batch distance = sqrt(view.distance2);
    const Vec3b by_x = turned(across.x) * distance, by_y = turned(across.y) * distance;
    const Batch n_xx = one + dot(across.x, by_x), n_xy = dot(across.x, by_y), n_yx = dot(across.y, by_x),
                n_yy = one + dot(across.y, by_y);
    const Batch of_axes(std::max(light.turn.axis_variance, 1e-7f));
    const Batch m_xx = of_axes + variance * (sqr(n_xx) + sqr(n_xy)),
                m_yy = of_axes + variance * (sqr(n_yx) + sqr(n_yy)), m_xy = variance * (n_xx * n_yx + n_xy * n_yy);
    const Batch det = max(m_xx * m_yy - sqr(m_xy), sqr(of_axes)), inverse_det = inverse(det);
    const Batch c_x = (m_yy * e_x - m_xy * e_y) * inverse_det, c_y = (m_xx * e_y - m_xy * e_x) * inverse_det;

    const Batch u_x = variance * (n_xx * c_x + n_yx * c_y), u_y = variance * (n_xy * c_x + n_yy * c_y);
    const Vec3b to_places = view.towards + across.x * u_x + across.y * u_y;
    const Batch nearer = inverse_sqrt(max(dot(to_places, to_places), least));
    const Batch told = (m_yy * (sqr(n_xx) + sqr(n_xy)) + m_xx * (sqr(n_yx) + sqr(n_yy)) -
                        Batch(2.0f) * m_xy * (n_xx * n_yx + n_xy * n_yy)) *
                       inverse_det;
    const Batch left = variance * max(one - Batch(0.5f) * variance * told, Batch(0.01f)) * nearer;
    const Batch sharpness = inverse(max(left, Batch(1e-7f)));
    const Batch loss = (e_x * c_x + e_y * c_y) * inverse(one + inverse(nearer));
    const Batch radiance = exp(-loss) * nearer * sharpness * inverse_sqrt(det) * Batch(sqr(0.5f / pi<float>)) *
                           inverse(view.distance2 * (one - exp(Batch(-2.0f) * inverse(of_axes))));
    return {{batch.frame.to_local(to_places * nearer), sharpness, zero}, radiance};
}

}  // namespace pivot
