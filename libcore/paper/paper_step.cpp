// Law paper: one step of an island by penalty springs and open-close iteration.
#include "paper/paper_step.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "base/error.hpp"
#include "contact/search.hpp"
#include "motion/displacement.hpp"
#include "motion/rotation.hpp"
#include "scene/bonds.hpp"
#include "solver/flips.hpp"
#include "step/deep_blocks.hpp"
#include "step/island/step_island.hpp"
#include "step/loads.hpp"
#include "step/settle.hpp"
#include "step/step.hpp"
#include "step/substep.hpp"

namespace talus {
namespace {

using std::size_t;

constexpr int most_passes = 6;        // of Shi's open-close iteration
constexpr double offset_speed = 0.3;  // at which overlap that a contact appears with is pressed out

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
BlockEquations<Dof> equations(const Scene& scene, int b, const State& state) {
  const auto i = static_cast<size_t>(b);
  const Blocks& blocks = scene.blocks;
  const double dt = scene.settings.dt, volume = blocks.volume[i];
  const Motion& m = state.motion[i];
  BlockEquations<Dof> eq;
  eq.R = m.pose.attitude.toRotationMatrix();
  const Mat3 S = eq.R * blocks.second_moment[i].asDiagonal() * eq.R.transpose();
  const Mat12 M12 = mass_matrix(blocks.mass[i] / volume, volume, S);
  const auto M = M12.template topLeftCorner<Dof, Dof>();
  eq.velocity.template head<6>() << m.velocity,
      angular_velocity(m.pose.attitude, m.angular_momentum, blocks.inertia[i]);
  eq.F.setZero();
  eq.F.template head<3>() =
      blocks.mass[i] * free_acceleration(scene, b, state.time, state.time + dt, state.pressure);
  for (const PointLoad& load : loads_on(scene, b)) {
    const typename BlockEquations<Dof>::Vec full =
        displacement<Dof>(eq.R * load.point).transpose() * force_of(load, state.pressure);
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

// The pattern of a contact at a pass's solution: `gap` > 0 open, `shear` = s_n + P T D.
ContactState judge(const PaperContact& contact, double gap, const Vec3& shear, double k_n,
                   double k_s) {
  if (gap >= contact.tension_force / k_n) return ContactState::open;  // criterion 1
  const double bound = contact.friction * std::max(0.0, -k_n * gap) + contact.cohesion_force;
  const Vec3& along = contact.slip_direction;  // of the pass before
  const bool turns_back = shear.dot(along) - contact.shear.dot(along) < 0;
  if (contact.state == ContactState::slip && !turns_back) return ContactState::slip;
  return k_s * shear.norm() > bound ? ContactState::slip : ContactState::stick;  // criteria 2, 3
}

/// The blocks of an island over one step: Eq. (3) and the contacts among them and with the ground.
template <int Dof>
struct OpenClose {
  using Vec = typename BlockEquations<Dof>::Vec;
  using Mat = typename BlockEquations<Dof>::Mat;
  const Scene& scene;
  State& state;
  Work& work;
  PaperLaw& paper;
  StepReport& report;
  OpenCloseWork<Dof>& w;
  std::span<const int> members;                           // ascending
  std::span<const int> manifolds = paper.work.manifolds;  // sorted by block A, then B
  double k_n = scene.settings.normal_stiffness, k_s = k_n * scene.settings.shear_ratio;

  static Eigen::Matrix<double, 3, Dof> T(const Vec3& arm) { return displacement<Dof>(arm); }

  // Movement of A's point relative to B's.
  [[nodiscard]] Vec3 moved(size_t r) const {
    const PaperContact& contact = w.contacts[r];
    const Vec3 of_a = T(contact.arm_a) * w.D[contact.a];
    if (contact.b < 0) return of_a;
    return of_a - T(contact.arm_b) * w.D[contact.b];
  }

  // (17), (20), (24) of a closed contact: its stiffness as seen by the relative movement, and the
  // force on A.
  void contact_terms(const PaperContact& contact, Mat3& stiffness, Vec3& force) const {
    const Vec3& n = contact.normal;
    const Mat3 nn = n * n.transpose();
    stiffness = k_n * nn;                                     // (17a)
    force = -k_n * (contact.gap_start + contact.offset) * n;  // (17b), d_0 = -gap
    if (contact.state == ContactState::stick) {
      stiffness += k_s * (Mat3::Identity() - nn);  // (20a)
      force -= k_s * contact.shear;                // (20b)
    } else {
      force -= contact.held_friction * contact.slip_direction;  // (24)
    }
  }

  // (3) with all closed contacts.
  void solve() {
    BlockLu<Dof>& lu = w.lu;
    w.edges.clear();
    for (const PaperContact& contact : w.contacts) {
      const std::pair<int, int> edge(contact.a, contact.b);
      if (contact.b >= 0 && (w.edges.empty() || w.edges.back() != edge)) w.edges.push_back(edge);
    }
    analyse_pattern(static_cast<int>(members.size()), w.edges, lu.pattern);
    clear_matrix(lu);
    const auto diagonal = [&](int k) -> Mat& { return lu.diagonal[lu.pattern.place[k]]; };
    for (size_t k = 0; k < members.size(); ++k) {
      diagonal(static_cast<int>(k)) = w.equations[k].K;
      w.D[k] = w.equations[k].F;
    }
    for (const PaperContact& contact : w.contacts) {
      if (contact.state == ContactState::open) continue;
      Mat3 stiffness;
      Vec3 force;
      contact_terms(contact, stiffness, force);
      const auto T_a = T(contact.arm_a);
      diagonal(contact.a) += T_a.transpose() * stiffness * T_a;
      w.D[contact.a] += T_a.transpose() * force;
      if (contact.b < 0) continue;
      const auto T_b = T(contact.arm_b);
      diagonal(contact.b) += T_b.transpose() * stiffness * T_b;
      w.D[contact.b] -= T_b.transpose() * force;
      const Mat ab = -T_a.transpose() * stiffness * T_b;
      add_blocks<Dof>(lu, contact.a, contact.b, ab, ab.transpose());
    }
    factor(lu);
    talus::solve<Dof>(lu, w.D, w.D);
  }

  // The patterns of Fig. 8 at the solution; number of contacts that switched.
  int set_states() {
    int switched = 0;
    for (size_t r = 0; r < w.contacts.size(); ++r) {
      PaperContact& contact = w.contacts[r];
      const Vec3 path = moved(r);
      const Vec3& n = contact.normal;
      const double gap = contact.gap_start + contact.offset + n.dot(path);
      const Vec3 shear = contact.shear + path - n.dot(path) * n;
      const ContactState judged = judge(contact, gap, shear, k_n, k_s);
      switched += judged != contact.state;
      contact.state = judged;
      const double slip = shear.norm();
      if (slip > 0) contact.slip_direction = shear / slip;
      contact.held_friction = contact.friction * std::max(0.0, -k_n * gap);
      if (judged == ContactState::stick) contact.held_friction += contact.cohesion_force;
    }
    return switched;
  }

  // Start of a contact: from the memory of the same features, if there is one.
  void start_contact(const GroundClass& face, PaperContact& contact) {
    const std::vector<ContactMemory>& memory = state.memory[members[contact.a]];
    const bool closed = contact.gap_start < 0 || contact.bond >= 0;
    contact.friction = face.friction;
    contact.state = closed ? ContactState::stick : ContactState::open;
    contact.offset = std::max(0.0, -contact.gap_start);
    // a vertex in a valley has a contact on either side of it, both with the vertex's key
    double nearest = -1;
    for (size_t m = 0; m < memory.size(); ++m) {
      if (!(memory[m].key == contact.key) || memory[m].normal.dot(contact.normal) <= nearest)
        continue;
      nearest = memory[m].normal.dot(contact.normal);
      contact.memory = static_cast<int>(m);
    }
    if (contact.memory >= 0) inherit(memory[contact.memory], contact);
    contact.cohesion_force = face.cohesion * contact.bond_area;
    contact.tension_force = face.tension * contact.bond_area;
  }

  static void inherit(const ContactMemory& last, PaperContact& contact) {
    contact.state = static_cast<ContactState>(last.state);
    if (contact.state == ContactState::slip)
      contact.slip_direction = last.shear;
    else
      contact.shear = last.shear - contact.normal.dot(last.shear) * contact.normal;
    contact.offset = last.offset;
    contact.held_friction = contact.friction * last.normal_force;
    if (contact.bond < 0) contact.bond_area = last.bond_area;
    // a bond that has failed has no area
    if (contact.bond_area > 0) contact.state = ContactState::stick;
  }

  void add_ground(size_t k) {
    const int b = members[k];
    const auto i = static_cast<size_t>(b);
    const double dt = scene.settings.dt, radius = scene.blocks.shapes.radius[i];
    const Vec& velocity = w.equations[k].velocity;
    const double reach =
        1.5 * dt *
            (velocity.template head<3>().norm() + velocity.template segment<3>(3).norm() * radius +
             scene.gravity.norm() * dt) +
        1e-9 * radius;
    Mat3 stretch = Mat3::Identity();
    if constexpr (Dof == 12) stretch += strain_tensor(state.strain[i]);
    const SearchResult near =
        find_contacts(scene.ground, scene.blocks.shapes, b, state.motion[i].pose, stretch, reach,
                      work.world_vertices, work.contacts, &work.near_ground[i]);
    if (near.reach == Reach::below) report.flags = report.flags | StepFlag::fell_through;
    if (near.reach == Reach::off_ground) w.outsiders.push_back(b);
    for (const Contact& found : work.contacts) {
      PaperContact& contact = w.contacts.emplace_back();
      contact.key = found.key;
      contact.a = static_cast<int>(k);
      contact.ground_class = found.ground_class;
      contact.normal = found.normal;
      contact.arm_a = w.equations[k].R * found.point_a;
      contact.gap_start = found.gap;
      start_contact(scene.ground.classes[found.ground_class], contact);
    }
  }

  [[nodiscard]] size_t place_of(int block) const {
    return static_cast<size_t>(work.search.groups.local_index[block]);
  }
  [[nodiscard]] const Vec3& position(int block) const { return state.motion[block].pose.position; }

  void add_pair(const PairManifold& m) {
    const int bond = find_bond(state.bonds, m.block_a, m.block_b,
                               state.motion[m.block_a].pose.attitude, m.normal);
    const GroundClass face = bond >= 0 ? state.bonds[bond].face : pair_class(scene, m);
    for (int p = m.point_begin; p < m.point_end; ++p) {
      const PairPoint& point = work.search.pairs.points[p];
      PaperContact& contact = w.contacts.emplace_back();
      contact.key = point.key;
      contact.key.body_b = m.block_b;
      contact.a = static_cast<int>(place_of(m.block_a));
      contact.b = static_cast<int>(place_of(m.block_b));
      contact.bond = bond;
      contact.normal = m.normal;
      contact.arm_a = point.point_b + point.gap * m.normal - position(m.block_a);
      contact.arm_b = point.point_b - position(m.block_b);
      contact.gap_start = point.gap;
      if (bond >= 0) contact.bond_area = point.area;
      start_contact(face, contact);
    }
  }

  // Equations, then contacts member by member: with the ground, then with later members.
  void assemble() {
    w.equations.clear();
    w.contacts.clear();
    w.contact_begin.clear();
    w.outsiders.clear();
    w.D.resize(members.size());
    for (const int b : members) w.equations.push_back(equations<Dof>(scene, b, state));
    auto next = manifolds.begin();
    for (size_t k = 0; k < members.size(); ++k) {
      w.contact_begin.push_back(w.contacts.size());
      add_ground(k);
      for (; next != manifolds.end(); ++next) {
        const PairManifold& m = work.search.pairs.manifolds[*next];
        if (m.block_a != members[k]) break;
        add_pair(m);
      }
    }
    w.contact_begin.push_back(w.contacts.size());
  }

  void iterate() {
    int passes = 0, switched = 1;
    while (switched > 0 && passes < most_passes) {
      solve();
      switched = set_states();
      ++passes;
    }
    if (switched > 0) {
      note_unconverged(members.front(), report);
      report.flags = report.flags | StepFlag::unconverged;
    }
    report.passes += passes;
  }

  // Memory of a closed contact: in ContactMemory::shear a sticking one keeps its spring, a slipping
  // one its direction.
  void remember_contact(size_t r, std::vector<ContactMemory>& memories) {
    const PaperContact& contact = w.contacts[r];
    const bool sticks = contact.state == ContactState::stick;
    if (contact.bond >= 0 && !sticks) state.bonds[contact.bond].area = 0;
    const Vec3 path = moved(r);
    const double along = contact.normal.dot(path), overlap = -(contact.gap_start + along);
    if (contact.state == ContactState::open && contact.offset <= 0) return;
    const std::vector<double>& thickness = scene.blocks.shapes.thickness;
    const int a = members[contact.a], b = contact.b < 0 ? a : members[contact.b];
    const int thinner = thickness[b] < thickness[a] ? b : a;
    note_overlap(thinner, overlap, thickness[thinner], work.deep, report);
    if (contact.state == ContactState::open) return;
    ContactMemory memory;
    memory.key = contact.key;
    memory.normal = contact.normal;
    memory.gap_end = contact.gap_start + contact.offset + along;
    memory.offset = std::max(0.0, contact.offset - offset_speed * scene.settings.dt);
    memory.normal_force = std::max(0.0, -k_n * memory.gap_end);
    memory.shear =
        sticks ? Vec3(contact.shear + path - along * contact.normal) : contact.slip_direction;
    memory.bond_area = sticks && contact.bond < 0 ? contact.bond_area : 0;
    memory.state = static_cast<std::uint8_t>(contact.state);
    memories.push_back(memory);
    ++report.n_closed;
    report.sum_penetration += std::max(overlap, 0.0);
    state.ledger.contact -= memory.normal_force * along;
    if (!sticks)
      state.ledger.friction +=
          contact.held_friction * (path - along * contact.normal).dot(contact.slip_direction);
  }

  void remember() {
    for (size_t k = 0; k < members.size(); ++k) {
      std::vector<ContactMemory>& memory = state.memory[members[k]];
      FlipCounter flips(memory);
      for (size_t r = w.contact_begin[k]; r < w.contact_begin[k + 1]; ++r)
        flips.add(w.contacts[r].memory, w.contacts[r].state);
      report.n_flips += flips.total();
      memory.clear();
      for (size_t r = w.contact_begin[k]; r < w.contact_begin[k + 1]; ++r)
        remember_contact(r, memory);
    }
  }

  [[nodiscard]] bool touches_nothing(size_t k) const {
    return std::none_of(w.contacts.begin(), w.contacts.end(), [&](const PaperContact& contact) {
      return contact.a == static_cast<int>(k) || contact.b == static_cast<int>(k);
    });
  }

  // Newmark with beta = 1/2, gamma = 1: v' = 2 D / dt - v.
  void move(size_t k) {
    const int b = members[k];
    const auto i = static_cast<size_t>(b);
    const double dt = scene.settings.dt;
    const Motion before = state.motion[i];
    const Vec& D = w.D[k];
    const Vec velocity = 2 / dt * D - w.equations[k].velocity;
    Motion& m = state.motion[i];
    m.pose.position += D.template head<3>();
    m.pose.attitude = (rotation_by(D.template segment<3>(3)) * m.pose.attitude).normalized();
    const Vec3 loads = book_loads(scene, b, before.pose, m.pose, state);
    const Vec3 external =
        free_acceleration(scene, b, state.time, state.time + dt, state.pressure) - scene.gravity;
    state.ledger.base += (scene.blocks.mass[i] * external - loads).dot(D.template head<3>());
    m.velocity = velocity.template head<3>();
    m.angular_momentum =
        angular_momentum(m.pose.attitude, velocity.template segment<3>(3), scene.blocks.inertia[i]);
    if constexpr (Dof == 12) {
      const Mat3& R = w.equations[k].R;
      state.strain[i] += strain_vector(R.transpose() * strain_tensor(D.template tail<6>()) * R);
      state.strain_rate[i] =
          strain_vector(R.transpose() * strain_tensor(velocity.template tail<6>()) * R);
    }
    ++report.substeps;
    state.local_time[i] = state.time + dt;
    if (!is_finite(m)) return stop_at(before, i, state, report);
    Segment segment;
    segment.block = b;
    segment.flight = touches_nothing(k);
    segment.t_start = state.time;
    segment.t_end = state.time + dt;
    segment.start = before;
    segment.end = m;
    segment.acceleration =
        2 / (dt * dt) * (m.pose.position - before.pose.position - dt * before.velocity);
    work.segments.push_back(segment);
  }

  void run() {
    assemble();
    iterate();
    const auto first = static_cast<size_t>(members.front());
    const bool was_free = state.memory[first].empty();
    const Vec3 velocity_before = state.motion[first].velocity;
    remember();
    for (size_t k = 0; k < members.size(); ++k) move(k);
    if (paper.settings.post_adjustment && (n_blocks(scene) == 1 || !scene.settings.block_contacts))
      post_adjust(was_free, velocity_before);
    for (const int b : members)
      if (left_ground(scene, position(b)) ||
          std::binary_search(w.outsiders.begin(), w.outsiders.end(), b))
        stop_outside(scene, b, state, report);
  }

  // Eq. (28), v_a = COR v_b, on the normal component of the centroid's velocity, once a collision:
  // v_b is kept when a free block first closes a contact, v_a set when its last contact opens
  // again.
  void post_adjust(bool was_free, const Vec3& velocity_before) {
    const auto i = static_cast<size_t>(members.front());
    const bool is_free = state.memory[i].empty();
    if (was_free && !is_free) {
      Vec3 normal = Vec3::Zero();
      for (const ContactMemory& memory : state.memory[i]) normal += memory.normal;
      normal.normalize();
      const double speed = -normal.dot(velocity_before);
      const double restitution = scene.ground.classes[w.contacts.front().ground_class].restitution;
      const double resting = 2 * scene.gravity.norm() * scene.settings.dt;
      paper.state.rebound[i] =
          speed > resting ? Vec3(restitution * speed * normal) : Vec3(Vec3::Zero());
    }
    if (was_free || !is_free || paper.state.rebound[i].isZero(0)) return;
    const double wanted = paper.state.rebound[i].norm();
    const Vec3 normal = paper.state.rebound[i] / wanted;
    Vec3& v = state.motion[i].velocity;
    const Vec3 adjusted = v + (wanted - normal.dot(v)) * normal;
    state.ledger.impact += 0.5 * scene.blocks.mass[i] * (v.squaredNorm() - adjusted.squaredNorm());
    v = adjusted;
    if (state.phase[i] != Phase::stopped) work.segments.back().end = state.motion[i];
    paper.state.rebound[i].setZero();
  }
};

// Pairs of blocks of island k, without those with fixed bodies.
void gather_pairs(const Scene& scene, const PairSearch& search, int k,
                  std::vector<int>& manifolds) {
  const auto at = static_cast<size_t>(k);
  for (int p = search.groups.pair_begin[at]; p < search.groups.pair_begin[at + 1]; ++p) {
    const int m = search.joined_manifold[search.groups.pairs[p]];
    if (!is_fixed(scene, search.pairs.manifolds[m].block_b)) manifolds.push_back(m);
  }
}

}  // namespace

State paper_start(const Scene& scene, Work& work, PaperLaw& paper) {
  if (!(scene.settings.normal_stiffness > 0))
    throw InputError({}, "law paper needs a normal stiffness above 0 N/m",
                     "give [solver] normal_stiffness_n_m; the paper takes k_n = E = 5e10");
  State state = start_unsettled(scene);
  paper.state.rebound.assign(state.motion.size(), Vec3::Zero());
  for (int b = 0; b < n_blocks(scene); ++b) bond_block(scene, b, state, work);
  return state;
}

StepReport paper_step(const Scene& scene, State& state, Work& work, PaperLaw& paper) {
  StepReport report;
  work.segments.clear();
  const bool islands = n_blocks(scene) > 1 && scene.settings.block_contacts;
  if (islands) form_islands(scene, state, work);
  const IslandGroups& groups = work.search.groups;
  for (int b = 0; b < n_blocks(scene); ++b) {
    const auto i = static_cast<size_t>(b);
    if (does_not_move(state.phase[i]) || (islands && groups.local_index[i] > 0)) continue;
    const std::span<const int> members =
        islands ? blocks_of(groups, groups.island_of[i]) : std::span<const int>(&b, 1);
    paper.work.manifolds.clear();
    if (islands) gather_pairs(scene, work.search, groups.island_of[i], paper.work.manifolds);
    if (scene.settings.strains)
      OpenClose<12>{scene, state, work, paper, report, paper.work.strained, members}.run();
    else
      OpenClose<6>{scene, state, work, paper, report, paper.work.rigid, members}.run();
  }
  end_step(scene, state, work, report);
  return report;
}

}  // namespace talus
