// tests/tools/run_probe.cpp
// Runs with known answers for the tests of the tools that evaluate runs: single boxes that slide
// straight down a plane (30 degrees, cells of 2 m), recorded by the recorder itself.
//   run-probe DIR N_RUNS [site=NAME] [name=NAME] [version=V] [status=running|failed] [standing=1]
//             [empty=1] [blocks=N] [step=H] [frames=DT] [seed=K] [height=H] [capacity=KJ|none]
//             [hits=stopped|held|broken|pile] [moving=1] [still=N] [still_runs=N] [seeds=FIRST]
//             [objects=watched|drawn] [weight=W] [independent=1] [passages=no] [case=NAME]
//             [share=MAX_FAILED_SHARE] [crs=EPSG:2056]
// Box b of run r (edge 1 m, 2600 kg) starts at rest at x = 11, y = 10 + 6 b and slides with
// a = 3 m/s2 along the slope for 4 s (24 m), then brakes evenly to rest within 2 s (12 m more); its
// speed is that of run 0 times 1 + 0.01 r. Written: DIR/slope.tif, DIR/run_<r>.h5, DIR/site.toml.
// hits: the record of a built fence. Each block that crosses the line touches it with the motion
// of the crossing; then it does not cross (stopped), crosses 0.1 s later with half the energy in a
// panel pushed 100 m (held) or in a broken one (broken), or nothing touches or crosses (pile).
// objects: a house in the path of box 0, a hut in that of box 2, a shed that nothing reaches;
// watched by the runs, or drawn in the site file alone. weight: of each box, events a year.
// independent: as with solver.blocks = "alone". moving: at the end, all of them. still: the first N
// boxes, still_runs: all boxes of the first N runs stay where they are. passages=no: the run did
// not record any. name: of the site file, site: of the runs.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <limits>
#include <map>
#include <numbers>

#include "base/sha256.hpp"
#include "io/crs_gdal.hpp"
#include "io/trn_file_gdal.hpp"
#include "record/run_file.hpp"
#include "site/site.hpp"
#include "unit/record/hand_made.hpp"

