// Closed polyhedra: moments, checks, and the cutting of convex ones by a plane.
#include "geometry/polyhedron.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "base/disjoint_sets.hpp"
#include "base/error.hpp"

namespace talus {
namespace {

Vec3 vertex_mean(const Polyhedron& body) {
  if (body.vertices.empty()) return Vec3::Zero();
  Vec3 sum = Vec3::Zero();
  for (const Vec3& v : body.vertices) sum += v;
  return sum / static_cast<double>(body.vertices.size());
}

// A directed use of an edge by a face, ordered so that the uses of one edge are adjacent.
struct EdgeUse {
  int low, high, face;
  bool forward;  // the face runs from low to high
};

std::vector<EdgeUse> edge_uses(const Polyhedron& body) {
  std::vector<EdgeUse> uses;
  uses.reserve(body.face_vertices.size());
  for (int f = 0; f < n_faces(body); ++f) {
    const auto loop = face(body, f);
    for (size_t k = 0; k < loop.size(); ++k) {
      const int a = loop[k], b = loop[(k + 1) % loop.size()];
      uses.push_back({std::min(a, b), std::max(a, b), f, a < b});
    }
  }
  std::sort(uses.begin(), uses.end(), [](const EdgeUse& p, const EdgeUse& q) {
    return std::tie(p.low, p.high, p.face, p.forward) < std::tie(q.low, q.high, q.face, q.forward);
  });
  return uses;
}

// Index faults of single faces; the checks of edges need sound indices.
SurfaceCheck check_faces(const Polyhedron& body) {
  SurfaceCheck check;
  const int n_vertices = static_cast<int>(body.vertices.size());
  for (int f = 0; f < n_faces(body); ++f) {
    const auto loop = face(body, f);
    const bool in_range =
        std::all_of(loop.begin(), loop.end(), [&](int v) { return v >= 0 && v < n_vertices; });
    if (loop.size() < 3 || !in_range) return {SurfaceFault::bad_index, f, -1, -1, 0, {}};
    for (size_t k = 0; k < loop.size(); ++k)
      if (loop[k] == loop[(k + 1) % loop.size()])
        return {SurfaceFault::repeated, f, loop[k], loop[k], 0, {}};
  }
  return check;
}

// Each edge must be used once forwards and once backwards.
SurfaceCheck check_edges(const std::vector<EdgeUse>& uses) {
  for (size_t first = 0; first < uses.size();) {
    size_t last = first;
    while (last < uses.size() && uses[last].low == uses[first].low &&
           uses[last].high == uses[first].high)
      ++last;
    const EdgeUse& use = uses[first];
    SurfaceFault fault = SurfaceFault::none;
    if (last - first == 1) fault = SurfaceFault::open;
    if (last - first > 2) fault = SurfaceFault::not_manifold;
    if (last - first == 2 && use.forward == uses[first + 1].forward)
      fault = SurfaceFault::not_oriented;
    if (fault != SurfaceFault::none) return {fault, use.face, use.low, use.high, 0, {}};
    first = last;
  }
  return {};
}

// Shells: faces that hang together through edges. A vertex counts once for each shell it is in.
void count_shells(const Polyhedron& body, const std::vector<EdgeUse>& uses, SurfaceCheck& check) {
  DisjointSets shells(n_faces(body));
  for (size_t k = 0; k + 1 < uses.size(); k += 2) shells.join(uses[k].face, uses[k + 1].face);
  std::map<int, int> shell_of_root;
  std::vector<std::pair<int, int>> corners;  // (shell, vertex)
  for (int f = 0; f < n_faces(body); ++f) {
    const int shell = shell_of_root.try_emplace(shells.root(f), shell_of_root.size()).first->second;
    check.euler.resize(shell_of_root.size(), 0);
    ++check.euler[shell];
    for (const int v : face(body, f)) corners.emplace_back(shell, v);
    check.euler[shell] -= static_cast<int>(face(body, f).size());  // two uses make one edge, below
  }
  for (size_t k = 0; k < uses.size(); k += 2)
    ++check.euler[shell_of_root[shells.root(uses[k].face)]];
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  for (const auto& corner : corners) ++check.euler[corner.first];
  check.n_shells = static_cast<int>(check.euler.size());
}

}  // namespace

std::span<const int> face(const Polyhedron& body, int f) {
  return {body.face_vertices.data() + body.face_begin[f],
          static_cast<size_t>(body.face_begin[f + 1] - body.face_begin[f])};
}

void add_face(Polyhedron& body, std::span<const int> vertices, int tag) {
  body.face_vertices.insert(body.face_vertices.end(), vertices.begin(), vertices.end());
  body.face_begin.push_back(static_cast<int>(body.face_vertices.size()));
  body.face_tag.push_back(tag);
}

Vec3 face_area_vector(const Polyhedron& body, int f) {
  const auto loop = face(body, f);
  const Vec3& o = body.vertices[loop[0]];
  Vec3 sum = Vec3::Zero();
  for (size_t k = 1; k + 1 < loop.size(); ++k)
    sum += (body.vertices[loop[k]] - o).cross(body.vertices[loop[k + 1]] - o);
  return sum / 2;
}

double face_area(const Polyhedron& body, int f) { return face_area_vector(body, f).norm(); }

Vec3 face_normal(const Polyhedron& body, int f) {
  const Vec3 area = face_area_vector(body, f);
  const double norm = area.norm();
  return norm > 0 ? Vec3(area / norm) : Vec3::Zero();
}

Vec3 face_centroid(const Polyhedron& body, int f) {
  const auto loop = face(body, f);
  const Vec3 normal = face_normal(body, f);
  const Vec3& o = body.vertices[loop[0]];
  Vec3 weighted = Vec3::Zero(), mean = Vec3::Zero();
  double total = 0;
  for (size_t k = 0; k < loop.size(); ++k) {
    mean += body.vertices[loop[k]] / static_cast<double>(loop.size());
    if (k == 0 || k + 1 == loop.size()) continue;
    const Vec3 a = body.vertices[loop[k]] - o, b = body.vertices[loop[k + 1]] - o;
    const double area = a.cross(b).dot(normal);  // signed: a reflex corner takes away
    weighted += area / 3 * (a + b);
    total += area;
  }
  return total > 0 ? Vec3(o + weighted / total) : mean;
}

namespace {

// Direction in which face f lies beside the edge a -> b, as an angle about the edge that grows
// towards the outside of a face that runs from a to b.
class AnglesAboutEdge {
 public:
  AnglesAboutEdge(const Polyhedron& body, int a, int b)
      : body_(body), along_((body.vertices[b] - body.vertices[a]).normalized()) {
    Eigen::Index thinnest = 0;
    along_.cwiseAbs().minCoeff(&thinnest);
    across_ = along_.cross(Vec3::Unit(thinnest)).normalized();
    up_ = along_.cross(across_);
  }
  [[nodiscard]] double operator()(int f, bool forward) const {
    const Vec3 into = face_normal(body_, f).cross(forward ? along_ : Vec3(-along_));
    return std::atan2(into.dot(up_), into.dot(across_));
  }

