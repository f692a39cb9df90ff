#include "core/integrators/media_ray.h"

#include "core/simd/pack.h"

namespace pivot {
namespace {

constexpr std::uint32_t typical_points = 8, emission_points = 4;

/// The mean along an emitting medium of sigma_t: of exp(-sigma x) over [0, length], times the length.
float emission_length_m(float sigma, float length_m) {
    const float depth = sigma * length_m;
    return depth > 1e-3f ? -std::expm1(-depth) / sigma : length_m * (1.0f - 0.5f * depth);
}

}  // namespace

Rgb transmittance_over(const Rgb& sigma_t, float length_m) {
    const auto left = [&](float sigma) { return sigma > 0.0f ? std::exp(-sigma * length_m) : 1.0f; };
    const float red = left(sigma_t.x);
    if (sigma_t.x == sigma_t.y && sigma_t.x == sigma_t.z) return Rgb(red);
    return {red, left(sigma_t.y), left(sigma_t.z)};
}

Vec3b transmittance_over(const Rgb& sigma_t, const Batch& length_m) {
    const auto left = [&](float sigma) { return sigma > 0.0f ? exp(Batch(-sigma) * length_m) : Batch(1.0f); };
    const Batch red = left(sigma_t.x);
    if (sigma_t.x == sigma_t.y && sigma_t.x == sigma_t.z) return Vec3b(red);
    return {red, left(sigma_t.y), left(sigma_t.z)};
}

void MediaRay::follow(const Ray& ray, RandomStream* stream) {
    ray_ = ray;
    stream_ = stream;
    media_.find_along(ray, along_);
    before_.assign(1, Rgb(1.0f));
    scatters_ = false;
    is_homogeneous_ = true;
    for (std::size_t i = 0; i < size(); ++i) {
        for (const std::uint32_t id : ids(i)) {
            const PlacedMedium& placed = media_.at(id);
            scatters_ = scatters_ || max_component(placed.sigma_s) > 0.0f;
            is_homogeneous_ = is_homogeneous_ && !placed.varies();
        }
    }
    for (std::size_t i = 0; i < size(); ++i)
        before_.push_back(before_.back() * transmittance(i, interval(i).near_m, interval(i).far_m));
}

Rgb MediaRay::emitted() const {
    Rgb sum(0.0f);
    for (std::size_t i = 0; i < size(); ++i) sum += before_[i] * emitted_in(i);
    return sum;
}

bool MediaRay::is_homogeneous(std::size_t i) const {
    return std::ranges::none_of(ids(i), [&](std::uint32_t id) { return media_.at(id).varies(); });
}

GridRay MediaRay::grid_ray(const PlacedMedium& placed, const VoxelGrid& grid, float near_m, float far_m) const {
    const Transform &to_object = placed.object_from_world, &to_grid = grid.grid_from_object();
    return {to_grid.point(to_object.point(ray_.origin)), to_grid.vector(to_object.vector(ray_.direction)), near_m,
            far_m};
}

void MediaRay::set_even_mix(std::size_t i, MediumMix& mix) const {
    clear(mix);
    for (const std::uint32_t id : ids(i)) {
        const Medium& medium = *media_.at(id).medium;
        if (!medium.density) add(mix, medium, 1.0f, Rgb(medium.emission_grid ? 0.0f : 1.0f));
    }
}

Rgb MediaRay::transmittance(std::size_t i, float near_m, float far_m) const {
    Rgb even(0.0f);
    for (const std::uint32_t id : ids(i))
        if (!media_.at(id).medium->density) even += media_.at(id).sigma_t;
    Rgb left = transmittance_over(even, far_m - near_m);
    if (is_homogeneous_) return left;
    for (const std::uint32_t id : ids(i)) {
        const PlacedMedium& placed = media_.at(id);
        const Medium& medium = *placed.medium;
        if (!medium.density) continue;
        const GridRay along = grid_ray(placed, *medium.density, near_m, far_m);
        left *= stream_ ? pivot::transmittance(*medium.density, along, placed.sigma_t, *stream_)
                        : transmittance_over(placed.sigma_t, density_integral(*medium.density, along));
    }
    return left;
}

const LinkSets& MediaRay::link_sets_at(float distance_m) const {
    std::size_t i = 0;
    while (i + 1 < size() && interval(i).far_m < distance_m) ++i;
    return link_sets_in(i);
}

std::uint32_t MediaRay::light_group_in(std::size_t i) const {
    const auto first = std::ranges::find_if(ids(i), [&](std::uint32_t id) { return emits(id); });
    return first == ids(i).end() ? no_light_group : media_.at(*first).light_group;
}

Rgb MediaRay::emitted_in(std::size_t i) const {
    const MediumInterval& part = interval(i);
    const float length_m = part.far_m - part.near_m;
    if (std::ranges::none_of(ids(i), [&](std::uint32_t id) { return emits(id); })) return Rgb(0.0f);
    Rgb sum(0.0f);
    if (is_homogeneous(i)) {
        set_even_mix(i, mix_);
        for (int c = 0; c < 3; ++c)
            if (mix_.emission[c] != 0.0f) sum[c] = mix_.emission[c] * emission_length_m(mix_.sigma_t[c], length_m);
        return sum;
    }
    Rgb left(1.0f);
    float reached_m = part.near_m;
    const std::uint32_t count = stream_ ? emission_points : 16 * emission_points;
    const float step_m = length_m / static_cast<float>(count);
    for (std::uint32_t k = 0; k < count; ++k) {
        const float at_m = part.near_m + (static_cast<float>(k) + (stream_ ? stream_->next() : 0.5f)) * step_m;
        left *= transmittance(i, reached_m, at_m);
        reached_m = at_m;
        set_mix_at(i, at_m, mix_);
        sum += left * mix_.emission * step_m;
    }
    return sum;
}

void MediaRay::set_typical_mix(std::size_t i, MediumMix& mix) const {
    // A grid may be empty at the few points that are asked, and dense between them.
    constexpr float least_of_most = 0.02f;
    const MediumInterval& part = interval(i);
    clear(mix);
    for (const std::uint32_t id : ids(i)) {
        const PlacedMedium& placed = media_.at(id);
        float density = 1.0f;
        if (const VoxelGrid* grid = placed.medium->density.get()) {
            density = 0.0f;
            for (std::uint32_t k = 0; k < typical_points; ++k) {
                const float share = (static_cast<float>(k) + 0.5f) / static_cast<float>(typical_points);
                density += value_at(grid, placed, position(lerp(part.near_m, part.far_m, share))).x;
            }
            density = std::max(density / static_cast<float>(typical_points), least_of_most * grid->most());
        }
        add(mix, *placed.medium, density, Rgb(0.0f));
    }
}

Batch MediaRay::relative_density(std::size_t i, const MediumMix& typical, const Batch& distance_m) const {
    Batch sum(0.0f);
    for (const std::uint32_t id : ids(i)) {
        const PlacedMedium& placed = media_.at(id);
        const float weight = mean_component(placed.sigma_s);
        Batch density(1.0f);
        if (const VoxelGrid* grid = placed.medium->density.get()) {
            const GridRay along = grid_ray(placed, *grid, 0.0f, 0.0f);
            density = grid->density(broadcast(along.origin) + distance_m * broadcast(along.direction));
        }
        sum += Batch(weight) * density;
    }
    return sum / Batch(typical.total_weight);
}

std::optional<MediaRay::Collided> MediaRay::collide(Rgb& throughput, RandomStream& stream, MediumMix& mix) const {
    const auto sum = [](const Rgb& c) { return c.x + c.y + c.z; };
    for (std::size_t i = 0; i < size(); ++i) {
        if (!(sum(throughput) > 0.0f)) return std::nullopt;
        const MediumInterval& part = interval(i);
        float far_m = part.far_m;
        bool collides = false;
        std::uint32_t with = 0;
        bool with_grid = false;
        // All that does not vary is one medium: a channel that the path carries chooses where it ends.
        set_even_mix(i, mix);
        if (max_component(mix.sigma_t) > 0.0f) {
            const float choice = stream.next() * sum(throughput);
            const int channel = choice < throughput.x ? 0 : choice < throughput.x + throughput.y ? 1 : 2;
            const float at_m = part.near_m + stream.next_depth() / mix.sigma_t[channel];
            collides = at_m < far_m;
            far_m = std::min(far_m, at_m);
            const Rgb weight =
                transmittance_over(mix.sigma_t, far_m - part.near_m) * (collides ? mix.sigma_t : Rgb(1.0f));
            const float whole = dot(throughput, weight);
            throughput *= whole > 0.0f ? weight * (sum(throughput) / whole) : Rgb(0.0f);
        }
        for (const std::uint32_t id : ids(i)) {
            const PlacedMedium& placed = media_.at(id);
            const VoxelGrid* grid = placed.medium->density.get();
            if (!grid) continue;
            const Collision found = sample_collision(*grid, grid_ray(placed, *grid, part.near_m, far_m), placed.sigma_t,
                                                     throughput, stream);
            throughput = found.throughput;
            if (!found.distance_m) continue;
            collides = with_grid = true;
            far_m = *found.distance_m;
            with = id;
        }
        if (!collides) continue;
        if (with_grid) {
            clear(mix);
            add(mix, *media_.at(with).medium, 1.0f, Rgb(0.0f));
        }
        const Rgb collided = throughput;
        throughput = Rgb(0.0f);
        if (!mix.scatters()) return std::nullopt;
        return Collided{far_m, collided * mix.sigma_s / max(mix.sigma_t, Rgb(tiny<float>))};
    }
    return std::nullopt;
}

namespace {

/// How far rays go within a box of another space, up to far_m.
Batch length_in_box(const std::array<Vec3f, 2>& box, const Transform& box_from_world, const RayOf<Batch>& rays) {
    const auto turned = [&](const Vec3b& v) {
        const Mat3<float>& m = box_from_world.linear;
        return broadcast(m[0]) * v.x + broadcast(m[1]) * v.y + broadcast(m[2]) * v.z;
    };
    const Vec3b origin = turned(rays.origin) + broadcast(box_from_world.translation),
                direction = turned(rays.direction);
    Batch near_m(0.0f), far_m = rays.far_m;
    for (int axis = 0; axis < 3; ++axis) {
        const Batch d = direction[axis];
        const Batch inverse = Batch(1.0f) / select(abs(d) < Batch(1e-20f), Batch(1e-20f), d);
        const Batch low = (Batch(box[0][axis]) - origin[axis]) * inverse;
        const Batch high = (Batch(box[1][axis]) - origin[axis]) * inverse;
        near_m = max(near_m, min(low, high));
        far_m = min(far_m, max(low, high));
    }
    return max(far_m - near_m, Batch(0.0f));
}

}  // namespace

Vec3b transmittance(const Media& media, const RayOf<Batch>& rays, const WordBatch& seeds) {
    if (media.are_even_boxes()) {
        Vec3b left(Batch(1.0f));
        for (std::uint32_t id = 0; id < media.count(); ++id) {
            const PlacedMedium& placed = media.at(id);
            const Batch length_m = placed.box ? length_in_box(*placed.box, placed.object_from_world, rays) : rays.far_m;
            left = left * transmittance_over(placed.sigma_t, length_m);
        }
        return left;
    }
    MediaRay ray(media);
    const std::array<Ray, batch_size> each = unpack<RayOf>(rays);
    std::array<std::uint32_t, batch_size> seed;
    seeds.store_unaligned(seed.data());
    std::array<Rgb, batch_size> left;
    for (std::size_t i = 0; i < batch_size; ++i) {
        left[i] = Rgb(1.0f);
        if (!(each[i].far_m > 0.0f)) continue;
        RandomStream stream{seed[i]};
        ray.follow(each[i], &stream);
        left[i] = ray.through();
    }
    return gather_vector([&](std::size_t i) { return left[i]; });
}

}  // namespace pivot
