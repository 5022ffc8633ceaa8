// Run-out of one run: paths, streamline, H, L, angles of reach, curves over time, energy shares.
#include "post/runout/runout.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/error.hpp"
#include "base/numbers.hpp"
#include "geometry/convex_outline.hpp"
#include "geometry/plan2d.hpp"
#include "record/motion.hpp"

namespace talus {
namespace {

double angle_of(double height, double length) {
  return length > 0 ? std::atan2(height, length) : no_value;
}

double plan_distance(const Vec3& a, const Vec3& b) { return (b - a).head<2>().norm(); }

double kinetic_rotation(const RunFile& run, int block, const FrameBlock& at) {
  const Vec3 spin = at.attitude.conjugate() * at.spin;
  return 0.5 * spin.cwiseAbs2().dot(run.blocks.inertia[block]);
}

// Raises the largest speed and energy of a block by its frames.
void raise_by_frames(RunReach& reach, const RunFile& run, int block) {
  for (int k = 0; k < n_frames(run.frames); ++k) {
    const FrameBlock at = frame_block(run, k, block);
    const double speed = at.velocity.norm();
    reach.max_speed[block] = std::max(reach.max_speed[block], speed);
    reach.max_energy[block] =
        std::max(reach.max_energy[block],
                 0.5 * run.blocks.mass[block] * speed * speed + kinetic_rotation(run, block, at));
  }
}

// The recorder has seen every step, the frames only their own moments.
void raise_by_passages(RunReach& reach, const std::vector<Passage>& passages) {
  for (const Passage& passage : passages) {
    double &speed = reach.max_speed[passage.block], &energy = reach.max_energy[passage.block];
    speed = std::max<double>(speed, passage.largest.speed);
    energy = std::max<double>(energy, passage.largest.total_energy);
  }
}

// Raises `top` to the highest vertex of a block before it moved.
void raise_to_highest(const RunFile& run, int block, Vec3& top) {
  const Pose pose = first_pose(run, block);
  for (int v = run.blocks.vertex_begin[block]; v < run.blocks.vertex_begin[block + 1]; ++v) {
    const Vec3 at = place(pose, run.blocks.vertices[v]);
    if (at.z() > top.z()) top = at;
  }
}

Vec3 highest_point(const RunFile& run) {
  Vec3 top(0, 0, -std::numeric_limits<double>::infinity());
  for (int block = 0; block < n_blocks(run); ++block) raise_to_highest(run, block, top);
  return top;
}

// The vertex of the toe block that is outermost in the direction of its last piece of path, put
// down to the ground.
Vec3 outermost_point(const RunFile& run, int block, const std::vector<Vec3>& path, const Trn& trn) {
  Vec2 forward = Vec2::Zero();
  for (std::size_t i = path.size() - 1; i > 0 && forward.norm() < 1e-9; --i)
    forward = (path.back() - path[i - 1]).head<2>();
  const Pose pose = last_pose(run, block);
  Vec3 toe = pose.position;
  for (int v = run.blocks.vertex_begin[block]; v < run.blocks.vertex_begin[block + 1]; ++v) {
    const Vec3 at = place(pose, run.blocks.vertices[v]);
    if (forward.dot(at.head<2>()) > forward.dot(toe.head<2>())) toe = at;
  }
  const double ground = elevation_at(trn, toe.x(), toe.y());
  if (!std::isnan(ground)) toe.z() = ground;
  return toe;
}

// The block that is farthest from the top, whatever its fate: one that still moves must not be left
// out of L. The length of its path says less: a block that danced in a hollow has a long one.
// Blocks that stayed where they were bound the source, not the run-out.
int find_toe_block(const RunFile& run, const Vec3& top,
                   const std::vector<WeightedValue>& displacement) {
  int toe = -1;
  double farthest = -1;
  for (int block = 0; block < n_blocks(run); ++block) {
    if (!(displacement[block].value > moved_m)) continue;
    const double distance = plan_distance(top, last_pose(run, block).position);
    if (distance <= farthest) continue;
    farthest = distance;
    toe = block;
  }
  return toe;
}

std::vector<Vec3> streamline_of(const RunFile& run, const Vec3& top, int toe_block, const Trn& trn,
                                double tolerance) {
  const std::vector<Vec3> path = simplified(block_path(run, toe_block), tolerance).point;
  const Vec3 toe = outermost_point(run, toe_block, path, trn);
  // The path is put on the ground, so that bounces and the block's own size do not bend the
  // profile.
  std::vector<Vec3> line{top};
  for (Vec3 at : path) {
    const double ground = elevation_at(trn, at.x(), at.y());
    if (!std::isnan(ground)) at.z() = ground;
    line.push_back(at);
  }
  line.push_back(toe);
  return line;
}

}  // namespace

namespace {

// Centroids of all blocks at the start, in plan.
std::vector<Vec2> source_outline(const RunFile& run) {
  std::vector<Vec2> starts;
  for (int block = 0; block < n_blocks(run); ++block)
    starts.push_back(first_pose(run, block).position.head<2>());
  return convex_outline(std::move(starts));
}

bool is_inside(const std::vector<Vec2>& outline, const Vec2& point) {
  if (outline.size() < 3) return false;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2 side = outline[(i + 1) % outline.size()] - outline[i], to = point - outline[i];
    if (side.x() * to.y() - side.y() * to.x() < 0) return false;
  }
  return true;
}

}  // namespace

