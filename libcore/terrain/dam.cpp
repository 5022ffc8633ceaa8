// Dams of earth and galleries laid on a terrain and burnt into it.
#include "terrain/dam.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "geometry/plan2d.hpp"
#include "terrain/trn_edge_crossings.hpp"
#include "terrain/trn_walk.hpp"

namespace talus {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();
constexpr double most_heights = 10;      // largest run of a face, in heights of the dam
constexpr double same_place = 1e-6;      // what is nearer than this meets [m]
constexpr double most_fine_nodes = 4e6;  // of the grid that the designed volumes are taken from
constexpr double finest_turn = std::numbers::pi / 12;  // of the sides of a round corner
constexpr double fine_per_crest = 4;                   // its cells across the crest

// --- the line --------------------------------------------------------------------------------

/// A place as a part of the line sees it: a straight piece, or one of its points.
struct Sight {
  double crest = 0, foot = 0;  // heights there: of the crest, and of the foot [m]
  double across = 0;           // distance from the line, > 0 uphill [m]
  double beyond = 0;           // distance past an end, along the line [m]
  double cot = 0;              // of the face
};

double cot_of(const DamShape& shape, double across) {
  return 1 / (across >= 0 ? shape.tan_uphill : shape.tan_downhill);
}

Vec2 direction_of(const Dam& dam, std::size_t piece) {
  return (dam.crest[piece + 1] - dam.crest[piece]).head<2>().normalized();
}

// Beyond an end the face turns from one side to the other, its run from theirs to theirs.
Sight sight_beyond_end(const Dam& dam, std::size_t point, const Vec2& out, const Vec2& q) {
  const Vec2 along = point == 0 ? Vec2(-out) : out;
  const Vec2 uphill = dam.uphill * Vec2(-along.y(), along.x());
  const double across = q.dot(uphill), r = q.norm();
  const double turned = r > 0 ? std::acos(std::clamp(across / r, -1.0, 1.0)) / std::numbers::pi : 0;
  const double up = cot_of(dam.shape, 1), down = cot_of(dam.shape, -1);
  return {dam.crest[point].z(), dam.foot[point].z(), across, q.dot(out), up + turned * (down - up)};
}

// Calls look(Sight) for the parts of the line that `at` lies beside: pieces between their ends, the
// outer sides of corners, what is beyond the ends.
template <class Look>
void for_each_sight(const Dam& dam, const Vec2& at, Look&& look) {
  const std::size_t n = dam.crest.size();
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const Vec3 &a = dam.crest[i], &b = dam.crest[i + 1];
    const double length = (b - a).head<2>().norm();
    const Vec2 along = direction_of(dam, i), q = at - a.head<2>();
    const double share = std::clamp(q.dot(along) / length, 0.0, 1.0);
    if (std::abs(q.dot(along) - share * length) > same_place) continue;
    const double across = dam.uphill * cross(along, q);
    look(Sight{a.z() + share * (b.z() - a.z()),
               dam.foot[i].z() + share * (dam.foot[i + 1].z() - dam.foot[i].z()), across, 0,
               cot_of(dam.shape, across)});
  }
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 q = at - dam.crest[i].head<2>();
    if (i == 0 || i + 1 == n) {
      const Vec2 out = i == 0 ? Vec2(-direction_of(dam, 0)) : direction_of(dam, n - 2);
      if (q.dot(out) >= 0) look(sight_beyond_end(dam, i, out, q));
      continue;
    }
    const Vec2 before = direction_of(dam, i - 1), after = direction_of(dam, i);
    if (q.dot(before) < 0 || q.dot(after) > 0) continue;
    // the outer side of the corner is the right of a line that turns left
    const double across = (cross(before, after) > 0 ? -dam.uphill : dam.uphill) * q.norm();
    look(Sight{dam.crest[i].z(), dam.foot[i].z(), across, 0, cot_of(dam.shape, across)});
  }
}

double distance_to(const Dam& dam, const Vec2& at) {
  double nearest = never;
  for (std::size_t i = 0; i + 1 < dam.crest.size(); ++i)
    nearest = std::min(
        nearest, distance_to_segment<Vec2>(at, dam.crest[i].head<2>(), dam.crest[i + 1].head<2>()));
  return nearest;
}

// How far from the line faces and the sides of the ditch may run.
double reach_of(const Dam& dam) {
  return dam.shape.crest_width / 2 + dam.shape.ditch_width +
         most_heights * (dam.most_height + dam.shape.ditch_depth);
}

// --- laying ----------------------------------------------------------------------------------

