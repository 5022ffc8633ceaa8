// Mesh files: formats, bodies, parts, refusals.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <functional>

#include "base/error.hpp"
#include "base/random.hpp"
#include "base/text.hpp"
#include "blocks/block_set.hpp"
#include "io/mesh.hpp"

namespace {

using namespace talus;

// The unit cube of triangles in each format.
constexpr std::array<std::array<int, 3>, 12> triangles = {{{0, 2, 1},
                                                           {0, 3, 2},
                                                           {4, 5, 6},
                                                           {4, 6, 7},
                                                           {0, 1, 5},
                                                           {0, 5, 4},
                                                           {1, 2, 6},
                                                           {1, 6, 5},
                                                           {2, 3, 7},
                                                           {2, 7, 6},
                                                           {3, 0, 4},
                                                           {3, 4, 7}}};
std::array<float, 3> corner(int v) {
  return {v == 1 || v == 2 || v == 5 || v == 6 ? 1.f : 0.f, v % 4 >= 2 ? 1.f : 0.f,
          v >= 4 ? 1.f : 0.f};
}
std::string vertices_text(const char* prefix) {
  std::string out;
  for (int v = 0; v < 8; ++v)
    out += prefix + text(corner(v)[0]) + " " + text(corner(v)[1]) + " " + text(corner(v)[2]) + "\n";
  return out;
}
std::string faces_text(const char* prefix, int base) {
  std::string out;
  for (const auto& t : triangles)
    out += prefix + std::to_string(t[0] + base) + " " + std::to_string(t[1] + base) + " " +
           std::to_string(t[2] + base) + "\n";
  return out;
}
template <class T>
std::string as_bytes(T value, bool big_endian = false) {
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);
  return big_endian ? std::string(bytes.rbegin(), bytes.rend()) : bytes;
}

std::string obj_cube() { return "# cube\no cube\n" + vertices_text("v ") + faces_text("f ", 1); }
std::string off_cube() { return "OFF\n8 12 0\n" + vertices_text("") + faces_text("3 ", 0); }
std::string ply_head(const char* format) {
  return std::string("ply\nformat ") + format +
         " 1.0\ncomment made up\nelement vertex 8\nproperty float x\nproperty float y\nproperty "
         "float "
         "z\nproperty uchar red\nelement face 12\nproperty list uchar int "
         "vertex_indices\nend_header\n";
}
std::string ply_text_cube() {
  std::string out = ply_head("ascii");
  for (int v = 0; v < 8; ++v)
    out += text(corner(v)[0]) + " " + text(corner(v)[1]) + " " + text(corner(v)[2]) + " 255\n";
  return out + faces_text("3 ", 0);
}
std::string ply_binary_cube(bool big) {
  std::string out = ply_head(big ? "binary_big_endian" : "binary_little_endian");
  for (int v = 0; v < 8; ++v) {
    for (const float x : corner(v)) out += as_bytes(x, big);
    out += '\x7f';
  }
  for (const auto& t : triangles) {
    out += '\x03';
    for (const int v : t) out += as_bytes(v, big);
  }
  return out;
}
std::string stl_binary_cube() {
  std::string out(80, 'x');
  out += as_bytes(12u);
  for (const auto& t : triangles) {
    out += std::string(12, '\0');
    for (const int v : t)
      for (const float x : corner(v)) out += as_bytes(x);
    out += std::string(2, '\0');
  }
  return out;
}
std::string stl_text_cube() {
  std::string out = "solid cube\n";
  for (const auto& t : triangles) {
    out += "facet normal 0 0 0\n outer loop\n";
    for (const int v : t)
      out += "  vertex " + text(corner(v)[0]) + " " + text(corner(v)[1]) + " " +
             text(corner(v)[2]) + "\n";
    out += " endloop\nendfacet\n";
  }
  return out + "endsolid cube\n";
}

