// tests/unit/dda/as_contact_row.hpp
// A row of an island as the contact law of one row takes it, to compare the two.
#pragma once

#include "dda/contact_row.hpp"
#include "dda/island.hpp"

namespace talus::test {

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
