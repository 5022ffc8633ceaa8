// Arrivals of blocks at fences and their verdicts: stopped, beside, over, under, through.
#include "post/fence/fence.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "base/numbers.hpp"
#include "geometry/plan2d.hpp"
#include "record/pieces.hpp"

namespace talus {
namespace {

int field_at(const Fence& fence, double chainage) {
  const auto after = std::upper_bound(fence.chainage.begin(), fence.chainage.end(), chainage);
  return std::clamp(static_cast<int>(after - fence.chainage.begin()) - 1, 0, n_fields(fence) - 1);
}

int nearest_post(const Fence& fence, double chainage) {
  const int field = field_at(fence, chainage);
  const double before = chainage - fence.chainage[field];
  return fence.chainage[field + 1] - chainage < before ? field + 1 : field;
}

Vec2 along(const Fence& fence, int field) {
  return (fence.post[field + 1] - fence.post[field]).head<2>().normalized();
}

// Horizontal, to the left of the line.
Vec2 normal_of(const Fence& fence, int field) {
  const Vec2 tangent = along(fence, field);
  return {-tangent.y(), tangent.x()};
}

// Angle between the horizontal velocity and the normal of the field, 0 to 90 degrees.
double angle_to_normal(const Vec3& velocity, const Vec2& tangent) {
  const double parallel = std::abs(velocity.head<2>().dot(tangent));
  const double across = std::abs(cross(velocity.head<2>(), tangent));
  return std::atan2(parallel, across);
}

// The direction of moving is to the left of the line (+1): then its first point is on the left.
Verdict bypass(const FenceArrival& arrival) {
  const bool at_first_end = arrival.chainage < 0;
  const bool left = arrival.direction > 0 ? at_first_end : !at_first_end;
  return left ? Verdict::bypassed_left : Verdict::bypassed_right;
}

double distance_to(const Fence& fence, int field, const Vec2& p) {
  return distance_to_segment<Vec2>(p, fence.post[field].head<2>(), fence.post[field + 1].head<2>());
}

int nearest_field(const Fence& fence, const Vec2& p) {
  int nearest = 0;
  for (int i = 1; i < n_fields(fence); ++i)
    if (distance_to(fence, i, p) < distance_to(fence, nearest, p)) nearest = i;
  return nearest;
}

double distance_to(const Fence& fence, const Vec2& p) {
  return distance_to(fence, nearest_field(fence, p), p);
}

// The panels of a line as the blocks of a run met them.
class PanelsOfLine {
 public:
  PanelsOfLine(const RunFile& file, int line) : world_(worlds_of(file)) {
    for (const PanelRow& row : file.panels)
      if (row.line == line) rows_[{row.rock, row.panel}] = &row;
    for (const FenceHit& hit : file.fence_hits)
      if (hit.line == line) touched_.emplace(hit.block, hit.panel);
  }
  // As the block's rock left it or, where that pushed it not or blocks share it, as it is for all.
  [[nodiscard]] const PanelRow* met_by(int block, int panel) const {
    for (const int rock : {world_[static_cast<std::size_t>(block)], -1})
      if (const auto found = rows_.find({rock, panel}); found != rows_.end()) return found->second;
    return nullptr;
  }
  [[nodiscard]] bool is_touched(int block, int panel) const {
    return touched_.contains({block, panel});
  }

