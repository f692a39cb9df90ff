#include "core/film/sample_counts.h"

#include <algorithm>
#include <cmath>

namespace pivot {

std::uint32_t pilot_samples(std::uint32_t max_samples) {
    constexpr std::uint32_t least = 16;
    return std::min(max_samples, std::max(least, max_samples / 4 / pilot_block * pilot_block));
}

std::vector<std::uint32_t> sample_counts(std::span<const Pilot> pilots, int width, float relative_error,
                                         std::uint32_t max_samples) {
    const int height = static_cast<int>(pilots.size()) / width;
    const std::uint32_t least = pilot_samples(max_samples);
    std::vector<std::uint32_t> counts(pilots.size(), max_samples);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            float variance = 0.0f, mean = 0.0f, neighbours = 0.0f;
            for (int v = std::max(y - 1, 0); v <= std::min(y + 1, height - 1); ++v) {
                for (int u = std::max(x - 1, 0); u <= std::min(x + 1, width - 1); ++u) {
                    const Pilot& pilot = pilots[static_cast<std::size_t>(v * width + u)];
                    if ((u == x && v == y) || pilot.blocks < 2) continue;
                    const auto n = static_cast<float>(pilot.blocks);
                    variance += std::max(pilot.sum_of_squares - pilot.sum * pilot.sum / n, 0.0f) / (n - 1.0f);
                    mean += pilot.sum / n;
                    neighbours += 1.0f;
                }
            }
            if (neighbours == 0.0f) continue;
            variance *= static_cast<float>(pilot_block) / neighbours;  // of one sample
            const float scale = relative_error * std::max(mean / neighbours, 0.1f);
            const float wanted = std::ceil(variance / (scale * scale));
            if (wanted < static_cast<float>(max_samples)) {
                counts[static_cast<std::size_t>(y * width + x)] = std::max(static_cast<std::uint32_t>(wanted), least);
            }
        }
    }
    return counts;
}

}  // namespace pivot
