// tests/unit/dda/as_contact_row.hpp
// Rows of an island one by one, and as the contact law of one row takes them, to compare the two.
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

inline IslandRow row_at(const Island& island, int r) {
  const RowIn<const RowGroup> of = row_of(island, r);
  IslandRow out;
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

inline ContactRow as_contact_row(const IslandRow& row) {
  ContactRow out;
  out.normal = row.normal;
  out.point = row.arm;
  out.shear_velocity = row.shear_velocity;
  out.slip_start = row.slip_start;
  out.bias = row.bias;
  out.normal_damping = row.normal_damping;
  out.shear_damping = row.shear_damping;
  out.friction = row.friction;
  out.cohesion_impulse = row.cohesion_impulse;
  out.tension_impulse = row.tension_impulse;
  out.normal_limit = row.normal_limit;
  return out;
}

}  // namespace talus::test
