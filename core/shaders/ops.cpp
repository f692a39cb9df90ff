// The table of all ops, a file of them for each subject.
#include "core/shaders/op.h"
#include "core/shaders/ops/tables.h"

namespace pivot {
namespace {

constexpr std::array tables{math_ops,   vector_math_ops, map_range_ops,   rotation_ops,  color_ops,
                            blend_ops,  spectrum_ops,    geometry_ops,    attribute_ops, ray_ops,
                            normal_ops, noise_ops,       white_noise_ops, voronoi_ops,   magic_ops,
                            brick_ops,  gabor_ops,       image_ops,       layer_ops,     strand_ops};

}  // namespace

const OpKind* find_op(std::string_view name) {
    for (const auto& table : tables)
        for (const OpKind& kind : table())
            if (kind.name == name) return &kind;
    return nullptr;
}

std::vector<const OpKind*> all_ops() {
    std::vector<const OpKind*> all;
    for (const auto& table : tables)
        for (const OpKind& kind : table()) all.push_back(&kind);
    return all;
}

}  // namespace pivot
