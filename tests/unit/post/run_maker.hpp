// tests/unit/post/run_maker.hpp
// Runs made by hand, with answers known beforehand.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "ensemble/clusters.hpp"
#include "geometry/polyhedron.hpp"
#include "post/deposit.hpp"
#include "record/run_file.hpp"
#include "terrain/trn.hpp"

namespace talus::testing {

/// A plane that falls by `slope` (m/m) towards +x, z = 100 at x = 0; nodes from (0, 0) to the east
/// and (south to north) up to y = size_y.
inline Trn plane_trn(double slope, double cell_size, int n_cols, int n_rows) {
  Trn trn;
  trn.n_rows = n_rows;
  trn.n_cols = n_cols;
  trn.cell_size = cell_size;
  trn.node0 = Vec2(0, (n_rows - 1) * cell_size);
  trn.origin = Vec3(1000, 2000, 0);
  for (int r = 0; r < n_rows; ++r)
    for (int c = 0; c < n_cols; ++c) trn.elevation.push_back(100 - slope * c * cell_size);
  return trn;
}

/// Adds a box with edges `size` and density 2000, its rest pose at `centre`.
inline void add_box(RunFile& run, const Vec3& size, const Vec3& centre) {
  RunBlocks& b = run.blocks;
  const double volume = size.prod(), mass = 2000 * volume;
  b.volume.push_back(volume);
  b.mass.push_back(mass);
  const Vec3 sq = size.cwiseAbs2();
  b.inertia.emplace_back(mass / 12 * Vec3(sq.y() + sq.z(), sq.x() + sq.z(), sq.x() + sq.y()));
  b.rest.push_back({centre, Quat::Identity()});
  const Polyhedron shell = box(-0.5 * size, 0.5 * size);
  const int first = b.vertex_begin.back();
  b.vertices.insert(b.vertices.end(), shell.vertices.begin(), shell.vertices.end());
  b.vertex_begin.push_back(static_cast<int>(b.vertices.size()));
  for (int f = 0; f < n_faces(shell); ++f) {
    for (const int v : face(shell, f)) b.face_vertices.push_back(first + v);
    b.face_begin.push_back(static_cast<int>(b.face_vertices.size()));
  }
  b.block_face_begin.push_back(static_cast<int>(b.face_begin.size()) - 1);
}

/// Adds a frame; one entry of `at` a block.
inline void add_frame(RunFile& run, double time, const std::vector<FrameBlock>& at) {
  Frame frame;
  frame.time = time;
  frame.blocks = at;
  append(run.frames, frame, false);
}

inline FrameBlock standing(const Vec3& position) {
  FrameBlock at;
  at.position = position;
  return at;
}

/// Clusters of runs that released these weights in `n_blocks` blocks each. `mass`: the rock mass
/// that each moved; empty: there is one. `run_weight`: empty: 1 each.
inline Clusters clusters_of_runs(const std::vector<double>& weight, int n_blocks,
                                 const std::vector<int>& mass = {},
                                 const std::vector<double>& run_weight = {}) {
  std::vector<RunMember> runs(weight.size());
  for (std::size_t r = 0; r < runs.size(); ++r) {
    runs[r].weight = weight[r];
    runs[r].n_blocks = runs[r].n_released = n_blocks;
    if (!run_weight.empty()) runs[r].run_weight = run_weight[r];
    if (!mass.empty()) {
      runs[r].info.terrain_digest = "before the slide";
      runs[r].info.blocks_hash = std::to_string(mass[r]);
    }
  }
  return clusters_of(runs);
}

}  // namespace talus::testing
