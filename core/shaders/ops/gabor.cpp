// Gabor noise: waves of one frequency under bells at random places, eight a cell, as they add up. Its value is their
// sine, its phase and intensity are those of the sum as a complex number.
//
// [Lagae09] "Procedural Noise using Sparse Gabor Convolution", SIGGRAPH 2009: (6), (8). [Tavernier19] "Making Gabor
// Noise Fast and Normalized", Eurographics 2019: so many a cell, of either sign. [Tricard19] "Procedural Phasor Noise",
// SIGGRAPH 2019: (8), (9). Hashes and scales are those of Cycles 4.5 svm/gabor.h.
#include "core/shaders/ops/hash.h"
#include "core/shaders/ops/spaces.h"
#include "core/shaders/ops/tables.h"

namespace pivot {
namespace {

constexpr int waves_of_cell = 8;

/// Of a wave, or of a sum of them.
struct Phasor {
    Batch real, imaginary;
};

Batch bounded(const Batch& cosine) { return min(max(cosine, Batch(-1.0f)), Batch(1.0f)); }

/// Waves that run one way, or are turned from it by up to a quarter turn to either side.
struct Plane {
    Batch angle, isotropy;

    Point<2> direction(const Point<3>& seed) const {
        const Batch turned = angle + (random_number(seed) - Batch(0.5f)) * pi<Batch> * isotropy;
        return {{cos(turned), sin(turned)}};
    }
};

/// Waves that run one way, or are turned from it in both of its spherical angles.
struct Space {
    Vec3b along;
    Batch isotropy;

    Point<3> direction(const Point<4>& seed) const {
        const Batch flat = sqrt(along.x * along.x + along.y * along.y);
        const Batch around = acos(bounded(divided(along.x, flat)));
        const Batch turn = pi<Batch> * isotropy;
        const Batch theta = acos(bounded(along.z)) + random_number(seed) * turn;
        const Batch phi =
            select(along.y < Batch(0.0f), -around, around) + random_number_of_order(seed, {2, 0, 3, 1}) * turn;
        const BatchMask is_turned = isotropy > Batch(0.0f);
        return {{select(is_turned, sin(theta) * cos(phi), along.x), select(is_turned, sin(theta) * sin(phi), along.y),
                 select(is_turned, cos(theta), along.z)}};
    }
};

template <std::size_t n>
Point<n + 1> seed_of(const Point<n>& cell, int number) {
    return make_point<n + 1>(
        [&](std::size_t i) { return i < n ? cell.x[std::min(i, n - 1)] : Batch(static_cast<float>(number)); });
}

/// Where a wave has its bell, in the unit cube.
Point<2> bell_place(const Point<3>& seed) {
    return {{random_number(seed), random_number(Point<3>{{seed.x[2], seed.x[0], seed.x[1]}})}};
}
Point<3> bell_place(const Point<4>& seed) {
    const Vec3b color = random_color(seed);
    return {{color.x, color.y, color.z}};
}

/// The waves of one cell. at: from its lowest corner.
template <std::size_t n, class Directions>
void add_cell(const Point<n>& cell, const Point<n>& at, const Batch& frequency, const Directions& directions,
              Phasor& sum) {
    for (int wave = 0; wave < waves_of_cell; ++wave) {
        const Point<n> from_bell = at - bell_place(seed_of(cell, 3 * wave + 1));
        const Batch distance2 = dot(from_bell, from_bell);
        const BatchMask is_near = distance2 < Batch(1.0f);
        if (!any(is_near)) continue;
        const Batch sign = select(random_number(seed_of(cell, 3 * wave + 2)) < Batch(0.5f), Batch(-1.0f), Batch(1.0f));
        // Hann's window takes the bell to 0 where it ends.
        const Batch window = Batch(0.5f) + Batch(0.5f) * cos(pi<Batch> * distance2);
        const Batch height = select(is_near, sign * window * exp(-pi<Batch> * distance2), Batch(0.0f));
        const Batch turns = frequency * dot(from_bell, directions.direction(seed_of(cell, 3 * wave)));
        sum.real += height * cos(Batch(2.0f) * pi<Batch> * turns);
        sum.imaginary += height * sin(Batch(2.0f) * pi<Batch> * turns);
    }
}

/// Value, phase and intensity. variance: of one wave's contribution.
template <std::size_t n, class Directions>
Vec3b gabor(const Point<n>& at, const Batch& frequency, const Directions& directions, float variance) {
    const Point<n> cell = floor(at);
    const Point<n> local = at - cell;
    Phasor sum{Batch(0.0f), Batch(0.0f)};
    constexpr int cells = n == 2 ? 9 : 27;
    for (int number = 0; number < cells; ++number) {
        const std::array<int, 3> steps{number % 3 - 1, number / 3 % 3 - 1, number / 9 - 1};
        const Point<n> offset = make_point<n>([&](std::size_t i) { return Batch(static_cast<float>(steps[i])); });
        add_cell(cell + offset, local - offset, max(frequency, Batch(1e-3f)), directions, sum);
    }
    const Batch scale(1.0f / (6.0f * std::sqrt(waves_of_cell * variance)));
    const Batch phase = atan2(sum.imaginary, sum.real);
    return {sum.imaginary * scale * Batch(0.5f) + Batch(0.5f), phase * Batch(0.5f / pi<float>) + Batch(0.5f),
            sqrt(sum.real * sum.real + sum.imaginary * sum.imaginary) * scale};
}

// Halves of what [Lagae09 (9)] gives at high frequencies, as signs are even.
constexpr float variance_of_plane = 0.125f, variance_of_space = 0.08838835f;

Vec3b gabor_2d(const Point<2>& at, Batch frequency, Batch isotropy, Batch angle) {
    return gabor(at, frequency, Plane{angle, isotropy}, variance_of_plane);
}

Vec3b gabor_3d(const Point<3>& at, Batch frequency, Batch isotropy, const Vec3b& along) {
    return gabor(at, frequency, Space{unit(along), isotropy}, variance_of_space);
}

constexpr std::array ops{op<gabor_2d>("gabor_2d"), op<gabor_3d>("gabor_3d")};

}  // namespace

std::span<const OpKind> gabor_ops() { return ops; }

}  // namespace pivot
