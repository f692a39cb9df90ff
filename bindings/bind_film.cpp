// pivot_core.film: where samples fall in a pixel, and how many it gets, for tests.
#include "bindings/arrays.h"
#include "bindings/names.h"
#include "bindings/register.h"
#include "core/film/sample_counts.h"

namespace pivot::bindings {
namespace {

py::tuple filter_samples(const std::string& pixel_filter, float width_px, const FloatArray& u) {
    require_shape(u, "u", {-1, 2});
    const PixelFilter filter(pixel_filter_from(pixel_filter), width_px);
    const py::ssize_t pixels = 2 * filter.reach_px() + 1;
    py::array_t<float> offsets({u.shape(0), py::ssize_t(2)}), weights({u.shape(0), py::ssize_t(2), pixels});
    for (py::ssize_t i = 0; i < u.shape(0); ++i) {
        const FilterSample sample = filter.sample({u.at(i, 0), u.at(i, 1)});
        offsets.mutable_at(i, 0) = sample.offset.x;
        offsets.mutable_at(i, 1) = sample.offset.y;
        std::ranges::copy(sample.weights_x, weights.mutable_data(i, 0));
        std::ranges::copy(sample.weights_y, weights.mutable_data(i, 1));
    }
    return py::make_tuple(offsets, weights);
}

py::tuple sample_counts_of(const FloatArray& samples, int reach_px, float half_error, float relative_error,
                           std::uint32_t max_samples) {
    require_shape(samples, "samples", {2, -1, -1, -1});
    const auto pilot_samples = static_cast<std::uint32_t>(2 * samples.shape(3));
    if (max_samples < pilot_samples) throw py::value_error("max_samples must not be below the pilot's, 2 n");
    const PixelGrid grid{static_cast<int>(samples.shape(2)), static_cast<int>(samples.shape(1))};
    std::array<std::vector<Pilot>, 2> pilot;
    const float* sample = samples.data();
    for (std::vector<Pilot>& half : pilot) {
        half.resize(grid.size());
        for (Pilot& pixel : half)
            for (py::ssize_t i = 0; i < samples.shape(3); ++i) pixel.add(*sample++);
    }
    const SampleCounts counts =
        sample_counts(pilot, grid, reach_px, half_error, relative_error, pilot_samples, max_samples);
    py::array_t<float> weights({py::ssize_t(2), samples.shape(1), samples.shape(2)});
    for (const std::size_t half : {0, 1})
        std::ranges::copy(counts.half_weight[half], weights.mutable_data(static_cast<py::ssize_t>(half)));
    return py::make_tuple(py::array_t<std::uint32_t>({samples.shape(1), samples.shape(2)}, counts.further.data()),
                          weights);
}

}  // namespace

void register_film(py::module_& film) {
    film.def("filter_samples", &filter_samples, py::arg("pixel_filter"), py::arg("width_px"), py::arg("u"),
             "For random numbers u (n, 2) in [0, 1): offsets (n, 2) from the pixel's centre, in pixels; weights (n, 2, "
             "k) along x and y for the k pixels around and including it.");
    film.def(
        "sample_counts", &sample_counts_of, py::arg("samples"), py::arg("reach_px"), py::arg("half_error"),
        py::arg("relative_error"), py::arg("max_samples"),
        "After a pilot that found radiances `samples` (2, height, width, n), by halves, whose pictures have the mean "
        "squared error half_error: how many samples follow for each pixel (height, width), and what each half weighs "
        "in the picture (2, height, width).");
}

}  // namespace pivot::bindings
