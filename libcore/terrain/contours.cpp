// Cleans a contour map: joins lines that meet at one height, refuses those that meet at two.
#include "terrain/contours.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.hpp"
#include "base/percentile.hpp"
#include "base/text.hpp"
#include "geometry/plan2d.hpp"
#include "geometry/segment_meetings.hpp"
#include "terrain/as_index.hpp"

namespace talus {
namespace {

constexpr int max_rounds = 8;  // splitting rounds; each leaves only meetings made by rounding

enum class Kind : std::uint8_t { contour, breakline, spot };

// A segment and the line it belongs to; lines count on from contours to breaklines.
struct Segment {
  int a = 0, b = 0, line = 0;
};

struct Network {
  std::vector<Vec3> points;
  std::vector<Kind> kind;  // of each point
  std::vector<int> line;   // of each point; spots count on from breaklines
  std::vector<Segment> segments;
};

Vec2 plan(const Vec3& point) { return point.head<2>(); }

constexpr double measured_alike_m = 0.1;  // two measured heights of one place

// Collects places where heights disagree.
class HeightJudge {
 public:
  HeightJudge(double interval, std::vector<HeightConflict>& conflicts, CleaningCounts& counts)
      : interval_(interval), conflicts_(conflicts), counts_(counts) {}

  // True when both heights may be taken as one. Contours must agree; a breakline or spot height
  // yields to a contour within half an interval, and one of two such is taken, which is counted.
  bool agree(const Vec2& place, double height1, Kind kind1, double height2, Kind kind2) {
    const double difference = std::abs(height1 - height2);
    if (difference <= same_height_m) return true;
    const bool is_contour1 = kind1 == Kind::contour, is_contour2 = kind2 == Kind::contour;
    const auto point = [&](double height) { return Vec3(place.x(), place.y(), height); };
    if (!(is_contour1 && is_contour2) && difference <= interval_ / 2) {
      if (!is_contour1 && !is_contour2 && difference > measured_alike_m)
        note_apart(difference, point(height1));
      return true;
    }
    conflicts_.push_back({name(kind1), name(kind2), point(height1), point(height2)});
    return false;
  }

  [[nodiscard]] bool found_conflicts() const { return !conflicts_.empty(); }

 private:
  static const char* name(Kind kind) {
    const char* names[] = {"contour", "breakline", "spot height"};
    return names[static_cast<int>(kind)];
  }

  void note_apart(double difference, const Vec3& place) {
    ++counts_.measured_apart;
    if (difference <= counts_.measured_apart_m) return;
    counts_.measured_apart_m = difference;
    counts_.measured_apart_at = place;
  }

