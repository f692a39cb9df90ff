// pivot_core.Image.
#include "bindings/arrays.h"
#include "bindings/register.h"
#include "core/textures/image.h"

namespace pivot::bindings {
namespace {

TexelType type_of(const py::dtype& dtype) {
    const char kind = dtype.kind();
    if (kind == 'u' && dtype.itemsize() == 1) return TexelType::uint8;
    if (kind == 'u' && dtype.itemsize() == 2) return TexelType::uint16;
    if (kind == 'f' && dtype.itemsize() == 2) return TexelType::float16;
    if (kind == 'f' && dtype.itemsize() == 4) return TexelType::float32;
    throw py::type_error("image: pixels must be of uint8, uint16, float16 or float32");
}

std::shared_ptr<Image> make_image(const py::array& pixels, bool srgb) {
    require_shape(pixels, "image: pixels", {-1, -1, -1});
    const TexelType type = type_of(pixels.dtype());
    if (!(pixels.flags() & py::array::c_style)) throw py::value_error("image: pixels must lie row by row in memory");
    const auto size = [&](py::ssize_t axis) { return static_cast<std::uint32_t>(pixels.shape(axis)); };
    const std::span texels(static_cast<const std::byte*>(pixels.data()), static_cast<std::size_t>(pixels.nbytes()));
    const std::uint32_t width = size(1), height = size(0), channels = size(2);
    const py::gil_scoped_release release;
    return std::make_shared<Image>(width, height, channels, type, srgb, texels);
}

py::array_t<float> level(const Image& image, std::size_t index) {
    if (index >= image.levels().size()) throw py::index_error("an image has no such level");
    const Image::Level& size = image.levels()[index];
    py::array_t<float> rgba({py::ssize_t{size.height}, py::ssize_t{size.width}, py::ssize_t{4}});
    std::ranges::copy(image.linear_rgba(index), rgba.mutable_data());
    return rgba;
}

}  // namespace

void register_images(py::module_& module) {
    py::class_<Image, std::shared_ptr<Image>>(module, "Image", "A picture that ops of programs look up; immutable.")
        .def(py::init(&make_image), py::arg("pixels"), py::arg("srgb") = false,
             "pixels (height, width, channels), copied: uint8 and uint16 for 0..1, float16, float32; the first row is "
             "the bottom one. Channels: grey; grey, alpha; RGB; RGBA. srgb: the colours are encoded so.")
        .def_property_readonly("level_count", [](const Image& image) { return image.levels().size(); })
        .def("level", &level, py::arg("index"),
             "(height, width, 4) linear: the picture, and from 1 on its copies of half the size of the one before.")
        .def_property_readonly("memory_bytes", &Image::memory_bytes);
}

}  // namespace pivot::bindings
