// Makes the scene of a run from a site file, its terrain and its blocks.
#include "setup/site_scene.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/error.hpp"
#include "base/random.hpp"
#include "base/text.hpp"
#include "base/units.hpp"
#include "scene/make_scene.hpp"
#include "scene/stems.hpp"
#include "scene/worlds.hpp"
#include "setup/crushing.hpp"
#include "site/soils.hpp"

namespace talus {
namespace {

double or_none(double value) { return std::isnan(value) ? 0 : value; }

// Barton and Bandis.
template <class Section>
void set_roughness(const Section& drawn, GroundClass& made) {
  made.roughness = or_none(drawn.jrc) * degree;
  made.wall_strength = 1e6 * or_none(drawn.jcs_mpa);
  made.residual = or_none(drawn.friction_deg) * degree;
}

// Parameters of yielding ground.
void set_yielding(const GroundSettings& drawn, GroundClass& made) {
  made.half_speed = or_none(drawn.cor_half_speed_m_s);
  made.half_energy = 1e3 * or_none(drawn.cor_half_energy_kj);
  made.rolling = or_none(drawn.rolling_resistance);
  made.bearing = 1e3 * or_none(drawn.bearing_kpa);
  made.scar_friction = or_none(drawn.scar_friction);
  made.scar_rate = or_none(drawn.scar_rate_1_m);
  made.scar_decay = or_none(drawn.scar_decay_1_s);
  made.weakening_speed = or_none(drawn.weakening_speed_m_s);
  made.weak_friction = std::tan(or_none(drawn.friction_weak_deg) * degree);
  made.drag_per_time = drawn.drag_1_s;
  made.drag_per_distance = drawn.drag_1_m;
}

bool weakens(const SolverSettings& solver) {
  return solver.friction == "weakening" && solver.law == "talus";
}

// Friction at rest stays that of the sections where it is smaller: a joint that is said to fail
// must not be held.
double weakened(double friction) { return std::min(friction, weakening().at_rest); }

void weaken(GroundSettings& ground) {
  if (!std::isnan(ground.friction_weak_deg)) return;
  const double at_rest = weakened(std::tan(ground.friction_deg * degree));
  ground.friction_deg = std::atan(at_rest) / degree;
  ground.friction_weak_deg = std::atan(std::min(at_rest, weakening().fast)) / degree;
  ground.weakening_speed_m_s = weakening().speed_m_s;
  ground.scar_friction = ground.scar_rate_1_m = ground.scar_decay_1_s = not_given;
}

GroundClass rock_class(const MaterialSettings& material, const SolverSettings& solver) {
  GroundClass made;
  made.friction = std::tan(material.friction_deg * degree);
  made.cohesion = material.cohesion_pa;
  made.tension = material.tension_pa;
  made.restitution = material.cor;
  if (!weakens(solver)) return made;
  made.friction = weakened(made.friction);
  made.weak_friction = std::min(made.friction, weakening().fast);
  made.weakening_speed = weakening().speed_m_s;
  return made;
}

// A joint set's faces; the parts of a section with several sets are named NAME_1, NAME_2, ...
const JointSettings* joints_of(const Site& site, const std::string& set) {
  for (const JointSettings& joints : site.joints)
    if (joints.name == set || (joints.n_sets > 1 && set.rfind('_') != std::string::npos &&
                               joints.name == set.substr(0, set.rfind('_'))))
      return &joints;
  return nullptr;
}

JointClasses joint_classes(const Site& site, const BlockSet& blocks,
                           const std::vector<GroundClass>& rock) {
  JointClasses classes;
  for (const int material : blocks.material) classes.of_block.push_back(rock[material]);
  for (const std::string& set : blocks.joint_set_names) {
    GroundClass& made = classes.of_set.emplace_back();
    made.friction = -1;
    const JointSettings* joints = joints_of(site, set);
    if (joints == nullptr) continue;
    if (!std::isnan(joints->friction_deg)) made.friction = std::tan(joints->friction_deg * degree);
    if (weakens(site.solver)) made.friction = weakened(made.friction);
    made.cohesion = joints->cohesion_pa;
    made.tension = joints->tension_pa;
    set_roughness(*joints, made);
  }
  return classes;
}

/// Materials in the order of the block set's names: densities, and the laws of their faces.
struct Rock {
  std::vector<Material> materials;
  std::vector<GroundClass> classes;
  std::vector<Crushing> crushing;
};

Rock rock_of(const Site& site, const BlockSet& blocks) {
  Rock rock;
  for (const std::string& name : blocks.material_names) {
    const auto found = std::find_if(site.materials.begin(), site.materials.end(),
                                    [&name](const auto& m) { return m.name == name; });
    if (found == site.materials.end())
      throw InputError({site.file},
                       "the blocks are of material " + name + ", which the site file does not have",
                       "add [material." + name + "], or cut the blocks again");
    rock.materials.push_back({found->density_kg_m3, found->young_modulus_pa, found->poisson_ratio});
    rock.classes.push_back(rock_class(*found, site.solver));
    rock.crushing.push_back({1e6 * found->strength_mpa, found->crush_below});
  }
  return rock;
}

void add_jitter(Blocks& blocks, double size, std::uint64_t seed) {
  if (size == 0) return;
  Random random(seed, "start jitter");
  for (Vec3& velocity : blocks.velocity)
    velocity += size * Vec3(random.normal(), random.normal(), random.normal());
}

}  // namespace

GroundClass ground_class(const GroundSettings& drawn) {
  GroundClass made;
  made.friction = std::tan(drawn.friction_deg * degree);
  made.cohesion = drawn.cohesion_pa;
  made.tension = drawn.tension_pa;
  made.restitution = drawn.cor;
  set_roughness(drawn, made);
  set_yielding(drawn, made);
  return made;
}

double time_step(const SolverSettings& solver) {
  if (!std::isnan(solver.time_step_s)) return solver.time_step_s;
  return solver.law == "paper" ? 1e-4 : Settings{}.dt;
}

Settings settings_of(const SolverSettings& solver, const ScenePlan& plan) {
  Settings settings;
  settings.strains = plan.strains;
  settings.dt = time_step(solver);
  settings.normal_stiffness =
      std::isnan(solver.normal_stiffness_n_m) ? 0 : solver.normal_stiffness_n_m;
  settings.accuracy = solver.accuracy;
  settings.flight = plan.flight;
  settings.block_contacts = plan.block_contacts;
  settings.sleep = plan.sleep;
  return settings;
}

std::vector<GroundSettings> drawn_grounds(const Site& site) {
  const SolverSettings& solver = site.solver;
  const auto seed = static_cast<std::uint64_t>(solver.seed);
  Random scatter(seed, "scatter of ground");
  std::vector<GroundSettings> drawn = site.grounds;
  for (GroundSettings& ground : drawn) {
    const double friction_shift = solver.friction_scatter_deg * scatter.normal();
    const double cor_shift = solver.cor_scatter * scatter.normal();
    ground.friction_deg = std::clamp(ground.friction_deg + friction_shift, 0.0, 89.0);
    ground.cor = std::clamp(ground.cor + cor_shift, 0.0, 1.0);
    if (weakens(solver)) weaken(ground);
  }
  return drawn;
}

Scene make_site_scene(const Site& site, const ScenePlan& plan, SceneParts parts,
                      bool surfaces_later) {
  const SolverSettings& solver = site.solver;
  const auto seed = static_cast<std::uint64_t>(solver.seed);
  Scene scene;
  scene.ground = make_ground(std::move(parts.trn), {});
  scene.ground.classes.clear();
  for (const GroundSettings& ground : drawn_grounds(site))
    scene.ground.classes.push_back(ground_class(ground));
  scene.ground.cell_class = std::move(parts.cell_class);
  const Rock rock = rock_of(site, parts.blocks);
  scene.joints = joint_classes(site, parts.blocks, rock.classes);
  scene.gravity = {0, 0, -solver.gravity_m_s2};
  scene.settings = settings_of(solver, plan);
  scene.base = std::move(parts.base);
  const FragmentationSettings& breaking = site.fragmentation;
  scene.fragments = std::move(parts.fragments);
  scene.fragmentation = {breaking.energy_j_m2, breaking.spread, breaking.separation_share,
                         static_cast<std::uint64_t>(breaking.seed)};
  if (surfaces_later && solver.law == "talus" &&
      fall_a_few_at_a_time(scene, n_blocks(parts.blocks)))
    add_blocks_without_surfaces(scene, parts.blocks, rock.materials);
  else
    add_blocks(scene, parts.blocks, rock.materials);
  if (solver.law == "talus") {
    const auto n_released = std::count_if(scene.fragments.begin(), scene.fragments.end(),
                                          [](const Fragment& f) { return f.parent < 0; });
    scene.crush_load =
        crush_loads(parts.blocks, scene.blocks, rock.crushing,
                    scene.fragments.empty() ? n_blocks(scene) : static_cast<int>(n_released));
  }
  add_jitter(scene.blocks, solver.start_jitter_m_s, seed);
  for (const StandingFence& fence : parts.fences) add_fence(scene, fence);
  if (!parts.stems.empty()) add_forest(scene, std::move(parts.stems), std::move(parts.stem_faces));
  scene.canopies = std::move(parts.canopies);
  scene.drained_at = site.water.drained_at_m;
  if (parts.water) add_joint_water(*parts.water, scene);
  check_scene(scene);
  return scene;
}

SplitSettings split_settings(const Site& site, const BlockSet& set) {
  const FragmentationSettings& from = site.fragmentation;
  SplitSettings made;
  made.splitting = from.splitting == "joints" ? Splitting::joints : Splitting::random;
  made.min_volume = from.min_volume_m3;
  made.max_generation = static_cast<int>(from.max_generation);
  made.seed = static_cast<std::uint64_t>(from.seed);
  for (const std::string& name : set.joint_set_names) {
    const JointSettings* joints = joints_of(site, name);
    const bool is_partly_open = joints != nullptr && joints->persistence < 1;
    made.bonded.push_back(is_partly_open ? 1 - joints->persistence : 1);
  }
  return made;
}

std::vector<UnusualValue> unusual_values(const Site& site) {
  std::vector<UnusualValue> found;
  const auto look = [&](const std::string& key, double value, double low, double high,
                        const std::string& unit, const std::string& usual) {
    if (value >= low && value <= high) return;
    if (std::isnan(value)) return;
    found.push_back({key, "is " + text(value, 4) + " " + unit + "; " + usual});
  };
  for (const MaterialSettings& m : site.materials) {
    const std::string key = "material." + m.name + ".";
    look(key + "density_kg_m3", m.density_kg_m3, 1500, 3500, "kg/m3",
         "rock has 2000 to 3200 kg/m3");
    look(key + "young_modulus_pa", m.young_modulus_pa, 1e8, 2e11, "Pa",
         "rock has 1e9 to 1e11 Pa, weathered rock from 1e8");
  }
  look("solver.normal_stiffness_n_m", site.solver.normal_stiffness_n_m, 1e6, 1e14, "N/m",
       "contacts of blocks have 1e8 to 1e12 N/m; law talus chooses it when it is not given");
  return found;
}

}  // namespace talus
