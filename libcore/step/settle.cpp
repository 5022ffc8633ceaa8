// Static start of one block, and the bonds of its faces on cohesive ground.
#include "step/settle.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "contact/scales.hpp"
#include "contact/search.hpp"
#include "geometry/corner_shares.hpp"
#include "solver/law_numbers.hpp"
#include "step/lone/lone_substep.hpp"

namespace talus {
namespace {

using std::size_t;

// Bonds of the faces that lie on the ground with all their corners when the run begins: each corner
// holds its share of the face's area (theory 1.7). Only where the ground has cohesion or tensile
// strength. `work.contacts` are those that touch.
void bond_faces(const Scene& scene, int b, const Pose& pose, const Work& work,
                std::vector<ContactMemory>& memory) {
  const Shapes& shapes = scene.blocks.shapes;
  const std::span<const Vec3> vertices = vertices_of(shapes, b);
  const auto touching = [&](int vertex, const Vec3& outward) -> const Contact* {
    for (const Contact& c : work.contacts)
      if (c.key.mode == ContactMode::vertex_face && c.key.feature_a == vertex &&
          c.normal.dot(outward) < -1 + negligible)
        return &c;
    return nullptr;
  };
  const int first_part = shapes.part_begin[b];
  const int last_part = shapes.part_begin[b + 1];
  for (int f = shapes.face_begin[first_part]; f < shapes.face_begin[last_part]; ++f) {
    const ShapeFace& face = shapes.faces[f];
    const Vec3 outward = pose.attitude * face.normal;
    const int n = face.vertex_end - face.vertex_begin;
    int held = 0;
    for (int k = face.vertex_begin; k < face.vertex_end; ++k)
      held += touching(shapes.face_vertices[k], outward) != nullptr;
    if (held < n) continue;
    const Vec3 u = face.normal.unitOrthogonal(), v = face.normal.cross(u);
    const auto corner = [&](size_t k) {
      const Vec3& x = vertices[shapes.face_vertices[face.vertex_begin + static_cast<int>(k)]];
      return Vec2(u.dot(x), v.dot(x));
    };
    std::vector<double> share(static_cast<size_t>(n), 0);
    share_area(share.size(), corner, [&](size_t k, double area) { share[k] += area; });
    for (int k = face.vertex_begin; k < face.vertex_end; ++k) {
      const Contact& c = *touching(shapes.face_vertices[k], outward);
      const GroundClass& ground = scene.ground.classes[c.ground_class];
      if (ground.cohesion == 0 && ground.tension == 0) continue;
      ContactMemory bond;
      bond.key = c.key;
      bond.normal = c.normal;
      bond.gap_end = c.gap;
      bond.bond_area = share[static_cast<size_t>(k - face.vertex_begin)];
      memory.push_back(bond);
    }
  }
}

// Whether the ball around block b at rest is far above all ground below it.
bool is_above_ground(const Scene& scene, size_t b) {
  const Vec3 &at = scene.blocks.rest[b].position,
             around = Vec3::Constant(1.001 * scene.blocks.shapes.radius[b]);
  const NearCells near =
      find_near_cells(scene.ground.trn, scene.ground.pyramid, at - around, at + around, 0);
  return near.reach == Reach::above;
}

// Whether the block is there, touches the ground without spin, and moves neither into it nor off
// it.
bool touches_at_rest(const Scene& scene, int b, const Motion& motion, Work& work) {
  const auto i = static_cast<size_t>(b);
  if (!is_released(scene, i) || !scene.blocks.spin[i].isZero(0) || is_above_ground(scene, i))
    return false;
  const BlockNumbers c = numbers_of(scene, b);
  (void)find_contacts(scene.ground, scene.blocks.shapes, b, motion.pose, Mat3::Identity(),
                      1e3 * c.touch, work.world_vertices, work.contacts);
  const double slow = 1e-6 * motion.velocity.norm();
  return !work.contacts.empty() &&
         std::all_of(work.contacts.begin(), work.contacts.end(), [&](const Contact& contact) {
           return std::abs(contact.normal.dot(motion.velocity)) <= slow;
         });
}

/// How a static iteration ends.
enum class Settled : std::uint8_t {
  rests,   ///< in equilibrium
  slides,  ///< in the equilibrium of a block that slides off from rest, all contacts alike
  moves    ///< neither, or the forces do not converge
};

// The system of a step from rest that ends at rest, strains and all. Those have no inertia here:
// they follow the forces at once, whatever the step, as the block's position does on stiff
// contacts.
template <int Dof>
BlockSystem<Dof> static_system(const Scene& scene, int b, const BlockNumbers& c, const Substep& s,
                               const State& state) {
  BlockSystem<Dof> system = make_system<Dof>(scene, b, c, s, state);
  if constexpr (Dof == 12) {
    const auto i = static_cast<size_t>(b);
    const Blocks& blocks = scene.blocks;
    const Mat6 C = elastic_matrix(blocks.young[i], blocks.poisson[i]);
    Vec6 stress = C * state.strain[i];
    if (!blocks.initial_stress.empty()) stress += blocks.initial_stress[i];
    stress -= load_strain(scene, b, s.free.pose.attitude, state.pressure) / blocks.volume[i];
    const Vec6 rate = C.ldlt().solve(stress) / -c.recovery_time;
    system.mass.template topRightCorner<6, 6>().setZero();
    system.mass.template bottomLeftCorner<6, 6>().setZero();
    system.mass.template bottomRightCorner<6, 6>() = s.h * c.recovery_time * blocks.volume[i] * C;
    system.free_velocity << s.R.transpose() * s.free.velocity, s.spin_free, rate;
    system.velocity.template tail<6>() = rate;
  }
  return system;
}

// Step of the static iteration [s]. Friction holds back motion that spreads by straining until the
// block has slid farther than that, so where it hardly slides short steps come to no end: as long
// as a free fall takes through the margin.
template <int Dof>
double static_step(const Settings& settings, const BlockNumbers& c) {
  if (Dof == 6 || c.gravity == 0) return settings.dt;
  return std::sqrt(2 * law::shallow * c.radius / c.gravity);
}

// A step of the static iteration.
struct StaticPass {
  Vec3 way = Vec3::Zero();       // of the centroid [m]
  double turn = 0;               // by turning and straining, at the block's radius [m]
  bool sticks = false;           // some contact does
  Vec3 velocity = Vec3::Zero();  // that the step would have ended with [m/s]
};

// From rest for h, with the contacts that it meets; none where they do not converge. `work.rows` is
// empty where it meets none. friction < 0: that of the ground.
template <int Dof>
std::optional<StaticPass> static_pass(const Scene& scene, int b, const BlockNumbers& c, double h,
                                      double friction, bool from_touch, State& state, Work& work) {
  const auto i = static_cast<size_t>(b);
  Motion& motion = state.motion[i];
  const Substep s = predict(scene, b, c, motion, 0, h, state.pressure);
  (void)find_contacts(scene.ground, scene.blocks.shapes, b, s.free.pose, stretch_of(state, b),
                      std::min(search_margin(c, h), law::shallow * c.radius), work.world_vertices,
                      work.contacts);
  make_rows(scene, b, c, s, state.memory[b], work);
  if (work.rows.empty()) return StaticPass{};
  for (ContactRow& row : work.rows) {
    if (friction >= 0) row.friction = friction;
    if (from_touch) row.offset = 0, set_ground_law(scene, c, s, row);
  }
  BlockSystem<Dof> system = static_system<Dof>(scene, b, c, s, state);
  if (!solve_contacts(system, std::span(work.rows), scene.settings.max_passes).converged)
    return std::nullopt;
  const Solved<Dof> solved = solved_motion(c, s, system);
  StepReport report;
  remember(c, s, solved, state, work, b, report);
  StaticPass pass;
  pass.way = solved.end.pose.position - motion.pose.position;
  pass.turn = c.radius * solved.end.pose.attitude.angularDistance(motion.pose.attitude);
  if constexpr (Dof == 12) {
    const Vec6 strained = c.recovery_time * system.velocity.template tail<6>();
    state.strain[i] += strained;
    pass.turn += c.radius * strained.norm();
  }
  pass.sticks = std::any_of(work.rows.begin(), work.rows.end(),
                            [](const ContactRow& row) { return row.state == ContactState::stick; });
  pass.velocity = solved.end.velocity;
  motion.pose = solved.end.pose;
  return pass;
}

// Static iteration: steps from rest, each ending at rest, until the block moves by less than
// `still` of its radius, or by the same displacement as in the step before without turning. A
// sliding block is put back by the distance that it slid, and its acceleration is known. A
// negative friction means that of the ground.
template <int Dof>
Settled settle(const Scene& scene, int b, double friction, bool from_touch, double still,
               State& state, Work& work) {
  // the first are those before the motion settles down, which takes long where friction holds
  // strains
  constexpr int most_passes = Dof == 12 ? 400 : 40, first_passes = Dof == 12 ? 100 : 5;
  constexpr double accelerates = 0.9;  // of the pass before: it comes to no end
  // Sliding is followed until the path changes by less than this, of the radius, or where that is
  // as far as the solver's tolerance lets it come: by less than these, of the path and of the
  // radius.
  constexpr double slides = 1e-11, slides_about = 1e-8, of_way = 1e-5;
  BlockNumbers c = numbers_of(scene, b);
  const double h = static_step<Dof>(scene.settings, c);
  c.recovery_time = h / 2;  // from rest, this lands in equilibrium at once as k grows
  Vec3& position = state.motion[b].pose.position;
  const Vec3 begin = position;
  Vec3 way_before = Vec3::Zero();
  double change_before = 0;
  for (int n = 0; n < most_passes; ++n) {
    const std::optional<StaticPass> pass =
        static_pass<Dof>(scene, b, c, h, friction, from_touch && n == 0, state, work);
    if (!pass) return Settled::moves;
    if (work.rows.empty()) return Settled::rests;
    const Vec3& way = pass->way;
    const double rounding = 1e-15 * position.norm();
    if (way.norm() + pass->turn < still * c.radius + rounding) return Settled::rests;
    const double change = (pass->sticks ? way.norm() : (way - way_before).norm()) + pass->turn;
    const bool comes_nearer = change < change_before / 2 && change > slides * c.radius + rounding;
    if (!pass->sticks && !comes_nearer &&
        change < std::min(of_way * way.norm(), slides_about * c.radius) + rounding) {
      const Vec3 along = way.normalized();
      position -= along.dot(position - begin) * along;
      state.acceleration[b] = pass->velocity / h;
      return Settled::slides;
    }
    if (n >= first_passes && change > accelerates * change_before) return Settled::moves;
    // this many passes would let it fall over or slide away
    const double most_way = (friction >= 0 ? 0.1 : 0.5) * c.radius;
    if (Dof == 12 && (position - begin).norm() > most_way) return Settled::moves;
    way_before = way;
    change_before = change;
  }
  return Settled::moves;
}

}  // namespace

void bond_block(const Scene& scene, int b, State& state, Work& work) {
  const auto i = static_cast<size_t>(b);
  if (touches_at_rest(scene, b, state.motion[i], work))
    bond_faces(scene, b, state.motion[i].pose, work, state.memory[i]);
}

namespace {

template <int Dof>
void settle_block_as(const Scene& scene, int b, State& state, Work& work) {
  const auto i = static_cast<size_t>(b);
  const Motion rest = state.motion[i];
  const EnergyLedger ledger = state.ledger;
  constexpr double sticking = 57;  // tan(89 degrees)
  constexpr double still = 1e-14;
  const auto strain = [&] { return Dof == 12 ? state.strain[i] : Vec6::Zero().eval(); };
  const auto set_strain = [&](const Vec6& value) {
    if (Dof == 12) state.strain[i] = value;
  };
  if (touches_at_rest(scene, b, rest, work)) {
    state.motion[i].velocity.setZero();
    bond_faces(scene, b, rest.pose, work, state.memory[i]);
    if (settle<Dof>(scene, b, sticking, true, rounding, state, work) != Settled::rests) {
      state.motion[i].pose = rest.pose;  // it topples: from where it is
      state.memory[i].clear();
      set_strain(Vec6::Zero());
    } else if (!rest.velocity.isZero(0)) {  // it moves along the ground: only the overlap is kept
      for (ContactMemory& memory : state.memory[i]) memory.shear.setZero();
    } else {
      const Motion stuck = state.motion[i];
      const Vec6 stuck_strain = strain();
      const std::vector<ContactMemory> memory = state.memory[i];
      if (settle<Dof>(scene, b, -1, false, still, state, work) == Settled::moves) {
        state.motion[i] = stuck;  // it slides, not always alike: from where it stuck
        state.memory[i] = memory;
        set_strain(stuck_strain);
      }
    }
  }
  state.ledger = ledger;
  state.motion[i].velocity = rest.velocity;
}

}  // namespace

void settle_block(const Scene& scene, int b, State& state, Work& work) {
  // blocks that touch each other are computed rigid, and which do is not known yet
  const bool may_meet = scene.settings.block_contacts && n_blocks(scene) > 1;
  const bool strains = scene.settings.strains && !may_meet;
  (strains ? settle_block_as<12> : settle_block_as<6>)(scene, b, state, work);
}

}  // namespace talus
