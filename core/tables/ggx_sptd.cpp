#include "core/tables/ggx_sptd.h"

#include "core/tables/axes.h"
#include "core/tables/embed.h"

PIVOT_EMBED_TABLE(pivot_ggx_sptd, "ggx_sptd.f32")

namespace pivot {

const float* ggx_sptd_table() { return pivot_ggx_sptd; }

GgxSptd ggx_sptd(float alpha, const Vec3f& wo_local) {
    const TableCell row = table_cell(alpha_coordinate(alpha), ggx_sptd_nodes);
    const TableCell column = table_cell(cos_coordinate(wo_local.z), ggx_sptd_nodes);
    const auto along_cos = [&](int alpha_index, int value) {
        const float* node = pivot_ggx_sptd + (alpha_index * ggx_sptd_nodes + column.index) * 3 + value;
        return lerp(node[0], node[3], column.weight);
    };
    const auto fetch = [&](int value) {
        return lerp(along_cos(row.index, value), along_cos(row.index + 1, value), row.weight);
    };
    return ggx_sptd_from_node(alpha, wo_local, fetch(0), fetch(1), fetch(2));
}

}  // namespace pivot
