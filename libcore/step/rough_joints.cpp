#include "step/rough_joints.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

#include "scene/bond_face.hpp"

namespace talus {
namespace {

using std::size_t;

// Area of the faces of block b that look against `normal`, body axes [m2].
double area_against(const Scene& scene, int b, const Vec3& normal) {
  const Hulls& hulls = scene.blocks.hulls;
  double sum = 0;
  for (int p = hulls.part_begin[b]; p < hulls.part_begin[b + 1]; ++p) {
    const auto vertex = [&](int k) -> const Vec3& {
      return hulls.vertices[hulls.vertex_begin[p] + hulls.loop_vertices[k]];
    };
    for (int f = hulls.face_begin[p]; f < hulls.face_begin[p] + hulls.n_faces[p]; ++f) {
      const Vec3 outward(hulls.nx[f], hulls.ny[f], hulls.nz[f]);
      if (hulls.cover[f] == FaceCover::all || !is_same_face(-outward, normal)) continue;
      const int first = hulls.loop_begin[f];
      Vec3 twice = Vec3::Zero();
      for (int k = first + 2; k < hulls.loop_begin[f + 1]; ++k)
        twice += (vertex(k - 1) - vertex(first)).cross(vertex(k) - vertex(first));
      sum += twice.norm() / 2;
    }
  }
  return sum;
}

// Normal force of the last step against `body_b` along `normal`, local axes; `at_rest` without one.
double force_along(std::span<const ContactMemory> memory, int body_b, const Vec3& normal,
                   double at_rest) {
  double sum = 0;
  bool any = false;
  for (const ContactMemory& then : memory) {
    if (then.key.body_b != body_b || !is_same_face(then.normal, normal)) continue;
    sum += then.normal_force;
    any = true;
  }
  return any ? sum : at_rest;
}

double pressed_by_gravity(const Scene& scene, int b, const Vec3& normal) {
  return std::max(0.0, -scene.blocks.mass[b] * scene.gravity.dot(normal));
}

double stress_of(double force, double area) {
  return area > 0 ? force / area : std::numeric_limits<double>::infinity();
}

}  // namespace

void set_rough_friction(const Scene& scene, int b, const Mat3& to_row,
                        std::span<const ContactMemory> memory, std::span<ContactRow> rows) {
  const ContactRow* last = nullptr;
  double stress = 0;
  for (ContactRow& row : rows) {
    const GroundClass& ground = scene.ground.classes[static_cast<size_t>(row.ground_class)];
    if (!is_rough(ground)) continue;
    if (last == nullptr || row.normal != last->normal) {
      const Vec3 normal = to_row.transpose() * row.normal;
      const double force =
          force_along(memory, row.key.body_b, normal, pressed_by_gravity(scene, b, normal));
      stress = stress_of(force, area_against(scene, b, row.normal));
      last = &row;
    }
    row.friction = rough_friction(ground, stress);
  }
}

void set_rough_friction(const Scene& scene, const PairManifold& m,
                        std::span<const ContactMemory> memory, GroundClass& faces) {
  if (!is_rough(faces)) return;
  // of the upper one
  const double at_rest = std::max(pressed_by_gravity(scene, m.block_a, m.normal),
                                  pressed_by_gravity(scene, m.block_b, -m.normal));
  faces.friction =
      rough_friction(faces, stress_of(force_along(memory, m.block_b, m.normal, at_rest), m.area));
}

bool has_rough_joints(const Scene& scene) {
  const std::vector<GroundClass>& sets = scene.joints.of_set;
  return is_rough(scene.joint) || std::any_of(sets.begin(), sets.end(), is_rough);
}

}  // namespace talus
