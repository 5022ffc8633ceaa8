// Runs without frames, and parts of many runs.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "base/error.hpp"
#include "base/random.hpp"
#include "post/reduce.hpp"
#include "run_maker.hpp"

using namespace talus;
using namespace talus::testing;

namespace {

std::string temporary(const std::string& name) {
  return (std::filesystem::path(::testing::TempDir()) / name).string();
}

std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

Trn terrain() {
  Trn trn = plane_trn(0.5, 2, 60, 30);
  for (double& z : trn.elevation) z -= 1;
  return trn;
}

// Two cubes that wander down the slope, no two runs alike.
RunFile random_run(int number, bool tall) {
  Random random(number);
  RunFile run;
  run.info.run_id = "run" + std::to_string(1000 + number);
  run.info.seed = number;
  run.info.independent = number % 2 == 1;
  run.info.weights_are_frequencies = number % 3 == 1;
  run.info.status = "done";
  run.info.config = "seed = " + std::to_string(number) + "\n";
  for (int block = 0; block < 2; ++block) add_box(run, {2, 2, tall ? 3.0 : 2.0}, {0, 0, 0});
  for (int k = 0; k <= 20; ++k) {
    std::vector<FrameBlock> at;
    for (int block = 0; block < 2; ++block) {
      const double x = 10 + 3 * k + random.uniform(-1, 1);
      at.push_back(standing({x, 20 + 10.0 * block + random.uniform(-2, 2), 101 - 0.5 * x}));
      at.back().velocity = {k < 20 ? 3.0 + random.uniform() : 0.0, 0, 0};
    }
    add_frame(run, k, at);
    HealthRow row;
    row.time = k;
    row.steps = 10 + k;
    row.unconverged = k % 3;
    row.largest_penetration = random.uniform();
    row.largest_error = row.largest_penetration / 3;
    row.shortest_dt = k == 0 ? 0 : 0.001 + random.uniform();
    row.left_domain = k / 10;
    row.potential = -1000.0 * k;
    row.friction = 900.0 * k;
    run.health.push_back(row);
  }
  run.phase.assign(2, Phase::asleep);
  run.grid = {Vec2(0, 60), 4, 15, 30};
  for (int block = 0; block < 2; ++block)
    for (int cell = static_cast<int>(random.below(9)); cell < 450;
         cell += 1 + static_cast<int>(random.below(30))) {
      Passage p;
      p.block = block;
      p.cell = cell;
      p.largest.speed = static_cast<float>(random.uniform(0, 20));
      p.first_time = static_cast<float>(random.uniform(0, 20));
      run.passages.push_back(p);
    }
  if (number % 2 == 0) {
    run.lines = {record_line("f", {{30, 0, 80}, {30, 60, 80}})};
    Crossing c;
    c.block = 1;
    c.n_crossings = 1;
    c.time = random.uniform();
    run.crossings = {c};
  }
  return run;
}

// The part of runs, in their order.
std::string part_of(const std::vector<RunFile>& runs, const std::string& name) {
  PartBuilder builder;
  std::vector<PartRow> rows;
  for (const RunFile& run : runs) {
    for (const Passage& p : run.passages) rows.push_back({n_runs(builder.part), p});
    RunFile kept = without_frames(run, terrain(), {});
    kept.health = short_health(kept.health);
    add_run(builder, "runs/" + run.info.run_id + ".h5", std::move(kept));
  }
  sort_rows(rows);
  const std::string path = temporary(name);
  write_part_file(path, builder.part, rows);
  return path;
}

void expect_same(const ReachLine& a, const ReachLine& b) {
  EXPECT_EQ(a.height, b.height);
  EXPECT_EQ(a.path, b.path);
  EXPECT_EQ(a.chord, b.chord);
}

}  // namespace

// Data that replace the frames agree to the last bit.
TEST(WithoutFrames, TellsTheSameReach) {
  for (int number = 0; number < 5; ++number) {
    const RunFile run = random_run(number, false);
    const RunFile kept = without_frames(run, terrain(), {});
    EXPECT_EQ(n_frames(kept.frames), 2);
    const EventReach a = event_reach(run, terrain(), {}), b = event_reach(kept, terrain(), {});
    expect_same(a.event, b.event);
    expect_same(a.centre_of_mass, b.centre_of_mass);
    EXPECT_EQ(a.streamline, b.streamline);
    EXPECT_EQ(a.toe_block, b.toe_block);
    EXPECT_EQ(a.sum_angle, b.sum_angle);
    EXPECT_EQ(a.profile.smallest, b.profile.smallest);
    EXPECT_EQ(a.profile.at_end(), b.profile.at_end());
    EXPECT_EQ(a.moved.p90, b.moved.p90);
    for (int block = 0; block < 2; ++block) {
      expect_same(a.blocks[block].reach, b.blocks[block].reach);
      EXPECT_EQ(a.blocks[block].max_speed, b.blocks[block].max_speed);
      EXPECT_EQ(a.blocks[block].max_energy, b.blocks[block].max_energy);
      EXPECT_EQ(a.blocks[block].fate, b.blocks[block].fate);
    }
    EXPECT_EQ(curves(run).back().centre_of_mass, curves(kept).back().centre_of_mass);
  }
}

