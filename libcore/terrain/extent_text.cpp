// The extent of a terrain as text of messages.
#include "terrain/extent_text.hpp"

#include "base/text.hpp"

namespace talus {

std::string extent_text(const Trn& trn) {
  const Vec2 first = (trn.origin + Vec3(trn.node0.x(), trn.node0.y(), 0)).head<2>();
  const Vec2 last = first + trn.cell_size * Vec2(trn.n_cols - 1, 1 - trn.n_rows);
  return "the terrain covers x " + text(first.x(), 10) + " to " + text(last.x(), 10) + ", y " +
         text(last.y(), 10) + " to " + text(first.y(), 10);
}

std::string place_text(const Vec2& local, const Vec3& origin) {
  return text(local.x() + origin.x(), 10) + ", " + text(local.y() + origin.y(), 10);
}

}  // namespace talus
