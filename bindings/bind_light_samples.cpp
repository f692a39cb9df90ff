// pivot_core.Scene's light samples: what the integrator draws at one vertex, and with which density, for tests.
#include <pybind11/stl.h>

#include "bindings/lobes.h"
#include "bindings/names.h"
#include "bindings/register.h"
#include "core/integrators/direct_light.h"
#include "core/integrators/fog_lamp.h"
#include "core/integrators/light_choice.h"
#include "core/integrators/light_sampler.h"

namespace pivot::bindings {
namespace {

/// The scene made ready by who holds it, and a vertex in it whose shading frame is the world's.
Vertex vertex_at(Scene& scene, const Material& material, const Triple& position, const Triple& wo) {
    scene.commit();
    if (!(wo[2] > 0.0f)) throw py::value_error("wo must be above the surface: z > 0");
    const Vec3f normal(0.0f, 0.0f, 1.0f);
    const SurfacePoint point{.position = to_vec3(position),
                             .normal_geometric = normal,
                             .frame = {{1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}, normal},
                             .error_m = 0.0f,
                             .front = 1.0f,
                             .wo_local = normalize(to_vec3(wo))};
    return {{}, point, make_surface(material, point.wo_local)};
}

/// A vertex that samples lamps alone, so many of them, or, where there are none, a mesh's triangles.
BouncePlan plan_with(const Scene& scene, std::size_t light_samples) {
    const bool has_lamps = !scene.lamps().empty();
    const std::size_t all = has_lamps ? std::min(scene.lamps().size(), max_lamp_samples)
                                      : std::min(scene.triangle_lights().size(), max_triangle_samples);
    if (light_samples != 1 && light_samples != all) {
        throw py::value_error("light_samples must be 1, as at later vertices, or " + std::to_string(max_lamp_samples) +
                              " (triangles: " + std::to_string(max_triangle_samples) +
                              "), or as many as there are lights if they are fewer");
    }
    return {0, Dimensions(0), has_lamps ? light_samples : 0, has_lamps ? 0 : light_samples};
}

py::tuple sample_lights(Scene& scene, const OwnedMaterial& material, const Triple& position, const Triple& wo,
                        const std::string& light_sampling, std::size_t light_samples, std::size_t count,
                        std::uint32_t seed) {
    const SceneHold hold(scene);
    VertexOf<Batch> vertices = broadcast<VertexOf>(vertex_at(scene, material, position, wo));
    const BouncePlan plan = plan_with(scene, light_samples);
    const LightSampling strategy = light_sampling_from(light_sampling);
    std::vector<Vec3f> wi;
    std::vector<Rgb> radiance;
    for (std::size_t first = 0; first < count; first += batch_size) {
        std::array<Sampler, batch_size> samplers;
        for (std::size_t i = 0; i < batch_size; ++i)
            samplers[i] = {hash(static_cast<std::uint32_t>(first + i), seed), 0};
        vertices.sampler = sampler_lanes(samplers);
        SharedLamps shared;
        ProgramMemory memory;
        const VertexBatch batch(vertices, std::min(batch_size, count - first));
        const VertexLights lights(scene, plan, batch);
        for (const LightSample& sample : light_samples_of(scene, strategy, plan, batch, lights, shared, memory)) {
            wi.push_back(sample.wi);
            radiance.push_back(sample.radiance);
        }
    }
    const auto rows = [](const std::vector<Vec3f>& values) {
        py::array_t<float> array({static_cast<py::ssize_t>(values.size()), py::ssize_t(3)});
        for (std::size_t i = 0; i < values.size(); ++i) {
            for (int c = 0; c < 3; ++c) array.mutable_at(i, c) = values[i][c];
        }
        return array;
    };
    return py::make_tuple(rows(wi), rows(radiance));
}

py::tuple light_densities(Scene& scene, const OwnedMaterial& material, const Triple& position, const Triple& wo,
                          const std::string& light_sampling, std::size_t light_samples, const FloatArray& wi) {
    require_shape(wi, "wi", {-1, 3});
    const SceneHold hold(scene);
    const Vertex vertex = vertex_at(scene, material, position, wo);
    const BouncePlan plan = plan_with(scene, light_samples);
    const VertexLights vertex_lights(scene, plan, VertexBatch(broadcast<VertexOf>(vertex), batch_size));
    const LightSampling strategy = light_sampling_from(light_sampling);
    const py::ssize_t count = wi.shape(0);
    const auto lights = static_cast<py::ssize_t>(scene.lamps().size() + scene.triangle_lights().size());
    py::array_t<float> pdf_omega({count, lights}), pdf_omega_bsdf(count), reflected({count, lights, py::ssize_t(3)});
    py::array_t<bool> shares(lights);
    std::fill_n(pdf_omega.mutable_data(), pdf_omega.size(), 0.0f);
    std::fill_n(reflected.mutable_data(), reflected.size(), 0.0f);
    for (py::ssize_t light = 0; light < lights; ++light) {
        const Light& source = scene.light(static_cast<std::size_t>(light));
        const LightSampler sampler(source, vertex.point, vertex.surface, strategy);
        const float expected = vertex_lights.expected_samples(0, static_cast<std::size_t>(light));
        shares.mutable_at(light) = sampler.shares_with_bsdf();
        for (py::ssize_t i = 0; i < count; ++i) {
            const Vec3f direction(wi.at(i, 0), wi.at(i, 1), wi.at(i, 2));
            pdf_omega_bsdf.mutable_at(i) = pivot::pdf_omega(vertex.surface, direction);
            const auto place = intersect_light(source, vertex.point.position, direction);
            if (!place || !vertex.is_open_to(direction)) continue;
            const Rgb radiance = eval(vertex.surface, direction) * place->radiance;
            if (!(max_component(radiance) > 0.0f)) continue;
            pdf_omega.mutable_at(i, light) = expected * sampler.pdf_omega(*place);
            for (int c = 0; c < 3; ++c) reflected.mutable_at(i, light, c) = radiance[c];
        }
    }
    return py::make_tuple(pdf_omega, reflected, pdf_omega_bsdf, shares);
}

/// Of the lamps, as a batch of this vertex in all its lanes chooses.
LightChoice choice_at(const Scene& scene, const Vertex& vertex, std::size_t cut_nodes) {
    if (scene.lamps().empty()) throw py::value_error("the scene has no lamp to choose");
    if (cut_nodes < 1 || cut_nodes > LightChoice::max_cut_nodes)
        throw py::value_error("cut_nodes must be 1 to " + std::to_string(LightChoice::max_cut_nodes));
    return LightChoice(scene.lamp_tree(), light_receiver(broadcast<VertexOf>(vertex)), batch_size, cut_nodes);
}

py::tuple choose_lights_at(Scene& scene, const OwnedMaterial& material, const Triple& position, const Triple& wo,
                           const FloatArray& u, std::size_t cut_nodes) {
    require_shape(u, "u", {-1});
    const SceneHold hold(scene);
    const LightChoice choice = choice_at(scene, vertex_at(scene, material, position, wo), cut_nodes);
    py::array_t<std::int64_t> light(u.shape(0));
    py::array_t<float> probability(u.shape(0));
    for (py::ssize_t first = 0; first < u.shape(0); first += batch_size) {
        const auto count = std::min(static_cast<py::ssize_t>(batch_size), u.shape(0) - first);
        Lanes lanes{};
        std::copy_n(u.data(first), count, lanes.begin());
        LightChoices choices;
        choice.choose(load(lanes), std::span(&choices, 1));
        for (py::ssize_t i = 0; i < count; ++i) {
            const float p = probability.mutable_at(first + i) = choices.probability[static_cast<std::size_t>(i)];
            light.mutable_at(first + i) =
                p > 0.0f ? static_cast<std::int64_t>(choices.light[static_cast<std::size_t>(i)]) : -1;
        }
    }
    return py::make_tuple(light, probability);
}

py::array_t<float> choice_probabilities(Scene& scene, const OwnedMaterial& material, const Triple& position,
                                        const Triple& wo, std::size_t cut_nodes) {
    const SceneHold hold(scene);
    const LightChoice choice = choice_at(scene, vertex_at(scene, material, position, wo), cut_nodes);
    py::array_t<float> probabilities(static_cast<py::ssize_t>(scene.lamps().size()));
    for (std::size_t light = 0; light < scene.lamps().size(); ++light) {
        probabilities.mutable_data()[light] = choice.probability(0, light);
    }
    return probabilities;
}

/// Fog of one lobe of Henyey and Greenstein's.
MediumMix even_fog(float g) {
    if (!(std::abs(g) <= max_abs_phase_g)) throw py::value_error("g must be above -1 and below 1");
    MediumMix mix{.sigma_s = Rgb(1.0f), .sigma_t = Rgb(1.0f), .emission = Rgb(0.0f), .lobes = {}};
    mix.lobes.push_back({Rgb(1.0f), {PhaseKind::henyey_greenstein, g}});
    mix.total_weight = MediumMix::weight(mix.lobes[0]);
    return mix;
}

py::tuple fog_lamp_samples(const Light& lamp, float g, const Triple& position, const Triple& direction,
                           const FloatArray& u) {
    require_shape(u, "u", {-1, 2});
    const MediumMix mix = even_fog(g);
    const Vec3b from = broadcast(to_vec3(position)), travels = broadcast(normalize(to_vec3(direction)));
    const py::ssize_t count = u.shape(0);
    py::array_t<float> wi({count, py::ssize_t(3)}), pdf_omega(count);
    for (py::ssize_t first = 0; first < count; first += batch_size) {
        const auto lanes = static_cast<std::size_t>(std::min(static_cast<py::ssize_t>(batch_size), count - first));
        const auto column = [&](int c) {
            return gather(
                [&](std::size_t i) { return i < lanes ? u.at(first + static_cast<py::ssize_t>(i), c) : 0.5f; });
        };
        const LampSamples samples = sample_lamp(lamp, mix, from, travels, {column(0), column(1)});
        const std::array<Lanes, 3> xyz{store(samples.wi.x), store(samples.wi.y), store(samples.wi.z)};
        const Lanes pdf = store(samples.pdf_omega);
        for (std::size_t i = 0; i < lanes; ++i) {
            const py::ssize_t row = first + static_cast<py::ssize_t>(i);
            for (int c = 0; c < 3; ++c) wi.mutable_at(row, c) = xyz[static_cast<std::size_t>(c)][i];
            pdf_omega.mutable_at(row) = pdf[i];
        }
    }
    return py::make_tuple(wi, pdf_omega);
}

py::array_t<float> fog_lamp_pdf(const Light& lamp, float g, const Triple& position, const Triple& direction,
                                const FloatArray& wi) {
    require_shape(wi, "wi", {-1, 3});
    const Vec3f from = to_vec3(position);
    const FogLampSampler sampler(lamp, even_fog(g), from, normalize(to_vec3(direction)), LightSampling::joint);
    py::array_t<float> pdf_omega(wi.shape(0));
    for (py::ssize_t i = 0; i < wi.shape(0); ++i) {
        const auto place = intersect_light(lamp, from, {wi.at(i, 0), wi.at(i, 1), wi.at(i, 2)});
        pdf_omega.mutable_at(i) = place ? sampler.pdf_omega(*place) : 0.0f;
    }
    return pdf_omega;
}

/// Each node as (child (n,), mean (n, 3), variance_m2 (n,), ...): see below.
py::list light_tree(Scene& scene) {
    const SceneHold hold(scene);
    scene.commit();
    py::list nodes;
    for (const LightTree::Node& node : scene.lamp_tree().nodes()) {
        const auto count = static_cast<py::ssize_t>(node.count);
        const auto numbers = [&](auto member) {
            py::array_t<float> values(count);
            for (std::size_t i = 0; i < node.count; ++i) values.mutable_data()[i] = node.proxies[i].*member;
            return values;
        };
        const auto vectors = [&](auto member) {
            py::array_t<float> values({count, py::ssize_t(3)});
            for (std::size_t i = 0; i < node.count; ++i)
                for (int axis = 0; axis < 3; ++axis)
                    values.mutable_at(static_cast<py::ssize_t>(i), axis) = (node.proxies[i].*member)[axis];
            return values;
        };
        using Proxy = LightProxyOf<float>;
        nodes.append(py::make_tuple(py::array_t<std::int32_t>(count, node.child.data()), vectors(&Proxy::mean),
                                    numbers(&Proxy::variance_m2), numbers(&Proxy::bound_m), numbers(&Proxy::intensity),
                                    vectors(&Proxy::axis), numbers(&Proxy::sharpness)));
    }
    return nodes;
}

}  // namespace

void register_light_samples(py::module_& module) {
    auto scene = module.attr("Scene").cast<py::class_<Scene, std::shared_ptr<Scene>>>();
    scene.def("sample_lights", &sample_lights, py::arg("material"), py::arg("position"), py::arg("wo"),
              py::arg("light_sampling"), py::arg("light_samples"), py::arg("count"), py::arg("seed"),
              "The light samples of `count` paths that meet a surface at `position`, its normal up: wi (n, 3) and what "
              "each adds if nothing is in the way, (n, 3); those that add nothing are left out. light_samples: 1, "
              "chosen among the lights; or as many as a first vertex takes.");
    scene.def("light_densities", &light_densities, py::arg("material"), py::arg("position"), py::arg("wo"),
              py::arg("light_sampling"), py::arg("light_samples"), py::arg("wi"),
              "Of sample_lights at directions wi (n, 3): the density of a path's samples of each light per steradian "
              "(n, lights), 0 where they would add nothing; what is reflected of the light's radiance (n, lights, 3); "
              "the density of BSDF samples (n,); which lights share with these by the balance heuristic (lights,).");
    scene.def(
        "choose_lights", &choose_lights_at, py::arg("material"), py::arg("position"), py::arg("wo"), py::arg("u"),
        py::arg("cut_nodes") = 1,
        "The light that each u (n,) in [0, 1) chooses down the light tree, (n,), -1 where none reaches the point, "
        "and with which probability, (n,).");
    scene.def("choice_probabilities", &choice_probabilities, py::arg("material"), py::arg("position"), py::arg("wo"),
              py::arg("cut_nodes") = 1, "With which probability choose_lights takes each lamp, (lamps,).");
    scene.def(
        "light_tree", &light_tree,
        "Its nodes, the root first, each as (child (n,): a node, or ~light; mean (n, 3), the place, of suns the "
        "direction; variance_m2 (n,) of places about it, across any line of sight; bound_m (n,), how far parts are "
        "from it at most; intensity (n,) in W/sr towards any side at most, the mean over colours; axis (n, 3), where "
        "it shines most, or 0; sharpness (n,) of that Gaussian).");
    module.def("fog_lamp_samples", &fog_lamp_samples, py::arg("light"), py::arg("g"), py::arg("position"),
               py::arg("direction"), py::arg("u"),
               "fog_lamp_samples(light, g, position, direction, u): what u (n, 2) in [0, 1) sample of a lamp from a "
               "place in fog of Henyey and Greenstein's phase function that a ray along `direction` crosses: wi (n, 3) "
               "and their density per steradian (n,).");
    module.def("fog_lamp_pdf", &fog_lamp_pdf, py::arg("light"), py::arg("g"), py::arg("position"), py::arg("direction"),
               py::arg("wi"),
               "fog_lamp_pdf(light, g, position, direction, wi): the density of fog_lamp_samples at wi (n, 3), 0 "
               "beside the lamp: (n,).");
}

}  // namespace pivot::bindings