TEST(ShortHealth, SaysTheSameOfTheRun) {
  const RunFile run = random_run(3, false);
  RunFile kept = run;
  kept.health = short_health(run.health);
  ASSERT_EQ(kept.health.size(), 2U);
  std::int64_t steps[2] = {0, 0}, unconverged[2] = {0, 0};
  double deepest[2] = {0, 0}, error[2] = {0, 0}, shortest[2] = {1, 1};
  for (int i = 0; i < 2; ++i)
    for (const HealthRow& row : (i == 0 ? run : kept).health) {
      steps[i] += row.steps;
      unconverged[i] += row.unconverged;
      deepest[i] = std::max(deepest[i], row.largest_penetration);
      error[i] = std::max(error[i], row.largest_error);
      if (row.shortest_dt > 0) shortest[i] = std::min(shortest[i], row.shortest_dt);
    }
  EXPECT_EQ(steps[0], steps[1]);
  EXPECT_EQ(unconverged[0], unconverged[1]);
  EXPECT_EQ(deepest[0], deepest[1]);
  EXPECT_EQ(error[0], error[1]);
  EXPECT_EQ(shortest[0], shortest[1]);
  EXPECT_EQ(kept.health.back().left_domain, run.health.back().left_domain);
  EXPECT_EQ(energy_shares(run).friction, energy_shares(kept).friction);
  EXPECT_EQ(short_health(kept.health).size(), 2U);
}

TEST(PartFile, GivesBackItsRuns) {
  std::vector<RunFile> runs;
  for (int number = 0; number < 6; ++number) runs.push_back(random_run(number, number > 3));
  const PartFile file(part_of(runs, "part_a.h5"));
  EXPECT_EQ(file.part.blocks.size(), 2U);  // the flat cubes and the tall ones
  EXPECT_EQ(file.part.lines.size(), 2U);   // a line, and none
  for (int r = 0; r < 6; ++r) {
    const RunFile wanted = without_frames(runs[r], terrain(), {}), got = run_of(file.part, r);
    EXPECT_EQ(got.info.run_id, wanted.info.run_id);
    EXPECT_EQ(got.info.config, wanted.info.config);
    EXPECT_EQ(got.info.seed, wanted.info.seed);
    EXPECT_EQ(got.info.independent, wanted.info.independent);
    EXPECT_EQ(got.info.weights_are_frequencies, wanted.info.weights_are_frequencies);
    EXPECT_EQ(got.blocks.vertices, wanted.blocks.vertices);
    EXPECT_EQ(got.blocks.face_vertices, wanted.blocks.face_vertices);
    EXPECT_EQ(got.blocks.block_face_begin, wanted.blocks.block_face_begin);
    EXPECT_EQ(got.frames.position, wanted.frames.position);
    EXPECT_EQ(got.frames.velocity, wanted.frames.velocity);
    EXPECT_EQ(got.reach->streamline, wanted.reach->streamline);
    EXPECT_EQ(got.lines.size(), wanted.lines.size());
    ASSERT_EQ(got.crossings.size(), wanted.crossings.size());
    for (std::size_t i = 0; i < got.crossings.size(); ++i)
      EXPECT_EQ(got.crossings[i].time, wanted.crossings[i].time);
  }
}

// Whatever strips they are taken in, the rows of a run are all there, and cells are whole.
TEST(PartFile, HandsOverEachPassageOnce) {
  std::vector<RunFile> runs;
  std::size_t n_rows = 0;
  for (int number = 0; number < 6; ++number) {
    runs.push_back(random_run(number, false));
    n_rows += runs.back().passages.size();
  }
  const PartFile file(part_of(runs, "part_strips.h5"));
  for (const int factor : {1, 4})
    for (const std::uint64_t most : {1ULL, 40ULL, 100000ULL}) {
      std::vector<std::size_t> of_run(6, 0);
      for_each_strip(file, factor, {}, most, [&](const auto& by_run) {
        for (std::size_t r = 0; r < by_run.size(); ++r) of_run[r] += by_run[r].size();
      });
      for (int r = 0; r < 6; ++r) EXPECT_EQ(of_run[r], runs[r].passages.size());
    }
  // a tile of larger cells: all rows of these cells
  const MapGrid map = map_grid(runs[0].grid, 16, "");
  std::size_t n = 0;
  for (const MapTile& tile : {MapTile{0, 5}, MapTile{5, 17}, MapTile{17, 32}})
    for_each_strip(file, 4, tile, 30, [&](const auto& by_run) {
      for (std::size_t r = 0; r < by_run.size(); ++r)
        n += map_rows(by_run[r], runs[0].grid, map, {}, tile).size();
    });
  std::size_t wanted = 0;
  for (const RunFile& run : runs) wanted += map_rows(run.passages, run.grid, map, {}).size();
  EXPECT_EQ(n, wanted);
  EXPECT_GT(n_rows, wanted);
}

