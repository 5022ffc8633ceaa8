// Water pressure in the joints of a mass at rest, as point loads on its faces.
#include "scene/joint_water.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "blocks/area_clip.hpp"
#include "blocks/block_set.hpp"
#include "contact/scales.hpp"
#include "geometry/face_pressure.hpp"
#include "scene/bond_face.hpp"
#include "scene/bonds.hpp"

namespace talus {
namespace {

using std::size_t;

/// A face that water may be in.
struct JointFace {
  int block_a = 0, block_b = -1;
  JointFill fill = JointFill::surface;
  Vec3 into_a = Vec3::Zero();  ///< unit
  std::vector<Vec3> outline;   ///< [m]
};

JointFill fill_of(const JointWater& water, int origin) {
  if (origin == face_source_side) return water.of_side;
  const bool is_known = origin >= 0 && static_cast<size_t>(origin) < water.of_set.size();
  return is_known ? water.of_set[origin] : JointFill::surface;
}

// A face of two sets is drained where one of them is, else a crack where one of them is.
JointFill fill_of(const JointWater& water, int origin_a, int origin_b) {
  return std::max(fill_of(water, origin_a), fill_of(water, origin_b));
}

void add_faces_of_pairs(const JointWater& water, const Scene& scene,
                        std::vector<JointFace>& faces) {
  for (JointContact& c : closed_faces(scene))
    faces.push_back({c.block_a, c.block_b, fill_of(water, c.joint_set_a, c.joint_set_b), c.normal,
                     std::move(c.outline)});
}

// Whether a face lies on one plane of the ground with all its corners.
bool lies_on_ground(const Scene& scene, const JointFace& face, double gap) {
  const Trn& trn = scene.ground.trn;
  Vec3 middle = Vec3::Zero();
  for (const Vec3& x : face.outline) middle += x / static_cast<double>(face.outline.size());
  if (!contains(trn, middle.x(), middle.y())) return false;
  const TrianglePlane plane = triangle_plane(trn, triangle_at(trn, middle.x(), middle.y()));
  return is_same_face(plane.normal, face.into_a) &&
         std::all_of(face.outline.begin(), face.outline.end(), [&](const Vec3& x) {
           const double above = x.z() - elevation_at(trn, x.x(), x.y());
           return std::abs(above) * plane.normal.z() <= gap;
         });
}

void add_faces_of_ground(const JointWater& water, const Scene& scene,
                         std::vector<JointFace>& faces) {
  const Hulls& hulls = scene.blocks.hulls;
  const double gap = closed_gap(scene);
  for (int p = 0; p < n_parts(hulls); ++p) {
    const int b = hulls.body[p];
    if (is_fixed(scene, b) || !is_released(scene, b)) continue;
    const Pose& pose = scene.blocks.rest[b];
    for (int f = hulls.face_begin[p]; f < hulls.face_begin[p] + hulls.n_faces[p]; ++f) {
      if (hulls.cover[f] == FaceCover::all || hulls.joint_set[f] == face_internal) continue;
      JointFace face;
      face.block_a = b;
      face.fill = fill_of(water, hulls.joint_set[f]);
      face.into_a = pose.attitude * -Vec3(hulls.nx[f], hulls.ny[f], hulls.nz[f]);
      for (int k = hulls.loop_begin[f]; k < hulls.loop_begin[f + 1]; ++k)
        face.outline.push_back(
            place(pose, hulls.vertices[hulls.vertex_begin[p] + hulls.loop_vertices[k]]));
      const bool is_of_source =
          hulls.joint_set[f] == face_failure || hulls.joint_set[f] == face_source_side;
      if (is_of_source || lies_on_ground(scene, face, gap)) faces.push_back(std::move(face));
    }
  }
}

/// The surface of the mass seen from above: faces of blocks on the ground surface, by the cells of
/// the ground that they are over.
struct TopFaces {
  struct Face {
    Vec3 normal;
    std::vector<Vec3> outline;
  };
  const Trn& trn;
  std::vector<Face> faces;
  std::vector<std::vector<int>> of_cell;

