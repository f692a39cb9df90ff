#include "core/distributions/ndf_projected_area.h"

#include <tbb/parallel_for.h>

#include <cmath>

namespace pivot {
namespace {

/// Pixels, and integrals of D h dw over them.
struct Block {
    std::size_t first_pixel, end_pixel;
    Vec3f h{0.0f};
    Vec3f low{1.0f}, high{-1.0f};  ///< bounds of its normals

    /// The least and the most of w.h.
    float least(const Vec3f& w) const {
        float sum = 0.0f;
        for (int i = 0; i < 3; ++i) sum += w[i] * (w[i] > 0.0f ? low[i] : high[i]);
        return sum;
    }
    float most(const Vec3f& w) const { return -least(-w); }
};

/// All pixels of an image that are not black, in blocks of neighbours: most of these a direction sees in full, or not
/// at all.
struct Blocks {
    std::vector<Vec3f> pixels;  ///< D h dw
    std::vector<Block> blocks;

    explicit Blocks(const NdfImage& image) {
        const std::size_t size = image.size(), side = std::max<std::size_t>(8, size / 64);
        const std::size_t across = (size + side - 1) / side;
        std::vector<Blocks> rows(across, Blocks());
        tbb::parallel_for(std::size_t(0), across, [&](std::size_t y) {
            for (std::size_t x = 0; x < across; ++x) rows[y].add(image, x * side, y * side, side);
        });
        for (const Blocks& row : rows) {
            const std::size_t first = pixels.size();
            pixels.insert(pixels.end(), row.pixels.begin(), row.pixels.end());
            for (Block block : row.blocks) {
                block.first_pixel += first, block.end_pixel += first;
                blocks.push_back(block);
            }
        }
    }

    float projected_area(const Vec3f& w) const {
        double sum = 0.0;
        for (const Block& block : blocks) {
            if (block.most(w) <= 0.0f) continue;
            if (block.least(w) >= 0.0f) {
                sum += static_cast<double>(dot(w, block.h));
                continue;
            }
            float part = 0.0f;
            for (std::size_t i = block.first_pixel; i < block.end_pixel; ++i) part += std::max(dot(w, pixels[i]), 0.0f);
            sum += static_cast<double>(part);
        }
        return static_cast<float>(sum);
    }

   private:
    Blocks() = default;

    void add(const NdfImage& image, std::size_t x, std::size_t y, std::size_t side) {
        const std::size_t size = image.size();
        Block block{.first_pixel = pixels.size(), .end_pixel = 0};
        Vec3<double> sum(0.0);
        for (std::size_t row = y; row < std::min(y + side, size); ++row)
            for (std::size_t column = x; column < std::min(x + side, size); ++column) {
                const float density = image.pixels()[row * size + column];
                if (!(density > 0.0f)) continue;
                const NdfPixel pixel = NdfPixel::at(size, column, row);
                const Vec3<double> h = static_cast<double>(density) * moments(pixel).h;
                sum += h;
                pixels.push_back(Vec3f(h));
                const auto reach = [](double low, double high) {
                    return Vec2<double>(low < 0.0 && high > 0.0 ? 0.0 : std::min(std::abs(low), std::abs(high)),
                                        std::max(std::abs(low), std::abs(high)));
                };
                const Vec2<double> in_x = reach(pixel.x0, pixel.x1), in_y = reach(pixel.y0, pixel.y1);
                const auto z = [](double a, double b) { return safe_sqrt(1.0 - a * a - b * b); };
                block.low = min(block.low, Vec3f(Vec3<double>(pixel.x0, pixel.y0, z(in_x.y, in_y.y))));
                block.high = max(block.high, Vec3f(Vec3<double>(pixel.x1, pixel.y1, z(in_x.x, in_y.x))));
            }
        block.h = Vec3f(sum);
        block.end_pixel = pixels.size();
        if (block.end_pixel > block.first_pixel) blocks.push_back(block);
    }
};

float azimuth_of(std::size_t i) {
    return 2.0f * pi<float> * static_cast<float>(i) / static_cast<float>(NdfProjectedArea::azimuths);
}

}  // namespace

float NdfProjectedArea::scale_of(const Vec3f& w) const { return w.z + alpha_ * std::sqrt(w.x * w.x + w.y * w.y); }

NdfProjectedArea::NdfProjectedArea(const NdfImage& image) {
    const Blocks blocks(image);
    float at_horizon = 0.0f;
    for (std::size_t i = 0; i < azimuths; ++i)
        at_horizon += blocks.projected_area(direction_at(0.0f, azimuth_of(i), 1.0f)) / static_cast<float>(azimuths);
    alpha_ = std::clamp(2.0f * at_horizon, 1e-3f, 1.0f);
    tbb::parallel_for(std::size_t(0), elevations, [&](std::size_t row) {
        const float place = static_cast<float>(row) / static_cast<float>(elevations - 1);
        for (std::size_t i = 0; i < azimuths; ++i) {
            const Vec3f w = direction_at(place, azimuth_of(i), alpha_);
            table_[row * azimuths + i] = blocks.projected_area(w) / scale_of(w);
        }
    });
}

float NdfProjectedArea::operator()(const Vec3f& w) const {
    const float row = elevation_coordinate(w, alpha_) * static_cast<float>(elevations - 1);
    const float turn = std::atan2(w.y, w.x) * (0.5f / pi<float>);
    const float column = (turn < 0.0f ? turn + 1.0f : turn) * static_cast<float>(azimuths);
    const auto first_row = std::min(static_cast<std::size_t>(std::max(row, 0.0f)), elevations - 2);
    const auto whole = static_cast<std::size_t>(column), first = whole % azimuths, second = (whole + 1) % azimuths;
    const float across = column - static_cast<float>(whole);
    const auto at = [&](std::size_t r) {
        return lerp(table_[r * azimuths + first], table_[r * azimuths + second], across);
    };
    return scale_of(w) * lerp(at(first_row), at(first_row + 1), row - static_cast<float>(first_row));
}

}  // namespace pivot
