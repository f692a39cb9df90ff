// pivot_core.film: where samples fall in a pixel, and how many it gets, for tests.
#include "bindings/arrays.h"
#include "bindings/names.h"
#include "bindings/register.h"
#include "core/film/sample_counts.h"

namespace pivot::bindings {
namespace {

py::array_t<float> filter_offsets(const std::string& pixel_filter, float width_px, const FloatArray& u) {
    require_shape(u, "u", {-1, 2});
    const PixelFilter filter(pixel_filter_from(pixel_filter), width_px);
    py::array_t<float> offsets({u.shape(0), py::ssize_t(2)});
    for (py::ssize_t i = 0; i < u.shape(0); ++i) {
        const Vec2f offset = filter.sample({u.at(i, 0), u.at(i, 1)});
        offsets.mutable_at(i, 0) = offset.x;
        offsets.mutable_at(i, 1) = offset.y;
    }
    return offsets;
}

py::array_t<std::uint32_t> sample_counts_of(const FloatArray& blocks, float relative_error, std::uint32_t max_samples) {
    require_shape(blocks, "blocks", {-1, -1, -1});
    const py::ssize_t height = blocks.shape(0), width = blocks.shape(1);
    std::vector<Pilot> pilots(static_cast<std::size_t>(height * width));
    for (std::size_t pixel = 0; pixel < pilots.size(); ++pixel) {
        const float* block = blocks.data() + static_cast<py::ssize_t>(pixel) * blocks.shape(2);
        for (py::ssize_t i = 0; i < blocks.shape(2); ++i) {
            if (std::isfinite(block[i])) pilots[pixel].add(block[i]);
        }
    }
    const std::vector<std::uint32_t> counts =
        sample_counts(pilots, static_cast<int>(width), relative_error, max_samples);
    return py::array_t<std::uint32_t>({height, width}, counts.data());
}

}  // namespace

void register_film(py::module_& film) {
    film.def("filter_offsets", &filter_offsets, py::arg("pixel_filter"), py::arg("width_px"), py::arg("u"),
             "Offsets (n, 2) from the pixel's centre, in pixels, for random numbers u (n, 2) in [0, 1).");
    film.def("pilot_samples", &pilot_samples, py::arg("max_samples"),
             "How many samples every pixel gets when at most max_samples are allowed.");
    film.def("sample_counts", &sample_counts_of, py::arg("blocks"), py::arg("relative_error"), py::arg("max_samples"),
             "How many samples each pixel gets, (height, width), after a pilot that found the means `blocks` (height, "
             "width, n) of four samples each; what is not finite was left out.");
}

}  // namespace pivot::bindings
