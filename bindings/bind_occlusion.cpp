// pivot_core.Scene's bent cones, and what they leave of a light: for tests and to look at.
#include <pybind11/stl.h>

#include "bindings/arrays.h"
#include "bindings/register.h"
#include "core/integrators/specular_occlusion.h"
#include "core/scene/scene.h"

namespace pivot::bindings {
namespace {

/// Calls visit(row, bent cone, point, material) for what each ray hits.
template <class Visit>
void for_each_hit(Scene& scene, const FloatArray& origins, const FloatArray& directions, const Visit& visit) {
    require_shape(origins, "origins", {-1, 3});
    require_shape(directions, "directions", {origins.shape(0), 3});
    const SceneHold hold(scene);
    scene.commit();
    scene.trace_bent_cones([] { return false; });
    const float *o = origins.data(), *d = directions.data();
    for (py::ssize_t i = 0; i < origins.shape(0); ++i, o += 3, d += 3) {
        const Ray ray{{o[0], o[1], o[2]}, {d[0], d[1], d[2]}};
        const auto hit = scene.intersect(ray, visible_to_camera);
        if (!hit) throw py::value_error("ray " + std::to_string(i) + " meets nothing");
        const SurfacePoint point = scene.surface_point(ray, *hit);
        visit(i, scene.bent_cone(*hit, point), point, scene.shaders()[scene.material_of(*hit)].constants);
    }
}

py::tuple bent_cones(Scene& scene, const FloatArray& origins, const FloatArray& directions) {
    py::array_t<float> axis({origins.shape(0), py::ssize_t(3)}), versine(origins.shape(0));
    for_each_hit(scene, origins, directions,
                 [&](py::ssize_t i, const Cap<float>& cone, const SurfacePoint&, const Material&) {
                     for (int k = 0; k < 3; ++k) axis.mutable_at(i, k) = cone.axis[k];
                     versine.mutable_at(i) = cone.versine;
                 });
    return py::make_tuple(axis, versine);
}

py::tuple seen_shares(Scene& scene, const FloatArray& origins, const FloatArray& directions, const Light* light) {
    py::array_t<float> diffuse(origins.shape(0)), glossy(origins.shape(0));
    for_each_hit(scene, origins, directions,
                 [&](py::ssize_t i, const Cap<float>& cone, const SurfacePoint& point, const Material& material) {
                     const Surface surface = make_surface(material, point.wo_local);
                     const SeenShare seen =
                         light ? seen_share(*light, cone, point, surface) : seen_share_of_world(cone, point, surface);
                     diffuse.mutable_at(i) = seen.diffuse;
                     glossy.mutable_at(i) = seen.glossy;
                 });
    return py::make_tuple(diffuse, glossy);
}

}  // namespace

void register_occlusion(py::module_& module) {
    auto scene = module.attr("Scene").cast<py::class_<Scene, std::shared_ptr<Scene>>>();
    scene.def("bent_cones", &bent_cones, py::arg("origins"), py::arg("directions"),
              "Where rays (n, 3) hit, the cap that surrounding geometry leaves free: axis (n, 3), versine (n,).\n"
              "ValueError where a ray meets nothing.");
    scene.def(
        "seen_shares",
        [](Scene& self, const FloatArray& origins, const FloatArray& directions, const std::optional<Light>& light) {
            return seen_shares(self, origins, directions, light ? &*light : nullptr);
        },
        py::arg("origins"), py::arg("directions"), py::arg("light"),
        "Where rays (n, 3) hit, the shares of a light, or with None of the world, that the bent cone leaves to the\n"
        "diffuse and the glossy lobe: (n,) each. Rays come from the viewer; the light need not be in the scene.");
}

}  // namespace pivot::bindings