  double interval_;
  std::vector<HeightConflict>& conflicts_;
  CleaningCounts& counts_;
};

void gather_lines(const Polylines& lines, Kind kind, int first_line, Network& network,
                  CleaningCounts& counts) {
  for (int l = 0; l < lines.n_lines(); ++l) {
    const int first = static_cast<int>(network.points.size());
    const int begin = lines.begin[l];
    int n = lines.begin[l + 1] - begin;
    const bool closed = n > 1 && plan(lines.points[begin]) == plan(lines.points[begin + n - 1]);
    if (closed) --n;
    bool one_place = true;
    for (int i = 0; i < n; ++i) {
      network.points.push_back(lines.points[begin + i]);
      network.kind.push_back(kind);
      network.line.push_back(first_line + l);
      one_place &= plan(network.points.back()) == plan(lines.points[begin]);
      if (i > 0) network.segments.push_back({first + i - 1, first + i, first_line + l});
    }
    if (closed && n > 2) network.segments.push_back({first + n - 1, first, first_line + l});
    counts.single_points += one_place ? 1 : 0;
  }
}

Network gather(const ContourMap& map, CleaningCounts& counts) {
  Network network;
  const std::size_t n =
      map.contours.points.size() + map.breaklines.points.size() + map.spots.size();
  network.points.reserve(n);
  network.kind.reserve(n);
  network.line.reserve(n);
  network.segments.reserve(n);
  gather_lines(map.contours, Kind::contour, 0, network, counts);
  gather_lines(map.breaklines, Kind::breakline, map.contours.n_lines(), network, counts);
  int line = map.contours.n_lines() + map.breaklines.n_lines();
  for (const Vec3& spot : map.spots) {
    network.points.push_back(spot);
    network.kind.push_back(Kind::spot);
    network.line.push_back(line++);
  }
  return network;
}

struct PlacedPoint {
  double x = 0, y = 0;
  int id = 0;
};

// Points of one place become the first of them, a contour's point when there is one.
void join_equal_points(Network& network, HeightJudge& judge, CleaningCounts& counts) {
  const int n = static_cast<int>(network.points.size());
  std::vector<PlacedPoint> sorted(n);
  for (int i = 0; i < n; ++i) sorted[i] = {network.points[i].x(), network.points[i].y(), i};
  const auto rank = [&](int i) { return std::pair(network.kind[i], i); };
  std::sort(sorted.begin(), sorted.end(), [&](const PlacedPoint& p, const PlacedPoint& q) {
    if (p.x != q.x) return p.x < q.x;
    return p.y != q.y ? p.y < q.y : rank(p.id) < rank(q.id);
  });
  std::vector<int> joined_to(n);
  for (std::size_t i = 0, first = 0; i < as_index(n); ++i) {
    if (sorted[i].x != sorted[first].x || sorted[i].y != sorted[first].y) first = i;
    joined_to[sorted[i].id] = sorted[first].id;
    if (i == first) continue;
    const auto kept = as_index(sorted[first].id), other = as_index(sorted[i].id);
    judge.agree(plan(network.points[kept]), network.points[kept].z(), network.kind[kept],
                network.points[other].z(), network.kind[other]);
    ++(network.kind[kept] == network.kind[other] ? counts.duplicate_points
                                                 : counts.breakline_meetings);
  }
  std::vector<int> new_id(n, -1);
  std::size_t n_kept = 0;
  for (std::size_t i = 0; i < as_index(n); ++i) {
    if (joined_to[i] != static_cast<int>(i)) continue;
    network.points[n_kept] = network.points[i];
    network.kind[n_kept] = network.kind[i];
    network.line[n_kept] = network.line[i];
    new_id[i] = static_cast<int>(n_kept++);
  }
  network.points.resize(n_kept);
  network.kind.resize(n_kept);
  network.line.resize(n_kept);
  for (Segment& s : network.segments) {
    s.a = new_id[joined_to[s.a]];
    s.b = new_id[joined_to[s.b]];
  }
}

void drop_repeated_segments(Network& network, CleaningCounts& counts) {
  std::vector<Segment>& segments = network.segments;
  std::erase_if(segments, [](const Segment& s) { return s.a == s.b; });
  for (Segment& s : segments)
    if (s.a > s.b) std::swap(s.a, s.b);
  std::sort(segments.begin(), segments.end(), [](const Segment& s, const Segment& t) {
    return std::tie(s.a, s.b, s.line) < std::tie(t.a, t.b, t.line);
  });
  const auto same = [](const Segment& s, const Segment& t) { return s.a == t.a && s.b == t.b; };
  const auto end = std::unique(segments.begin(), segments.end(), same);
  counts.duplicate_segments += static_cast<std::size_t>(segments.end() - end);
  segments.erase(end, segments.end());
}

SegmentMeetings find_meetings(const Network& network) {
  std::vector<Vec2> points(network.points.size());
  std::vector<bool> has_segment(points.size(), false);
  std::vector<std::array<int, 2>> segments;
  segments.reserve(network.segments.size());
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = plan(network.points[i]);
  for (const Segment& s : network.segments) {
    segments.push_back({s.a, s.b});
    has_segment[s.a] = has_segment[s.b] = true;
  }
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!has_segment[i]) segments.push_back({static_cast<int>(i), static_cast<int>(i)});
  return find_segment_meetings(points, segments);
}

double share_along(const Network& network, const Segment& s, const Vec2& place) {
  return share_along_segment<Vec2>(place, plan(network.points[s.a]), plan(network.points[s.b]));
}

double height_along(const Network& network, const Segment& s, double share) {
  const double z_a = network.points[s.a].z(), z_b = network.points[s.b].z();
  return z_a == z_b ? z_a : z_a + share * (z_b - z_a);
}

// A point to be put into a segment, `share` of the path along it.
struct Split {
  int segment = 0;
  double share = 0;
  int point = 0;
};

class Splitter {
 public:
  Splitter(Network& network, int n_contours, HeightJudge& judge, CleaningCounts& counts)
      : network_(network), n_contours_(n_contours), judge_(judge), counts_(counts) {}

