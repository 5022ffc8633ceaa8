// blocks/cut.hpp with CGAL: columns of the mass, cut joint by joint into convex cells.
#include <CGAL/Cell_attribute.h>
#include <CGAL/Cell_attribute_with_point.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Linear_cell_complex_for_combinatorial_map.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <unordered_map>

#include "blocks/area_clip.hpp"
#include "blocks/cut.hpp"
#include "blocks/joint_cell_tree.hpp"

namespace talus {
namespace {

// Memory of a vertex: the plane that it was last compared with, and its side of it.
struct VertexInfo {
  int joint = -1;   // or n_joints + side of the outline
  double side = 0;  // signed distance, exactly 0 on the joint [m]
  int index = -1;   // in the finished complex
};

struct Items {
  template <class Map>
  struct Dart_wrapper {
    using Dart_info = int;  // number in the finished complex
    using Vertex = CGAL::Cell_attribute_with_point<Map, VertexInfo>;
    using Face = CGAL::Cell_attribute<Map, int>;  // CutFace or joint
    using Attributes = std::tuple<Vertex, void, Face>;
  };
};
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Lcc = CGAL::Linear_cell_complex_for_combinatorial_map<
    3, 3, CGAL::Linear_cell_complex_traits<3, Kernel>, Items>;
using Dart = Lcc::Dart_handle;

Vec3 point_of(const Lcc& lcc, Dart d) {
  const auto& p = lcc.point(d);
  return {p.x(), p.y(), p.z()};
}

// A cell during the cutting: a dart of it and its box.
struct Piece {
  Dart dart;
  Vec3 low, high;
};
using Leaf = JointCell<Piece>;

// --- the mass as sewn columns ------------------------------------------------------------------

// Builds one column after the other and sews its walls to those of earlier columns.
class ColumnBuilder {
 public:
  ColumnBuilder(Lcc& lcc, const Trn& ground, const Trn& bed, double thin)
      : lcc_(lcc), ground_(ground), bed_(bed), thin_(thin) {}

  void add_triangle(int triangle, std::vector<Piece>& pieces) {
    const Cell cell = cell_of_triangle(ground_, triangle);
    const int r = cell.row, c = cell.col;
    const std::array<std::size_t, 3> nodes =
        triangle % 2 == 0 ? std::array{node(r, c), node(r + 1, c), node(r + 1, c + 1)}
                          : std::array{node(r, c), node(r + 1, c + 1), node(r, c + 1)};
    std::array<bool, 3> is_thick{};
    for (int k = 0; k < 3; ++k) {
      const double depth = ground_.elevation[nodes[k]] - bed_.elevation[nodes[k]];
      is_thick[k] = depth > thin_;
      if (std::isnan(depth)) return;
    }
    if (!is_thick[0] && !is_thick[1] && !is_thick[2]) return;
    const auto corners = triangle_corners(ground_, triangle);
    Column column{nodes, corners, is_thick, {}};
    add_faces(column);
    link_faces(column);
    Piece piece{column.loops[0].darts[0], corners[0], corners[0]};
    for (int k = 0; k < 3; ++k)
      for (const double z : {corners[k].z(), bed_.elevation[nodes[k]]}) {
        const Vec3 p(corners[k].x(), corners[k].y(), z);
        piece.low = piece.low.cwiseMin(p);
        piece.high = piece.high.cwiseMax(p);
      }
    pieces.push_back(piece);
  }

 private:
  // A vertex is a node above (2 n) or below (2 n + 1); where the mass has no thickness both are
  // one.
  struct Loop {
    std::vector<std::size_t> keys;
    std::vector<Dart> darts;
    int made_by;
  };
  struct Column {
    std::array<std::size_t, 3> nodes;
    std::array<Vec3, 3> corners;
    std::array<bool, 3> is_thick;
    std::vector<Loop> loops;
  };

  std::size_t node(int r, int c) const { return node_index(ground_, r, c); }