double MassReach::angle() const { return angle_of(height, length); }

MassReach mass_reach(const RunFile& run, const std::vector<WeightedValue>& displacement) {
  struct End {
    double distance, z, mass;
  };
  MassReach reach;
  Vec3 top(0, 0, -std::numeric_limits<double>::infinity());
  const auto has_moved = [&](int block) { return displacement[block].value > moved_m; };
  for (int block = 0; block < n_blocks(run); ++block)
    if (has_moved(block)) raise_to_highest(run, block, top);
  std::vector<End> ends;
  double all = 0, left = 0;
  const std::vector<double> counted = counted_by(run);
  const std::vector<Vec2> source = source_outline(run);
  for (int block = 0; block < n_blocks(run); ++block) {
    if (!has_moved(block)) continue;
    const Vec3 at = last_pose(run, block).position;
    ends.push_back({plan_distance(top, at), at.z(), counted[block]});
    all += counted[block];
    reach.moved_volume += run.blocks.volume[block];
    if (!is_inside(source, at.head<2>())) left += counted[block];
  }
  if (ends.empty()) return {no_value, no_value, 0, no_value, no_value, 0, 0};
  reach.left_share = left / std::accumulate(counted.begin(), counted.end(), 0.0);
  std::stable_sort(ends.begin(), ends.end(),
                   [](const End& a, const End& b) { return a.distance < b.distance; });
  double within = 0;
  for (const End& end : ends) {
    if (within < reach_share * all * (1 - 1e-12)) {
      reach.length = end.distance;
      reach.height = top.z() - end.z;
    }
    within += end.mass;
  }
  for (const End& end : ends) {
    if (end.distance <= reach.length) continue;
    ++reach.n_beyond;
    reach.beyond_share += end.mass / all;
    reach.n_outliers += end.distance > outlier_factor * reach.length;
  }
  reach.toe_share = ends.back().mass / all;
  return reach;
}

double AngleProfile::at_end() const { return angle.empty() ? no_value : angle.back(); }

TimedPath block_path(const RunFile& run, int block) {
  constexpr double least_change = 0.5, gravity = 9.81;  // [m/s], [m/s2]
  TimedPath path;
  Vec3 before = Vec3::Zero();
  for (int k = 0; k < n_frames(run.frames); ++k) {
    const FrameBlock at = frame_block(run, k, block);
    const double speed = at.velocity.norm();
    const double by_weight = k == 0 ? 0 : gravity * (run.frames.time[k] - run.frames.time[k - 1]);
    const Vec3 change = at.velocity - before + by_weight * Vec3::UnitZ();
    path.time.push_back(run.frames.time[k]);
    path.point.push_back(at.position);
    path.speed.push_back(speed);
    path.spin.push_back(at.spin.norm());
    path.energy.push_back(0.5 * run.blocks.mass[block] * speed * speed +
                          kinetic_rotation(run, block, at));
    path.is_impact.push_back(k > 0 && change.norm() > std::max(least_change, 2 * by_weight));
    before = at.velocity;
  }
  return path;
}

TimedPath centre_of_mass_path(const RunFile& run) {
  TimedPath path;
  for (int k = 0; k < n_frames(run.frames); ++k) {
    Vec3 moment = Vec3::Zero(), momentum = Vec3::Zero();
    double mass = 0;
    for (int block = 0; block < n_blocks(run); ++block) {
      const FrameBlock at = frame_block(run, k, block);
      moment += run.blocks.mass[block] * at.position;
      momentum += run.blocks.mass[block] * at.velocity;
      mass += run.blocks.mass[block];
    }
    path.time.push_back(run.frames.time[k]);
    path.point.emplace_back(moment / mass);
    path.speed.push_back(momentum.norm() / mass);
  }
  return path;
}