  explicit TopFaces(const Scene& scene) : trn(scene.ground.trn) {
    of_cell.resize(static_cast<size_t>(n_triangles(trn)) / 2);
    const Hulls& hulls = scene.blocks.hulls;
    for (int p = 0; p < n_parts(hulls); ++p) {
      const int b = hulls.body[p];
      if (is_fixed(scene, b) || !is_released(scene, b)) continue;
      for (int f = hulls.face_begin[p]; f < hulls.face_begin[p] + hulls.n_faces[p]; ++f)
        if (hulls.joint_set[f] == face_terrain) add(scene, p, f);
    }
  }

  void add(const Scene& scene, int p, int f) {
    const Hulls& hulls = scene.blocks.hulls;
    const Pose& pose = scene.blocks.rest[hulls.body[p]];
    Face face{pose.attitude * Vec3(hulls.nx[f], hulls.ny[f], hulls.nz[f]), {}};
    if (!(face.normal.z() > rounding)) return;
    Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
    for (int k = hulls.loop_begin[f]; k < hulls.loop_begin[f + 1]; ++k) {
      const Vec3 x = place(pose, hulls.vertices[hulls.vertex_begin[p] + hulls.loop_vertices[k]]);
      face.outline.push_back(x);
      low = low.cwiseMin(x), high = high.cwiseMax(x);
    }
    const Cell first = locate(trn, low.x(), high.y()).cell,
               last = locate(trn, high.x(), low.y()).cell;
    for (int row = first.row; row <= last.row; ++row)
      for (int col = first.col; col <= last.col; ++col)
        of_cell[cell_index(row, col)].push_back(static_cast<int>(faces.size()));
    faces.push_back(std::move(face));
  }

  [[nodiscard]] size_t cell_index(int row, int col) const {
    return static_cast<size_t>(row) * static_cast<size_t>(trn.n_cols - 1) +
           static_cast<size_t>(col);
  }

  // By how far a place is outside of a face in plan, <= 0: inside [m].
  static double outside(const Face& face, double x, double y) {
    double farthest = -std::numeric_limits<double>::infinity();
    for (size_t i = 0; i < face.outline.size(); ++i) {
      const Vec3 &from = face.outline[i], &to = face.outline[(i + 1) % face.outline.size()];
      const Vec2 along = (to - from).head<2>().normalized();
      farthest = std::max(farthest, along.y() * (x - from.x()) - along.x() * (y - from.y()));
    }
    return farthest;
  }

  // Of the faces over a place the highest; beside them the nearest in the cell, beyond it the
  // ground [m].
  [[nodiscard]] double elevation(double x, double y) const {
    const Cell cell = locate(trn, x, y).cell;
    double top = elevation_at(trn, x, y), nearest = std::numeric_limits<double>::infinity();
    for (const int f : of_cell[cell_index(cell.row, cell.col)]) {
      const Face& face = faces[static_cast<size_t>(f)];
      const Vec3& on = face.outline[0];
      const double z =
          on.z() - face.normal.head<2>().dot(Vec2(x, y) - on.head<2>()) / face.normal.z();
      const double off = std::max(0.0, outside(face, x, y) - rounding * trn.cell_size);
      if (off > nearest || (off == nearest && z <= top)) continue;
      nearest = off, top = z;
    }
    return top;
  }
};

/// Lowest and highest point of a crack [m].
struct CrackSpan {
  double foot = -std::numeric_limits<double>::infinity();
  double top = std::numeric_limits<double>::infinity();

