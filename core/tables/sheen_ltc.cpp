#include "core/tables/sheen_ltc.h"

#include "core/tables/axes.h"
#include "core/tables/embed.h"

PIVOT_EMBED_TABLE(pivot_sheen_ltc, "sheen_ltc.f32")

namespace pivot {

template <class T>
SheenLtc<T> sheen_ltc(T roughness, T cos_o) {
    const TableCell row = table_cell(clamp01(roughness), sheen_roughness_nodes);
    const TableCell column = table_cell(clamp01(cos_o), sheen_cos_nodes);
    const Index<T> node = (row.index * sheen_cos_nodes + column.index) * 3;
    const auto value = [&](int which) {
        const auto along = [&](int i) {
            const float* table = pivot_sheen_ltc + i * sheen_cos_nodes * 3 + which;
            return lerp(fetch(table, node), fetch(table + 3, node), column.weight);
        };
        return lerp(along(0), along(1), row.weight);
    };
    return {value(0), value(1), value(2)};
}

template SheenLtc<float> sheen_ltc(float, float);
template SheenLtc<Batch> sheen_ltc(Batch, Batch);

}  // namespace pivot
