#include "core/textures/image.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <stdexcept>

#include "core/textures/srgb.h"
#include "core/textures/texels.h"

namespace pivot {
namespace {

constexpr std::size_t read_beyond = 16;

template <class Number>
Number load_number(const std::byte* at) {
    Number number;
    std::memcpy(&number, at, sizeof(Number));
    return number;
}

float load_as_float(TexelType type, const std::byte* at) {
    switch (type) {
        case TexelType::uint8:
            return static_cast<float>(load_number<std::uint8_t>(at)) * (1 / 255.0f);
        case TexelType::uint16:
            return static_cast<float>(load_number<std::uint16_t>(at)) * (1 / 65535.0f);
        case TexelType::float16:
            return float_from_half(load_number<std::uint16_t>(at));
        case TexelType::float32:
            return load_number<float>(at);
    }
    return 0.0f;
}

template <class Number>
void store_number(std::byte* at, Number number) {
    std::memcpy(at, &number, sizeof(Number));
}

void store_float(TexelType type, std::byte* at, float x) {
    const auto whole = [&](float largest) { return clamp01(x) * largest + 0.5f; };
    switch (type) {
        case TexelType::uint8:
            return store_number(at, static_cast<std::uint8_t>(whole(255.0f)));
        case TexelType::uint16:
            return store_number(at, static_cast<std::uint16_t>(whole(65535.0f)));
        case TexelType::float16:
            return store_number(at, half_from_float(x));
        case TexelType::float32:
            return store_number(at, x);
    }
}

/// What each byte of an sRGB picture stands for.
const std::array<float, 256>& linear_bytes() {
    static const auto table = [] {
        std::array<float, 256> linear;
        for (std::size_t i = 0; i < linear.size(); ++i)
            linear[i] = linear_from_srgb(static_cast<float>(i) * (1 / 255.0f));
        return linear;
    }();
    return table;
}

/// What of three neighbouring texels, from the first, goes into one of half as many.
struct Share {
    std::uint32_t first;
    std::array<float, 3> weights;
};

Share share_of(std::uint32_t place, std::uint32_t from, std::uint32_t to) {
    const double ratio = static_cast<double>(from) / to, begin = place * ratio, end = begin + ratio;
    Share share{.first = static_cast<std::uint32_t>(begin), .weights = {}};
    for (std::uint32_t i = 0; i < 3; ++i) {
        const double inside = std::min<double>(end, share.first + i + 1) - std::max<double>(begin, share.first + i);
        share.weights[i] = static_cast<float>(std::max(inside, 0.0) / ratio);
    }
    return share;
}

}  // namespace

/// A row's numbers, channel by channel of each texel; a few more, so that batches fit.
struct Image::Row {
    std::vector<float> numbers;

    explicit Row(std::size_t count) : numbers(count + batch_size) {}

