// Stage 4 of an island's step: each member without contact.
#include "step/island/stages.hpp"
#include "step/substep.hpp"

namespace talus {
namespace {

using std::size_t;

// Mass, free velocity, first guess of the velocity, and where the member's impulses act.
void add_predicted(const Scene& scene, const State& state, const BlockNumbers& c, const Substep& s,
                   const FreeTurn& turn, size_t b, Island& island) {
  Vec6 free, guess;
  free << s.free.velocity, turn.spin_end;
  if (c.stands || state.acceleration[b] == scene.gravity)  // nothing pressed it
    guess = free;
  else
    guess << s.start.velocity + s.h * state.acceleration[b],
        turn.spin_start + s.h * (s.R * state.spin_rate[b]);
  Mat6 M = Mat6::Zero();
  M.topLeftCorner<3, 3>().diagonal().setConstant(c.mass);
  M.bottomRightCorner<3, 3>() = s.R * c.inertia.asDiagonal() * s.R.transpose();
  if (c.stands) M /= share_of_standing_mass;
  island.mass.push_back(M);
  island.free_velocity.push_back(free);
  island.velocity.push_back(guess);
  island.position.push_back((s.start.pose.position + s.free.pose.position) / 2);
  island.radius.push_back(c.radius);
}

// The substep of a fixed member.
Substep stand(const Pose& pose, double h) {
  Substep s;
  s.h = h;
  s.start.pose = s.free.pose = pose;
  s.R = s.R_start = pose.attitude.toRotationMatrix();
  return s;
}

void clear_bodies(Island& island) {
  island.mass.clear();
  island.free_velocity.clear();
  island.velocity.clear();
  island.position.clear();
  island.radius.clear();
}

}  // namespace

void predict_free(const Scene& scene, const State& state, const IslandMembers& members, double t,
                  double h, Workers* workers, FreeMotions& free) {
  free.t = t;
  free.h = h;
  free.substeps.resize(members.size());
  free.turns.resize(members.size());
  in_chunks(workers, members.size(), [&](size_t begin, size_t end) {
    for (size_t k = begin; k < end; ++k) {
      const BlockNumbers& c = members.numbers[k];
      Substep& s = free.substeps[k];
      s = c.stands ? stand(state.motion[members.block(k)].pose, h)
                   : predict(scene, members.blocks[k], c,
                             begin_drag(scene, state, members.block(k), h), t, h, state.pressure);
      free.turns[k] = {s.R * s.R_start.transpose(), s.R_start * s.spin_start, s.R * s.spin_free,
                       s.R * c.inverse_inertia.asDiagonal() * s.R.transpose()};
    }
  });
}

void predict(const Scene& scene, const State& state, const IslandMembers& members, double t,
             double h, FreeMotions& free, Island& island) {
  predict_free(scene, state, members, t, h, nullptr, free);
  clear_bodies(island);
  for (size_t k = 0; k < members.size(); ++k)
    add_predicted(scene, state, members.numbers[k], free.substeps[k], free.turns[k],
                  members.block(k), island);
}

}  // namespace talus
