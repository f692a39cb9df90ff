// pivot_core.LOBES: the kinds of lobes and their parameters; and the BSDF of a Material, for tests.
#include "bindings/lobes.h"
#include "core/simd/pack.h"

namespace pivot::bindings {
namespace {

[[noreturn]] void fail(std::string_view kind, const std::string& message) {
    throw py::value_error("lobe '" + std::string(kind) + "': " + message);
}

template <class L>
std::string names_of_parameters() {
    std::string names;
    for (const LobeParameter& parameter : L::parameters)
        names += (names.empty() ? "" : ", ") + std::string(parameter.name);
    return names;
}

/// One number or colour of a kind's Parameters.
void set_parameter(std::string_view kind, const LobeParameter& parameter,
                   const std::variant<float, Triple, LobeTable>& value, float* numbers) {
    const std::string name(parameter.name);
    const auto* color = std::get_if<Triple>(&value);
    const bool is_one = parameter.count == 1;
    if (is_one ? !std::holds_alternative<float>(value) : !color)
        fail(kind, name + " must be " + (is_one ? "one number" : "three numbers"));
    for (std::size_t i = 0; i < parameter.count; ++i) {
        numbers[i] = color ? (*color)[i] : std::get<float>(value);
        if (!(numbers[i] >= parameter.low && numbers[i] <= parameter.high))
            fail(kind, name + " must be finite and " +
                           (parameter.high < std::numeric_limits<float>::max()
                                ? "in [" + std::to_string(parameter.low) + ", " + std::to_string(parameter.high) + "]"
                                : "at least " + std::to_string(parameter.low)));
    }
}

constexpr const char* table_name = "ndf";

/// The table that a kind reads, which is kept, and where it is.
template <class L>
AddressOf<float> set_table(const LobeArguments::value_type::second_type& values, OwnedMaterial& material) {
    const auto value = values.find(table_name);
    const auto* table = value != values.end() ? std::get_if<LobeTable>(&value->second) : nullptr;
    if (!table || !*table) fail(L::name, std::string(table_name) + " must be a TabulatedNdf");
    material.tables.push_back(*table);
    return AddressOf<float>::of(table->get());
}

template <class L>
LobeOf<float> to_lobe(float kind, const LobeArguments::value_type::second_type& values, OwnedMaterial& material) {
    LobeOf<float> lobe{};
    lobe.kind = kind;
    typename L::Parameters start{};
    std::size_t known = 0, first = 0;
    if constexpr (HasTable<L>) {
        start.ndf = set_table<L>(values, material);
        ++known;
    }
    lobe.write(start);
    for (const LobeParameter& parameter : L::parameters) {
        if (const auto value = values.find(std::string(parameter.name)); value != values.end()) {
            set_parameter(L::name, parameter, value->second, &lobe.numbers[first]);
            ++known;
        }
        first += parameter.count;
    }
    if (known < values.size()) fail(L::name, "its parameters are " + names_of_parameters<L>());
    return lobe;
}

Surface surface_of(const Material& material, const Triple& wo_local) {
    const Vec3f wo = normalize(to_vec3(wo_local));
    if (!(wo.z > 0.0f)) throw py::value_error("wo_local must be above the surface: z > 0");
    return make_surface(material, wo);
}

/// of(surface, rows (n, 3), one a lane): what it makes of each row.
template <std::size_t columns, class Of>
py::array_t<float> map_rows(const Surface& surface, const FloatArray& rows, const Of& of) {
    const auto lanes = broadcast<SurfaceOf>(surface);
    const py::ssize_t count = rows.shape(0), step = batch_size;
    py::array_t<float> result({count, static_cast<py::ssize_t>(columns)});
    for (py::ssize_t first = 0; first < count; first += step) {
        const std::array<Batch, columns> values =
            of(lanes, gather_vector([&](std::size_t lane) {
                   const py::ssize_t row = std::min(first + static_cast<py::ssize_t>(lane), count - 1);
                   return Vec3f(rows.at(row, 0), rows.at(row, 1), rows.at(row, 2));
               }));
        for (std::size_t c = 0; c < columns; ++c) {
            const Lanes each = store(values[c]);
            for (py::ssize_t row = first; row < std::min(first + step, count); ++row)
                result.mutable_at(row, c) = each[static_cast<std::size_t>(row - first)];
        }
    }
    return result;
}

std::array<Batch, 3> columns_of(const Vec3b& v) { return {v.x, v.y, v.z}; }

py::tuple evaluate(const OwnedMaterial& material, const Triple& wo_local, const FloatArray& wi_local) {
    require_shape(wi_local, "wi_local", {-1, 3});
    const Surface surface = surface_of(material, wo_local);
    return py::make_tuple(
        map_rows<3>(surface, wi_local, [](const auto& s, const Vec3b& wi) { return columns_of(eval(s, wi)); }),
        map_rows<1>(surface, wi_local, [](const auto& s, const Vec3b& wi) { return std::array{pdf_omega(s, wi)}; }));
}

py::array_t<float> sample_directions(const OwnedMaterial& material, const Triple& wo_local, const FloatArray& u) {
    require_shape(u, "u", {-1, 3});
    return map_rows<3>(surface_of(material, wo_local), u, [](const auto& s, const Vec3b& row) {
        return columns_of(sample(s, row.x, Vec2b(row.y, row.z)));
    });
}

Triple albedo(const OwnedMaterial& material, const Triple& wo_local) {
    const Surface surface = surface_of(material, wo_local);
    Rgb total = albedo_base(surface);
    for_each_lobe(surface,
                  [&](const auto& lobe, const LobeOf<float>&, bool) { total += lobe.albedo(surface.wo_local); });
    return {total.x, total.y, total.z};
}

}  // namespace

void set_lobes(OwnedMaterial& material, const LobeArguments& arguments) {
    if (arguments.size() > max_lobes)
        throw py::value_error("a material has at most " + std::to_string(max_lobes) + " lobes beside its base");
    std::array<LobeOf<float>, max_lobes>& lobes = material.lobes;
    lobes = {};
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        const auto& [name, values] = arguments[i];
        std::string known;
        for_each_lobe_kind<float>([&, &name = name, &values = values]<class L>(float kind) {
            if (L::name == name) lobes[i] = to_lobe<L>(kind, values, material);
            known += (known.empty() ? "" : ", ") + std::string(L::name);
        });
        if (lobes[i].kind == 0.0f) fail(name, "there is no such kind; there are " + known);
    }
}