using Parser = Mesh (*)(const std::string&, const std::string&);
struct Sample {
  const char* name;
  Parser parse;
  std::string bytes;
};
std::vector<Sample> samples() {
  return {{"obj", parse_obj, obj_cube()},
          {"off", parse_off, off_cube()},
          {"ply text", parse_ply, ply_text_cube()},
          {"ply little endian", parse_ply, ply_binary_cube(false)},
          {"ply big endian", parse_ply, ply_binary_cube(true)},
          {"stl binary", parse_stl, stl_binary_cube()},
          {"stl text", parse_stl, stl_text_cube()}};
}

}  // namespace

TEST(Mesh, EveryFormatGivesTheSameCube) {
  for (const Sample& sample : samples()) {
    SCOPED_TRACE(sample.name);
    const auto bodies = bodies_of(sample.parse(sample.bytes, "cube"));
    ASSERT_EQ(bodies.size(), 1u);
    EXPECT_EQ(bodies[0].surface.vertices.size(), 8u);
    EXPECT_EQ(check_surface(bodies[0].surface).fault, SurfaceFault::none);
    EXPECT_DOUBLE_EQ(moments(bodies[0].surface).volume, 1);
  }
}

TEST(Mesh, FilesCutShortAreRefused) {
  for (const Sample& sample : samples()) {
    SCOPED_TRACE(sample.name);
    for (const double share : {0.0, 0.05, 0.3, 0.5, 0.8, 0.97}) {
      const auto cut = static_cast<size_t>(share * static_cast<double>(sample.bytes.size()));
      try {
        // an OBJ that ends behind a face is a file of its own, but no closed cube
        const Mesh mesh = sample.parse(sample.bytes.substr(0, cut), "cube");
        EXPECT_EQ(check_surface(mesh.surface).fault, SurfaceFault::open);
      } catch (const InputError& error) {
        EXPECT_EQ(std::string(error.what()).rfind("cube", 0), 0u);
      }
    }
  }
}

TEST(Mesh, ManyBodiesStandInOneFile) {
  const std::string two = obj_cube() + "o other\n" + "v 5 0 0\nv 6 0 0\nv 5 1 0\nv 5 0 1\n" +
                          "f -4 -2 -3\nf -4 -3 -1\nf -4/1 -1/2 -2\nf -3//1 -2//1 -1//1\n";
  const auto bodies = bodies_of(parse_obj(two, "two.obj"));
  ASSERT_EQ(bodies.size(), 2u);
  EXPECT_EQ(bodies[1].name, "other");
  EXPECT_NEAR(moments(bodies[1].surface).volume, 1.0 / 6, 1e-15);
}

// Eight unit cubes around one corner of a 2 x 2 x 2 cube: faces, edges and the corner in common.
std::vector<Polyhedron> eight_cubes() {
  std::vector<Polyhedron> cubes;
  for (int k = 0; k < 8; ++k) {
    const Vec3 low(k & 1, k >> 1 & 1, k >> 2);
    cubes.push_back(box(low, low + Vec3::Ones()));
  }
  return cubes;
}

void expect_eight_cubes(const std::vector<MeshBody>& bodies) {
  ASSERT_EQ(bodies.size(), 8u);
  for (const MeshBody& body : bodies) {
    EXPECT_EQ(check_surface(body.surface).fault, SurfaceFault::none);
    EXPECT_EQ(check_surface(body.surface).n_shells, 1);
    EXPECT_EQ(body.surface.vertices.size(), 8u);
    EXPECT_DOUBLE_EQ(moments(body.surface).volume, 1);
  }
}

// Each with vertices of its own, as objects of an OBJ file and without a name in an OFF file.
TEST(Mesh, TouchingBodiesWithOwnVerticesStayApart) {
  std::string objects, off = "OFF\n64 48 0\n", off_faces;
  const std::vector<Polyhedron> cubes = eight_cubes();
  for (size_t k = 0; k < cubes.size(); ++k) {
    objects += "o cube" + std::to_string(k) + "\n";
    for (const Vec3& v : cubes[k].vertices) {
      const std::string words = text(v.x()) + " " + text(v.y()) + " " + text(v.z()) + "\n";
      objects += "v " + words;
      off += words;
    }
    for (int f = 0; f < 6; ++f) {
      objects += "f";
      off_faces += "4";
      for (const int v : face(cubes[k], f)) {
        objects += " " + std::to_string(8 * k + static_cast<size_t>(v) + 1);
        off_faces += " " + std::to_string(8 * k + static_cast<size_t>(v));
      }
      objects += "\n";
      off_faces += "\n";
    }
  }
  const auto bodies = bodies_of(parse_obj(objects, "eight.obj"));
  expect_eight_cubes(bodies);
  EXPECT_EQ(bodies[3].name, "cube3");
  expect_eight_cubes(bodies_of(parse_off(off + off_faces, "eight.off")));
}

