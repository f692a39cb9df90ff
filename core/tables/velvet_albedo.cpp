#include "core/tables/velvet_albedo.h"

#include "core/tables/axes.h"
#include "core/tables/embed.h"

PIVOT_EMBED_TABLE(pivot_velvet_albedo, "velvet_albedo.f32")

namespace pivot {

template <class T>
T velvet_albedo(T sigma, T cos_o) {
    const T along_sigma = clamp01((sigma - T(velvet_min_sigma)) * T(1.0f / (1.0f - velvet_min_sigma)));
    const TableCell row = table_cell(along_sigma, velvet_sigma_nodes);
    const TableCell column = table_cell(acos(clamp01(cos_o)) * T(2.0f / pi<float>), velvet_cos_nodes);
    const Index<T> node = row.index * velvet_cos_nodes + column.index;
    const auto along = [&](int i) {
        const float* table = pivot_velvet_albedo + i * velvet_cos_nodes;
        return lerp(fetch(table, node), fetch(table + 1, node), column.weight);
    };
    return exp(lerp(along(0), along(1), row.weight) / (sigma * sigma));
}

template float velvet_albedo(float, float);
template Batch velvet_albedo(Batch, Batch);

}  // namespace pivot
