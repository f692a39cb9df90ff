#include "core/lights/light_pieces.h"

#include <algorithm>
#include <cmath>

namespace pivot {
namespace {

/// As many deposits of equal weight tell how light is spread.
constexpr float least_deposits = 16.0f;

/// Of a coordinate in -1 to 1.
std::size_t quarter_of(float x) { return static_cast<std::size_t>(std::clamp(2.0f * (x + 1.0f), 0.0f, 3.0f)); }

/// The middle of a sixteenth along the first axis, or the second.
float middle(std::size_t piece, std::size_t axis) {
    const std::size_t high = piece >> (2 + axis) & 1, low = piece >> axis & 1;
    return 0.5f * static_cast<float>(2 * high + low) - 0.75f;
}

}  // namespace

LightPiece LightPieces::part_of(const LightPiece& piece, std::size_t k, int halvings) const {
    const float scale = std::ldexp(0.5f, -halvings);
    LightPiece part = piece;
    part.mean += scale * ((k & 1 ? along : -along) + (k & 2 ? across : -across));
    part.variance_m2 *= 0.25f;
    part.share *= 0.25f;
    return part;
}

void PieceSums::add(const Vec3f& offset, int flat_axis, const Vec3f& place, float weight) {
    if (flat_axis_ < 0) flat_axis_ = flat_axis, first_ = place;
    const std::size_t s = quarter_of(offset[(flat_axis_ + 1) % 3]), t = quarter_of(offset[(flat_axis_ + 2) % 3]);
    Sum& sum = sums_[(t >> 1) << 3 | (s >> 1) << 2 | (t & 1) << 1 | (s & 1)];
    sum.weight += weight;
    sum.place += weight * (place - first_);
    weight_ += weight;
    squares_ += weight * weight;
}

std::optional<LightPieces> PieceSums::pieces() const {
    if (weight_ * weight_ < least_deposits * squares_) return std::nullopt;
    LightPieces result{};
    Vec3f mean(0.0f);
    float s_mean = 0.0f, t_mean = 0.0f;
    for (std::size_t i = 0; i < sums_.size(); ++i) {
        mean += sums_[i].place / weight_;
        s_mean += sums_[i].weight / weight_ * middle(i, 0);
        t_mean += sums_[i].weight / weight_ * middle(i, 1);
    }
    // The plane through the pieces' means, by least squares.
    float ss = 0.0f, st = 0.0f, tt = 0.0f;
    Vec3f sx(0.0f), tx(0.0f);
    for (std::size_t i = 0; i < sums_.size(); ++i) {
        if (!(sums_[i].weight > 0.0f)) continue;
        const float w = sums_[i].weight / weight_, s = middle(i, 0) - s_mean, t = middle(i, 1) - t_mean;
        const Vec3f x = sums_[i].place / sums_[i].weight - mean;
        ss += w * s * s, st += w * s * t, tt += w * t * t;
        sx += w * s * x, tx += w * t * x;
    }
    constexpr float least = 1e-6f;
    ss += least, tt += least;
    const float scale = 0.25f / (ss * tt - st * st);
    const Vec3f along = scale * (tt * sx - st * tx), across = scale * (ss * tx - st * sx);
    result.along = along, result.across = across;
    const float variance = (length_squared(along) + length_squared(across)) / 6.0f;
    for (std::size_t k = 0; k < 4; ++k) {
        Sum whole;
        for (std::size_t i = 4 * k; i < 4 * k + 4; ++i) {
            const Sum& sum = sums_[i];
            whole.weight += sum.weight, whole.place += sum.place;
            if (sum.weight > 0.0f) result.sixteenths[i] = piece_of(sum, variance);
        }
        if (!(whole.weight > 0.0f)) continue;
        float spread = variance;
        for (std::size_t i = 4 * k; i < 4 * k + 4; ++i)
            if (sums_[i].weight > 0.0f)
                spread += 0.5f * sums_[i].weight / whole.weight *
                          length_squared(sums_[i].place / sums_[i].weight - whole.place / whole.weight);
        result.quarters[k] = piece_of(whole, spread);
    }
    return result;
}

LightPiece PieceSums::piece_of(const Sum& sum, float variance_m2) const {
    return {first_ + sum.place / sum.weight, variance_m2, sum.weight / weight_};
}

}  // namespace pivot
