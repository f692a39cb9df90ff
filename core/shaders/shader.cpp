#include "core/shaders/shader.h"

#include "core/simd/pack.h"

namespace pivot {
namespace {

/// 0 where there is no number: what a node made of nothing must not reach a light.
Batch finite(const Batch& x) { return select(abs(x) <= std::numeric_limits<Batch>::max(), x, Batch(0.0f)); }

}  // namespace

MaterialOf<Batch> material_at(const Shader& shader, std::span<const Batch> registers) {
    MaterialOf<Batch> material = broadcast<MaterialOf>(shader.constants);
    for (const Varying& v : shader.varying) {
        const Batch value = min(max(finite(registers[v.register_index]), Batch(v.low)), Batch(v.high));
        std::memcpy(reinterpret_cast<std::byte*>(&material) + v.number * sizeof(Batch), &value, sizeof(Batch));
    }
    return material;
}

}  // namespace pivot
