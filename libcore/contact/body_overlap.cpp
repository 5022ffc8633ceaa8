// Depth of overlap of two bodies: the shortest displacement that separates all their parts.
#include "contact/body_overlap.hpp"

#include <Eigen/LU>
#include <algorithm>

#include "base/numbers.hpp"
#include "contact/pair_axes.hpp"
#include "contact/scales.hpp"

namespace talus {
namespace {

// Upper bound of the overlap of two parts, by their faces alone: a fraction of the cost of all
// axes.
double depth_by_faces(const PartPair& parts) {
  double depth = infinity;
  for_each_face_normal(parts, [&](const Vec3&, double separation, FaceCover) {
    depth = std::min(depth, -separation);
  });
  return depth;
}

template <class Visit>
void for_each_pair(const Hulls& hulls, const PlacedHulls& placed, int body_a, int body_b,
                   Visit&& visit) {
  for (int a = hulls.part_begin[body_a]; a < hulls.part_begin[body_a + 1]; ++a)
    for (int b = hulls.part_begin[body_b]; b < hulls.part_begin[body_b + 1]; ++b)
      visit(PartPair{hulls, placed, a, b});
}

void add_ways(const PartPair& parts, BodyOverlapScratch& scratch) {
  scratch.begin.push_back(static_cast<int>(scratch.ways.size()));
  for_each_face_normal(parts, [&](const Vec3& normal, double separation, FaceCover) {
    scratch.ways.push_back({normal, -separation});
  });
  for_each_crossing(parts, false, [&](const Vec3& normal, double separation) {
    scratch.ways.push_back({normal, -separation});
  });
}

// The least displacement that takes the parts of a pair apart; 0 or less: they are.
double least_depth(const BodyOverlapScratch& scratch, std::size_t pair) {
  double least = infinity;
  for (int k = scratch.begin[pair]; k < scratch.begin[pair + 1]; ++k)
    least = std::min(least, scratch.ways[k].depth);
  return least;
}

// From where to where along a direction the parts of a pair overlap.
void range_along(const BodyOverlapScratch& scratch, std::size_t pair, const Vec3& direction,
                 double& begin, double& end) {
  begin = -infinity;
  end = infinity;
  for (int k = scratch.begin[pair]; k < scratch.begin[pair + 1]; ++k) {
    const WayOut& way = scratch.ways[k];
    const double rate = way.axis.dot(direction);
    if (rate > last_figures)
      end = std::min(end, way.depth / rate);
    else if (rate < -last_figures)
      begin = std::max(begin, way.depth / rate);
    else if (way.depth <= 0)
      begin = infinity;
  }
}

// How far A moves along a direction until it is out of all of B; `enough` is as good as more. The
// parts of pair `first` overlap: those it has to leave at least.
double path_along(const BodyOverlapScratch& scratch, std::size_t first, const Vec3& direction,
                  double enough) {
  double begin_of_first = 0, end_of_first = 0;
  range_along(scratch, first, direction, begin_of_first, end_of_first);
  if (end_of_first >= enough) return end_of_first;
  double at = 0;
  for (bool moved = true; moved && at < enough;) {
    moved = false;
    for (std::size_t pair = 0; pair + 1 < scratch.begin.size(); ++pair) {
      double begin = 0, end = 0;
      range_along(scratch, pair, direction, begin, end);
      if (begin > at + last_figures || !(end > at + last_figures) || begin >= end) continue;
      at = end;
      moved = true;
    }
  }
  return at;
}

// The shortest path out of all pairs, along one of the axes out of an overlapping pair, if it is
// shorter than `least`. A path may be shorter than the depth along its axis, as it leaves through
// other faces; `all`: try such axes too.
double shorter_path(const BodyOverlapScratch& scratch, bool all, double least) {
  for (std::size_t pair = 0; pair + 1 < scratch.begin.size(); ++pair) {
    if (least_depth(scratch, pair) <= 0) continue;
    for (int k = scratch.begin[pair]; k < scratch.begin[pair + 1]; ++k)
      if (all || scratch.ways[k].depth < least)
        least = std::min(least, path_along(scratch, pair, scratch.ways[k].axis, least));
  }
  return least;
}

// --- displacements in any direction ------------------------------------------------------------

constexpr int most_tried = 2000;

double left_to_go(const WayOut& way, const Vec3& x) { return way.depth - way.axis.dot(x); }

// The part that A is in deepest after a displacement; -1: it is out of all.
int deepest_pair(const BodyOverlapScratch& scratch, const Vec3& x) {
  int deepest = -1;
  double most = rounding;
  for (std::size_t pair = 0; pair + 1 < scratch.begin.size(); ++pair) {
    double least = infinity;
    for (int k = scratch.begin[pair]; k < scratch.begin[pair + 1] && least > most; ++k)
      least = std::min(least, left_to_go(scratch.ways[k], x));
    if (least > most) most = least, deepest = static_cast<int>(pair);
  }
  return deepest;
}

// Takes x if it goes far enough along all axes of `d` and is shorter than the best so far.
void take_shorter(const BodyOverlapScratch& scratch, const Vec3& x, Displacement& d) {
  const double length = x.norm();
  if (!(length < d.length)) return;
  for (int i = 0; i < d.n_ways; ++i)
    if (left_to_go(scratch.ways[d.ways[i]], x) > rounding / 2) return;
  d.x = x;
  d.length = length;
}

// The shortest displacement that goes to the end of the last axis of `d` and as far along the rest
// as they require: it ends on one, two or three of the planes. False: there is none, or it is at
// least as long as `least`.
bool shorten(const BodyOverlapScratch& scratch, double least, Displacement& d) {
  const auto way = [&](int i) -> const WayOut& { return scratch.ways[d.ways[i]]; };
  const int last = d.n_ways - 1;
  const WayOut& a = way(last);
  d.length = least;
  take_shorter(scratch, a.depth * a.axis, d);
  for (int i = 0; i < last; ++i) {
    const WayOut& b = way(i);
    const double c = a.axis.dot(b.axis), sin_sq = 1 - c * c;
    if (!(sin_sq > last_figures)) continue;
    const double of_a = (a.depth - c * b.depth) / sin_sq, of_b = (b.depth - c * a.depth) / sin_sq;
    take_shorter(scratch, of_a * a.axis + of_b * b.axis, d);
    for (int k = 0; k < i; ++k) {
      Mat3 planes;
      planes << a.axis.transpose(), b.axis.transpose(), way(k).axis.transpose();
      if (!(std::abs(planes.determinant()) > last_figures)) continue;
      take_shorter(scratch, planes.inverse() * Vec3(a.depth, b.depth, way(k).depth), d);
    }
  }
  return d.length < least;
}

// The shortest of all displacements that lead out of every part, if one is shorter than `least`.
// Tried from the shortest on, each is extended along an axis out of the part that A is in deepest:
// the first that is out of all parts is the shortest.
double least_displacement(double least, BodyOverlapScratch& scratch) {
  std::vector<Displacement>& heap = scratch.tried;
  const auto is_longer = [](const Displacement& a, const Displacement& b) {
    return a.length > b.length;
  };
  heap.assign(1, Displacement{});
  for (int n = 0; n < most_tried && !heap.empty(); ++n) {
    std::pop_heap(heap.begin(), heap.end(), is_longer);
    const Displacement shortest = heap.back();
    heap.pop_back();
    const int pair = deepest_pair(scratch, shortest.x);
    if (pair < 0) return shortest.length;
    if (shortest.n_ways == Displacement::most_ways) return least;
    for (int k = scratch.begin[pair]; k < scratch.begin[pair + 1]; ++k) {
      Displacement next = shortest;
      next.ways[next.n_ways++] = k;
      if (!shorten(scratch, least, next)) continue;
      heap.push_back(next);
      std::push_heap(heap.begin(), heap.end(), is_longer);
    }
  }
  return least;
}

}  // namespace

double body_overlap(const Hulls& hulls, const PlacedHulls& placed, int body_a, int body_b,
                    double ignored, BodyOverlapScratch& scratch) {
  scratch.ways.clear();
  scratch.begin.clear();
  int n_pairs = 0;
  double deepest = 0;
  for_each_pair(hulls, placed, body_a, body_b, [&](const PartPair& parts) {
    ++n_pairs;
    deepest = std::max(deepest, depth_by_faces(parts));
  });
  // out of one of several parts may be into the next: then the bound by faces does not hold
  if (deepest <= (n_pairs == 1 ? ignored : 0)) return 0;
  for_each_pair(hulls, placed, body_a, body_b,
                [&](const PartPair& parts) { add_ways(parts, scratch); });
  scratch.begin.push_back(static_cast<int>(scratch.ways.size()));
  double bound = 0;  // no path is shorter: it leaves each pair
  for (std::size_t pair = 0; pair + 1 < scratch.begin.size(); ++pair)
    bound = std::max(bound, least_depth(scratch, pair));
  if (bound <= last_figures) return 0;
  const double least = shorter_path(scratch, false, infinity);
  if (least <= bound + last_figures) return least;
  return least_displacement(shorter_path(scratch, true, least), scratch);
}

}  // namespace talus
