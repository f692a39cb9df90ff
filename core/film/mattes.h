// Which objects, materials and assets a pixel sees, and how much of each: what Cryptomatte's passes rank.
//   [Friedman15] "Fully Automatic ID Mattes with Support for Motion Blur and Transparency"
#pragma once

#include <span>
#include <vector>

namespace pivot {

/// The kinds of ids that passes show.
enum class MatteKind { object, material, asset };

/// Ids as [Friedman15] makes floats of hashes.
struct MatteIds {
    float object = 0.0f, material = 0.0f, asset = 0.0f;

    bool operator==(const MatteIds&) const = default;
    float of(MatteKind kind) const {
        return kind == MatteKind::object ? object : kind == MatteKind::material ? material : asset;
    }
};

struct Matte {
    MatteIds ids;
    float weight;
};

/// What one camera ray shows of ids.
struct SeenMatte {
    std::size_t ray;
    Matte matte;
};

/// A pixel's sums.
class Mattes {
   public:
    void add(const Matte& matte, float scale);
    void add(const Mattes& other, float scale);
    /// Adds what samples show of ids, by the samples' weights. seen: of them, the first sample's ray being first_ray.
    void add(std::span<const SeenMatte> seen, std::size_t first_ray, std::span<const float> weights, float scale);

    /// Writes (id, weight) of the two that weigh most after the first `rank`, weights over the pixel's; 0: no more.
    void write(MatteKind kind, std::size_t rank, float per_weight, float* out) const;

   private:
    std::vector<Matte> mattes_;
};

}  // namespace pivot
