// Blocks that break: pieces replace their block, and the energy of the hits that break it.
#include "step/breakage.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "motion/rotation.hpp"
#include "scene/sleep.hpp"
#include "step/substep.hpp"

namespace talus {
namespace {

using std::size_t;

std::uint64_t mixed(std::uint64_t z) {  // finaliser of splitmix64
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

// In [0, 1), of seed, body and number of its hits alone.
double draw(std::uint64_t seed, int b, int n_hits) {
  const std::uint64_t body = mixed(seed + 0x9e3779b97f4a7c15ULL * (static_cast<unsigned>(b) + 1U));
  const std::uint64_t hit = mixed(body + 0x9e3779b97f4a7c15ULL * static_cast<unsigned>(n_hits));
  return static_cast<double>(hit >> 11) * 0x1p-53;
}

Vec3 spin_of(const Scene& scene, size_t b, const Motion& m) {
  return angular_velocity(m.pose.attitude, m.angular_momentum, scene.blocks.inertia[b]);
}

Vec3 velocity_at(const Scene& scene, size_t b, const Motion& m, const Vec3& place) {
  return m.velocity + spin_of(scene, b, m).cross(place - m.pose.position);
}

// How much a push of 1 N s along n at `arm` moves a block there [1/kg].
double mobility_of(const Scene& scene, size_t b, const Motion& m, const Vec3& arm, const Vec3& n) {
  const Vec3 turn = m.pose.attitude.conjugate() * arm.cross(n);
  return 1 / scene.blocks.mass[b] + turn.dot(turn.cwiseQuotient(scene.blocks.inertia[b]));
}

// A piece in its place as cut turns and moves with the block.
Motion inherited(const Scene& scene, size_t piece, size_t whole, const Motion& motion) {
  const Pose &rest = scene.blocks.rest[piece], &from = scene.blocks.rest[whole];
  const Quat turn = motion.pose.attitude * from.attitude.conjugate();
  Motion made;
  made.pose.position = motion.pose.position + turn * (rest.position - from.position);
  made.pose.attitude = (turn * rest.attitude).normalized();
  made.velocity = velocity_at(scene, whole, motion, made.pose.position);
  made.angular_momentum = angular_momentum(made.pose.attitude, spin_of(scene, whole, motion),
                                           scene.blocks.inertia[piece]);
  return made;
}

void push_piece(const Vec3& impulse, const Vec3& at, double mass, Motion& motion) {
  motion.velocity += impulse / mass;
  motion.angular_momentum += (at - motion.pose.position).cross(impulse);
}

// An impulse J and -J on the pieces that adds `separation` to their energy: W J^2 / 2 of it, since
// pieces of one rigid motion do not open before.
void drive_apart(const Scene& scene, size_t first, const Vec3& at, const Vec3& normal,
                 double separation, State& state) {
  if (!(separation > 0)) return;
  double mobility = 0;
  for (const size_t b : {first, first + 1}) {
    const Motion& m = state.motion[b];
    mobility += mobility_of(scene, b, m, at - m.pose.position, normal);
  }
  const Vec3 impulse = std::sqrt(2 * separation / mobility) * normal;
  push_piece(-impulse, at, scene.blocks.mass[first], state.motion[first]);
  push_piece(impulse, at, scene.blocks.mass[first + 1], state.motion[first + 1]);
}

void begin_life(const Scene& scene, size_t b, State& state) {
  be_born(state, b, state.time);
  state.rest_pose[b] = state.motion[b].pose;
  state.flight_end[b] = state.time;
  state.memory[b].clear();
  state.support[b].setZero();
  forget_rates(scene, static_cast<int>(b), state);
}

// Bonds of the block with its neighbours are gone with it.
void free_bonds(int b, State& state) {
  for (BlockBond& bond : state.bonds)
    if (bond.block_a == b || bond.block_b == b) bond.area = 0;
}

// A block that a hit found asleep or that flies on from it is where it is now.
void bring_up(const Scene& scene, int b, State& state, Work& work) {
  const auto i = static_cast<size_t>(b);
  if (state.phase[i] == Phase::flight) end_flight(scene, b, state.time, state, work);
  if (state.phase[i] == Phase::asleep) wake_bonded(b, state.time, state);
}

void hit(const Scene& scene, int b, double loss, State& state, Work& work) {
  const auto i = static_cast<size_t>(b);
  const Fragment& whole = scene.fragments[i];
  const Fragmentation& law = scene.fragmentation;
  ++state.n_hits[i];
  if (whole.first_piece < 0 || !takes_part(state, b)) return;
  const double work_needed = law.energy * whole.cut_area * whole.bonded;
  const double chance = chance_of_breaking(loss, work_needed, law.spread);
  if (draw(law.seed, b, state.n_hits[i]) >= chance) return;
  bring_up(scene, b, state, work);
  const double separation = law.separation_share * loss,
               fracture = std::min(work_needed, loss - separation);
  const double left = loss - separation - fracture;
  state.breaks.push_back({b, whole.first_piece, whole.released, whole.generation, state.time,
                          state.motion[i].pose.position, scene.blocks.volume[i], loss, fracture,
                          separation});
  release_pieces(scene, b, separation, state);
  state.ledger.impact -= separation + fracture;
  state.ledger.breakage += fracture;
  if (!(left > 0)) return;
  for (const int piece : {whole.first_piece, whole.first_piece + 1})
    hit(scene, piece,
        left * scene.blocks.volume[static_cast<size_t>(piece)] / scene.blocks.volume[i], state,
        work);
}

}  // namespace

void add_ground_hit_loss(const Scene& scene, int b, const Motion& before, const Motion& after,
                         std::span<const Contact> contacts, double dissipated, State& state) {
  if (state.hit_loss.empty()) return;
  const auto i = static_cast<size_t>(b);
  Vec3 normal = Vec3::Zero(), point = Vec3::Zero();
  int n = 0;
  for (const Contact& contact : contacts) {
    const Vec3 at = place(before.pose, contact.point_a);
    if (contact.normal.dot(velocity_at(scene, i, before, at)) >= 0) continue;
    normal += contact.normal;
    point += at;
    ++n;
  }
  if (n == 0 || normal.isZero(0)) return;
  normal.normalize();
  point /= n;
  const double impulse = scene.blocks.mass[i] * normal.dot(after.velocity - before.velocity);
  const double path =
      normal.dot(velocity_at(scene, i, before, point) + velocity_at(scene, i, after, point)) / 2;
  // couples may have taken more of a hit than it lost otherwise
  state.hit_loss[i] += std::clamp(-impulse * path, 0.0, std::max(0.0, dissipated));
}

double chance_of_breaking(double loss, double work, double spread) {
  if (!(loss > 0)) return 0;
  return work > 0 ? 1 - std::exp2(-std::pow(loss / work, spread)) : 1;
}

void release_pieces(const Scene& scene, int b, double separation, State& state) {
  const auto i = static_cast<size_t>(b);
  const Fragment& whole = scene.fragments[i];
  const auto first = static_cast<size_t>(whole.first_piece);
  Motion& motion = state.motion[i];
  for (const size_t piece : {first, first + 1}) {
    state.motion[piece] = inherited(scene, piece, i, motion);
    begin_life(scene, piece, state);
  }
  const Quat turn = motion.pose.attitude * scene.blocks.rest[i].attitude.conjugate();
  const Vec3 at =
      motion.pose.position + turn * (whole.cut_centroid - scene.blocks.rest[i].position);
  drive_apart(scene, first, at, turn * whole.cut_normal, separation, state);
  motion.velocity.setZero();
  motion.angular_momentum.setZero();
  state.memory[i].clear();
  free_bonds(b, state);
  break_up(state, i);
  state.pairs.listed_at.clear();  // so that pairs are listed anew, with the pieces
}

void break_blocks(const Scene& scene, State& state, Work& work) {
  for (size_t b = 0; b < state.hit_loss.size(); ++b) {
    const double loss = std::exchange(state.hit_loss[b], 0);
    if (loss > 0) hit(scene, static_cast<int>(b), loss, state, work);
  }
}

}  // namespace talus
