// A shader's program: ops over registers, run for a batch of places at once. What is the same everywhere was folded
// when it was made, so that a step runs because its numbers vary.
#pragma once

#include <span>
#include <string>

#include "core/shaders/op.h"

namespace pivot {

/// What a program's steps leave, kept from run to run.
using Registers = std::vector<Batch>;

/// A number of an op: constant, or a register's.
struct Input {
    static constexpr std::uint32_t constant = ~0u;
    std::uint32_t register_index = constant;
    float value = 0.0f;  ///< of a constant
};

class Program {
   public:
    /// Appends a step and returns its first register. Throws std::invalid_argument that names the op.
    /// neighbour: which of the places it looks at.
    std::uint32_t add(const std::string& name, std::vector<Input> inputs, OpSettings settings, std::uint32_t neighbour);
    /// The first of two places beside, so many footprints away: what bump mapping takes the differences of heights to.
    std::uint32_t bump_neighbour(float filter_width);

    bool is_empty() const { return steps_.empty(); }
    /// Those of its steps that these registers depend on; registers keep their places.
    Program part_for(std::span<const std::uint32_t> registers) const;
    std::uint32_t register_count() const { return register_count_; }
    /// The names of the steps' kinds, in order.
    std::vector<std::string_view> ops() const;
    /// Whether some step looks at a neighbour.
    bool needs_neighbours() const { return needs_neighbours_; }

    std::span<const float> bump_widths() const { return bump_widths_; }

    /// Makes the smaller copies of the images that its steps look up.
    void make_image_levels() const;

    /// places: as many as there are neighbours, or one. registers: grown to register_count() where they are fewer.
    void run(Places places, Registers& registers) const;
    /// The registers where there is no surface: register_count() numbers.
    std::vector<float> run_nowhere() const;

   private:
    struct Step {
        const OpKind* kind;
        std::uint32_t first_input, first_output;
        std::uint32_t neighbour;
        OpSettings settings;
    };
    std::vector<Step> steps_;
    std::vector<Input> inputs_;
    std::vector<float> bump_widths_;
    std::uint32_t register_count_ = 0;
    bool needs_neighbours_ = false;
};

/// What an op makes of constants. inputs, and what is returned: by number, then by lane. Throws std::invalid_argument
/// that names the op if the settings are too few or too many.
std::vector<Batch> evaluate(const OpKind& kind, std::span<const Batch> inputs, const OpSettings& settings);

}  // namespace pivot
