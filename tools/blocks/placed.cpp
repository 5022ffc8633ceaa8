#include "tools/blocks/placed.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/memory.hpp"
#include "base/text.hpp"
#include "base/units.hpp"
#include "base/words.hpp"
#include "blocks/least_size.hpp"
#include "blocks/part_faces.hpp"
#include "blocks/placed_bodies.hpp"
#include "blocks/placement.hpp"
#include "blocks/shapes.hpp"
#include "blocks/solid.hpp"
#include "geometry/plan2d.hpp"
#include "geometry/repeated_points.hpp"
#include "io/crs_gdal.hpp"
#include "io/mesh.hpp"
#include "setup/site_shapes_gdal.hpp"
#include "site/joint_plan.hpp"

namespace talus {
namespace {

Where where_of_section(const PlacedContext& context, const PlacedSettings& section) {
  return {context.site.file, section.line, "blocks." + section.name};
}

Vec3 vector_of(const std::vector<double>& values) {
  return values.size() == 3 ? Vec3(values[0], values[1], values[2]) : Vec3::Zero();
}

// --- bodies ------------------------------------------------------------------------------------

Polyhedron shape_of(const PlacedContext& context, const PlacedSettings& section, Random& random) {
  const ShapeKind& kind = shape_kind(section.shape);
  ShapeSize size;
  size.n_sides = static_cast<int>(section.n_sides);
  size.n_points = static_cast<int>(section.n_points);
  const std::vector<double>& given = section.size_m;
  const auto wanted = static_cast<std::size_t>(kind.n_extents);
  if (given.empty() && std::isnan(section.volume_m3))
    throw InputError(where_of_section(context, section), "neither size_m nor volume_m3 is given",
                     "give the extents of the shape, or its volume");
  if (given.size() == 1)
    size.extents = Vec3::Constant(given[0]);
  else if (given.size() == wanted)
    for (std::size_t k = 0; k < wanted; ++k) size.extents[static_cast<Eigen::Index>(k)] = given[k];
  else if (!given.empty())
    throw InputError(where_of(context.site, "blocks." + section.name + ".size_m"),
                     "size_m has " + std::to_string(given.size()) + " numbers, expected 1 or " +
                         std::to_string(wanted) + " for a " + section.shape);
  Polyhedron body = kind.make(size, random);
  if (n_faces(body) == 0 || check_surface(body).fault != SurfaceFault::none)
    throw InputError(where_of_section(context, section), "the " + section.shape + " has no volume",
                     "choose a larger size, or more points");
  if (!std::isnan(section.volume_m3)) body = scaled_to(std::move(body), section.volume_m3);
  const double volume = moments(body).volume;
  if (!(volume >= least_volume))
    throw InputError(where_of_section(context, section),
                     "the " + section.shape + " has " + text(volume, 3) + " m3, expected " +
                         text(least_volume) + " (a cube of 1 mm) or more",
                     "size_m is in metres");
  return body;
}

// Bodies of a file that stand in each other: an inside-out one in another is a cavity, which bodies
// cannot have; the rest is a warning.
void check_apart(const PlacedContext& context, const std::string& path,
                 const std::vector<Body>& bodies, const std::vector<std::string>& names,
                 const std::vector<bool>& were_turned) {
  const BodyOverlaps found = find_overlaps(bodies, were_turned);
  if (found.cavity)
    throw InputError({path, 0, names[(*found.cavity)[0]]},
                     "is inside-out and stands in " + names[(*found.cavity)[1]] + ": a cavity",
                     "bodies are solid: remove the inner surface");
  if (found.n > 0)
    context.tool.warn(path + ": " + std::to_string(found.n) +
                      " pairs of bodies overlap, most of all " + names[found.worst[0]] + " and " +
                      names[found.worst[1]] + ": " + percent(found.largest_share) +
                      " of the smaller one");
}

// The bodies of a mesh file, as they stand in it.
std::vector<Body> mesh_bodies(const PlacedContext& context, const PlacedSettings& section) {
  const std::string path = resolved(context.site, section.file);
  context.tool.read_also("blocks." + section.name, path);
  std::vector<Body> bodies;
  std::vector<std::string> names;
  std::vector<bool> were_turned;
  std::vector<MeshBody> meshes = read_mesh(path);
  for (const std::string& doubt : doubts_about(meshes)) context.tool.warn(path + ": " + doubt);
  const auto put_in_frame = [&](Polyhedron& surface) {
    for (Vec3& v : surface.vertices) {
      if (section.y_up) v = Vec3(v.x(), -v.z(), v.y());
      v *= section.scale;
      if (section.in_place) v -= context.ground.origin;
    }
  };
  for (MeshBody& mesh : meshes) {
    put_in_frame(mesh.surface);
    for (Polyhedron& part : mesh.parts) put_in_frame(part);
    const std::string name =
        mesh.name.empty() ? "body " + std::to_string(bodies.size() + 1) : mesh.name;
    const Where where{path, 0, name};
    bool was_turned = false;
    bodies.push_back(mesh.parts.empty() ? make_solid(mesh.surface, where, was_turned)
                                        : make_solid_of_parts(mesh.parts, where, was_turned));
    if (!mesh.parts.empty() && !hang_together(bodies.back().parts))
      context.tool.warn(path + ": " + name +
                        " has parts that do not lie against the others; all of them move as one "
                        "body");
    names.push_back(name);
    were_turned.push_back(was_turned);
  }
  check_apart(context, path, bodies, names, were_turned);
  for (size_t b = 0; b < bodies.size(); ++b)
    if (were_turned[b])
      context.tool.warn(path + ": " + names[b] + " was inside-out and has been turned");
  return bodies;
}

// `n_places` release points, before they are made.
void check_number(const PlacedContext& context, const PlacedSettings& section, double n_places,
                  double n_at_each) {
  const auto most = static_cast<double>(context.site.source.max_blocks);
  if (n_places * n_at_each > most)
    throw InputError(where_of_section(context, section),
                     "would release about " + text(std::round(n_places * n_at_each)) +
                         " bodies, expected at most " + text(most),
                     "widen release_spacing_m, lower n_per_point, or set source.max_blocks to what "
                     "your machine can take");
  constexpr double bytes_per_body = 6700;  // as cut ones, docs/tools/talus-blocks.md
  require_memory(bytes_per_body * n_places * n_at_each, where_of_section(context, section),
                 text(std::round(n_places * n_at_each)) + " bodies",
                 "widen release_spacing_m or lower n_per_point");
}

// --- positions ---------------------------------------------------------------------------------

std::vector<Vec3> release_from_file(const PlacedContext& context, const PlacedSettings& section) {
  const SitePlace release = release_of(section);
  std::vector<Vec3> positions;
  for (std::vector<Vec2> line :
       shapes_in_plan(context.tool, context.site, context.ground, release)) {
    if (release.kind == VectorKind::lines) {
      check_number(context, section, length_of(line) / section.release_spacing_m, 1);
      line = points_along(line, section.release_spacing_m);
    }
    for (const Vec2& p : line) positions.emplace_back(p.x(), p.y(), NAN);
  }
  return positions;
}

// A place that is named twice is one place: two bodies in it would be one inside the other, or,
// each alone, would count twice.
std::vector<Vec3> each_place_once(const PlacedContext& context, const PlacedSettings& section,
                                  const std::vector<Vec3>& positions) {
  constexpr double same_place = 1e-3;  // [m]
  const std::vector<int> repeated = repeated_points(positions, same_place);
  std::vector<Vec3> kept;
  const Vec3* last = nullptr;
  for (size_t i = 0; i < positions.size(); ++i)
    if (repeated[i] < 0)
      kept.push_back(positions[i]);
    else
      last = &positions[i];
  if (last == nullptr) return kept;
  const Vec3 place = *last + context.ground.origin;
  context.tool.warn("blocks." + section.name + ": " +
                    std::to_string(positions.size() - kept.size()) + " of " +
                    std::to_string(positions.size()) +
                    " release places repeat another one, such as (" + text(place.x(), 10) + ", " +
                    text(place.y(), 10) + "): each is taken once; n_per_point releases several");
  return kept;
}

std::vector<Vec3> positions_of(const PlacedContext& context, const PlacedSettings& section) {
  std::vector<Vec3> positions =
      local_points(context.tool, context.site, context.ground, section.position_m,
                   "blocks." + section.name, "position_m");
  if (!section.release_file.empty())
    for (const Vec3& p : release_from_file(context, section)) positions.push_back(p);
  if (section.release_grid) {
    if (!context.source_area)
      throw InputError(where_of_section(context, section),
                       "release_grid needs the polygon of [source]", "add [source] with a polygon");
    if (std::isnan(section.release_spacing_m))
      throw InputError(where_of_section(context, section), "release_grid needs release_spacing_m");
    check_number(context, section,
                 sloping_area(context.ground, *context.source_area) /
                     (section.release_spacing_m * section.release_spacing_m),
                 1);
    for (const Vec2& p :
         points_over(context.ground, *context.source_area, section.release_spacing_m))
      positions.emplace_back(p.x(), p.y(), NAN);
  }
  if (positions.empty())
    throw InputError(where_of_section(context, section), "the bodies have no place",
                     "give position_m, release_file or release_grid");
  return each_place_once(context, section, positions);
}

// Turned, moved to the place and, unless its height is given, set on the ground.
void put(const PlacedContext& context, const PlacedSettings& section, const Mat3& turn,
         const Vec3& position, std::vector<Body>& bodies) {
  const Vec3 place = position + context.ground.origin;
  const std::string words = "a body at (" + text(place.x(), 10) + ", " + text(place.y(), 10) + ")";
  const double depth =
      put_on_ground(bodies, context.ground, {turn, position, section.height_above_ground_m});
  if (std::isnan(depth))
    throw InputError(where_of_section(context, section), words + " does not lie over known ground",
                     "move it, or make the terrain larger");
  if (depth > 0)
    context.tool.warn("blocks." + section.name + ": " + words + " reaches " + text(depth, 3) +
                      " m into the ground");
}

// Bodies of a mesh as they stand in it, in map coordinates.
std::vector<Body> bodies_in_place(const PlacedContext& context, const PlacedSettings& section) {
  if (section.file.empty())
    throw InputError(where_of_section(context, section), "in_place needs a mesh file");
  std::vector<Body> bodies = mesh_bodies(context, section);
  int n_below = 0;
  for (const Body& body : bodies) {
    if (std::isnan(clearance(body, context.ground)))
      throw InputError(where_of_section(context, section),
                       "the mesh does not lie over known ground",
                       "in_place takes map coordinates; without it, give position_m");
    n_below += is_below(body, context.ground);
  }
  if (n_below > 0)
    context.tool.warn("blocks." + section.name + ": " + std::to_string(n_below) +
                      " bodies lie wholly below the ground: check the datum of their heights, "
                      "or give the terrain lowered to their bed");
  return bodies;
}

// What stands at each place, about its centre of mass; empty for a shape, of which each is new.
std::vector<Body> bodies_to_copy(const PlacedContext& context, const PlacedSettings& section) {
  if (section.file.empty()) return {};
  std::vector<Body> meshes = mesh_bodies(context, section);
  centre(meshes);
  if (!std::isnan(section.volume_m3)) scale_to_volume(meshes, section.volume_m3);
  return meshes;
}

bool has_frequency(const PlacedSettings& section) {
  return !std::isnan(section.frequency_per_a) || !std::isnan(section.frequency_per_m2_a);
}

// Events a year that each body stands for; 1 where no frequency is given. A point of a release grid
// stands for the square of its spacing, of sloping area.
double weight_of(const PlacedSettings& section) {
  if (!has_frequency(section)) return 1;
  const double of_point =
      std::isnan(section.frequency_per_a)
          ? section.frequency_per_m2_a * section.release_spacing_m * section.release_spacing_m
          : section.frequency_per_a;
  return of_point / static_cast<double>(section.n_per_point);
}

void check_frequency(const PlacedContext& context, const PlacedSettings& section) {
  const Where where = where_of_section(context, section);
  if (!std::isnan(section.frequency_per_a) && !std::isnan(section.frequency_per_m2_a))
    throw InputError(where, "has both frequency_per_a and frequency_per_m2_a",
                     "give the one of each release point, or the one of area");
  if (!std::isnan(section.frequency_per_m2_a) && !section.release_grid)
    throw InputError(
        where, "has frequency_per_m2_a, and its bodies do not stand for an area",
        "release all over the source, with release_grid = true and release_spacing_m; points "
        "have frequency_per_a");
  for (const PlacedSettings& other : context.site.blocks)
    if (has_frequency(other) != has_frequency(section))
      throw InputError(where,
                       std::string("has ") + (has_frequency(section) ? "a" : "no") +
                           " frequency, and blocks." + other.name + " has " +
                           (has_frequency(section) ? "none" : "one"),
                       "bodies are weighed by their frequencies: give one to each section");
}

void add_bodies(const PlacedContext& context, const PlacedSettings& section,
                std::vector<Body> bodies, BlockSet& set) {
  for (Body& body : bodies) {
    body.material = material_index(context.site, section.material);
    body.velocity = vector_of(section.velocity_m_s);
    body.spin = vector_of(section.spin_rad_s);
    body.weight = weight_of(section);
    add_body(set, body);
    // once a year is a frequency too
    if (has_frequency(section) && set.weight.empty()) set.weight.assign(set.volume.size(), 1);
  }
}

void add_copies(const PlacedContext& context, const PlacedSettings& section,
                const std::vector<Body>& meshes, BlockSet& set) {
  Random random(static_cast<std::uint64_t>(section.seed), "blocks " + section.name);
  const Mat3 fixed =
      rotation(section.yaw_deg * degree, section.pitch_deg * degree, section.roll_deg * degree);
  const std::vector<Vec3> positions = positions_of(context, section);
  check_number(context, section, static_cast<double>(positions.size()),
               static_cast<double>(section.n_per_point) *
                   static_cast<double>(std::max<size_t>(1, meshes.size())));
  for (const Vec3& position : positions)
    for (std::int64_t copy = 0; copy < section.n_per_point; ++copy) {
      std::vector<Body> bodies = meshes;
      if (bodies.empty()) {
        bodies.emplace_back();
        bodies[0].parts = {shape_of(context, section, random)};
      }
      const Mat3 turn = section.random_orientation ? random_rotation(random) : fixed;
      put(context, section, turn, position, bodies);
      add_bodies(context, section, std::move(bodies), set);
    }
}

void add_section(const PlacedContext& context, const PlacedSettings& section, BlockSet& set) {
  if (section.file.empty() == section.shape.empty())
    throw InputError(
        where_of_section(context, section),
        section.file.empty() ? "neither file nor shape is given" : "both file and shape are given",
        "a body is one or the other");
  check_frequency(context, section);
  if (section.in_place) {
    add_bodies(context, section, bodies_in_place(context, section), set);
    return;
  }
  const std::vector<Body> meshes = bodies_to_copy(context, section);
  if (section.n_per_point > 1)
    context.tool.warn("blocks." + section.name + ": " + std::to_string(section.n_per_point) +
                      " bodies at each release point overlap: move them alone (talus-dda "
                      "--independent), or set n_per_point to 1");
  add_copies(context, section, meshes, set);
}

}  // namespace

void add_placed_blocks(const PlacedContext& context, BlockSet& set) {
  for (const PlacedSettings& section : context.site.blocks) add_section(context, section, set);
}

}  // namespace talus
