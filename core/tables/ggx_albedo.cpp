#include "core/tables/ggx_albedo.h"

#include "core/tables/axes.h"
#include "core/tables/embed.h"
#include "core/tables/ggx_sptd.h"

PIVOT_EMBED_TABLE(pivot_ggx_average_albedo, "ggx_average_albedo.f32")

namespace pivot {

template <class T>
T ggx_albedo(T alpha, T cos_o) {
    const TableCell row = table_cell(alpha_coordinate(alpha), ggx_sptd_nodes);
    const TableCell column = table_cell(cos_coordinate(cos_o), ggx_sptd_nodes);
    const Index<T> node = (row.index * ggx_sptd_nodes + column.index) * 3;
    const auto along_cos = [&](int alpha_index) {
        const float* table = ggx_sptd_table() + alpha_index * ggx_sptd_nodes * 3 + 2;
        return lerp(fetch(table, node), fetch(table + 3, node), column.weight);
    };
    return lerp(along_cos(0), along_cos(1), row.weight);
}

template <class T>
T ggx_average_albedo(T alpha) {
    const TableCell cell = table_cell(alpha_coordinate(alpha), ggx_albedo_nodes);
    return lerp(fetch(pivot_ggx_average_albedo, cell.index), fetch(pivot_ggx_average_albedo + 1, cell.index),
                cell.weight);
}

template float ggx_albedo(float, float);
template Batch ggx_albedo(Batch, Batch);
template float ggx_average_albedo(float);
template Batch ggx_average_albedo(Batch);

}  // namespace pivot
