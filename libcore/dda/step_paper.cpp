#include "dda/step_paper.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "contact/search.hpp"
#include "dda/displacement.hpp"
#include "dda/newton.hpp"
#include "dda/rotation.hpp"
#include "dda/step.hpp"
#include "dda/substep.hpp"

namespace talus {
namespace {

using std::size_t;

constexpr int most_passes = 6;  // of Shi's open-close iteration

/// The block's part of Eq. (3) without contacts, in local axes.
template <int Dof>
struct Equations {
  using Vec = Eigen::Matrix<double, Dof, 1>;
  using Mat = Eigen::Matrix<double, Dof, Dof>;
  Mat K;
  Vec F;
  Vec velocity;  // at the start of the step
  Mat3 R;        // body to local axes at the start
};

Mat3 strain_tensor(const Vec6& e) {
  return (Mat3() << e[0], e[5] / 2, e[4] / 2, e[5] / 2, e[1], e[3] / 2, e[4] / 2, e[3] / 2, e[2])
      .finished();
}
Vec6 strain_vector(const Mat3& E) {
  return (Vec6() << E(0, 0), E(1, 1), E(2, 2), 2 * E(1, 2), 2 * E(0, 2), 2 * E(0, 1)).finished();
}

// T_i at `arm`, its first Dof columns.
template <int Dof>
Eigen::Matrix<double, 3, Dof> displacement(const Vec3& arm) {
  return displacement_matrix(arm).template leftCols<Dof>();
}

// Inertia, elasticity, initial stress and loads: theory 1.5 and 1.8.
template <int Dof>
Equations<Dof> equations(const Scene& scene, int b, const State& state) {
  const auto i = static_cast<size_t>(b);
  const Blocks& blocks = scene.blocks;
  const double dt = scene.settings.dt, volume = blocks.volume[i];
  const Motion& m = state.motion[i];
  Equations<Dof> eq;
  eq.R = m.pose.attitude.toRotationMatrix();
  const Mat3 S = eq.R * blocks.second_moment[i].asDiagonal() * eq.R.transpose();
  const Mat12 M12 = mass_matrix(blocks.mass[i] / volume, volume, S);
  const auto M = M12.template topLeftCorner<Dof, Dof>();
  eq.velocity.template head<6>() << m.velocity,
      angular_velocity(m.pose.attitude, m.angular_momentum, blocks.inertia[i]);
  eq.F.setZero();
  eq.F.template head<3>() =
      blocks.mass[i] * free_acceleration(scene, b, state.time, state.time + dt);
  for (const PointLoad& load : scene.loads) {
    if (load.block != b) continue;
    const typename Equations<Dof>::Vec full =
        displacement<Dof>(eq.R * load.point).transpose() * load.force;
    eq.F.template tail<Dof - 3>() += full.template tail<Dof - 3>();
  }
  eq.K = 2 / (dt * dt) * M;
  if constexpr (Dof == 12) {
    const Mat6 C = elastic_matrix(blocks.young[i], blocks.poisson[i]);
    eq.velocity.template tail<6>() =
        strain_vector(eq.R * strain_tensor(state.strain_rate[i]) * eq.R.transpose());
    eq.K.template bottomRightCorner<6, 6>() += volume * C;
    Vec6 stress = C * strain_vector(eq.R * strain_tensor(state.strain[i]) * eq.R.transpose());
    if (!blocks.initial_stress.empty()) stress += blocks.initial_stress[i];
    eq.F.template tail<6>() -= volume * stress;
  }
  eq.F += 2 / dt * (M * eq.velocity);
  return eq;
}

/// A contact during open-close: how it enters Eq. (3).
struct Spring {
  double gap = 0;  // at the pass's solution, > 0 open
  Vec3 shear;      // s_n + P T D at the pass's solution
  double N = 0;    // normal force of the pass before
  Vec3 direction;  // e_s of the pass before
};

ContactState judge(const ContactRow& row, const Spring& spring, double k_n, double k_s,
                   ContactState before) {
  if (spring.gap >= row.tension_impulse / k_n) return ContactState::open;  // criterion 1
  const double N = std::max(0.0, -k_n * spring.gap);
  const double bound = row.friction * N + row.cohesion_impulse;
  const double slip = spring.shear.norm();
  if (before == ContactState::slip)  // sticks again when the sliding turns back
    return spring.shear.dot(spring.direction) - row.shear.dot(spring.direction) < 0 &&
                   k_s * slip <= bound
               ? ContactState::stick
               : ContactState::slip;
  return k_s * slip > bound ? ContactState::slip : ContactState::stick;  // criteria 2, 3
}

template <int Dof>
struct OpenClose {
  const Scene& scene;
  Work& work;
  Equations<Dof> eq;
  double k_n, k_s;
  typename Equations<Dof>::Vec D;

