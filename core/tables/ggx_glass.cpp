#include "core/tables/ggx_glass.h"

#include "core/tables/axes.h"
#include "core/tables/embed.h"

PIVOT_EMBED_TABLE(pivot_ggx_glass, "ggx_glass.f32")
PIVOT_EMBED_TABLE(pivot_ggx_glass_average, "ggx_glass_average.f32")

namespace pivot {

template <class T>
GlassAlbedo<T> ggx_glass_albedo(T alpha, T cos_o, T eta) {
    const TableCell row = table_cell(alpha_coordinate(alpha), ggx_glass_alpha_nodes);
    const TableCell column = table_cell(cos_coordinate(cos_o), ggx_glass_cos_nodes);
    const TableCell layer = table_cell(eta_coordinate(eta), ggx_glass_eta_nodes);
    const Index<T> node = ((row.index * ggx_glass_cos_nodes + column.index) * ggx_glass_eta_nodes + layer.index) * 2;
    const auto value = [&](int which) {
        const auto along_eta = [&](int i, int j) {
            const float* table = pivot_ggx_glass + (i * ggx_glass_cos_nodes + j) * ggx_glass_eta_nodes * 2 + which;
            return lerp(fetch(table, node), fetch(table + 2, node), layer.weight);
        };
        return lerp(lerp(along_eta(0, 0), along_eta(0, 1), column.weight),
                    lerp(along_eta(1, 0), along_eta(1, 1), column.weight), row.weight);
    };
    return {value(0), value(1)};
}

template <class T>
T ggx_glass_average_albedo(T alpha, T eta) {
    const TableCell row = table_cell(alpha_coordinate(alpha), ggx_glass_alpha_nodes);
    const TableCell layer = table_cell(eta_coordinate(eta), ggx_glass_eta_nodes);
    const Index<T> node = row.index * ggx_glass_eta_nodes + layer.index;
    const auto along_eta = [&](int i) {
        const float* table = pivot_ggx_glass_average + i * ggx_glass_eta_nodes;
        return lerp(fetch(table, node), fetch(table + 1, node), layer.weight);
    };
    return lerp(along_eta(0), along_eta(1), row.weight);
}

template GlassAlbedo<float> ggx_glass_albedo(float, float, float);
template GlassAlbedo<Batch> ggx_glass_albedo(Batch, Batch, Batch);
template float ggx_glass_average_albedo(float, float);
template Batch ggx_glass_average_albedo(Batch, Batch);

}  // namespace pivot