  // Top, bottom and up to three walls, counter-clockwise from outside.
  void add_faces(Column& column) {
    const auto top = [&](int k) { return 2 * column.nodes[k]; };
    const auto low = [&](int k) { return 2 * column.nodes[k] + (column.is_thick[k] ? 1 : 0); };
    add_loop(column, {top(0), top(1), top(2)}, cut_terrain);
    add_loop(column, {low(0), low(2), low(1)}, cut_failure);
    for (int k = 0; k < 3; ++k) {
      const int next = (k + 1) % 3;
      std::vector<std::size_t> wall = {low(k), low(next)};
      if (column.is_thick[next]) wall.push_back(top(next));
      if (column.is_thick[k]) wall.push_back(top(k));
      if (wall.size() > 2) add_loop(column, wall, cut_wall);
    }
  }

  void add_loop(Column& column, std::vector<std::size_t> keys, int made_by) {
    Loop loop{std::move(keys), {}, made_by};
    const Dart first = lcc_.make_combinatorial_polygon(static_cast<unsigned>(loop.keys.size()));
    const auto face = lcc_.create_attribute<2>(made_by);
    Dart d = first;
    for (std::size_t k = 0; k < loop.keys.size(); ++k, d = lcc_.beta(d, 1)) loop.darts.push_back(d);
    lcc_.set_attribute<2>(first, face);
    column.loops.push_back(std::move(loop));
  }

  Lcc::Point position(std::size_t key) const {
    const int n = static_cast<int>(key / 2);
    const Vec3 p = node_point(ground_, n / ground_.n_cols, n % ground_.n_cols);
    return {p.x(), p.y(), key % 2 ? bed_.elevation[key / 2] : p.z()};
  }

  // Joins the faces of the column along their edges, sets its points and sews its walls.
  void link_faces(Column& column) {
    std::map<std::pair<std::size_t, std::size_t>, Dart> waiting;
    for (const Loop& loop : column.loops)
      for (std::size_t k = 0; k < loop.keys.size(); ++k) {
        const std::size_t from = loop.keys[k], to = loop.keys[(k + 1) % loop.keys.size()];
        const auto other = waiting.find({to, from});
        if (other != waiting.end())
          lcc_.link_beta<2>(loop.darts[k], other->second);
        else
          waiting.emplace(std::pair{from, to}, loop.darts[k]);
      }
    for (const Loop& loop : column.loops)
      for (std::size_t k = 0; k < loop.keys.size(); ++k)
        if (lcc_.attribute<0>(loop.darts[k]) == Lcc::null_handle)
          lcc_.set_vertex_attribute(loop.darts[k],
                                    lcc_.create_vertex_attribute(position(loop.keys[k])));
    for (const Loop& loop : column.loops)
      if (loop.made_by == cut_wall) sew_wall(loop);
  }

  // The neighbour column runs around the same wall in the opposite sense.
  void sew_wall(const Loop& loop) {
    for (std::size_t k = 0; k < loop.keys.size(); ++k) {
      const std::size_t from = loop.keys[k], to = loop.keys[(k + 1) % loop.keys.size()];
      const auto other = open_walls_.find({to, from});
      if (other == open_walls_.end()) continue;
      lcc_.sew<3>(loop.darts[k], other->second);
      open_walls_.erase(other);
      return;
    }
    // The edge at the bottom names the wall: no other wall has it.
    open_walls_.emplace(std::pair{loop.keys[0], loop.keys[1]}, loop.darts[0]);
  }

  Lcc& lcc_;
  const Trn& ground_;
  const Trn& bed_;
  double thin_;
  std::map<std::pair<std::size_t, std::size_t>, Dart> open_walls_;
};

// --- cutting -----------------------------------------------------------------------------------

// Plane j is that of joint j, or of side j - n_joints of the outline.
class Cutter {
 public:
  Cutter(Lcc& lcc, const std::vector<Joint>& joints, const std::vector<AreaSide>& sides,
         double tolerance, double side_tolerance)
      : lcc_(lcc),
        joints_(joints),
        sides_(sides),
        tolerance_(tolerance),
        side_tolerance_(side_tolerance) {}

  int n_uncut = 0;

  // Which sides of joint j the piece reaches: bit 1 inside, bit 2 outside.
  int sides_of(const Piece& piece, int j) {
    const Plane& plane = plane_of(j);
    const Vec3 middle = (piece.low + piece.high) / 2;
    const double reach = plane.normal.cwiseAbs().dot(piece.high - piece.low) / 2;
    const double at = distance(plane, middle);
    // Far from the joint: the box says it. Nearer, the vertices do, and are remembered.
    if (at > reach + tolerance_of(j)) return 2;
    if (at < -reach - tolerance_of(j)) return 1;
    int sides = 0;
    for (auto it = lcc_.darts_of_orbit<1, 2>(piece.dart).begin(),
              end = lcc_.darts_of_orbit<1, 2>(piece.dart).end();
         it != end; ++it) {
      const double side = side_of(it, j);
      if (side < 0) sides |= 1;
      if (side > 0) sides |= 2;
    }
    return sides;
  }

