// Contacts between blocks: the list of close pairs, their axes and features, and grazing contacts.
#include "contact/block_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "contact/scales.hpp"

namespace talus {
namespace {

constexpr double look_now = -std::numeric_limits<double>::infinity();
constexpr double passing_ratio = 1e-4;  // ... by more than this in a step
constexpr double steps_ahead = 20;      // ... and along the motion of this many steps ahead ...
constexpr double farthest_ahead = 0.5;  // ... up to this part of its radius

int n_free(const Hulls& hulls, const PairMotion& motion) {
  return n_bodies(hulls) - motion.n_fixed;
}
bool is_fixed(const Hulls& hulls, const PairMotion& motion, int b) {
  return b >= n_free(hulls, motion);
}
Vec3 step_of(const PairMotion& motion, int b) {
  return motion.step.empty() ? Vec3(Vec3::Zero()) : motion.step[b];
}
bool is_absent(const PairMotion& motion, int b) {
  return static_cast<std::size_t>(b) < motion.absent.size() && motion.absent[b] != 0;
}
double turn_of(const PairMotion& motion, int b) { return motion.turn.empty() ? 0 : motion.turn[b]; }

// All bodies except fixed bodies in their first place.
template <class Visit>
void for_each_movable(const Hulls& hulls, const PairMotion& motion, Visit&& visit) {
  for (int b = 0; b < n_free(hulls, motion); ++b) visit(b);
  for (const int b : motion.shifted) visit(b);
}

// Places the fixed bodies that the free body at hand has pushed where they are for it, and those
// of the one before back.
class Arrangement {
 public:
  Arrangement(const Hulls& hulls, const PairMotion& motion, PlacedHulls& placed,
              std::vector<ShiftedBody>& shifted)
      : hulls_(hulls), motion_(motion), placed_(placed), shifted_(shifted) {
    shifted.clear();
  }
  void make_for(int free) {
    if (motion_.own == nullptr || free == free_) return;
    put_back();
    free_ = free;
    motion_.own->of(free, shifted_);
    for (const ShiftedBody& s : shifted_) place_body(hulls_, s.body, s.now, placed_);
  }
  void put_back() {
    for (const ShiftedBody& s : shifted_) place_body(hulls_, s.body, s.at_first, placed_);
    shifted_.clear();
    free_ = -1;
  }

