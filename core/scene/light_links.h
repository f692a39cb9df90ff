// Which objects a light lights, and whose shadows it casts. Every object is in one set of receivers and in one of
// blockers, of 64 each; a light names sets.
#pragma once

#include <cstdint>

namespace pivot {

/// Masks of sets.
struct LightLinks {
    std::uint64_t receivers = ~std::uint64_t{0}, blockers = ~std::uint64_t{0};

    bool operator==(const LightLinks&) const = default;
};

/// An object's sets, by number.
struct LinkSets {
    std::uint8_t receiver = 0, blocker = 0;
};

inline bool is_receiver(const LightLinks& light, const LinkSets& object) {
    return (light.receivers >> object.receiver & 1) != 0;
}
inline bool is_blocker(const LightLinks& light, const LinkSets& object) {
    return (light.blockers >> object.blocker & 1) != 0;
}
inline bool has_blockers_of_its_own(const LightLinks& light) { return light.blockers != LightLinks{}.blockers; }

}  // namespace pivot