  // Faces of the piece that lie on the joint become the joint's; two columns do not hang together
  // through them any more.
  void mark_faces_on(const Piece& piece, int j) {
    for_each_wall_on(piece, j, [&](Dart face) { lcc_.info<2>(face) = j; });
  }

  // Whether rock on the other side of joint j hangs on to the piece through a wall on the joint.
  bool has_wall_on(const Piece& piece, int j) {
    bool found = false;
    for_each_wall_on(piece, j, [&](Dart) { found = true; });
    return found;
  }

  // Whether the discs of joint j cover its section through the piece.
  bool is_covered(const Piece& piece, int j) {
    const std::vector<Vec3> section = section_of(piece, j);
    return std::any_of(joints_[j].discs.begin(), joints_[j].discs.end(), [&](const Disc& disc) {
      return std::all_of(section.begin(), section.end(), [&](const Vec3& p) {
        return (p - disc.centre).squaredNorm() <= disc.radius * disc.radius;
      });
    });
  }

  // The parts of a column of the mass inside the area; the rest is taken out of the complex.
  std::vector<Piece> trimmed(const Piece& column, const std::vector<int>& sides, const Area& area) {
    std::vector<Piece> parts = {column};
    for (const int s : sides) {
      const int j = static_cast<int>(joints_.size()) + s;
      for (size_t k = parts.size(); k-- > 0;) {
        if (sides_of(parts[k], j) != 3 || !is_crossed_by_side(parts[k], j)) continue;
        Piece inner, outer;
        if (!cut(parts[k], j, inner, outer)) continue;
        parts[k] = inner;
        parts.push_back(outer);
      }
    }
    std::erase_if(parts, [&](const Piece& part) {
      const bool is_outside = !contains(area, middle_of(part).template head<2>());
      if (is_outside) lcc_.remove_cell<3>(part.dart);
      return is_outside;
    });
    return parts;
  }

  // Cuts the piece, which reaches both sides of plane j; false when it could not be done.
  bool cut(const Piece& piece, int j, Piece& inner, Piece& outer) {
    split_edges(piece, j);
    split_faces(piece, j);
    const Dart start = find_rim(piece, j);
    if (start == Lcc::null_handle) return ++n_uncut, false;
    std::vector<Dart> rim;
    Dart d = start;
    do {
      rim.push_back(d);
      d = next_on_rim(d, j);
    } while (d != start && rim.size() < 100000);
    if (d != start || static_cast<int>(rim.size()) != n_rim_ || rim.size() < 3)
      return ++n_uncut, false;
    const Dart outside = lcc_.beta(start, 2);
    const Dart face = lcc_.insert_cell_2_in_cell_3(rim.begin(), rim.end());
    lcc_.set_attribute<2>(face, lcc_.create_attribute<2>(is_side(j) ? int{cut_wall} : j));
    inner = piece_of(start);
    outer = piece_of(outside);
    return true;
  }

 private:
  bool is_side(int j) const { return j >= static_cast<int>(joints_.size()); }
  const AreaSide& area_side(int j) const { return sides_[static_cast<size_t>(j) - joints_.size()]; }
  const Plane& plane_of(int j) const { return is_side(j) ? area_side(j).plane : joints_[j].plane; }
  double tolerance_of(int j) const { return is_side(j) ? side_tolerance_ : tolerance_; }

  // Points of the plane's section through the piece, its corners among them.
  std::vector<Vec3> section_of(const Piece& piece, int j) {
    std::vector<Vec3> section;
    for (auto it = lcc_.darts_of_orbit<1, 2>(piece.dart).begin(),
              end = lcc_.darts_of_orbit<1, 2>(piece.dart).end();
         it != end; ++it) {
      const Dart next = lcc_.beta(it, 1);
      const double a = side_of(it, j), b = side_of(next, j);
      if (a == 0) section.push_back(point_of(lcc_, it));
      if (a < 0 && b > 0) section.push_back(crossing(it, next));
    }
    return section;
  }

