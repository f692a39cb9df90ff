// NumPy broadcasting for free functions templated over T in {float, double}.
//
//     define(module, "cap_solid_angle", doc, [](auto versine) { return solid_angle(versine); },
//            Number{.name = "versine", .low = 0, .high = 2});
//
// Arguments broadcast over their leading axes; each spec below names the trailing axes it takes. The function runs in
// float32 if every NumPy floating-point argument is float32 (Python numbers and integers adapt, as in NumPy 2), else in
// float64. A function may return a number, a bool, a vector, a std::array of these, or a std::tuple. Bad input raises
// ValueError naming the argument.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <array>
#include <sstream>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "core/math/vector.h"

namespace pivot::bindings {

namespace py = pybind11;
using Shape = std::vector<py::ssize_t>;

[[noreturn]] inline void fail(const char* name, const std::string& problem) {
    throw py::value_error(std::string(name) + " " + problem);
}

// ---- specs: what an argument is, how its values are checked and read ------------------------------------------------
// core: its trailing axes (-1: any length). check: called once per element. read: one element from packed memory.

/// A number in [low, high]; an open end excludes its bound.
struct Number {
    const char* name;
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();
    bool open_low = false, open_high = false;

    static Shape core() { return {}; }
    template <class T>
    void check(const T* value, py::ssize_t /*size*/) const {
        const auto x = static_cast<double>(*value);
        if (x > low && x < high) return;
        if ((x == low && !open_low) || (x == high && !open_high)) return;
        std::ostringstream text;
        text << "must be in " << (open_low ? '(' : '[') << low << ", " << high << (open_high ? ')' : ']') << ", got "
             << x;
        fail(name, text.str());
    }
    template <class T>
    static T read(const T* value, py::ssize_t /*size*/) {
        return *value;
    }
};

/// Two random numbers in [0, 1): shape (..., 2).
struct UnitSquare {
    const char* name;

    static Shape core() { return {2}; }
    template <class T>
    void check(const T* value, py::ssize_t size) const {
        const Number number{.name = name, .low = 0, .high = 1, .open_high = true};
        for (py::ssize_t i = 0; i < size; ++i) number.check(value + i, 1);
    }
    template <class T>
    static Vec2<T> read(const T* value, py::ssize_t /*size*/) {
        return {value[0], value[1]};
    }
};

/// Any vector: shape (..., 3).
struct Vector {
    const char* name;

    static Shape core() { return {3}; }
    template <class T>
    void check(const T* /*value*/, py::ssize_t /*size*/) const {}
    template <class T>
    static Vec3<T> read(const T* value, py::ssize_t /*size*/) {
        return {value[0], value[1], value[2]};
    }
};

/// A unit vector, to float32 rounding: shape (..., 3).
struct Direction : Vector {
    template <class T>
    void check(const T* value, py::ssize_t size) const {
        const double norm = length(Vec3<double>(read(value, size)));
        if (!(std::abs(norm - 1) < 1e-5)) fail(name, "must be of unit length, got length " + std::to_string(norm));
    }
};

/// A matrix that can be inverted in T: shape (..., 3, 3), row-major as NumPy's.
struct Matrix {
    const char* name;

    static Shape core() { return {3, 3}; }
    template <class T>
    void check(const T* value, py::ssize_t size) const {
        const Mat3<double> m(read(value, size));
        const double scale = length(m[0]) * length(m[1]) * length(m[2]);
        if (!(std::abs(glm::determinant(m)) > static_cast<double>(std::numeric_limits<T>::epsilon()) * scale))
            fail(name, "is singular");
    }
    template <class T>
    static Mat3<T> read(const T* v, py::ssize_t /*size*/) {
        return {v[0], v[3], v[6], v[1], v[4], v[7], v[2], v[5], v[8]};
    }
};

/// The vertices of a polygon, at least three, none at the origin: shape (..., n, 3).
struct Polygon {
    const char* name;