 private:
  std::vector<int> world_;
  std::map<std::pair<int, int>, const PanelRow*> rows_;  // by rock and panel
  std::set<std::pair<int, int>> touched_;                // block and panel
};

// The block as it was before it touched the panel, as far as the run recorded it.
FenceArrival arrival_of(const FenceHit& hit, const RunFile& file, const Fence& fence, int run) {
  FenceArrival a;
  a.run = run;
  a.block = hit.block;
  a.weight = weight_of(file, hit.block);
  a.time = hit.time;
  a.chainage = hit.chainage;
  a.by_touch = true;
  a.direction = hit.velocity.head<2>().dot(normal_of(fence, hit.panel)) < 0 ? -1 : 1;
  a.field = hit.panel;
  a.post = nearest_post(fence, hit.chainage);
  a.angle = angle_to_normal(hit.velocity, along(fence, hit.panel));
  a.speed = hit.velocity.norm();
  a.translation = hit.translational_energy;
  a.rotation = hit.rotational_energy;
  a.spin = a.centroid = no_value;
  a.top = hit.top_height;
  a.bottom = hit.bottom_height;
  a.volume = file.blocks.volume[hit.block];
  return a;
}

// Panels that may hold a block: the one nearest to its last place, and those that it touched. Is
// one of them active and pushed as far as the block lies beyond the line?
bool is_held(const RunFile& file, const PanelsOfLine& panels, const Fence& fence, int block,
             int direction) {
  const Vec2 at = last_pose(file, block).position.head<2>();
  const int field = nearest_field(fence, at);
  const double beyond = direction * (at - fence.post[field].head<2>()).dot(normal_of(fence, field));
  for (int i = 0; i < n_fields(fence); ++i) {
    const PanelRow* panel = panels.met_by(block, i);
    if (panel != nullptr && std::isinf(panel->broken_at) &&
        beyond <= std::max(0.0, direction * panel->deflection) &&
        (i == field || panels.is_touched(block, i)))
      return true;
  }
  return false;
}

}  // namespace

const char* text(Verdict verdict) {
  constexpr std::array names = {"stopped",       "pierced",        "free_border", "overtopped",
                                "bypassed_left", "bypassed_right", "underpassed", "not_reached"};
  return names[static_cast<std::size_t>(verdict)];
}

Fence make_fence(const RecordLine& line, const FenceSettings& settings) {
  return {line.name, line.points, line.chainage, settings.height_m, settings.capacity_kj * 1e3};
}

double base_at(const Fence& fence, double chainage) {
  const int field = field_at(fence, chainage);
  const double c0 = fence.chainage[field], c1 = fence.chainage[field + 1];
  const double s = std::clamp((chainage - c0) / (c1 - c0), 0.0, 1.0);
  return fence.post[field].z() + s * (fence.post[field + 1].z() - fence.post[field].z());
}

Vec3 place_of(const FenceArrival& arrival, const Fence& fence) {
  const int field = field_at(fence, arrival.chainage);
  const double s = (arrival.chainage - fence.chainage[field]) /
                   (fence.chainage[field + 1] - fence.chainage[field]);
  Vec3 at = fence.post[field] + s * (fence.post[field + 1] - fence.post[field]);
  at.z() = base_at(fence, arrival.chainage) +
           (arrival.by_touch ? 0.5 * (arrival.top + arrival.bottom) : arrival.centroid);
  return at;
}

std::vector<FenceArrival> line_crossings(const RunFile& file, int line, const Fence& fence,
                                         int run) {
  std::vector<FenceArrival> out;
  const std::vector<int> world = worlds_of(file);
  for (const Crossing& c : file.crossings) {
    if (c.line != line) continue;
    FenceArrival a;
    a.run = run;
    a.block = c.block;
    a.world = world[static_cast<std::size_t>(c.block)];
    a.weight = weight_of(file, c.block);
    a.time = c.time;
    a.chainage = c.chainage;
    a.beside = c.beside;
    a.direction = c.direction;
    if (!c.beside) {
      a.field = field_at(fence, c.chainage);
      a.post = nearest_post(fence, c.chainage);
      a.angle = angle_to_normal(c.velocity, along(fence, a.field));
    }
    a.speed = c.velocity.norm();
    a.spin = c.spin.norm();
    a.translation = c.translational_energy;
    a.rotation = c.rotational_energy;
    a.centroid = c.position.z() - base_at(fence, c.chainage);
    a.top = a.centroid + c.top_height - c.centroid_height;
    a.bottom = a.centroid + c.bottom_height - c.centroid_height;
    a.volume = file.blocks.volume[c.block];
    a.passed_for_good = c.beside || c.n_crossings % 2 == 1;
    out.push_back(a);
  }
  return out;
}

std::vector<FenceArrival> arrivals(const RunFile& file, int line, const Fence& fence, int run) {
  std::map<int, FenceArrival> of_block;
  for (const FenceArrival& crossing : line_crossings(file, line, fence, run))
    of_block[crossing.block] = crossing;
  std::map<int, const FenceHit*> first;
  for (const FenceHit& hit : file.fence_hits) {
    if (hit.line != line) continue;
    const FenceHit*& known = first[hit.block];
    if (known == nullptr || hit.time < known->time) known = &hit;
  }
  const std::vector<int> world = worlds_of(file);
  for (const auto& [block, hit] : first) {
    of_block[block] = arrival_of(*hit, file, fence, run);
    of_block[block].world = world[static_cast<std::size_t>(block)];
  }
  std::vector<FenceArrival> out;
  for (const auto& [block, arrival] : of_block) out.push_back(arrival);
  return out;
}

Verdict expected_verdict(const FenceArrival& arrival, const Fence& fence, double free_border) {
  if (arrival.beside) return bypass(arrival);
  if (arrival.top < 0) return Verdict::underpassed;
  if (arrival.bottom > fence.height) return Verdict::overtopped;
  if (arrival.energy() > fence.capacity) return Verdict::pierced;  // false for an unknown capacity
  if (arrival.top > fence.height - free_border) return Verdict::free_border;
  return Verdict::stopped;
}

Verdict observed_verdict(const FenceArrival& arrival, const Fence& fence, double free_border) {
  if (arrival.beside) return bypass(arrival);
  if (arrival.top < 0) return Verdict::underpassed;
  if (arrival.bottom > fence.height) return Verdict::overtopped;
  if (arrival.top > fence.height - free_border && !(arrival.energy() > fence.capacity))
    return Verdict::free_border;
  return Verdict::pierced;
}

bool came_near(const RunFile& file, int block, const Fence& fence, double contact) {
  for (int k = 0; k < n_frames(file.frames); ++k) {
    const FrameBlock at = frame_block(file, k, block);
    for (int v = file.blocks.vertex_begin[block]; v < file.blocks.vertex_begin[block + 1]; ++v) {
      const Vec3 point = at.position + at.attitude * file.blocks.vertices[v];
      if (distance_to(fence, point.head<2>()) <= contact) return true;
    }
  }
  return false;
}

std::vector<FenceTouch> touches(const RunFile& file, int line, const Fence& fence,
                                const std::vector<FenceArrival>& crossings) {
  std::vector<FenceTouch> out(static_cast<std::size_t>(n_blocks(file)));
  for (const FenceHit& hit : file.fence_hits) {
    FenceTouch& touch = out[hit.block];
    if (hit.line == line) touch.time = std::min(touch.time, hit.time);
  }
  const PanelsOfLine panels(file, line);
  for (const FenceArrival& crossing : crossings) {
    if (crossing.beside) continue;
    FenceTouch& touch = out[crossing.block];
    if (const PanelRow* panel = panels.met_by(crossing.block, crossing.field))
      touch.gap_since = panel->broken_at;
    touch.held = is_held(file, panels, fence, crossing.block, crossing.direction);
  }
  return out;
}

Verdict touched_verdict(const FenceTouch& touch, const FenceArrival* crossing, const Fence& fence,
                        double free_border) {
  const bool touched = touch.time < FenceTouch::never;
  if (crossing == nullptr) return touched ? Verdict::stopped : Verdict::not_reached;
  if (crossing->beside)
    return touched && crossing->time < touch.time ? Verdict::stopped : bypass(*crossing);
  if (crossing->top < 0) return Verdict::underpassed;
  if (crossing->bottom > fence.height) return Verdict::overtopped;
  if (touch.held) return Verdict::stopped;
  // without a touch it came through where a panel was broken before
  if (!touched || touch.gap_since <= crossing->time) return Verdict::pierced;
  return crossing->top > fence.height - free_border ? Verdict::free_border : Verdict::pierced;
}

std::vector<BlockVerdict> verdicts_of(const RunFile& file, int run, int line,
                                      const std::vector<FenceArrival>& of_run, const Fence& fence,
                                      double free_border, bool standing, double contact) {
  std::vector<BlockVerdict> out;
  for (int block = 0; block < n_blocks(file); ++block)
    out.push_back({run, block, Verdict::not_reached, -1});
  for (std::size_t i = 0; i < of_run.size(); ++i)
    out[of_run[i].block].arrival = static_cast<int>(i);
  const std::vector<FenceArrival> crossings = line_crossings(file, line, fence, run);
  std::vector<const FenceArrival*> crossing_of(out.size(), nullptr);
  for (const FenceArrival& crossing : crossings) crossing_of[crossing.block] = &crossing;
  const bool has_hits = std::any_of(file.panels.begin(), file.panels.end(),
                                    [line](const PanelRow& panel) { return panel.line == line; });
  const std::vector<FenceTouch> touch = touches(file, line, fence, crossings);
  for (BlockVerdict& v : out) {
    const FenceArrival* const crossing = crossing_of[v.block];
    if (standing && has_hits)
      v.verdict = touched_verdict(touch[v.block], crossing, fence, free_border);
    else if (crossing != nullptr)
      v.verdict = standing ? observed_verdict(*crossing, fence, free_border)
                           : expected_verdict(*crossing, fence, free_border);
    else if (standing && came_near(file, v.block, fence, contact))
      v.verdict = Verdict::stopped;
  }
  return out;
}

int uphill_side(const Fence& fence, const Trn& trn) {
  double higher_on_the_left = 0;
  for (int field = 0; field < n_fields(fence); ++field) {
    const Vec2 left = normal_of(fence, field);
    const Vec2 middle = 0.5 * (fence.post[field] + fence.post[field + 1]).head<2>();
    const Vec2 a = middle + fence.height * left, b = middle - fence.height * left;
    const double rise = elevation_at(trn, a.x(), a.y()) - elevation_at(trn, b.x(), b.y());
    if (!std::isnan(rise))
      higher_on_the_left += rise * (fence.chainage[field + 1] - fence.chainage[field]);
  }
  return higher_on_the_left < 0 ? -1 : 1;
}

double storage(const Fence& fence, int field, int side, const Trn& trn, double reach) {
  const Vec2 a = fence.post[field].head<2>(), b = fence.post[field + 1].head<2>();
  const Vec2 uphill = side * normal_of(fence, field);
  const double step = 0.25 * trn.cell_size;
  const int n_across = std::max(1, static_cast<int>(std::ceil((b - a).norm() / step)));
  const double width = (b - a).norm() / n_across;
  double volume = 0;
  for (int i = 0; i < n_across; ++i) {
    const double s = (i + 0.5) / n_across;
    const Vec2 foot = a + s * (b - a);
    const double fill = fence.post[field].z() +
                        s * (fence.post[field + 1].z() - fence.post[field].z()) + fence.height;
    for (double far = 0.5 * step; far < reach; far += step) {
      const Vec2 at = foot + far * uphill;
      const double depth = fill - elevation_at(trn, at.x(), at.y());
      if (!(depth > 0) || depth > 2 * fence.height) break;
      volume += depth * step * width;
    }
  }
  return volume;
}

}  // namespace talus
