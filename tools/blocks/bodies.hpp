// tools/blocks/bodies.hpp
// Bodies of [blocks.*] and [rockfall.*] from meshes and shapes, and how they are put on the ground.
#pragma once

#include <string>
#include <vector>

#include "base/random.hpp"
#include "blocks/block_set.hpp"
#include "site/site.hpp"
#include "terrain/trn.hpp"
#include "tools/frame/tool.hpp"

namespace talus {

/// A section while its bodies are made.
struct BodySection {
  Tool& tool;
  const Site& site;
  const Trn& ground;
  const BodySettings& body;
  std::string path;  ///< "blocks.house", "rockfall.cliff"

  [[nodiscard]] Where where() const { return {site.file, body.line, path}; }
};

/// Throws InputError unless the section has either a file or a shape.
void check_form(const BodySection& section);

/// Throws InputError where so many bodies are too many for [source] max_blocks or the memory.
void check_number(const BodySection& section, double n_bodies);

/// A shape with the volume of the section; a shape with random numbers is another one each time.
/// Throws InputError for a size that makes no body.
[[nodiscard]] Polyhedron shape_of(const BodySection& section, Random& random);

/// The bodies of the section's mesh file, as written in it; with `in_place` in the coordinates
/// of the ground. Throws InputError as read_mesh() and make_solid().
[[nodiscard]] std::vector<Body> mesh_bodies(const BodySection& section, bool in_place);

/// The places of a section, each once, with a warning.
[[nodiscard]] std::vector<Vec3> each_place_once(const BodySection& section,
                                                const std::vector<Vec3>& positions);

/// Turns the bodies, moves them to the place and, unless its height is given, sets them on the
/// ground so high above it [m]. False where some of them do not lie over known ground.
[[nodiscard]] bool put(const BodySection& section, const Mat3& turn, const Vec3& position,
                       double height, std::vector<Body>& bodies);

/// Throws InputError: a body there does not lie over known ground.
[[noreturn]] void refuse_place(const BodySection& section, const Vec3& position);

/// Gives the bodies the material of the section and their motion.
void add_bodies(const BodySection& section, const Vec3& velocity, const Vec3& spin, double weight,
                std::vector<Body> bodies, BlockSet& set);

/// Three numbers of the site file; zero where none are given.
[[nodiscard]] Vec3 vector_of(const std::vector<double>& values);

}  // namespace talus
