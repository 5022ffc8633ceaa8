// libcore/report/doubts_html.hpp
// Doubts on a page: a numbered line each, a kind together, with its remedy. Places of the kind
// have its number on a map.
#pragma once

#include <string>
#include <vector>

#include "base/doubt.hpp"

namespace talus {

/// HTML. Doubts that were mended or accepted are marked. `if_none`: the text without any.
[[nodiscard]] std::string doubts_html(const std::vector<Doubt>& doubts, const std::string& if_none);

/// A place of a doubt, or the corners of its extent, in plan, from `origin` on.
struct DoubtMark {
  int number = 0;  ///< of its line
  std::vector<Vec2> at;
  std::string title;
};
[[nodiscard]] std::vector<DoubtMark> marks_of(const std::vector<Doubt>& doubts, const Vec3& origin);

}  // namespace talus