namespace {

// Block 0 broke into 1 and 2, and 2 was crushed; in the other run nothing broke, though it might.
RunFile broken_run() {
  RunFile run = random_run(1, false);
  run.blocks.body = {1, 2};
  run.blocks.generation = {1, 1};
  Break row;
  row.first_piece = 1;
  row.time = 3.5;
  row.fracture = 12;
  run.breaks = {row};
  CrushedBlock debris;
  debris.block = 1;
  debris.load = 2e6;
  debris.place = {1, 2, 3};
  run.crushed = {debris};
  run.phase = {Phase::asleep, Phase::crushed};
  for (HealthRow& health : run.health) health.breakage = 50 * health.time;
  return run;
}

}  // namespace

TEST(Part, KeepsWhatBrokeAndWhatWasCrushed) {
  RunFile whole = random_run(2, false);
  whole.blocks.body = {0, 1};
  whole.blocks.generation = {0, 0};
  const RunFile broken = broken_run();
  const PartFile part(part_of({broken, whole}, "part_pieces.h5"));
  const RunFile got = run_of(part.part, 0), other = run_of(part.part, 1);
  EXPECT_EQ(got.blocks.body, broken.blocks.body);
  EXPECT_EQ(got.blocks.generation, broken.blocks.generation);
  EXPECT_EQ(got.phase, broken.phase);
  ASSERT_EQ(got.breaks.size(), 1u);
  EXPECT_EQ(got.breaks[0].first_piece, 1);
  EXPECT_EQ(got.breaks[0].time, 3.5);
  EXPECT_EQ(got.breaks[0].fracture, 12);
  ASSERT_EQ(got.crushed.size(), 1u);
  EXPECT_EQ(got.crushed[0].block, 1);
  EXPECT_EQ(got.crushed[0].load, 2e6);
  EXPECT_EQ(got.crushed[0].place, Vec3(1, 2, 3));
  EXPECT_EQ(got.health.back().breakage, broken.health.back().breakage);
  EXPECT_TRUE(other.blocks.body.empty() && other.blocks.generation.empty());
  EXPECT_TRUE(other.breaks.empty() && other.crushed.empty());
}

// The same part by run files without frames, and by a part.
TEST(Part, OfRunsThatBrokeIsTheSameByAnyWay) {
  const std::string direct = part_of({broken_run(), random_run(2, false)}, "part_direct.h5");
  const std::string path = temporary("run_broken_ends.h5");
  write_run_file(path, without_frames(broken_run(), terrain(), {}));
  EXPECT_EQ(bytes_of(part_of({read_run_file(path), random_run(2, false)}, "part_by_file.h5")),
            bytes_of(direct));
}

// Of which block they are pieces is not known where no bodies are numbered.
TEST(RunFile, WithBreaksOfPiecesThatItLacksIsRefused) {
  RunFile run = broken_run();
  run.blocks.body.clear();
  const std::string path = temporary("run_no_bodies.h5");
  write_run_file(path, run);
  EXPECT_THROW((void)read_run_file(path), InputError);
}

TEST(PartFile, IsNotOpenedWhenItIsAnotherFile) {
  const std::string path = temporary("run_alone.h5");
  write_run_file(path, random_run(1, false));
  EXPECT_FALSE(is_part_file(path));
  EXPECT_THROW(PartFile{path}, InputError);
  const std::string part = part_of({random_run(1, false)}, "part_alone.h5");
  EXPECT_TRUE(is_part_file(part));
  EXPECT_THROW((void)read_run_file(part), InputError);
}

// A run that kept no more than its ends says so in its own file too.
TEST(RunFile, KeepsItsReachWithoutFrames) {
  const RunFile run = without_frames(random_run(2, false), terrain(), {});
  const std::string path = temporary("run_ends.h5");
  write_run_file(path, run);
  const RunFile got = read_run_file(path);
  ASSERT_TRUE(got.reach);
  EXPECT_EQ(got.reach->streamline, run.reach->streamline);
  EXPECT_EQ(got.reach->max_energy, run.reach->max_energy);
  expect_same(got.reach->block[1], run.reach->block[1]);
  expect_same(got.reach->centre_of_mass, run.reach->centre_of_mass);
  EXPECT_EQ(bytes_of(part_of({got}, "part_ends.h5")),
            bytes_of(part_of({random_run(2, false)}, "part_whole.h5")));
}
