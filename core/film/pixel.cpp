#include "core/film/pixel.h"

#include "core/simd/batch.h"

namespace pivot {
namespace {

/// Sums of structs of floats, number by number.
template <class Numbers>
void add_weighted(std::span<const Numbers> samples, std::span<const float> weights, float scale, Numbers& sum) {
    constexpr std::size_t numbers = sizeof(Numbers) / sizeof(float);
    constexpr std::size_t together = numbers / batch_size * batch_size;
    for (std::size_t first = 0; first < together; first += batch_size) {
        Batch added(0.0f);
        for (std::size_t i = 0; i < samples.size(); ++i)
            added += Batch(weights[i]) * Batch::load_unaligned(reinterpret_cast<const float*>(&samples[i]) + first);
        float* const to = reinterpret_cast<float*>(&sum) + first;
        (Batch::load_unaligned(to) + Batch(scale) * added).store_unaligned(to);
    }
    for (std::size_t at = together; at < numbers; ++at) {
        float added = 0.0f;
        for (std::size_t i = 0; i < samples.size(); ++i)
            added += weights[i] * reinterpret_cast<const float*>(&samples[i])[at];
        reinterpret_cast<float*>(&sum)[at] += scale * added;
    }
}

}  // namespace

void WeightedSum::add(std::span<const Sample> samples, std::span<const float> weights,
                      std::optional<float> radiance_variance, float scale) {
    add_weighted(samples, weights, scale, sum);
    float added = 0.0f, squared = 0.0f;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        added += weights[i];
        squared += weights[i] * weights[i];
    }
    weight += scale * added;
    squared_weight += sqr(scale) * squared;
    if (!radiance_variance) return;
    told_weight += sqr(scale) * squared;
    variance += sqr(scale) * squared * *radiance_variance;
}

void WeightedSum::add(const WeightedSum& other, float scale) {
    constexpr float once = 1.0f;
    add_weighted<Sample>({&other.sum, 1}, {&once, 1}, scale, sum);
    weight += scale * other.weight;
    squared_weight += sqr(scale) * other.squared_weight;
    told_weight += sqr(scale) * other.told_weight;
    variance += sqr(scale) * other.variance;
}

void SurfacePixel::add(std::span<const SurfacePasses> samples, std::span<const float> weights, float scale) {
    add_weighted(samples, weights, scale, sum);
}

void SurfacePixel::add(const SurfacePixel& other, float scale) {
    constexpr float once = 1.0f;
    add_weighted<SurfacePasses>({&other.sum, 1}, {&once, 1}, scale, sum);
}

void add_named(std::span<const Rgb> samples, std::span<const float> weights, float scale, std::span<Rgb> sums) {
    for (std::size_t i = 0; i * sums.size() < samples.size(); ++i)
        for (std::size_t k = 0; k < sums.size(); ++k) sums[k] += scale * weights[i] * samples[i * sums.size() + k];
}

void OwnSum::add(std::span<const Sample> samples, float scale) {
    for (const Sample& sample : samples) {
        radiance += scale * sample.radiance;
        indirect += scale * sample.indirect;
        albedo += scale * sample.denoising_albedo;
        normal += scale * sample.denoising_normal;
        weight += scale;
    }
    const std::size_t half = samples.size() / 2;
    if (half < 1) return;
    // By their two halves. Evenly spread samples of direct light leave less than halves of them tell: 0.36 to 0.6 of
    // it, as measured, where light that bounced has all of it.
    constexpr float even = 0.5f;
    Rgb direct_apart(0.0f), indirect_apart(0.0f);
    for (std::size_t i = 0; i < 2 * half; ++i) {
        const float sign = i < half ? 1.0f : -1.0f;
        direct_apart += sign * (samples[i].radiance - samples[i].indirect);
        indirect_apart += sign * samples[i].indirect;
    }
    const auto variance = [&](const Rgb& apart) {
        return mean_component(apart * apart) / static_cast<float>(2 * half);
    };
    const float told = sqr(scale) * static_cast<float>(samples.size());
    told_weight += told;
    direct_variance += even * told * variance(direct_apart);
    indirect_variance += told * variance(indirect_apart);
}

void OwnSum::add(const OwnSum& other, float scale) {
    radiance += scale * other.radiance;
    indirect += scale * other.indirect;
    albedo += scale * other.albedo;
    normal += scale * other.normal;
    weight += scale * other.weight;
    told_weight += sqr(scale) * other.told_weight;
    direct_variance += sqr(scale) * other.direct_variance;
    indirect_variance += sqr(scale) * other.indirect_variance;
}

}  // namespace pivot
