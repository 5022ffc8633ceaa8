// tests/unit/dda/rows_of_island.hpp
// Contacts of an island one by one, read from their lanes.
#pragma once

#include <vector>

#include "dda/contact_row.hpp"
#include "dda/island.hpp"

namespace talus::test {

/// Numbers of all rows, pair by pair.
inline std::vector<int> row_numbers(const Island& island) {
  std::vector<int> numbers;
  for (const BodyPair& pair : island.pairs)
    for (int r = pair.row_begin; r < pair.row_end; ++r) numbers.push_back(r);
  return numbers;
}

inline ContactRow row_at(const Island& island, int r) {
  const RowIn<const RowGroup> of = row_of(island, r);
  ContactRow out;
  out.normal = of.normal();
  out.arm = of.arm();
  out.shear_velocity = of.vector(&RowGroup::shear_velocity);
  out.slip_start = of.vector(&RowGroup::slip_start);
  out.bias = of.bias();
  out.normal_damping = of.normal_damping();
  out.shear_damping = of.shear_damping();
  out.friction = of.value(&RowGroup::friction);
  out.cohesion_impulse = of.value(&RowGroup::cohesion);
  out.tension_impulse = of.value(&RowGroup::tension);
  out.normal_limit = of.normal_limit();
  out.impulse = of.impulse();
  out.state = of.state();
  return out;
}

}  // namespace talus::test
