#include "core/media/tracking.h"

namespace pivot {
namespace {

/// Beyond this optical depth of a brick, by its majorant, cell by cell is little dearer, and has no noise.
constexpr float dense_depth = 4.0f;

/// How far Gauss and Legendre's two points are from the middle of a part, in its length.
constexpr float gauss_offset = 0.28867513f;

/// The integral of the density, exact within one cell.
float two_point_integral(const VoxelGrid& density, const GridRay& ray, float near_m, float far_m) {
    const float length_m = far_m - near_m, middle = near_m + 0.5f * length_m, offset = length_m * gauss_offset;
    return 0.5f * length_m * (density.density(ray.at(middle - offset)) + density.density(ray.at(middle + offset)));
}

/// Calls visit(near_m, far_m, integral of the density) with the part in each of the grid's cells, until it returns
/// false.
template <class Visit>
void for_each_voxel_cell(const VoxelGrid& density, const GridRay& ray, float near_m, float far_m, const Visit& visit) {
    walk_grid(ray.origin - density.low(), ray.direction, near_m, far_m, density.high() - density.low(),
              [&](float from_m, float to_m, const auto&) {
                  return visit(from_m, to_m, two_point_integral(density, ray, from_m, to_m));
              });
}

float integral_by_cells(const VoxelGrid& density, const GridRay& ray, float near_m, float far_m) {
    float sum = 0.0f;
    for_each_voxel_cell(density, ray, near_m, far_m, [&](float, float, float integral) {
        sum += integral;
        return true;
    });
    return sum;
}

/// Where in a part within one cell the integral of the density from near_m is `wanted`, of `whole`.
float invert_integral(const VoxelGrid& density, const GridRay& ray, float near_m, float far_m, float wanted,
                      float whole) {
    float low = near_m, high = far_m, x = near_m + (far_m - near_m) * (wanted / whole);
    for (int i = 0; i < 12; ++i) {  // Newton's method, or halving where it leads out
        const float error = two_point_integral(density, ray, near_m, x) - wanted;
        if (abs(error) <= 1e-6f * whole) break;
        (error > 0.0f ? high : low) = x;
        const float next = x - error / density.density(ray.at(x));
        x = next > low && next < high ? next : 0.5f * (low + high);
    }
    return x;
}

/// The transmittance of a thin brick: that of a linear density through two points of it in closed form, the rest by
/// ratios [Novak14].
Rgb residual_ratio(const VoxelGrid& density, const GridRay& ray, float near_m, float far_m, float majorant,
                   const Rgb& sigma_t, float sigma_most, RandomStream& stream) {
    const float length_m = far_m - near_m;
    const auto density_at = [&](float part) { return density.density(ray.at(near_m + length_m * part)); };
    constexpr float first = 0.5f - gauss_offset, second = 0.5f + gauss_offset;
    const float a = density_at(first), b = density_at(second), slope = (b - a) / (second - first);
    const float at_near = a - slope * first, at_far = at_near + slope;
    const float spread = max(majorant - min(at_near, at_far), max(at_near, at_far));  // of the rest, at most
    const float depth = sigma_most * spread * length_m;
    Rgb result = exp(-sigma_t * (0.5f * (a + b) * length_m));
    for (float at = stream.next_depth(); at < depth; at += stream.next_depth()) {
        const float part = at / depth, rest = density_at(part) - (at_near + slope * part);
        result *= Rgb(1.0f) - sigma_t * (rest / (sigma_most * spread));
    }
    return result;
}

/// Whether to go on. What hardly counts is kept with a probability, for as much more.
bool survives(Rgb& transmitted, RandomStream& stream) {
    constexpr float least = 1e-4f;
    const float most = max_component(transmitted);
    if (most >= least) return true;
    const bool is_kept = stream.next() * least < most;
    transmitted = is_kept ? transmitted * (least / most) : Rgb(0.0f);
    return is_kept;
}

float sum(const Rgb& c) { return c.x + c.y + c.z; }

/// A collision in a thin brick, real or null by the mean of the channels that the path carries [Kutz17].
std::optional<float> delta_tracking(const VoxelGrid& density, const GridRay& ray, float near_m, float far_m,
                                    float majorant, const Rgb& sigma_t, float sigma_most, Rgb& throughput,
                                    RandomStream& stream) {
    const float depth = sigma_most * majorant * (far_m - near_m);
    for (float at = stream.next_depth(); at < depth; at += stream.next_depth()) {
        const float distance_m = near_m + (far_m - near_m) * (at / depth);
        const float real = min(density.density(ray.at(distance_m)) / majorant, 1.0f);
        const Rgb share = sigma_t * (real / sigma_most);
        const float probability = dot(throughput, share) / sum(throughput);
        if (stream.next() < probability) {
            throughput *= share / probability;
            return distance_m;
        }
        throughput *= (Rgb(1.0f) - share) / (1.0f - probability);
    }
    return std::nullopt;
}

/// A collision in a dense brick, where a channel's transmittance falls to a random number. The channel is chosen by
/// what the path carries, and all are weighted as if any had been.
std::optional<float> closed_form_tracking(const VoxelGrid& density, const GridRay& ray, float near_m, float far_m,
                                          const Rgb& sigma_t, Rgb& throughput, RandomStream& stream) {
    const float choice = stream.next() * sum(throughput);
    const int channel = choice < throughput.x ? 0 : choice < throughput.x + throughput.y ? 1 : 2;
    const float wanted = stream.next_depth() / sigma_t[channel];  // infinite of a channel that nothing stops
    float passed = 0.0f;
    std::optional<float> distance_m;
    for_each_voxel_cell(density, ray, near_m, far_m, [&](float from_m, float to_m, float integral) {
        if (passed + integral > wanted) {
            distance_m = invert_integral(density, ray, from_m, to_m, wanted - passed, integral);
            passed = wanted;
            return false;
        }
        passed += integral;
        return true;
    });
    const Rgb weight = exp(-sigma_t * passed) * (distance_m ? sigma_t : Rgb(1.0f));
    throughput *= weight * (sum(throughput) / dot(throughput, weight));
    return distance_m;
}

}  // namespace

float density_integral(const VoxelGrid& density, const GridRay& ray) {
    float sum = 0.0f;
    density.for_each_cell(ray.origin, ray.direction, ray.near_m, ray.far_m, [&](float near_m, float far_m, float) {
        sum += integral_by_cells(density, ray, near_m, far_m);
        return true;
    });
    return sum;
}

Rgb transmittance(const VoxelGrid& density, const GridRay& ray, const Rgb& sigma_t, RandomStream& stream) {
    const float sigma_most = max_component(sigma_t);
    Rgb result(1.0f);
    if (!(sigma_most > 0.0f)) return result;
    density.for_each_cell(
        ray.origin, ray.direction, ray.near_m, ray.far_m, [&](float near_m, float far_m, float majorant) {
            result *= sigma_most * majorant * (far_m - near_m) > dense_depth
                          ? exp(-sigma_t * integral_by_cells(density, ray, near_m, far_m))
                          : residual_ratio(density, ray, near_m, far_m, majorant, sigma_t, sigma_most, stream);
            return survives(result, stream);
        });
    return max(result, Rgb(0.0f));
}

Collision sample_collision(const VoxelGrid& density, const GridRay& ray, const Rgb& sigma_t, const Rgb& throughput,
                           RandomStream& stream) {
    const float sigma_most = max_component(sigma_t);
    Collision result{std::nullopt, throughput};
    if (!(sigma_most > 0.0f && sum(throughput) > 0.0f)) return result;
    density.for_each_cell(
        ray.origin, ray.direction, ray.near_m, ray.far_m, [&](float near_m, float far_m, float majorant) {
            result.distance_m =
                sigma_most * majorant * (far_m - near_m) > dense_depth
                    ? closed_form_tracking(density, ray, near_m, far_m, sigma_t, result.throughput, stream)
                    : delta_tracking(density, ray, near_m, far_m, majorant, sigma_t, sigma_most, result.throughput,
                                     stream);
            return !result.distance_m;
        });
    return result;
}

}  // namespace pivot