    static Shape core() { return {-1, 3}; }
    template <class T>
    void check(const T* value, py::ssize_t size) const {
        if (size < 9) fail(name, "needs at least three vertices, got " + std::to_string(size / 3));
        for (const Vec3<T>& vertex : read(value, size))
            if (dot(vertex, vertex) == T(0)) fail(name, "has a vertex at the origin");
    }
    template <class T>
    static std::vector<Vec3<T>> read(const T* value, py::ssize_t size) {
        std::vector<Vec3<T>> vertices;
        for (py::ssize_t i = 0; i < size; i += 3) vertices.emplace_back(value[i], value[i + 1], value[i + 2]);
        return vertices;
    }
};

// ---- arrays ---------------------------------------------------------------------------------------------------------

/// What this argument asks for: Python numbers and integers leave the choice to the others.
enum class Precision { any, single, full };

inline Precision precision(const py::object& object) {
    if (py::isinstance<py::float_>(object) && !py::hasattr(object, "dtype")) return Precision::any;
    const py::array array = py::array::ensure(object);
    if (!array || array.dtype().kind() != 'f') return Precision::any;
    return py::isinstance<py::array_t<float>>(array) ? Precision::single : Precision::full;
}

inline py::ssize_t product(const Shape& shape) {
    py::ssize_t size = 1;
    for (const py::ssize_t n : shape) size *= n;
    return size;
}

/// One argument as packed T: its leading shape, its trailing axes' size, and every value checked.
template <class T>
struct Input {
    py::array_t<T, py::array::c_style | py::array::forcecast> values;
    Shape leading;
    py::ssize_t size = 1;

    template <class Spec>
    Input(const Spec& spec, const py::object& object) {
        const py::array raw = py::array::ensure(object);
        if (!raw || std::string("biuf").find(raw.dtype().kind()) == std::string::npos)
            fail(spec.name, "must be an array of real numbers");
        values = py::array_t<T, py::array::c_style | py::array::forcecast>(raw);
        const Shape core = Spec::core(), shape(values.shape(), values.shape() + values.ndim());
        bool fits = shape.size() >= core.size();
        for (size_t k = 0; fits && k < core.size(); ++k) {
            const py::ssize_t n = shape[shape.size() - core.size() + k];
            fits = core[k] < 0 || n == core[k];
            size *= n;
        }
        if (!fits) {
            std::string expected;
            for (const py::ssize_t n : core) expected += n < 0 ? ", n" : ", " + std::to_string(n);
            fail(spec.name, "must have shape (..." + expected + ")");
        }
        leading.assign(shape.begin(), shape.end() - static_cast<std::ptrdiff_t>(core.size()));
        const py::ssize_t elements = product(leading);
        for (py::ssize_t i = 0; i < elements * size; ++i)
            if (!std::isfinite(values.data()[i])) fail(spec.name, "must be finite");
        for (py::ssize_t i = 0; i < elements; ++i) spec.check(values.data() + i * size, size);
    }

    /// The element at flat index i of the broadcast shape `common`.
    const T* at(py::ssize_t i, const Shape& common) const {
        py::ssize_t offset = 0, stride = size;
        for (size_t k = 1; k <= leading.size(); ++k) {
            const py::ssize_t n = leading[leading.size() - k], wide = common[common.size() - k];
            if (n > 1) offset += (i % wide) * stride;
            i /= wide;
            stride *= n;
        }
        return values.data() + offset;
    }
};

inline void broadcast(Shape& common, const Shape& shape, const char* name) {
    if (shape.size() > common.size()) common.insert(common.begin(), shape.size() - common.size(), 1);
    for (size_t k = 1; k <= shape.size(); ++k) {
        py::ssize_t& wide = common[common.size() - k];
        const py::ssize_t n = shape[shape.size() - k];
        if (wide == 1) wide = n;
        if (n != 1 && n != wide) fail(name, "does not broadcast with the other arguments");
    }
}

/// How a returned value lies in an array: numbers and bools (...), vectors (..., n), std::arrays of either (..., n,
/// ...).
template <class V>
struct Element {
    using Scalar = V;
    static Shape core() { return {}; }
    static void write(Scalar* out, const V& value) { *out = value; }
};

template <glm::length_t N, class T>
struct Element<glm::vec<N, T>> {
    using Scalar = T;
    static Shape core() { return {N}; }
    static void write(Scalar* out, const glm::vec<N, T>& value) {
        for (glm::length_t k = 0; k < N; ++k) out[k] = value[k];
    }
};

template <class V, size_t N>
struct Element<std::array<V, N>> {
    using Scalar = typename Element<V>::Scalar;
    static Shape core() {
        Shape shape = Element<V>::core();
        shape.insert(shape.begin(), N);
        return shape;
    }
    static void write(Scalar* out, const std::array<V, N>& values) {
        for (const V& value : values) Element<V>::write(std::exchange(out, out + product(Element<V>::core())), value);
    }
};

template <class V>
struct Output {
    py::array_t<typename Element<V>::Scalar> values;
    py::ssize_t size = product(Element<V>::core());

