// tests/bench/slide_scene.hpp
// The peers' slide (scene F): its terrain and its blocks, as files in TALUS_PEERS_DIR.
#pragma once

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "dda/cases.hpp"

namespace talus::bench {

inline Trn read_grid(const std::string& path) {
  std::ifstream in(path);
  std::string key;
  Trn trn;
  double x0 = 0, y0 = 0, unknown = 0;
  in >> key >> trn.n_cols >> key >> trn.n_rows >> key >> x0 >> key >> y0 >> key >> trn.cell_size >>
      key >> unknown;
  trn.node0 = Vec2(x0, y0 + (trn.n_rows - 1) * trn.cell_size);
  trn.elevation.resize(static_cast<std::size_t>(trn.n_cols * trn.n_rows));
  for (double& z : trn.elevation) in >> z;
  return trn;
}

inline std::vector<Body> read_blocks(const std::string& path) {
  std::ifstream in(path);
  std::vector<Body> bodies;
  std::vector<Vec3> vertices;
  std::vector<std::vector<int>> faces;
  int first = 1;
  const auto flush = [&] {
    if (faces.empty()) return;
    first += static_cast<int>(vertices.size());
    Body body;
    body.parts = {cases::polyhedron(std::move(vertices), faces)};
    bodies.push_back(std::move(body));
    vertices.clear();
    faces.clear();
  };
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string word;
    words >> word;
    if (word == "o") flush();
    if (word == "v") {
      Vec3 v;
      words >> v.x() >> v.y() >> v.z();
      vertices.push_back(v);
    }
    if (word != "f") continue;
    faces.emplace_back();
    while (words >> word) faces.back().push_back(std::atoi(word.c_str()) - first);
  }
  flush();
  return bodies;
}

}  // namespace talus::bench