// An STL file repeats the vertices of each triangle: only the orientation of the faces about an
// edge tells which of them bound the same cube.
TEST(Mesh, TouchingBodiesOfTrianglesStayApart) {
  std::string stl = "solid eight\n";
  for (const Polyhedron& cube : eight_cubes())
    for (int f = 0; f < 6; ++f)
      for (const int first : {0, 1}) {
        const auto loop = face(cube, f);
        stl += "facet normal 0 0 0\nouter loop\n";
        for (const int v : {loop[0], loop[first + 1], loop[first + 2]})
          stl += "vertex " + text(cube.vertices[v].x()) + " " + text(cube.vertices[v].y()) + " " +
                 text(cube.vertices[v].z()) + "\n";
        stl += "endloop\nendfacet\n";
      }
  expect_eight_cubes(bodies_of(parse_stl(stl + "endsolid eight\n", "eight.stl")));
}

// A body whose faces all have vertices of their own is closed by joining them within the object.
TEST(Mesh, ObjectsOfLooseFacesAreClosed) {
  std::string objects;
  size_t n = 0;
  for (const Polyhedron& cube : eight_cubes()) {
    objects += "o cube" + text(n) + "\n";
    for (int f = 0; f < 6; ++f) {
      for (const int v : face(cube, f))
        objects += "v " + text(cube.vertices[v].x()) + " " + text(cube.vertices[v].y()) + " " +
                   text(cube.vertices[v].z()) + "\n";
      objects += "f -4 -3 -2 -1\n";
      ++n;
    }
  }
  ASSERT_EQ(n, 48u);
  expect_eight_cubes(bodies_of(parse_obj(objects, "loose.obj")));
}

// Groups divide the surface of one body; they do not make it two.
TEST(Mesh, GroupsOfFacesAreOneBody) {
  std::string cube = vertices_text("v ") + faces_text("f ", 1);
  cube.insert(cube.find("f "), "g bottom\n");
  cube.insert(cube.rfind("f "), "g side\n");
  const auto bodies = bodies_of(parse_obj(cube, "groups.obj"));
  ASSERT_EQ(bodies.size(), 1u);
  EXPECT_DOUBLE_EQ(moments(bodies[0].surface).volume, 1);
}

// Blocks in place on a slope, with vertices of neighbours at equal coordinates. The volumes are
// those with which the scene was made: 4,000 m3 in all, rounded to 9 decimals of a coordinate.
TEST(Mesh, JointedRockMassReadsAsItsBlocks) {
  const auto bodies = read_mesh(std::string(TALUS_SOURCE_DIR) + "/tests/data/blocks_39.obj");
  ASSERT_EQ(bodies.size(), 39u);
  double sum = 0, smallest = 1e9;
  for (size_t b = 0; b < bodies.size(); ++b) {
    EXPECT_EQ(bodies[b].name, "block_" + std::to_string(b));
    EXPECT_EQ(check_surface(bodies[b].surface).fault, SurfaceFault::none);
    EXPECT_TRUE(is_convex(bodies[b].surface, 1e-6));
    sum += moments(bodies[b].surface).volume;
    smallest = std::min(smallest, moments(bodies[b].surface).volume);
  }
  EXPECT_NEAR(sum, 4000, 1e-6);
  EXPECT_NEAR(smallest, 51.8, 0.05);
}

