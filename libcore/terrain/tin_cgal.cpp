// terrain/triangulate.hpp with CGAL: points are inserted in an order of our own, so that the same
// points give the same triangles.
#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <bit>
#include <limits>
#include <utility>

#include "base/error.hpp"
#include "terrain/triangulate.hpp"

namespace talus {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
// The number of the point, and of the triangle in the mesh written last.
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<int, Kernel>;
using FaceBase =
    CGAL::Triangulation_face_base_with_info_2<int, Kernel,
                                              CGAL::Constrained_triangulation_face_base_2<Kernel>>;
using Structure = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
// Crossing segments have been refused with their place before; here they must not be joined
// silently.
using Crossings = CGAL::No_constraint_intersection_requiring_constructions_tag;
using Delaunay = CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure, Crossings>;

Kernel::Point_2 plan(const Vec3& point) { return {point.x(), point.y()}; }

constexpr int hilbert_levels = 14;

// Place along Hilbert's curve of the cell (x, y) of a lattice of 2^hilbert_levels cells a side.
std::uint64_t hilbert_number(std::uint32_t x, std::uint32_t y) {
  std::uint64_t number = 0;
  for (std::uint32_t side = 1U << (hilbert_levels - 1); side > 0; side /= 2) {
    const bool right = (x & side) != 0, up = (y & side) != 0;
    number = 4 * number + (right ? (up ? 2U : 3U) : (up ? 1U : 0U));
    if (!up) {
      if (right) x = ~x, y = ~y;
      std::swap(x, y);
    }
  }
  return number;
}

// Three quarters of the points come last, three quarters of the rest before them, and so on, by
// chance: no map is then so regular that its insertion becomes slow (Amenta, Choi, Rote 2003).
std::uint64_t round_of(std::size_t i) {
  std::uint64_t mixed = (i + 1) * 0x9E3779B97F4A7C15U;
  mixed = (mixed ^ mixed >> 30) * 0xBF58476D1CE4E5B9U;
  constexpr int last = 15;
  return static_cast<std::uint64_t>(last -
                                    std::min(last, std::countr_zero(mixed ^ mixed >> 27) / 2));
}

// Order of insertion: rounds, and within a round neighbours in the plane are neighbours in the
// list.
std::vector<int> insertion_order(const std::vector<Vec3>& points) {
  if (points.empty()) return {};
  Vec2 low = points.front().head<2>(), high = low;
  for (const Vec3& p : points) low = low.cwiseMin(p.head<2>()), high = high.cwiseMax(p.head<2>());
  const double extent = std::max((high - low).maxCoeff(), std::numeric_limits<double>::min());
  const double cells = ((1 << hilbert_levels) - 1) / extent;
  std::vector<std::pair<std::uint64_t, int>> keys(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec2 cell = (points[i].head<2>() - low) * cells;
    keys[i] = {
        round_of(i) << 2 * hilbert_levels | hilbert_number(static_cast<std::uint32_t>(cell.x()),
                                                           static_cast<std::uint32_t>(cell.y())),
        static_cast<int>(i)};
  }
  std::sort(keys.begin(), keys.end());
  std::vector<int> order(keys.size());
  std::transform(keys.begin(), keys.end(), order.begin(),
                 [](const auto& key) { return key.second; });
  return order;
}

}  // namespace

struct Triangulation::Impl {
  Delaunay delaunay;
  std::vector<Vec3> new_points;  // that no mesh has taken yet
  std::size_t n_taken = 0;       // points that a mesh has taken

  [[nodiscard]] std::size_t n_points() const { return n_taken + new_points.size(); }

  void constrain(const std::vector<std::array<int, 2>>& edges) {
    std::vector<Delaunay::Vertex_handle> handles(n_points());
    for (const auto vertex : delaunay.finite_vertex_handles()) handles[vertex->info()] = vertex;
    for (const auto& [a, b] : edges) delaunay.insert_constraint(handles[a], handles[b]);
  }

  void add_neighbors(TriangleMesh& mesh) {
    auto outside = delaunay.incident_faces(delaunay.infinite_vertex());
    const auto first_outside = outside;
    do outside->info() = -1;
    while (++outside != first_outside);
    int n_faces = 0;
    for (const auto face : delaunay.finite_face_handles()) face->info() = n_faces++;
    mesh.neighbors.reserve(mesh.triangles.size());
    mesh.constrained.reserve(mesh.triangles.size());
    for (const auto face : delaunay.finite_face_handles()) {
      mesh.neighbors.push_back(
          {face->neighbor(0)->info(), face->neighbor(1)->info(), face->neighbor(2)->info()});
      unsigned constrained = 0;
      for (int k = 0; k < 3; ++k) constrained |= face->is_constrained(k) ? 1U << k : 0U;
      mesh.constrained.push_back(static_cast<std::uint8_t>(constrained));
    }
  }
};

Triangulation::Triangulation(std::vector<Vec3> points,
                             const std::vector<std::array<int, 2>>& segments, std::string source)
    : impl_(std::make_unique<Impl>()) {
  Delaunay::Face_handle hint;
  for (const int i : insertion_order(points)) {
    const auto vertex = impl_->delaunay.insert(plan(points[i]), hint);
    vertex->info() = i;
    hint = vertex->face();
  }
  impl_->new_points = std::move(points);
  if (impl_->delaunay.dimension() < 2)
    throw InputError({source},
                     "all points stand on one straight line, expected lines that span an area",
                     "give the contours of the whole slope");
  try {
    impl_->constrain(segments);
  } catch (const Delaunay::Intersection_of_constraints_exception&) {
    throw InputError({source}, "lines cross that cleaning left apart", "simplify the lines");
  }
}

Triangulation::~Triangulation() = default;
Triangulation::Triangulation(Triangulation&&) noexcept = default;
Triangulation& Triangulation::operator=(Triangulation&&) noexcept = default;

void Triangulation::fix_edges(const std::vector<std::array<int, 2>>& edges) {
  impl_->constrain(edges);
}

void Triangulation::add(const std::vector<Vec3>& points) {
  Delaunay::Face_handle hint;
  for (const int i : insertion_order(points)) {
    const std::size_t n_before = impl_->delaunay.number_of_vertices();
    const Vec3& point = points[i];
    const Delaunay::Vertex_handle vertex = impl_->delaunay.insert(plan(point), hint);
    hint = vertex->face();
    if (impl_->delaunay.number_of_vertices() == n_before) continue;
    vertex->info() = static_cast<int>(impl_->n_points());
    impl_->new_points.push_back(point);
  }
}

void Triangulation::refresh(TriangleMesh& mesh, bool only_triangles) {
  TALUS_ASSERT(mesh.points.size() == impl_->n_taken);
  impl_->n_taken = impl_->n_points();
  if (mesh.points.empty())
    mesh.points = std::move(impl_->new_points);
  else
    mesh.points.insert(mesh.points.end(), impl_->new_points.begin(), impl_->new_points.end());
  impl_->new_points = {};
  mesh.triangles.clear();
  mesh.triangles.reserve(impl_->delaunay.number_of_faces());
  for (const auto face : impl_->delaunay.finite_face_handles())
    mesh.triangles.push_back(
        {face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()});
  mesh.neighbors.clear();
  mesh.constrained.clear();
  if (!only_triangles) impl_->add_neighbors(mesh);
}

TriangleMesh Triangulation::mesh() {
  TriangleMesh mesh;
  refresh(mesh);
  return mesh;
}

}  // namespace talus
