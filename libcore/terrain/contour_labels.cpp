// Finds the height of each contour from the label nearest to it.
#include "terrain/contour_labels.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "base/disjoint_sets.hpp"
#include "base/numbers.hpp"
#include "geometry/plan2d.hpp"

namespace talus {
namespace {

constexpr double clearly_nearer = 0.5;

// A line as a label sees it.
struct LineBeside {
  int line = -1;
  double distance = infinity;
  bool is_at_end = false;
  Vec2 place = Vec2::Zero(), outward = Vec2::Zero();  // of that end
};

LineBeside look(const Polylines& lines, int line, const Vec2& label) {
  const int begin = lines.begin[line], end = lines.begin[line + 1];
  LineBeside beside;
  beside.line = line;
  const auto point = [&](int i) { return Vec2(lines.points[i].head<2>()); };
  const bool is_ring = point(begin) == point(end - 1);
  for (int i = begin; i + 1 < end; ++i) {
    const Vec2 a = point(i), d = point(i + 1) - a;
    const double share = share_along_segment<Vec2>(label, a, point(i + 1));
    const double distance = (label - a - share * d).norm();
    if (!(distance < beside.distance)) continue;
    beside.distance = distance;
    const bool is_first = i == begin && share == 0, is_last = i + 2 == end && share == 1;
    beside.is_at_end = !is_ring && (is_first || is_last);
    beside.place = a + share * d;
    beside.outward = (is_first ? Vec2(-d) : d).normalized();
  }
  return beside;
}

std::array<LineBeside, 2> two_nearest(const Polylines& lines, const Vec2& label) {
  std::array<LineBeside, 2> nearest;
  for (int l = 0; l < lines.n_lines(); ++l) {
    const LineBeside beside = look(lines, l, label);
    if (beside.distance < nearest[0].distance)
      nearest[1] = std::exchange(nearest[0], beside);
    else if (beside.distance < nearest[1].distance)
      nearest[1] = beside;
  }
  return nearest;
}

// Whether two ends look at each other: a line is broken there.
bool is_gap_between(const LineBeside& a, const LineBeside& b) {
  if (!a.is_at_end || !b.is_at_end) return false;
  const Vec2 across = (b.place - a.place).normalized();
  return a.outward.dot(across) > 0.7 && b.outward.dot(across) < -0.7;
}

// Lines that share an end, by the first of them.
std::vector<int> contours_of(const Polylines& lines) {
  DisjointSets contours(lines.n_lines());
  std::map<std::pair<double, double>, int> line_at;
  for (int l = 0; l < lines.n_lines(); ++l)
    for (const int i : {lines.begin[l], lines.begin[l + 1] - 1}) {
      const Vec3& end = lines.points[i];
      const auto [at, is_new] = line_at.try_emplace({end.x(), end.y()}, l);
      contours.join(l, at->second);
    }
  std::vector<int> first;
  for (int l = 0; l < lines.n_lines(); ++l) first.push_back(contours.root(l));
  return first;
}

}  // namespace

LabelledLines heights_from_labels(const Polylines& lines, const std::vector<Vec3>& labels) {
  LabelledLines found;
  const std::vector<int> contour = contours_of(lines);
  std::vector<double> height(lines.n_lines(), std::nan(""));
  const auto set = [&](int line, double label) {
    double& there = height[contour[line]];
    if (!std::isnan(there) && std::abs(there - label) > same_height_m && found.line_at_two < 0)
      found.line_at_two = line, found.two_heights = {there, label};
    there = label;
  };
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const auto [first, second] = two_nearest(lines, labels[i].head<2>());
    const bool is_gap = is_gap_between(first, second);
    const bool is_one = second.line < 0 || contour[first.line] == contour[second.line];
    if (first.distance > clearly_nearer * second.distance && !is_gap && !is_one) {
      found.unclear.push_back(static_cast<int>(i));
      continue;
    }
    set(first.line, labels[i].z());
    if (is_gap && first.distance > clearly_nearer * second.distance)
      set(second.line, labels[i].z());
  }
  for (int l = 0; l < lines.n_lines(); ++l) {
    found.height.push_back(height[contour[l]]);
    if (std::isnan(found.height.back())) found.without.push_back(l);
  }
  return found;
}

}  // namespace talus
