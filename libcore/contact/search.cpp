// Finds all contacts of a block with the ground at a pose: modes 1, 2 and 3 of Fig. 7.
#include "contact/search.hpp"

#include <algorithm>
#include <cmath>

#include "contact/ground_features.hpp"

namespace talus {
namespace {

using std::size_t;

/// A triangle, and across which of its edges the next one lies.
struct Neighbour {
  int d_row, d_col, odd;       // cell offset and which triangle of that cell
  int corner_row, corner_col;  // corner of the own triangle opposite to the shared edge
};
// Lower left: west, south, diagonal. Upper right: north, east, diagonal.
constexpr Neighbour neighbours[2][3] = {{{0, -1, 1, 1, 1}, {1, 0, 1, 0, 0}, {0, 0, 1, 1, 0}},
                                        {{-1, 0, 0, 1, 1}, {0, 1, 0, 0, 0}, {0, 0, 0, 0, 1}}};

// Signed distance from a plane. Component by component: as an expression of vectors the plane would
// go through memory in pieces that do not fit, which stalls.
double distance_above(const TrianglePlane& plane, const Vec3& x) {
  return plane.normal.x() * (x.x() - plane.point.x()) +
         plane.normal.y() * (x.y() - plane.point.y()) +
         plane.normal.z() * (x.z() - plane.point.z());
}

void add_plane(const TrianglePlane& plane, const Ground& ground, int triangle, int b, int v,
               const Vec3& X, const Vec3& x, double gap, std::vector<Contact>& contacts) {
  contacts.push_back({{ContactMode::vertex_face, -1, v, -1},
                      b,
                      class_of(ground, triangle),
                      plane.normal,
                      X,
                      x - gap * plane.normal,
                      gap});
}

// The planes on the other side of valley lines near the vertex. There the ground is the higher of
// the two planes, so both half-spaces hold; at a ridge or a flat edge only the own plane does.
void add_valley_planes(const Ground& ground, const GridPoint& at, const TrianglePlane& own, int b,
                       int v, const Vec3& X, const Vec3& x, double margin, double near_cells,
                       std::vector<Contact>& contacts) {
  const Trn& trn = ground.trn;
  const bool odd = is_upper(at);
  const double distance[3] = {odd ? at.south : at.east, 1 - (odd ? at.east : at.south),
                              std::abs(at.south - at.east) * 0.7071};
  if (std::min({distance[0], distance[1], distance[2]}) > near_cells) return;
  for (int k = 0; k < 3; ++k) {
    if (distance[k] > near_cells) continue;
    const Neighbour& n = neighbours[odd][k];
    const Cell cell{at.cell.row + n.d_row, at.cell.col + n.d_col};
    if (cell.row < 0 || cell.col < 0 || cell.row > trn.n_rows - 2 || cell.col > trn.n_cols - 2)
      continue;
    const int triangle = first_triangle(trn, cell) + n.odd;
    const TrianglePlane plane = triangle_plane(trn, triangle);
    const Vec3 corner = node_point(trn, at.cell.row + n.corner_row, at.cell.col + n.corner_col);
    const double above = distance_above(plane, corner);
    if (!(above > 1e-9 * trn.cell_size)) continue;  // flat or a ridge
    if (own.normal.dot(plane.normal) > 1 - 1e-12) continue;
    const double gap = distance_above(plane, x);
    if (gap < margin) add_plane(plane, ground, triangle, b, v, X, x, gap, contacts);
  }
}

// Whether the gap of a point at `height` above ground of this gradient is above `margin` for sure,
// told without a root: the gap is the height over sqrt(1 + gradient^2).
bool is_far_above(double height, const Vec2& gradient, double margin) {
  return height > 0 && height * height > 1.0001 * margin * margin * (1 + gradient.squaredNorm());
}

// Whether a vertex lies beyond the known ground.
bool leans_out(const Trn& trn, const std::vector<Vec3>& vertices) {
  return std::any_of(vertices.begin(), vertices.end(),
                     [&](const Vec3& x) { return std::isnan(elevation_at(trn, x.x(), x.y())); });
}

void find_mode_1(const Ground& ground, const Shapes& shapes, int b, double highest, double margin,
                 const std::vector<Vec3>& vertices, std::vector<Contact>& contacts) {
  const std::span<const Vec3> body = vertices_of(shapes, b);
  const Trn& trn = ground.trn;
  const double cells_per_gap = 4 / trn.cell_size;
  for (size_t v = 0; v < vertices.size(); ++v) {
    const Vec3& x = vertices[v];
    if (x.z() > highest + margin) continue;
    const GridPoint at = locate(trn, x.x(), x.y());
    const Vec2 gradient = triangle_gradient(trn, at.cell, is_upper(at));
    if (is_far_above(x.z() - elevation_at(trn, at), gradient, margin)) continue;
    const TrianglePlane plane = plane_of(node_point(trn, at.cell.row, at.cell.col), gradient);
    const double gap = distance_above(plane, x);
    if (!(gap < margin)) continue;  // also when the triangle is not ground
    const int id = static_cast<int>(v);
    add_plane(plane, ground, triangle_of(trn, at), b, id, body[v], x, gap, contacts);
    const double near_cells = cells_per_gap * std::max(margin, -gap);
    add_valley_planes(ground, at, plane, b, id, body[v], x, margin, near_cells, contacts);
  }
}

}  // namespace

SearchResult find_contacts(const Ground& ground, const Shapes& shapes, int b, const Pose& pose,
                           const Mat3& stretch, double margin, std::vector<Vec3>& vertices,
                           std::vector<Contact>& contacts, NearFeatures* near_features) {
  const std::span<const Vec3> body = vertices_of(shapes, b);
  contacts.clear();
  vertices.resize(body.size());
  const Mat3 R = pose.attitude.toRotationMatrix();
  const Mat3 F = R * stretch;
  Vec3 low = pose.position, high = pose.position;
  for (size_t v = 0; v < body.size(); ++v) {
    const Vec3 x =
        pose.position + body[v].x() * F.col(0) + body[v].y() * F.col(1) + body[v].z() * F.col(2);
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
    vertices[v] = x;
  }
  const NearCells near = find_near_cells(ground.trn, ground.pyramid, low, high, margin);
  if (near.reach == Reach::above) return {near.reach, low.z() - near.ground.high};
  if (near.reach == Reach::off_ground) return {near.reach, 0};
  const bool all_on_grid =
      contains(ground.trn, low.x(), low.y()) && contains(ground.trn, high.x(), high.y());
  if (!(all_on_grid && near.ground.all_known) && leans_out(ground.trn, vertices))
    return {Reach::off_ground, 0};
  find_mode_1(ground, shapes, b, near.ground.high, margin, vertices, contacts);
  find_features({ground, shapes, b, pose, stretch, R, vertices, low, high}, near.cells, margin,
                near_features, contacts);
  return {near.reach, 0};
}

}  // namespace talus
