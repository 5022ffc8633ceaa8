// Candidate lines for a fence uphill of an object: contours, or lines of equal distance.
#include "setup/fence_candidates.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/numbers.hpp"
#include "geometry/plan2d.hpp"
#include "geometry/segment_meetings.hpp"
#include "io/level_lines.hpp"

namespace talus {
namespace {

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
  double nearest = std::numeric_limits<double>::infinity(), z = no_value;
  for (const Vec3& s : samples) {
    const double distance = (s.head<2>() - p).squaredNorm();
    if (distance < nearest) {
      nearest = distance;
      z = s.z();
    }
  }
  return z;
}

// The grid about the object, no finer than the terrain, and the contoured values on it.
SampledField value_grid(const Trn& trn, const RecordObject& object,
                        const std::vector<Vec3>& samples, const CandidateSettings& settings) {
  Vec2 low = samples.front().head<2>(), high = low;
  for (const Vec3& s : samples) {
    low = low.cwiseMin(s.head<2>());
    high = high.cwiseMax(s.head<2>());
  }
  const double margin = settings.farthest + object.radius;
  low.array() -= margin;
  high.array() += margin;
  SampledField grid;
  grid.corner = low;
  grid.north = 1;
  grid.spacing = std::max(trn.cell_size, (high - low).maxCoeff() / most_nodes);
  grid.n_cols = static_cast<int>(std::ceil((high.x() - low.x()) / grid.spacing)) + 1;
  grid.n_rows = static_cast<int>(std::ceil((high.y() - low.y()) / grid.spacing)) + 1;
  for (int r = 0; r < grid.n_rows; ++r)
    for (int c = 0; c < grid.n_cols; ++c) {
      const Vec2 p = grid.corner + grid.spacing * Vec2(c, r);
      const double distance = gap_to(object, p);
      const double z = contains(trn, p.x(), p.y()) ? elevation_at(trn, p.x(), p.y()) : no_value;
      // a margin on both sides, so that lines at the limits themselves are found
      const bool in_zone = distance >= settings.nearest - grid.spacing &&
                           distance <= settings.farthest + grid.spacing &&
                           z > ground_at_nearest(samples, p);
      grid.value.push_back(in_zone ? (settings.by_contours ? z : distance) : no_value);
    }
  return grid;
}

double slope_at(const Trn& trn, const Vec2& p) {
  return triangle_gradient(trn, triangle_at(trn, p.x(), p.y())).norm();
}

bool crosses_itself(const std::vector<Vec2>& line) {
  std::vector<std::array<int, 2>> segments;
  for (int i = 0; i + 1 < static_cast<int>(line.size()); ++i) segments.push_back({i, i + 1});
  const SegmentMeetings meetings = find_segment_meetings(line, segments);
  return !meetings.crossings.empty() || !meetings.touches.empty();
}

// The pieces of a line where a fence can be built.
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

FenceCandidates lines_with_step(const Trn& trn, const RecordObject& object,
                                const SampledField& grid, double first_level,
                                const CandidateSettings& settings) {
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
    for (LevelLine& line : level_lines(grid, {level})) {
      // a fence ends beside its beginning
      if (line.points.front() == line.points.back()) line.points.pop_back();
      add_pieces(trn, object, line.points, settings, out);
    }
  }
  return out;
}

}  // namespace

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
  const SampledField grid = value_grid(trn, object, samples, given);
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
