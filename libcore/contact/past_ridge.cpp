// Depth of a block in a ridge that one of its vertices has crossed.
#include "contact/past_ridge.hpp"

#include <algorithm>

#include "contact/entrance.hpp"

namespace talus {
namespace {

using std::size_t;

struct OwnedEdge {
  int d_row, d_col;  // node that owns it, from the cell's first
  EdgeKind kind;
  std::uint8_t flag;
};
// Lower left triangle: west, south, diagonal. Upper right: north, east, diagonal.
constexpr OwnedEdge edges_of_triangle[2][3] = {
    {{0, 0, EdgeKind::south, trn_flag::convex_south},
     {1, 0, EdgeKind::east, trn_flag::convex_east},
     {0, 0, EdgeKind::diagonal, trn_flag::convex_diagonal}},
    {{0, 0, EdgeKind::east, trn_flag::convex_east},
     {0, 1, EdgeKind::south, trn_flag::convex_south},
     {0, 0, EdgeKind::diagonal, trn_flag::convex_diagonal}}};

// How far below the ridge from `begin` to `end` an edge of the block passes that leads away from
// vertex v, seen from above; 0 when none does [m].
double height_under(const Shapes& shapes, int b, std::span<const Vec3> vertices, int v,
                    const Vec3& begin, const Vec3& end) {
  const Vec3& x = vertices[v];
  double height = 0;
  for (const ShapeEdge& edge : edges_of(shapes, b)) {
    if (edge.a != v && edge.b != v) continue;
    const Vec3 e = vertices[edge.a == v ? edge.b : edge.a] - x;
    const LinePair at = crossing_seen_along(Vec3::UnitZ(), x, e, begin, end - begin);
    if (is_within(at)) height = std::max(height, (begin + at.t * (end - begin) - x - at.s * e).z());
  }
  return height;
}

}  // namespace

double depth_past_ridge(const Ground& ground, const Shapes& shapes, int b,
                        std::span<const Vec3> vertices, const std::vector<Contact>& contacts,
                        double least) {
  const Trn& trn = ground.trn;
  double deepest = 0, reported = 0;
  for (const Contact& contact : contacts) {
    reported = std::max(reported, -contact.gap);
    if (contact.key.mode != ContactMode::vertex_face) continue;
    const int v = contact.key.feature_a;
    const Vec3& x = vertices[v];
    const GridPoint at = locate(trn, x.x(), x.y());
    for (const OwnedEdge& owned : edges_of_triangle[is_upper(at)]) {
      const int row = at.cell.row + owned.d_row, col = at.cell.col + owned.d_col;
      if (!(ground.flags[node_index(trn, row, col)] & owned.flag)) continue;
      const int own = triangle_of(trn, at);
      const TrnEdge ridge = trn_edge(trn, row, col, owned.kind);
      const TrianglePlane other = triangle_plane(trn, ridge.left == own ? ridge.right : ridge.left);
      if (-other.normal.dot(x - other.point) <= least) continue;  // it hardly crossed the ridge
      const double height =
          height_under(shapes, b, vertices, v, node_point(trn, ridge.a.row, ridge.a.col),
                       node_point(trn, ridge.b.row, ridge.b.col));
      const double cosine = std::min(triangle_plane(trn, own).normal.z(), other.normal.z());
      deepest = std::max(deepest, height * cosine);
    }
  }
  return deepest > std::max(least, 2 * reported) ? deepest : 0;
}

}  // namespace talus
