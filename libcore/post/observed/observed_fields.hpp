// libcore/post/observed/observed_fields.hpp: public
// Fields of observations beside results: boulders, scars, outlines.
#pragma once

#include "base/fields.hpp"
#include "post/observed/observed.hpp"

namespace talus {

[[nodiscard]] const std::vector<Field<BoulderRow>>& boulder_fields();
[[nodiscard]] const std::vector<Field<ScarRow>>& scar_fields();

struct OutlineRow {
  const std::string& event;
  const OutlineScore& score;
};
[[nodiscard]] const std::vector<Field<OutlineRow>>& outline_fields();

}  // namespace talus
