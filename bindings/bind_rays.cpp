// pivot_core.Scene's rays: what a scene's geometry answers, for tests and to measure against.
#include <pybind11/stl.h>

#include <limits>

#include "bindings/arrays.h"
#include "bindings/register.h"
#include "core/scene/scene.h"

namespace pivot::bindings {
namespace {

constexpr std::size_t chunk_size = 1024;

/// Calls visit(first, rays) for chunks of the rays: small enough for a cache, large enough for packets.
template <class Visit>
void for_each_chunk(const FloatArray& origins, const FloatArray& directions, const float* far_m, const float* times,
                    const Visit& visit) {
    require_shape(origins, "origins", {-1, 3});
    require_shape(directions, "directions", {origins.shape(0), 3});
    const auto count = static_cast<std::size_t>(origins.shape(0));
    const float *o = origins.data(), *d = directions.data();
    std::vector<Ray> rays;
    for (std::size_t first = 0; first < count; first += chunk_size) {
        rays.clear();
        for (std::size_t i = first; i < std::min(first + chunk_size, count); ++i) {
            const float far = far_m ? far_m[i] : std::numeric_limits<float>::infinity();
            rays.push_back({{o[3 * i], o[3 * i + 1], o[3 * i + 2]},
                            {d[3 * i], d[3 * i + 1], d[3 * i + 2]},
                            0.0f,
                            far,
                            times ? times[i] : middle_time});
        }
        visit(first, rays);
    }
}

py::tuple intersect(Scene& scene, const FloatArray& origins, const FloatArray& directions, bool packets,
                    const std::optional<FloatArray>& times) {
    if (times) require_shape(*times, "times", {origins.shape(0)});
    const float* of_rays = times ? times->data() : nullptr;
    const SceneHold hold(scene);
    scene.commit();
    const py::ssize_t count = origins.shape(0);
    py::array_t<float> distance_m(count);
    py::array_t<std::int64_t> instance(count), triangle(count);
    py::array_t<float> barycentric({count, py::ssize_t(2)});
    std::vector<std::optional<RayHit>> hits(chunk_size);
    for_each_chunk(origins, directions, nullptr, of_rays, [&](std::size_t first, const std::vector<Ray>& rays) {
        if (packets) {
            scene.intersect(rays, visible_to_camera, hits);
        } else {
            for (std::size_t i = 0; i < rays.size(); ++i) hits[i] = scene.intersect(rays[i], visible_to_camera);
        }
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const auto row = static_cast<py::ssize_t>(first + i);
            const auto& hit = hits[i];
            distance_m.mutable_at(row) = hit ? hit->distance_m : std::numeric_limits<float>::infinity();
            instance.mutable_at(row) = hit ? std::int64_t(hit->instance) : -1;
            triangle.mutable_at(row) = hit ? std::int64_t(hit->triangle) : -1;
            barycentric.mutable_at(row, 0) = hit ? hit->barycentric.x : 0.0f;
            barycentric.mutable_at(row, 1) = hit ? hit->barycentric.y : 0.0f;
        }
    });
    return py::make_tuple(distance_m, instance, triangle, barycentric);
}

py::array_t<bool> occluded(Scene& scene, const FloatArray& origins, const FloatArray& directions,
                           const FloatArray& far_m, bool packets) {
    require_shape(far_m, "far_m", {origins.shape(0)});
    const SceneHold hold(scene);
    scene.commit();
    py::array_t<bool> result(origins.shape(0));
    bool* out = result.mutable_data();
    std::vector<std::uint8_t> occluded_rays(chunk_size);
    for_each_chunk(origins, directions, far_m.data(), nullptr, [&](std::size_t first, const std::vector<Ray>& rays) {
        if (packets) {
            scene.occluded(rays, occluded_rays);
        } else {
            for (std::size_t i = 0; i < rays.size(); ++i) occluded_rays[i] = scene.occluded(rays[i]);
        }
        for (std::size_t i = 0; i < rays.size(); ++i) out[first + i] = occluded_rays[i] != 0;
    });
    return result;
}

}  // namespace

void register_rays(py::module_& module) {
    auto scene = module.attr("Scene").cast<py::class_<Scene, std::shared_ptr<Scene>>>();
    scene.def("intersect", &intersect, py::arg("origins"), py::arg("directions"), py::arg("packets") = true,
              py::arg("times") = py::none(),
              "Closest hits of rays (n, 3), unit directions, at times (n,), else in the middle: distance_m (n,), "
              "infinite where there is none; instance and "
              "triangle (n,), -1 where there is none; barycentric (n, 2).");
    scene.def("occluded", &occluded, py::arg("origins"), py::arg("directions"), py::arg("far_m"),
              py::arg("packets") = true, "Whether rays (n, 3) meet anything nearer than far_m (n,).");
}

}  // namespace pivot::bindings
