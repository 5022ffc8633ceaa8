#include "dda/fence.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "dda/rotation.hpp"
#include "geometry/polyhedron.hpp"

namespace talus {
namespace {

using std::size_t;

constexpr double plate_thickness = 0.2;  // [m]
constexpr double used_up = 1 - 1e-9;     // share of the capacity at which a panel breaks
constexpr double across = 0.5;           // least cosine of a push with the panel's normal

// The plate between two feet, down to `depth` below and up to `height` above them.
Polyhedron plate(const Vec3& a, const Vec3& b, const Vec3& normal, double depth, double height) {
  Polyhedron body =
      box(Vec3(0, -plate_thickness / 2, -depth), Vec3(1, plate_thickness / 2, height));
  for (Vec3& v : body.vertices) v = a + v.x() * (b - a) + v.y() * normal + v.z() * Vec3::UnitZ();
  return body;
}

Vec3 left_of(const Vec3& along) { return Vec3(-along.y(), along.x(), 0).normalized(); }

double horizontal(const Vec3& v) { return std::hypot(v.x(), v.y()); }

const FencePanel& panel_of(const Scene& scene, int body) {
  const auto f = static_cast<size_t>(body - n_blocks(scene));
  return scene.fixed.panels[static_cast<size_t>(scene.fixed.panel[f])];
}

Vec3 spin_of(const Scene& scene, int block, const Motion& m) {
  return angular_velocity(m.pose.attitude, m.angular_momentum,
                          scene.blocks.inertia[static_cast<size_t>(block)]);
}

double translational(const Scene& scene, int block, const Motion& m) {
  return 0.5 * scene.blocks.mass[static_cast<size_t>(block)] * m.velocity.squaredNorm();
}
double rotational(const Scene& scene, int block, const Motion& m) {
  return 0.5 * spin_of(scene, block, m).dot(m.angular_momentum);
}

FenceHit* find_hit(FenceState& fence, int block, const FencePanel& panel) {
  const auto found = std::find_if(fence.hits.rbegin(), fence.hits.rend(), [&](const FenceHit& h) {
    return h.block == block && h.line == panel.line && h.panel == panel.number;
  });
  return found == fence.hits.rend() ? nullptr : &*found;
}

FenceHit first_touch(const Scene& scene, int block, const FencePanel& panel, const Vec3& point,
                     double time, const Motion& before) {
  const Vec3 along = panel.foot_b - panel.foot_a;
  const double length = horizontal(along);
  const double way = std::clamp(
      (point - panel.foot_a).head<2>().dot(along.head<2>()) / (length * length), 0.0, 1.0);
  const double base = panel.foot_a.z() + way * along.z();
  FenceHit hit;
  hit.block = block;
  hit.line = panel.line;
  hit.panel = panel.number;
  hit.time = time;
  hit.chainage = panel.chainage + way * length;
  hit.velocity = before.velocity;
  hit.translational_energy = translational(scene, block, before);
  hit.rotational_energy = rotational(scene, block, before);
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Vec3& v : vertices_of(scene.blocks.shapes, block)) {
    const double z = place(before.pose, v).z();
    low = std::min(low, z), high = std::max(high, z);
  }
  hit.bottom_height = low - base;
  hit.top_height = high - base;
  return hit;
}

int hardest_pusher(std::span<const PanelPush> pushes, int panel) {
  const auto work_on = [panel](const PanelPush& p) { return p.panel == panel ? p.work : -1; };
  return std::max_element(
             pushes.begin(), pushes.end(),
             [&](const PanelPush& a, const PanelPush& b) { return work_on(a) < work_on(b); })
      ->block;
}

void wake_sleepers_at(const Scene& scene, int panel, State& state) {
  for (size_t b = 0; b < state.memory.size(); ++b) {
    if (state.phase[b] != Phase::asleep) continue;
    for (const ContactMemory& m : state.memory[b]) {
      if (!is_fixed(scene, m.key.body_b)) continue;
      const auto f = static_cast<size_t>(m.key.body_b - n_blocks(scene));
      if (scene.fixed.panel[f] != panel) continue;
      wake(state, b, state.time);
    }
  }
}

}  // namespace

int add_fixed_body(Scene& scene, const Polyhedron& body, int contact_class, int panel) {
  TALUS_ASSERT(n_bodies(scene.blocks.hulls) == n_blocks(scene) + n_fixed(scene));
  const Vec3 centroid = moments(body).centroid;
  add_hulls(scene.blocks.hulls, std::span(&body, 1), centroid, Mat3::Identity(), true);
  scene.fixed.pose.push_back({centroid, Quat::Identity()});
  scene.fixed.contact_class.push_back(contact_class);
  scene.fixed.panel.push_back(panel);
  return n_fixed(scene) - 1;
}

std::vector<Polyhedron> panel_plates(const StandingFence& fence) {
  std::vector<Polyhedron> plates;
  for (size_t i = 0; i + 1 < fence.posts.size(); ++i) {
    const Vec3 &a = fence.posts[i], &b = fence.posts[i + 1];
    plates.push_back(plate(a, b, left_of(b - a), fence.depth[i], fence.height));
  }
  return plates;
}

