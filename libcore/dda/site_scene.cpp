#include "dda/site_scene.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "base/error.hpp"
#include "base/random.hpp"
#include "dda/make_scene.hpp"

namespace talus {
namespace {

constexpr double degree = std::numbers::pi / 180;

GroundClass ground_class(const GroundSettings& ground, const SolverSettings& solver,
                         double friction_shift_deg, double cor_shift) {
  GroundClass made;
  const double friction = std::clamp(ground.friction_deg + friction_shift_deg, 0.0, 89.0);
  const double cor = std::isnan(solver.cor) ? ground.cor : solver.cor;
  made.friction = std::tan(friction * degree);
  made.cohesion = ground.cohesion_pa;
  made.tension = ground.tension_pa;
  made.restitution = std::clamp(cor + cor_shift, 0.0, 1.0);
  return made;
}

// Contacts between blocks: the smallest friction and restitution of the materials there are.
GroundClass joint_class(const Site& site, const BlockSet& blocks) {
  GroundClass made;
  double friction = 89, cor = 1;
  for (const MaterialSettings& material : site.materials) {
    const auto& names = blocks.material_names;
    if (std::find(names.begin(), names.end(), material.name) == names.end()) continue;
    friction = std::min(friction, material.friction_deg);
    cor = std::min(cor, std::isnan(site.solver.cor) ? material.cor : site.solver.cor);
  }
  made.friction = std::tan(friction * degree);
  made.restitution = cor;
  return made;
}

// Materials in the order of the block set's names.
std::vector<Material> materials_of(const Site& site, const BlockSet& blocks) {
  std::vector<Material> materials;
  for (const std::string& name : blocks.material_names) {
    const auto found = std::find_if(site.materials.begin(), site.materials.end(),
                                    [&name](const auto& m) { return m.name == name; });
    if (found == site.materials.end())
      throw InputError({site.file},
                       "the blocks are of material " + name + ", which the site file does not have",
                       "add [material." + name + "], or cut the blocks again");
    materials.push_back({found->density_kg_m3, found->young_modulus_pa, found->poisson_ratio});
  }
  return materials;
}

Settings settings_of(const SolverSettings& solver, const ScenePlan& plan) {
  Settings settings;
  settings.law = solver.law == "paper" ? Law::paper : Law::talus;
  settings.strains = plan.strains;
  settings.dt = time_step(solver);
  settings.normal_stiffness =
      std::isnan(solver.normal_stiffness_n_m) ? 0 : solver.normal_stiffness_n_m;
  settings.shear_ratio = solver.shear_stiffness_ratio;
  settings.max_passes = static_cast<int>(solver.max_passes);
  settings.flight = plan.flight;
  settings.block_contacts = plan.block_contacts;
  settings.sleep = plan.sleep;
  return settings;
}

void add_jitter(Blocks& blocks, double size, std::uint64_t seed) {
  if (size == 0) return;
  Random random(seed, "start jitter");
  for (Vec3& velocity : blocks.velocity)
    velocity += size * Vec3(random.normal(), random.normal(), random.normal());
}

}  // namespace

double time_step(const SolverSettings& solver) {
  double dt = solver.time_step_s;
  if (std::isnan(dt)) dt = solver.law == "paper" ? 1e-4 : Settings{}.dt;
  if (!std::isnan(solver.min_time_step_s)) dt = std::max(dt, solver.min_time_step_s);
  if (!std::isnan(solver.max_time_step_s)) dt = std::min(dt, solver.max_time_step_s);
  return dt;
}

Scene make_site_scene(const Site& site, const ScenePlan& plan, SceneParts parts) {
  const SolverSettings& solver = site.solver;
  const auto seed = static_cast<std::uint64_t>(solver.seed);
  Random scatter(seed, "scatter of ground");
  Scene scene;
  scene.ground = make_ground(std::move(parts.trn), {});
  scene.ground.classes.clear();
  for (const GroundSettings& ground : site.grounds) {
    const double friction_shift = solver.friction_scatter_deg * scatter.normal();
    const double cor_shift = solver.cor_scatter * scatter.normal();
    scene.ground.classes.push_back(ground_class(ground, solver, friction_shift, cor_shift));
  }
  scene.ground.cell_class = std::move(parts.cell_class);
  scene.joint = joint_class(site, parts.blocks);
  scene.gravity = {0, 0, -solver.gravity_m_s2};
  scene.settings = settings_of(solver, plan);
  scene.base = {std::move(parts.base.time), std::move(parts.base.acceleration)};
  add_blocks(scene, parts.blocks, materials_of(site, parts.blocks));
  add_jitter(scene.blocks, solver.start_jitter_m_s, seed);
  check_scene(scene);
  return scene;
}

}  // namespace talus