void register_lobes(py::module_& module) {
    py::dict kinds;
    py::list with_tables;
    for_each_lobe_kind<float>([&]<class L>(float) {
        py::dict parameters;
        for (const LobeParameter& p : L::parameters)
            parameters[py::str(std::string(p.name))] = py::make_tuple(p.count, p.low, p.high);
        if constexpr (HasTable<L>) with_tables.append(py::str(std::string(L::name)));
        kinds[py::str(std::string(L::name))] = parameters;
    });
    module.attr("LOBES") = kinds;
    module.attr("LOBES_WITH_NDF") = with_tables;
    module.attr("MAX_LOBES") = max_lobes;
    auto material = module.attr("Material").cast<py::class_<OwnedMaterial>>();
    material.def("evaluate", &evaluate, py::arg("wo_local"), py::arg("wi_local"),
                 "BSDF times |cos| (n, 3), and the density of sample() (n, 1), both per steradian; wi_local (n, 3).");
    material.def("sample", &sample_directions, py::arg("wo_local"), py::arg("u"),
                 "Directions (n, 3) by u (n, 3) in [0, 1): the first number chooses the lobe, the others place it.");
    material.def("albedo", &albedo, py::arg("wo_local"),
                 "About what it sends towards wo_local where all light around is 1, by which lobes are chosen.");
}

}  // namespace pivot::bindings
