// Makes a solid body of a surface: checks it and divides it into convex parts.
#include "blocks/solid.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/text.hpp"
#include "geometry/triangulate.hpp"

namespace talus {
namespace {

double size_of(const Polyhedron& body) {
  Vec3 low = body.vertices[0], high = low;
  for (const Vec3& v : body.vertices) low = low.cwiseMin(v), high = high.cwiseMax(v);
  return (high - low).norm();
}

// --- binary tree of the planes of a body's faces ----------------------------------------------

// A convex piece of a face.
struct Patch {
  std::vector<Vec3> loop;
  Plane plane;
};

// Convex faces stay whole, the rest becomes triangles. Faces are flat (with_flat_faces).
void add_patches(const Polyhedron& body, int f, std::vector<Patch>& patches) {
  const Plane plane = plane_through(face_centroid(body, f), face_normal(body, f));
  if (plane.normal.squaredNorm() == 0) return;
  if (is_convex_face(body, f)) {
    std::vector<Vec3> loop;
    for (const int v : face(body, f)) loop.push_back(body.vertices[v]);
    patches.push_back({std::move(loop), plane});
    return;
  }
  for (const auto& [i, j, k] : triangles_of_face(body, f))
    patches.push_back({{body.vertices[i], body.vertices[j], body.vertices[k]}, plane});
}

struct Halves {
  std::vector<Vec3> inside, outside;  // empty when nothing of it is there
};

Halves split(const std::vector<Vec3>& loop, const Plane& plane, double tolerance) {
  Halves halves;
  bool any_inside = false, any_outside = false;
  for (size_t k = 0; k < loop.size(); ++k) {
    const Vec3 &a = loop[k], &b = loop[(k + 1) % loop.size()];
    const double da = distance(plane, a), db = distance(plane, b);
    any_inside |= da < -tolerance;
    any_outside |= da > tolerance;
    if (da <= tolerance) halves.inside.push_back(a);
    if (da >= -tolerance) halves.outside.push_back(a);
    if ((da < -tolerance && db > tolerance) || (da > tolerance && db < -tolerance)) {
      const Vec3 p = a + da / (da - db) * (b - a);
      halves.inside.push_back(p);
      halves.outside.push_back(p);
    }
  }
  if (!any_inside) halves.inside.clear();
  if (!any_outside) halves.outside.clear();
  return halves;
}

// The plane, of up to 32 looked at, that cuts the fewest other patches and balances best.
size_t best_plane(const std::vector<Patch>& patches, double tolerance) {
  size_t best = 0;
  double best_cost = std::numeric_limits<double>::infinity();
  const size_t step = std::max<size_t>(1, patches.size() / 32);
  for (size_t i = 0; i < patches.size(); i += step) {
    double n_cut = 0, balance = 0;
    for (const Patch& other : patches) {
      bool inside = false, outside = false;
      for (const Vec3& v : other.loop) {
        const double d = distance(patches[i].plane, v);
        inside |= d < -tolerance;
        outside |= d > tolerance;
      }
      n_cut += inside && outside;
      balance += inside ? 1 : outside ? -1 : 0;
    }
    const double cost = 8 * n_cut + std::abs(balance);
    if (cost < best_cost) best = i, best_cost = cost;
  }
  return best;
}

// Planes that nearly coincide double corners or leave out a face; the corners span the cell.
Polyhedron clip_soundly(const Polyhedron& cell, const Plane& plane, double tolerance) {
  Polyhedron kept = clip_convex(cell, plane, face_internal, tolerance);
  if (n_faces(kept) == 0) return kept;
  const SurfaceFault fault = check_surface(kept).fault;
  if (fault == SurfaceFault::none || fault == SurfaceFault::flat) return kept;
  return convex_hull(kept.vertices, face_internal);
}

// Cuts `cell` by the planes of the patches in it; the space inside all of them is a part. A patch
// whose plane has cut is used up, so every branch of the tree ends.
void grow(const Polyhedron& cell, std::vector<Patch> patches, double tolerance,
          std::vector<Polyhedron>& parts) {
  struct Branch {
    Polyhedron cell;
    std::vector<Patch> patches;
  };
  std::vector<Branch> open = {{cell, std::move(patches)}};
  while (!open.empty()) {
    Branch branch = std::move(open.back());
    open.pop_back();
    if (n_faces(branch.cell) == 0) continue;
    const size_t cutting = best_plane(branch.patches, tolerance);
    const Plane plane = branch.patches[cutting].plane;
    std::vector<Patch> inside, outside;
    for (size_t p = 0; p < branch.patches.size(); ++p) {
      if (p == cutting) continue;
      const Patch& patch = branch.patches[p];
      Halves halves = split(patch.loop, plane, tolerance);
      if (!halves.inside.empty()) inside.push_back({std::move(halves.inside), patch.plane});
      if (!halves.outside.empty()) outside.push_back({std::move(halves.outside), patch.plane});
    }
    if (!outside.empty())
      open.push_back(
          {clip_convex(branch.cell, flipped(plane), face_internal, tolerance), std::move(outside)});
    Polyhedron inner = clip_soundly(branch.cell, plane, tolerance);
    if (!inside.empty())
      open.push_back({std::move(inner), std::move(inside)});
    else if (n_faces(inner) > 0)
      parts.push_back(std::move(inner));
  }
}

// --- joining parts ------------------------------------------------------------------------------

Plane plane_of(const Polyhedron& body, int f) {
  return plane_through(face_centroid(body, f), face_normal(body, f));
}

// The union of two convex bodies that meet in a plane, when it is convex; else without faces.
Polyhedron convex_union(const Polyhedron& a, const Polyhedron& b, double tolerance) {
  for (int f = 0; f < n_faces(a); ++f) {
    const Plane between = plane_of(a, f);
    int opposite = -1;
    for (int g = 0; g < n_faces(b); ++g)
      if (face_normal(b, g).dot(between.normal) < -1 + 1e-12 &&
          std::abs(distance(between, b.vertices[face(b, g)[0]])) <= tolerance)
        opposite = g;
    if (opposite < 0) continue;
    const auto within = [&](const Polyhedron& body, const Polyhedron& other, int skipped) {
      for (int g = 0; g < n_faces(other); ++g)
        for (const Vec3& v : body.vertices)
          if (g != skipped && distance(plane_of(other, g), v) > tolerance) return false;
      return true;
    };
    if (!within(a, b, opposite) || !within(b, a, f)) continue;
    const double size = size_of(a) + size_of(b);
    Polyhedron joined = box(a.vertices[0] - Vec3::Constant(2 * size),
                            a.vertices[0] + Vec3::Constant(2 * size), face_internal);
    for (int g = 0; g < n_faces(a) && n_faces(joined) > 0; ++g)
      if (g != f) joined = clip_convex(joined, plane_of(a, g), a.face_tag[g], tolerance);
    for (int g = 0; g < n_faces(b) && n_faces(joined) > 0; ++g)
      if (g != opposite) joined = clip_convex(joined, plane_of(b, g), b.face_tag[g], tolerance);
    const double sum = moments(a).volume + moments(b).volume;
    if (n_faces(joined) > 0 && std::abs(moments(joined).volume - sum) <= 1e-9 * sum) return joined;
  }
  return {};
}

void join_parts(std::vector<Polyhedron>& parts, double tolerance) {
  for (size_t i = 0; i < parts.size(); ++i)
    for (size_t j = i + 1; j < parts.size();) {
      Polyhedron joined = convex_union(parts[i], parts[j], tolerance);
      if (n_faces(joined) == 0) {
        ++j;
        continue;
      }
      parts[i] = std::move(joined);
      parts.erase(parts.begin() + static_cast<std::ptrdiff_t>(j));
      j = i + 1;
    }
}

// Faces that do not lie on the body's own are between parts.
void name_part_faces(std::vector<Polyhedron>& parts, const Polyhedron& body, double tolerance) {
  std::vector<Plane> planes;
  for (int f = 0; f < n_faces(body); ++f) planes.push_back(plane_of(body, f));
  for (Polyhedron& part : parts)
    for (int f = 0; f < n_faces(part); ++f) {
      const Vec3 centre = face_centroid(part, f), normal = face_normal(part, f);
      const bool is_own = std::any_of(planes.begin(), planes.end(), [&](const Plane& plane) {
        return plane.normal.dot(normal) > 1 - 1e-9 &&
               std::abs(distance(plane, centre)) <= tolerance;
      });
      part.face_tag[f] = is_own ? face_terrain : face_internal;
    }
}

}  // namespace

Polyhedron in_standard_order(const Polyhedron& body) {
  std::vector<int> order(body.vertices.size()), place(order.size());
  std::iota(order.begin(), order.end(), 0);
  const auto key = [&](int v) {
    const Vec3& p = body.vertices[v];
    return std::array{p.x(), p.y(), p.z()};
  };
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return key(a) < key(b); });
  Polyhedron ordered;
  for (size_t k = 0; k < order.size(); ++k) {
    place[order[k]] = static_cast<int>(k);
    ordered.vertices.push_back(body.vertices[order[k]]);
  }
  std::vector<std::pair<std::vector<int>, int>> faces;
  for (int f = 0; f < n_faces(body); ++f) {
    std::vector<int> loop;
    for (const int v : face(body, f)) loop.push_back(place[v]);
    std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
    faces.emplace_back(std::move(loop), body.face_tag[f]);
  }
  std::sort(faces.begin(), faces.end());
  for (const auto& [loop, tag] : faces) add_face(ordered, loop, tag);
  return ordered;
}

