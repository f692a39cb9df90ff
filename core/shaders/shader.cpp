#include "core/shaders/shader.h"

#include "core/simd/pack.h"

namespace pivot {
namespace {

/// 0 where there is no number: what a node made of nothing must not reach a light.
Batch finite(const Batch& x) { return select(abs(x) <= std::numeric_limits<Batch>::max(), x, Batch(0.0f)); }

Batch value_of(const Varying& v, std::span<const Batch> registers) {
    return min(max(finite(registers[v.register_index]), Batch(v.low)), Batch(v.high));
}

/// Sets one of the numbers that a struct over batches is made of.
template <class Numbers>
void set_number(Numbers& numbers, std::size_t place, const Batch& value) {
    std::memcpy(reinterpret_cast<std::byte*>(&numbers) + place * sizeof(Batch), &value, sizeof(Batch));
}

}  // namespace

void Shader::set_transparency() {
    std::vector<std::uint32_t> registers;
    for (const Varying& v : varying)
        if (v.number >= transparency_place) registers.push_back(v.register_index);
    transparency = program.part_for(registers);
}

TransparencyOf<Batch> transparency_at(const Shader& shader, std::span<const Batch> registers) {
    TransparencyOf<Batch> result = broadcast<TransparencyOf>(shader.constants.transparency);
    for (const Varying& v : shader.varying)
        if (v.number >= transparency_place) set_number(result, v.number - transparency_place, value_of(v, registers));
    return result;
}

MaterialOf<Batch> material_at(const Shader& shader, std::span<const Batch> registers) {
    MaterialOf<Batch> material = broadcast<MaterialOf>(shader.constants);
    for (const Varying& v : shader.varying) set_number(material, v.number, value_of(v, registers));
    return material;
}

}  // namespace pivot