    explicit Output(Shape shape) : values(extended(std::move(shape))) {}
    void write(py::ssize_t i, const V& value) { Element<V>::write(values.mutable_data() + i * size, value); }

    static Shape extended(Shape shape) {
        for (const py::ssize_t n : Element<V>::core()) shape.push_back(n);
        return shape;
    }
};

template <class V>
std::tuple<V> as_tuple(V value) {
    return {value};
}
template <class... V>
std::tuple<V...> as_tuple(std::tuple<V...> values) {
    return values;
}

template <class T, class Fn, class... Specs, size_t... I>
py::object evaluate(const Fn& fn, const std::tuple<Specs...>& specs,
                    const std::array<py::object, sizeof...(I)>& objects, std::index_sequence<I...>) {
    const std::array<Input<T>, sizeof...(I)> inputs{Input<T>(std::get<I>(specs), objects[I])...};
    Shape common;
    (broadcast(common, inputs[I].leading, std::get<I>(specs).name), ...);

    const auto call = [&](py::ssize_t i) { return fn(Specs::read(inputs[I].at(i, common), inputs[I].size)...); };
    return [&]<class... V>(std::tuple<V...>*) -> py::object {
        std::tuple<Output<V>...> outputs{Output<V>(common)...};
        for (py::ssize_t i = 0; i < product(common); ++i) {
            const std::tuple<V...> values = as_tuple(call(i));
            [&]<size_t... K>(std::index_sequence<K...>) { (std::get<K>(outputs).write(i, std::get<K>(values)), ...); }
            (std::index_sequence_for<V...>());
        }
        const auto unwrap = [](const py::array& array) -> py::object { return array[py::tuple()]; };  // 0-d -> scalar
        return std::apply(
            [&](const auto&... output) -> py::object {
                if constexpr (std::is_same_v<decltype(call(0)), std::tuple<V...>>)
                    return py::make_tuple(unwrap(output.values)...);
                else
                    return (unwrap(output.values), ...);
            },
            outputs);
    }(static_cast<decltype(as_tuple(call(0)))*>(nullptr));
}

/// `fn` over arrays: a callable taking one Python object per spec.
template <class Fn, class... Specs>
auto vectorized(Fn fn, Specs... specs) {
    return [fn, specs = std::tuple(specs...)](std::conditional_t<true, const py::object&, Specs>... arguments) {
        const std::array<py::object, sizeof...(Specs)> objects{arguments...};
        bool single = false, full = false;
        for (const py::object& object : objects) {
            single |= precision(object) == Precision::single;
            full |= precision(object) == Precision::full;
        }
        constexpr auto indices = std::index_sequence_for<Specs...>();
        if (single && !full) return evaluate<float>(fn, specs, objects, indices);
        return evaluate<double>(fn, specs, objects, indices);
    };
}

/// Adds `fn` over arrays to the module, each argument under its spec's name.
template <class Fn, class... Specs>
void define(py::module_& module, const char* name, const char* doc, Fn fn, Specs... specs) {
    module.def(name, vectorized(fn, specs...), doc, py::arg(specs.name)...);
}

}  // namespace pivot::bindings