  void touch(const SegmentTouch& touch) {
    const Segment& s = network_.segments[touch.segment];
    Vec3& point = network_.points[touch.point];
    const Kind kind_point = network_.kind[touch.point];
    const double share = share_along(network_, s, plan(point));
    const double height = height_along(network_, s, share);
    if (!judge_.agree(plan(point), height, kind_of(s), point.z(), kind_point)) return;
    if (kind_of(s) == Kind::contour) point.z() = height;
    ++(kind_of(s) == kind_point ? counts_.touches : counts_.breakline_meetings);
    splits_.push_back({touch.segment, share, touch.point});
  }

  void cross(const SegmentCrossing& crossing) {
    const Segment& s = network_.segments[crossing.first];
    const Segment& t = network_.segments[crossing.second];
    const Vec2 a = plan(network_.points[s.a]), b = plan(network_.points[s.b]);
    const double share =
        crossing_share(a, b, plan(network_.points[t.a]), plan(network_.points[t.b]));
    const Vec2 place = a + share * (b - a);
    const double share_t = share_along(network_, t, place);
    const double height_s = height_along(network_, s, share);
    const double height_t = height_along(network_, t, share_t);
    if (!judge_.agree(place, height_s, kind_of(s), height_t, kind_of(t))) return;
    const bool second_rules = kind_of(t) == Kind::contour;
    ++(kind_of(s) == kind_of(t) ? counts_.crossings : counts_.breakline_meetings);
    const int point = static_cast<int>(network_.points.size());
    network_.points.emplace_back(place.x(), place.y(), second_rules ? height_t : height_s);
    network_.kind.push_back(std::min(kind_of(s), kind_of(t)));
    network_.line.push_back(std::min(s.line, t.line));
    splits_.push_back({crossing.first, share, point});
    splits_.push_back({crossing.second, share_t, point});
  }

  void apply() {
    std::sort(splits_.begin(), splits_.end(), [](const Split& p, const Split& q) {
      return std::tie(p.segment, p.share, p.point) < std::tie(q.segment, q.share, q.point);
    });
    for (std::size_t i = 0; i < splits_.size();) {
      const int segment = splits_[i].segment;
      const auto [a, b, line] = network_.segments[segment];
      int from = a;
      for (; i < splits_.size() && splits_[i].segment == segment; ++i) {
        network_.segments.push_back({from, splits_[i].point, line});
        from = splits_[i].point;
      }
      network_.segments[segment] = {from, b, line};
    }
  }

 private:
  [[nodiscard]] Kind kind_of(const Segment& s) const {
    return s.line < n_contours_ ? Kind::contour : Kind::breakline;
  }

  Network& network_;
  int n_contours_;
  HeightJudge& judge_;
  CleaningCounts& counts_;
  std::vector<Split> splits_;
};

// Splits segments where other segments meet them; false when there was nothing to split.
bool split_where_lines_meet(const ContourMap& map, Network& network, HeightJudge& judge,
                            CleaningCounts& counts) {
  const SegmentMeetings meetings = find_meetings(network);
  Splitter splitter(network, map.contours.n_lines(), judge, counts);
  for (const SegmentTouch& touch : meetings.touches) splitter.touch(touch);
  for (const SegmentCrossing& crossing : meetings.crossings) splitter.cross(crossing);
  if (judge.found_conflicts()) return false;
  splitter.apply();
  return !meetings.touches.empty() || !meetings.crossings.empty();
}

CleanLines contours_first(const Network& network, const CleaningCounts& counts) {
  CleanLines clean;
  clean.counts = counts;
  std::vector<int> new_id(network.points.size());
  clean.points.reserve(network.points.size());
  clean.line.reserve(network.points.size());
  for (const bool contours : {true, false}) {
    for (std::size_t i = 0; i < network.points.size(); ++i) {
      if ((network.kind[i] == Kind::contour) != contours) continue;
      new_id[i] = static_cast<int>(clean.points.size());
      clean.points.push_back(network.points[i]);
      clean.line.push_back(network.line[i]);
    }
    if (contours) clean.n_contour_points = static_cast<int>(clean.points.size());
  }
  clean.segments.reserve(network.segments.size());
  for (const Segment& s : network.segments) clean.segments.push_back({new_id[s.a], new_id[s.b]});
  return clean;
}

}  // namespace