 private:
  const Polyhedron& body_;
  Vec3 along_, across_, up_;
};

// Brings each of `right` to the place of its partner in `left`: the face on the other side of the
// material. Faces that lie on each other, of two bodies that touch, have none between them.
void pair_about_edge(const Polyhedron& body, int a, int b, const std::vector<int>& left,
                     std::vector<int>& right) {
  constexpr double full_turn = 2 * std::numbers::pi, same_direction = 1e-9;
  const AnglesAboutEdge angle(body, a, b);
  for (size_t i = 0; i < std::min(left.size(), right.size()); ++i) {
    const auto material = [&](int f) {
      const double turn = std::fmod(angle(left[i], true) - angle(f, false) + full_turn, full_turn);
      return turn > same_direction ? turn : full_turn;
    };
    const auto partner =
        std::min_element(right.begin() + static_cast<std::ptrdiff_t>(i), right.end(),
                         [&](int f, int g) { return material(f) < material(g); });
    std::iter_swap(right.begin() + static_cast<std::ptrdiff_t>(i), partner);
  }
}

}  // namespace

std::vector<PolyhedronEdge> edges(const Polyhedron& body) {
  const std::vector<EdgeUse> uses = edge_uses(body);
  std::vector<PolyhedronEdge> found;
  found.reserve(uses.size() / 2);
  for (size_t first = 0; first < uses.size();) {
    std::vector<int> left, right;
    size_t k = first;
    for (; k < uses.size() && uses[k].low == uses[first].low && uses[k].high == uses[first].high;
         ++k)
      (uses[k].forward ? left : right).push_back(uses[k].face);
    const size_t n = std::max(left.size(), right.size());
    if (n > 1) pair_about_edge(body, uses[first].low, uses[first].high, left, right);
    for (size_t i = 0; i < n; ++i)
      found.push_back({uses[first].low, uses[first].high, i < left.size() ? left[i] : -1,
                       i < right.size() ? right[i] : -1});
    first = k;
  }
  return found;
}

double shortest_edge(const Polyhedron& body) {
  double shortest_sq = std::numeric_limits<double>::infinity();
  for (int f = 0; f < n_faces(body); ++f) {
    const auto loop = face(body, f);
    for (size_t k = 0; k < loop.size(); ++k)
      shortest_sq = std::min(
          shortest_sq,
          (body.vertices[loop[k]] - body.vertices[loop[(k + 1) % loop.size()]]).squaredNorm());
  }
  return std::sqrt(shortest_sq);
}

Moments moments(const Polyhedron& body) {
  const Vec3 o = vertex_mean(body);
  double volume = 0;
  Vec3 first = Vec3::Zero();
  Mat3 second = Mat3::Zero();
  for (int f = 0; f < n_faces(body); ++f) {
    const auto loop = face(body, f);
    const Vec3 a = body.vertices[loop[0]] - o;
    for (size_t k = 1; k + 1 < loop.size(); ++k) {
      const Vec3 b = body.vertices[loop[k]] - o, c = body.vertices[loop[k + 1]] - o;
      const double v = a.dot(b.cross(c)) / 6;
      const Vec3 s = a + b + c;
      volume += v;
      first += v / 4 * s;
      second +=
          v / 20 * (s * s.transpose() + a * a.transpose() + b * b.transpose() + c * c.transpose());
    }
  }
  if (volume == 0) return {0, o, Mat3::Zero()};
  const Vec3 g = first / volume;
  return {volume, o + g, second - volume * g * g.transpose()};
}

Moments joined(const Moments& one, const Moments& other) {
  const double volume = one.volume + other.volume;
  if (volume == 0) return {0, one.centroid, Mat3::Zero()};
  const Vec3 apart = other.centroid - one.centroid;
  return {
      volume, one.centroid + other.volume / volume * apart,
      one.second + other.second + one.volume * other.volume / volume * apart * apart.transpose()};
}

Vec3 extents(const Moments& m) {
  if (m.volume <= 0) return Vec3::Zero();
  const Eigen::SelfAdjointEigenSolver<Mat3> axes(m.second, Eigen::EigenvaluesOnly);
  const Vec3 size = (12 / m.volume * axes.eigenvalues().cwiseMax(0)).cwiseSqrt();
  return {size.z(), size.y(), size.x()};
}

const char* text(SurfaceFault fault) {
  switch (fault) {
    case SurfaceFault::none:
      return "sound";
    case SurfaceFault::bad_index:
      return "a face with fewer than three vertices or a vertex that does not exist";
    case SurfaceFault::repeated:
      return "a face that names the same vertex twice in a row";
    case SurfaceFault::open:
      return "open: an edge with one face only";
    case SurfaceFault::not_manifold:
      return "not a surface: an edge with more than two faces";
    case SurfaceFault::not_oriented:
      return "neighbouring faces that are oriented against each other";
    case SurfaceFault::flat:
      return "flat: no volume";
    case SurfaceFault::inside_out:
      return "inside-out: the faces point inwards";
  }
  return "";
}

SurfaceCheck check_surface(const Polyhedron& body) {
  SurfaceCheck check = check_faces(body);
  if (check.fault != SurfaceFault::none) return check;
  const std::vector<EdgeUse> uses = edge_uses(body);
  check = check_edges(uses);
  if (check.fault != SurfaceFault::none) return check;
  count_shells(body, uses, check);

  // Flat is judged against the volume of a cube on the same surface.
  const double volume = moments(body).volume;
  double area = 0;
  for (int f = 0; f < n_faces(body); ++f) area += face_area(body, f);
  if (!(std::abs(volume) > 1e-9 * std::pow(area / 6, 1.5)))
    check.fault = SurfaceFault::flat;
  else if (volume < 0)
    check.fault = SurfaceFault::inside_out;
  return check;
}

bool is_convex(const Polyhedron& body, double tolerance_m) {
  for (int f = 0; f < n_faces(body); ++f) {
    const Plane plane = plane_through(face_centroid(body, f), face_normal(body, f));
    for (const Vec3& v : body.vertices)
      if (distance(plane, v) > tolerance_m) return false;
  }
  return true;
}

namespace {

// Copies of vertices and cut points of the body being clipped, each made once.
struct Clipper {
  const Polyhedron& body;
  const std::vector<double>& side;  // signed distances, exactly 0 on the plane
  Polyhedron out{};
  std::vector<int> copy{};                       // of old vertices, -1 = not yet
  std::vector<std::array<int, 3>> cut_points{};  // (low, high, new index)
  std::vector<std::array<int, 2>> cap_edges{};   // on the plane, from where the cap enters each
  std::vector<int> inner{};                      // part of one face
  std::vector<char> on_plane{};                  // its vertices

