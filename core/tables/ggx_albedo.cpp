#include "core/tables/ggx_albedo.h"

#include "core/tables/axes.h"
#include "core/tables/embed.h"
#include "core/tables/ggx_sptd.h"

PIVOT_EMBED_TABLE(pivot_ggx_average_albedo, "ggx_average_albedo.f32")

namespace pivot {

float ggx_albedo(float alpha, float cos_o) {
    const TableCell row = table_cell(alpha_coordinate(alpha), ggx_sptd_nodes);
    const TableCell column = table_cell(cos_coordinate(cos_o), ggx_sptd_nodes);
    const auto along_cos = [&](int alpha_index) {
        const float* node = ggx_sptd_table() + (alpha_index * ggx_sptd_nodes + column.index) * 3 + 2;
        return lerp(node[0], node[3], column.weight);
    };
    return lerp(along_cos(row.index), along_cos(row.index + 1), row.weight);
}

float ggx_average_albedo(float alpha) {
    const TableCell cell = table_cell(alpha_coordinate(alpha), ggx_albedo_nodes);
    return lerp(pivot_ggx_average_albedo[cell.index], pivot_ggx_average_albedo[cell.index + 1], cell.weight);
}

}  // namespace pivot
