// The places of a batch on surfaces, where a program runs.
#pragma once

#include "core/shaders/program.h"

namespace pivot {

/// What programs work in, kept from batch to batch.
struct ProgramMemory {
    Registers registers;
    std::vector<Place> places;
};

/// Leaves what the program makes of the places in memory.registers. barycentric: of the points.
void run_on_surfaces(const Program& program, const PlaceLanes& lanes, const SurfacePointOf<Batch>& point,
                     const Vec2b& barycentric, ProgramMemory& memory);

}  // namespace pivot
