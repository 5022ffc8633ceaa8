// Makes and checks a scene: masses, principal axes, surfaces, limits of input.
#include "scene/make_scene.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <string>

#include "base/error.hpp"
#include "base/text.hpp"

namespace talus {
namespace {

/// Rotation whose columns are the principal axes of S, right-handed. A tensor that is diagonal to
/// rounding keeps the local axes, so that a box stays a box in its own axes.
Mat3 principal_axes(const Mat3& S) {
  const double scale = S.diagonal().maxCoeff();
  const double mixed = std::max({std::abs(S(0, 1)), std::abs(S(0, 2)), std::abs(S(1, 2))});
  if (mixed <= 1e-14 * scale) return Mat3::Identity();
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(S);
  Mat3 axes = solver.eigenvectors();
  if (axes.determinant() < 0) axes.col(2) = -axes.col(2);
  return axes;
}

void check_material(const Material& m, const std::string& name) {
  const Where where{"", 0, "material " + name};
  if (!(m.density > 0 && std::isfinite(m.density)))
    throw InputError(where, "density is " + text(m.density) + " kg/m3, expected above 0");
  if (!(m.young > 0 && std::isfinite(m.young)))
    throw InputError(where, "Young's modulus is " + text(m.young) + " Pa, expected above 0");
  if (!(m.poisson >= 0 && m.poisson < 0.5))
    throw InputError(where, "Poisson's ratio is " + text(m.poisson) + ", expected 0 to below 0.5");
}

// Beyond any rock, and beyond what steps can follow: a step is cut to a part of a turn.
void check_speed(const char* what, double speed, const char* unit, int block) {
  constexpr double largest = 1000;
  if (speed <= largest) return;
  throw InputError({"", 0, "block " + std::to_string(block)},
                   std::string(what) + " with " + text(speed, 4) + " " + unit +
                       ", expected at most " + text(largest),
                   "see velocity_m_s and spin_rad_s of its section [blocks.*] or [rockfall.*]");
}

// A block of no surface that is as large as the one that `of` is made of.
void add_extent(const Blocks& of, Blocks& to) {
  const auto repeat = [](std::vector<int>& begin) { begin.push_back(begin.back()); };
  to.shapes.radius.push_back(of.shapes.radius.back());
  to.shapes.thickness.push_back(of.shapes.thickness.back());
  to.hulls.radius.push_back(of.hulls.radius.back());
  for (auto* begin : {&to.shapes.vertex_begin, &to.shapes.part_begin, &to.shapes.edge_begin,
                      &to.hulls.part_begin, &to.hulls.body_vertex_begin, &to.hulls.body_edge_begin})
    repeat(*begin);
}

void add_block(Scene& scene, const BlockSet& set, int b, const Material& material) {
  const auto i = static_cast<std::size_t>(b);
  Blocks& blocks = scene.blocks;
  const double volume = set.volume[i];
  const Mat3 axes = principal_axes(set.second_moment[i]);
  const Vec3 S = (axes.transpose() * set.second_moment[i] * axes).diagonal();
  if (!(volume > 0) || !(S.minCoeff() > 0))
    throw InputError({"", 0, "block " + std::to_string(b)}, "has no volume or no extent",
                     "remove it from the block set, or rebuild the set with talus-blocks");
  check_speed("moves at the start", set.velocity[i].norm(), "m/s", b);
  check_speed("spins at the start", set.spin[i].norm(), "rad/s", b);
  blocks.mass.push_back(material.density * volume);
  blocks.volume.push_back(volume);
  blocks.inertia.push_back(material.density * Vec3(S.y() + S.z(), S.x() + S.z(), S.x() + S.y()));
  blocks.second_moment.push_back(S);
  blocks.young.push_back(material.young);
  blocks.poisson.push_back(material.poisson);
  blocks.rest.push_back({set.centroid[i], Quat(axes)});
  blocks.velocity.push_back(set.velocity[i]);
  blocks.spin.push_back(set.spin[i]);
}

void check_materials(const BlockSet& set, std::span<const Material> materials) {
  for (std::size_t m = 0; m < materials.size(); ++m)
    check_material(materials[m],
                   m < set.material_names.size() ? set.material_names[m] : std::to_string(m));
}

const Material& material_of(const BlockSet& set, int b, std::span<const Material> materials) {
  const auto m = static_cast<std::size_t>(set.material[static_cast<std::size_t>(b)]);
  TALUS_ASSERT(m < materials.size());
  return materials[m];
}

}  // namespace

void add_surfaces(const BlockSet& set, int b, Blocks& to) {
  const auto i = static_cast<std::size_t>(b);
  const Mat3 axes = principal_axes(set.second_moment[i]);
  std::vector<Polyhedron> parts;
  for (int p = set.convex_part_begin[i]; p < set.convex_part_begin[i + 1]; ++p)
    parts.push_back(convex_part(set, p));
  add_shape(to.shapes, parts, block_shell(set, b), set.centroid[i], axes.transpose(),
            face_internal);
  add_hulls(to.hulls, parts, set.centroid[i], axes.transpose());
}

void add_blocks(Scene& scene, const BlockSet& set, std::span<const Material> materials) {
  check_materials(set, materials);
  for (int b = 0; b < n_blocks(set); ++b) {
    add_block(scene, set, b, material_of(set, b, materials));
    add_surfaces(set, b, scene.blocks);
  }
}

void add_blocks_without_surfaces(Scene& scene, const BlockSet& set,
                                 std::span<const Material> materials) {
  check_materials(set, materials);
  for (int b = 0; b < n_blocks(set); ++b) {
    add_block(scene, set, b, material_of(set, b, materials));
    Blocks one;
    add_surfaces(set, b, one);
    add_extent(one, scene.blocks);
  }
}

void check_scene(const Scene& scene) {
  const Settings& s = scene.settings;
  if (!(s.dt > 0 && std::isfinite(s.dt)))
    throw InputError({}, "time step is " + text(s.dt) + " s, expected above 0");
  if (!(s.normal_stiffness >= 0))
    throw InputError({}, "normal stiffness is " + text(s.normal_stiffness) + " N/m, expected >= 0");
  if (!(s.accuracy > 0))
    throw InputError({}, "accuracy is " + text(s.accuracy) + ", expected above 0");
  if (!(s.shear_ratio > 0))
    throw InputError(
        {}, "ratio of shear to normal stiffness is " + text(s.shear_ratio) + ", expected above 0");
  for (const GroundClass& g : scene.ground.classes) {
    if (!(g.friction >= 0 && std::isfinite(g.friction)))
      throw InputError({}, "friction tan(phi) is " + text(g.friction) + ", expected >= 0");
    if (!(g.restitution >= 0 && g.restitution <= 1))
      throw InputError({}, "restitution is " + text(g.restitution) + ", expected 0 to 1");
    if (!(g.cohesion >= 0 && g.tension >= 0))
      throw InputError({}, "cohesion or tensile strength is negative");
    for (const auto number : yielding_numbers) {
      const double value = g.*number;
      if (!(value >= 0 && std::isfinite(value)) && value != GroundClass{}.*number)
        throw InputError({}, "a number of yielding ground is " + text(value) + ", expected >= 0");
    }
  }
  for (const Canopy& canopy : scene.canopies)
    if (!(canopy.drag >= 0 && std::isfinite(canopy.drag)))
      throw InputError({}, "drag of a forest is " + text(canopy.drag) + " kg/s, expected >= 0");
  const AccelerationRecord& base = scene.base;
  if (base.time.size() != base.acceleration.size())
    throw InputError({}, "base motion has " + std::to_string(base.time.size()) + " times and " +
                             std::to_string(base.acceleration.size()) + " accelerations");
  for (std::size_t i = 1; i < base.time.size(); ++i)
    if (!(base.time[i] > base.time[i - 1]))
      throw InputError({},
                       "times of the base motion do not increase at sample " + std::to_string(i));
}

}  // namespace talus
