#include "setup/fence_candidates.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "geometry/segment_meetings.hpp"

namespace talus {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr int most_nodes = 300;  // a side of the search's grid

// Points of an object a spacing apart, with the ground at each.
std::vector<Vec3> samples_of(const RecordObject& object, const Trn& trn, double spacing) {
  std::vector<Vec3> out;
  const auto add = [&](const Vec2& p) {
    const double z = elevation_at(trn, p.x(), p.y());
    if (!std::isnan(z)) out.emplace_back(p.x(), p.y(), z);
  };
  for (const ObjectPart& part : object.parts) {
    std::vector<Vec2> points = part.points;
    if (part.is_area) points.push_back(points.front());
    add(points.front());
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      const Vec2 along = points[i + 1] - points[i];
      const int n = std::max(1, static_cast<int>(std::ceil(along.norm() / spacing)));
      for (int k = 1; k <= n; ++k) add(points[i] + along * (static_cast<double>(k) / n));
    }
  }
  return out;
}

double ground_at_nearest(const std::vector<Vec3>& samples, const Vec2& p) {
  double nearest = std::numeric_limits<double>::infinity(), z = none;
  for (const Vec3& s : samples) {
    const double distance = (s.head<2>() - p).squaredNorm();
    if (distance < nearest) {
      nearest = distance;
      z = s.z();
    }
  }
  return z;
}

// The grid about the object, no finer than the terrain, and what is contoured on it.
ValueGrid value_grid(const Trn& trn, const RecordObject& object, const std::vector<Vec3>& samples,
                     const CandidateSettings& settings) {
  Vec2 low = samples.front().head<2>(), high = low;
  for (const Vec3& s : samples) {
    low = low.cwiseMin(s.head<2>());
    high = high.cwiseMax(s.head<2>());
  }
  const double margin = settings.farthest + object.radius;
  low.array() -= margin;
  high.array() += margin;
  ValueGrid grid;
  grid.first = low;
  grid.spacing = std::max(trn.cell_size, (high - low).maxCoeff() / most_nodes);
  grid.n_cols = static_cast<int>(std::ceil((high.x() - low.x()) / grid.spacing)) + 1;
  grid.n_rows = static_cast<int>(std::ceil((high.y() - low.y()) / grid.spacing)) + 1;
  for (int r = 0; r < grid.n_rows; ++r)
    for (int c = 0; c < grid.n_cols; ++c) {
      const Vec2 p = grid.first + grid.spacing * Vec2(c, r);
      const double distance = gap_to(object, p);
      const double z = contains(trn, p.x(), p.y()) ? elevation_at(trn, p.x(), p.y()) : none;
      // a margin on both sides, so that lines at the limits themselves are found
      const bool in_zone = distance >= settings.nearest - grid.spacing &&
                           distance <= settings.farthest + grid.spacing &&
                           z > ground_at_nearest(samples, p);
      grid.value.push_back(in_zone ? (settings.by_contours ? z : distance) : none);
    }
  return grid;
}

// Edges of the grid: 2 node for the one to the next column, 2 node + 1 to the next row.
using EdgeLinks = std::map<int, std::vector<int>>;

void link_cell(const ValueGrid& grid, int r, int c, double level, EdgeLinks& links) {
  const auto node = [&](int dr, int dc) { return (r + dr) * grid.n_cols + c + dc; };
  const std::array<int, 4> corner{node(0, 0), node(0, 1), node(1, 1), node(1, 0)};
  const std::array<int, 4> edge{2 * corner[0], 2 * corner[1] + 1, 2 * corner[3], 2 * corner[0] + 1};
  double sum = 0;
  std::array<bool, 4> above{};
  for (int i = 0; i < 4; ++i) {
    const double value = grid.value[corner[i]];
    if (std::isnan(value)) return;
    sum += value;
    above[i] = value >= level;
  }
  std::vector<int> crossed;  // sides of the cell, in order around it
  for (int i = 0; i < 4; ++i)
    if (above[i] != above[(i + 1) % 4]) crossed.push_back(i);
  if (crossed.empty()) return;
  // at a saddle the line cuts off the two corners that are unlike the middle
  if (crossed.size() == 4 && above[0] == (sum / 4 >= level))
    crossed = {0, 1, 2, 3};
  else if (crossed.size() == 4)
    crossed = {3, 0, 1, 2};
  for (std::size_t k = 0; k < crossed.size(); k += 2) {
    const int a = edge[crossed[k]], b = edge[crossed[k + 1]];
    links[a].push_back(b);
    links[b].push_back(a);
  }
}

Vec2 place_on(const ValueGrid& grid, int edge, double level) {
  const int node = edge / 2, next = edge % 2 == 0 ? node + 1 : node + grid.n_cols;
  const double a = grid.value[node], b = grid.value[next];
  const double s = a == b ? 0.5 : (level - a) / (b - a);
  const Vec2 at(node % grid.n_cols, node / grid.n_cols);
  return grid.first + grid.spacing * (at + s * (edge % 2 == 0 ? Vec2(1, 0) : Vec2(0, 1)));
}

// From `start` on, taking links away; ends where none is left.
std::vector<Vec2> walk(const ValueGrid& grid, double level, int start, EdgeLinks& links) {
  std::vector<Vec2> line{place_on(grid, start, level)};
  for (int at = start; !links[at].empty();) {
    const int to = links[at].front();
    links[at].erase(links[at].begin());
    std::vector<int>& back = links[to];
    back.erase(std::find(back.begin(), back.end(), at));
    if (to == start) break;
    line.push_back(place_on(grid, to, level));
    at = to;
  }
  return line;
}

