// Perlin's noise, and the fractals of its octaves that Blender's Noise and Musgrave textures are.
// [Musgrave03] F. Kenton Musgrave in "Texturing and Modeling: A Procedural Approach", 3rd edition, chapter 16, in the
// form of Cycles 4.5 kernel/svm/fractal_noise.h. Octaves need not be whole: of the last a part counts.
#include "core/shaders/ops/perlin.h"
#include "core/shaders/ops/tables.h"

namespace pivot {
namespace {

/// settings: whether the noise wraps.
template <std::size_t n>
[[gnu::noinline]] Batch noise(Settings<1> settings, const Point<n>& at) {
    return perlin(at, settings[0] != 0.0f);
}

/// How much of an octave counts.
Batch share(const Batch& octaves, int octave) { return clamp01(octaves - Batch(static_cast<float>(octave))); }

bool has_octave(const Batch& octaves, int octave) { return any(octaves > Batch(static_cast<float>(octave))); }

template <std::size_t n>
Batch fbm(Settings<1> settings, const Point<n>& at, Batch octaves, Batch roughness, Batch lacunarity) {
    Batch sum(0.0f), amplitude(1.0f), frequency(1.0f);
    for (int i = 0; has_octave(octaves, i); ++i) {
        sum += share(octaves, i) * amplitude * noise(settings, at * frequency);
        amplitude *= roughness;
        frequency *= lacunarity;
    }
    return sum;
}

/// Within 0..1: the mean of its octaves.
template <std::size_t n>
Batch fbm_normalized(Settings<1> settings, const Point<n>& at, Batch octaves, Batch roughness, Batch lacunarity) {
    Batch sum(0.0f), amplitudes(0.0f), amplitude(1.0f), frequency(1.0f), result(0.0f);
    for (int i = 0; has_octave(octaves, i); ++i) {
        sum += amplitude * noise(settings, at * frequency);
        amplitudes += amplitude;
        amplitude *= roughness;
        frequency *= lacunarity;
        result = lerp(result, Batch(0.5f) * sum / amplitudes + Batch(0.5f), share(octaves, i));
    }
    return result;
}

template <std::size_t n>
Batch multifractal(Settings<1> settings, Point<n> at, Batch octaves, Batch roughness, Batch lacunarity) {
    Batch value(1.0f), amplitude(1.0f);
    for (int i = 0; has_octave(octaves, i); ++i) {
        value *= share(octaves, i) * amplitude * noise(settings, at) + Batch(1.0f);
        amplitude *= roughness;
        at = at * lacunarity;
    }
    return value;
}

template <std::size_t n>
Batch hetero_terrain(Settings<1> settings, Point<n> at, Batch octaves, Batch roughness, Batch lacunarity,
                     Batch offset) {
    Batch value = noise(settings, at) + offset, amplitude = roughness;
    for (int i = 1; has_octave(octaves, i); ++i) {
        at = at * lacunarity;
        value += share(octaves, i) * (noise(settings, at) + offset) * amplitude * value;
        amplitude *= roughness;
    }
    return value;
}

template <std::size_t n>
Batch hybrid_multifractal(Settings<1> settings, Point<n> at, Batch octaves, Batch roughness, Batch lacunarity,
                          Batch offset, Batch gain) {
    const Batch least_weight(0.001f);
    Batch value(0.0f), amplitude(1.0f), weight(1.0f);
    for (int i = 0; has_octave(select(weight > least_weight, octaves, Batch(0.0f)), i); ++i) {
        const BatchMask counts = weight > least_weight;
        const Batch signal = min(weight, Batch(1.0f)) * (noise(settings, at) + offset) * amplitude;
        value += select(counts, share(octaves, i) * signal, Batch(0.0f));
        weight = select(counts, gain * signal, Batch(0.0f));
        amplitude *= roughness;
        at = at * lacunarity;
    }
    return value;
}

/// A part of an octave counts as none.
template <std::size_t n>
Batch ridged_multifractal(Settings<1> settings, Point<n> at, Batch octaves, Batch roughness, Batch lacunarity,
                          Batch offset, Batch gain) {
    const auto ridge = [&] { return sqr(offset - abs(noise(settings, at))); };
    Batch signal = ridge(), value = signal, amplitude = roughness;
    for (int i = 1; has_octave(octaves, i); ++i) {
        at = at * lacunarity;
        signal = ridge() * clamp01(signal * gain);
        value += select(share(octaves, i) >= Batch(1.0f), signal * amplitude, Batch(0.0f));
        amplitude *= roughness;
    }
    return value;
}

constexpr std::array ops{
    op<noise<1>>("noise_1d"),
    op<noise<2>>("noise_2d"),
    op<noise<3>>("noise_3d"),
    op<noise<4>>("noise_4d"),
    op<fbm<1>>("noise_fbm_1d"),
    op<fbm<2>>("noise_fbm_2d"),
    op<fbm<3>>("noise_fbm_3d"),
    op<fbm<4>>("noise_fbm_4d"),
    op<fbm_normalized<1>>("noise_fbm_normalized_1d"),
    op<fbm_normalized<2>>("noise_fbm_normalized_2d"),
    op<fbm_normalized<3>>("noise_fbm_normalized_3d"),
    op<fbm_normalized<4>>("noise_fbm_normalized_4d"),
    op<multifractal<1>>("noise_multifractal_1d"),
    op<multifractal<2>>("noise_multifractal_2d"),
    op<multifractal<3>>("noise_multifractal_3d"),
    op<multifractal<4>>("noise_multifractal_4d"),
    op<hetero_terrain<1>>("noise_hetero_terrain_1d"),
    op<hetero_terrain<2>>("noise_hetero_terrain_2d"),
    op<hetero_terrain<3>>("noise_hetero_terrain_3d"),
    op<hetero_terrain<4>>("noise_hetero_terrain_4d"),
    op<hybrid_multifractal<1>>("noise_hybrid_multifractal_1d"),
    op<hybrid_multifractal<2>>("noise_hybrid_multifractal_2d"),
    op<hybrid_multifractal<3>>("noise_hybrid_multifractal_3d"),
    op<hybrid_multifractal<4>>("noise_hybrid_multifractal_4d"),
    op<ridged_multifractal<1>>("noise_ridged_multifractal_1d"),
    op<ridged_multifractal<2>>("noise_ridged_multifractal_2d"),
    op<ridged_multifractal<3>>("noise_ridged_multifractal_3d"),
    op<ridged_multifractal<4>>("noise_ridged_multifractal_4d"),
};

}  // namespace

std::span<const OpKind> noise_ops() { return ops; }

}  // namespace pivot
