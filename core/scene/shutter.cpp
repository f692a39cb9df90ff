#include "core/scene/shutter.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace pivot {

Shutter::Shutter(std::span<const float> openness) {
    const auto is_valid = [](float open) { return open >= 0.0f && std::isfinite(open); };
    if (openness.size() < 2 || !std::ranges::all_of(openness, is_valid))
        throw std::invalid_argument("camera: its shutter's curve needs two values or more, none of them below 0");
    std::vector<float> passed{0.0f};
    for (std::size_t i = 1; i < openness.size(); ++i)
        passed.push_back(passed.back() + 0.5f * (openness[i - 1] + openness[i]));
    const float all = passed.back();
    if (!(all > 0.0f)) return;
    openness_.assign(openness.begin(), openness.end());
    for (const float before : passed) passed_share_.push_back(before / all);
}

float Shutter::time(float u) const {
    if (openness_.empty()) return u;
    const auto after = std::ranges::upper_bound(passed_share_, u);
    const auto last = static_cast<std::ptrdiff_t>(openness_.size()) - 2;
    const auto i = static_cast<std::size_t>(std::clamp(after - passed_share_.begin() - 1, std::ptrdiff_t{0}, last));
    // Between two values openness is linear, so that the share passed is a parabola: a + (b - a) x / 2 of x.
    const float share = passed_share_[i + 1] - passed_share_[i], a = openness_[i], b = openness_[i + 1];
    const float part = share > 0.0f ? std::clamp((u - passed_share_[i]) / share, 0.0f, 1.0f) : 0.0f;
    const float root = std::sqrt(std::max(a * a + part * (b * b - a * a), 0.0f));
    const float x = a + root > 0.0f ? part * (a + b) / (a + root) : part;
    return (static_cast<float>(i) + std::min(x, 1.0f)) / static_cast<float>(openness_.size() - 1);
}

}  // namespace pivot
