// Greatest height of a path above the ground below it.
#include "record/path_heights.hpp"

#include <cmath>

#include "terrain/trn_walk.hpp"

namespace talus {
namespace {

void raise(double& largest, double height) {
  if (!(height <= largest) && !std::isnan(height)) largest = height;
}

// Heights above the plane of one triangle between s0 and s1, where the path stays over it.
void raise_over_triangle(const Trn& trn, const HeightPath& path, double s0, double s1,
                         Heights& largest) {
  const Vec3 change = path.to - path.from;
  const Vec3 middle = path.from + 0.5 * (s0 + s1) * change;
  const GridPoint at = locate(trn, middle.x(), middle.y());
  const Vec2 gradient = triangle_gradient(trn, at.cell, is_upper(at));
  const Vec3 off = path.from - node_point(trn, at.cell.row, at.cell.col);
  const double start = off.z() - gradient.dot(off.head<2>());
  const double rate = change.z() - gradient.dot(change.head<2>());
  const double top_rate = path.top_to - path.top_from;
  const auto height = [&](double s) { return start + rate * s - path.sag * s * (1 - s); };
  const auto try_at = [&](double s) {
    const double above = height(s);
    raise(largest.centroid, above);
    raise(largest.top, above + path.top_from + top_rate * s);
  };
  try_at(s0);
  try_at(s1);
  if (path.sag >= 0) return;
  for (const double r : {rate, rate + top_rate}) {  // h'(s) = r - sag + 2 sag s vanishes
    const double s = (path.sag - r) / (2 * path.sag);
    if (s > s0 && s < s1) try_at(s);
  }
}

}  // namespace

Heights largest_heights(const Trn& trn, const HeightPath& path, double s_in, double s_out) {
  const Vec2 change = (path.to - path.from).head<2>();
  const Vec2 a = path.from.head<2>() + s_in * change, b = path.from.head<2>() + s_out * change;
  Heights largest;
  if (contains(trn, a.x(), a.y()) && contains(trn, b.x(), b.y()) &&
      triangle_at(trn, a.x(), a.y()) == triangle_at(trn, b.x(), b.y())) {
    raise_over_triangle(trn, path, s_in, s_out, largest);
    return largest;
  }
  walk_cells(trn, a, b, [&](const CellPart& part) {
    const auto off_diagonal = [&](double t) {  // > 0 south-west of the cell's diagonal
      const Vec2 at = a + t * (b - a);
      return (trn.node0.y() - at.y()) / trn.cell_size - part.cell.row -
             ((at.x() - trn.node0.x()) / trn.cell_size - part.cell.col);
    };
    const double d_in = off_diagonal(part.t_in), d_out = off_diagonal(part.t_out);
    const auto add = [&](double t0, double t1) {
      const double range = s_out - s_in;
      raise_over_triangle(trn, path, s_in + t0 * range, s_in + t1 * range, largest);
    };
    if (d_in * d_out < 0) {
      const double t = part.t_in + d_in / (d_in - d_out) * (part.t_out - part.t_in);
      add(part.t_in, t);
      add(t, part.t_out);
    } else {
      add(part.t_in, part.t_out);
    }
  });
  return largest;
}

}  // namespace talus
