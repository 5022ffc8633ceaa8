// blocks/solid.hpp with CGAL: a surface checked for being a solid, and its convex parts.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>

#include <algorithm>
#include <array>
#include <numeric>

#include "base/text.hpp"
#include "blocks/part_faces.hpp"
#include "blocks/solid.hpp"
#include "geometry/triangulate.hpp"

namespace talus {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Triangle = Kernel::Triangle_3;
using Segment = Kernel::Segment_3;

Point point(const Vec3& p) { return {p.x(), p.y(), p.z()}; }

// A triangle of a face and its extent along x.
struct SurfacePiece {
  std::array<int, 3> v;
  int face;
  double low, high;
};

std::vector<SurfacePiece> pieces_of(const Polyhedron& surface) {
  std::vector<SurfacePiece> pieces;
  for (int f = 0; f < n_faces(surface); ++f)
    for (const auto& v : triangles_of_face(surface, f)) {
      const auto [low, high] = std::minmax(
          {surface.vertices[v[0]].x(), surface.vertices[v[1]].x(), surface.vertices[v[2]].x()});
      pieces.push_back({v, f, low, high});
    }
  std::sort(pieces.begin(), pieces.end(), [](const SurfacePiece& a, const SurfacePiece& b) {
    return std::tie(a.low, a.face, a.v) < std::tie(b.low, b.face, b.v);
  });
  return pieces;
}

// Pieces that share an edge collide when they lie on top of each other, those that share a corner
// when the far edge of one meets the other; separate ones when they have a point in common.
bool collide(const Polyhedron& surface, const SurfacePiece& a, const SurfacePiece& b) {
  const auto at = [&](int v) { return point(surface.vertices[v]); };
  std::vector<int> shared, rest_a, rest_b;
  for (const int v : a.v)
    (std::find(b.v.begin(), b.v.end(), v) != b.v.end() ? shared : rest_a).push_back(v);
  for (const int v : b.v)
    if (std::find(a.v.begin(), a.v.end(), v) == a.v.end()) rest_b.push_back(v);
  const Triangle ta(at(a.v[0]), at(a.v[1]), at(a.v[2])), tb(at(b.v[0]), at(b.v[1]), at(b.v[2]));
  if (shared.size() == 3) return true;
  if (shared.size() == 2) {
    const Point p = at(shared[0]), q = at(shared[1]), r = at(rest_a[0]), s = at(rest_b[0]);
    return CGAL::coplanar(p, q, r, s) && CGAL::coplanar_orientation(p, q, r, s) == CGAL::POSITIVE;
  }
  if (ta.is_degenerate() || tb.is_degenerate()) return false;
  if (shared.size() == 1)
    return CGAL::do_intersect(ta, Segment(at(rest_b[0]), at(rest_b[1]))) ||
           CGAL::do_intersect(tb, Segment(at(rest_a[0]), at(rest_a[1])));
  return CGAL::do_intersect(ta, tb);
}

double size_of(const Polyhedron& body) {
  Vec3 low = body.vertices[0], high = low;
  for (const Vec3& v : body.vertices) low = low.cwiseMin(v), high = high.cwiseMax(v);
  return (high - low).norm();
}

std::string text_of(const Vec3& p) {
  return "(" + text(p.x(), 7) + ", " + text(p.y(), 7) + ", " + text(p.z(), 7) + ")";
}

// The convex hull, when it holds no more besides the body than the unevenness of the body's faces
// leaves open; else without faces.
Polyhedron hull_if_as_even(const Polyhedron& body, double tolerance) {
  double largest = 0, area = 0;
  for (int f = 0; f < n_faces(body); ++f) {
    largest = std::max(largest, unevenness(body, f));
    area += face_area(body, f);
  }
  if (largest <= tolerance) return {};
  Polyhedron hull = convex_hull(body.vertices, face_terrain);
  const double more = moments(hull).volume - moments(body).volume;
  return more <= largest * area ? hull : Polyhedron{};
}

}  // namespace

std::optional<std::pair<int, int>> find_self_intersection(const Polyhedron& surface) {
  const std::vector<SurfacePiece> pieces = pieces_of(surface);
  const auto apart = [&](const SurfacePiece& a, const SurfacePiece& b) {
    for (const Eigen::Index axis : {1, 2}) {
      const auto extent = [&](const SurfacePiece& p) {
        return std::minmax({surface.vertices[p.v[0]][axis], surface.vertices[p.v[1]][axis],
                            surface.vertices[p.v[2]][axis]});
      };
      const auto [low_a, high_a] = extent(a);
      const auto [low_b, high_b] = extent(b);
      if (low_a > high_b || low_b > high_a) return true;
    }
    return false;
  };
  for (size_t i = 0; i < pieces.size(); ++i)
    for (size_t j = i + 1; j < pieces.size() && pieces[j].low <= pieces[i].high; ++j)
      if (pieces[i].face != pieces[j].face && !apart(pieces[i], pieces[j]) &&
          collide(surface, pieces[i], pieces[j]))
        return std::minmax(pieces[i].face, pieces[j].face);
  return std::nullopt;
}