namespace {

using namespace talus;
using namespace talus_test;

constexpr double angle = std::numbers::pi / 6;
using Words = std::map<std::string, std::string>;

double number(const Words& words, const std::string& key, double otherwise) {
  const auto at = words.find(key);
  return at == words.end() ? otherwise : std::atof(at->second.c_str());
}
std::string word(const Words& words, const std::string& key, const std::string& otherwise) {
  const auto at = words.find(key);
  return at == words.end() ? otherwise : at->second;
}

Scene make_scene(int n, const std::string& crs) {
  Scene scene;
  scene.ground.trn = trn_of(16, 41, 2, [](double x, double) { return 200 - std::tan(angle) * x; });
  scene.ground.trn.origin =
      crs == "EPSG:2056" ? Vec3(2650000, 1200000, 0) : Vec3(250000, 350000, 0);
  scene.ground.trn.crs_wkt = crs_from_user(crs, "crs");
  for (int b = 0; b < n; ++b) add_box(scene, {1, 1, 1});
  return scene;
}

std::vector<Segment> way_of(int b, double scale, double step) {
  const Vec3 along(std::cos(angle), 0, -std::sin(angle));
  Motion motion;
  motion.pose.position = {11, 10 + 6.0 * b, 200 - std::tan(angle) * 11 + 0.6};
  std::vector<Segment> way;
  const auto go = [&](double t0, double t1, double a) {
    const int n = static_cast<int>(std::lround((t1 - t0) / step));
    for (int i = 0; i < n; ++i) {
      way.push_back(slide(b, motion, t0 + i * step, t0 + (i + 1) * step, a * along, Vec3::Zero()));
      motion = way.back().end;
    }
  };
  go(0, 4, 3 * scale);
  go(4, 6, -6 * scale);
  way.back().end.velocity.setZero();
  return way;
}

RunBlocks blocks_of(const Scene& scene) {
  RunBlocks blocks;
  blocks.mass = scene.blocks.mass;
  blocks.volume = scene.blocks.volume;
  blocks.inertia = scene.blocks.inertia;
  blocks.vertices = scene.blocks.shapes.vertices;
  blocks.vertex_begin = scene.blocks.shapes.vertex_begin;
  for (std::size_t b = 0; b < blocks.mass.size(); ++b) {
    blocks.rest.push_back({{11, 10 + 6.0 * static_cast<double>(b), 194}, Quat::Identity()});
    // corners are numbered 4 x + 2 y + z
    for (const std::array<int, 4>& face :
         {std::array{0, 1, 3, 2}, std::array{4, 6, 7, 5}, std::array{0, 4, 5, 1},
          std::array{2, 3, 7, 6}, std::array{0, 2, 6, 4}, std::array{1, 5, 7, 3}}) {
      for (const int v : face) blocks.face_vertices.push_back(v + blocks.vertex_begin[b]);
      blocks.face_begin.push_back(static_cast<int>(blocks.face_vertices.size()));
    }
    blocks.block_face_begin.push_back(static_cast<int>(blocks.face_begin.size()) - 1);
  }
  return blocks;
}

HealthRow health_at(const Scene& scene, double time, double drop) {
  HealthRow row;
  row.time = time;
  row.steps = 100;
  row.largest_penetration = 0.002;
  const double mass = scene.blocks.mass[0] * static_cast<double>(scene.blocks.mass.size());
  row.potential = -mass * 10 * drop;
  row.friction = mass * 10 * drop;
  return row;
}

std::string site_text(const Words& words) {
  const std::string capacity = word(words, "capacity", "250");
  return "[site]\nname = \"" + word(words, "name", "probe") +
         "\"\n\n[fence.check]\n"
         "line = [[250030, 350004], [250030, 350020]]\n"
         "height_m = " +
         word(words, "height", "3") + "\n" +
         (capacity == "none" ? "" : "capacity_kj = " + capacity + "\n") +
         "post_spacing_m = 8\nactive = false\n" +
         (words.contains("share")
              ? "\n[uncertainty]\nmax_failed_share = " + word(words, "share", "") + "\n"
              : "") +
         (words.contains("objects")
              ? "\n[object.house]\npolygon = [[250030, 350008], [250036, 350008], [250036, "
                "350012], "
                "[250030, 350012]]\nkind = \"house\"\n[object.hut]\nposition_m = [250033, "
                "350022]\nradius_m = 1.5\n[object.shed]\npolygon = [[250062, 350008], [250066, "
                "350008], [250066, 350012]]\n"
              : "");
}

std::vector<RecordObject> objects_of(const Words& words) {
  if (word(words, "objects", "") != "watched") return {};
  return {{"house", "house", {{{{30, 8}, {36, 8}, {36, 12}, {30, 12}}, true}}, 0},
          {"hut", "", {{{{33, 22}}, false}}, 1.5},
          {"shed", "", {{{{62, 8}, {66, 8}, {66, 12}}, true}}, 0}};
}

void record_hits(RunFile& run, const std::string& kind) {
  constexpr double never = std::numeric_limits<double>::infinity();
  std::vector<Crossing> later;
  for (Crossing c : run.crossings) {
    if (c.beside) {
      later.push_back(c);
      continue;
    }
    if (kind == "pile") continue;
    FenceHit hit;
    hit.block = c.block;
    hit.panel = c.segment;
    hit.time = c.time;
    hit.chainage = c.chainage;
    hit.velocity = c.velocity;
    hit.translational_energy = c.translational_energy;
    hit.rotational_energy = c.rotational_energy;
    hit.top_height = c.top_height;
    hit.bottom_height = c.bottom_height;
    run.fence_hits.push_back(hit);
    c.time += 0.1;
    c.translational_energy *= 0.5;
    if (kind != "stopped") later.push_back(c);
  }
  run.crossings = later;
  const double pushed = kind == "held" ? -100 : 0;  // to the right: eastwards
  for (int panel = 0; panel < 2; ++panel)
    run.panels.push_back(
        {0, panel, 250e3, 0, pushed, kind == "broken" ? 0 : never, kind == "broken" ? 0 : -1});
}

RunFile make_run(const Words& words, int r, const std::string& trn_sha256) {
  const Scene scene =
      make_scene(static_cast<int>(number(words, "blocks", 1)), word(words, "crs", "EPSG:31254"));
  const double step = number(words, "step", 0.01), interval = number(words, "frames", 0.1);
  RunFile run;
  run.info.run_id =
      "probe" + std::to_string(100000 + r + 1000 * std::lround(number(words, "seed", 0)));
  run.info.seed = words.contains("seeds") ? r + std::lround(number(words, "seeds", 0)) : 0;
  run.info.version = word(words, "version", "0.1.0");
  run.info.site = word(words, "site", "probe");
  run.info.case_name = word(words, "case", "");
  run.info.crs_wkt = scene.ground.trn.crs_wkt;
  run.info.origin = scene.ground.trn.origin;
  run.info.trn_sha256 = trn_sha256;
  run.info.status = word(words, "status", "done");
  run.info.reason = run.info.status == "failed" ? "a limit was broken" : "";
  run.info.duration = 8;
  run.info.time = run.info.status == "done" ? 8 : 5;
  run.blocks = blocks_of(scene);
  PassageRecorder passages = start_passages(scene, passage_grid(scene.ground.trn, 0), false);
  CrossingRecorder crossings = start_crossings(
      scene, {record_line("check", posts_on_ground(scene.ground.trn, {{30, 4}, {30, 20}}, 8, {}))});
  ObjectRecorder objects = start_objects(scene, objects_of(words));
  FrameSampler sampler = start_frames(scene, interval);
  const double scale = 1 + 0.01 * r;
  const double n_still = number(words, "still", 0), n_still_runs = number(words, "still_runs", 0);
  for (int b = 0; b < n_blocks(scene); ++b) {
    const bool stays = b < n_still || r < n_still_runs;
    const std::vector<Segment> way = way_of(b, stays ? 0 : scale, step);
    record_start(passages, scene, b, way[0].start, 0);
    record_start(sampler, scene, b, way[0].start, Vec6::Zero());
    for (const Segment& segment : way) {
      SegmentMotion motion;
      motion.follow(segment, scene.blocks.inertia[static_cast<std::size_t>(b)]);
      record_passages(passages, scene, motion);
      record_crossings(crossings, scene, segment);
      record_objects(objects, scene, motion);
      record_frames(sampler, scene, motion, Vec6::Zero());
    }
  }
  flush_passages(passages);
  for (const Frame& frame : take_frames(sampler, 6)) append(run.frames, frame, false);
  append(run.frames, last_frame(sampler, 8), false);
  const bool has_passages = word(words, "passages", "") != "no";
  if (has_passages) run.grid = passages.grid;
  if (has_passages && number(words, "empty", 0) == 0) run.passages = sorted(passages.table);
  run.lines = crossings.lines;
  run.lines[0].standing = number(words, "standing", 0) != 0;
  run.info.config = print_config(parse_site(site_text(words), "site.toml"));
  run.crossings = sorted(crossings);
  run.objects = objects.objects;
  run.object_hits = sorted(objects);
  run.info.independent = number(words, "independent", 0) != 0;
  run.info.weights_are_frequencies = words.contains("weight");
  if (words.contains("weight"))
    run.blocks.weight.assign(run.blocks.mass.size(), number(words, "weight", 1));
  if (words.contains("hits")) record_hits(run, words.at("hits"));
  run.health = {health_at(scene, 0, 0), health_at(scene, 8, 18 * scale)};
  run.phase.assign(run.blocks.mass.size(), Phase::asleep);
  if (words.contains("moving")) {
    std::fill(run.phase.begin(), run.phase.end(), Phase::near_ground);
    std::fill(run.frames.velocity.end() - 3 * n_blocks(run), run.frames.velocity.end(), 1.0F);
  }
  return run;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) return 2;
  const std::string folder = argv[1];
  Words words;
  for (int i = 3; i < argc; ++i) {
    const std::string text = argv[i];
    words[text.substr(0, text.find('='))] = text.substr(text.find('=') + 1);
  }
  const Scene scene = make_scene(1, word(words, "crs", "EPSG:31254"));
  Trn trn = scene.ground.trn;
  write_trn(folder + "/slope.tif", trn);
  std::ofstream(folder + "/site.toml") << site_text(words);
  const std::string digest = sha256_of_file(folder + "/slope.tif");
  for (int r = 0; r < std::atoi(argv[2]); ++r)
    write_run_file(folder + "/run_" + std::to_string(r) + ".h5", make_run(words, r, digest));
  return 0;
}
