// One step of a shader's program: a function of batches of numbers that is known by its name. A table of kinds is made
// of plain functions:
//
//     double_of(Batch x)                                 -> op<double_of>("double"): one number in, one out
//     shifted(const Place& place, const Vec3b& by)       -> three numbers in, three out; reads where it is
//     noise(Settings<2> settings, const Vec3b& at)       -> with two numbers that are the same wherever it runs
//     texel(const Image& image, const Vec2b& uv)         -> looks an image up
#pragma once

#include <memory>
#include <span>
#include <string_view>
#include <tuple>
#include <vector>

#include "core/shaders/place.h"
#include "core/shaders/point.h"

namespace pivot {

struct Image;

/// What an op is told once, when its program is made.
struct OpSettings {
    std::vector<float> numbers;
    std::shared_ptr<const Image> image;
};

/// So many numbers of an op's settings; or as many and more.
template <std::size_t n>
using Settings = std::span<const float, n>;
template <std::size_t n>
struct SettingsFrom : std::span<const float> {};

struct OpKind {
    std::string_view name;
    std::uint32_t input_count, output_count;  ///< numbers: a vector is three
    std::uint32_t setting_count;
    bool takes_more_settings;
    bool reads_place;  ///< else it depends on its inputs alone
    bool reads_image;
    void (*run)(const Batch* inputs, const OpSettings& settings, const Place& place, Batch* outputs);
};

namespace detail {

/// How many registers a parameter or a result takes.
template <class T>
inline constexpr std::uint32_t width_of = 0;
template <>
inline constexpr std::uint32_t width_of<Batch> = 1;
template <>
inline constexpr std::uint32_t width_of<Vec2b> = 2;
template <>
inline constexpr std::uint32_t width_of<Vec3b> = 3;
template <std::size_t n>
inline constexpr std::uint32_t width_of<Point<n>> = n;
template <class... Parts>
inline constexpr std::uint32_t width_of<std::tuple<Parts...>> = (width_of<Parts> + ... + 0);

template <class T>
inline constexpr std::uint32_t settings_of = 0;
template <std::size_t n>
inline constexpr std::uint32_t settings_of<Settings<n>> = n;
template <std::size_t n>
inline constexpr std::uint32_t settings_of<SettingsFrom<n>> = n;
template <class T>
inline constexpr bool is_open_ended = false;
template <std::size_t n>
inline constexpr bool is_open_ended<SettingsFrom<n>> = true;

template <class T>
T read(const Batch* inputs, const OpSettings& settings, const Place& place) {
    using Bare = std::remove_cvref_t<T>;
    if constexpr (std::is_same_v<Bare, Batch>) return inputs[0];
    if constexpr (requires(Bare point) { point.x.fill(Batch()); })
        return make_point<width_of<Bare>>([&](std::size_t i) { return inputs[i]; });
    if constexpr (std::is_same_v<Bare, Vec2b>) return Vec2b(inputs[0], inputs[1]);
    if constexpr (std::is_same_v<Bare, Vec3b>) return Vec3b(inputs[0], inputs[1], inputs[2]);
    if constexpr (is_open_ended<Bare>)
        return Bare{settings.numbers};
    else if constexpr (settings_of<Bare> != 0)
        return Bare(settings.numbers.data(), settings_of<Bare>);
    if constexpr (std::is_same_v<Bare, Image>) return *settings.image;
    if constexpr (std::is_same_v<Bare, Place>) return place;
}

inline void write(const Batch& result, Batch* outputs) { outputs[0] = result; }
inline void write(const Vec2b& result, Batch* outputs) { outputs[0] = result.x, outputs[1] = result.y; }
inline void write(const Vec3b& result, Batch* outputs) {
    outputs[0] = result.x, outputs[1] = result.y, outputs[2] = result.z;
}
template <class... Parts>
void write(const std::tuple<Parts...>& result, Batch* outputs) {
    std::apply([&](const Parts&... parts) { ((write(parts, outputs), outputs += width_of<Parts>), ...); }, result);
}

template <class T>
using Read = std::conditional_t<width_of<std::remove_cvref_t<T>> != 0, std::remove_cvref_t<T>, T>;

template <auto function, class Result, class... Parameters>
constexpr OpKind make_op(std::string_view name) {
    static_assert(((width_of<std::remove_cvref_t<Parameters>> != 0 || settings_of<Parameters> != 0 ||
                    std::is_same_v<Parameters, const Image&> || std::is_same_v<Parameters, const Place&>)&&...));
    return {name,
            (width_of<std::remove_cvref_t<Parameters>> + ... + 0),
            width_of<Result>,
            (settings_of<Parameters> + ... + 0),
            (is_open_ended<Parameters> || ...),
            (std::is_same_v<Parameters, const Place&> || ...),
            (std::is_same_v<Parameters, const Image&> || ...),
            [](const Batch* inputs, const OpSettings& settings, const Place& place, Batch* outputs) {
                // Braces keep the order of the parameters.
                std::tuple<Read<Parameters>...> arguments{read<Read<Parameters>>(
                    std::exchange(inputs, inputs + width_of<std::remove_cvref_t<Parameters>>), settings, place)...};
                write(std::apply(function, arguments), outputs);
            }};
}

template <auto function, class Result, class... Parameters>
constexpr OpKind op_of(std::string_view name, Result (*)(Parameters...)) {
    return make_op<function, Result, Parameters...>(name);
}

}  // namespace detail

/// The kind whose steps call a function, or a lambda that captures nothing.
template <auto function>
constexpr OpKind op(std::string_view name) {
    return detail::op_of<function>(name, +function);
}

/// Every kind there is; a name finds one, or null.
const OpKind* find_op(std::string_view name);
std::vector<const OpKind*> all_ops();

}  // namespace pivot
