// Bodies of the [blocks.*] sections, put where they start.
#include "tools/blocks/placed.hpp"

#include <cmath>

#include "base/units.hpp"
#include "blocks/placed_bodies.hpp"
#include "blocks/placement.hpp"
#include "blocks/shapes.hpp"
#include "setup/site_shapes_gdal.hpp"

namespace talus {
namespace {

// Bodies of a mesh without a place: as written in it, in map coordinates.
std::vector<Body> bodies_in_place(const BodySection& section) {
  std::vector<Body> bodies = mesh_bodies(section, true);
  int n_below = 0;
  for (const Body& body : bodies) {
    if (std::isnan(clearance(body, section.ground)))
      throw InputError(section.where(), "the mesh does not lie over known ground",
                       "give map coordinates in the mesh, or position_m");
    n_below += is_below(body, section.ground);
  }
  if (n_below > 0)
    section.tool.warn(section.path + ": " + std::to_string(n_below) +
                      " bodies lie wholly below the ground: check the datum of their heights, "
                      "or give the terrain lowered to their bed");
  return bodies;
}

// Bodies at each place, about their centre of mass; empty for a shape, of which each is new.
std::vector<Body> bodies_to_copy(const BodySection& section) {
  if (section.body.file.empty()) return {};
  std::vector<Body> meshes = mesh_bodies(section, false);
  centre(meshes);
  if (!std::isnan(section.body.volume_m3)) scale_to_volume(meshes, section.body.volume_m3);
  return meshes;
}

void add_section(const BodySection& section, const PlacedSettings& settings, BlockSet& set) {
  check_form(section);
  const Vec3 velocity = vector_of(settings.velocity_m_s), spin = vector_of(settings.spin_rad_s);
  if (!settings.file.empty() && settings.position_m.empty()) {
    add_bodies(section, velocity, spin, 1, bodies_in_place(section), set);
    return;
  }
  const std::vector<Body> meshes = bodies_to_copy(section);
  Random random(static_cast<std::uint64_t>(settings.seed), "blocks " + settings.name);
  const Mat3 fixed =
      rotation(settings.yaw_deg * degree, settings.pitch_deg * degree, settings.roll_deg * degree);
  const std::vector<Vec3> positions =
      each_place_once(section, local_points(section.tool, section.site, section.ground,
                                            settings.position_m, section.path, "position_m"));
  if (positions.empty())
    throw InputError(section.where(), "the bodies have no place", "give position_m");
  check_number(section,
               static_cast<double>(positions.size() * std::max<std::size_t>(1, meshes.size())));
  for (const Vec3& position : positions) {
    std::vector<Body> bodies = meshes;
    if (bodies.empty()) bodies.emplace_back().parts = {shape_of(section, random)};
    if (!put(section, settings.random_orientation ? random_rotation(random) : fixed, position,
             settings.height_above_ground_m, bodies))
      refuse_place(section, position);
    add_bodies(section, velocity, spin, 1, std::move(bodies), set);
  }
}

}  // namespace

void add_placed_blocks(Tool& tool, const Site& site, const Trn& ground, BlockSet& set) {
  for (const PlacedSettings& settings : site.blocks)
    add_section({tool, site, ground, settings, "blocks." + settings.name}, settings, set);
}

}  // namespace talus