// Of a corner the middle of those of its two pieces.
Vec2 uphill_normal(const Dam& dam, std::size_t point) {
  const std::size_t last = dam.crest.size() - 2;
  const Vec2 along =
      direction_of(dam, point == 0 ? 0 : point - 1) + direction_of(dam, std::min(point, last));
  return dam.uphill * Vec2(-along.y(), along.x()).normalized();
}

// Where the uphill face meets the ground across a point of the line.
DamFault find_foot(const Trn& ground, const Dam& dam, std::size_t point, Vec3& foot) {
  const Vec2 from = dam.crest[point].head<2>(), normal = uphill_normal(dam, point);
  const auto above = [&](double r) {
    const Vec2 at = from + r * normal;
    return dam_height_at(dam, at) - elevation_at(ground, at.x(), at.y());
  };
  const double reach = reach_of(dam), step = std::min(ground.cell_size, dam.shape.crest_width) / 8;
  double low = 0;
  for (double high = step;; high += step) {
    const double gap = above(high);
    if (std::isnan(gap)) return {DamFault::off_the_ground, from + high * normal};
    if (high > reach) return {DamFault::uphill_face, from + high * normal};
    if (gap > 0) {
      low = high;
      continue;
    }
    for (int halving = 0; halving < 60; ++halving) {
      const double middle = 0.5 * (low + high);
      (above(middle) > 0 ? low : high) = middle;
    }
    const Vec2 at = from + high * normal;
    foot = {at.x(), at.y(), elevation_at(ground, at.x(), at.y())};
    return {};
  }
}

void measure_heights(const Trn& ground, Dam& dam) {
  dam.least_height = dam.most_height = dam.shape.height;
  for (std::size_t i = 0; i + 1 < dam.crest.size(); ++i) {
    const Vec3 &a = dam.crest[i], &b = dam.crest[i + 1];
    for_each_edge_crossing(ground, a.head<2>(), b.head<2>(), [&](double share) {
      const Vec3 at = a + share * (b - a);
      const double height = at.z() - elevation_at(ground, at.x(), at.y());
      dam.least_height = std::min(dam.least_height, height);
      dam.most_height = std::max(dam.most_height, height);
    });
  }
}

// --- burning ---------------------------------------------------------------------------------

/// A part of a terrain: as many nodes, from a row and column on, each cell parted in `k`.
Trn part_of(const Trn& trn, int row, int col, int n_rows, int n_cols, int k) {
  Trn part;
  part.n_rows = (n_rows - 1) * k + 1;
  part.n_cols = (n_cols - 1) * k + 1;
  part.cell_size = trn.cell_size / k;
  part.node0 = node_point(trn, row, col).head<2>();
  part.elevation.resize(static_cast<std::size_t>(part.n_rows) *
                        static_cast<std::size_t>(part.n_cols));
  for (int r = 0; r < part.n_rows; ++r)
    for (int c = 0; c < part.n_cols; ++c) {
      GridPoint at{{std::min(row + r / k, trn.n_rows - 2), std::min(col + c / k, trn.n_cols - 2)}};
      at.south = row + static_cast<double>(r) / k - at.cell.row;
      at.east = col + static_cast<double>(c) / k - at.cell.col;
      // NaN times 0 is NaN: a node itself is known whatever its neighbours are
      const bool is_node = r % k == 0 && c % k == 0;
      part.elevation[node_index(part, r, c)] =
          is_node ? trn.elevation[node_index(trn, row + r / k, col + c / k)]
                  : elevation_at(trn, at);
    }
  return part;
}

struct Burnt {
  DamFault fault;
  std::vector<int> nodes;
};

DamFault fault_at(const Dam& dam, const Vec2& at, bool is_fill) {
  if (!is_fill) return {DamFault::ditch_side, at};
  double highest = -never, across = 0;
  for_each_sight(dam, at, [&](const Sight& s) {
    const double z = s.crest - std::abs(s.across) / s.cot;
    if (z > highest) {
      highest = z;
      across = s.across;
    }
  });
  return {across > 0 ? DamFault::uphill_face : DamFault::downhill_face, at};
}

