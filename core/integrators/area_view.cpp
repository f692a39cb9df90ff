#include "core/integrators/area_view.h"

namespace pivot {

AreaView<float> view_from(const AreaLight& light, const SurfacePoint& point) {
    return {.center = point.frame.to_local(light.center - point.position),
            .half_u = point.frame.to_local(light.half_u),
            .half_v = point.frame.to_local(light.half_v),
            .normal = point.frame.to_local(normal_towards(light, point.position)),
            .parallelogram_m2 = parallelogram_m2(light),
            .ellipse = light.shape == AreaShape::ellipse,
            .triangle = light.shape == AreaShape::triangle};
}

}  // namespace pivot
