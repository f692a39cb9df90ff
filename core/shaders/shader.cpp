#include "core/shaders/shader.h"

#include "core/simd/pack.h"

namespace pivot {
namespace {

/// 0 where there is no number: what a node made of nothing must not reach a light.
Batch finite(const Batch& x) { return select(abs(x) <= std::numeric_limits<Batch>::max(), x, Batch(0.0f)); }

}  // namespace

bool Shader::has_varying_emission() const {
    return std::ranges::any_of(
        varying, [](const Varying& v) { return v.number >= emission_place && v.number < emission_place + 3; });
}

MaterialOf<Batch> material_at(const Shader& shader, std::span<const Batch> registers) {
    MaterialOf<Batch> material = broadcast<MaterialOf>(shader.constants);
    for (const Varying& v : shader.varying) {
        const Batch value = min(max(finite(registers[v.register_index]), Batch(v.low)), Batch(v.high));
        std::memcpy(reinterpret_cast<std::byte*>(&material) + v.number * sizeof(Batch), &value, sizeof(Batch));
    }
    return material;
}

}  // namespace pivot