std::vector<double> contour_levels(const ContourMap& map) {
  std::vector<double> levels;
  levels.reserve(map.contours.n_lines());
  for (int l = 0; l < map.contours.n_lines(); ++l)
    levels.push_back(map.contours.points[map.contours.begin[l]].z());
  std::sort(levels.begin(), levels.end());
  const auto same = [](double lower, double upper) { return upper - lower <= same_height_m; };
  levels.erase(std::unique(levels.begin(), levels.end(), same), levels.end());
  return levels;
}

double contour_interval(const ContourMap& map) {
  const std::vector<double> levels = contour_levels(map);
  if (levels.size() < 2) return 0;
  std::vector<double> steps(levels.size() - 1);
  std::transform(levels.begin() + 1, levels.end(), levels.begin(), steps.begin(), std::minus<>());
  return median(std::move(steps));
}

std::vector<Vec3> hold_back_contours(int every, ContourMap& map) {
  TALUS_ASSERT(every >= 2);
  const std::vector<double> levels = contour_levels(map);
  std::vector<Vec3> held_back;
  Polylines kept;
  for (int l = 0; l < map.contours.n_lines(); ++l) {
    const auto begin = map.contours.points.begin() + map.contours.begin[l];
    const auto end = map.contours.points.begin() + map.contours.begin[l + 1];
    const auto level = std::lower_bound(levels.begin(), levels.end(), begin->z() - same_height_m);
    const bool takes_out =
        level + 1 < levels.end() && (level - levels.begin()) % every == every - 1;
    std::vector<Vec3>& to = takes_out ? held_back : kept.points;
    to.insert(to.end(), begin, end);
    if (takes_out) continue;
    kept.begin.push_back(static_cast<int>(kept.points.size()));
    kept.feature.push_back(map.contours.feature[l]);
  }
  map.contours = std::move(kept);
  return held_back;
}

void check_heights(const ContourMap& map) {
  const std::vector<double> levels = contour_levels(map);
  if (levels.size() >= 2) return;
  const std::string lines = map.contours.n_lines() == 1 ? "there is one contour only, at "
                                                        : "all contours stand at one height, ";
  throw InputError({map.source},
                   lines + text(levels.front() + map.origin.z(), 8) +
                       " m, expected contours at two heights at least",
                   "choose the field that holds the elevation with --elevation-field");
}

std::optional<CleanLines> try_clean_lines(const ContourMap& map,
                                          std::vector<HeightConflict>& conflicts) {
  CleaningCounts counts;
  HeightJudge judge(contour_interval(map), conflicts, counts);
  Network network = gather(map, counts);
  for (int round = 0; round < max_rounds; ++round) {
    join_equal_points(network, judge, counts);
    if (judge.found_conflicts()) return std::nullopt;
    drop_repeated_segments(network, counts);
    const bool was_split = split_where_lines_meet(map, network, judge, counts);
    if (judge.found_conflicts()) return std::nullopt;
    if (!was_split) return contours_first(network, counts);
  }
  throw InputError(
      {map.source},
      "lines still cross each other after " + std::to_string(max_rounds) + " rounds of splitting",
      "simplify the lines");
}

std::string describe(const HeightConflict& conflict, const Vec3& origin) {
  const auto line = [&](const std::string& kind, const Vec3& point) {
    return kind + " at " + text(point.z() + origin.z(), 10) + " m";
  };
  return line(conflict.a, conflict.place_a) + " meets " + line(conflict.b, conflict.place_b) +
         " at x " + text(conflict.place_a.x() + origin.x(), 10) + ", y " +
         text(conflict.place_a.y() + origin.y(), 10);
}

CleanLines clean_lines(const ContourMap& map) {
  std::vector<HeightConflict> conflicts;
  std::optional<CleanLines> clean = try_clean_lines(map, conflicts);
  if (clean) return std::move(*clean);
  const std::string more =
      conflicts.size() > 1 ? ", and so in " + std::to_string(conflicts.size() - 1) + " more places"
                           : "";
  throw InputError({map.source},
                   describe(conflicts.front(), map.origin) + more +
                       "; expected lines of different height to stay apart",
                   "mend the lines at the place named, or take wrong ones out");
}

void forget_lines(ContourMap& map) {
  map.contours = {};
  map.breaklines = {};
  map.spots = {};
}

}  // namespace talus