  Eigen::Matrix<double, 3, Dof> T(const ContactRow& row) const {
    return displacement<Dof>(row.point);
  }

  // (17), (20), (24) of the closed contacts, then (3).
  void solve() {
    typename Equations<Dof>::Mat K = eq.K;
    typename Equations<Dof>::Vec F = eq.F;
    for (const ContactRow& row : work.rows) {
      if (row.state == ContactState::open) continue;
      const auto T_a = T(row);
      const Vec3& n = row.normal;
      const typename Equations<Dof>::Vec G = -T_a.transpose() * n;  // (12)-(14) in one
      K += k_n * G * G.transpose();                                 // (17a)
      F += k_n * row.gap_start * G;                                 // (17b), d_0 = -gap
      if (row.state == ContactState::stick) {
        const Mat3 N = Mat3::Identity() - n * n.transpose();
        K += k_s * T_a.transpose() * N * T_a;    // (20a)
        F -= k_s * T_a.transpose() * row.shear;  // (20b)
      } else {
        F -= row.held_cap * T_a.transpose() * row.slip_start;  // (24)
      }
    }
    D = K.ldlt().solve(F);
  }

  // The patterns of Fig. 8 at the solution; number of contacts that switched.
  int set_states() {
    int switched = 0;
    for (ContactRow& row : work.rows) {
      const Vec3 moved = T(row) * D;
      const Vec3& n = row.normal;
      Spring spring;
      spring.gap = row.gap_start + n.dot(moved);
      spring.shear = row.shear + moved - n.dot(moved) * n;
      spring.direction = row.slip_start;
      const ContactState state = judge(row, spring, k_n, k_s, row.state);
      switched += state != row.state;
      row.state = state;
      const double slip = spring.shear.norm();
      if (slip > 0) row.slip_start = spring.shear / slip;
      row.held_cap = row.friction * std::max(0.0, -k_n * spring.gap);
      if (state == ContactState::stick) row.held_cap += row.cohesion_impulse;
    }
    return switched;
  }
};

void make_rows(const Scene& scene, const State& state, int b, const Mat3& R, Work& work) {
  const std::vector<ContactMemory>& memory = state.memory[static_cast<size_t>(b)];
  work.rows.clear();
  for (size_t i = 0; i < work.contacts.size(); ++i) {
    const Contact& contact = work.contacts[i];
    const GroundClass& ground = scene.ground.classes[static_cast<size_t>(contact.ground_class)];
    ContactRow row;
    row.contact = static_cast<int>(i);
    row.normal = contact.normal;
    row.point = R * contact.point_a;
    row.gap_start = contact.gap;
    row.friction = ground.friction;
    row.state = contact.gap < 0 ? ContactState::stick : ContactState::open;
    for (size_t m = 0; m < memory.size(); ++m) {
      if (!(memory[m].key == contact.key)) continue;
      row.memory = static_cast<int>(m);
      row.shear = memory[m].shear - contact.normal.dot(memory[m].shear) * contact.normal;
      row.slip_start = memory[m].slip_direction;
      row.held_cap = ground.friction * memory[m].normal_force;
      row.state = static_cast<ContactState>(memory[m].state);
      row.bond_area = memory[m].bond_area;
    }
    row.cohesion_impulse = ground.cohesion * row.bond_area;  // here forces: nothing is times dt
    row.tension_impulse = ground.tension * row.bond_area;
    work.rows.push_back(row);
  }
}

// What closed contacts keep: a sticking one its spring, a slipping one its direction.
template <int Dof>
void remember(const OpenClose<Dof>& solved, State& state, Work& work, int b, StepReport& report) {
  work.memory_next.clear();
  for (const ContactRow& row : work.rows) {
    if (row.state == ContactState::open) continue;
    const Vec3 moved = solved.T(row) * solved.D;
    const double along = row.normal.dot(moved);
    ContactMemory memory;
    memory.key = work.contacts[static_cast<size_t>(row.contact)].key;
    memory.normal = row.normal;
    memory.gap_end = row.gap_start + along;
    memory.normal_force = std::max(0.0, -solved.k_n * memory.gap_end);
    memory.slip_direction = row.slip_start;
    const bool sticks = row.state == ContactState::stick;
    if (sticks) memory.shear = row.shear + moved - along * row.normal;
    memory.bond_area = sticks ? row.bond_area : 0;
    memory.state = static_cast<std::uint8_t>(row.state);
    work.memory_next.push_back(memory);
    ++report.n_closed;
    note_penetration(report, -memory.gap_end,
                     solved.scene.blocks.shapes.thickness[static_cast<size_t>(b)]);
    state.ledger.contact -= memory.normal_force * along;
    if (!sticks)
      state.ledger.friction += row.held_cap * (moved - along * row.normal).dot(row.slip_start);
  }
  std::vector<ContactMemory>& memory = state.memory[static_cast<size_t>(b)];
  report.n_flips += count_flips(work.rows, memory);
  std::swap(memory, work.memory_next);
}

// Eq. (28), v_a = COR v_b, on the normal component of the centroid's velocity, once a collision:
// v_b is kept when a free block first closes a contact, v_a set when its last contact opens again.
void post_adjust(const Scene& scene, int b, bool was_free, const Vec3& velocity_before,
                 const Work& work, State& state) {
  const auto i = static_cast<size_t>(b);
  const bool is_free = state.memory[i].empty();
  if (was_free && !is_free) {
    Vec3 normal = Vec3::Zero();
    for (const ContactMemory& memory : state.memory[i]) normal += memory.normal;
    normal.normalize();
    const double speed = -normal.dot(velocity_before);
    const double restitution =
        scene.ground.classes[static_cast<size_t>(work.contacts.front().ground_class)].restitution;
    const double resting = 2 * scene.gravity.norm() * scene.settings.dt;
    state.rebound[i] = speed > resting ? Vec3(restitution * speed * normal) : Vec3(Vec3::Zero());
  }
  if (was_free || !is_free || state.rebound[i].isZero(0)) return;
  const double wanted = state.rebound[i].norm();
  const Vec3 normal = state.rebound[i] / wanted;
  Vec3& v = state.motion[i].velocity;
  const Vec3 adjusted = v + (wanted - normal.dot(v)) * normal;
  state.ledger.impact += 0.5 * scene.blocks.mass[i] * (v.squaredNorm() - adjusted.squaredNorm());
  v = adjusted;
  state.rebound[i].setZero();
}

template <int Dof>
void advance(const Scene& scene, int b, State& state, Work& work, StepReport& report) {
  const auto i = static_cast<size_t>(b);
  const double dt = scene.settings.dt, radius = scene.blocks.shapes.radius[i];
  const Motion before = state.motion[i];
  OpenClose<Dof> solver{scene,
                        work,
                        equations<Dof>(scene, b, state),
                        scene.settings.normal_stiffness,
                        scene.settings.normal_stiffness * scene.settings.shear_ratio,
                        {}};
  const double spin = solver.eq.velocity.template segment<3>(3).norm();
  const double ctol =
      1.5 * dt * (before.velocity.norm() + spin * radius + scene.gravity.norm() * dt) +
      1e-9 * radius;
  Mat3 stretch = Mat3::Identity();
  if constexpr (Dof == 12) stretch += strain_tensor(state.strain[i]);
  const SearchResult near = find_contacts(scene.ground, scene.blocks.shapes, b, before.pose,
                                          stretch, ctol, work.world_vertices, work.contacts);
  if (near.reach == Reach::below) report.flags = report.flags | StepFlag::fell_through;
  make_rows(scene, state, b, solver.eq.R, work);
  int passes = 0, switched = 1;
  while (switched > 0 && passes < most_passes) {
    solver.solve();
    switched = solver.set_states();
    ++passes;
  }
  if (switched > 0) ++report.n_unconverged, report.flags = report.flags | StepFlag::unconverged;
  report.passes += passes;
  ++report.substeps;
  const bool was_free = state.memory[i].empty();
  remember(solver, state, work, b, report);

  const auto& D = solver.D;
  const typename Equations<Dof>::Vec velocity = 2 / dt * D - solver.eq.velocity;
  Motion& m = state.motion[i];
  m.pose.position += D.template head<3>();
  m.pose.attitude = (rotation_by(D.template segment<3>(3)) * m.pose.attitude).normalized();
  m.velocity = velocity.template head<3>();
  m.angular_momentum =
      angular_momentum(m.pose.attitude, velocity.template segment<3>(3), scene.blocks.inertia[i]);
  if constexpr (Dof == 12) {
    const Mat3& R = solver.eq.R;
    state.strain[i] += strain_vector(R.transpose() * strain_tensor(D.template tail<6>()) * R);
    state.strain_rate[i] =
        strain_vector(R.transpose() * strain_tensor(velocity.template tail<6>()) * R);
  }
  if (scene.settings.post_adjustment) post_adjust(scene, b, was_free, before.velocity, work, state);
  Segment segment;
  segment.block = b;
  segment.flight = work.rows.empty();
  segment.t_start = state.time;
  segment.t_end = state.time + dt;
  segment.start = before;
  segment.end = m;
  segment.acceleration =
      2 / (dt * dt) * (m.pose.position - before.pose.position - dt * before.velocity);
  work.segments.push_back(segment);
  state.local_time[i] = state.time + dt;
}

}  // namespace

void advance_block_paper(const Scene& scene, int b, State& state, Work& work, StepReport& report) {
  if (scene.settings.strains)
    advance<12>(scene, b, state, work, report);
  else
    advance<6>(scene, b, state, work, report);
}

}  // namespace talus
