// An island of touching bodies: assembly of pairs and rows, and lanes of contacts.
#include "solver/island.hpp"

#include "base/make_room.hpp"

namespace talus {

void open_pair(int a, int b, Island& island) {
  const int at = 2 * static_cast<int>(island.rows.size());
  BodyPair& pair = island.pairs.emplace_back();
  pair.a = a;
  pair.b = b;
  pair.row_begin = pair.row_end = at;
  if (b >= 0) pair.shift = island.position[a] - island.position[b];
}

namespace {

// As lanes have it: the drift is a known part of the point's velocity, and a contact that waits to
// be hit keeps its place and its strength, but presses nothing.
LawRow<double> law_in_lane(const ContactRow& contact) {
  LawRow<double> law = contact;
  if (contact.waits) {
    law.shear_velocity.setZero(), law.slip_start.setZero();
    law.bias = law.normal_damping = law.shear_damping = law.cohesion = law.tension = 0;
    return law;
  }
  const double along = contact.normal.dot(contact.drift);
  law.shear_velocity += contact.drift - along * contact.normal;
  law.bias += along;
  law.normal_tangent = law.normal_damping;
  return law;
}

}  // namespace

int add_row(const ContactRow& contact, Island& island) {
  BodyPair& pair = island.pairs.back();
  const int r = pair.row_end++;
  if (r % 2 == 0) {
    make_room(island.rows);
    island.rows.emplace_back();
  }
  const IslandRow row = row_of(island, r);
  row.set_law(law_in_lane(contact));
  row.set_arm(contact.arm);
  return r;
}

}  // namespace talus