// Goes from the line over neighbours as long as the dam stands above the ground or the ditch below.
Burnt burn(const Dam& dam, Trn& trn) {
  const double reach = reach_of(dam);
  std::vector<char> seen(trn.elevation.size(), 0);
  std::vector<int> open;
  std::vector<std::pair<int, double>> moved;
  const auto add = [&](int row, int col) {
    char& known = seen[node_index(trn, row, col)];
    if (known == 0) open.push_back(static_cast<int>(node_index(trn, row, col)));
    known = 1;
  };
  for (std::size_t i = 0; i + 1 < dam.crest.size(); ++i)
    walk_cells(trn, dam.crest[i].head<2>(), dam.crest[i + 1].head<2>(), [&](const CellPart& part) {
      for (const int r : {0, 1})
        for (const int c : {0, 1}) add(part.cell.row + r, part.cell.col + c);
    });
  while (!open.empty()) {
    const int node = open.back();
    open.pop_back();
    const int row = node / trn.n_cols, col = node % trn.n_cols;
    const Vec3 p = node_point(trn, row, col);
    const Vec2 at = p.head<2>();
    const double body = dam_height_at(dam, at), ditch = ditch_height_at(dam, at);
    if (std::isnan(p.z())) return {{DamFault::off_the_ground, at}, {}};
    if (!(body > p.z() - same_place || ditch < p.z() + same_place)) continue;
    const double z = std::max(std::min(p.z(), ditch), body);
    if (distance_to(dam, at) > reach) return {fault_at(dam, at, z > p.z()), {}};
    if (z != p.z()) {
      if (row == 0 || col == 0 || row + 1 == trn.n_rows || col + 1 == trn.n_cols)
        return {{DamFault::off_the_ground, at}, {}};
      moved.emplace_back(node, z);
    }
    for (int r = std::max(0, row - 1); r <= std::min(trn.n_rows - 1, row + 1); ++r)
      for (int c = std::max(0, col - 1); c <= std::min(trn.n_cols - 1, col + 1); ++c) add(r, c);
  }
  std::sort(moved.begin(), moved.end());
  Burnt burnt;
  for (const auto& [node, z] : moved) {
    trn.elevation[static_cast<std::size_t>(node)] = z;
    burnt.nodes.push_back(node);
  }
  return burnt;
}

// Of a triangle whose corners were lifted by a, b, c: the mean over its area of what is above zero.
double mean_above_zero(double a, double b, double c) {
  std::array<double, 3> x{a, b, c};
  std::sort(x.begin(), x.end());
  if (x[0] >= 0) return (x[0] + x[1] + x[2]) / 3;
  if (x[2] <= 0) return 0;
  if (x[1] <= 0) return x[2] / 3 * (x[2] / (x[2] - x[0])) * (x[2] / (x[2] - x[1]));
  // all of it, less the corner below zero, which counts as negative in the sum
  return (x[0] + x[1] + x[2]) / 3 - x[0] / 3 * (x[0] / (x[0] - x[1])) * (x[0] / (x[0] - x[2]));
}

Earthwork earthwork_between(const Trn& before, const Trn& after) {
  Earthwork work;
  const double area = before.cell_size * before.cell_size / 2;
  const auto lift = [&](int row, int col) {
    const std::size_t i = node_index(before, row, col);
    return after.elevation[i] - before.elevation[i];
  };
  for (int r = 0; r + 1 < before.n_rows; ++r)
    for (int c = 0; c + 1 < before.n_cols; ++c)
      for (const double middle : {lift(r + 1, c), lift(r, c + 1)}) {
        const double a = lift(r, c), b = lift(r + 1, c + 1);
        if (std::isnan(a + b + middle) || (a == 0 && b == 0 && middle == 0)) continue;
        work.fill += area * mean_above_zero(a, b, middle);
        work.cut += area * mean_above_zero(-a, -b, -middle);
      }
  return work;
}

// The part of the terrain that the dam can reach.
struct Reach {
  int row, col, n_rows, n_cols;
};

Reach window_of(const Dam& dam, const Trn& trn) {
  Vec2 low(never, never), high(-never, -never);
  for (const Vec3& p : dam.crest) {
    low = low.cwiseMin(p.head<2>());
    high = high.cwiseMax(p.head<2>());
  }
  const double reach = reach_of(dam) + 2 * trn.cell_size;
  const GridPoint first = locate(trn, low.x() - reach, high.y() + reach);
  const GridPoint last = locate(trn, high.x() + reach, low.y() - reach);
  return {first.cell.row, first.cell.col, last.cell.row - first.cell.row + 2,
          last.cell.col - first.cell.col + 2};
}

}  // namespace

double dam_height_at(const Dam& dam, const Vec2& at) {
  double highest = -never;
  for_each_sight(dam, at, [&](const Sight& s) {
    if (dam.shape.is_gallery) {
      const bool is_roof = std::abs(s.across) <= dam.shape.crest_width / 2 + same_place;
      if (is_roof && s.beyond <= same_place) highest = std::max(highest, s.crest);
      return;
    }
    const double off = std::hypot(s.across, s.beyond);
    // a corner's distance is its own: nothing is beyond it
    highest = std::max(highest, s.crest - std::max(0.0, off - dam.shape.crest_width / 2) / s.cot);
  });
  return highest;
}

