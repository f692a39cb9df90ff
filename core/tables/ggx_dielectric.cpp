#include "core/tables/ggx_dielectric.h"

#include "core/tables/axes.h"
#include "core/tables/embed.h"

PIVOT_EMBED_TABLE(pivot_ggx_dielectric, "ggx_dielectric.f32")

namespace pivot {

template <class T>
T ggx_dielectric_weight(T alpha, T cos_o, T ior) {
    const TableCell row = table_cell(alpha_coordinate(alpha), ggx_dielectric_alpha_nodes);
    const TableCell column = table_cell(cos_coordinate(cos_o), ggx_dielectric_cos_nodes);
    const TableCell layer = table_cell(ior_coordinate(ior), ggx_dielectric_ior_nodes);
    const Index<T> node =
        (row.index * ggx_dielectric_cos_nodes + column.index) * ggx_dielectric_ior_nodes + layer.index;
    const auto along_ior = [&](int i, int j) {
        const float* table = pivot_ggx_dielectric + (i * ggx_dielectric_cos_nodes + j) * ggx_dielectric_ior_nodes;
        return lerp(fetch(table, node), fetch(table + 1, node), layer.weight);
    };
    return lerp(lerp(along_ior(0, 0), along_ior(0, 1), column.weight),
                lerp(along_ior(1, 0), along_ior(1, 1), column.weight), row.weight);
}

template float ggx_dielectric_weight(float, float, float);
template Batch ggx_dielectric_weight(Batch, Batch, Batch);

}  // namespace pivot
