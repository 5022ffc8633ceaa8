#include "dda/island.hpp"

#include "base/make_room.hpp"

namespace talus {

void open_pair(int a, int b, Island& island) {
  const int at = 2 * static_cast<int>(island.rows.size());
  island.pairs.push_back({a, b, at, at, true});
}

namespace {

// What makes a contact press. The drift is a known part of its point's velocity.
void set_law(const ContactRow& contact, const RowIn<RowGroup>& lane) {
  const double along = contact.normal.dot(contact.drift);
  lane.set_vector(&RowGroup::shear_velocity,
                  contact.shear_velocity + (contact.drift - along * contact.normal));
  lane.set_vector(&RowGroup::slip_start, contact.slip_start);
  lane.set(&RowGroup::bias, contact.bias + along);
  lane.set(&RowGroup::normal_damping, contact.normal_damping);
  lane.set(&RowGroup::shear_damping, contact.shear_damping);
  lane.set(&RowGroup::cohesion, contact.cohesion_impulse);
  lane.set(&RowGroup::tension, contact.tension_impulse);
  lane.set(&RowGroup::normal_tangent, contact.normal_damping);
}

}  // namespace

int add_row(const ContactRow& contact, Island& island) {
  BodyPair& pair = island.pairs.back();
  const int r = pair.row_end++;
  if (r % 2 == 0) {
    make_room(island.rows);
    RowGroup& group = island.rows.emplace_back();
    group.normal_limit = Two{no_normal_limit, no_normal_limit};
  }
  const RowIn<RowGroup> lane = row_of(island, r);
  lane.set_vector(&RowGroup::normal, contact.normal);
  lane.set_vector(&RowGroup::arm, contact.arm);
  lane.set(&RowGroup::friction, contact.friction);
  lane.set(&RowGroup::normal_limit, contact.normal_limit);
  lane.set_vector(&RowGroup::impulse, contact.impulse);
  lane.set_state(contact.state);
  if (!contact.waits) set_law(contact, lane);
  return r;
}

}  // namespace talus
