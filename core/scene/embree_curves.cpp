// Curves as Embree's geometry.
#include "core/geometry/curves.h"
#include "core/scene/embree.h"

namespace pivot {
namespace {

/// Where a ray meets a round tube with this normal, as ribbons' hits tell it.
Vec2f place_on_tube(const Curves& curves, std::uint32_t segment, float u, const Vec3f& normal, const Vec3f& direction,
                    float time) {
    const Vec3f along(curve_derivative(curves, segment, u, time)), across = cross(direction, along);
    const Vec3f around = normal - dot(normal, along) / std::max(length_squared(along), 1e-30f) * along;
    const float scale2 = length_squared(across) * length_squared(around);
    return {u, scale2 > 0.0f ? dot(across, around) / std::sqrt(scale2) : 0.0f};
}

/// Of what is round, whose hits come with a normal: drops what is met from within, and tells where the others are as
/// touching_triangle() wants it.
void keep_fronts(const RTCFilterFunctionNArguments* arguments) {
    const auto* curves = static_cast<const Curves*>(arguments->geometryUserPtr);
    const unsigned n = arguments->N;
    for (unsigned i = 0; i < n; ++i) {
        if (arguments->valid[i] == 0) continue;
        const Vec3f direction(RTCRayN_dir_x(arguments->ray, n, i), RTCRayN_dir_y(arguments->ray, n, i),
                              RTCRayN_dir_z(arguments->ray, n, i));
        const Vec3f normal(RTCHitN_Ng_x(arguments->hit, n, i), RTCHitN_Ng_y(arguments->hit, n, i),
                           RTCHitN_Ng_z(arguments->hit, n, i));
        if (dot(normal, direction) >= 0.0f) {
            arguments->valid[i] = 0;
            continue;
        }
        const Vec2f uv =
            curves->shape == CurveShape::ball
                ? Vec2f(ball_frame(direction).to_local(normalize(normal)))
                : place_on_tube(*curves, RTCHitN_primID(arguments->hit, n, i), RTCHitN_u(arguments->hit, n, i), normal,
                                direction, RTCRayN_time(arguments->ray, n, i));
        RTCHitN_u(arguments->hit, n, i) = uv.x;
        RTCHitN_v(arguments->hit, n, i) = uv.y;
    }
}

}  // namespace

Owned<RTCGeometry> EmbreeDevice::make_curves(const Curves& curves) const {
    const auto type_of = [](CurveShape shape) {
        if (shape == CurveShape::ball) return RTC_GEOMETRY_TYPE_SPHERE_POINT;
        return shape == CurveShape::round ? RTC_GEOMETRY_TYPE_ROUND_CATMULL_ROM_CURVE
                                          : RTC_GEOMETRY_TYPE_FLAT_CATMULL_ROM_CURVE;
    };
    Owned<RTCGeometry> geometry(rtcNewGeometry(handle.get(), type_of(curves.shape)));
    const auto set_keys = [&](unsigned step, const std::vector<CurvePoint>& keys) {
        rtcSetSharedGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_VERTEX, step, RTC_FORMAT_FLOAT4, keys.data(), 0,
                                   sizeof(CurvePoint), keys.size());
    };
    if (curves.steps.empty()) {
        set_keys(0, curves.keys);
    } else {
        rtcSetGeometryTimeStepCount(geometry.get(), static_cast<unsigned>(curves.steps.size()));
        for (unsigned step = 0; step < curves.steps.size(); ++step) set_keys(step, curves.steps[step]);
    }
    if (curves.shape != CurveShape::ball)
        rtcSetSharedGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT, curves.segments.data(), 0,
                                   sizeof(std::uint32_t), curves.segments.size());
    if (curves.shape != CurveShape::ribbon) {
        rtcSetGeometryUserData(geometry.get(), const_cast<Curves*>(&curves));
        rtcSetGeometryIntersectFilterFunction(geometry.get(), keep_fronts);
        rtcSetGeometryOccludedFilterFunction(geometry.get(), keep_fronts);
    } else {
        rtcSetGeometryTessellationRate(geometry.get(), static_cast<float>(curves.subdivisions));
    }
    return geometry;
}

}  // namespace pivot
