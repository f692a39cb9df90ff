// The lobes that a surface may have beside its base: a file each in core/bsdf/lobes/, and a row of the list below. A
// kind is a struct of numbers as seen from one direction; all have the same functions (see Lobe). Shading frame, z the
// normal and wo above it; wi may be on either side.
#pragma once

#include <tuple>
#include <utility>

#include "core/bsdf/highlight.h"
#include "core/bsdf/lobes/anisotropic_ggx.h"
#include "core/bsdf/lobes/ashikhmin_shirley.h"
#include "core/bsdf/lobes/clearcoat.h"
#include "core/bsdf/lobes/dielectric.h"
#include "core/bsdf/lobes/disney_diffuse.h"
#include "core/bsdf/lobes/further_base.h"
#include "core/bsdf/lobes/hair.h"
#include "core/bsdf/lobes/metal_film.h"
#include "core/bsdf/lobes/oren_nayar.h"
#include "core/bsdf/lobes/sheen.h"
#include "core/bsdf/lobes/strand.h"
#include "core/bsdf/lobes/subsurface.h"
#include "core/bsdf/lobes/tabulated.h"
#include "core/bsdf/lobes/thin_film.h"
#include "core/bsdf/lobes/thin_glass.h"
#include "core/bsdf/lobes/toon.h"
#include "core/bsdf/lobes/translucent.h"
#include "core/bsdf/lobes/velvet.h"
#include "core/bsdf/material.h"

