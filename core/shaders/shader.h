// What a material means: numbers, of which those that vary over a surface are a program's registers.
#pragma once

#include <algorithm>
#include <optional>

#include "core/bsdf/material.h"
#include "core/bsdf/tabulated_ndf.h"
#include "core/media/medium.h"
#include "core/shaders/program.h"

namespace pivot {

/// A number of MaterialOf, counted in floats from its start, and the register that it is, within bounds.
struct Varying {
    std::uint32_t number;
    std::uint32_t register_index;
    float low, high;
};

struct Shader {
    Material constants;
    Program program;
    std::vector<Varying> varying;
    std::optional<std::array<std::uint32_t, 3>> normal;       ///< registers of the shading normal, world space
    std::optional<std::array<std::uint32_t, 3>> tangent;      ///< of the tangent, world space, of any length
    std::vector<std::shared_ptr<const TabulatedNdf>> tables;  ///< that its lobes read
    std::shared_ptr<const Medium> medium;                     ///< that fills what it surrounds; none: nothing
    float matte = 0.0f;                                       ///< its id in mattes
    float pass_index = 0.0f;                                  ///< Blender's own of the material
    bool filters_shadows = true;                              ///< false: it hides light, whatever rays see through it
    bool has_surface = true;                                  ///< false: rays pass, and only the medium is there
    bool normal_is_own = false;  ///< the surface's own, as displacement would turn it: nothing smooths its shadows
    std::vector<std::pair<std::uint32_t, std::uint32_t>> aovs;  ///< passes, and the material whose emission each shows
    Program transparency;  ///< what of the program tells how much light passes; set_transparency() makes it

    Shader(const Material& material) : constants(material) {}  // NOLINT: a material is a shader of constants
    Shader(const Material& material, Program runs) : constants(material), program(std::move(runs)) {}

    bool is_constant() const { return varying.empty() && !normal && !tangent; }
    bool has_varying_emission() const {
        return std::ranges::any_of(
            varying, [](const Varying& v) { return v.number >= emission_place && v.number < emission_place + 3; });
    }
    bool has_varying_transparency() const {
        return std::ranges::any_of(varying, [](const Varying& v) { return v.number >= transparency_place; });
    }
    /// Whether light may pass straight through it.
    bool is_transparent() const {
        return has_varying_transparency() || max_component(constants.transparency.color) > 0.0f;
    }
    /// Whether shadow rays pass through it.
    bool filters_light() const { return filters_shadows && is_transparent(); }
    void set_transparency();
    /// Whether light may leave it of its own.
    bool is_emissive() const { return has_varying_emission() || constants.is_emissive(); }
};

/// What of light passes at each lane's place; the registers: as `transparency` leaves them.
TransparencyOf<Batch> transparency_at(const Shader& shader, std::span<const Batch> registers);

/// The material at each lane's place, its numbers within what a surface can be made of.
MaterialOf<Batch> material_at(const Shader& shader, std::span<const Batch> registers);

}  // namespace pivot
