// What a cell of virtual lights looks like from nearby: the sixteen pieces of it, in the surface, by what of its light
// each has. Of one Gaussian nothing tells how the light of neighbouring cells adds up where they meet, nor that it ends
// where another surface stands on theirs.
#pragma once

#include <array>
#include <optional>

#include "core/math/vector.h"

namespace pivot {

struct LightPiece {
    Vec3f mean;
    float variance_m2;  ///< of places, as VirtualLight's
    float share;        ///< of the light
};

struct LightPieces {
    std::array<LightPiece, 4> quarters;
    std::array<LightPiece, 16> sixteenths;  ///< those of each quarter together
    Vec3f along, across;                    ///< half of the sides of a sixteenth

    /// A quarter of a sixteenth, or of a part of one that is 2^-halvings as long.
    LightPiece part_of(const LightPiece& piece, std::size_t k, int halvings) const;
};

/// Sums over deposits in a cell.
class PieceSums {
   public:
    /// offset: from the cell's middle, -1 to 1. flat_axis: the one of its axes that the surface faces most.
    void add(const Vec3f& offset, int flat_axis, const Vec3f& place, float weight);
    /// Nothing where too few deposits tell too little.
    std::optional<LightPieces> pieces() const;

   private:
    struct Sum {
        float weight = 0.0f;
        Vec3f place{0.0f};  ///< from the first deposit's
    };

    LightPiece piece_of(const Sum& sum, float variance_m2) const;

    std::array<Sum, 16> sums_;
    float weight_ = 0.0f, squares_ = 0.0f;
    Vec3f first_{0.0f};
    int flat_axis_ = -1;  ///< the first deposit's
};

}  // namespace pivot
