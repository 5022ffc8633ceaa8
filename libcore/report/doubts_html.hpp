// libcore/report/doubts_html.hpp
// Doubts on a page: a numbered line each, a kind together, with its way out. Places of the kind
// have its number on a map.
#pragma once

#include <string>
#include <vector>

#include "base/doubt.hpp"

namespace talus {

/// HTML. What was mended, or accepted, says so. `if_none`: what is said without any.
[[nodiscard]] std::string doubts_html(const std::vector<Doubt>& doubts, const std::string& if_none);

/// A place of a doubt, or the corners of its extent, in plan, from `origin` on.
struct DoubtMark {
  int number = 0;  ///< of its line
  std::vector<Vec2> at;
  std::string title;
};
[[nodiscard]] std::vector<DoubtMark> marks_of(const std::vector<Doubt>& doubts, const Vec3& origin);

}  // namespace talus
