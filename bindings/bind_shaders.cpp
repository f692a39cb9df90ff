// pivot_core.Program, Shader, and the ops that programs are made of.
#include <pybind11/stl.h>

#include <cstddef>
#include <cstring>
#include <map>
#include <optional>

#include "bindings/lobes.h"
#include "bindings/register.h"
#include "core/bsdf/lobe.h"
#include "core/shaders/lamp_mean.h"
#include "core/shaders/shader.h"
#include "core/shaders/volume_places.h"
#include "core/textures/image.h"

namespace pivot::bindings {
namespace {

using std::string;

const OpKind& op_named(const string& name) {
    const OpKind* kind = find_op(name);
    if (!kind) throw py::value_error("there is no op '" + name + "'");
    return *kind;
}

/// What an op makes of constants, inputs (..., N): a row a set.
py::array_t<float> run_op(const string& name, const FloatArray& inputs, const std::vector<float>& settings,
                          const std::optional<std::shared_ptr<Image>>& image) {
    const OpKind& kind = op_named(name);
    if (kind.reads_place) throw py::value_error("op '" + name + "' depends on where it runs");
    if (kind.reads_image && !image) throw py::value_error("op '" + name + "': it needs an image");
    require_shape(inputs, "op '" + name + "': inputs", {-1, kind.input_count});
    const py::ssize_t count = inputs.shape(0);
    py::array_t<float> outputs({count, static_cast<py::ssize_t>(kind.output_count)});
    const OpSettings op_settings{settings, image.value_or(nullptr)};
    std::vector<Lanes> lanes(kind.input_count);
    for (py::ssize_t first = 0; first < count; first += static_cast<py::ssize_t>(batch_size)) {
        const auto row = [&](std::size_t lane) { return std::min(first + static_cast<py::ssize_t>(lane), count - 1); };
        std::vector<Batch> batches(kind.input_count);
        for (std::uint32_t i = 0; i < kind.input_count; ++i)
            batches[i] = gather([&](std::size_t lane) { return inputs.at(row(lane), i); });
        const std::vector<Batch> results = evaluate(kind, batches, op_settings);
        for (std::uint32_t i = 0; i < kind.output_count; ++i) {
            const Lanes values = store(results[i]);
            for (std::size_t lane = 0; lane < batch_size; ++lane) outputs.mutable_at(row(lane), i) = values[lane];
        }
    }
    return outputs;
}

/// A number, or a register: what an op takes.
Input to_input(const std::pair<std::int64_t, float>& input) {
    return input.first < 0 ? Input{.value = input.second}
                           : Input{.register_index = static_cast<std::uint32_t>(input.first)};
}

std::uint32_t add_step(Program& program, const string& name, const std::vector<std::pair<std::int64_t, float>>& inputs,
                       const std::vector<float>& settings, std::uint32_t neighbour,
                       const std::optional<std::shared_ptr<Image>>& image) {
    std::vector<Input> numbers;
    for (const auto& input : inputs) numbers.push_back(to_input(input));
    return program.add(name, std::move(numbers), {settings, image.value_or(nullptr)}, neighbour);
}

py::array_t<float> run_at(const Program& program, const FloatArray& positions_object, const FloatArray& object_to_world,
                          const std::vector<std::uint32_t>& registers,
                          const std::map<std::uint32_t, FloatArray>& attributes, const std::array<float, 4>& color,
                          float pass_index, float random,
                          const std::map<std::uint32_t, std::array<float, 4>>& object_attributes) {
    require_shape(positions_object, "positions_object", {-1, 3});
    require_shape(object_to_world, "object_to_world", {4, 4});
    for (const std::uint32_t index : registers)
        if (index >= program.register_count())
            throw py::value_error("the program has no register " + std::to_string(index));
    const py::ssize_t count = positions_object.shape(0);
    VolumePoints points{.positions_object = std::vector<Vec3f>(static_cast<std::size_t>(count)),
                        .attributes = {},
                        .world_from_object = to_transform(object_to_world.data()),
                        .object = {}};
    points.object.color = Rgb(color[0], color[1], color[2]);
    points.object.alpha = color[3];
    points.object.pass_index = pass_index;
    points.object.random = random;
    std::memcpy(points.positions_object.data(), positions_object.data(),
                sizeof(Vec3f) * points.positions_object.size());
    for (const auto& [id, values] : attributes) {
        require_shape(values, "attributes", {count, -1});
        const py::ssize_t width = values.shape(1);
        if (width < 1 || width > 4) throw py::value_error("attributes have one to four numbers each");
        points.attributes.push_back({id, false, static_cast<std::uint32_t>(width),
                                     std::vector<float>(values.data(), values.data() + values.size())});
    }
    std::vector<ObjectAttribute> of_object;
    for (const auto& [id, value] : object_attributes) of_object.push_back({id, value});
    points.object.attributes = std::make_shared<const std::vector<ObjectAttribute>>(std::move(of_object));

    py::array_t<float> result({count, static_cast<py::ssize_t>(registers.size())});
    const std::vector<float> numbers = [&] {
        const py::gil_scoped_release release;
        return run_in_volume(program, std::move(points), registers);
    }();
    std::ranges::copy(numbers, result.mutable_data());
    return result;
}

/// Where a named number or colour of a material lies, in floats.
struct Numbers {
    std::size_t first, count;
    float low, high;
};

/// Calls visit(name, Numbers) with each that the material has: the base's, "emission", "transparency", "opacity", and
/// of its lobes "lobes.0.color".
template <class Visit>
void for_each_number(const Material& material, const Visit& visit) {
    const auto visit_kind = [&]<class L>(const string& prefix, std::size_t first) {
        for (const LobeParameter& p : L::parameters) {
            visit(prefix + string(p.name), Numbers{first, p.count, p.low, p.high});
            first += p.count;
        }
    };
    visit_kind.template operator()<FurtherBase<float>>("", 0);
    constexpr float most = std::numeric_limits<float>::max();
    visit("emission", Numbers{emission_place, 3, -most, most});
    visit("transparency", Numbers{transparency_place, 3, 0.0f, most});
    visit("opacity", Numbers{transparency_place + 3, 1, 0.0f, most});
    for (std::size_t i = 0; i < max_lobes; ++i)
        for_each_lobe_kind<float>([&]<class L>(float kind) {
            if (material.lobes[i].kind != kind) return;
            constexpr std::size_t numbers_place = offsetof(LobeOf<float>, numbers) / sizeof(float);
            const std::size_t at = lobes_place + i * sizeof(LobeOf<float>) / sizeof(float) + numbers_place;
            visit_kind.template operator()<L>("lobes." + std::to_string(i) + ".", at);
        });
}

Shader constant_shader(const OwnedMaterial& material) {
    Shader shader(material);
    shader.tables = material.tables;
    return shader;
}

Shader make_shader(const OwnedMaterial& constants, const Program& program,
                   const std::map<string, std::vector<std::int64_t>>& varying) {
    Shader shader(constants, program);
    shader.tables = constants.tables;
    const auto check = [&](const string& name, const std::vector<std::int64_t>& registers, std::size_t count) {
        if (registers.size() != count) throw py::value_error(name + " is " + std::to_string(count) + " numbers");
        for (const std::int64_t index : registers)
            if (index >= program.register_count())
                throw py::value_error(name + ": the program has no register " + std::to_string(index));
    };
    const auto three_registers = [](const string& name, const std::vector<std::int64_t>& registers) {
        if (std::ranges::min(registers) < 0) throw py::value_error("a " + name + " is three registers");
        const auto at = [&](std::size_t i) { return static_cast<std::uint32_t>(registers[i]); };
        return std::array{at(0), at(1), at(2)};
    };
    std::size_t known = 0;
    for (const string name : {"normal", "own_normal"}) {
        const auto found = varying.find(name);
        if (found == varying.end()) continue;
        const std::vector<std::int64_t>& registers = found->second;
        check(name, registers, 3);
        shader.normal = three_registers("normal", registers);
        shader.normal_is_own = name == "own_normal";
        ++known;
    }
    if (const auto found = varying.find("tangent"); found != varying.end()) {
        check("tangent", found->second, 3);
        shader.tangent = three_registers("tangent", found->second);
        ++known;
    }
    string names = "normal, own_normal, tangent";
    for_each_number(constants, [&](const string& name, const Numbers& numbers) {
        names += ", " + name;
        const auto found = varying.find(name);
        if (found == varying.end()) return;
        ++known;
        check(name, found->second, numbers.count);
        for (std::size_t i = 0; i < numbers.count; ++i)
            if (found->second[i] >= 0)
                shader.varying.push_back({static_cast<std::uint32_t>(numbers.first + i),
                                          static_cast<std::uint32_t>(found->second[i]), numbers.low, numbers.high});
    });
    if (known < varying.size()) throw py::value_error("what may vary of this material is " + names);
    return shader;
}

}  // namespace

void register_shaders(py::module_& module) {
    module.def(
        "ops",
        [] {
            py::dict result;
            for (const OpKind* kind : all_ops())
                result[py::str(string(kind->name))] =
                    py::make_tuple(kind->input_count, kind->output_count, kind->reads_place);
            return result;
        },
        "ops(): by name, how many numbers each op of a program takes and gives, and whether it reads where it runs.");
    module.def("run_op", &run_op, py::arg("name"), py::arg("inputs"), py::arg("settings") = std::vector<float>{},
               py::arg("image") = py::none(),
               "run_op(name, inputs, settings=[], image=None): what an op makes of constants, (N, outputs) of inputs "
               "(N, inputs).");
    py::class_<Program>(module, "Program", "Ops over registers, run at each place of a surface.")
        .def(py::init<>())
        .def("add", &add_step, py::arg("op"), py::arg("inputs"), py::arg("settings") = std::vector<float>{},
             py::arg("neighbour") = 0, py::arg("image") = py::none(),
             "Appends an op and returns its first register. inputs: (register, 0.0), or (-1, a constant), for each "
             "number. neighbour 1 and 2: what it would give at the places beside, along two directions; from 3 on: at "
             "those of bump_neighbour. image: of an op that looks one up.")
        .def("bump_neighbour", &Program::bump_neighbour, py::arg("filter_width"),
             "The first of two neighbours along the directions that bump mapping takes, filter_width footprints away.")
        .def("run_nowhere", &Program::run_nowhere, "The registers where there is no surface.")
        .def("run_at", &run_at, py::arg("positions_object"), py::arg("object_to_world"), py::arg("registers"),
             py::kw_only(), py::arg("attributes") = py::dict(),
             py::arg("color") = std::array<float, 4>{1.0f, 1.0f, 1.0f, 1.0f}, py::arg("pass_index") = 0.0f,
             py::arg("random") = 0.0f, py::arg("object_attributes") = py::dict(),
             "The chosen registers, (N, registers), at points (N, 3) within an object. What shaders ask of the mesh is "
             "in attributes, by Scene.attribute_id: (N, 1..4); of the object in color, pass_index, random, and "
             "object_attributes by the same. There is no normal, ray or camera.")
        .def_property_readonly("ops", &Program::ops, "The names of its ops, in order.");
    py::class_<Shader>(module, "Shader", "A Material of which some numbers are a program's registers.")
        .def(py::init(&constant_shader), py::arg("constants"))
        .def(py::init(&make_shader), py::arg("constants"), py::arg("program"), py::arg("varying"),
             "varying: by the name of Material's argument, the register of each number, -1 for one that is constant; "
             "'normal': the shading normal in world space; or 'own_normal', where displacement turns the surface's "
             "own; 'tangent': which way x lies of pictures of microfacets, world space.");
    py::implicitly_convertible<OwnedMaterial, Shader>();
    module.def("mean_lamp_share", &mean_lamp_share, py::arg("shader"), py::arg("light"),
               "mean_lamp_share(shader, light): what a lamp's shader leaves of its light on the whole, in grey.");
}

}  // namespace pivot::bindings
