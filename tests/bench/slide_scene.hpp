// tests/bench/slide_scene.hpp
// The peers' slide (scene F): terrain_F.asc and blocks_N.obj of the folder TALUS_PEERS_DIR.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>

#include "verify/study/ensemble.hpp"

namespace talus::bench {

inline std::string text_of_file(const std::string& path) {
  std::ifstream in(path);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

/// The folder of the peers' files; empty where TALUS_PEERS_DIR is not set.
inline std::string peers_folder() {
  const char* folder = std::getenv("TALUS_PEERS_DIR");
  return folder != nullptr ? folder : "";
}

/// Threads that share a step: TALUS_BENCH_THREADS, else one.
inline int n_threads() {
  const char* n = std::getenv("TALUS_BENCH_THREADS");
  return n != nullptr ? std::max(1, std::atoi(n)) : 1;
}

/// Terrain and the N = 39, 390 or 3,900 blocks. Throws InputError.
inline SlideData read_peers_slide(std::int64_t n) {
  const std::string folder = peers_folder();
  return read_slide(text_of_file(folder + "/terrain_F.asc"),
                    text_of_file(folder + "/blocks_" + std::to_string(n) + ".obj"));
}

}  // namespace talus::bench
