// Bodies of [blocks.*] and [rockfall.*] from meshes and shapes, set on the ground.
#include "tools/blocks/bodies.hpp"

#include <algorithm>
#include <cmath>

#include "base/memory.hpp"
#include "base/text.hpp"
#include "base/words.hpp"
#include "blocks/least_size.hpp"
#include "blocks/part_faces.hpp"
#include "blocks/placed_bodies.hpp"
#include "blocks/shapes.hpp"
#include "blocks/solid.hpp"
#include "geometry/repeated_points.hpp"
#include "io/mesh.hpp"
#include "site/joint_plan.hpp"

namespace talus {

Vec3 vector_of(const std::vector<double>& values) {
  return values.size() == 3 ? Vec3(values[0], values[1], values[2]) : Vec3::Zero();
}

void check_form(const BodySection& section) {
  const BodySettings& body = section.body;
  if (body.file.empty() != body.shape.empty()) return;
  throw InputError(
      section.where(),
      body.file.empty() ? "neither file nor shape is given" : "both file and shape are given",
      "a body is one or the other");
}

void check_number(const BodySection& section, double n_bodies) {
  const auto most = static_cast<double>(section.site.source.max_blocks);
  if (n_bodies > most)
    throw InputError(section.where(),
                     "would release about " + text(std::round(n_bodies)) +
                         " bodies, expected at most " + text(most),
                     "widen release_spacing_m, lower rocks, or set source.max_blocks to what your "
                     "machine can take");
  constexpr double bytes_per_body = 6700;  // as cut ones, docs/tools/talus-blocks.md
  require_memory(bytes_per_body * n_bodies, section.where(), text(std::round(n_bodies)) + " bodies",
                 "widen release_spacing_m or lower rocks");
}

Polyhedron shape_of(const BodySection& section, Random& random) {
  const ShapeKind& kind = shape_kind(section.body.shape);
  ShapeSize size;
  size.n_points = static_cast<int>(section.body.n_points);
  const std::vector<double>& given = section.body.size_m;
  const auto wanted = static_cast<std::size_t>(kind.n_extents);
  if (given.empty() && std::isnan(section.body.volume_m3))
    throw InputError(section.where(), "neither size_m nor volume_m3 is given",
                     "give the extents of the shape, or its volume");
  if (given.size() == 1)
    size.extents = Vec3::Constant(given[0]);
  else if (given.size() == wanted)
    for (std::size_t k = 0; k < wanted; ++k) size.extents[static_cast<Eigen::Index>(k)] = given[k];
  else if (!given.empty())
    throw InputError(where_of(section.site, section.path + ".size_m"),
                     "size_m has " + std::to_string(given.size()) + " numbers, expected 1 or " +
                         std::to_string(wanted) + " for a " + section.body.shape);
  Polyhedron body = kind.make(size, random);
  if (n_faces(body) == 0 || check_surface(body).fault != SurfaceFault::none)
    throw InputError(section.where(), "the " + section.body.shape + " has no volume",
                     "choose a larger size, or more points");
  if (!std::isnan(section.body.volume_m3))
    body = scaled_to(std::move(body), section.body.volume_m3);
  const double volume = moments(body).volume;
  if (!(volume >= least_volume))
    throw InputError(section.where(),
                     "the " + section.body.shape + " has " + text(volume, 3) + " m3, expected " +
                         text(least_volume) + " (a cube of 1 mm) or more",
                     "size_m is in metres");
  return body;
}

namespace {

// Bodies of a file that are inside one another: an inside-out one in another is a cavity, which
// bodies cannot have; the rest is a warning.
void check_apart(const BodySection& section, const std::string& path,
                 const std::vector<Body>& bodies, const std::vector<std::string>& names,
                 const std::vector<bool>& were_turned) {
  const BodyOverlaps found = find_overlaps(bodies, were_turned);
  if (found.cavity)
    throw InputError({path, 0, names[(*found.cavity)[0]]},
                     "is inside-out and stands in " + names[(*found.cavity)[1]] + ": a cavity",
                     "bodies are solid: remove the inner surface");
  if (found.n > 0)
    section.tool.warn(path + ": " + std::to_string(found.n) +
                      " pairs of bodies overlap, most of all " + names[found.worst[0]] + " and " +
                      names[found.worst[1]] + ": " + percent(found.largest_share) +
                      " of the smaller one");
}

}  // namespace

std::vector<Body> mesh_bodies(const BodySection& section, bool in_place) {
  const std::string path = resolved(section.site, section.body.file);
  section.tool.read_also(section.path, path);
  std::vector<Body> bodies;
  std::vector<std::string> names;
  std::vector<bool> were_turned;
  std::vector<MeshBody> meshes = read_mesh(path);
  for (const std::string& doubt : doubts_about(meshes)) section.tool.warn(path + ": " + doubt);
  const auto put_in_frame = [&](Polyhedron& surface) {
    for (Vec3& v : surface.vertices) {
      v *= section.body.scale;
      if (in_place) v -= section.ground.origin;
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
      section.tool.warn(path + ": " + name +
                        " has parts that do not lie against the others; all of them move as one "
                        "body");
    names.push_back(name);
    were_turned.push_back(was_turned);
  }
  check_apart(section, path, bodies, names, were_turned);
  for (size_t b = 0; b < bodies.size(); ++b)
    if (were_turned[b])
      section.tool.warn(path + ": " + names[b] + " was inside-out and has been turned");
  return bodies;
}

// Two bodies in one place would be one inside the other, or, each alone, would count twice.
std::vector<Vec3> each_place_once(const BodySection& section, const std::vector<Vec3>& positions) {
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
  const Vec3 place = *last + section.ground.origin;
  section.tool.warn(section.path + ": " + std::to_string(positions.size() - kept.size()) + " of " +
                    std::to_string(positions.size()) +
                    " release places repeat another one, such as (" + text(place.x(), 10) + ", " +
                    text(place.y(), 10) + "): each is taken once; rocks releases several");
  return kept;
}

namespace {

std::string body_at(const BodySection& section, const Vec3& position) {
  const Vec3 place = position + section.ground.origin;
  return "a body at (" + text(place.x(), 10) + ", " + text(place.y(), 10) + ")";
}

}  // namespace

bool put(const BodySection& section, const Mat3& turn, const Vec3& position, double height,
         std::vector<Body>& bodies) {
  const double depth = put_on_ground(bodies, section.ground, {turn, position, height});
  if (depth > 0)
    section.tool.warn(section.path + ": " + body_at(section, position) + " reaches " +
                      text(depth, 3) + " m into the ground");
  return !std::isnan(depth);
}

void refuse_place(const BodySection& section, const Vec3& position) {
  throw InputError(section.where(), body_at(section, position) + " does not lie over known ground",
                   "move it, or make the terrain larger");
}

void add_bodies(const BodySection& section, const Vec3& velocity, const Vec3& spin, double weight,
                std::vector<Body> bodies, BlockSet& set) {
  for (Body& body : bodies) {
    body.material = material_index(section.site, section.body.material);
    body.velocity = velocity;
    body.spin = spin;
    body.weight = weight;
    add_body(set, body);
  }
}

}  // namespace talus
