// What Blender's image textures look up, and how they project a picture on a place. [Cycles 4.5 kernel/svm/image.h,
// kernel/camera/projection.h, util/math_float3.h]
#include "core/shaders/ops/math.h"
#include "core/shaders/ops/tables.h"
#include "core/textures/image.h"

namespace pivot {
namespace {

const Batch zero(0.0f), one(1.0f), half(0.5f);

ImageLookup how(Settings<4> settings) {
    return {.interpolation = static_cast<Interpolation>(settings[0]),
            .extension = static_cast<Extension>(settings[1]),
            .unassociate = settings[2] != 0.0f,
            .closed_u = settings[3] != 0.0f};
}

/// settings: Interpolation, Extension, whether colours are wanted without alpha, whether u = 0 and 1 are one place.
std::tuple<Vec3b, Batch> whole_image(const Image& image, Settings<4> settings, const Vec2b& uv, const Vec2b& uv_x,
                                     const Vec2b& uv_y) {
    return image.lookup(how(settings), uv, uv_x, uv_y);
}

/// One of the tiles that a picture is made of, beside what the others gave. settings: as above, then which tile it is
/// along u and v. [Cycles 4.5 kernel/svm/image.h svm_node_tex_image]
std::tuple<Vec3b, Batch> image_tile(const Image& image, Settings<6> settings, const Vec2b& uv, const Vec2b& uv_x,
                                    const Vec2b& uv_y, const Vec3b& color, const Batch& alpha) {
    const Vec2b tile{Batch(settings[4]), Batch(settings[5])};
    const BatchMask inside = trunc(uv.x) == tile.x && trunc(uv.y) == tile.y;
    if (!any(inside)) return {color, alpha};
    const auto [c, a] = image.lookup(how(settings.first<4>()), uv - tile, uv_x - tile, uv_y - tile);
    return {select(inside, c, color), select(inside, a, alpha)};
}

/// The six faces of a box, seen from outside and blended near its edges. settings: as above, then how far the blend
/// reaches; the coordinate beside: along two directions.
std::tuple<Vec3b, Batch> image_box(const Image& image, Settings<5> settings, const Place& place, const Vec3b& at,
                                   const Vec3b& at_x, const Vec3b& at_y) {
    const Batch blend(settings[4]), limit = half * (one + blend);
    const Mat3<Batch>& linear = place.lanes.corners.world_from_object.linear;
    const Vec3b object_normal = place.normal * linear;
    Vec3b n = abs(object_normal);
    n *= one / max(n.x + n.y + n.z, tiny<Batch>);
    // A corner of the triangle of all (n.x, n.y, n.z) is one face's, an edge two faces', the middle all three's.
    const BatchMask x_alone = n.x > limit * (n.x + n.y) && n.x > limit * (n.x + n.z);
    const BatchMask y_alone = n.y > limit * (n.x + n.y) && n.y > limit * (n.y + n.z);
    const BatchMask z_alone = n.z > limit * (n.x + n.z) && n.z > limit * (n.y + n.z);
    Vec3b weight(one, zero, zero);
    if (settings[4] > 0.0f) {
        const auto between = [&](const Batch& a, const Batch& b) {
            return clamp01(Batch((divided(a, a + b) - half * (one - blend)) / blend));
        };
        const Batch xy = between(n.x, n.y), yz = between(n.y, n.z), xz = between(n.x, n.z);
        const Batch two_limits = limit + limit, share = one / (two_limits - one);
        weight = (Batch(2.0f) - limit) * n + Vec3b(limit - one);
        weight *= share;
        weight = select(n.y < (one - limit) * (n.x + n.z), Vec3b(xz, zero, one - xz), weight);
        weight = select(n.x < (one - limit) * (n.y + n.z), Vec3b(zero, yz, one - yz), weight);
        weight = select(n.z < (one - limit) * (n.y + n.x), Vec3b(xy, one - xy, zero), weight);
    }
    weight = select(z_alone, Vec3b(zero, zero, one), weight);
    weight = select(y_alone, Vec3b(zero, one, zero), weight);
    weight = select(x_alone, Vec3b(one, zero, zero), weight);

    Vec3b color(zero);
    Batch alpha = zero;
    const auto add = [&](const Batch& share, const auto& face) {
        const BatchMask seen = share > zero;
        if (!any(seen)) return;
        const auto [c, a] = image.lookup(how(settings.first<4>()), face(at), face(at_x), face(at_y));
        color += select(seen, share * c, Vec3b(zero));
        alpha += select(seen, share * a, zero);
    };
    // No face is mirrored.
    add(weight.x, [&](const Vec3b& p) { return Vec2b(select(object_normal.x < zero, one - p.y, p.y), p.z); });
    add(weight.y, [&](const Vec3b& p) { return Vec2b(select(object_normal.y > zero, one - p.x, p.x), p.z); });
    add(weight.z, [&](const Vec3b& p) { return Vec2b(select(object_normal.z > zero, one - p.y, p.y), p.x); });
    return {color, alpha};
}

/// From the cube 0..1.
Vec2b project_sphere(const Vec3b& cube) {
    const Vec3b at = Batch(2.0f) * (cube - Vec3b(half));
    const Batch size2 = dot(at, at);
    const BatchMask upright = at.x == zero && at.y == zero;
    const Batch u = select(upright, zero, half - atan2(at.x, at.y) * Batch(0.5f / pi<float>));
    const Batch cosine = at.z / sqrt(max(size2, tiny<Batch>));
    const Batch v = one - acos(min(max(cosine, -one), one)) * Batch(1 / pi<float>);
    return {select(size2 > zero, u, zero), select(size2 > zero, v, zero)};
}

Vec2b project_tube(const Vec3b& cube) {
    const Vec3b at = Batch(2.0f) * (cube - Vec3b(half));
    const BatchMask somewhere = at.x * at.x + at.y * at.y > zero;
    return {select(somewhere, (one - atan2(at.x, at.y) * Batch(1 / pi<float>)) * half, zero),
            select(somewhere, (at.z + one) * half, zero)};
}

Vec2b project_equirectangular(const Vec3b& direction) {
    const Batch size = length(direction);
    const Batch cosine = min(max(divided(direction.z, size), -one), one);
    const Batch u = half - atan2(direction.y, direction.x) * Batch(0.5f / pi<float>);
    const Batch v = one - acos(cosine) * Batch(1 / pi<float>);
    return {select(size > zero, u, zero), select(size > zero, v, zero)};
}

Vec2b project_mirror_ball(const Vec3b& direction) {
    const Batch size = length(direction);
    const Vec3b towards(divided(direction.x, size), divided(direction.y, size) - one, divided(direction.z, size));
    const Batch scale = Batch(2.0f) * sqrt(max(Batch(-0.5f) * towards.y, zero));
    const Vec3b at = towards / select(scale > zero, scale, one);
    return {half * (at.x + one), half * (at.z + one)};
}

constexpr std::array ops{
    op<whole_image>("image"),
    op<image_tile>("image_tile"),
    op<image_box>("image_box"),
    op<project_sphere>("project_sphere"),
    op<project_tube>("project_tube"),
    op<project_equirectangular>("project_equirectangular"),
    op<project_mirror_ball>("project_mirror_ball"),
};

}  // namespace

std::span<const OpKind> image_ops() { return ops; }

}  // namespace pivot
