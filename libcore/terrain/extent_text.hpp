// libcore/terrain/extent_text.hpp: public
// Where a terrain lies, in the words of messages.
#pragma once

#include <string>

#include "terrain/trn.hpp"

namespace talus {

/// "the terrain covers x 248363 to 249217, y 351036 to 351760": its nodes in map coordinates [m].
[[nodiscard]] std::string extent_text(const Trn& trn);
/// "248363.5, 351036.25": a place in map coordinates; `origin` of its terrain [m].
[[nodiscard]] std::string place_text(const Vec2& local, const Vec3& origin);

}  // namespace talus