 private:
  const Hulls& hulls_;
  const PairMotion& motion_;
  PlacedHulls& placed_;
  std::vector<ShiftedBody>& shifted_;
  int free_ = -1;
};

// Mean over the bodies; zero where budgets are not relative to it.
template <class Value>
Vec3 frame_mean(const Hulls& hulls, bool in_frame, Value&& value) {
  Vec3 sum = Vec3::Zero();
  if (!in_frame) return sum;
  for (int b = 0; b < n_bodies(hulls); ++b) sum += value(b);
  return sum / std::max(1, n_bodies(hulls));
}

Vec3 mean_position(const Hulls& hulls, const PlacedHulls& placed, bool in_frame) {
  return frame_mean(hulls, in_frame, [&](int b) -> const Vec3& { return placed.position[b]; });
}
Vec3 mean_step(const Hulls& hulls, const PairMotion& motion, bool in_frame) {
  if (motion.step.empty()) return Vec3::Zero();
  return frame_mean(hulls, in_frame, [&](int b) -> const Vec3& { return motion.step[b]; });
}

// How far body b reaches for contacts: the reaches of two bodies cover the margin of their pair.
double reach(const PairMotion& motion, const PairSettings& settings, int b,
             const Vec3& frame_step) {
  return settings.margin / 2 + (step_of(motion, b) - frame_step).norm() + turn_of(motion, b);
}

double fixed_reach(const PairSettings& settings) { return settings.margin / 2; }

// Adds the motion since the last step to `travel`, and fills `reach`.
void follow_motion(const Hulls& hulls, const PlacedHulls& placed, const PairMotion& motion,
                   const PairSettings& settings, PairState& state, PairWork& work) {
  work.reach.resize(n_free(hulls, motion));
  state.in_frame = motion.n_fixed == 0;
  const Vec3 frame_step = mean_step(hulls, motion, state.in_frame);
  for (int b = 0; b < n_free(hulls, motion); ++b)
    work.reach[b] = reach(motion, settings, b, frame_step);
  if (state.travel.empty()) return;
  const Vec3 frame = mean_position(hulls, placed, state.in_frame);
  for_each_movable(hulls, motion, [&](int b) {
    state.travel[b] += (placed.position[b] - state.last_at[b] - (frame - state.last_frame)).norm() +
                       placed.turned[b] - state.last_turned[b];
    state.last_at[b] = placed.position[b];
    state.last_turned[b] = placed.turned[b];
  });
  state.last_frame = frame;
}

bool is_within(const Box& budget, const Vec3& moved, double around) {
  return (moved.array() + around <= budget.high.array()).all() &&
         (moved.array() - around >= budget.low.array()).all();
}

bool list_is_good(const Hulls& hulls, const PlacedHulls& placed, const PairMotion& motion,
                  const PairSettings& settings, const PairState& state, const PairWork& work) {
  if (!settings.use_cache || state.listed_at.size() != hulls.radius.size()) return false;
  const Vec3 shift = state.last_frame - state.frame;
  const auto keeps_within = [&](int b, const Box& budget, double reach) {
    return is_within(budget, placed.position[b] - state.listed_at[b] - shift,
                     placed.turned[b] - state.listed_turned[b] + reach);
  };
  for (int b = 0; b < n_free(hulls, motion); ++b)
    if (!keeps_within(b, state.budget[b], work.reach[b])) return false;
  if (motion.n_fixed == 0) return true;
  const double reach = fixed_reach(settings);
  if (motion.own != nullptr) {
    const auto first = static_cast<std::size_t>(n_free(hulls, motion));
    const double most = *std::max_element(state.travel.begin() + static_cast<std::ptrdiff_t>(first),
                                          state.travel.end());
    return reach + most <= state.fixed_budget;
  }
  const Box budget{Vec3::Constant(-state.fixed_budget), Vec3::Constant(state.fixed_budget)};
  return reach <= state.fixed_budget &&
         std::all_of(motion.shifted.begin(), motion.shifted.end(),
                     [&](int b) { return keeps_within(b, budget, reach); });
}

void set_budgets(const Hulls& hulls, const PlacedHulls& placed, const PairMotion& motion,
                 const PairSettings& settings, PairState& state) {
  state.frame = mean_position(hulls, placed, state.in_frame);
  state.last_frame = state.frame;
  if (state.listed_at.size() != hulls.radius.size()) {
    state.listed_at = state.last_at = placed.position;
    state.listed_turned = state.last_turned = placed.turned;
    state.travel.assign(hulls.radius.size(), 0);
  }
  for_each_movable(hulls, motion, [&](int b) {
    state.listed_at[b] = state.last_at[b] = placed.position[b];
    state.listed_turned[b] = state.last_turned[b] = placed.turned[b];
    state.travel[b] = 0;
  });
  if (motion.own != nullptr)
    std::fill(state.travel.begin() + n_free(hulls, motion), state.travel.end(), 0);
  state.fixed_budget = 2 * fixed_reach(settings);
  state.budget.resize(n_free(hulls, motion));
  const Vec3 frame_step = mean_step(hulls, motion, state.in_frame);
  for (int b = 0; b < n_free(hulls, motion); ++b) {
    const double skin = largest_skin * hulls.radius[b] + 2 * reach(motion, settings, b, frame_step);
    Vec3 ahead = steps_ahead * (step_of(motion, b) - frame_step);
    const double farthest = farthest_ahead * hulls.radius[b];
    if (ahead.norm() > farthest) ahead *= farthest / ahead.norm();
    state.budget[b] = {ahead.cwiseMin(0).array() - skin, ahead.cwiseMax(0).array() + skin};
  }
}

// Of the free bodies.
void box_parts(const Hulls& hulls, const PlacedHulls& placed, const PairMotion& motion,
               const PairState& state, std::vector<Box>& boxes) {
  const int n = hulls.part_begin[n_free(hulls, motion)];
  boxes.resize(n);
  for (int p = 0; p < n; ++p) {
    Box& box = boxes[p];
    if (is_absent(motion, hulls.body[p])) {  // near nothing but bodies at its centroid
      box.low = box.high = placed.position[hulls.body[p]];
      continue;
    }
    box = box_of_part(hulls, placed, p);
    box.low += state.budget[hulls.body[p]].low;
    box.high += state.budget[hulls.body[p]].high;
  }
}

Box grown(Box box, double by) {
  box.low += Vec3::Constant(-by);
  box.high += Vec3::Constant(by);
  return box;
}

// Adds the pairs of free parts with those of the fixed bodies near them.
int add_fixed_pairs(const Hulls& hulls, const PlacedHulls& placed, const PairMotion& motion,
                    const PairState& state, Arrangement& arrangement, PairWork& work) {
  TALUS_ASSERT(motion.grid != nullptr && motion.grid->n_bodies == motion.n_fixed);
  const int first = n_free(hulls, motion);
  int n_near = 0;
  for (std::size_t p = 0; p < work.boxes.size(); ++p) {
    find_near(*motion.grid, grown(work.boxes[p], state.fixed_budget), work.near);
    for (int& f : work.near) f += first;
    const auto by_grid = work.near.size();
    const auto add = [&](int body) {
      if (!std::binary_search(work.near.begin(),
                              work.near.begin() + static_cast<std::ptrdiff_t>(by_grid), body))
        work.near.push_back(body);
    };
    for (const int body : motion.shifted) add(body);
    arrangement.make_for(hulls.body[p]);
    for (const ShiftedBody& s : work.shifted) add(s.body);
    n_near += static_cast<int>(work.near.size());
    for (const int body : work.near)
      for (int q = hulls.part_begin[body]; q < hulls.part_begin[body + 1]; ++q)
        if (overlap(work.boxes[p], grown(box_of_part(hulls, placed, q), state.fixed_budget)))
          work.close.push_back({static_cast<int>(p), q});
  }
  std::sort(work.close.begin(), work.close.end());
  return n_near;
}

// The new list; pairs that were listed before keep their axes and features. Travel starts anew, so
// every pair is looked at once.
void merge_list(PairState& state, PairWork& work) {
  work.next_watch.clear();
  work.next_pairs.clear();
  std::size_t old = 0;
  for (const std::array<int, 2>& close : work.close) {
    const int a = close[0], b = close[1];
    const auto before = [&](const PairWatch& w) {
      return w.part_a != a ? w.part_a < a : w.part_b < b;
    };
    while (old < state.watch.size() && before(state.watch[old])) ++old;
    const bool known =
        old < state.watch.size() && state.watch[old].part_a == a && state.watch[old].part_b == b;
    work.next_watch.push_back({look_now, a, b});
    work.next_pairs.push_back(known ? state.pairs[old] : ListedPair{});
  }
  state.watch.swap(work.next_watch);
  state.pairs.swap(work.next_pairs);
}

// Returns how many fixed bodies were looked at.
int relist(const Hulls& hulls, const PlacedHulls& placed, const PairMotion& motion,
           const PairSettings& settings, PairState& state, Arrangement& arrangement,
           PairWork& work) {
  set_budgets(hulls, placed, motion, settings, state);
  box_parts(hulls, placed, motion, state, work.boxes);
  work.close.clear();
  if (motion.free_meet)
    find_overlaps(work.boxes, std::span(hulls.body).first(work.boxes.size()), work.strips,
                  work.close);
  const int n_near =
      motion.n_fixed > 0 ? add_fixed_pairs(hulls, placed, motion, state, arrangement, work) : 0;
  merge_list(state, work);
  return n_near;
}

double graze_height(const Hulls& hulls, const PairSettings& settings, int part_a, int part_b) {
  return settings.graze_ratio * std::min(hulls.thickness[part_a], hulls.thickness[part_b]) +
         settings.graze_m;
}

// All that the functions below hand on.
struct Search {
  const Hulls& hulls;
  const PlacedHulls& placed;
  const PairMotion& motion;
  const PairSettings& settings;
  PairState& state;
  Arrangement& arrangement;
  const std::vector<double>& reach;  // with a bound on the bodies' motion since the list was made
  ListLook& look;
};

bool is_awake(const Search& s, int b) {
  return !is_fixed(s.hulls, s.motion, b) && (s.motion.awake.empty() || s.motion.awake[b] != 0);
}

double reach_of(const Search& s, int b) {
  return is_fixed(s.hulls, s.motion, b) ? fixed_reach(s.settings) + s.state.travel[b] : s.reach[b];
}

double pair_margin(const Search& s, int a, int b) {
  const bool on_fixed = is_fixed(s.hulls, s.motion, b);  // a < b: never a
  const double turn = turn_of(s.motion, a) + (on_fixed ? 0 : turn_of(s.motion, b));
  if (s.motion.step.empty()) return s.settings.margin + turn;
  if (on_fixed) return s.settings.margin + turn + s.motion.step[a].norm();
  return s.settings.margin + turn + (s.motion.step[a] - s.motion.step[b]).norm();
}

// The features that a pair had in the last step; none once a search for new ones failed, since its
// range then counts from the new list.
std::span<const HeldPoint> held_before(const Search& s, const ListedPair& pair) {
  if (!pair.touches || pair.held_begin == pair.held_end) return {};
  return std::span(s.state.held)
      .subspan(static_cast<std::size_t>(pair.held_begin),
               static_cast<std::size_t>(pair.held_end - pair.held_begin));
}

// Searches axis and features of a pair.
void search_all(const Search& s, const PairWatch& watch, double margin, ListedPair& pair) {
  ++s.look.n_searched;
  const std::span<const HeldPoint> before = held_before(s, pair);
  pair.held_begin = static_cast<int>(s.look.held.size());
  const ContactSearch found = search_contact(
      s.hulls, s.placed, watch.part_a, watch.part_b, margin, pair.touches ? pair.axis : PairAxis{},
      s.settings.with_areas, s.look.axis, s.look.clip, s.look.held);
  if (found.choice.touches)
    keep_edges(s.hulls, s.placed, watch.part_a, watch.part_b, before, found.choice.normal,
               static_cast<std::size_t>(pair.held_begin), s.look.held);
  pair.held_end = static_cast<int>(s.look.held.size());
  pair.axis = found.choice.axis;
  pair.near_edges = found.choice.near_edges;
  pair.touches = found.choice.touches;
  pair.incident = found.incident;
  pair.area = found.area;
  pair.other_face = found.choice.other_face;
  pair.hold =
      pair.axis.kind == AxisKind::none ? std::max(0.0, found.choice.separation) : found.choice.hold;
}

// Searches the features of a pair that touches along a known axis; false when none meet.
bool search_features(const Search& s, const PairWatch& watch, ListedPair& pair) {
  ++s.look.n_clipped;
  const std::span<const HeldPoint> before = held_before(s, pair);
  const auto begin = s.look.held.size();
  pair.held_begin = static_cast<int>(s.look.held.size());
  pair.incident = incident_of(s.hulls, s.placed, watch.part_a, watch.part_b, pair.axis);
  pair.area = find_features(s.hulls, s.placed, watch.part_a, watch.part_b, pair.axis, pair.incident,
                            s.settings.with_areas, s.look.clip, s.look.held);
  const Vec3 normal = axis_normal(s.hulls, s.placed, watch.part_a, watch.part_b, pair.axis);
  add_near_edges(s.hulls, s.placed, watch.part_a, watch.part_b, pair.near_edges, normal, begin,
                 s.look.held);
  keep_edges(s.hulls, s.placed, watch.part_a, watch.part_b, before, normal, begin, s.look.held);
  pair.held_end = static_cast<int>(s.look.held.size());
  return pair.held_end > pair.held_begin;
}

void keep_features(const Search& s, ListedPair& pair) {
  const int begin = static_cast<int>(s.look.held.size());
  s.look.held.insert(s.look.held.end(), s.state.held.begin() + pair.held_begin,
                     s.state.held.begin() + pair.held_end);
  pair.held_begin = begin;
  pair.held_end = static_cast<int>(s.look.held.size());
}

// Whether a pair needs no points that do not close in the step.
bool closes_only(const Search& s, const PairWatch& watch) {
  const std::span<const std::uint8_t> closing_only = s.motion.closing_only;
  const int a = s.hulls.body[watch.part_a], b = s.hulls.body[watch.part_b];
  return !closing_only.empty() && closing_only[a] != 0 &&
         (is_fixed(s.hulls, s.motion, b) || closing_only[b] != 0);
}

// Which points a pair needs along its axis.
PointReach point_reach(const Search& s, const PairWatch& watch, double margin, const Vec3& normal) {
  PointReach reach;
  reach.margin = margin;
  const PairMotion& motion = s.motion;
  const int a = s.hulls.body[watch.part_a], b = s.hulls.body[watch.part_b];
  const bool on_fixed = is_fixed(s.hulls, motion, b);
  if (!closes_only(s, watch)) return reach;
  // the end of a turn is nearer to its start than by its chord: half the square of the angle
  double bent = motion.rotation[a].norm() * motion.turn[a];
  Vec3 along = normal.cross(motion.rotation[a]);
  reach.opens_at_origin = normal.dot(motion.step[a]) - along.dot(s.placed.position[a]);
  reach.opens_along = along;
  if (!on_fixed) {
    bent += motion.rotation[b].norm() * motion.turn[b];
    along = normal.cross(motion.rotation[b]);
    reach.opens_at_origin -= normal.dot(motion.step[b]) - along.dot(s.placed.position[b]);
    reach.opens_along -= along;
  }
  reach.closing =
      std::max(s.settings.closing, graze_height(s.hulls, s.settings, watch.part_a, watch.part_b)) +
      bent;
  return reach;
}

// Contacts of a pair whose axis is known. `moved`: since its features were searched.
void add_contacts(const Search& s, const PairWatch& watch, double moved, double margin,
                  const Vec3& normal, ListedPair& pair) {
  const std::span<const HeldPoint> held(s.look.held.data() + pair.held_begin,
                                        s.look.held.data() + pair.held_end);
  add_manifold(s.hulls, s.placed, watch.part_a, watch.part_b, pair.axis, pair.incident, normal,
               pair.area, point_reach(s, watch, margin, normal), held, s.look.manifolds,
               s.look.points);
  if (!has_points(s.look.manifolds.back())) {
    if (apart_along(s.hulls, s.placed, watch.part_a, watch.part_b, normal) > margin)
      s.look.manifolds.pop_back();
    return;
  }
  if (pair.other_face + moved >= -graze_height(s.hulls, s.settings, watch.part_a, watch.part_b))
    s.look.shallow.push_back(static_cast<int>(s.look.manifolds.size()) - 1);
}

// Where the bodies of a pair are, and how far they moved since that was last noted in the pair.
struct Lookup {
  Vec3 between;
  double turned, moved, margin;
};

Lookup look_up(const Search& s, const ListedPair& pair, int a, int b) {
  Lookup now;
  now.between = s.placed.position[b] - s.placed.position[a];
  now.turned = s.placed.turned[a] + s.placed.turned[b];
  now.moved = (now.between - pair.between).norm() + now.turned - pair.turned;
  now.margin = pair_margin(s, a, b);
  return now;
}

void note(Lookup& now, ListedPair& pair) {
  pair.between = now.between;
  pair.turned = now.turned;
  now.moved = 0;
}

// Does the axis that separated the parts still do so?
bool stays_apart(const Search& s, const PairWatch& watch, Lookup& now, ListedPair& pair) {
  if (!s.settings.use_cache || pair.touches || pair.axis.kind == AxisKind::none) return false;
  if (pair.hold - now.moved > now.margin) return true;
  const double separation =
      apart_along(s.hulls, s.placed, watch.part_a, watch.part_b,
                  axis_normal(s.hulls, s.placed, watch.part_a, watch.part_b, pair.axis));
  if (separation <= now.margin) return false;
  pair.hold = separation;
  note(now, pair);
  return true;
}

// Brings axis and features of a pair up to date.
void refresh(const Search& s, const PairWatch& watch, Lookup& now, ListedPair& pair) {
  const double thickness =
      std::min(s.hulls.thickness[watch.part_a], s.hulls.thickness[watch.part_b]);
  const bool known = s.settings.use_cache && pair.touches && now.moved <= pair.hold;
  // in a mass, a part that passes by has other features soon anyway
  const bool passes_by =
      closes_only(s, watch) && now.margin - s.settings.margin > passing_ratio * thickness;
  const double hold = (passes_by ? axis_slack : feature_slack) * thickness;
  if (known && now.moved <= hold) return keep_features(s, pair);
  if (known && search_features(s, watch, pair)) {
    pair.hold -= now.moved;
    pair.other_face += now.moved;
  } else {
    search_all(s, watch, now.margin, pair);
  }
  note(now, pair);
}

// Looks at one listed pair: sets when to look next, and adds its contacts.
void look_at(const Search& s, PairWatch& watch, ListedPair& pair) {
  const int a = s.hulls.body[watch.part_a], b = s.hulls.body[watch.part_b];
  if (!is_awake(s, a) && !is_awake(s, b)) return keep_features(s, pair);
  s.arrangement.make_for(a);
  Lookup now = look_up(s, pair, a, b);
  if (!stays_apart(s, watch, now, pair)) refresh(s, watch, now, pair);
  if (!pair.touches) {
    watch.wake = s.state.travel[a] + s.state.travel[b] + pair.hold - now.moved;
    return;
  }
  watch.wake = look_now;
  const Vec3 normal = axis_normal(s.hulls, s.placed, watch.part_a, watch.part_b, pair.axis);
  if (normal.isZero(0))
    pair.hold = -1;  // edges turned parallel
  else
    add_contacts(s, watch, now.moved, now.margin, normal, pair);
}

// The pairs [begin, end) of the list; `notes` which were looked at.
void look_at_pairs(const Search& s, std::size_t begin, std::size_t end, bool notes) {
  ListLook& look = s.look;
  look.manifolds.clear();
  look.points.clear();
  look.held.clear();
  look.shallow.clear();
  look.looked_at.clear();
  look.n_searched = look.n_clipped = 0;
  for (std::size_t i = begin; i < end; ++i) {
    PairWatch& watch = s.state.watch[i];
    const int a = s.hulls.body[watch.part_a], b = s.hulls.body[watch.part_b];
    if (is_absent(s.motion, a) || is_absent(s.motion, b)) continue;
    if (s.settings.use_cache && reach_of(s, a) + reach_of(s, b) < watch.wake) continue;
    look_at(s, watch, s.state.pairs[i]);
    if (notes) look.looked_at.push_back(static_cast<int>(i));
  }
}

template <class T>
void append(const std::vector<T>& from, std::vector<T>& to) {
  to.insert(to.end(), from.begin(), from.end());
}

// Joins the findings of several looks, in the order of the list.
void join_looks(std::span<const ListLook> looks, PairState& state, PairWork& work,
                PairReport& report) {
  state.held.clear();
  for (const ListLook& look : looks) {
    const auto first_held = static_cast<int>(state.held.size()),
               first_point = static_cast<int>(work.points.size()),
               first_manifold = static_cast<int>(work.manifolds.size());
    for (const int i : look.looked_at) {
      state.pairs[i].held_begin += first_held;
      state.pairs[i].held_end += first_held;
    }
    append(look.held, state.held);
    append(look.points, work.points);
    append(look.manifolds, work.manifolds);
    for (auto m = work.manifolds.begin() + first_manifold; m != work.manifolds.end(); ++m) {
      m->point_begin += first_point;
      m->point_end += first_point;
    }
    for (const int m : look.shallow) work.shallow.push_back(first_manifold + m);
    report.n_searched += look.n_searched;
    report.n_clipped += look.n_clipped;
  }
}

void look_at_list(const Hulls& hulls, const PlacedHulls& placed, const PairMotion& motion,
                  const PairSettings& settings, PairState& state, Arrangement& arrangement,
                  PairWork& work, PairReport& report) {
  for (int b = 0; b < n_free(hulls, motion); ++b) work.reach[b] += state.travel[b];
  const auto look_over = [&](ListLook& look, std::size_t begin, std::size_t end, bool notes) {
    look_at_pairs({hulls, placed, motion, settings, state, arrangement, work.reach, look}, begin,
                  end, notes);
  };
  const std::size_t n = state.watch.size();
  // an arrangement is one at a time
  Workers* const workers = motion.own == nullptr ? settings.workers : nullptr;
  const std::size_t n_looks = talus::n_parts(workers, n);
  if (work.looks.size() < n_looks) work.looks.resize(n_looks);
  if (n_looks == 1) {
    ListLook& look = work.looks[0];
    look_over(look, 0, n, false);
    work.manifolds.swap(look.manifolds);
    work.points.swap(look.points);
    work.shallow.swap(look.shallow);
    state.held.swap(look.held);
    report.n_searched = look.n_searched;
    report.n_clipped = look.n_clipped;
    return;
  }
  in_parts(workers, n, [&](std::size_t i, std::size_t begin, std::size_t end) {
    look_over(work.looks[i], begin, end, true);
  });
  join_looks(std::span(work.looks).first(n_looks), state, work, report);
}

// Manifolds, by free block, that certainly support it: closed within `graze`, and not shallow
// themselves.
void list_supports(const Hulls& hulls, const PairMotion& motion, const PairSettings& settings,
                   PairWork& work) {
  const int n = n_free(hulls, motion);
  const auto carries = [&](const PairManifold& m) {
    const double graze = graze_height(hulls, settings, m.part_a, m.part_b);
    return std::any_of(work.points.begin() + m.point_begin, work.points.begin() + m.point_end,
                       [&](const PairPoint& p) { return p.gap <= graze; });
  };
  std::vector<int>& begin = work.support_begin;
  begin.assign(static_cast<std::size_t>(n) + 2, 0);
  std::vector<int>& bearing = work.bearing;
  bearing.clear();
  auto next_shallow = work.shallow.begin();
  for (int m = 0; m < static_cast<int>(work.manifolds.size()); ++m) {
    if (next_shallow != work.shallow.end() && *next_shallow == m) {
      ++next_shallow;
    } else if (carries(work.manifolds[m])) {
      bearing.push_back(m);
      ++begin[work.manifolds[m].block_a + 1];
      if (work.manifolds[m].block_b < n) ++begin[work.manifolds[m].block_b + 1];
    }
  }
  for (std::size_t b = 1; b < begin.size(); ++b) begin[b] += begin[b - 1];
  work.supports.resize(2 * bearing.size());
  for (auto m = bearing.rbegin(); m != bearing.rend(); ++m) {
    work.supports[--begin[work.manifolds[*m].block_a + 1]] = *m;
    if (work.manifolds[*m].block_b < n) work.supports[--begin[work.manifolds[*m].block_b + 1]] = *m;
  }
}

// Does another block than `other` support `block` along `direction`?
bool is_supported(const PairWork& work, int block, int other, const Vec3& direction) {
  for (int k = work.support_begin[block + 1]; k < work.support_begin[block + 2]; ++k) {
    const PairManifold& m = work.manifolds[work.supports[k]];
    if (m.block_a == other || m.block_b == other) continue;
    const double along = m.normal.dot(direction);
    if ((m.block_a == block ? along : -along) >= same_axis_cos) return true;
  }
  return false;
}

// A fixed body slides over nothing: a block on it does not support it.
bool is_grazing(const Hulls& hulls, const PlacedHulls& placed, const PairMotion& motion,
                const PairSettings& settings, const PairManifold& m, PairWork& work) {
  const double least = -graze_height(hulls, settings, m.part_a, m.part_b);
  for (const int part : {m.part_a, m.part_b}) {
    const int other = part == m.part_a ? m.part_b : m.part_a;
    face_separations(hulls, placed, part, other, work.axis.face_a);
    for (int f = 0; f < hulls.n_faces[part]; ++f) {
      const int slot = hulls.face_begin[part] + f;
      if (work.axis.face_a[f] < least || hulls.cover[slot] == FaceCover::all) continue;
      const Vec3 outward = normal_at(placed, slot);
      const Vec3 to_a = part == m.part_b ? outward : Vec3(-outward);
      if (to_a.dot(m.normal) >= same_axis_cos) continue;
      if (is_supported(work, m.block_a, m.block_b, to_a) ||
          (!is_fixed(hulls, motion, m.block_b) && is_supported(work, m.block_b, m.block_a, -to_a)))
        return true;
    }
  }
  return false;
}

// Removes the manifolds whose numbers are in `dropped`, and their points.
void drop_manifolds(PairWork& work) {
  std::size_t kept = 0;
  int n_points = 0;
  auto next = work.dropped.begin();
  for (std::size_t m = 0; m < work.manifolds.size(); ++m) {
    if (next != work.dropped.end() && *next == static_cast<int>(m)) {
      ++next;
      continue;
    }
    PairManifold manifold = work.manifolds[m];
    const auto from = work.points.begin();
    std::copy(from + manifold.point_begin, from + manifold.point_end, from + n_points);
    manifold.point_end = n_points + manifold.point_end - manifold.point_begin;
    manifold.point_begin = n_points;
    n_points = manifold.point_end;
    work.manifolds[kept++] = manifold;
  }
  work.manifolds.resize(kept);
  work.points.resize(n_points);
}

int drop_grazing(const Hulls& hulls, const PlacedHulls& placed, const PairMotion& motion,
                 const PairSettings& settings, Arrangement& arrangement, PairWork& work) {
  if (work.shallow.empty()) return 0;
  list_supports(hulls, motion, settings, work);
  work.dropped.clear();
  for (const int m : work.shallow) {
    arrangement.make_for(work.manifolds[m].block_a);
    if (is_grazing(hulls, placed, motion, settings, work.manifolds[m], work))
      work.dropped.push_back(m);
  }
  if (!work.dropped.empty()) drop_manifolds(work);
  return static_cast<int>(work.dropped.size());
}

}  // namespace

PairReport find_pair_contacts(const Hulls& hulls, PlacedHulls& placed, const PairMotion& motion,
                              const PairSettings& settings, PairState& state, PairWork& work) {
  PairReport report;
  work.manifolds.clear();
  work.points.clear();
  work.shallow.clear();
  Arrangement arrangement(hulls, motion, placed, work.shifted);
  follow_motion(hulls, placed, motion, settings, state, work);
  if (!list_is_good(hulls, placed, motion, settings, state, work)) {
    report.n_fixed_near = relist(hulls, placed, motion, settings, state, arrangement, work);
    report.relisted = true;
  }
  look_at_list(hulls, placed, motion, settings, state, arrangement, work, report);
  report.n_listed = static_cast<int>(state.pairs.size());
  report.n_grazing = drop_grazing(hulls, placed, motion, settings, arrangement, work);
  arrangement.put_back();
  return report;
}

}  // namespace talus
