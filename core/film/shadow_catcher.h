// Shadow catchers: stand-ins for real things, of which a picture shows what others do to their light. A camera ray that
// meets one is followed twice: among all, and among shadow catchers alone.
#pragma once

#include <vector>

#include "core/film/film.h"

namespace pivot {

/// What a film keeps for them as named passes.
namespace catcher_pass {
inline constexpr std::size_t alone = 0,  ///< light of catchers, as if there were nothing else
    among_all = 4,                       ///< and as it is
    matte = 1,                           ///< light of all camera rays that meet none, and of media before one
    shares = 2,                          ///< the alpha of these, and the share of rays that meet one
    world = 3,                           ///< the world's, through these media, of rays that meet one
    count = 5;
}  // namespace catcher_pass

/// A picture without the catchers: with nothing in their place, with alpha where they lose light, or the world behind
/// them, darkened as much.
enum class CatcherPicture { nothing, alpha, world };

/// The factor of light on catchers, height x width x 3; 1 where there are none. first: their first named pass.
/// [Cycles 4.5 kernel/film/read.h]
std::vector<float> shadow_catcher_factor(const Film& film, std::size_t first);

/// Combined, premultiplied, height x width x 4.
std::vector<float> read_catcher_picture(const Film& film, std::size_t first, CatcherPicture kind);

}  // namespace pivot