double ditch_height_at(const Dam& dam, const Vec2& at) {
  const DamShape& shape = dam.shape;
  if (shape.is_gallery || !(shape.ditch_depth > 0)) return never;
  double nearest = never, height = never;
  for_each_sight(dam, at, [&](const Sight& s) {
    const double off = std::hypot(s.across, s.beyond);
    if (!(off < nearest)) return;
    nearest = off;
    const double bottom = s.foot - shape.ditch_depth;
    const double from = shape.crest_width / 2 + (s.crest - bottom) / shape.tan_uphill;
    height = bottom + std::max({0.0, (from - s.across) * shape.tan_uphill,
                                (s.across - from - shape.ditch_width) * shape.tan_downhill,
                                s.beyond * shape.tan_downhill});
  });
  return height;
}

int corners_among(const Trn& trn, const std::vector<int>& nodes, const Vec2& at) {
  const GridPoint place = locate(trn, at.x(), at.y());
  const auto is_among = [&](int south, int east) {
    const std::size_t node = node_index(trn, place.cell.row + south, place.cell.col + east);
    return std::binary_search(nodes.begin(), nodes.end(), static_cast<int>(node)) ? 1 : 0;
  };
  return is_among(0, 0) + is_among(1, 1) + (is_upper(place) ? is_among(0, 1) : is_among(1, 0));
}

bool is_on_a_dam(const Trn& trn, const Vec2& at) {
  return std::any_of(trn.dams.begin(), trn.dams.end(),
                     [&](const BurntDam& dam) { return corners_among(trn, dam.nodes, at) > 0; });
}

std::vector<Vec2> line_beside(const std::vector<Vec2>& line, double distance) {
  std::vector<Vec2> out;
  const std::size_t last = line.size() - 2;
  const auto piece = [&](std::size_t i) { return Vec2(line[i + 1] - line[i]); };
  for (std::size_t i = 0; i < line.size(); ++i) {
    const Vec2 before = piece(i == 0 ? 0 : i - 1), after = piece(std::min(i, last));
    const auto left = [](const Vec2& along) { return Vec2(-along.y(), along.x()).normalized(); };
    const Vec2 a = distance * left(before), b = distance * left(after);
    const double turn = std::atan2(cross(a, b), a.dot(b));
    const int n = static_cast<int>(std::ceil(std::abs(turn) / finest_turn));
    if (turn * distance < 0 && n > 1) {
      for (int k = 0; k <= n; ++k) out.emplace_back(line[i] + Eigen::Rotation2Dd(k * turn / n) * a);
      continue;
    }
    const double shortest = std::min(before.norm(), after.norm());
    const double back = std::min(std::abs(distance * std::tan(turn / 2)), shortest);
    out.emplace_back(line[i] + std::hypot(distance, back) * (a + b).normalized());
  }
  return out;
}

std::vector<RoofPiece> roof_pieces(const Trn& trn, const DamShape& gallery) {
  const double inwards = 1.5 * trn.cell_size;  // from a roof's end to where it is whole
  std::vector<RoofPiece> pieces;
  std::vector<Vec2> lefts;
  for (std::size_t i = 0; i + 1 < gallery.line.size(); ++i) {
    const Vec2 &a = gallery.line[i], &b = gallery.line[i + 1];
    const double length = (b - a).norm(), inner = length - 2 * inwards;
    const Vec2 along = (b - a) / length, left(-along.y(), along.x());
    const Vec2 from = a + inwards * along, to = b - inwards * along;
    const double rise = elevation_at(trn, to.x(), to.y()) - elevation_at(trn, from.x(), from.y());
    const double slope = inner > trn.cell_size ? rise / inner : 0;
    const Vec3 normal = Vec3(-slope * along.x(), -slope * along.y(), 1).normalized();
    lefts.emplace_back(gallery.crest_width / 2 * left);
    pieces.push_back({{a - lefts[i], b - lefts[i], b + lefts[i], a + lefts[i]}, normal});
    if (i == 0) continue;
    // the outer side of the corner is the right of a line that turns left
    const double side = cross(lefts[i - 1], lefts[i]) > 0 ? -1 : 1;
    const Vec2 first = side * lefts[i - 1], last = side * lefts[i];
    const double turn = std::atan2(cross(first, last), first.dot(last));
    const int n = static_cast<int>(std::ceil(std::abs(turn) / finest_turn));
    if (n == 0) continue;
    RoofPiece corner{{a}, normal};
    for (int k = 0; k <= n; ++k)
      corner.ring.emplace_back(a + Eigen::Rotation2Dd(k * turn / n) * first);
    if (turn < 0) std::reverse(corner.ring.begin() + 1, corner.ring.end());
    pieces.push_back(std::move(corner));
  }
  return pieces;
}

