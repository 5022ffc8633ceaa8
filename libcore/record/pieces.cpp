// Replaces the bodies of a run that broke by the pieces at its end.
#include "record/pieces.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "record/passage_table.hpp"

namespace talus {
namespace {

using std::size_t;

/// Bodies at the end, and the fate of the rest.
struct Lineage {
  std::vector<int> bodies;               ///< that are there at the end, ascending        (n_left)
  std::vector<double> born;              ///< -infinity: released [s]                     (n_bodies)
  std::vector<std::vector<int>> pieces;  ///< rows of `bodies` that were part of a body   (n_bodies)
  std::vector<int> largest;              ///< of these, -1: none                          (n_bodies)
};

Lineage lineage_of(const RunFile& run) {
  const auto n = static_cast<size_t>(n_blocks(run));
  Lineage out;
  out.born.assign(n, -std::numeric_limits<double>::infinity());
  out.pieces.resize(n);
  out.largest.assign(n, -1);
  for (const Break& broken : run.breaks)
    for (const int piece : {broken.first_piece, broken.first_piece + 1})
      out.born[static_cast<size_t>(piece)] = broken.time;
  for (size_t b = 0; b < n; ++b) {
    if (!exists(run.phase[b])) continue;
    const int row = static_cast<int>(out.bodies.size());
    out.bodies.push_back(static_cast<int>(b));
    for (int of = static_cast<int>(b); of >= 0; of = run.blocks.parent[of]) {
      out.pieces[of].push_back(row);
      int& largest = out.largest[of];
      if (largest < 0 || run.blocks.volume[b] > run.blocks.volume[out.bodies[largest]])
        largest = row;
    }
  }
  return out;
}

template <class Value>
void keep(const std::vector<int>& bodies, std::vector<Value>& values) {
  if (values.empty()) return;
  std::vector<Value> kept;
  for (const int b : bodies) kept.push_back(values[b]);
  values = std::move(kept);
}

void keep_faces(const std::vector<int>& bodies, RunBlocks& blocks) {
  RunBlocks kept;
  for (const int b : bodies) {
    const int shift = static_cast<int>(kept.vertices.size()) - blocks.vertex_begin[b];
    for (int v = blocks.vertex_begin[b]; v < blocks.vertex_begin[b + 1]; ++v)
      kept.vertices.push_back(blocks.vertices[v]);
    kept.vertex_begin.push_back(static_cast<int>(kept.vertices.size()));
    for (int f = blocks.block_face_begin[b]; f < blocks.block_face_begin[b + 1]; ++f) {
      for (int k = blocks.face_begin[f]; k < blocks.face_begin[f + 1]; ++k)
        kept.face_vertices.push_back(blocks.face_vertices[k] + shift);
      kept.face_begin.push_back(static_cast<int>(kept.face_vertices.size()));
    }
    kept.block_face_begin.push_back(static_cast<int>(kept.face_begin.size()) - 1);
  }
  blocks.vertices = std::move(kept.vertices);
  blocks.vertex_begin = std::move(kept.vertex_begin);
  blocks.face_vertices = std::move(kept.face_vertices);
  blocks.face_begin = std::move(kept.face_begin);
  blocks.block_face_begin = std::move(kept.block_face_begin);
}

// Where a body is in a frame in which another one, that it is part of, is known.
FrameBlock carried(const Pose& rest, const Pose& rest_of_whole, const FrameBlock& whole) {
  const Quat turn = whole.attitude * rest_of_whole.attitude.conjugate();
  FrameBlock out = whole;
  const Vec3 arm = turn * (rest.position - rest_of_whole.position);
  out.position += arm;
  out.attitude = (turn * rest.attitude).normalized();
  if (out.attitude.w() < 0) out.attitude.coeffs() = -out.attitude.coeffs();
  out.velocity += whole.spin.cross(arm);
  return out;
}

void merge_frames(const Lineage& lineage, RunFile& run) {
  RunFrames merged;
  const bool with_strain = !run.frames.strain.empty();
  for (int k = 0; k < n_frames(run.frames); ++k) {
    Frame frame;
    frame.time = run.frames.time[static_cast<size_t>(k)];
    for (const int b : lineage.bodies) {
      int whole = b;
      while (lineage.born[static_cast<size_t>(whole)] > frame.time)
        whole = run.blocks.parent[whole];
      const FrameBlock at = frame_block(run, k, whole);
      frame.blocks.push_back(whole == b ? at
                                        : carried(run.blocks.rest[b], run.blocks.rest[whole], at));
    }
    append(merged, frame, with_strain);
  }
  run.frames = std::move(merged);
}

void merge_passages(const Lineage& lineage, RunFile& run) {
  PassageTable table;
  for (Passage row : run.passages)
    for (const int piece : lineage.pieces[static_cast<size_t>(row.block)]) {
      Passage of_piece = row;
      of_piece.block = piece;
      table.raise(of_piece);
    }
  run.passages = sorted(table);
}

// Of two crossings of one line the first of the line itself, else the first beside it.
void add_later(const Crossing& later, Crossing& first) {
  const bool takes_over = first.beside && !later.beside;
  const std::int32_t n = first.n_crossings + later.n_crossings;
  if (takes_over || (first.beside == later.beside && later.time < first.time)) first = later;
  first.n_crossings = n;
}

void merge_crossings(const Lineage& lineage, RunFile& run) {
  std::map<std::pair<std::int32_t, std::int32_t>, Crossing> rows;  // by line, then block
  for (const Crossing& row : run.crossings)
    for (const int piece : lineage.pieces[static_cast<size_t>(row.block)]) {
      Crossing of_piece = row;
      of_piece.block = piece;
      const auto [at, is_new] = rows.try_emplace({row.line, piece}, of_piece);
      if (!is_new) add_later(of_piece, at->second);
    }
  run.crossings.clear();
  for (const auto& [key, row] : rows) run.crossings.push_back(row);
}

void merge_object_hits(const Lineage& lineage, RunFile& run) {
  std::map<std::pair<std::int32_t, std::int32_t>, ObjectHit> rows;  // by object, then block
  for (const ObjectHit& row : run.object_hits)
    for (const int piece : lineage.pieces[static_cast<size_t>(row.block)]) {
      ObjectHit of_piece = row;
      of_piece.block = piece;
      const auto [at, is_new] = rows.try_emplace({row.object, piece}, of_piece);
      if (!is_new) at->second = joined(at->second, of_piece);
    }
  run.object_hits.clear();
  for (const auto& [key, row] : rows) run.object_hits.push_back(row);
}

// Rows of one body alone (hits, breaks, deep rows) become those of the largest of its pieces.
void rename_alone(const Lineage& lineage, RunFile& run) {
  const auto rename = [&lineage](std::int32_t& block) {
    if (block >= 0) block = lineage.largest[static_cast<size_t>(block)];
  };
  for (RoofHit& row : run.roof_hits) rename(row.block);
  for (FenceHit& row : run.fence_hits) rename(row.block);
  for (PanelRow& row : run.panels) rename(row.broken_by);
  for (TreeHitRow& row : run.tree_hits) rename(row.hit.block), rename(row.broken_by);
  for (CrushedBlock& row : run.crushed) rename(row.block);
  for (DeepRow& row : run.deep) rename(row.block), rename(row.partner);
}

}  // namespace

void merge_pieces(RunFile& run) {
  if (run.blocks.parent.empty() || run.phase.empty()) return;
  const Lineage lineage = lineage_of(run);
  merge_frames(lineage, run);
  merge_passages(lineage, run);
  merge_crossings(lineage, run);
  merge_object_hits(lineage, run);
  rename_alone(lineage, run);
  RunBlocks& blocks = run.blocks;
  keep_faces(lineage.bodies, blocks);
  keep(lineage.bodies, blocks.mass);
  keep(lineage.bodies, blocks.volume);
  keep(lineage.bodies, blocks.weight);
  keep(lineage.bodies, blocks.inertia);
  keep(lineage.bodies, blocks.rest);
  keep(lineage.bodies, blocks.generation);
  keep(lineage.bodies, run.phase);
  blocks.body = lineage.bodies;
  blocks.parent.clear();
}

std::vector<int> released_of(const RunFile& run) {
  std::vector<int> released_block(run.blocks.mass.size());
  std::map<int, int> released;  // of pieces
  for (const Break& broken : run.breaks)
    for (const int piece : {broken.first_piece, broken.first_piece + 1})
      released[piece] = broken.released;
  for (size_t b = 0; b < released_block.size(); ++b) {
    const int body = run.blocks.body.empty() ? static_cast<int>(b) : run.blocks.body[b];
    const auto found = released.find(body);
    released_block[b] = found == released.end() ? body : found->second;
  }
  return released_block;
}

std::vector<int> worlds_of(const RunFile& run) {
  return run.info.independent ? released_of(run) : std::vector<int>(run.blocks.mass.size(), 0);
}

int count_different(const std::vector<int>& numbers) {
  return static_cast<int>(std::set<int>(numbers.begin(), numbers.end()).size());
}

}  // namespace talus