TEST(Mesh, FaultsSayWhere) {
  const auto refusal = [](Parser parse, const std::string& bytes) -> std::string {
    try {
      static_cast<void>(parse(bytes, "m"));
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_EQ(refusal(parse_obj, "v 0 0 0\nv 1 0 0\nf 1 2 3\n"), "m:3: a face names vertex 3 of 2");
  EXPECT_EQ(refusal(parse_obj, "v 0 0 x\n"), "m:1: \"x\" is not a number");
  EXPECT_EQ(refusal(parse_obj, "v 0 0 nan\n"), "m:1: \"nan\" is not a number");
  EXPECT_EQ(refusal(parse_obj, "v 0 0 0\nv 1 0 0\nf 1 2 1\n"),
            "m:3: a face has fewer than three different vertices");
  EXPECT_EQ(refusal(parse_off, "OFF\n9999999 1 0\n"),
            "m:2: found 9999999, expected a whole number from 0 to 13");
  EXPECT_EQ(refusal(parse_obj, "v 0 0 0\n"), "m: holds no face");
}

// The parsers take any bytes: they read them or refuse them.
TEST(Mesh, MangledFilesNeverCrash) {
  Random random(5);
  auto all = samples();
  all.push_back({"obj parts", parse_obj,
                 obj_text({box({0, 0, 0}, {1, 1, 1}), box({1, 0, 0}, {2, 1, 1})}, "r", {0, 0, 0})});
  for (int trial = 0; trial < 7000; ++trial) {
    const Sample& sample = all[trial % all.size()];
    std::string bytes = sample.bytes;
    for (int k = 0; k < 1 + trial % 3; ++k) {
      const size_t at = random.below(bytes.size());
      if (trial % 2)
        bytes[at] = static_cast<char>(random.below(256));
      else
        bytes.erase(at, random.below(9));
      if (bytes.empty()) break;
    }
    try {
      static_cast<void>(bodies_of(sample.parse(bytes, "m")));
    } catch (const InputError&) {
      continue;
    }
  }
}

TEST(Mesh, ObjTextReadsBackTheSame) {
  const auto cube = bodies_of(parse_obj(obj_cube(), "cube"))[0];
  const auto again = bodies_of(parse_obj(obj_text({cube.surface}, "c", {0.1, 1e6, 0}), "again"))[0];
  EXPECT_EQ(again.surface.face_vertices, cube.surface.face_vertices);
  EXPECT_EQ(again.name, "c");
  EXPECT_EQ(again.surface.vertices[1].y(), 1e6 + 1);
}

// --- parts of one body -------------------------------------------------------------------------

namespace {

// A cube, an L of two boxes as a block that was divided, and the same L with a surface of its own.
BlockSet three_blocks() {
  BlockSet set;
  set.origin = Vec3(500000, 5200000, 0);
  set.material_names = {"rock"};
  const Polyhedron foot = box({5, 0, 0}, {7, 1, 1}, face_terrain);
  const Polyhedron leg = box({5, 1, 0}, {6, 2, 1}, face_terrain);
  Body cube, divided, whole;
  cube.parts = {box({0, 0, 0}, {1, 1, 1}, face_terrain)};
  divided.parts = whole.parts = {foot, leg};
  whole.shell.vertices = {{5, 0, 0}, {7, 0, 0}, {7, 1, 0}, {6, 1, 0}, {6, 2, 0}, {5, 2, 0}};
  for (int v = 0; v < 6; ++v)
    whole.shell.vertices.push_back(whole.shell.vertices[v] + Vec3::UnitZ());
  add_face(whole.shell, std::array{5, 4, 3, 2, 1, 0}, face_terrain);
  add_face(whole.shell, std::array{6, 7, 8, 9, 10, 11}, face_terrain);
  for (int v = 0; v < 6; ++v)
    add_face(whole.shell, std::array{v, (v + 1) % 6, (v + 1) % 6 + 6, v + 6}, face_terrain);
  for (const Body& body : {cube, divided, whole}) add_body(set, body);
  return set;
}

std::string words_of_refusal(const std::string& bytes) {
  try {
    static_cast<void>(parse_obj(bytes, "m"));
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

// "f ..." of a tetrahedron on the last four vertices, which are written before.
std::string tetrahedron(double x) {
  const std::string at = text(x);
  return "v " + at + " 0 0\nv " + text(x + 1) + " 0 0\nv " + at + " 1 0\nv " + at +
         " 0 1\nf -4 -2 -3\nf -4 -3 -1\nf -4 -1 -2\nf -3 -2 -1\n";
}

}  // namespace

// Blocks, OBJ, blocks: bodies, parts, places and names are those that were written.
TEST(MeshParts, BlocksComeBackAsTheBodiesThatTheyWere) {
  const BlockSet set = three_blocks();
  ASSERT_EQ(broken_promise(set), "");
  BlockSet again;
  again.material_names = set.material_names;
  for (int b = 0; b < n_blocks(set); ++b) {
    const std::string name = "block_" + std::to_string(b);
    const std::string obj = obj_text(block_surfaces(set, b), name, set.origin);
    const std::vector<MeshBody> bodies = bodies_of(parse_obj(obj, "m"));
    ASSERT_EQ(bodies.size(), 1u) << obj;
    EXPECT_EQ(bodies[0].name, name);
    EXPECT_TRUE(doubts_about(bodies).empty());
    Body body;
    body.parts = bodies[0].parts;
    if (body.parts.empty()) body.parts = {bodies[0].surface};
    for (Polyhedron& part : body.parts)
      for (Vec3& v : part.vertices) v -= set.origin;
    add_body(again, body);
  }
  EXPECT_EQ(again.volume, set.volume);
  EXPECT_EQ(again.centroid, set.centroid);
  ASSERT_EQ(again.convex_part_begin, (std::vector<int>{0, 1, 3, 4}));  // of the last its surface
  for (const int p : {0, 1, 2}) {
    EXPECT_EQ(convex_part(again, p).vertices, convex_part(set, p).vertices);
    EXPECT_EQ(convex_part(again, p).face_vertices, convex_part(set, p).face_vertices);
  }
}

// A block that is one surface is written as it always was, and one in parts by its groups.
TEST(MeshParts, OnlyDividedBlocksHaveGroups) {
  const BlockSet set = three_blocks();
  const auto n_groups = [&](int b) {
    const std::string obj = "\n" + obj_text(block_surfaces(set, b), "r", Vec3::Zero());
    int n = 0;
    for (size_t at = obj.find("\ng "); at != std::string::npos; at = obj.find("\ng ", at + 1)) ++n;
    return n;
  };
  EXPECT_EQ(n_groups(0), 0);
  EXPECT_EQ(n_groups(1), 2);
  EXPECT_EQ(n_groups(2), 0);
}

// Parts come in the order of their numbers, a group may continue later and have other names too.
TEST(MeshParts, OrderAndOtherNamesDoNotMatter) {
  std::string obj = "o rock\ng rock_part_1 grey\n" + tetrahedron(1) + "o alone\n" + tetrahedron(5) +
                    "o pair\ng x pair_part_0\n" + tetrahedron(9);
  const std::string first = "g grey rock_part_0\n" + tetrahedron(0);
  obj.insert(obj.find("o alone"), first.substr(0, first.rfind("f ")) + "g rock_part_2\n" +
                                      tetrahedron(2) + "g rock_part_0\nf -7 -6 -5\n");
  const auto bodies = bodies_of(parse_obj(obj, "m"));
  ASSERT_EQ(bodies.size(), 3u);
  EXPECT_EQ(bodies[0].name, "rock");
  ASSERT_EQ(bodies[0].parts.size(), 3u);
  for (int k = 0; k < 3; ++k) {
    EXPECT_EQ(check_surface(bodies[0].parts[k]).fault, SurfaceFault::none);
    EXPECT_NEAR(moments(bodies[0].parts[k]).centroid.x(), k + 0.25, 1e-15);
  }
  EXPECT_EQ(bodies[1].name, "alone");
  EXPECT_TRUE(bodies[1].parts.empty());
  EXPECT_EQ(bodies[2].parts.size(), 1u);
}

// Parts of one body may share vertices, and loose faces are closed within their part.
TEST(MeshParts, PartsMayShareVerticesOrRepeatThem) {
  std::string obj = "o r\n";
  for (const char* v : {"0 0 0", "1 0 0", "0 1 0", "0 0 1", "0 0 -1"})
    obj += std::string("v ") + v + "\n";
  obj += "g r_part_0\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
  obj += "g r_part_1\nf 1 2 3\nf 1 5 2\nf 1 3 5\nf 2 5 3\n";
  const auto bodies = bodies_of(parse_obj(obj, "m"));
  ASSERT_EQ(bodies.size(), 1u);
  ASSERT_EQ(bodies[0].parts.size(), 2u);
  for (const Polyhedron& part : bodies[0].parts) EXPECT_DOUBLE_EQ(moments(part).volume, 1.0 / 6);
  obj.replace(obj.rfind("f 2 5 3"), 7, "v 1 0 0\nv 0 0 -1\nv 0 1 0\nf -3 -2 -1");
  EXPECT_DOUBLE_EQ(moments(bodies_of(parse_obj(obj, "m"))[0].parts[1]).volume, 1.0 / 6);
}

TEST(MeshParts, WhatIsNoWholeSetOfPartsIsRefused) {
  const std::string one = "o r\ng r_part_0\n" + tetrahedron(0);
  EXPECT_EQ(words_of_refusal(one + "g base\n" + tetrahedron(2)),
            "m:11: faces of object r are outside of its parts (line 2 begins one)");
  EXPECT_EQ(words_of_refusal("o r\n" + tetrahedron(2) + "g r_part_0\n" + tetrahedron(0)),
            "m:1: faces of object r are outside of its parts (line 10 begins one)");
  EXPECT_EQ(words_of_refusal(one + "g r_part_01\n" + tetrahedron(2)),
            "m:11: faces of object r are outside of its parts (line 2 begins one)");
  EXPECT_EQ(words_of_refusal(one + "g r_part_2\n" + tetrahedron(2)),
            "m:2: object r has parts up to number 2 and no face of number 1");
  EXPECT_EQ(words_of_refusal(one + "g r_part_1\n"),
            "m:2: object r has parts up to number 1 and no face of number 1");
  EXPECT_EQ(words_of_refusal(one + "g r_part_1 r_part_2\n" + tetrahedron(2)),
            "m:11: faces are said to belong to two parts of object r");
  EXPECT_EQ(words_of_refusal(one + "o s\ng r_part_1\n" + tetrahedron(2)),
            "m:12: group r_part_1 is outside of object r, which begins in line 1");
  EXPECT_EQ(words_of_refusal("g r_part_0\n" + tetrahedron(0) + "o r\n" + tetrahedron(2)),
            "m:1: group r_part_0 is outside of object r, which begins in line 10");
}

// Other groups read as ever; groups that may have been meant as one body are reported.
TEST(MeshParts, OtherGroupsStayBodiesOfTheirOwn) {
  const auto doubts = [](const std::string& obj, size_t n) {
    const auto bodies = bodies_of(parse_obj(obj, "m"));
    EXPECT_EQ(bodies.size(), n);
    for (const MeshBody& body : bodies) EXPECT_TRUE(body.parts.empty());
    return doubts_about(bodies);
  };
  const std::string two = "g left\n" + tetrahedron(0) + "g right\n" + tetrahedron(2);
  EXPECT_TRUE(doubts(two, 2).empty());
  EXPECT_TRUE(doubts("o a\n" + tetrahedron(0) + "o b\ng left\n" + tetrahedron(2), 2).empty());
  ASSERT_EQ(doubts("o a\n" + two, 2).size(), 1u);
  EXPECT_NE(doubts("o a\n" + two, 2)[0].find("1 object holds several closed bodies"),
            std::string::npos);
  const auto lost = doubts("g r_part_0\n" + tetrahedron(0) + "g r_part_1\n" + tetrahedron(2), 2);
  ASSERT_EQ(lost.size(), 1u);
  EXPECT_NE(lost[0].find("2 bodies are named like parts, as r_part_0"), std::string::npos);
}