  bool is_crossed_by_side(const Piece& piece, int j) {
    SideRange range;
    for (const Vec3& p : section_of(piece, j)) include(range, area_side(j), p.head<2>());
    return runs_through(area_side(j), range, side_tolerance_);
  }

  Vec3 middle_of(const Piece& piece) {
    Vec3 sum = Vec3::Zero();
    int n = 0;
    for (auto it = lcc_.one_dart_per_incident_cell<0, 3, 2>(piece.dart).begin(),
              end = lcc_.one_dart_per_incident_cell<0, 3, 2>(piece.dart).end();
         it != end; ++it, ++n)
      sum += point_of(lcc_, it);
    return sum / n;
  }

  double side_of(Dart d, int j) {
    VertexInfo& info = lcc_.info<0>(d);
    if (info.joint != j) {
      info.joint = j;
      info.side = distance(plane_of(j), point_of(lcc_, d));
      if (std::abs(info.side) <= tolerance_of(j)) info.side = 0;
    }
    return info.side;
  }

  // Side of a whole face: -1, 1, 0 when on the joint, 2 when it still reaches both sides.
  int face_side(Dart face, int j) {
    bool inside = false, outside = false;
    Dart d = face;
    do {
      const double side = side_of(d, j);
      inside |= side < 0;
      outside |= side > 0;
      d = lcc_.beta(d, 1);
    } while (d != face);
    if (inside && outside) return 2;
    return inside ? -1 : outside ? 1 : 0;
  }

  template <class Visit>
  void for_each_wall_on(const Piece& piece, int j, Visit visit) {
    if (!touches(piece, j)) return;
    for (auto it = lcc_.one_dart_per_incident_cell<2, 3, 2>(piece.dart).begin(),
              end = lcc_.one_dart_per_incident_cell<2, 3, 2>(piece.dart).end();
         it != end; ++it)
      if (lcc_.info<2>(it) == cut_wall && face_side(it, j) == 0) visit(it);
  }

  bool touches(const Piece& piece, int j) const {
    const Plane& plane = joints_[j].plane;
    const double reach = plane.normal.cwiseAbs().dot(piece.high - piece.low) / 2;
    return std::abs(distance(plane, (piece.low + piece.high) / 2)) <= reach + tolerance_;
  }

  Vec3 crossing(Dart from, Dart to) {
    const double a = lcc_.info<0>(from).side, b = lcc_.info<0>(to).side;
    const Vec3 p = point_of(lcc_, from);
    return p + a / (a - b) * (point_of(lcc_, to) - p);
  }

  void split_edges(const Piece& piece, int j) {
    std::vector<Dart> crossing_edges;
    for (auto it = lcc_.darts_of_orbit<1, 2>(piece.dart).begin(),
              end = lcc_.darts_of_orbit<1, 2>(piece.dart).end();
         it != end; ++it)
      if (side_of(it, j) < 0 && side_of(lcc_.beta(it, 1), j) > 0) crossing_edges.push_back(it);
    for (const Dart d : crossing_edges) {
      const Vec3 p = crossing(d, lcc_.beta(d, 1));
      const Dart added = lcc_.insert_point_in_cell<1>(d, {p.x(), p.y(), p.z()});
      lcc_.info<0>(added) = {j, 0, -1};
    }
  }

  // A convex face that reaches both sides has two vertices on the joint, one where its outside
  // begins and one where it ends.
  void split_faces(const Piece& piece, int j) {
    std::vector<Dart> faces;
    for (auto it = lcc_.one_dart_per_incident_cell<2, 3, 2>(piece.dart).begin(),
              end = lcc_.one_dart_per_incident_cell<2, 3, 2>(piece.dart).end();
         it != end; ++it)
      if (face_side(it, j) == 2) faces.push_back(it);
    for (const Dart face : faces) {
      Dart leaving = Lcc::null_handle, entering = Lcc::null_handle;
      int n_changes = 0;
      Dart d = face;
      do {
        const double before = side_of(lcc_.beta(d, 0), j), after = side_of(lcc_.beta(d, 1), j);
        if (side_of(d, j) == 0 && before < 0 && after >= 0) leaving = d, ++n_changes;
        if (side_of(d, j) == 0 && before >= 0 && after < 0) entering = d, ++n_changes;
        d = lcc_.beta(d, 1);
      } while (d != face);
      if (n_changes == 2 && leaving != Lcc::null_handle && entering != Lcc::null_handle)
        lcc_.insert_cell_1_in_cell_2(leaving, entering);
    }
  }

