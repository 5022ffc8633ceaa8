// Fences in a scene: panels as fixed bodies, and the record of blocks that hit them.
#include "scene/fence.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "geometry/polyhedron.hpp"
#include "motion/rotation.hpp"

namespace talus {
namespace {

using std::size_t;

constexpr double plate_thickness = 0.2;  // [m]

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
  return scene.fixed.panels[panel_number(scene, body)];
}

Vec3 spin_of(const Scene& scene, int block, const Motion& m) {
  return angular_velocity(m.pose.attitude, m.angular_momentum, scene.blocks.inertia[block]);
}

double translational(const Scene& scene, int block, const Motion& m) {
  return 0.5 * scene.blocks.mass[block] * m.velocity.squaredNorm();
}
double rotational(const Scene& scene, int block, const Motion& m) {
  return 0.5 * spin_of(scene, block, m).dot(m.angular_momentum);
}

FenceHit* hit_on(FenceState& fence, int block, const FencePanel& panel) {
  return find_hit(fence.hits, fence.chain, block, [&](const FenceHit& h) {
    return h.line == panel.line && h.panel == panel.number;
  });
}

FenceHit first_touch(const Scene& scene, int block, const FencePanel& panel, const Vec3& point,
                     double time, const Motion& before) {
  const Vec3 along = panel.foot_b - panel.foot_a;
  const double length = horizontal(along);
  const double share = std::clamp(
      (point - panel.foot_a).head<2>().dot(along.head<2>()) / (length * length), 0.0, 1.0);
  const double base = panel.foot_a.z() + share * along.z();
  FenceHit hit;
  hit.block = block;
  hit.line = panel.line;
  hit.panel = panel.number;
  hit.time = time;
  hit.chainage = panel.chainage + share * length;
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

}  // namespace

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
    chainage += horizontal(panel.foot_b - panel.foot_a);
    Yielding yielding;
    yielding.axis = left_of(panel.foot_b - panel.foot_a);
    yielding.capacity = fence.capacity;
    if (std::isfinite(fence.capacity)) yielding.force = fence.capacity / fence.deflection;
    const int body = add_fixed_body(scene, plates[i], contact_class);
    panel.yielding = let_yield(scene, body, yielding);
    fixed.panel[body] = static_cast<int>(fixed.panels.size());
    fixed.panels.push_back(panel);
  }
}

int panel_number(const Scene& scene, int body) {
  return body < n_fixed(scene) ? scene.fixed.panel[body] : -1;
}

void note_hit(const Scene& scene, int block, int body, const Vec3& point, double time,
              const Motion& before, const Motion& after, FenceState& fence) {
  const FencePanel& panel = panel_of(scene, body);
  FenceHit* hit = hit_on(fence, block, panel);
  if (hit == nullptr)
    hit = &add_hit(first_touch(scene, block, panel, point, time, before), n_blocks(scene),
                   fence.hits, fence.chain);
  hit->energy_after = translational(scene, block, after) + rotational(scene, block, after);
}

void note_work(const Scene& scene, std::span<const YieldPush> pushes, FenceState& fence) {
  for (const YieldPush& push : pushes) {
    if (push.yielding >= static_cast<int>(scene.fixed.yieldings.size())) continue;  // a stem
    const int body = scene.fixed.yieldings[push.yielding].body;
    if (panel_number(scene, body) < 0) continue;
    if (FenceHit* hit = hit_on(fence, push.block, panel_of(scene, body))) hit->work += push.work;
  }
}

}  // namespace talus
