// Effects of yielding ground and of forests: couples, friction that varies, drag.
#include "step/soil.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "solver/law_numbers.hpp"
#include "terrain/trn.hpp"

namespace talus {
namespace {

using std::size_t;
using std::numbers::pi;

double sphere_radius(double volume) { return std::cbrt(3 * volume / (4 * pi)); }

void drag_on_ground(const GroundClass& ground, double h, Motion& motion) {
  if (!drags(ground)) return;
  const double kept = kept_by_drag(ground, motion.velocity.norm(), h);
  motion.velocity *= kept;
  motion.angular_momentum *= kept;
}

}  // namespace

RowArm arm_on(const Scene& scene, const GroundClass& ground, int b) {
  const auto i = static_cast<size_t>(b);
  if (!resists_rolling(ground)) return {};
  const double radius = sphere_radius(scene.blocks.volume[i]);
  const double weight = scene.blocks.mass[i] / scene.blocks.volume[i] * scene.gravity.norm();
  const double rolling = rolling_on(ground, weight, radius);
  return {rolling * radius, (ground.spinning < 0 ? rolling : ground.spinning) * radius};
}

Dent dent_on(const Scene& scene, const GroundClass& ground, int b) {
  const auto i = static_cast<size_t>(b);
  return dent_in(ground, scene.blocks.mass[i], sphere_radius(scene.blocks.volume[i]));
}

double turn_damping(const Scene& scene, const BlockNumbers& c, double h) {
  return law::stiffest_lone * law::recovery_steps * (h / scene.settings.dt) * c.inertia.maxCoeff();
}

int add_turn(const Scene& scene, int b, const BlockNumbers& c, double h,
             std::span<const ContactRow> rows, std::vector<AngularRow>& turns,
             std::vector<RowArm>& arms) {
  if (std::none_of(rows.begin(), rows.end(),
                   [&](const ContactRow& row) { return resists_rolling(class_of(scene, row)); }))
    return -1;
  AngularRow turn;
  turn.row_end = static_cast<int>(rows.size());
  turn.arm_begin = static_cast<int>(arms.size());
  turn.damping = turn_damping(scene, c, h);
  turn.inertia = c.inertia.minCoeff();
  for (const ContactRow& row : rows) arms.push_back(arm_on(scene, class_of(scene, row), b));
  turns.push_back(turn);
  return static_cast<int>(turns.size()) - 1;
}

double slip_distance(const Slide& slide, const GroundClass& ground) {
  if (slide.memory == nullptr) return 0;
  return slide.memory->distance *
         std::exp(-ground.scar_decay * std::max(0.0, slide.t - slide.memory->time));
}

void vary_friction(const GroundClass& ground, const Slide& slide, double speed, double time,
                   double& friction) {
  if (varies_friction(ground))
    friction = mean_friction(ground, speed, slip_distance(slide, ground), time * speed);
}

void slide_on(const Scene& scene, const GroundClass& ground, int b, double speed, double time,
              double t, double h, State& state) {
  if (state.slid.empty()) return;
  const double path = speed > law::island_tolerance * scene.gravity.norm() * h ? time * speed : 0;
  state.slid[static_cast<size_t>(b)] = {slip_distance(slide_of(state, b, t), ground) + path, t + h};
}

int begin_soil(const Scene& scene, int b, const BlockNumbers& c, double h, const Slide& slide,
               std::span<ContactRow> rows, std::vector<AngularRow>& turns,
               std::vector<RowArm>& arms) {
  const int turn = add_turn(scene, b, c, h, rows, turns, arms);
  for (ContactRow& row : rows)
    vary_friction(class_of(scene, row), slide, row.slip_speed, h, row.friction);
  return turn;
}

Motion after_drag(const Scene& scene, int b, const Motion& motion, const HalfWay& half,
                  bool is_pressed, double h) {
  Motion out = motion;
  if (is_pressed)
    for_each_class_below(scene.ground, half.from, half.to, [&](int ground, double share) {
      drag_on_ground(scene.ground.classes[static_cast<size_t>(ground)], share * h, out);
    });
  const double drag = mean_drag(scene.canopies, scene.ground.trn, half.from, half.to);
  if (drag > 0) out.velocity *= std::exp(-drag * h / scene.blocks.mass[static_cast<size_t>(b)]);
  return out;
}

bool any_drags(const Scene& scene) {
  return !scene.canopies.empty() ||
         std::any_of(scene.ground.classes.begin(), scene.ground.classes.end(), drags);
}

}  // namespace talus