std::vector<int> simplified(std::span<const Vec3> points, double tolerance) {
  const int n = static_cast<int>(points.size());
  if (n == 0) return {};
  std::vector<bool> keep(points.size(), false);
  keep.front() = keep.back() = true;
  std::vector<std::pair<int, int>> open{{0, n - 1}};
  while (!open.empty()) {
    const auto [first, last] = open.back();
    open.pop_back();
    int farthest = -1;
    double largest = tolerance;
    for (int i = first + 1; i < last; ++i) {
      const double off = distance_to_segment(points[i], points[first], points[last]);
      if (off <= largest) continue;
      largest = off;
      farthest = i;
    }
    if (farthest < 0) continue;
    keep[farthest] = true;
    open.emplace_back(first, farthest);
    open.emplace_back(farthest, last);
  }
  std::vector<int> kept;
  for (int i = 0; i < n; ++i)
    if (keep[i]) kept.push_back(i);
  return kept;
}

namespace {

TimedPath points_of(const TimedPath& path, const std::vector<int>& kept) {
  TimedPath out;
  const auto keep = [&kept](const auto& values, auto& of_kept) {
    for (const int i : kept)
      if (!values.empty()) of_kept.push_back(values[i]);
  };
  keep(path.time, out.time);
  keep(path.point, out.point);
  keep(path.speed, out.speed);
  keep(path.distance, out.distance);
  keep(path.spin, out.spin);
  keep(path.energy, out.energy);
  keep(path.height, out.height);
  keep(path.is_impact, out.is_impact);
  return out;
}

}  // namespace

TimedPath simplified(const TimedPath& path, double tolerance) {
  return points_of(path, simplified(std::span(path.point), tolerance));
}

TimedPath shown_path(const RunFile& run, int block, const Trn& trn, double tolerance) {
  TimedPath path = block_path(run, block);
  for (std::size_t i = 0; i < path.point.size(); ++i) {
    const Vec3& p = path.point[i];
    path.height.push_back(contains(trn, p.x(), p.y()) ? p.z() - elevation_at(trn, p.x(), p.y())
                                                      : no_value);
    path.distance.push_back(i == 0 ? 0
                                   : path.distance.back() + plan_distance(path.point[i - 1], p));
  }
  std::vector<int> kept = simplified(std::span(path.point), tolerance);
  int highest = 0;  // since the last impact
  for (int i = 0; i < static_cast<int>(path.point.size()); ++i) {
    if (path.is_impact[i]) {
      kept.insert(kept.end(), {highest, i - 1, i});
      highest = i;
    }
    if (path.height[i] > path.height[highest]) highest = i;
  }
  std::sort(kept.begin(), kept.end());
  kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
  return points_of(path, kept);
}

double horizontal_length(std::span<const Vec3> points) {
  double length = 0;
  for (std::size_t i = 1; i < points.size(); ++i) length += plan_distance(points[i - 1], points[i]);
  return length;
}

ReachLine reach_along(std::span<const Vec3> points) {
  if (points.empty()) return {};
  return {points.front().z() - points.back().z(), horizontal_length(points),
          plan_distance(points.front(), points.back())};
}

AngleProfile angle_profile(std::span<const Vec3> points, double from, double tolerance) {
  AngleProfile profile;
  profile.smallest = profile.smallest_at = no_value;
  double distance = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i > 0) distance += plan_distance(points[i - 1], points[i]);
    const double angle = angle_of(points[0].z() - points[i].z(), distance);
    profile.angle.push_back(angle);
    if (std::isnan(angle) || distance < from) continue;
    if (angle >= profile.smallest) {  // false for the first: comparison with NaN fails
      const double head = profile.smallest_at * (std::tan(angle) - std::tan(profile.smallest));
      profile.missing_head = std::max(profile.missing_head, head);
      continue;
    }
    profile.smallest = angle;
    profile.smallest_at = distance;
  }
  profile.monotone = profile.missing_head <= tolerance;
  return profile;
}

