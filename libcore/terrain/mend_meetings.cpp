// Moves contours that meet at different heights apart, within the accuracy of the map.
#include "terrain/mend_meetings.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "base/numbers.hpp"
#include "geometry/plan2d.hpp"
#include "geometry/segment_meetings.hpp"
#include "terrain/as_index.hpp"

namespace talus {
namespace {

constexpr int max_rounds = 40;
constexpr double gap_share = 0.05;  // of the tolerance: distance that moved lines keep

// One contour in plan. A closed one does not repeat its first point.
struct PlanLine {
  std::vector<Vec2> points, original;
  double height = 0;
  bool is_closed = false;
  [[nodiscard]] int n_points() const { return static_cast<int>(points.size()); }
  [[nodiscard]] int n_segments() const { return is_closed ? n_points() : n_points() - 1; }
  [[nodiscard]] const Vec2& at(int i) const { return points[as_index(i) % points.size()]; }
};

std::vector<PlanLine> plan_lines(const Polylines& contours) {
  std::vector<PlanLine> lines(contours.n_lines());
  for (int l = 0; l < contours.n_lines(); ++l) {
    PlanLine& line = lines[l];
    const int begin = contours.begin[l], end = contours.begin[l + 1];
    line.height = contours.points[begin].z();
    for (int i = begin; i < end; ++i) line.points.push_back(contours.points[i].head<2>());
    line.is_closed = line.n_points() > 3 && line.points.front() == line.points.back();
    if (line.is_closed) line.points.pop_back();
    line.original = line.points;
  }
  return lines;
}

// --- where lines meet ----------------------------------------------------------------------------

// A meeting as line a sees it: segment and share along it, as one number.
struct Event {
  double along_a = 0, along_b = 0;
  Vec2 place = Vec2::Zero();
};
using LinePair = std::pair<int, int>;
using Events = std::map<LinePair, std::vector<Event>>;

// All lines as one set of segments between points that differ.
struct Joined {
  std::vector<Vec2> points;
  std::vector<std::array<int, 2>> segments;
  std::vector<std::vector<std::array<int, 2>>> at_point;    // line, number in it
  std::vector<std::vector<std::array<int, 3>>> on_segment;  // line, number, 1: turned round
};

Joined join(const std::vector<PlanLine>& lines) {
  Joined joined;
  std::map<std::pair<double, double>, int> id_of;
  std::vector<std::vector<int>> ids(lines.size());
  for (std::size_t l = 0; l < lines.size(); ++l)
    for (int i = 0; i < lines[l].n_points(); ++i) {
      const Vec2& p = lines[l].at(i);
      const auto [at, is_new] =
          id_of.try_emplace({p.x(), p.y()}, static_cast<int>(joined.points.size()));
      if (is_new) joined.points.push_back(p), joined.at_point.emplace_back();
      joined.at_point[at->second].push_back({static_cast<int>(l), i});
      ids[l].push_back(at->second);
    }
  std::map<std::array<int, 2>, int> segment_of;
  for (std::size_t l = 0; l < lines.size(); ++l)
    for (int i = 0; i < lines[l].n_segments(); ++i) {
      const int a = ids[l][i], b = ids[l][(as_index(i) + 1) % ids[l].size()];
      if (a == b) continue;
      const std::array<int, 2> ends = {std::min(a, b), std::max(a, b)};
      const auto [at, is_new] =
          segment_of.try_emplace(ends, static_cast<int>(joined.segments.size()));
      if (is_new) joined.segments.push_back(ends), joined.on_segment.emplace_back();
      joined.on_segment[at->second].push_back({static_cast<int>(l), i, a > b ? 1 : 0});
    }
  return joined;
}

class EventFinder {
 public:
  explicit EventFinder(const std::vector<PlanLine>& lines) : lines_(lines), joined_(join(lines)) {}

  Events find() {
    for (std::size_t p = 0; p < joined_.points.size(); ++p)
      for (const auto& one : joined_.at_point[p])
        for (const auto& other : joined_.at_point[p])
          add(one[0], one[1], other[0], other[1], joined_.points[p]);
    const SegmentMeetings meetings = find_segment_meetings(joined_.points, joined_.segments);
    for (const SegmentTouch& touch : meetings.touches) add_touch(touch);
    for (const SegmentCrossing& crossing : meetings.crossings) add_crossing(crossing);
    for (auto& [pair, events] : found_) sort_events(events);
    return std::move(found_);
  }

