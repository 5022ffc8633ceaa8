// Finds contours and points whose heights contradict those around them.
#include "terrain/outliers.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>

#include "base/numbers.hpp"
#include "base/percentile.hpp"
#include "geometry/plan2d.hpp"
#include "terrain/as_index.hpp"
#include "terrain/contours.hpp"
#include "terrain/lone_levels.hpp"
#include "terrain/two_heights.hpp"

namespace talus {
namespace {

constexpr double contour_steps = 1.5;  // off its neighbours: more than one label, with room
constexpr double measured_steps = 2;   // beyond its neighbours
constexpr double most_edges = 0.8;     // to contours of another height

// Calls visit(point, contour point) for the edges of triangles that end at the contour of another
// line. Edges inside the map come twice, so that they weigh more than those of its rim.
template <class Visit>
void for_each_edge(const TriangleMesh& mesh, const LinesOfPoints& lines, const Visit& visit) {
  const int n = static_cast<int>(lines.line.size());
  for (const auto& corners : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const int a = corners[k], b = corners[(k + 1) % 3];
      if (a >= n || b >= n || lines.line[a] == lines.line[b]) continue;
      if (b < lines.n_contour_points) visit(a, b);
      if (a < lines.n_contour_points) visit(b, a);
    }
}

// The same for edges between two contours of different heights.
template <class Visit>
void for_each_step(const TriangleMesh& mesh, const LinesOfPoints& lines, const Visit& visit) {
  for_each_edge(mesh, lines, [&](int point, int other) {
    if (point >= lines.n_contour_points) return;
    const double above = mesh.points[point].z() - mesh.points[other].z();
    if (std::abs(above) > same_height_m) visit(point, other, above);
  });
}

// --- contours ------------------------------------------------------------------------------------

bool stands_off(std::int64_t n_above, std::int64_t n_below, std::int64_t n_edges) {
  return static_cast<double>(std::max(n_above, n_below)) >=
             most_edges * static_cast<double>(n_edges) &&
         n_edges > 0;
}

// Whether an edge is too high for its length, as a step between cells side by side would be.
bool is_impossible_edge(const TriangleMesh& mesh, int a, int b) {
  const Vec3 edge = mesh.points[b] - mesh.points[a];
  return std::abs(edge.z()) > impossible_step(edge.head<2>().norm());
}

// A contour that is off by the map's interval, and the heights of its surroundings.
struct Candidate {
  Outlier outlier{0, Vec3::Zero(), infinity, -infinity, false};
  std::int64_t n_impossible = 0;  // edges
  std::vector<double> above;      // by edge [m]
  std::vector<int> neighbours;    // lines beside it; after gather_steps() each once
  std::vector<double> steps;      // that its sound neighbours leave to sound contours beyond [m]
  bool has_sound_neighbour = false;
};

// For each line its candidate, -1: none.
std::vector<int> find_candidates(const TriangleMesh& mesh, const LinesOfPoints& lines,
                                 double interval, std::vector<Candidate>& candidates) {
  std::vector<std::int64_t> n_above(lines.n_lines), n_below = n_above, n_edges = n_above;
  for_each_step(mesh, lines, [&](int point, int, double above) {
    const std::size_t line = as_index(lines.line[point]);
    n_above[line] += above > contour_steps * interval ? 1 : 0;
    n_below[line] += above < -contour_steps * interval ? 1 : 0;
    ++n_edges[line];
  });
  std::vector<int> candidate_of(lines.n_lines, -1);
  for (int l = 0; l < lines.n_lines; ++l) {
    if (!stands_off(n_above[l], n_below[l], n_edges[l])) continue;
    candidate_of[l] = static_cast<int>(candidates.size());
    candidates.emplace_back().outlier.line = l;
  }
  return candidate_of;
}

void gather_neighbours(const TriangleMesh& mesh, const LinesOfPoints& lines,
                       const std::vector<int>& candidate_of, std::vector<Candidate>& candidates) {
  for_each_step(mesh, lines, [&](int point, int other, double above) {
    const int c = candidate_of[lines.line[point]];
    if (c < 0) return;
    Candidate& candidate = candidates[c];
    const double z = mesh.points[other].z();
    if (candidate.above.empty()) candidate.outlier.place = mesh.points[point];
    candidate.outlier.low = std::min(candidate.outlier.low, z);
    candidate.outlier.high = std::max(candidate.outlier.high, z);
    candidate.above.push_back(above);
    candidate.n_impossible += is_impossible_edge(mesh, point, other) ? 1 : 0;
    candidate.neighbours.push_back(lines.line[other]);
    candidate.has_sound_neighbour |= candidate_of[lines.line[other]] < 0;
  });
}

void gather_steps(const TriangleMesh& mesh, const LinesOfPoints& lines,
                  const std::vector<int>& candidate_of, std::vector<Candidate>& candidates) {
  std::vector<std::vector<int>> beside(lines.n_lines);  // candidates beside each line
  for (std::size_t c = 0; c < candidates.size(); ++c) {
    std::vector<int>& neighbours = candidates[c].neighbours;
    std::sort(neighbours.begin(), neighbours.end());
    neighbours.erase(std::unique(neighbours.begin(), neighbours.end()), neighbours.end());
    for (const int line : neighbours)
      if (candidate_of[line] < 0) beside[line].push_back(static_cast<int>(c));
  }
  for_each_step(mesh, lines, [&](int point, int other, double above) {
    if (candidate_of[lines.line[other]] >= 0) return;
    for (const int c : beside[lines.line[point]]) candidates[c].steps.push_back(std::abs(above));
  });
}

double step_of(const Candidate& candidate, double interval) {
  return candidate.steps.empty() ? interval : std::max(interval, median(candidate.steps));
}

bool stands_off(const Candidate& candidate, double step) {
  const auto count = [&](double sign) {
    return std::count_if(candidate.above.begin(), candidate.above.end(),
                         [&](double above) { return sign * above > contour_steps * step; });
  };
  return stands_off(count(1), count(-1), static_cast<std::int64_t>(candidate.above.size()));
}

// The last contour at the rim differs from the wrong one beside it, too, and has no other
// neighbour.
bool is_beside_culprit(const Candidate& candidate, const std::vector<int>& candidate_of,
                       const std::vector<Candidate>& candidates) {
  if (candidate.has_sound_neighbour) return false;
  return std::any_of(candidate.neighbours.begin(), candidate.neighbours.end(),
                     [&](int line) { return candidates[candidate_of[line]].has_sound_neighbour; });
}

std::vector<Outlier> contour_outliers(const TriangleMesh& mesh, const LinesOfPoints& lines,
                                      double interval) {
  std::vector<Candidate> candidates;
  const std::vector<int> candidate_of = find_candidates(mesh, lines, interval, candidates);
  if (candidates.empty()) return {};
  gather_neighbours(mesh, lines, candidate_of, candidates);
  gather_steps(mesh, lines, candidate_of, candidates);
  std::vector<Outlier> found;
  for (Candidate& candidate : candidates) {
    if (!stands_off(candidate, step_of(candidate, interval)) ||
        is_beside_culprit(candidate, candidate_of, candidates))
      continue;
    candidate.outlier.is_impossible =
        stands_off(candidate.n_impossible, 0, static_cast<std::int64_t>(candidate.above.size()));
    found.push_back(candidate.outlier);
  }
  return found;
}

// --- measured points -----------------------------------------------------------------------------

std::vector<Outlier> measured_outliers(const TriangleMesh& mesh, const LinesOfPoints& lines,
                                       double interval) {
  const std::size_t first = as_index(lines.n_contour_points);
  std::vector<double> low(lines.line.size() - first, infinity), high(low.size(), -infinity);
  std::vector<std::int64_t> n_edges(low.size()), n_impossible(low.size());
  for_each_edge(mesh, lines, [&](int point, int contour) {
    if (as_index(point) < first) return;
    const double z = mesh.points[contour].z();
    low[as_index(point) - first] = std::min(low[as_index(point) - first], z);
    high[as_index(point) - first] = std::max(high[as_index(point) - first], z);
    ++n_edges[as_index(point) - first];
    n_impossible[as_index(point) - first] += is_impossible_edge(mesh, point, contour) ? 1 : 0;
  });
  std::vector<Outlier> found;
  for (std::size_t i = 0; i < low.size(); ++i) {
    const Vec3& point = mesh.points[first + i];
    const double limit = measured_steps * std::max(interval, high[i] - low[i]);
    if (!(point.z() > high[i] + limit || point.z() < low[i] - limit) || low[i] > high[i]) continue;
    found.push_back({lines.line[first + i], point, low[i], high[i],
                     stands_off(n_impossible[i], 0, n_edges[i])});
  }
  return found;
}

// --- two heights in one place --------------------------------------------------------------------

// Spot heights: the upper one of two, and those off a contour where no other contour goes with
// them. A breakline there may be the edge of a wall.
std::vector<Outlier> two_heights(const TriangleMesh& mesh, const LinesOfPoints& lines,
                                 double interval) {
  std::vector<int> n_points(as_index(lines.n_lines));
  for (const int line : lines.line) ++n_points[line];
  const auto n = static_cast<int>(lines.line.size());
  const auto is_spot = [&](int point) {
    return point >= lines.n_contour_points && point < n && n_points[lines.line[point]] == 1;
  };
  std::vector<Outlier> found;
  std::map<int, double> off;  // by spot: a contour in its place [m]
  std::set<int> alike;        // spots with a contour in place that goes with them
  for (const auto& corners : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const int spot = corners[k], next = corners[(k + 1) % 3], last = corners[(k + 2) % 3];
      if (!is_spot(spot)) continue;
      const Vec3& place = mesh.points[spot];
      for (const int other : {next, last}) {
        const double z = mesh.points[other].z();
        if (is_spot(other) && place.z() > z &&
            are_two_heights(place, mesh.points[other], one_place_m))
          found.push_back({lines.line[spot], place, z, z, false});
      }
      if (std::max(next, last) >= lines.n_contour_points) continue;
      if (lines.line[next] != lines.line[last]) continue;
      const Vec3 &from = mesh.points[next], &to = mesh.points[last];
      const Vec3 beside(
          place.x() + distance_to_segment<Vec2>(place.head<2>(), from.head<2>(), to.head<2>()),
          place.y(), from.z());
      if ((beside - place).head<2>().norm() > one_place_m) continue;
      const bool is_off = are_two_heights(place, beside, one_place_m) &&
                          std::abs(place.z() - beside.z()) > interval / 2;
      if (is_off) off[spot] = beside.z();
      if (!is_off) alike.insert(spot);
    }
  for (const auto& [spot, z] : off)
    if (!alike.contains(spot)) found.push_back({lines.line[spot], mesh.points[spot], z, z, false});
  return found;
}

// By line; of a line the one that says most about it.
void keep_one_of_each(std::vector<Outlier>& found) {
  std::stable_sort(found.begin(), found.end(), [](const Outlier& a, const Outlier& b) {
    return a.line != b.line ? a.line < b.line : a.is_impossible > b.is_impossible;
  });
  const auto same = [](const Outlier& a, const Outlier& b) { return a.line == b.line; };
  found.erase(std::unique(found.begin(), found.end(), same), found.end());
}

}  // namespace

std::vector<Outlier> find_outliers(const TriangleMesh& mesh, const LinesOfPoints& lines,
                                   double interval) {
  std::vector<Outlier> found = contour_outliers(mesh, lines, interval);
  std::vector<Outlier> measured = measured_outliers(mesh, lines, interval);
  const std::vector<Outlier> two = two_heights(mesh, lines, interval);
  measured.insert(measured.end(), two.begin(), two.end());
  keep_one_of_each(measured);
  found.insert(found.end(), measured.begin(), measured.end());
  return found;
}

}  // namespace talus