RunReach reach_of_frames(const RunFile& run, const Trn& trn, const ReachSettings& settings) {
  RunReach reach;
  reach.tolerance = settings.tolerance;
  const auto n = static_cast<std::size_t>(n_blocks(run));
  reach.max_speed.assign(n, 0);
  reach.max_energy.assign(n, 0);
  for (int block = 0; block < n_blocks(run); ++block) {
    reach.block.push_back(
        reach_along(simplified(block_path(run, block), settings.tolerance).point));
    raise_by_frames(reach, run, block);
  }
  raise_by_passages(reach, run.passages);
  const std::vector<WeightedValue> displacement = displacements(run);
  if (!moved_of_run(run).any()) return reach;
  reach.centre_of_mass =
      reach_along(simplified(centre_of_mass_path(run), settings.tolerance).point);
  const Vec3 top = highest_point(run);
  reach.streamline =
      streamline_of(run, top, find_toe_block(run, top, displacement), trn, settings.tolerance);
  return reach;
}

EventReach event_reach(const RunFile& run, const Trn& trn, const ReachSettings& settings) {
  TALUS_ASSERT(!run.reach || run.reach->tolerance == settings.tolerance);
  const RunReach reach = run.reach ? *run.reach : reach_of_frames(run, trn, settings);
  EventReach event;
  double drop = 0, length = 0;
  for (int block = 0; block < n_blocks(run); ++block) {
    event.blocks.push_back({block, fate_of(run, block, settings.rest_speed), reach.block[block],
                            reach.max_speed[block], reach.max_energy[block]});
    drop += run.blocks.mass[block] * reach.block[block].height;
    length += run.blocks.mass[block] * reach.block[block].path;
  }
  const std::vector<WeightedValue> displacement = displacements(run);
  event.moved = moved_of_run(run);
  if (!event.moved.any()) {
    event.event = event.centre_of_mass = {no_value, no_value, no_value};
    event.sum_angle = event.profile.smallest = event.profile.smallest_at = no_value;
    event.mass = mass_reach(run, displacement);
    return event;
  }
  event.streamline = reach.streamline;
  event.top = event.streamline.front();
  event.toe = event.streamline.back();
  event.sum_angle = angle_of(drop, length);
  event.centre_of_mass = reach.centre_of_mass;
  event.toe_block = find_toe_block(run, event.top, displacement);
  event.toe_fate = event.blocks[event.toe_block].fate;
  event.event = reach_along(event.streamline);
  event.mass = mass_reach(run, displacement);
  // From where the toe block started: the piece from the top to there may lead sideways.
  event.profile = angle_profile(std::span<const Vec3>(event.streamline).subspan(1),
                                0.1 * event.event.path, settings.tolerance);
  return event;
}

std::vector<CurveRow> curves(const RunFile& run) {
  std::vector<CurveRow> rows;
  const TimedPath centre = centre_of_mass_path(run);
  for (int k = 0; k < n_frames(run.frames); ++k) {
    CurveRow row;
    row.time = run.frames.time[k];
    row.centre_of_mass = centre.point[k];
    double mass = 0;
    for (int block = 0; block < n_blocks(run); ++block) {
      const FrameBlock at = frame_block(run, k, block);
      const double speed = at.velocity.norm(), m = run.blocks.mass[block];
      mass += m;
      row.mean_speed += m * speed;
      row.max_speed = std::max(row.max_speed, speed);
      row.front = std::max(row.front, plan_distance(first_pose(run, block).position, at.position));
      row.translation += translational_energy(m, at.velocity);
      row.rotation += kinetic_rotation(run, block, at);
    }
    row.mean_speed /= mass;
    rows.push_back(row);
  }
  return rows;
}

EnergyShares energy_shares(const RunFile& run) {
  EnergyShares shares;
  if (run.health.empty()) return shares;
  const HealthRow &start = run.health.front(), &end = run.health.back();
  const double at_start = start.translation + start.rotation + start.elastic + spent_energy(start) -
                          start.base - start.water;
  shares.put_in = start.potential - end.potential + at_start + end.base + end.water;
  if (!(shares.put_in > 0)) return {};
  shares.friction = end.friction / shares.put_in;
  shares.impact = end.impact / shares.put_in;
  shares.contact = end.contact / shares.put_in;
  shares.fence = end.fence / shares.put_in;
  shares.rolling = end.rolling / shares.put_in;
  shares.drag = end.drag / shares.put_in;
  shares.breakage = end.breakage / shares.put_in;
  shares.removed = end.removed / shares.put_in;
  shares.kinetic = (end.translation + end.rotation) / shares.put_in;
  shares.elastic = end.elastic / shares.put_in;
  shares.unaccounted = 1 - spent_energy(end) / shares.put_in - shares.kinetic - shares.elastic;
  return shares;
}

}  // namespace talus
