#include "core/tables/ggx_ltc.h"

#include "core/tables/axes.h"
#include "core/tables/embed.h"
#include "core/tables/ggx_albedo.h"

PIVOT_EMBED_TABLE(pivot_ggx_ltc, "ggx_ltc.f32")

namespace pivot {

GgxLtc ggx_ltc(float alpha, const Vec3f& wo_local) {
    const TableCell row = table_cell(alpha_coordinate(alpha), ggx_ltc_nodes);
    const TableCell column = table_cell(cos_coordinate(wo_local.z), ggx_ltc_nodes);
    const auto along_cos = [&](int alpha_index, int value) {
        const float* node = pivot_ggx_ltc + (alpha_index * ggx_ltc_nodes + column.index) * 4 + value;
        return lerp(node[0], node[4], column.weight);
    };
    const auto fetch = [&](int value) {
        return lerp(along_cos(row.index, value), along_cos(row.index + 1, value), row.weight);
    };
    const Mat3<float> m = ggx_ltc_matrix(alpha, wo_local, fetch(0), fetch(1), fetch(2), fetch(3));
    return {make_ltsd(BaseDistribution::clamped_cosine, m), ggx_albedo(alpha, wo_local.z)};
}

}  // namespace pivot
