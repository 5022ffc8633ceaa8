// Crossings of lines that are moved after the runs, from frames; moves a fence to a cheaper place.
#include "post/fence_search/paths.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/plan2d.hpp"
#include "post/deposit.hpp"
#include "record/motion.hpp"

namespace talus {
namespace {

struct PlanBox {
  Vec2 low = Vec2::Constant(std::numeric_limits<double>::infinity());
  Vec2 high = -low;
  void add(const Vec2& p) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  [[nodiscard]] bool holds(const Vec2& p, double margin) const {
    return p.x() >= low.x() - margin && p.x() <= high.x() + margin && p.y() >= low.y() - margin &&
           p.y() <= high.y() + margin;
  }
};
PlanBox plan_box_of(const std::vector<Vec2>& points) {
  PlanBox box;
  for (const Vec2& p : points) box.add(p);
  return box;
}

bool is_near(const Vec2& p, const std::vector<Vec2>& line, double margin) {
  for (std::size_t i = 0; i + 1 < line.size(); ++i)
    if (distance_to_segment(p, line[i], line[i + 1]) <= margin) return true;
  return false;
}

PathPoint path_point(const RunFile& run, int frame, int b) {
  const FrameBlock at = frame_block(run, frame, b);
  PathPoint out;
  out.time = run.frames.time[frame];
  out.position = at.position;
  out.speed = static_cast<float>(at.velocity.norm());
  out.energy = static_cast<float>(translational_energy(run.blocks.mass[b], at.velocity));
  const Vec3 spin = at.attitude.conjugate() * at.spin;
  out.spin_energy = static_cast<float>(0.5 * spin.cwiseAbs2().dot(run.blocks.inertia[b]));
  double top = -std::numeric_limits<double>::infinity(), bottom = -top;
  for (int v = run.blocks.vertex_begin[b]; v < run.blocks.vertex_begin[b + 1]; ++v) {
    const double z = (at.attitude * run.blocks.vertices[v]).z();
    top = std::max(top, z);
    bottom = std::min(bottom, z);
  }
  out.top = static_cast<float>(top);
  out.bottom = static_cast<float>(bottom);
  return out;
}

// Where a step of a path crosses a field of the line, as shares of both.
struct Meeting {
  double s = 0, w = 0;
  int field = 0, direction = 0;
};
std::optional<Meeting> first_meeting(const Fence& fence, const Vec2& a, const Vec2& b) {
  std::optional<Meeting> first;
  for (int f = 0; f < n_fields(fence); ++f) {
    const Vec2 p = fence.post[f].head<2>(), along = fence.post[f + 1].head<2>() - p;
    const double side_a = cross(along, a - p), side_b = cross(along, b - p);
    if ((side_a >= 0) == (side_b >= 0)) continue;
    const double s = side_a / (side_a - side_b);
    const double w = (a + s * (b - a) - p).dot(along) / along.squaredNorm();
    if (w < 0 || w > 1 || (first && first->s <= s)) continue;
    first = Meeting{s, w, f, side_b >= 0 ? 1 : -1};
  }
  return first;
}

FenceArrival arrival_of(const BlockPath& path, const PathPoint& a, const PathPoint& b,
                        const Meeting& at, const Fence& fence) {
  const auto between = [&](double from, double to) { return from + at.s * (to - from); };
  FenceArrival out;
  out.run = path.run;
  out.block = path.number;
  out.weight = path.weight;
  out.volume = path.volume;
  out.time = between(a.time, b.time);
  out.field = at.field;
  out.chainage =
      fence.chainage[at.field] + at.w * (fence.chainage[at.field + 1] - fence.chainage[at.field]);
  out.direction = at.direction;
  out.speed = between(a.speed, b.speed);
  out.translation = between(a.energy, b.energy);
  out.rotation = between(a.spin_energy, b.spin_energy);
  out.centroid = between(a.position.z(), b.position.z()) - base_at(fence, out.chainage);
  out.top = out.centroid + between(a.top, b.top);
  out.bottom = out.centroid + between(a.bottom, b.bottom);
  out.passed_for_good = true;
  return out;
}

// The fence as it was placed, the whole of its own line.
PlacedFence whole_of(const SearchLine& line) {
  PlacedFence placed;
  placed.to = length(line.fence);
  placed.n_fields = n_fields(line.fence);
  return placed;
}

bool can_stand(const std::vector<Vec3>& posts, const Trn& trn, const RefineLimits& limits,
               double spacing, int min_fields) {
  if (static_cast<int>(posts.size()) - 1 < min_fields) return false;
  for (std::size_t i = 0; i < posts.size(); ++i) {
    const Vec2 p = posts[i].head<2>();
    if (std::isnan(posts[i].z())) return false;
    if (triangle_gradient(trn, triangle_at(trn, p.x(), p.y())).norm() > limits.ground_slope)
      return false;
    if (limits.object != nullptr && gap_to(*limits.object, p) < limits.nearest) return false;
    if (i == 0) continue;
    const double far = (p - posts[i - 1].head<2>()).norm();
    if (far > 1.05 * spacing || far < 0.5 * spacing) return false;
    if (std::abs(posts[i].z() - posts[i - 1].z()) > limits.line_slope * far) return false;
  }
  return true;
}

// Horizontal, to the left of the line at a post.
Vec2 normal_at(const std::vector<Vec3>& posts, std::size_t i) {
  const Vec3& a = posts[i > 0 ? i - 1 : 0];
  const Vec3& b = posts[std::min(i + 1, posts.size() - 1)];
  const Vec2 along = (b - a).head<2>().normalized();
  return {-along.y(), along.x()};
}

using Posts = std::vector<Vec3>;

void put_on_ground(Posts& posts, const Trn& trn) {
  for (Vec3& post : posts) {
    const bool is_inside = contains(trn, post.x(), post.y());
    post.z() = is_inside ? elevation_at(trn, post.x(), post.y())
                         : std::numeric_limits<double>::quiet_NaN();
  }
}

// All lines that one move makes of a line.
std::vector<Posts> moves_of(const Posts& posts, double offset) {
  std::vector<Posts> out;
  for (const double by : {-offset, offset}) {
    Posts moved = posts;
    for (std::size_t i = 0; i < posts.size(); ++i) moved[i].head<2>() += by * normal_at(posts, i);
    out.push_back(moved);
  }
  out.emplace_back(posts.begin() + 1, posts.end());
  out.emplace_back(posts.begin(), posts.end() - 1);
  Posts longer = posts;
  longer.push_back(2 * posts.back() - posts[posts.size() - 2]);
  out.push_back(longer);
  longer = posts;
  longer.insert(longer.begin(), 2 * posts[0] - posts[1]);
  out.push_back(longer);
  for (std::size_t i = 0; i < posts.size(); ++i)
    for (const double by : {-offset, offset}) {
      Posts moved = posts;
      moved[i].head<2>() += by * normal_at(posts, i);
      out.push_back(moved);
    }
  return out;
}

bool is_within(const Posts& posts, const Posts& start, double farthest) {
  std::vector<Vec2> line;
  for (const Vec3& p : start) line.push_back(p.head<2>());
  return std::all_of(posts.begin(), posts.end(),
                     [&](const Vec3& p) { return is_near(p.head<2>(), line, farthest); });
}

// Blocks to be stopped are held without the end fields.
bool has_free_ends(const SearchLine& line, int end_fields, double needed) {
  const int last = n_fields(line.fence) - end_fields;
  double held = 0;
  for (const SearchHit& hit : line.hits)
    if (hit.matters && hit.arrival.field >= end_fields && hit.arrival.field < last)
      held += hit.arrival.weight;
  return held >= needed * (1 - 1e-9);
}

}  // namespace

void add_paths(std::vector<BlockPath>& paths, const RunFile& run, int run_index, int first_block,
               const std::vector<double>& on_object, const Corridor& corridor) {
  if (run.reach || n_frames(run.frames) < 3) return;
  std::vector<PlanBox> boxes;
  for (const std::vector<Vec2>& line : corridor.lines) boxes.push_back(plan_box_of(line));
  const auto is_inside = [&](int frame, int b) {
    const Vec2 p = frame_block(run, frame, b).position.head<2>();
    for (std::size_t l = 0; l < boxes.size(); ++l)
      if (boxes[l].holds(p, corridor.margin) && is_near(p, corridor.lines[l], corridor.margin))
        return true;
    return false;
  };
  for (int b = 0; b < n_blocks(run); ++b) {
    BlockPath path{
        run_index, first_block + b, b, weight_of(run, b), run.blocks.volume[b], on_object[b], {}};
    bool was_inside = false;
    for (int k = 0; k < n_frames(run.frames); ++k) {
      const bool inside = is_inside(k, b);
      // with the frames before and after, which a step into the corridor comes from
      if (inside && !was_inside && k > 0) path.points.push_back(path_point(run, k - 1, b));
      if (inside || was_inside) path.points.push_back(path_point(run, k, b));
      if (!inside && was_inside) {
        paths.push_back(path);
        path.points.clear();
      }
      was_inside = inside;
    }
    if (path.points.size() > 1) paths.push_back(path);
  }
}

SearchLine line_of_paths(const std::vector<BlockPath>& paths, const std::vector<Vec3>& posts,
                         int side) {
  SearchLine line;
  line.side = side;
  line.fence.post = posts;
  PlanBox box;
  for (std::size_t i = 0; i < posts.size(); ++i) {
    line.fence.chainage.push_back(
        i == 0 ? 0.0 : line.fence.chainage.back() + (posts[i] - posts[i - 1]).head<2>().norm());
    box.add(posts[i].head<2>());
  }
  int known = -1;  // block whose first crossing is there; its pieces come in the order of time
  for (const BlockPath& path : paths) {
    if (path.block == known) continue;
    for (std::size_t k = 0; k + 1 < path.points.size(); ++k) {
      const PathPoint &a = path.points[k], &b = path.points[k + 1];
      const Vec2 from = a.position.head<2>(), to = b.position.head<2>();
      const Vec2 low = from.cwiseMin(to), high = from.cwiseMax(to);
      if (low.x() > box.high.x() || high.x() < box.low.x() || low.y() > box.high.y() ||
          high.y() < box.low.y() || from == to)
        continue;
      const std::optional<Meeting> at = first_meeting(line.fence, from, to);
      if (!at) continue;
      SearchHit hit;
      hit.arrival = arrival_of(path, a, b, *at, line.fence);
      hit.block = path.block;
      hit.matters = hit.arrival.time < path.on_object && std::isfinite(path.on_object);
      line.hits.push_back(hit);
      known = path.block;
      break;
    }
  }
  sort_hits(line);
  return line;
}

RefinedFence refine(const SearchRuns& runs, const std::vector<BlockPath>& paths, const Fence& start,
                    int side, const DesignCode& code, const SearchSettings& settings,
                    const Trn& trn, const RefineLimits& limits) {
  const auto evaluated = [&](const Posts& posts) {
    RefinedFence out;
    out.line = line_of_paths(paths, posts, side);
    out.line.name = start.name;
    out.option = cheapest_on(runs, {out.line}, whole_of(out.line), code, settings, trn);
    return out;
  };
  const double needed = settings.share * weight_on_object(runs);
  RefinedFence best = evaluated(start.post);
  for (int round = 0; round < limits.most_rounds; ++round) {
    std::optional<RefinedFence> better;
    for (Posts& posts : moves_of(best.line.fence.post, limits.offset)) {
      put_on_ground(posts, trn);
      if (!can_stand(posts, trn, limits, settings.spacing, settings.min_fields) ||
          !is_within(posts, start.post, limits.farthest))
        continue;
      ++best.n_tried;
      RefinedFence moved = evaluated(posts);
      const FenceOption& so_far = better ? better->option : best.option;
      if (!moved.option.faults.empty() || !has_free_ends(moved.line, settings.end_fields, needed))
        continue;
      if (!so_far.faults.empty() || moved.option.cost < so_far.cost * (1 - 1e-3))
        better = std::move(moved);
    }
    if (!better) break;
    better->n_moves = best.n_moves + 1;
    better->n_tried = best.n_tried;
    best = std::move(*better);
  }
  return best;
}

}  // namespace talus
