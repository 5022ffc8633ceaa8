#include "contact/body_overlap.hpp"

#include <algorithm>
#include <limits>

#include "contact/pair_axes.hpp"

namespace talus {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double across = 1e-12;      // cosine: an axis across the direction of a displacement
constexpr double same_place = 1e-12;  // [m]

// No more than this are two parts in each other: what their faces say, a fraction of all axes.
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
    if (rate > across)
      end = std::min(end, way.depth / rate);
    else if (rate < -across)
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
      if (begin > at + same_place || !(end > at + same_place) || begin >= end) continue;
      at = end;
      moved = true;
    }
  }
  return at;
}

// Of the paths along the ways out of pairs that overlap those shorter than `least`. A path may be
// shorter than its way's depth, as it leaves through other faces; `all`: those ways count too.
double shorter_path(const BodyOverlapScratch& scratch, bool all, double least) {
  for (std::size_t pair = 0; pair + 1 < scratch.begin.size(); ++pair) {
    if (least_depth(scratch, pair) <= 0) continue;
    for (int k = scratch.begin[pair]; k < scratch.begin[pair + 1]; ++k)
      if (all || scratch.ways[k].depth < least)
        least = std::min(least, path_along(scratch, pair, scratch.ways[k].axis, least));
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
  // out of one of several parts may be into the next: what faces say then bounds nothing
  if (deepest <= (n_pairs == 1 ? ignored : 0)) return 0;
  for_each_pair(hulls, placed, body_a, body_b,
                [&](const PartPair& parts) { add_ways(parts, scratch); });
  scratch.begin.push_back(static_cast<int>(scratch.ways.size()));
  double bound = 0;  // no path is shorter: it leaves each pair
  for (std::size_t pair = 0; pair + 1 < scratch.begin.size(); ++pair)
    bound = std::max(bound, least_depth(scratch, pair));
  if (bound <= same_place) return 0;
  const double least = shorter_path(scratch, false, infinity);
  if (least <= bound + same_place) return least;
  const double other = shorter_path(scratch, true, least);
  return other < least - same_place ? other : least;
}

}  // namespace talus