namespace pivot {

template <class T>
using LobeKinds =
    std::tuple<FurtherBase<T>, Translucent<T>, Tabulated<T>, Dielectric<T>, AnisotropicGgx<T>, Conductor<T>,
               OrenNayar<T>, DisneyDiffuse<T>, Sheen<T>, Velvet<T>, Hair<T>, Subsurface<T>, ThinFilm<T>, Strand<T>,
               AshikhminShirley<T>, Toon<T>, MetalFilm<T>, ThinGlass<T>, Clearcoat<T>>;

/// A lobe that reads a table, whose AddressOf it and its Parameters call ndf (lobe_record.h clears it in other lanes).
template <class L>
concept HasTable = requires {
    typename L::Table;
};

/// A lobe about as even as Lambert's, which bumps light as they do that, and which light samples find with it.
template <class L>
concept DiffuseLobe = requires {
    requires L::is_diffuse;
};

/// What a kind of lobe must have, T its number type. It may have add_highlights(HighlightsOf<T>&, wo, mask), which adds
/// GGX lobes that light samples may follow and what these leave out (of a diffuse lobe, whether it is even enough); and
/// highlight_probability(), below which u_lobe draws what is no diffuse light; and eval_diffuse(wo, wi), the part of
/// eval() that is; its Parameters turn_over(mask), which makes them those of the surface's back, and
/// turn_normals(local_of, mask), which takes normals of theirs out of world space; and is_diffuse, see
/// DiffuseLobe; and is_of_strands, of surfaces that are thinner than pixels; and eval_sampled(wo, wi), which stands for
/// eval() where a sample of the BSDF goes on, of lobes to which lamps are not like other light.
template <class L, class T>
concept Lobe = requires(const L& lobe, const typename L::Parameters& parameters, const Vec3<T>& w, T u_lobe,
                        const Vec2<T>& u) {
    /// As a material has it: a struct of numbers, named in order by L::parameters, and last the AddressOf an
    /// L::Table, if there is such a type; and as it is seen from wo.
    { L::seen(parameters, w) } -> std::same_as<L>;
    requires !HasTable<L> || requires {
        lobe.ndf;
        parameters.ndf;
    };
    { L::name } -> std::convertible_to<std::string_view>;
    { L::parameters[0] } -> std::convertible_to<LobeParameter>;
    /// Which sides of the surface light may come from: the viewer's, the other, or both.
    { L::reflects || L::transmits } -> std::convertible_to<bool>;
    /// (wo, wi): BSDF times |cos|, 1/sr.
    { lobe.eval(w, w) } -> std::same_as<Vec3<T>>;
    /// (wo, wi): density of sample().
    { lobe.pdf_omega(w, w) } -> std::same_as<T>;
    /// (wo, u_lobe, u): a direction; u_lobe chooses among parts, if there are any, and u places it.
    { lobe.sample(w, u_lobe, u) } -> std::same_as<Vec3<T>>;
    /// (wo): what it sends to wo where all light around is 1; about, for it chooses among lobes.
    { lobe.albedo(w) } -> std::same_as<Vec3<T>>;
    /// What the pass of diffuse colours shows of it.
    { lobe.diffuse() } -> std::same_as<Vec3<T>>;
    /// (wo): the base that reflects what this lobe sends to wo, or about that; of one that only transmits, in a frame
    /// turned over. has_closed_form: whether the analytic integrator takes the base for the lobe.
    { lobe.closed_form(w) } -> std::same_as<BaseOf<T>>;
    { L::has_closed_form } -> std::convertible_to<bool>;
    /// (least alpha): the lobe, its GGX alpha at least that and all else as it was, even how much it reflects.
    { lobe.blurred(u_lobe) } -> std::same_as<L>;
};

namespace detail {

template <class L>
constexpr std::size_t number_count() {
    std::size_t count = 0;
    for (const LobeParameter& parameter : L::parameters) count += parameter.count;
    if constexpr (HasTable<L>) count += 3;  // its address, after them
    return count;
}

}  // namespace detail

/// Calls visit.operator()<L>(kind) for each kind L; kind: its place in the list, from 1.
template <class T, class Visit>
void for_each_lobe_kind(const Visit& visit) {
    [&]<class... L>(std::type_identity<std::tuple<L...>>) {
        static_assert((Lobe<L, T> && ...));
        static_assert(((sizeof(typename L::Parameters) == detail::number_count<L>() * sizeof(T)) && ...));
        float kind = 0.0f;
        (visit.template operator()<L>(T(++kind)), ...);
    }(std::type_identity<LobeKinds<T>>{});
}

/// The material as the surface's back has it, where that is seen.
template <class T>
void turn_over(MaterialOf<T>& material, const Mask<T>& is_behind) {
    for (LobeOf<T>& record : material.lobes) {
        if (!any(record.kind > T(0))) return;
        for_each_lobe_kind<T>([&]<class L>(T kind) {
            if constexpr (requires(typename L::Parameters p) { p.turn_over(is_behind); }) {
                const Mask<T> is_kind = record.kind == kind;
                if (!any(is_kind && is_behind)) return;
                auto parameters = record.template read<typename L::Parameters>(is_kind);
                parameters.turn_over(is_behind);
                record.write(parameters, is_kind);
            }
        });
    }
}

/// The material with the normals of its lobes, which are in world space, as local_of(normal) has them.
template <class T, class LocalOf>
void turn_normals(MaterialOf<T>& material, const LocalOf& local_of) {
    for (LobeOf<T>& record : material.lobes) {
        if (!any(record.kind > T(0))) return;
        for_each_lobe_kind<T>([&]<class L>(T kind) {
            if constexpr (requires(typename L::Parameters p) { p.turn_normals(local_of, kind == kind); }) {
                const Mask<T> is_kind = record.kind == kind;
                if (!any(is_kind)) return;
                auto parameters = record.template read<typename L::Parameters>(is_kind);
                parameters.turn_normals(local_of, is_kind);
                record.write(parameters, is_kind);
            }
        });
    }
}

/// Calls visit(lobe, mask) for each kind that the record has in some lane, those of the mask.
template <class T, class Visit>
void visit_lobe(const LobeOf<T>& record, const Visit& visit) {
    for_each_lobe_kind<T>([&]<class L>(T kind) {
        const Mask<T> is_kind = record.kind == kind;
        if (any(is_kind)) visit(record.template read<L>(is_kind), is_kind);
    });
}

}  // namespace pivot
