#include "core/tables/ggx_dielectric.h"

#include "core/tables/axes.h"
#include "core/tables/embed.h"

PIVOT_EMBED_TABLE(pivot_ggx_dielectric, "ggx_dielectric.f32")

namespace pivot {

float ggx_dielectric_weight(float alpha, float cos_o, float ior) {
    const TableCell row = table_cell(alpha_coordinate(alpha), ggx_dielectric_alpha_nodes);
    const TableCell column = table_cell(cos_coordinate(cos_o), ggx_dielectric_cos_nodes);
    const TableCell layer = table_cell(ior_coordinate(ior), ggx_dielectric_ior_nodes);
    const auto along_ior = [&](int i, int j) {
        const float* node = pivot_ggx_dielectric +
                            ((row.index + i) * ggx_dielectric_cos_nodes + column.index + j) * ggx_dielectric_ior_nodes +
                            layer.index;
        return lerp(node[0], node[1], layer.weight);
    };
    return lerp(lerp(along_ior(0, 0), along_ior(0, 1), column.weight),
                lerp(along_ior(1, 0), along_ior(1, 1), column.weight), row.weight);
}

}  // namespace pivot
