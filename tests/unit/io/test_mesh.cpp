#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <functional>

#include "base/error.hpp"
#include "base/random.hpp"
#include "base/text.hpp"
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
  const auto all = samples();
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
  const auto again = bodies_of(parse_obj(obj_text(cube.surface, "c", {0.1, 1e6, 0}), "again"))[0];
  EXPECT_EQ(again.surface.face_vertices, cube.surface.face_vertices);
  EXPECT_EQ(again.name, "c");
  EXPECT_EQ(again.surface.vertices[1].y(), 1e6 + 1);
}