 private:
  void add(int line_a, double along_a, int line_b, double along_b, const Vec2& place) {
    const bool meet =
        line_a < line_b && std::abs(lines_[line_a].height - lines_[line_b].height) > same_height_m;
    if (meet) found_[{line_a, line_b}].push_back({along_a, along_b, place});
  }

  // Position along a segment from 0 to 1, in the direction of its line.
  [[nodiscard]] double along(const std::array<int, 3>& on, double share) const {
    return on[1] + (on[2] == 1 ? 1 - share : share);
  }

  void add_touch(const SegmentTouch& touch) {
    const auto& [a, b] = joined_.segments[touch.segment];
    const Vec2 &from = joined_.points[a], &to = joined_.points[b];
    const Vec2& p = joined_.points[touch.point];
    const double share = (p - from).dot(to - from) / (to - from).squaredNorm();
    for (const auto& on : joined_.on_segment[touch.segment])
      for (const auto& at : joined_.at_point[touch.point]) {
        add(on[0], along(on, share), at[0], at[1], p);
        add(at[0], at[1], on[0], along(on, share), p);
      }
  }

  void add_crossing(const SegmentCrossing& crossing) {
    const auto& [a, b] = joined_.segments[crossing.first];
    const auto& [c, d] = joined_.segments[crossing.second];
    const Vec2 &pa = joined_.points[a], &pb = joined_.points[b];
    const Vec2 &pc = joined_.points[c], &pd = joined_.points[d];
    const double share = crossing_share(pa, pb, pc, pd), other = crossing_share(pc, pd, pa, pb);
    const Vec2 place = pa + share * (pb - pa);
    for (const auto& one : joined_.on_segment[crossing.first])
      for (const auto& two : joined_.on_segment[crossing.second]) {
        add(one[0], along(one, share), two[0], along(two, other), place);
        add(two[0], along(two, other), one[0], along(one, share), place);
      }
  }

  static void sort_events(std::vector<Event>& events) {
    const auto key = [](const Event& e) { return std::tie(e.along_a, e.along_b); };
    std::sort(events.begin(), events.end(),
              [&](const Event& e, const Event& f) { return key(e) < key(f); });
    events.erase(std::unique(events.begin(), events.end(),
                             [&](const Event& e, const Event& f) { return key(e) == key(f); }),
                 events.end());
  }