  [[nodiscard]] double level(double fill) const { return std::min(foot + fill, top); }
};

CrackSpan span_of(const std::vector<Vec3>& outline) {
  const auto [low, high] = std::ranges::minmax(outline, {}, [](const Vec3& x) { return x.z(); });
  return {low.z(), high.z()};
}

CrackSpan united(const CrackSpan& a, const CrackSpan& b) {
  return {std::min(a.foot, b.foot), std::max(a.top, b.top)};
}

// Of the crack of each face: of all faces of cracks in its plane. No bounds where it is in none.
std::vector<CrackSpan> spans_of(const std::vector<JointFace>& faces, double gap) {
  std::vector<CrackSpan> own(faces.size()), spans(faces.size());
  const auto is_crack = [&](size_t i) { return faces[i].fill == JointFill::crack; };
  for (size_t i = 0; i < faces.size(); ++i) {
    if (!is_crack(i)) continue;
    spans[i] = own[i] = span_of(faces[i].outline);
  }
  for (size_t i = 0; i < faces.size(); ++i)
    for (size_t k = 0; k < faces.size() && is_crack(i); ++k) {
      if (!is_crack(k)) continue;
      const Vec3 &n = faces[i].into_a, &other = faces[k].into_a;
      if (!is_same_face(n, other) && !is_same_face(n, -other)) continue;
      if (std::abs(n.dot(faces[k].outline[0] - faces[i].outline[0])) > gap) continue;
      spans[i] = united(spans[i], own[k]);
    }
  return spans;
}

double area_of(const std::vector<Vec3>& outline) {
  Vec3 twice = Vec3::Zero();
  for (size_t i = 2; i < outline.size(); ++i)
    twice += (outline[i - 1] - outline[0]).cross(outline[i] - outline[0]);
  return twice.norm() / 2;
}

void add_wet_face(const JointFace& face, const FacePressure& pressure, Scene& scene) {
  const int n = static_cast<int>(scene.wet_faces.size());
  const Vec3 at = pressure.centre(), force = pressure.force * face.into_a;
  const auto body_point = [&](int b) -> Vec3 {
    const Pose& pose = scene.blocks.rest[b];
    return pose.attitude.conjugate() * (at - pose.position);
  };
  WetFace wet;
  wet.block_a = face.block_a;
  wet.block_b = face.block_b;
  wet.point_a = body_point(face.block_a);
  wet.point_b = face.block_b < 0 ? at : body_point(face.block_b);
  wet.normal = scene.blocks.rest[face.block_a].attitude.conjugate() * face.into_a;
  wet.force = pressure.force;
  wet.extent = 2 * std::sqrt(area_of(face.outline) / std::numbers::pi);
  scene.loads.push_back({wet.block_a, wet.point_a, force, n});
  if (wet.block_b >= 0) scene.loads.push_back({wet.block_b, wet.point_b, -force, n});
  scene.wet_faces.push_back(wet);
}

/// The faces that water may be in, and how high it stands there.
struct WetJoints {
  const JointWater& water;
  std::vector<JointFace> faces;  ///< by block
  std::vector<CrackSpan> cracks;
  Trn surface;  ///< piezometric
  TopFaces tops;

  WetJoints(const JointWater& of, const Scene& scene)
      : water(of), surface(scene.ground.trn), tops(scene) {
    add_faces_of_pairs(water, scene, faces);
    add_faces_of_ground(water, scene, faces);
    std::erase_if(faces, [](const JointFace& face) { return face.fill == JointFill::drained; });
    std::stable_sort(faces.begin(), faces.end(), [](const JointFace& one, const JointFace& other) {
      return one.block_a < other.block_a;
    });
    if (!water.surface.empty()) surface.elevation = water.surface;
    // cut rock puts the corners of one plane where blocks were merged, not exactly on it
    cracks = spans_of(faces, 100 * closed_gap(scene));
  }