  // The rim of the new face: darts of inner faces whose twin belongs to an outer face.
  bool is_on_rim(Dart d, int j) {
    return face_side(d, j) == -1 && face_side(lcc_.beta(d, 2), j) != -1;
  }

  // A dart of the rim; counts them all. Null when a face still reaches both sides.
  Dart find_rim(const Piece& piece, int j) {
    Dart found = Lcc::null_handle;
    n_rim_ = 0;
    for (auto it = lcc_.darts_of_orbit<1, 2>(piece.dart).begin(),
              end = lcc_.darts_of_orbit<1, 2>(piece.dart).end();
         it != end; ++it) {
      if (side_of(it, j) != 0 || side_of(lcc_.beta(it, 1), j) != 0) continue;
      const int side = face_side(it, j);
      if (side == 2) return Lcc::null_handle;
      if (side == -1 && face_side(lcc_.beta(it, 2), j) != -1) found = it, ++n_rim_;
    }
    return found;
  }

  Dart next_on_rim(Dart d, int j) {
    Dart next = lcc_.beta(d, 1);
    for (int turn = 0; turn < 1000 && !is_on_rim(next, j); ++turn)
      next = lcc_.beta(lcc_.beta(next, 2), 1);
    return next;
  }

  Piece piece_of(Dart dart) {
    Piece piece{dart, point_of(lcc_, dart), point_of(lcc_, dart)};
    for (auto it = lcc_.darts_of_orbit<1, 2>(dart).begin(),
              end = lcc_.darts_of_orbit<1, 2>(dart).end();
         it != end; ++it) {
      const Vec3 p = point_of(lcc_, it);
      piece.low = piece.low.cwiseMin(p);
      piece.high = piece.high.cwiseMax(p);
    }
    return piece;
  }