  const std::vector<PlanLine>& lines_;
  Joined joined_;
  Events found_;
};

// --- sides ---------------------------------------------------------------------------------------

// The place of a line nearest to a point, and the side that the point is on.
struct Nearest {
  Vec2 place = Vec2::Zero();
  Vec2 left = Vec2::Zero();  // unit normal of the line there, to the left
  double distance = infinity;
  int side = 0;  // 1: left, -1: right, 0: on the line
};

Vec2 left_of(const PlanLine& line, int segment) {
  const Vec2 d = line.at(segment + 1) - line.at(segment);
  return Vec2(-d.y(), d.x()).normalized();
}

// At a corner the mean of the normals of both segments, which tells the sides there.
Vec2 left_at(const PlanLine& line, int segment, double share) {
  const int n = line.n_segments();
  const int other = share <= 0 ? segment - 1 : share >= 1 ? segment + 1 : segment;
  if (!line.is_closed && (other < 0 || other >= n)) return left_of(line, segment);
  const Vec2 sum = left_of(line, segment) + left_of(line, (other + n) % n);
  return sum.squaredNorm() > 1e-12 ? Vec2(sum.normalized()) : left_of(line, segment);
}

Nearest nearest_on(const PlanLine& line, const Vec2& p) {
  Nearest nearest;
  int segment = -1;
  double share_there = 0;
  for (int s = 0; s < line.n_segments(); ++s) {
    const Vec2 &a = line.at(s), d = line.at(s + 1) - a;
    if (d.squaredNorm() == 0) continue;
    const double share = share_along_segment<Vec2>(p, a, line.at(s + 1));
    const Vec2 place = a + share * d;
    const double distance = (p - place).norm();
    if (!(distance < nearest.distance)) continue;
    nearest.place = place, nearest.distance = distance;
    segment = s, share_there = share;
  }
  if (segment < 0) return nearest;
  nearest.left = left_at(line, segment, share_there);
  const double apart = (p - nearest.place).dot(nearest.left);
  nearest.side = apart > 0 ? 1 : apart < 0 ? -1 : 0;
  return nearest;
}

// --- one line beside another ---------------------------------------------------------------------

// Points of a line between two meetings with another: from the first on, up to and with the last.
struct Part {
  std::vector<int> points;     // of the line, in order
  Vec2 middle = Vec2::Zero();  // of a part without a point
  int side = 0;                // of the other line, that most of it is on
  double depth = 0;            // farthest from the other line; infinity: beyond the tolerance
};

// The parts of `line` between its meetings at `along`, sorted.
std::vector<Part> parts_between(const PlanLine& line, std::vector<double> along) {
  const double n = line.n_segments();
  along.erase(std::unique(along.begin(), along.end()), along.end());
  const auto place_at = [&](double at) {
    const int s = std::min(static_cast<int>(at), line.n_segments() - 1);
    return Vec2(line.at(s) + (at - s) * (line.at(s + 1) - line.at(s)));
  };
  const auto part_of = [&](double from, double to) {
    Part part;
    for (int i = static_cast<int>(std::floor(from)) + 1; i < to; ++i)
      part.points.push_back(i % line.n_points());
    const double middle = 0.5 * (from + to);
    part.middle = place_at(middle >= n ? middle - n : middle);
    return part;
  };
  std::vector<Part> parts;
  if (line.is_closed) {
    for (std::size_t i = 0; i < along.size(); ++i)
      parts.push_back(i + 1 < along.size() ? part_of(along[i], along[i + 1])
                                           : part_of(along[i], along[0] + n));
    return parts;
  }
  if (along.front() > 0) parts.push_back(part_of(-1, along.front()));
  if (along.front() > 0) parts.back().middle = place_at(0.5 * along.front());
  for (std::size_t i = 0; i + 1 < along.size(); ++i)
    parts.push_back(part_of(along[i], along[i + 1]));
  if (along.back() < n) {
    parts.push_back(part_of(along.back(), n + 0.5));
    parts.back().middle = place_at(0.5 * (along.back() + n));
  }
  return parts;
}

// Where a part lies: points are looked at until one is beyond the tolerance.
void find_side(const PlanLine& line, const PlanLine& other, double tolerance, Part& part) {
  const auto look = [&](const Vec2& p) {
    const Nearest nearest = nearest_on(other, p);
    if (nearest.side != 0 && nearest.distance > part.depth)
      part.depth = nearest.distance, part.side = nearest.side;
    return nearest.distance > tolerance;
  };
  bool is_beyond = look(part.middle);
  for (std::size_t i = 0; i < part.points.size() && !is_beyond; ++i)
    is_beyond = look(line.at(part.points[i]));
  if (is_beyond) part.depth = infinity;
}

// The side that a line belongs on: that of its parts beyond the tolerance, else of the farthest.
// 0: on both sides beyond it, or on none.
int home_side(const std::vector<Part>& parts) {
  double left = 0, right = 0;
  for (const Part& part : parts) {
    if (part.side > 0) left = std::max(left, part.depth);
    if (part.side < 0) right = std::max(right, part.depth);
  }
  if (left == right) return 0;
  return left > right ? 1 : -1;
}

// Points of a line with where they go.
struct Moves {
  std::vector<std::pair<int, Vec2>> points;
  double largest = 0;  // displacement from the place in the map
};

// Moves that bring the points of `line` that are on the wrong side of `other`, or on it, to the
// home side. None: they would go beyond the tolerance, or a home side is missing.
std::optional<Moves> moves_home(const PlanLine& line, const PlanLine& other,
                                const std::vector<double>& along, double tolerance) {
  std::vector<Part> parts = parts_between(line, along);
  for (Part& part : parts) find_side(line, other, tolerance, part);
  const int home = home_side(parts);
  if (home == 0) return std::nullopt;
  std::set<int> wrong;
  for (const Part& part : parts) {
    if (part.side == home) continue;
    if (part.depth > tolerance) return std::nullopt;
    wrong.insert(part.points.begin(), part.points.end());
  }
  for (const double at : along)
    if (at == std::floor(at)) wrong.insert(static_cast<int>(at) % line.n_points());
  Moves moves;
  for (const int i : wrong) {
    const Nearest nearest = nearest_on(other, line.at(i));
    if (nearest.side == home) continue;  // another line has moved since
    const bool is_off = nearest.side != 0 && nearest.distance > 1e-9 * tolerance;
    const Vec2 out =
        is_off ? Vec2((nearest.place - line.at(i)) / nearest.distance) : Vec2(home * nearest.left);
    const Vec2 to = nearest.place + gap_share * tolerance * out;
    moves.points.emplace_back(i, to);
    moves.largest = std::max(moves.largest, (to - line.original[i]).norm());
  }
  if (moves.largest > tolerance) return std::nullopt;
  return moves;
}

void apply(const Moves& moves, PlanLine& line) {
  for (const auto& [point, to] : moves.points) line.points[point] = to;
}

enum class Outcome { moved, waits, stuck };

// Moves points of one of two lines apart. It waits where another line has moved since the meetings
// were found and nothing is left to be done, and is stuck when neither line may be moved. The line
// with the shorter displacement moves, with `by_height` the lower one: a line between two lines
// would otherwise move to and fro for ever.
Outcome move_apart(const std::vector<Event>& events, double tolerance, bool by_height, PlanLine& a,
                   PlanLine& b) {
  std::vector<double> along_a, along_b;
  for (const Event& event : events) {
    along_a.push_back(event.along_a);
    along_b.push_back(event.along_b);
  }
  std::sort(along_b.begin(), along_b.end());
  const std::optional<Moves> of_a = moves_home(a, b, along_a, tolerance);
  const std::optional<Moves> of_b = moves_home(b, a, along_b, tolerance);
  const bool a_can = of_a && !of_a->points.empty(), b_can = of_b && !of_b->points.empty();
  if (!a_can && !b_can) return of_a || of_b ? Outcome::waits : Outcome::stuck;
  const bool a_should =
      a_can && b_can && (by_height ? a.height < b.height : of_a->largest <= of_b->largest);
  if (a_can && (!b_can || a_should))
    apply(*of_a, a);
  else
    apply(*of_b, b);
  return Outcome::moved;
}

// --- the whole map -------------------------------------------------------------------------------

void collect_moves(const std::vector<PlanLine>& lines, Mending& mending) {
  for (std::size_t l = 0; l < lines.size(); ++l)
    for (std::size_t i = 0; i < lines[l].points.size(); ++i) {
      const Vec2 &from = lines[l].original[i], &to = lines[l].points[i];
      if (from == to) continue;
      mending.moved.push_back({static_cast<int>(l), from, to});
      mending.largest_move = std::max(mending.largest_move, (to - from).norm());
    }
}

void take_over(const std::vector<PlanLine>& lines, Polylines& contours) {
  for (std::size_t l = 0; l < lines.size(); ++l) {
    const int begin = contours.begin[l], n = contours.begin[l + 1] - begin;
    for (int i = 0; i < n; ++i) contours.points[begin + i].head<2>() = lines[l].at(i);
  }
}

}  // namespace

double accuracy_of_lines(const Polylines& lines) {
  constexpr std::size_t fewest = 30;
  std::vector<double> bends;
  for (int l = 0; l < lines.n_lines(); ++l)
    for (int i = lines.begin[l] + 1; i + 1 < lines.begin[l + 1]; ++i) {
      const Vec2 a = lines.points[i - 1].head<2>();
      const Vec2 chord = lines.points[i + 1].head<2>() - a;
      const double twice_area = std::abs(cross(chord, lines.points[i].head<2>() - a));
      if (twice_area > 0 && chord.norm() > 0) bends.push_back(twice_area / chord.norm());
    }
  if (bends.size() < fewest) return 0;
  const auto tenth = bends.begin() + static_cast<std::ptrdiff_t>(bends.size() / 10);
  std::nth_element(bends.begin(), tenth, bends.end());
  return *tenth;
}

Mending mend_meetings(double tolerance, ContourMap& map) {
  std::vector<PlanLine> lines = plan_lines(map.contours);
  Mending mending;
  Events events = EventFinder(lines).find();
  for (const auto& [pair, places] : events)
    for (const Event& event : places)
      mending.meetings.push_back({event.place, pair.first, pair.second, false});
  std::set<LinePair> stuck;
  bool goes_on = tolerance > 0;
  for (int round = 0; round < max_rounds && goes_on; ++round) {
    goes_on = false;
    for (const auto& [pair, places] : events) {
      if (stuck.contains(pair)) continue;
      const Outcome outcome =
          move_apart(places, tolerance, round > 0, lines[pair.first], lines[pair.second]);
      if (outcome == Outcome::stuck) stuck.insert(pair);
      goes_on |= outcome == Outcome::moved;
    }
    if (goes_on) events = EventFinder(lines).find();
  }
  for (const auto& [pair, places] : events) stuck.insert(pair);
  for (Meeting& meeting : mending.meetings)
    meeting.is_mended = !stuck.contains({meeting.line_a, meeting.line_b});
  if (!stuck.empty()) return mending;
  collect_moves(lines, mending);
  take_over(lines, map.contours);
  return mending;
}

}  // namespace talus