  // z of the water over a place of face i, NaN: none; a crack may run over [m]
  [[nodiscard]] double level(size_t i, const Vec3& x) const {
    if (faces[i].fill == JointFill::crack) return cracks[i].foot + water.crack_fill;
    return water.surface.empty() ? tops.elevation(x.x(), x.y()) - water.depth
                                 : elevation_at(surface, x.x(), x.y());
  }
};

// The wall of a mass along a side, in pieces no longer than a cell; those without rock left out.
std::vector<std::vector<Vec3>> wall_of(const Trn& ground, const Trn& bed, const AreaSide& side) {
  std::vector<std::vector<Vec3>> pieces;
  const int n = static_cast<int>(std::ceil(side.length / ground.cell_size));
  const auto at = [&](const Trn& trn, int k) -> Vec3 {
    const Vec2 p = side.start + k * side.length / n * side.direction;
    return {p.x(), p.y(), elevation_at(trn, p.x(), p.y())};
  };
  for (int k = 0; k < n; ++k) {
    const std::vector<Vec3> piece = {at(bed, k), at(bed, k + 1), at(ground, k + 1), at(ground, k)};
    if (piece[2].z() > piece[1].z() || piece[3].z() > piece[0].z()) pieces.push_back(piece);
  }
  return pieces;
}

}  // namespace

Vec3 water_on_mass(const JointWater& water, const Trn& ground, const Trn& bed, const Area& area) {
  Trn surface = ground;
  if (!water.surface.empty()) surface.elevation = water.surface;
  const double below = water.surface.empty() ? water.depth : 0;
  Vec3 sum = Vec3::Zero();
  const auto add = [&](const std::vector<Vec3>& outline, const Vec3& inward, double level) {
    const auto pressure_at = [&](const Vec3& x) {
      const double z = std::isnan(level) ? elevation_at(surface, x.x(), x.y()) - below : level;
      return std::isnan(z) ? 0 : water.unit_weight * (z - x.z());
    };
    sum += pressure_on(outline, ground.cell_size, pressure_at).force * inward;
  };
  constexpr double by_surface = std::numeric_limits<double>::quiet_NaN();
  for (const TriangleInArea& one : triangles_in(ground, area)) {
    if (!is_known(ground, one.triangle) ||
        triangle_corners(ground, one.triangle) == triangle_corners(bed, one.triangle))
      continue;
    const TrianglePlane plane = triangle_plane(bed, one.triangle);
    for (const std::vector<Vec2>& piece : one.pieces) {
      std::vector<Vec3> outline;
      for (const Vec2& p : piece)
        outline.emplace_back(p.x(), p.y(), elevation_at(bed, p.x(), p.y()));
      add(outline, plane.normal, by_surface);
    }
  }
  if (water.of_side == JointFill::drained) return sum;
  for (const AreaSide& side : sides_of(area)) {
    const std::vector<std::vector<Vec3>> wall = wall_of(ground, bed, side);
    if (wall.empty()) continue;
    CrackSpan span = span_of(wall[0]);
    for (const std::vector<Vec3>& piece : wall) span = united(span, span_of(piece));
    const double level =
        water.of_side == JointFill::crack ? span.level(water.crack_fill) : by_surface;
    for (const std::vector<Vec3>& piece : wall) add(piece, -side.plane.normal, level);
  }
  return sum;
}

void add_joint_water(const JointWater& water, Scene& scene) {
  const WetJoints joints(water, scene);
  for (size_t i = 0; i < joints.faces.size(); ++i) {
    const JointFace& face = joints.faces[i];
    const auto pressure_at = [&](const Vec3& x) {
      const double level = std::min(joints.level(i, x), joints.cracks[i].top);
      return std::isnan(level) ? 0 : water.unit_weight * (level - x.z());
    };
    const double resolution = face.fill == JointFill::crack
                                  ? std::numeric_limits<double>::infinity()
                                  : joints.surface.cell_size;
    const FacePressure pressure = pressure_on(face.outline, resolution, pressure_at);
    if (pressure.force > 0) add_wet_face(face, pressure, scene);
  }
  std::stable_sort(scene.loads.begin(), scene.loads.end(),
                   [](const PointLoad& a, const PointLoad& b) { return a.block < b.block; });
}

WaterRange water_range(const JointWater& water, const Scene& scene) {
  const WetJoints joints(water, scene);
  constexpr double no_limit = std::numeric_limits<double>::infinity();
  WaterRange range{no_limit, -no_limit};
  for (size_t i = 0; i < joints.faces.size(); ++i)
    for (const Vec3& x : joints.faces[i].outline) {
      const double rise = x.z() - joints.level(i, x);
      if (std::isnan(rise)) continue;
      range = {std::min(range.dry, rise), std::max(range.full, rise)};
    }
  return range.dry <= range.full ? range : WaterRange{};
}

}  // namespace talus
