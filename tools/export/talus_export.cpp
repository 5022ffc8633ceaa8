// tools/export/talus_export.cpp
// Blocks of a run as a file that other programs open. Page: docs/tools/talus-export.md
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include "base/memory.hpp"
#include "base/sha256.hpp"
#include "base/text.hpp"
#include "ensemble/run_set.hpp"
#include "import/dem_gdal.hpp"
#include "io/block_scene.hpp"
#include "io/blocks_hdf5.hpp"
#include "io/trn_digest.hpp"
#include "store/xdmf_hdf5.hpp"
#include "tools/frame/command_line.hpp"
#include "tools/frame/tool.hpp"

namespace {

using namespace talus;  // NOLINT: a program of its own
namespace fs = std::filesystem;

struct Options {
  std::string file, out, trn;
  double time_s = std::nan("");
};

constexpr const char* xdmf = ".xmf";
const std::map<std::string, void (*)(const std::string&, const BlockScene&)> formats = {
    {".ply", write_ply}, {".obj", write_obj}, {".glb", write_glb}, {".vtp", write_vtp}};

std::string ending_of(const Options& o) {
  const std::string ending = lower(fs::path(o.out).extension().string());
  if (ending != xdmf && !formats.contains(ending))
    throw UsageError(
        {"", 0, "--out"}, "is " + o.out + ", expected a name in .ply, .obj, .glb, .vtp or .xmf",
        "the ending says the format; docs/tools/talus-export.md says what opens which");
  if (ending == xdmf && !(o.trn.empty() && std::isnan(o.time_s)))
    throw UsageError({"", 0, "--out"}, "is XDMF, which holds all frames of the blocks alone",
                     "leave --trn and --time-s away, or write .vtp");
  return ending;
}

// The frame nearest to a time; the last one where none is given.
int frame_at(const RunFile& run, const Options& o) {
  const std::vector<double>& times = run.frames.time;
  if (times.empty()) throw InputError({o.file}, "has no frames", "compute the run again");
  const int last = n_frames(run.frames) - 1;
  if (std::isnan(o.time_s)) return last;
  const std::string range = "0 to " + text(times.back(), 6) + " s";
  if (!(o.time_s >= 0 && o.time_s <= times.back()))
    throw InputError({"", 0, "--time-s"}, "is " + text(o.time_s) + ", expected " + range,
                     "the run has no other frames");
  int nearest = 0;
  for (int k = 1; k <= last; ++k)
    if (std::abs(times[k] - o.time_s) <= std::abs(times[nearest] - o.time_s)) nearest = k;
  if (run.reach && times[nearest] != o.time_s)
    throw InputError({o.file}, "has no frames between its first and its last, " + range,
                     "compute the run with [output] frames = true");
  return nearest;
}

SceneBody body_of(const RunFile& run, int frame, int b) {
  const RunBlocks& blocks = run.blocks;
  const FrameBlock at = frame_block(run, frame, b);
  const int first = blocks.vertex_begin[b];
  Polyhedron shell;
  shell.vertices.assign(blocks.vertices.begin() + first,
                        blocks.vertices.begin() + blocks.vertex_begin[b + 1]);
  for (int f = blocks.block_face_begin[b]; f < blocks.block_face_begin[b + 1]; ++f) {
    std::vector<int> corners;
    for (int k = blocks.face_begin[f]; k < blocks.face_begin[f + 1]; ++k)
      corners.push_back(blocks.face_vertices[k] - first);
    add_face(shell, corners, 0);
  }
  return {connected_surfaces(std::move(shell)),
          {at.position, at.attitude},
          blocks.volume[b],
          at.velocity.norm()};
}

void check_terrain(const Trn& trn, const RunFile& run, const Options& o) {
  const RunMember member = member_of(o.file, run);
  check_member(member, member, {o.trn, sha256_of_file(o.trn), trn_digest(trn)});
}

void check_terrain(const Trn& trn, const BlockSet& set, const Options& o) {
  const auto& known = set.ground_digests;
  if (std::find(known.begin(), known.end(), trn_digest(trn)) == known.end())
    throw InputError({o.trn}, "is not the terrain that " + o.file + " was made for",
                     "give the terrain that talus-blocks was given, or its --trn-out");
}

// Common part of runs and block sets.
template <class Blocks>
BlockScene scene_of(const Blocks& blocks, const Vec3& origin, const std::string& crs_wkt,
                    const Options& o) {
  BlockScene scene;
  scene.origin = origin;
  scene.crs_wkt = crs_wkt;
  if (o.trn.empty()) return scene;
  const Trn trn = read_trn(o.trn);
  check_terrain(trn, blocks, o);
  constexpr double bytes_per_node = 600;  // with two triangles, in memory and as a file
  require_memory(bytes_per_node * static_cast<double>(trn.elevation.size()), {o.trn},
                 counted(static_cast<std::int64_t>(trn.elevation.size()), "node"),
                 "leave --trn away; the terrain is a raster that other programs open");
  scene.ground.push_back(ground_body(trn, origin));
  return scene;
}

BlockScene blocks_at_rest(const Options& o) {
  if (!std::isnan(o.time_s))
    throw UsageError({"", 0, "--time-s"}, "is given, but " + o.file + " holds blocks at rest",
                     "give a run of talus-dda, or omit it");
  const BlockSet set = read_blocks(o.file);
  BlockScene scene = scene_of(set, set.origin, set.crs_wkt, o);
  scene.source = "Talus, blocks " + set.content_hash;
  for (int b = 0; b < n_blocks(set); ++b)
    scene.blocks.push_back({block_surfaces(set, b), {}, set.volume[b], set.velocity[b].norm()});
  return scene;
}

BlockScene moment_of(const RunFile& run, const Options& o) {
  const int frame = frame_at(run, o);
  BlockScene scene = scene_of(run, run.info.origin, run.info.crs_wkt, o);
  scene.source = "Talus " + run.info.version + ", run " + run.info.run_id;
  scene.time = run.frames.time[frame];
  for (int b = 0; b < n_blocks(run); ++b) scene.blocks.push_back(body_of(run, frame, b));
  return scene;
}

RunFile read_run(const Options& o) {
  return read_run_file(o.file, {.passages = false,
                                .crossings = false,
                                .health = false,
                                .checkpoint = false,
                                .objects = false,
                                .words = false,
                                .trees = false});
}

void export_moment(Tool& tool, const Options& o, const std::string& ending) {
  const BlockScene scene = is_block_set(o.file) ? blocks_at_rest(o) : moment_of(read_run(o), o);
  formats.at(ending)(tool.stage(o.out), scene);
  const auto n = static_cast<std::int64_t>(scene.blocks.size());
  tool.result({{"out", o.out}, {"n_blocks", n}, {"time_s", scene.time}},
              counted(n, "block") + " at " + text(scene.time, 6) + " s in " + o.out);
}

void export_frames(Tool& tool, const Options& o) {
  const fs::path data = fs::path(o.out).replace_extension(".xdmf.h5");
  tool.write_also(data.string());
  const RunFile run = read_run(o);
  write_xdmf(tool.stage(o.out), tool.stage(data.string()), data.filename().string(), run);
  tool.result({{"out", o.out}, {"n_blocks", n_blocks(run)}, {"n_frames", n_frames(run.frames)}},
              counted(n_blocks(run), "block") + ", " + counted(n_frames(run.frames), "frame") +
                  " in " + o.out);
}

}  // namespace

int main(int argc, char** argv) {
  Options o;
  Tool tool("talus-export", "Blocks of a run as a file that other programs open.");
  tool.input("RUN.h5|BLOCKS.h5", o.file,
             "run of talus-dda, or blocks at rest of talus-blocks (HDF5)");
  tool.output("-o,--out", o.out,
              "PLY, OBJ, GLB, VTP of one moment, or XDMF of all frames, by its ending")
      .required();
  tool.input("--trn", o.trn, "terrain of the runs (GeoTIFF of talus-trn)");
  tool.option("--time-s", o.time_s,
              "moment, of which the nearest frame is taken [s]; nan: the end");
  tool.footer(
      "Example:\n  talus-export run_1.h5 --trn bed.tif -o deposit.glb\n"
      "With --trn the terrain is in the file too.");
  return tool.run(argc, argv, [&] {
    const std::string ending = ending_of(o);
    if (ending == xdmf)
      export_frames(tool, o);
    else
      export_moment(tool, o, ending);
  });
}