double common_volume(const Polyhedron& one, const Polyhedron& other) {
  Polyhedron common = one;
  for (int f = 0; f < n_faces(other) && n_faces(common) > 0; ++f) {
    const Plane plane = plane_through(face_centroid(other, f), face_normal(other, f));
    if (plane.normal.squaredNorm() > 0) common = clip_convex(common, plane, face_internal, 0);
  }
  return n_faces(common) > 0 ? moments(common).volume : 0;
}

double unevenness(const Polyhedron& body, int f) {
  const Plane plane = plane_through(face_centroid(body, f), face_normal(body, f));
  double largest = 0;
  for (const int v : face(body, f))
    largest = std::max(largest, std::abs(distance(plane, body.vertices[v])));
  return largest;
}

Polyhedron with_flat_faces(const Polyhedron& body, double tolerance) {
  Polyhedron flat;
  flat.vertices = body.vertices;
  for (int f = 0; f < n_faces(body); ++f) {
    if (unevenness(body, f) <= tolerance)
      add_face(flat, face(body, f), body.face_tag[f]);
    else
      for (const auto& triangle : triangles_of_face(body, f))
        add_face(flat, triangle, body.face_tag[f]);
  }
  return flat;
}

std::vector<Polyhedron> convex_parts(const Polyhedron& body, const Where& where) {
  constexpr int max_faces = 20000;
  if (n_faces(body) > max_faces)
    throw InputError(where,
                     "the mesh is not convex and has " + std::to_string(n_faces(body)) +
                         " faces, expected at most " + std::to_string(max_faces),
                     "simplify it, or take its convex hull");
  const double size = size_of(body), tolerance = 1e-9 * size;
  std::vector<Patch> patches;
  for (int f = 0; f < n_faces(body); ++f) add_patches(body, f, patches);
  const Vec3 room = Vec3::Constant(size);
  std::vector<Polyhedron> parts;
  grow(box(body.vertices[0] - 2 * room, body.vertices[0] + 2 * room, face_internal),
       std::move(patches), tolerance, parts);
  const double volume = moments(body).volume;
  std::erase_if(parts, [&](const Polyhedron& part) {
    return check_surface(part).fault != SurfaceFault::none || moments(part).volume < 1e-12 * volume;
  });
  double sum = 0;
  for (const Polyhedron& part : parts) sum += moments(part).volume;
  if (!(std::abs(sum - volume) <= 1e-6 * volume))
    throw InputError(where,
                     "the mesh cannot be taken apart: its convex parts hold " + text(sum, 8) +
                         " of its " + text(volume, 8) + " m3",
                     "repair the mesh; faces may lie on top of each other");
  if (parts.size() <= 400) join_parts(parts, tolerance);
  name_part_faces(parts, body, 1e-7 * size);
  return parts;
}

}  // namespace talus