double slope_at(const Trn& trn, const Vec2& p) {
  return triangle_gradient(trn, triangle_at(trn, p.x(), p.y())).norm();
}

double length_of(const std::vector<Vec2>& line) {
  double length = 0;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) length += (line[i + 1] - line[i]).norm();
  return length;
}

bool crosses_itself(const std::vector<Vec2>& line) {
  std::vector<std::array<int, 2>> segments;
  for (int i = 0; i + 1 < static_cast<int>(line.size()); ++i) segments.push_back({i, i + 1});
  const SegmentMeetings meetings = find_segment_meetings(line, segments);
  return !meetings.crossings.empty() || !meetings.touches.empty();
}

// The pieces of a line that a fence can stand on.
void add_pieces(const Trn& trn, const RecordObject& object, const std::vector<Vec2>& line,
                const CandidateSettings& settings, FenceCandidates& out) {
  std::vector<Vec2> piece;
  const auto close = [&] {
    if (piece.size() > 1) {
      if (length_of(piece) < settings.least_length - 1e-9)
        ++out.n_too_short;
      else if (!crosses_itself(piece))
        out.lines.push_back(piece);
    }
    piece.clear();
  };
  for (const Vec2& p : evenly_spaced(line, settings.spacing)) {
    const double z = elevation_at(trn, p.x(), p.y()), distance = gap_to(object, p);
    // a line of equal distance has it but for the error of the grid
    const double tolerance = (settings.by_contours ? 1e-3 : 0.1) * settings.spacing;
    const bool in_zone = !std::isnan(z) && distance > settings.nearest - tolerance &&
                         distance < settings.farthest + tolerance;
    const bool stands = in_zone && slope_at(trn, p) <= settings.ground_slope;
    if (!stands) {
      out.n_cut += in_zone;
      close();
      continue;
    }
    if (!piece.empty()) {
      const Vec2& last = piece.back();
      const double rise = std::abs(z - elevation_at(trn, last.x(), last.y()));
      if (rise > settings.line_slope * (p - last).norm()) {
        ++out.n_cut;
        close();
      }
    }
    piece.push_back(p);
  }
  close();
}

FenceCandidates lines_with_step(const Trn& trn, const RecordObject& object, const ValueGrid& grid,
                                double first_level, const CandidateSettings& settings) {
  FenceCandidates out;
  out.step = settings.step;
  double highest = -std::numeric_limits<double>::infinity();
  for (const double value : grid.value) {
    if (std::isnan(value)) continue;
    highest = std::max(highest, value);
    ++out.n_in_zone;
  }
  for (int k = 0;; ++k) {
    const double level = first_level + k * settings.step;
    if (!(level <= highest) || (!settings.by_contours && level > settings.farthest + 1e-9)) break;
    for (const std::vector<Vec2>& line : iso_lines(grid, level))
      add_pieces(trn, object, line, settings, out);
  }
  return out;
}

}  // namespace

std::vector<std::vector<Vec2>> iso_lines(const ValueGrid& grid, double level) {
  EdgeLinks links;
  for (int r = 0; r + 1 < grid.n_rows; ++r)
    for (int c = 0; c + 1 < grid.n_cols; ++c) link_cell(grid, r, c, level, links);
  std::vector<int> starts;
  for (const auto& [edge, to] : links)
    if (to.size() == 1) starts.push_back(edge);
  std::vector<int> all;
  for (const auto& [edge, to] : links) all.push_back(edge);
  starts.insert(starts.end(), all.begin(), all.end());  // what is left is closed
  std::vector<std::vector<Vec2>> lines;
  for (const int start : starts)
    if (!links[start].empty()) lines.push_back(walk(grid, level, start, links));
  return lines;
}

std::vector<Vec2> evenly_spaced(const std::vector<Vec2>& line, double spacing) {
  const double length = length_of(line);
  if (line.size() < 2 || !(length > 0)) return line;
  const int n = std::max(1, static_cast<int>(std::ceil(length / spacing - 1e-9)));
  std::vector<Vec2> out{line.front()};
  double before = 0;  // chainage of point i
  std::size_t i = 0;
  for (int k = 1; k < n; ++k) {
    const double at = length * k / n;
    while (i + 2 < line.size() && before + (line[i + 1] - line[i]).norm() < at) {
      before += (line[i + 1] - line[i]).norm();
      ++i;
    }
    const Vec2 along = line[i + 1] - line[i];
    out.push_back(line[i] + along * ((at - before) / along.norm()));
  }
  out.push_back(line.back());
  return out;
}

FenceCandidates fence_candidates(const Trn& trn, const RecordObject& object,
                                 const CandidateSettings& given) {
  const std::vector<Vec3> samples = samples_of(object, trn, std::max(trn.cell_size, 1.0));
  if (samples.empty()) return {};
  const ValueGrid grid = value_grid(trn, object, samples, given);
  double first_level = given.nearest;
  if (given.by_contours) {
    first_level = std::numeric_limits<double>::infinity();
    for (const Vec3& s : samples) first_level = std::min(first_level, s.z() + given.step);
  }
  CandidateSettings settings = given;
  for (;;) {
    FenceCandidates found = lines_with_step(trn, object, grid, first_level, settings);
    const int n = static_cast<int>(found.lines.size());
    if (n <= given.most) return found;
    settings.step *= std::max(1.1, static_cast<double>(n) / given.most);
  }
}

}  // namespace talus
