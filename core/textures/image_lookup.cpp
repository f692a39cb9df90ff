// Image::lookup: which texels, with what weights. [C] is Cycles 4.5, kernel/device/cpu/image.h.
#include "core/textures/image.h"
#include "core/textures/srgb.h"
#include "core/textures/texels.h"

namespace pivot {
namespace {

const Batch zero(0.0f), one(1.0f);

/// The texels along one axis that a lookup takes, whole numbers within the picture, and their weights: 0 past a clip.
struct Taps {
    std::uint32_t count;
    std::array<Batch, 4> places, weights;
};

/// What is left of x / size, both whole: exact to 2^24.
Batch remainder(const Batch& x, const Batch& size) {
    const Batch rest = x - size * floor(x / size);
    return select(rest < zero, rest + size, select(rest >= size, rest - size, rest));
}

Batch wrapped(const Batch& place, const Batch& size, Extension extension) {
    switch (extension) {
        case Extension::repeat:
            return remainder(place, size);
        case Extension::extend:
        case Extension::clip:
            return min(max(place, zero), size - one);
        case Extension::mirror: {
            const Batch there_and_back = remainder(place, size + size);
            return select(there_and_back < size, there_and_back, size + size - one - there_and_back);
        }
    }
    return place;
}

Taps taps_at(const Batch& coordinate, const Batch& size, const ImageLookup& how) {
    Taps taps;
    const bool closest = how.interpolation == Interpolation::closest;
    const Batch scaled = coordinate * size - Batch(closest ? 0.0f : 0.5f);
    // Nonsense is looked up somewhere.
    const Batch x = select(abs(scaled) < Batch(0x1p22f), scaled, zero);
    const Batch whole = trunc(x) - select(x < zero, one, zero), t = x - whole;  // [C frac]
    Batch first = whole;
    switch (how.interpolation) {
        case Interpolation::closest:
            taps.count = 1;
            taps.weights[0] = one;
            break;
        case Interpolation::linear:
            taps.count = 2;
            taps.weights[0] = one - t;
            taps.weights[1] = t;
            break;
        case Interpolation::cubic: {  // the B-spline
            const Batch sixth(1.0f / 6.0f), half(0.5f);
            first = whole - one;
            taps.count = 4;
            taps.weights[0] = ((-sixth * t + half) * t - half) * t + sixth;
            taps.weights[1] = (half * t - one) * t * t + Batch(2.0f / 3.0f);
            taps.weights[2] = ((-half * t + half) * t + half) * t + sixth;
            taps.weights[3] = sixth * t * t * t;
        }
    }
    for (std::uint32_t i = 0; i < taps.count; ++i) {
        const Batch place = first + Batch(static_cast<float>(i));
        taps.places[i] = wrapped(place, size, how.extension);
        if (how.extension == Extension::clip)
            taps.weights[i] = select(place >= zero && place < size, taps.weights[i], zero);
    }
    return taps;
}

/// A level of a picture in each lane.
struct LevelLanes {
    Batch width, height;
    std::array<std::size_t, batch_size> widths;
    std::array<const std::byte*, batch_size> texels;
};

/// What interpolates: the stored numbers, and how much of the place is within the picture.
struct Interpolated {
    std::array<Batch, 4> numbers{zero, zero, zero, zero};
    Batch coverage = zero;
};

std::array<std::int32_t, batch_size> indices(const Batch& x) {
    return std::bit_cast<std::array<std::int32_t, batch_size>>(xsimd::to_int(x));
}

template <TexelType type, std::uint32_t channels>
Interpolated interpolate(const LevelLanes& level, const Taps& x, const Taps& y) {
    constexpr std::size_t texel_bytes = number_bytes(type) * channels, word_count = (texel_bytes + 3) / 4;
    Interpolated result;
    for (std::uint32_t j = 0; j < y.count; ++j) {
        const auto rows = indices(y.places[j]);
        std::array<const std::byte*, batch_size> starts;
        for (std::size_t lane = 0; lane < batch_size; ++lane)
            starts[lane] = level.texels[lane] + static_cast<std::size_t>(rows[lane]) * level.widths[lane] * texel_bytes;
        for (std::uint32_t i = 0; i < x.count; ++i) {
            const auto columns = indices(x.places[i]);
            std::array<std::array<std::uint32_t, batch_size>, word_count> lanes;
            for (std::size_t lane = 0; lane < batch_size; ++lane) {
                std::array<std::uint32_t, word_count> words;
                std::memcpy(words.data(), starts[lane] + static_cast<std::size_t>(columns[lane]) * texel_bytes,
                            sizeof(words));
                for (std::size_t w = 0; w < word_count; ++w) lanes[w][lane] = words[w];
            }
            std::array<WordBatch, 4> words;
            for (std::size_t w = 0; w < word_count; ++w) words[w] = std::bit_cast<WordBatch>(lanes[w]);
            const Batch weight = y.weights[j] * x.weights[i];
            for (std::uint32_t c = 0; c < channels; ++c) result.numbers[c] += weight * number_of<type>(words, c);
            result.coverage += weight;
        }
    }
    return result;
}

using Interpolate = Interpolated (*)(const LevelLanes&, const Taps&, const Taps&);

template <TexelType type>
constexpr std::array<Interpolate, 4> of_type{interpolate<type, 1>, interpolate<type, 2>, interpolate<type, 3>,
                                             interpolate<type, 4>};

Interpolate interpolation_of(TexelType type, std::uint32_t channels) {
    switch (type) {
        case TexelType::uint8:
            return of_type<TexelType::uint8>[channels - 1];
        case TexelType::uint16:
            return of_type<TexelType::uint16>[channels - 1];
        case TexelType::float16:
            return of_type<TexelType::float16>[channels - 1];
        case TexelType::float32:
            return of_type<TexelType::float32>[channels - 1];
    }
    return nullptr;
}

/// Where in a picture, and over how many of its levels and texels, a lookup goes.
struct Probes {
    Batch count;  ///< side by side along the footprint
    Vec2b step;   ///< the footprint's longer side
    Batch depth;  ///< level, with a fraction
    float most;   ///< the largest count
    bool any_deep;
};

/// A footprint that is longer than wide is looked up in several places along it, each about as wide as it is.
Probes probes_over(Vec2b x, Vec2b y, const Image& image, bool closed_u) {
    constexpr float max_probes = 8.0f;
    if (closed_u)
        for (Vec2b* step : {&x, &y}) step->x -= floor(step->x + Batch(0.5f));
    const Batch width(static_cast<float>(image.width())), height(static_cast<float>(image.height()));
    const auto texels2 = [&](const Vec2b& step) {
        const Batch columns = step.x * width, rows = step.y * height;
        return columns * columns + rows * rows;
    };
    const Batch x2 = texels2(x), y2 = texels2(y);
    const BatchMask along_x = x2 >= y2, minified = max(x2, y2) > one && max(x2, y2) < Batch(0x1p80f);
    Probes probes{.count = one, .step = {zero, zero}, .depth = zero, .most = 1.0f, .any_deep = false};
    if (!any(minified)) return probes;
    const Batch longer = sqrt(select(minified, max(x2, y2), one)), shorter = sqrt(max(min(x2, y2), one));
    probes.count = select(minified, min(floor(longer / shorter + Batch(0.5f)), Batch(max_probes)), one);
    probes.step = {select(along_x, x.x, y.x), select(along_x, x.y, y.y)};
    const Batch deepest(static_cast<float>(image.levels().size() - 1));
    probes.depth = select(minified, min(log2(max(longer / probes.count, shorter)), deepest), zero);
    probes.most = std::ranges::max(store(probes.count));
    probes.any_deep = any(probes.depth > zero);
    return probes;
}

void add(Interpolated& sum, const Batch& weight, const Interpolated& more) {
    for (std::size_t c = 0; c < sum.numbers.size(); ++c) sum.numbers[c] += weight * more.numbers[c];
    sum.coverage += weight * more.coverage;
}

}  // namespace

std::tuple<Vec3b, Batch> Image::lookup(const ImageLookup& how, const Vec2b& uv, const Vec2b& uv_x,
                                       const Vec2b& uv_y) const {
    const Interpolate interpolated = interpolation_of(type_, channels_);
    const auto lanes_at = [&](const Batch& numbers) {
        LevelLanes lanes;
        const auto which = indices(numbers);
        Lanes widths, heights;
        for (std::size_t lane = 0; lane < batch_size; ++lane) {
            const Level& level = levels_[static_cast<std::size_t>(which[lane])];
            lanes.widths[lane] = level.width;
            lanes.texels[lane] = &texels_[level.first_byte];
            widths[lane] = static_cast<float>(level.width);
            heights[lane] = static_cast<float>(level.height);
        }
        lanes.width = load(widths);
        lanes.height = load(heights);
        return lanes;
    };
    const auto at = [&](const LevelLanes& level, const Vec2b& place) {
        return interpolated(level, taps_at(place.x, level.width, how), taps_at(place.y, level.height, how));
    };

    const Probes probes = probes_over(uv_x - uv, uv_y - uv, *this, how.closed_u);
    if (probes.any_deep) make_levels();
    const Batch depth = floor(probes.depth), t = probes.depth - depth;
    const LevelLanes fine = lanes_at(depth);
    Interpolated found;
    if (probes.most == 1.0f && !probes.any_deep) {
        found = at(fine, uv);
    } else {
        const LevelLanes coarse = lanes_at(min(depth + one, Batch(static_cast<float>(levels_.size() - 1))));
        for (float i = 0.0f; i < probes.most; ++i) {
            const BatchMask counts = Batch(i) < probes.count;
            const Batch share = (Batch(i) + Batch(0.5f)) / probes.count - Batch(0.5f);
            const Vec2b place(uv.x + select(probes.count > one, share * probes.step.x, zero),
                              uv.y + select(probes.count > one, share * probes.step.y, zero));
            const Batch weight = select(counts, one / probes.count, zero);
            add(found, weight * (one - t), at(fine, place));
            if (probes.any_deep) add(found, weight * t, at(coarse, place));
        }
    }

    const auto& [a, b, c, d] = found.numbers;
    const Batch alpha = channels_ == 4 ? d : channels_ == 2 ? b : found.coverage;
    Vec3b color = channels_ < 3 ? Vec3b(a) : Vec3b(a, b, c);
    const Batch divisor = how.unassociate ? select(alpha != zero, alpha, one) : one;
    if (!is_srgb_) return {color / divisor, alpha};
    const auto linear = [](const Vec3b& srgb) {
        return Vec3b(linear_from_srgb(srgb.x), linear_from_srgb(srgb.y), linear_from_srgb(srgb.z));
    };
    const Vec3b sharp = linear(color / divisor);
    if (!how.unassociate || !probes.any_deep) return {sharp, alpha};
    // Cycles divides what is stored. The copies' colours are means of light that alpha is multiplied into.
    return {sharp + (linear(color) / divisor - sharp) * min(probes.depth, one), alpha};
}

}  // namespace pivot
