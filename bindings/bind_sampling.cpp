// pivot_core.sampling: the sampler's parts and its points, for tests.
#include <pybind11/numpy.h>

#include "bindings/register.h"
#include "core/sampling/sobol.h"

namespace pivot::bindings {
namespace {

namespace py = pybind11;
using WordArray = py::array_t<std::uint32_t, py::array::c_style | py::array::forcecast>;

py::array_t<float> points(const WordArray& pixel_seed, const WordArray& sample, std::uint32_t dimension, bool batches) {
    if (pixel_seed.ndim() != 1 || sample.ndim() != 1 || pixel_seed.shape(0) != sample.shape(0))
        throw py::value_error("pixel_seed and sample must have one shape (n,)");
    const auto count = static_cast<std::size_t>(sample.shape(0));
    std::vector<Sampler> samplers;
    for (std::size_t i = 0; i < count; ++i) samplers.push_back({pixel_seed.data()[i], sample.data()[i]});
    std::vector<Vec2f> values(count);
    if (batches) {
        sample_points(samplers, dimension, values);
    } else {
        for (std::size_t i = 0; i < count; ++i) values[i] = samplers[i].point(dimension);
    }
    py::array_t<float> result({sample.shape(0), py::ssize_t(2)});
    for (std::size_t i = 0; i < count; ++i) {
        result.mutable_data()[2 * i] = values[i].x;
        result.mutable_data()[2 * i + 1] = values[i].y;
    }
    return result;
}

py::tuple pixel_samplers(const py::array_t<std::uint32_t>& x, const py::array_t<std::uint32_t>& y, std::uint32_t seed,
                         std::uint32_t log2_samples, const py::array_t<std::uint32_t>& sample) {
    const auto field = [&](std::uint32_t Sampler::*member) {
        return py::vectorize([=](std::uint32_t column, std::uint32_t row, std::uint32_t index) {
            return pixel_sampler(column, row, seed, log2_samples, index).*member;
        })(x, y, sample);
    };
    return py::make_tuple(field(&Sampler::pixel_seed), field(&Sampler::sample));
}

}  // namespace

void register_sampling(py::module_& sampling) {
    sampling.def(
        "sobol_second", py::vectorize([](std::uint32_t index) { return reverse_bits(sobol_second_reversed(index)); }),
        py::arg("index"),
        "The second Sobol dimension of an index (...), a 32-bit fraction; the first is the index, bits reversed.");
    sampling.def("owen_scramble", py::vectorize([](std::uint32_t fraction, std::uint32_t seed) {
                     return reverse_bits(owen_scramble_reversed(reverse_bits(fraction), seed));
                 }),
                 py::arg("fraction"), py::arg("seed"),
                 "A 32-bit fraction (...), each bit flipped or not by those above it and the seed.");
    sampling.def("to_unit", py::vectorize([](std::uint32_t fraction) { return to_unit(fraction); }),
                 py::arg("fraction"), "A 32-bit fraction (...) as float32 in [0, 1).");
    sampling.def("points", &points, py::arg("pixel_seed"), py::arg("sample"), py::arg("dimension"),
                 py::arg("batches") = true,
                 "The points (n, 2) in [0, 1) of samples (n,) of pixels (n,): in SIMD batches, or one by one.");
    sampling.def(
        "pixel_samplers", &pixel_samplers, py::arg("x"), py::arg("y"), py::arg("seed"), py::arg("log2_samples"),
        py::arg("sample"),
        "What points() takes, pixel_seed and sample (n,), of samples (n,) below 2^log2_samples of the pixels at "
        "(x, y), both (n,): those of a square of pixels are successive points of one sequence.");
}

}  // namespace pivot::bindings
