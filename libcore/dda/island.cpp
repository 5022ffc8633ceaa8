#include "dda/island.hpp"

#include "base/make_room.hpp"

namespace talus {

void open_pair(int a, int b, Island& island) {
  const int at = 2 * static_cast<int>(island.rows.size());
  island.pairs.push_back({a, b, at, at, true});
}

int add_row(const IslandRow& row, Island& island) {
  BodyPair& pair = island.pairs.back();
  const int r = pair.row_end++;
  if (r % 2 == 0) {
    make_room(island.rows);
    RowGroup& group = island.rows.emplace_back();
    group.normal_limit = Two{no_normal_limit, no_normal_limit};
  }
  const RowIn<RowGroup> out = row_of(island, r);
  out.set_vector(&RowGroup::normal, row.normal);
  out.set_vector(&RowGroup::arm, row.arm);
  out.set_vector(&RowGroup::shear_velocity, row.shear_velocity);
  out.set_vector(&RowGroup::slip_start, row.slip_start);
  out.set_vector(&RowGroup::impulse, row.impulse);
  out.set(&RowGroup::bias, row.bias);
  out.set(&RowGroup::normal_damping, row.normal_damping);
  out.set(&RowGroup::shear_damping, row.shear_damping);
  out.set(&RowGroup::friction, row.friction);
  out.set(&RowGroup::cohesion, row.cohesion_impulse);
  out.set(&RowGroup::tension, row.tension_impulse);
  out.set(&RowGroup::normal_limit, row.normal_limit);
  out.set(&RowGroup::normal_tangent, row.normal_damping);
  out.set_state(row.state);
  return r;
}

}  // namespace talus
