#include "core/film/shadow_catcher.h"

#include <algorithm>

namespace pivot {
namespace {

/// Less of a pixel than this, which the tail of its filter gives, is not seen.
constexpr float least_share = 1.0f / 1024.0f;

/// a over b; where b is 0 the mean of the other parts, 0 without any.
Rgb divided_evenly(const Rgb& a, const Rgb& b) {
    Rgb ratio(0.0f);
    float sum = 0.0f, count = 0.0f;
    for (int c = 0; c < 3; ++c) {
        if (b[c] == 0.0f) continue;
        ratio[c] = a[c] / b[c];
        sum += ratio[c], count += 1.0f;
    }
    for (int c = 0; c < 3; ++c)
        if (b[c] == 0.0f && count > 0.0f) ratio[c] = sum / count;
    return ratio;
}

Rgb rgb_at(const std::vector<float>& values, std::size_t place) {
    return {values[place], values[place + 1], values[place + 2]};
}

}  // namespace

std::vector<float> shadow_catcher_factor(const Film& film, std::size_t first) {
    const std::vector<float> combined = film.read(find_pass("Combined")),
                             catcher = film.read_named(first + catcher_pass::alone),
                             among_all = film.read_named(first + catcher_pass::among_all),
                             shares = film.read_named(first + catcher_pass::shares);
    std::vector<float> factor(3 * film.grid().size(), 1.0f);
    for (std::size_t i = 0; i < film.grid().size(); ++i) {
        if (shares[3 * i + 1] < least_share) continue;
        const float alpha = std::clamp(combined[4 * i + 3], 0.0f, 1.0f);
        const Rgb share = divided_evenly(rgb_at(among_all, 3 * i), rgb_at(catcher, 3 * i));
        for (int c = 0; c < 3; ++c) factor[3 * i + static_cast<std::size_t>(c)] = 1.0f + alpha * (share[c] - 1.0f);
    }
    return factor;
}

std::vector<float> read_catcher_picture(const Film& film, std::size_t first, CatcherPicture kind) {
    const std::vector<float> factor = shadow_catcher_factor(film, first),
                             matte = film.read_named(first + catcher_pass::matte),
                             shares = film.read_named(first + catcher_pass::shares),
                             world = film.read_named(first + catcher_pass::world);
    std::vector<float> picture(4 * film.grid().size());
    for (std::size_t i = 0; i < film.grid().size(); ++i) {
        const float alpha = std::clamp(shares[3 * i], 0.0f, 1.0f);
        const float left = std::clamp(mean_component(rgb_at(factor, 3 * i)), 0.0f, 1.0f);
        const Rgb behind = kind == CatcherPicture::world ? left * rgb_at(world, 3 * i) : Rgb(0.0f);
        for (int c = 0; c < 3; ++c) {
            const auto place = static_cast<std::size_t>(c);
            picture[4 * i + place] = matte[3 * i + place] + behind[c];
        }
        picture[4 * i + 3] = kind == CatcherPicture::nothing ? alpha
                             : kind == CatcherPicture::world ? 1.0f
                                                             : alpha + (1.0f - alpha) * (1.0f - left);
    }
    return picture;
}

}  // namespace pivot
