// Samples of a world that varies, by vertices of paths: candidates by its brightness alone, of which as many as have
// shadow rays are chosen by what the surface makes of them. This is resampling [Talbot05]: candidate x_k of n, its
// density p, weighs c_k = f(x_k) m(x_k), f the mean of BSDF times cosine and m the share that MIS leaves to n samples
// of the world. A chosen one brings f L m / (c p) sum(c) / n, unbiased whatever c is, and even where L follows p and
// nothing is in the way. Candidates are evenly spaced along the map's rows, and choices along the sums of c.
//   [Talbot05] "Importance Resampling for Global Illumination"
#pragma once

#include "core/integrators/light_lanes.h"
#include "core/integrators/settings.h"
#include "core/scene/scene.h"

namespace pivot {

/// How vertices of a bounce sample the world: later ones bring less. Of balls under three skies, twice as many of both
/// at first hits took a quarter from relMSE and cost as much more CPU; what is in the way makes most of the noise
/// there. Candidates by the lobes too, two of them, left a tenth more noise on even surfaces and as much on glossy
/// ones. Past first hits the more candidates count beside BSDF samples, the less those that meet something bright by
/// chance bring: eight in the place of two leave three quarters of the relMSE of glossy balls among each other; sixteen
/// cost more than they save.
struct WorldPlan {
    std::uint32_t candidates;  ///< as so many samples they count beside BSDF samples
    std::uint32_t rays;

    static constexpr std::uint32_t most_candidates = 8;
    static constexpr WorldPlan at(std::uint32_t bounce) {
        return bounce == 0 ? WorldPlan{4, 2} : WorldPlan{most_candidates, 1};
    }
};

class WorldSampler {
   public:
    WorldSampler(const Scene& scene, LightSampling strategy, const BouncePlan& plan, const VertexBatch& vertices);

    /// How many samples each vertex takes.
    std::uint32_t rays() const { return plan_.rays; }

    /// One of them.
    LightSampleOf<Batch> sample(std::uint32_t ray, Registers& registers) const;

   private:
    using Column = std::array<Batch, WorldPlan::most_candidates>;  ///< of a number of each candidate

    Vec3b chosen(const std::array<Column, 3>& columns, const IndexBatch& candidate) const;

    const Scene& scene_;
    WorldPlan plan_;
    std::uint32_t bounce_;
    Batch u_choice_;
    std::array<Column, 3> wi_, worth_;  ///< worth: f over its mean and over p
    Column sums_;                       ///< of c, up to each candidate
};

}  // namespace pivot