    /// A curve over all but alpha.
    template <class Curve>
    void apply(std::uint32_t channels, const Curve& curve) {
        const Batch alphas = gather([&](std::size_t i) { return channels % 2 == 0 && (i + 1) % channels == 0; });
        for (std::size_t i = 0; i + batch_size <= numbers.size(); i += batch_size) {
            const Batch x = Batch::load_unaligned(&numbers[i]);
            select(alphas > Batch(0.5f), x, curve(x)).store_unaligned(&numbers[i]);
        }
    }
};

Image::Image(std::uint32_t width, std::uint32_t height, std::uint32_t channels, TexelType type, bool is_srgb,
             std::span<const std::byte> texels)
    : type_(type), channels_(channels), is_srgb_(is_srgb) {
    if (width == 0 || height == 0) throw std::invalid_argument("an image needs at least one pixel");
    if (width > 1u << 20 || height > 1u << 20) throw std::invalid_argument("an image has at most 2^20 pixels a side");
    if (channels < 1 || channels > 4) throw std::invalid_argument("an image has 1 to 4 channels");
    if (texels.size() != std::size_t{width} * height * texel_bytes())
        throw std::invalid_argument("an image's texels do not fill it");
    std::size_t bytes = 0;
    for (Level level{width, height, 0};; level = {std::max(level.width / 2, 1u), std::max(level.height / 2, 1u), 0}) {
        level.first_byte = bytes;
        levels_.push_back(level);
        bytes += std::size_t{level.width} * level.height * texel_bytes();
        if (level.width == 1 && level.height == 1) break;
    }
    memory_bytes_ = bytes + read_beyond;
    texels_ = std::make_unique_for_overwrite<std::byte[]>(memory_bytes_);
    std::ranges::copy(texels, texels_.get());
}

/// A thread that helps here must not begin other work, which may look this image up and wait for itself.
void Image::make_levels() const {
    std::call_once(are_levels_made_, [&] {
        tbb::this_task_arena::isolate([&] {
            for (std::size_t i = 1; i < levels_.size(); ++i) make_level(levels_[i - 1], levels_[i]);
        });
    });
}

std::size_t Image::texel_bytes() const { return number_bytes(type_) * channels_; }

Image::Row Image::linear_row(const Level& level, std::uint32_t y) const {
    const std::size_t count = std::size_t{level.width} * channels_;
    Row row(count);
    const std::byte* at = &texels_[level.first_byte + std::size_t{y} * level.width * texel_bytes()];
    if (is_srgb_ && type_ == TexelType::uint8) {
        const bool has_alpha = channels_ % 2 == 0;
        for (std::size_t i = 0; i < count; ++i) {
            const auto byte = static_cast<std::size_t>(at[i]);
            const bool is_alpha = has_alpha && (i + 1) % channels_ == 0;
            row.numbers[i] = is_alpha ? static_cast<float>(byte) * (1 / 255.0f) : linear_bytes()[byte];
        }
        return row;
    }
    for (std::size_t i = 0; i < count; ++i) row.numbers[i] = load_as_float(type_, at + i * number_bytes(type_));
    if (is_srgb_) row.apply(channels_, linear_from_srgb<Batch>);
    return row;
}

void Image::store_row(const Level& level, std::uint32_t y, Row row) const {
    if (is_srgb_) row.apply(channels_, srgb_from_linear<Batch>);
    std::byte* at = &texels_[level.first_byte + std::size_t{y} * level.width * texel_bytes()];
    for (std::size_t i = 0; i < std::size_t{level.width} * channels_; ++i)
        store_float(type_, at + i * number_bytes(type_), row.numbers[i]);
}

/// Each texel is the mean of what it covers, in linear light.
void Image::make_level(const Level& from, const Level& to) const {
    std::vector<Share> columns(to.width);
    for (std::uint32_t x = 0; x < to.width; ++x) columns[x] = share_of(x, from.width, to.width);
    tbb::parallel_for(0u, to.height, [&](std::uint32_t y) {
        const Share rows = share_of(y, from.height, to.height);
        Row row(std::size_t{to.width} * channels_);
        for (std::uint32_t j = 0; j < 3; ++j) {
            if (rows.weights[j] == 0.0f) continue;
            const Row source = linear_row(from, rows.first + j);
            for (std::uint32_t x = 0; x < to.width; ++x)
                for (std::uint32_t i = 0; i < 3; ++i) {
                    const float weight = rows.weights[j] * columns[x].weights[i];
                    if (weight == 0.0f) continue;
                    for (std::uint32_t c = 0; c < channels_; ++c)
                        row.numbers[x * channels_ + c] +=
                            weight * source.numbers[(columns[x].first + i) * channels_ + c];
                }
        }
        store_row(to, y, std::move(row));
    });
}

std::vector<float> Image::linear_rgba(std::size_t level) const {
    if (level > 0) make_levels();
    const Level& chosen = levels_[level];
    std::vector<float> rgba;
    rgba.reserve(std::size_t{chosen.width} * chosen.height * 4);
    for (std::uint32_t y = 0; y < chosen.height; ++y) {
        const Row row = linear_row(chosen, y);
        for (std::uint32_t x = 0; x < chosen.width; ++x) {
            const float* texel = &row.numbers[x * channels_];
            for (std::uint32_t c = 0; c < 3; ++c) rgba.push_back(texel[channels_ < 3 ? 0 : c]);
            rgba.push_back(channels_ % 2 == 0 ? texel[channels_ - 1] : 1.0f);
        }
    }
    return rgba;
}

}  // namespace pivot