double side_distance(const DamShape& shape) {
  return shape.crest_width / 2 + shape.ditch_width + 3 * (shape.height + shape.ditch_depth);
}

SideRise rise_to_the_left(const Trn& ground, const DamShape& shape) {
  const double beyond = side_distance(shape);
  double sum = 0, length = 0, left_length = 0, right_length = 0;
  for (std::size_t i = 0; i + 1 < shape.line.size(); ++i) {
    const Vec2 along = shape.line[i + 1] - shape.line[i];
    const Vec2 left = Vec2(-along.y(), along.x()).normalized();
    const Vec2 middle = 0.5 * (shape.line[i] + shape.line[i + 1]);
    const Vec2 off = beyond * left;
    const Vec2 a = middle + off, b = middle - off;
    const double rise = elevation_at(ground, a.x(), a.y()) - elevation_at(ground, b.x(), b.y());
    if (std::isnan(rise)) continue;
    sum += rise * along.norm();
    length += along.norm();
    (rise < 0 ? right_length : left_length) += along.norm();
  }
  if (length == 0) return {};
  return {sum / length, (sum < 0 ? left_length : right_length) / length};
}

DamFault lay_dam(const Trn& ground, const DamShape& shape, Dam& dam) {
  TALUS_ASSERT(shape.line.size() >= 2);
  dam = {};
  dam.shape = shape;
  for (const Vec2& p : shape.line) {
    const double z = elevation_at(ground, p.x(), p.y());
    if (std::isnan(z)) return {DamFault::off_the_ground, p};
    dam.crest.emplace_back(p.x(), p.y(), z + shape.height);
  }
  dam.uphill = rise_to_the_left(ground, shape).mean < 0 ? -1 : 1;
  dam.foot = dam.crest;
  measure_heights(ground, dam);
  if (shape.is_gallery) return {};
  std::vector<Vec3> feet;
  for (std::size_t i = 0; i < dam.crest.size(); ++i) {
    Vec3 foot;
    if (const DamFault fault = find_foot(ground, dam, i, foot); fault.kind != DamFault::none)
      return fault;
    feet.push_back(foot);
  }
  dam.foot = std::move(feet);
  return {};
}

DamBurn burn_dam(const Dam& dam, Trn& trn) {
  DamBurn out;
  const Reach reach = window_of(dam, trn);
  const auto part = [&](int k) {
    return part_of(trn, reach.row, reach.col, reach.n_rows, reach.n_cols, k);
  };
  const Trn before = part(1);
  Burnt burnt = burn(dam, trn);
  out.fault = burnt.fault;
  if (out.fault.kind != DamFault::none) return out;
  out.nodes = std::move(burnt.nodes);
  out.in_cells = earthwork_between(before, part(1));
  for (std::size_t i = 0; i + 1 < dam.crest.size(); ++i) {
    const Vec3 &a = dam.crest[i], &b = dam.crest[i + 1];
    const auto look = [&](double share) {
      const Vec3 at = a + share * (b - a);
      const double loss = at.z() - elevation_at(trn, at.x(), at.y());
      if (loss > out.crest_loss) {
        out.crest_loss = loss;
        out.crest_loss_at = at.head<2>();
      }
    };
    look(0);
    look(1);
    for_each_edge_crossing(trn, a.head<2>(), b.head<2>(), look);
  }
  if (dam.shape.is_gallery) {
    out.designed = out.in_cells;
    return out;
  }
  const double cells = static_cast<double>(reach.n_rows) * reach.n_cols;
  const double wanted = fine_per_crest * trn.cell_size / dam.shape.crest_width;
  const int k = static_cast<int>(std::clamp(
      std::ceil(wanted), 1.0, std::max(1.0, std::floor(std::sqrt(most_fine_nodes / cells)))));
  const Trn ground = part_of(before, 0, 0, before.n_rows, before.n_cols, k);
  Trn fine = ground;
  out.designed =
      burn(dam, fine).fault.kind == DamFault::none ? earthwork_between(ground, fine) : out.in_cells;
  return out;
}

}  // namespace talus