void add_fence(Scene& scene, const StandingFence& fence) {
  FixedBodies& fixed = scene.fixed;
  const int contact_class = static_cast<int>(fixed.classes.size());
  fixed.classes.push_back(fence.contact);
  const std::vector<Polyhedron> plates = panel_plates(fence);
  double chainage = 0;
  for (size_t i = 0; i + 1 < fence.posts.size(); ++i) {
    FencePanel panel;
    panel.line = fence.line;
    panel.number = static_cast<int>(i);
    panel.foot_a = fence.posts[i];
    panel.foot_b = fence.posts[i + 1];
    panel.chainage = chainage;
    panel.normal = left_of(panel.foot_b - panel.foot_a);
    panel.capacity = fence.capacity;
    if (std::isfinite(fence.capacity)) panel.force = fence.capacity / fence.deflection;
    chainage += horizontal(panel.foot_b - panel.foot_a);
    add_fixed_body(scene, plates[i], contact_class, static_cast<int>(fixed.panels.size()));
    fixed.panels.push_back(panel);
  }
}

FenceState start_fence(const Scene& scene) {
  const size_t n = scene.fixed.panels.size();
  FenceState fence;
  fence.deflection.assign(n, 0);
  fence.work.assign(n, 0);
  fence.broken_at.assign(n, std::numeric_limits<double>::infinity());
  fence.broken_by.assign(n, -1);
  return fence;
}

bool stands(const Scene& scene, const State& state, int body) {
  const int panel = panel_number(scene, body);
  return panel < 0 || state.fence.broken_by[static_cast<size_t>(panel)] < 0;
}

Pose fixed_pose(const Scene& scene, const State& state, int body) {
  const auto f = static_cast<size_t>(body - n_blocks(scene));
  Pose pose = scene.fixed.pose[f];
  if (const int panel = scene.fixed.panel[f]; panel >= 0)
    pose.position += state.fence.deflection[static_cast<size_t>(panel)] *
                     scene.fixed.panels[static_cast<size_t>(panel)].normal;
  return pose;
}

const GroundClass& fixed_class(const Scene& scene, int body) {
  const auto f = static_cast<size_t>(body - n_blocks(scene));
  return scene.fixed.classes[static_cast<size_t>(scene.fixed.contact_class[f])];
}

int panel_number(const Scene& scene, int body) {
  return scene.fixed.panel[static_cast<size_t>(body - n_blocks(scene))];
}

const FencePanel* giving_way(const Scene& scene, int body, const Vec3& normal) {
  if (panel_number(scene, body) < 0) return nullptr;
  const FencePanel& panel = panel_of(scene, body);
  const bool yields = std::isfinite(panel.force) && std::abs(normal.dot(panel.normal)) > across;
  return yields ? &panel : nullptr;
}

void add_push(const PanelPush& push, std::vector<PanelPush>& pushes) {
  for (PanelPush& known : pushes) {
    if (known.block != push.block || known.panel != push.panel) continue;
    known.work += push.work;
    known.power += push.power;
    if (std::abs(push.shift) > std::abs(known.shift)) {
      known.shift = push.shift;
      known.to = push.to;
    }
    return;
  }
  pushes.push_back(push);
}

double time_to_first_break(const Scene& scene, const FenceState& fence,
                           std::span<const PanelPush> pushes, double h) {
  double first = std::numeric_limits<double>::infinity();
  for (const PanelPush& push : pushes) {
    const auto p = static_cast<size_t>(push.panel);
    double work = 0, power = 0;
    for (const PanelPush& other : pushes) {
      if (other.panel != push.panel) continue;
      work += other.work;
      power += other.power;
    }
    const double left = std::max(0.0, scene.fixed.panels[p].capacity - fence.work[p]);
    if (work <= left + (1 - used_up) * scene.fixed.panels[p].capacity) continue;
    const double change = (work - power * h) / (h * h);  // work(t) = power t + change t^2
    const double root = std::sqrt(std::max(0.0, power * power + 4 * change * left));
    first = std::min(first, 2 * left / (power + root));
  }
  return first;
}

void push_panels(const Scene& scene, std::span<const PanelPush> pushes, double time, State& state) {
  FenceState& fence = state.fence;
  for (const PanelPush& push : pushes) {
    const auto p = static_cast<size_t>(push.panel);
    fence.work[p] += push.work;
    state.ledger.fence += push.work;
    if (push.shift < 0) fence.deflection[p] = std::min(fence.deflection[p], push.to);
    if (push.shift > 0) fence.deflection[p] = std::max(fence.deflection[p], push.to);
    if (FenceHit* hit = find_hit(fence, push.block, scene.fixed.panels[p])) hit->work += push.work;
  }
  for (const PanelPush& push : pushes) {
    const auto p = static_cast<size_t>(push.panel);
    if (fence.work[p] < used_up * scene.fixed.panels[p].capacity || fence.broken_by[p] >= 0)
      continue;
    fence.broken_at[p] = time;
    fence.broken_by[p] = hardest_pusher(pushes, push.panel);
    wake_sleepers_at(scene, push.panel, state);
  }
}

void note_hit(const Scene& scene, int block, int body, const Vec3& point, double time,
              const Motion& before, const Motion& after, FenceState& fence) {
  const FencePanel& panel = panel_of(scene, body);
  FenceHit* hit = find_hit(fence, block, panel);
  if (hit == nullptr)
    hit = &fence.hits.emplace_back(first_touch(scene, block, panel, point, time, before));
  hit->energy_after = translational(scene, block, after) + rotational(scene, block, after);
}

}  // namespace talus
