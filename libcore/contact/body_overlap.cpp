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

bool overlap(const BodyOverlapScratch& scratch, std::size_t pair) {
  for (int k = scratch.begin[pair]; k < scratch.begin[pair + 1]; ++k)
    if (scratch.ways[k].depth <= 0) return false;
  return true;
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

// How far A moves along a direction until it is out of all of B; `enough` is as good as more.
double path_along(const BodyOverlapScratch& scratch, const Vec3& direction, double enough) {
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
  double least = infinity;
  for (std::size_t pair = 0; pair + 1 < scratch.begin.size(); ++pair) {
    if (!overlap(scratch, pair)) continue;
    for (int k = scratch.begin[pair]; k < scratch.begin[pair + 1]; ++k)
      if (scratch.ways[k].depth < least)
        least = std::min(least, path_along(scratch, scratch.ways[k].axis, least));
  }
  return least < infinity ? least : 0;
}

}  // namespace talus