Polyhedron convex_hull(const std::vector<Vec3>& points, int tag) {
  if (points.size() < 4) return {};
  std::vector<Point> exact;
  for (const Vec3& p : points) exact.push_back(point(p));
  const bool is_flat = std::all_of(exact.begin(), exact.end(), [&](const Point& p) {
    return CGAL::coplanar(exact[0], exact[1], exact[2], p);
  });
  if (is_flat && !CGAL::collinear(exact[0], exact[1], exact[2])) return {};
  CGAL::Surface_mesh<Point> mesh;
  CGAL::convex_hull_3(exact.begin(), exact.end(), mesh);
  Polyhedron hull;
  std::vector<int> index(mesh.number_of_vertices());
  for (const auto v : mesh.vertices()) {
    index[v] = static_cast<int>(hull.vertices.size());
    const Point& p = mesh.point(v);
    hull.vertices.emplace_back(p.x(), p.y(), p.z());
  }
  std::vector<int> loop;
  for (const auto f : mesh.faces()) {
    loop.clear();
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(f))) loop.push_back(index[v]);
    add_face(hull, loop, tag);
  }
  return in_standard_order(hull);  // the hull's own order follows addresses in memory
}

namespace {

// A closed surface that does not cut through itself, outward, with faces of one plane joined.
Polyhedron sound_surface(const Polyhedron& surface, const Where& where, bool& was_turned) {
  Polyhedron body = surface;
  for (const Vec3& v : body.vertices)
    if (!v.allFinite()) throw InputError(where, "a coordinate is not finite");
  const SurfaceCheck check = check_surface(body);
  if (check.fault == SurfaceFault::inside_out) {
    for (int f = 0; f < n_faces(body); ++f)
      std::reverse(body.face_vertices.begin() + body.face_begin[f],
                   body.face_vertices.begin() + body.face_begin[f + 1]);
    was_turned = true;
  } else if (check.fault != SurfaceFault::none) {
    std::string place;
    if (check.vertex_a >= 0 && check.vertex_b >= 0)
      place = " at the edge " + text_of(body.vertices[check.vertex_a]) + " - " +
              text_of(body.vertices[check.vertex_b]);
    throw InputError(where,
                     std::string("the mesh is ") + text(check.fault) + place +
                         ", expected a closed surface around a volume",
                     "close and repair it with a mesh editor");
  }
  if (const auto crossing = find_self_intersection(body))
    throw InputError(where,
                     "the mesh cuts through itself: faces " + std::to_string(crossing->first + 1) +
                         " and " + std::to_string(crossing->second + 1) + " near " +
                         text_of(face_centroid(body, crossing->first)),
                     "repair it with a mesh editor");
  std::fill(body.face_tag.begin(), body.face_tag.end(), face_terrain);
  return with_joined_faces(body);
}

// A surface that is convex to how well it is known; else without faces.
Polyhedron convex_surface(const Polyhedron& body) {
  const double size = size_of(body);
  return is_convex(body, 1e-7 * size) ? body : hull_if_as_even(body, 1e-9 * size);
}

}  // namespace

Body make_solid(const Polyhedron& surface, const Where& where, bool& was_turned) {
  was_turned = false;
  Polyhedron body = sound_surface(surface, where, was_turned);
  Body solid;
  if (Polyhedron convex = convex_surface(body); n_faces(convex) > 0) {
    solid.parts.push_back(std::move(convex));
    return solid;
  }
  body = with_flat_faces(body, 1e-9 * size_of(body));
  solid.parts = convex_parts(body, where);
  if (solid.parts.size() > 1) solid.shell = std::move(body);
  return solid;
}

Body make_solid_of_parts(const std::vector<Polyhedron>& parts, const Where& where,
                         bool& was_turned) {
  was_turned = false;
  Body solid;
  for (size_t p = 0; p < parts.size(); ++p) {
    const Where here{where.file, where.line, where.item + ", part " + std::to_string(p)};
    const Polyhedron surface = sound_surface(parts[p], here, was_turned);
    Polyhedron convex = convex_surface(surface);
    if (check_surface(surface).n_shells != 1 || n_faces(convex) == 0)
      throw InputError(here, "a part is not one convex body",
                       "give convex parts, or the closed surface of the whole alone: it is then "
                       "taken apart here");
    solid.parts.push_back(std::move(convex));
  }
  double volume = 0;
  for (const Polyhedron& part : solid.parts) volume += moments(part).volume;
  const double shared = shared_volume(solid.parts);
  if (!(shared <= 1e-6 * volume))
    throw InputError(where,
                     "the parts of the body overlap by " + text(shared, 3) + " m3 of " +
                         text(volume, 4) + " m3, which would count twice",
                     "parts may touch only; give the closed surface of the whole alone");
  name_covered_faces(solid.parts);
  return solid;
}

}  // namespace talus
