// Blender's Magic texture: sines of sines. [Cycles 4.5 kernel/svm/magic.h 13-99]
#include "core/shaders/ops/math.h"
#include "core/shaders/ops/tables.h"

namespace pivot {
namespace {

/// settings: how many steps deep, 0 to 10.
Vec3b magic(Settings<1> settings, const Vec3b& at, Batch scale, Batch distortion) {
    const auto depth = static_cast<int>(settings[0]);
    const Batch turn(2.0f * pi<float>), five = Batch(5.0f), half(0.5f);
    const Vec3b p(modulo(at.x, turn), modulo(at.y, turn), modulo(at.z, turn));
    Batch x = sin((p.x + p.y + p.z) * five * scale);
    Batch y = cos((-p.x + p.y - p.z) * five * scale);
    Batch z = -cos((-p.x - p.y + p.z) * five * scale);
    if (depth > 0) {
        x *= distortion, y *= distortion, z *= distortion;
        y = -cos(x - y + z) * distortion;
    }
    if (depth > 1) x = cos(x - y - z) * distortion;
    if (depth > 2) z = sin(-x - y - z) * distortion;
    if (depth > 3) x = -cos(-x + y - z) * distortion;
    if (depth > 4) y = -sin(-x + y + z) * distortion;
    if (depth > 5) y = -cos(-x + y + z) * distortion;
    if (depth > 6) x = cos(x + y + z) * distortion;
    if (depth > 7) z = sin(x + y - z) * distortion;
    if (depth > 8) x = -cos(-x - y + z) * distortion;
    if (depth > 9) y = -sin(x - y + z) * distortion;
    const Batch divisor = select(distortion != Batch(0.0f), distortion * Batch(2.0f), Batch(1.0f));
    return {half - x / divisor, half - y / divisor, half - z / divisor};
}

constexpr std::array ops{op<magic>("magic")};

}  // namespace

std::span<const OpKind> magic_ops() { return ops; }

}  // namespace pivot
