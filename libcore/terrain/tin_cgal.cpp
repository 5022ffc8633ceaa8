#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Spatial_sort_traits_adapter_2.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/property_map.h>
#include <CGAL/spatial_sort.h>

#include <numeric>
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

// Order in which neighbours in the plane are neighbours in the list (Hilbert curve).
std::vector<std::size_t> spatial_order(const std::vector<Kernel::Point_2>& points) {
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto map = CGAL::make_property_map(points);
  CGAL::spatial_sort(order.begin(), order.end(),
                     CGAL::Spatial_sort_traits_adapter_2<Kernel, decltype(map)>(map));
  return order;
}

}  // namespace

struct Triangulation::Impl {
  Delaunay delaunay;
  std::vector<Vec3> points;

  void insert_points() {
    std::vector<Kernel::Point_2> places(points.size());
    std::transform(points.begin(), points.end(), places.begin(), plan);
    Delaunay::Face_handle hint;
    for (const std::size_t i : spatial_order(places)) {
      const Delaunay::Vertex_handle vertex = delaunay.insert(places[i], hint);
      vertex->info() = static_cast<int>(i);
      hint = vertex->face();
    }
  }

  void constrain(const std::vector<std::array<int, 2>>& edges) {
    std::vector<Delaunay::Vertex_handle> handles(points.size());
    for (const auto vertex : delaunay.finite_vertex_handles())
      handles[static_cast<std::size_t>(vertex->info())] = vertex;
    for (const auto& [a, b] : edges)
      delaunay.insert_constraint(handles[static_cast<std::size_t>(a)],
                                 handles[static_cast<std::size_t>(b)]);
  }
};

Triangulation::Triangulation(std::vector<Vec3> points,
                             const std::vector<std::array<int, 2>>& segments, std::string source)
    : impl_(std::make_unique<Impl>()) {
  impl_->points = std::move(points);
  impl_->insert_points();
  if (impl_->delaunay.dimension() < 2)
    throw InputError({source},
                     "all points stand on one straight line, expected lines that span an area",
                     "give the contours of the whole slope");
  try {
    impl_->constrain(segments);
  } catch (const Delaunay::Intersection_of_constraints_exception&) {
    throw InputError({source}, "lines cross that cleaning left apart",
                     "simplify the lines, e.g. with ogr2ogr -simplify");
  }
}

Triangulation::~Triangulation() = default;
Triangulation::Triangulation(Triangulation&&) noexcept = default;
Triangulation& Triangulation::operator=(Triangulation&&) noexcept = default;

void Triangulation::fix_edges(const std::vector<std::array<int, 2>>& edges) {
  impl_->constrain(edges);
}

void Triangulation::add(const std::vector<Vec3>& points) {
  std::vector<Kernel::Point_2> places(points.size());
  std::transform(points.begin(), points.end(), places.begin(), plan);
  impl_->points.reserve(impl_->points.size() + points.size());
  Delaunay::Face_handle hint;
  for (const std::size_t i : spatial_order(places)) {
    const std::size_t n_before = impl_->delaunay.number_of_vertices();
    const Delaunay::Vertex_handle vertex = impl_->delaunay.insert(places[i], hint);
    hint = vertex->face();
    if (impl_->delaunay.number_of_vertices() == n_before) continue;
    vertex->info() = static_cast<int>(impl_->points.size());
    impl_->points.push_back(points[i]);
  }
}

TriangleMesh Triangulation::mesh() {
  Delaunay& delaunay = impl_->delaunay;
  TriangleMesh mesh;
  mesh.points = impl_->points;
  const std::size_t n = delaunay.number_of_faces();
  mesh.triangles.reserve(n);
  mesh.neighbors.reserve(n);
  mesh.constrained.reserve(n);
  for (const auto face : delaunay.all_face_handles()) face->info() = -1;
  int n_faces = 0;
  for (const auto face : delaunay.finite_face_handles()) face->info() = n_faces++;
  for (const auto face : delaunay.finite_face_handles()) {
    std::array<int, 3> corners{}, neighbors{};
    std::uint8_t constrained = 0;
    for (int k = 0; k < 3; ++k) {
      corners[static_cast<std::size_t>(k)] = face->vertex(k)->info();
      neighbors[static_cast<std::size_t>(k)] = face->neighbor(k)->info();
      if (face->is_constrained(k)) constrained |= static_cast<std::uint8_t>(1U << k);
    }
    mesh.triangles.push_back(corners);
    mesh.neighbors.push_back(neighbors);
    mesh.constrained.push_back(constrained);
  }
  return mesh;
}

}  // namespace talus