  int kept(int v) {
    if (copy[v] < 0) {
      copy[v] = static_cast<int>(out.vertices.size());
      out.vertices.push_back(body.vertices[v]);
    }
    return copy[v];
  }
  int cut(int a, int b) {
    if (a > b) std::swap(a, b);
    for (const auto& [low, high, index] : cut_points)
      if (low == a && high == b) return index;
    const double t = side[a] / (side[a] - side[b]);
    out.vertices.push_back(body.vertices[a] + t * (body.vertices[b] - body.vertices[a]));
    cut_points.push_back({a, b, static_cast<int>(out.vertices.size()) - 1});
    return cut_points.back()[2];
  }
};

// The inner part of one face; also notes its edge on the plane, from where it enters to where it
// leaves the cap (the cap runs in the opposite sense).
void clip_face(Clipper& c, int f) {
  const auto loop = face(c.body, f);
  std::vector<int>& inner = c.inner;
  std::vector<char>& on_plane = c.on_plane;
  inner.clear();
  on_plane.clear();
  bool any_inside = false;
  for (size_t k = 0; k < loop.size(); ++k) {
    const int a = loop[k], b = loop[(k + 1) % loop.size()];
    const double da = c.side[a], db = c.side[b];
    any_inside |= da < 0;
    if (da <= 0) inner.push_back(c.kept(a)), on_plane.push_back(da == 0);
    if (da * db < 0) inner.push_back(c.cut(a, b)), on_plane.push_back(true);
  }
  if (!any_inside || inner.size() < 3) return;
  add_face(c.out, inner, c.body.face_tag[f]);
  for (size_t k = 0; k < inner.size(); ++k)
    if (on_plane[k] && on_plane[(k + 1) % inner.size()])
      c.cap_edges.push_back({inner[(k + 1) % inner.size()], inner[k]});
}

// Closes the hole that the cut has left: its edges, chained.
void add_cap(Polyhedron& out, const std::vector<std::array<int, 2>>& cap_edges, int tag) {
  std::vector<int> next(out.vertices.size(), -1);
  for (const auto& [from, to] : cap_edges) next[from] = to;
  std::vector<int> loop;
  int v = cap_edges.front()[0];
  do {
    loop.push_back(v);
    v = next[v];
    if (v < 0) return;  // touched along an edge only: nothing to close
  } while (v != loop.front() && loop.size() <= cap_edges.size());
  if (loop.size() >= 3) add_face(out, loop, tag);
}

}  // namespace

Polyhedron clip_convex(const Polyhedron& body, const Plane& plane, int tag, double tolerance_m) {
  std::vector<double> side(body.vertices.size());
  bool any_inside = false, any_outside = false;
  for (size_t v = 0; v < side.size(); ++v) {
    side[v] = distance(plane, body.vertices[v]);
    if (std::abs(side[v]) <= tolerance_m) side[v] = 0;
    any_inside |= side[v] < 0;
    any_outside |= side[v] > 0;
  }
  if (!any_outside) return any_inside ? body : Polyhedron{};
  if (!any_inside) return {};
  Clipper clipper{body, side};
  clipper.copy.assign(side.size(), -1);
  Polyhedron& out = clipper.out;
  out.vertices.reserve(side.size() + 8);
  out.face_begin.reserve(body.face_begin.size() + 1);
  out.face_vertices.reserve(body.face_vertices.size() + 16);
  out.face_tag.reserve(body.face_tag.size() + 1);
  for (int f = 0; f < n_faces(body); ++f) clip_face(clipper, f);
  if (!clipper.cap_edges.empty()) add_cap(out, clipper.cap_edges, tag);
  return std::move(clipper.out);
}

double section_area(const Polyhedron& body, const Plane& plane) {
  // each triangle of a face that the plane cuts gives a side of the section, all in one sense
  double twice = 0;
  const Vec3 from = plane.offset * plane.normal;
  for (int f = 0; f < n_faces(body); ++f) {
    const auto loop = face(body, f);
    for (size_t k = 1; k + 1 < loop.size(); ++k) {
      const std::array<int, 3> corners = {loop[0], loop[k], loop[k + 1]};
      Vec3 rises = Vec3::Zero(), falls = Vec3::Zero();
      bool cut = false;
      for (size_t i = 0; i < 3; ++i) {
        const Vec3 &a = body.vertices[corners[i]], &b = body.vertices[corners[(i + 1) % 3]];
        const double off_a = distance(plane, a), off_b = distance(plane, b);
        if ((off_a > 0) == (off_b > 0)) continue;
        cut = true;
        (off_b > 0 ? rises : falls) = a + off_a / (off_a - off_b) * (b - a) - from;
      }
      if (cut) twice += plane.normal.dot(falls.cross(rises));
    }
  }
  return std::abs(twice) / 2;
}

Polyhedron box(const Vec3& low, const Vec3& high, int tag) {
  Polyhedron body;
  for (int k = 0; k < 8; ++k)
    body.vertices.emplace_back(k & 1 ? high.x() : low.x(), k & 2 ? high.y() : low.y(),
                               k & 4 ? high.z() : low.z());
  constexpr std::array<std::array<int, 4>, 6> loops = {
      {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
  for (const auto& loop : loops) add_face(body, loop, tag);
  return body;
}

}  // namespace talus