  Lcc& lcc_;
  const std::vector<Joint>& joints_;
  const std::vector<AreaSide>& sides_;
  double tolerance_, side_tolerance_;
  int n_rim_ = 0;
};

// --- the mass inside its outline ---------------------------------------------------------------

// Triangles with rock over the bed; without rings in `area` no side cuts them.
std::vector<TriangleInArea> triangles_of_mass(const Trn& ground, const Trn& bed, const Area& area) {
  std::vector<TriangleInArea> triangles;
  if (area.rings.empty())
    for (int t = 0; t < n_triangles(ground); ++t) triangles.push_back({t, {}, {}});
  else
    triangles = triangles_in(ground, area);
  std::erase_if(triangles, [&](const TriangleInArea& one) {
    return !is_known(ground, one.triangle) ||
           triangle_corners(ground, one.triangle) == triangle_corners(bed, one.triangle);
  });
  return triangles;
}

// All columns are sewn before the first is trimmed: walls match while they are whole.
std::vector<Piece> columns_in(Lcc& lcc, const Trn& ground, const Trn& bed,
                              const std::vector<TriangleInArea>& triangles, const Area& area,
                              Cutter& cutter, double thin) {
  ColumnBuilder builder(lcc, ground, bed, thin);
  std::vector<Piece> columns;
  std::vector<const TriangleInArea*> made_for;
  for (const TriangleInArea& one : triangles) {
    builder.add_triangle(one.triangle, columns);
    made_for.resize(columns.size(), &one);
  }
  std::vector<Piece> pieces;
  for (size_t k = 0; k < columns.size(); ++k) {
    if (made_for[k]->sides.empty())
      pieces.push_back(columns[k]);
    else
      for (const Piece& part : cutter.trimmed(columns[k], made_for[k]->sides, area))
        pieces.push_back(part);
  }
  for (auto it = lcc.darts().begin(), end = lcc.darts().end(); it != end; ++it)
    if (lcc.is_free<3>(it) && lcc.info<2>(it) == cut_wall) lcc.info<2>(it) = cut_side;
  return pieces;
}

// --- export ------------------------------------------------------------------------------------

// Numbers the darts of one piece face by face.
void number_piece(Lcc& lcc, const Piece& piece, int leaf, CellComplex& out) {
  const int cell = static_cast<int>(out.cell_leaf.size());
  out.cell_leaf.push_back(leaf);
  std::vector<Dart> open = {piece.dart};
  while (!open.empty()) {
    const Dart start = open.back();
    open.pop_back();
    if (lcc.info(start) >= 0) continue;
    const int face = static_cast<int>(out.face_dart.size());
    const int first = static_cast<int>(out.dart_vertex.size());
    out.face_dart.push_back(first);
    out.face_made_by.push_back(lcc.info<2>(start));
    out.face_cell.push_back(cell);
    Dart d = start;
    do {
      VertexInfo& vertex = lcc.info<0>(d);
      if (vertex.index < 0) {
        vertex.index = static_cast<int>(out.vertices.size());
        out.vertices.push_back(point_of(lcc, d));
      }
      lcc.info(d) = static_cast<int>(out.dart_vertex.size());
      out.dart_vertex.push_back(vertex.index);
      out.dart_next.push_back(lcc.info(d) + 1);
      out.dart_face.push_back(face);
      open.push_back(lcc.beta(d, 2));
      d = lcc.beta(d, 1);
    } while (d != start);
    out.dart_next.back() = first;
  }
}

CellComplex exported(Lcc& lcc, std::vector<Leaf>& leaves, int n_uncut) {
  CellComplex out;
  out.n_uncut = n_uncut;
  for (auto it = lcc.darts().begin(), end = lcc.darts().end(); it != end; ++it) lcc.info(it) = -1;
  for (Leaf& leaf : leaves) {
    for (const Piece& piece : leaf.pieces)
      number_piece(lcc, piece, static_cast<int>(out.leaves.size()), out);
    out.leaves.push_back(std::move(leaf.body));
    out.leaf_joint_cell.push_back(leaf.joint_cell);
  }
  out.dart_twin.assign(out.dart_vertex.size(), -1);
  out.dart_opposite.assign(out.dart_vertex.size(), -1);
  for (auto it = lcc.darts().begin(), end = lcc.darts().end(); it != end; ++it) {
    out.dart_twin[lcc.info(it)] = lcc.info(lcc.beta(it, 2));
    if (!lcc.is_free<3>(it)) out.dart_opposite[lcc.info(it)] = lcc.info(lcc.beta(it, 3));
  }
  return out;
}

}  // namespace

CellComplex cut_mass(const Trn& ground, const Trn& bed, const Area& outline,
                     const std::vector<Joint>& joints, const ProgressFunction& progress) {
  const Area area = snapped(ground, outline);
  const std::vector<TriangleInArea> triangles = triangles_of_mass(ground, bed, area);
  if (triangles.empty()) return {};
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const TriangleInArea& one : triangles)
    for (const Trn* trn : {&ground, &bed})
      for (const Vec3& p : triangle_corners(*trn, one.triangle))
        low = low.cwiseMin(p), high = high.cwiseMax(p);
  const double diagonal = (high - low).norm();
  const double tolerance = 1e-8 * diagonal;

  Lcc lcc;
  const std::vector<AreaSide> sides = sides_of(area);
  Cutter cutter(lcc, joints, sides, tolerance, area.rings.empty() ? 0 : side_tolerance(area));
  Leaf root;
  root.pieces = columns_in(lcc, ground, bed, triangles, area, cutter, tolerance);
  // The joint cells reach above the ground, where blocks made convex may need the room.
  const Vec3 room = Vec3::Constant(0.05 * diagonal);
  root.body = box(low - room, high + room, cut_wall);
  // Through-going joints come first in the list of candidates.
  for (const bool is_through : {true, false})
    for (int j = 0; j < static_cast<int>(joints.size()); ++j)
      if (joints[j].is_through == is_through) root.candidates.push_back(j);
  root.sides.resize(sides.size());
  std::iota(root.sides.begin(), root.sides.end(), 0);

  std::vector<Leaf> leaves;
  JointCellTree<Piece, Cutter>(cutter, joints, sides, tolerance, progress)
      .grow(std::move(root), leaves);
  return exported(lcc, leaves, cutter.n_uncut);
}

}  // namespace talus
