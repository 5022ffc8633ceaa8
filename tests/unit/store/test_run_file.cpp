// Run files and checkpoints: reading back, parts, damage.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "base/error.hpp"
#include "base/sha256.hpp"
#include "io/h5_hdf5.hpp"
#include "record/passage_rows.hpp"
#include "record/run_file.hpp"
#include "store/checkpoint.hpp"
#include "unit/record/hand_made.hpp"

namespace {

using namespace talus_test;
using talus::RunFile;

std::string temporary(const std::string& name) {
  return (std::filesystem::temp_directory_path() /
          ("talus_run_file_" + std::to_string(::getpid()) + "_" + name))
      .string();
}

// A file removed with its scope.
struct TemporaryFile {
  std::string path;
  explicit TemporaryFile(const std::string& name) : path(temporary(name)) {}
  ~TemporaryFile() { std::filesystem::remove(path); }
};

talus::RunBlocks two_boxes() {
  Scene scene;
  add_box(scene, {1, 2, 3});
  add_box(scene, {2, 2, 2});
  talus::RunBlocks blocks;
  blocks.mass = scene.blocks.mass;
  blocks.volume = scene.blocks.volume;
  blocks.inertia = scene.blocks.inertia;
  blocks.rest.resize(2);
  blocks.rest[1].position = {10, 20, 30};
  blocks.vertex_begin = {0, 8, 16};
  blocks.vertices = scene.blocks.shapes.vertices;
  blocks.face_vertices = {0, 1, 2, 8, 9, 10};
  blocks.face_begin = {0, 3, 6};
  blocks.block_face_begin = {0, 1, 2};
  return blocks;
}

RunFile sample(int n_frames, int n_rows) {
  talus::Random random(7, "run file");
  RunFile run;
  run.info.run_id = "0123456789abcdef";
  run.info.site = "a site with ä";
  run.info.origin = {500000, 5000000, 0};
  run.info.law = "talus";
  run.info.seed = 17;
  run.info.weights_are_frequencies = true;
  run.info.status = "done";
  run.info.duration = 20;
  run.info.time = 20;
  run.info.config = "[solver]\nlaw = \"talus\"\n";
  run.info.plan = "[]";
  run.blocks = two_boxes();
  for (int k = 0; k < n_frames; ++k) {
    talus::Frame frame{0.1 * k, std::vector<talus::FrameBlock>(2)};
    for (talus::FrameBlock& block : frame.blocks) {
      block.position = random_vector(random, 100);
      block.attitude = random_attitude(random);
      block.velocity = random_vector(random, 10);
      block.spin = random_vector(random, 3);
    }
    append(run.frames, frame, false);
  }
  run.grid = {{-5, 95}, 5, 20, 30};
  for (int i = 0; i < n_rows; ++i)
    run.passages.push_back(
        {i % 2, i % 600, {1.5f * static_cast<float>(i), 2, 3, 4, 5}, 0.25f, 0.5f, -3});
  run.lines.push_back(talus::record_line("fence.low", {{0, 0, 1}, {10, 0, 2}, {10, 5, 2}}));
  talus::Crossing crossing;
  crossing.block = 1;
  crossing.segment = 1;
  crossing.n_crossings = 2;
  crossing.velocity = {1, 2, 3};
  crossing.top_height = 4.25;
  run.crossings.push_back(crossing);
  run.health.resize(3);
  run.health[2].unconverged = 5;
  run.health[2].friction = 1e6;
  for (std::size_t k = 0; k < run.health[1].cuts.size(); ++k)
    run.health[1].cuts[k] = 10 + static_cast<std::int64_t>(k);
  run.health[1].largest_error = 0.25;
  run.checkpoint = {1, 2, 3, 255};
  run.phase = {talus::Phase::asleep, talus::Phase::left_domain};
  run.blocks.weight = {1, 0.25};
  run.lines[0].standing = true;
  talus::FenceHit hit;
  hit.block = 1;
  hit.panel = 1;
  hit.velocity = {3, 2, 1};
  hit.energy_after = 7;
  run.fence_hits.push_back(hit);
  run.panels = {{0, 0, std::numeric_limits<double>::infinity(), 0, 0,
                 std::numeric_limits<double>::infinity(), -1},
                {0, 1, 5e5, 5e5, -1.5, 3.25, 1}};
  run.forests = {{"upper", 400}, {"lower", 30}};
  talus::TreeHitRow& tree = run.tree_hits.emplace_back();
  tree.forest = 1;
  tree.stem = 17;
  tree.species = 8;
  tree.foot = {1, 2, 3};
  tree.capacity = 5e4;
  tree.left = 2e4;
  tree.broken_at = std::numeric_limits<double>::infinity();
  tree.hit.block = 1;
  tree.hit.velocity = {3, 2, 1};
  tree.hit.work = 3e4;
  return run;
}

TEST(RunFile, ReadsBackWhatWasWritten) {
  const TemporaryFile file("round.h5");
  const RunFile run = sample(50, 700);
  talus::write_run_file(file.path, run);
  const RunFile back = talus::read_run_file(file.path);
  EXPECT_EQ(back.info.site, run.info.site);
  EXPECT_EQ(back.info.config, run.info.config);
  EXPECT_EQ(back.info.origin, run.info.origin);
  EXPECT_EQ(back.info.seed, 17);
  EXPECT_TRUE(back.info.weights_are_frequencies);
  EXPECT_EQ(back.blocks.mass, run.blocks.mass);
  EXPECT_EQ(back.blocks.vertices, run.blocks.vertices);
  EXPECT_EQ(back.blocks.face_vertices, run.blocks.face_vertices);
  EXPECT_EQ(back.blocks.rest[1].position, run.blocks.rest[1].position);
  EXPECT_EQ(back.frames.time, run.frames.time);
  EXPECT_EQ(back.frames.position, run.frames.position);
  EXPECT_EQ(back.frames.attitude, run.frames.attitude);
  EXPECT_TRUE(back.frames.strain.empty());
  ASSERT_EQ(back.passages.size(), 700u);
  EXPECT_EQ(back.passages[699].block, 1);
  EXPECT_EQ(back.passages[699].cell, 99);
  EXPECT_EQ(back.passages[699].largest.speed, 1.5f * 699);
  EXPECT_EQ(back.passages[699].travel_angle, 0.5f);
  EXPECT_EQ(back.passages[699].heading, -3);
  EXPECT_EQ(back.phase, run.phase);
  EXPECT_EQ(back.blocks.weight, run.blocks.weight);
  EXPECT_TRUE(back.lines[0].standing);
  ASSERT_EQ(back.fence_hits.size(), 1u);
  EXPECT_EQ(back.fence_hits[0].velocity, Vec3(3, 2, 1));
  EXPECT_EQ(back.fence_hits[0].energy_after, 7);
  ASSERT_EQ(back.panels.size(), 2u);
  EXPECT_TRUE(std::isinf(back.panels[0].capacity));
  EXPECT_EQ(back.panels[1].broken_at, 3.25);
  EXPECT_EQ(back.panels[1].broken_by, 1);
  EXPECT_EQ(back.panels[1].rock, -1);
  EXPECT_FALSE(back.info.independent);
  ASSERT_EQ(back.forests.size(), 2u);
  EXPECT_EQ(back.forests[0].name, "upper");
  EXPECT_EQ(back.forests[1].n_stems, 30);
  ASSERT_EQ(back.tree_hits.size(), 1u);
  EXPECT_EQ(back.tree_hits[0].forest, 1);
  EXPECT_EQ(back.tree_hits[0].stem, 17);
  EXPECT_EQ(back.tree_hits[0].species, 8);
  EXPECT_EQ(back.tree_hits[0].foot, Vec3(1, 2, 3));
  EXPECT_EQ(back.tree_hits[0].left, 2e4);
  EXPECT_EQ(back.tree_hits[0].broken_by, -1);
  EXPECT_EQ(back.tree_hits[0].hit.velocity, Vec3(3, 2, 1));
  EXPECT_EQ(back.tree_hits[0].hit.work, 3e4);
  EXPECT_EQ(back.grid.corner, run.grid.corner);
  EXPECT_EQ(back.grid.n_cols, 30);
  ASSERT_EQ(back.lines.size(), 1u);
  EXPECT_EQ(back.lines[0].name, "fence.low");
  EXPECT_EQ(back.lines[0].points, run.lines[0].points);
  ASSERT_EQ(back.crossings.size(), 1u);
  EXPECT_EQ(back.crossings[0].velocity, Vec3(1, 2, 3));
  EXPECT_EQ(back.crossings[0].top_height, 4.25);
  EXPECT_EQ(back.crossings[0].n_crossings, 2);
  EXPECT_EQ(back.health[2].unconverged, 5);
  EXPECT_EQ(back.health[2].friction, 1e6);
  EXPECT_EQ(back.health[1].cuts, run.health[1].cuts);
  EXPECT_EQ(back.health[1].largest_error, 0.25);
  EXPECT_EQ(back.checkpoint, run.checkpoint);
}

// The reasons for which substeps are made again have the same names in the file as in the code.
TEST(RunFile, NamesTheReasonsOfCutsAsTheCodeDoes) {
  const TemporaryFile file("cuts.h5");
  talus::write_run_file(file.path, sample(1, 1));
  const talus::H5Reader reader(file.path);
  for (std::size_t k = 0; k < talus::substep_cut_names.size(); ++k) {
    const auto counts =
        reader.array<std::int64_t>(std::string("health/cut_") + talus::substep_cut_names[k], 1);
    EXPECT_EQ(counts, (std::vector<std::int64_t>{0, 10 + static_cast<std::int64_t>(k), 0}));
  }
}

TEST(RunFile, IsReadInParts) {
  const TemporaryFile file("parts.h5");
  const RunFile run = sample(50, 70);
  talus::write_run_file(file.path, run);
  const RunFile head = talus::read_run_head(file.path);
  EXPECT_EQ(head.info.site, run.info.site);
  EXPECT_EQ(head.info.trn_sha256, run.info.trn_sha256);
  EXPECT_EQ(head.info.config, run.info.config);
  EXPECT_EQ(head.info.plan, run.info.plan);
  EXPECT_EQ(head.grid.n_cols, run.grid.n_cols);
  EXPECT_EQ(n_blocks(head), 0);

  const RunFile last = talus::read_run_file(
      file.path, {.only_last_frame = true, .only_faults = true, .words = false});
  EXPECT_TRUE(last.info.plan.empty());
  EXPECT_EQ(last.health[2].unconverged, 5);
  EXPECT_EQ(last.health[2].friction, 0);
  ASSERT_EQ(n_frames(last.frames), 1);
  EXPECT_EQ(last.frames.time[0], run.frames.time[49]);
  for (int b = 0; b < 2; ++b) {
    const auto found = frame_block(last, 0, b), expected = frame_block(run, 49, b);
    EXPECT_EQ(found.position, expected.position);
    EXPECT_EQ(found.attitude.coeffs(), expected.attitude.coeffs());
    EXPECT_EQ(found.spin, expected.spin);
  }
}

TEST(RunFile, KeepsWhatEachRockLeftOfAPanel) {
  const TemporaryFile file("alone.h5");
  RunFile run = sample(0, 0);
  run.info.independent = true;
  run.panels.push_back({0, 1, 5e5, 2e5, -0.5, std::numeric_limits<double>::infinity(), -1, 1});
  talus::write_run_file(file.path, run);
  const RunFile back = talus::read_run_file(file.path);
  EXPECT_TRUE(back.info.independent);
  ASSERT_EQ(back.panels.size(), 3u);
  EXPECT_EQ(back.panels[1].rock, -1);
  EXPECT_EQ(back.panels[2].rock, 1);
  EXPECT_EQ(back.panels[2].deflection, -0.5);
}

TEST(RunFile, HoldsThousandsOfLinesAndObjects) {
  const TemporaryFile file("many.h5");
  RunFile run = sample(1, 1);
  for (int i = 0; i < 3000; ++i) {
    const double x = i;
    run.lines.push_back(talus::record_line("fence." + std::to_string(i), {{x, 0, 1}, {x, 10, 1}}));
    run.objects.push_back({"hut " + std::to_string(i), "hut", {{{{x, 20}}, false}}, 1});
  }
  talus::write_run_file(file.path, run);
  const RunFile back = talus::read_run_file(file.path);
  ASSERT_EQ(back.lines.size(), run.lines.size());
  EXPECT_EQ(back.lines.back().name, "fence.2999");
  ASSERT_EQ(back.objects.size(), run.objects.size());
  EXPECT_EQ(back.objects.back().name, "hut 2999");
}

TEST(RunFile, HoldsRoofsOverObjectsAndTheirHits) {
  const TemporaryFile file("roofs.h5");
  RunFile run = sample(0, 0);
  const std::vector<Vec2> roof{{0, 0}, {9, 0}, {9, 8}}, other{{9, 0}, {20, 0}, {20, 8}, {9, 8}};
  for (const char* name : {"open", "road"})
    run.objects.push_back({name, "road", {{{{0, 4}, {20, 4}}, false}}, 3});
  run.objects[1].roofs = {roof, other};
  run.roof_hits.push_back({1, 0, 3, 2.5, 2600, 1, {1, 2, 3}, {4, 5, -6}, 6});
  talus::write_run_file(file.path, run);
  const RunFile back = talus::read_run_file(file.path);
  ASSERT_EQ(back.objects.size(), 2u);
  EXPECT_TRUE(back.objects[0].roofs.empty());
  EXPECT_EQ(back.objects[1].roofs, run.objects[1].roofs);
  ASSERT_EQ(back.roof_hits.size(), 1u);
  EXPECT_EQ(back.roof_hits[0].n_hits, 3);
  EXPECT_EQ(back.roof_hits[0].velocity, Vec3(4, 5, -6));
  run.roof_hits[0].line = 99;
  talus::write_run_file(file.path, run);
  EXPECT_THROW((void)talus::read_run_file(file.path), talus::InputError);
}

TEST(RunFile, HoldsARunWithoutRows) {
  const TemporaryFile file("empty.h5");
  RunFile run = sample(0, 0);
  run.crossings.clear();
  run.lines.clear();
  run.panels.clear();
  run.fence_hits.clear();
  run.health.clear();
  run.checkpoint.clear();
  run.grid = {};
  talus::write_run_file(file.path, run);
  const RunFile back = talus::read_run_file(file.path);
  EXPECT_EQ(n_frames(back.frames), 0);
  EXPECT_TRUE(back.passages.empty());
  EXPECT_TRUE(back.lines.empty());
  EXPECT_EQ(n_blocks(back), 2);
}

// Runs without blocks that were deep have no such table, as older ones.
TEST(RunFile, KeepsTheBlocksThatWereDeep) {
  const TemporaryFile file("deep.h5");
  RunFile run = sample(2, 3);
  talus::write_run_file(file.path, run);
  EXPECT_TRUE(talus::read_run_file(file.path).deep.empty());
  talus::DeepRow row;
  row.block = 1;
  row.partner = 0;
  row.steps = 12;
  row.depth = 0.17;
  row.place = {1, 2, 3};
  row.ends_in_toe = 1;
  run.deep = {row};
  talus::write_run_file(file.path, run);
  const RunFile back = talus::read_run_file(file.path);
  ASSERT_EQ(back.deep.size(), 1u);
  EXPECT_EQ(back.deep[0].partner, 0);
  EXPECT_EQ(back.deep[0].steps, 12);
  EXPECT_EQ(back.deep[0].place, talus::Vec3(1, 2, 3));
  EXPECT_EQ(back.deep[0].ends_in_toe, 1);
  run.deep[0].block = 2;
  talus::write_run_file(file.path, run);
  EXPECT_THROW((void)talus::read_run_file(file.path), talus::InputError);
}

TEST(RunFile, OfEqualContentHasEqualBytes) {
  const TemporaryFile one("one.h5"), other("other.h5");
  talus::write_run_file(one.path, sample(200, 5000));
  talus::write_run_file(other.path, talus::read_run_file(one.path));
  EXPECT_EQ(talus::sha256_of_file(one.path), talus::sha256_of_file(other.path));
}

// More rows than a piece that is read at once, and than a chunk of the file.
TEST(RunFile, HasTheSameBytesWhereItsFirstPassagesAreInAnotherFile) {
  const TemporaryFile one("whole.h5"), other("parted.h5");
  RunFile run = sample(2, 40000);
  talus::write_run_file(one.path, run);
  talus::PassageRows earlier(testing::TempDir());
  const std::vector<talus::Passage> all = run.passages;
  earlier.append({all.begin(), all.begin() + 7000});
  earlier.append({all.begin() + 7000, all.begin() + 39000});
  run.passages.assign(all.begin() + 39000, all.end());
  talus::write_run_file(other.path, run, &earlier);
  EXPECT_EQ(talus::sha256_of_file(one.path), talus::sha256_of_file(other.path));
}

TEST(RunFile, IsReplacedAsAWhole) {
  const TemporaryFile file("replaced.h5");
  talus::replace_run_file(file.path, sample(1, 1));
  talus::replace_run_file(file.path, sample(2, 2));
  EXPECT_EQ(talus::read_run_file(file.path).passages.size(), 2u);
  EXPECT_FALSE(std::filesystem::exists(file.path + ".new"));
}

TEST(RunFile, ThatContradictsItselfIsRefused) {
  const TemporaryFile file("wrong.h5");
  int n = 0;
  const auto refuses = [&](auto&& change) {
    SCOPED_TRACE(++n);
    RunFile run = sample(3, 10);
    change(run);
    talus::write_run_file(file.path, run);
    EXPECT_THROW((void)talus::read_run_file(file.path), talus::InputError);
  };
  refuses([](RunFile& run) { run.passages[3].block = 2; });
  refuses([](RunFile& run) { run.passages[3].cell = 600; });
  refuses([](RunFile& run) { run.passages[3].cell = -1; });
  refuses([](RunFile& run) { run.crossings[0].segment = 2; });
  refuses([](RunFile& run) { run.crossings[0].line = 1; });
  refuses([](RunFile& run) { run.blocks.vertex_begin[1] = 17; });
  refuses([](RunFile& run) { run.blocks.face_vertices[0] = 16; });
  refuses([](RunFile& run) { run.info.origin.x() = std::nan(""); });
}

TEST(RunFile, ThatIsDamagedIsRefusedOrRead) {
  const TemporaryFile whole("whole.h5"), damaged("damaged.h5");
  talus::write_run_file(whole.path, sample(30, 300));
  std::ifstream in(whole.path, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  const auto try_bytes = [&](const std::string& content) {
    std::ofstream(damaged.path, std::ios::binary) << content;
    try {
      (void)talus::read_run_file(damaged.path);
      return true;
    } catch (const talus::InputError&) {
      return false;
    }
  };
  talus::Random random(5, "damage");
  int n_refused = 0;
  for (int i = 0; i < 300; ++i) {
    std::string content = bytes;
    for (int k = 0; k <= i % 4; ++k)
      content[random.below(content.size())] = static_cast<char>(random.below(256));
    n_refused += try_bytes(content) ? 0 : 1;
  }
  EXPECT_GT(n_refused, 290);  // all but those where chance put back the same value
  for (const double share : {0.0, 0.001, 0.3, 0.9, 0.999})
    EXPECT_FALSE(try_bytes(
        bytes.substr(0, static_cast<std::size_t>(share * static_cast<double>(bytes.size())))));
  EXPECT_FALSE(try_bytes("not an HDF5 file"));
}

TEST(RunFile, ThatCannotBeWrittenSaysWhy) {
  try {
    talus::write_run_file("/dev/full", sample(1, 1));
    FAIL() << "a full disk went unseen";
  } catch (const talus::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("No space left"), std::string::npos) << error.what();
  }
}

// --- checkpoint --------------------------------------------------------------------------------

talus::Checkpoint sample_checkpoint() {
  talus::Checkpoint checkpoint;
  talus::State& state = checkpoint.state;
  state.time = 1.25;
  state.motion.resize(2);
  state.motion[1].velocity = {1, 2, 3};
  state.motion[1].pose.attitude = Quat(0.5, 0.5, -0.5, 0.5);
  state.local_time = {1, 1.25};
  state.flight_end = {2, 0};
  state.phase = {talus::Phase::flight, talus::Phase::near_ground};
  state.acceleration.resize(2, Vec3::Ones());
  state.spin_rate.resize(2, Vec3::Zero());
  state.support = {Vec3(1, 2, 3), Vec3(4, 5, 6)};
  state.rest_pose.resize(2);
  state.rest_steps = {0, 7};
  state.deep.resize(2);
  state.deep[1].steps = 12;
  state.deep[1].depth = 0.17;
  state.memory.resize(2);
  state.memory[1].resize(3);
  state.memory[1][2].key.feature_a = 42;
  state.memory[1][2].normal_force = 1e-300;
  state.mass.resize(2);
  state.pressure = {1, 0.25, 0};
  state.ledger.water = 17;
  state.mass[1] = {.is_in_mass = true, .calm = 3, .unsettled = 4, .barred = 5};
  state.counters.impacts = 99;
  checkpoint.trackers.resize(2);
  checkpoint.trackers[0].covered = {5, 6, 7};
  checkpoint.trackers[0].margin = 0.125;
  checkpoint.sampler.interval = 0.1;
  checkpoint.sampler.next = {12, 13};
  checkpoint.sampler.latest.resize(2);
  checkpoint.sampler.open.push_back({1.2, std::vector<talus::FrameBlock>(2)});
  checkpoint.interval.passes = 1234;
  return checkpoint;
}

TEST(Checkpoint, ReadsBackToTheBit) {
  const auto bytes = talus::pack(sample_checkpoint());
  const talus::Checkpoint back = talus::unpack(bytes, 2, 8, "file");
  EXPECT_EQ(talus::pack(back), bytes);
  EXPECT_EQ(back.state.memory[1][2].normal_force, 1e-300);
  EXPECT_EQ(back.state.support[1], Vec3(4, 5, 6));
  EXPECT_EQ(back.state.counters.impacts, 99);
  EXPECT_EQ(back.state.pressure, (std::vector<double>{1, 0.25, 0}));
  EXPECT_EQ(back.state.ledger.water, 17);
  EXPECT_TRUE(back.state.mass[1].is_in_mass);
  EXPECT_EQ(back.state.mass[1].barred, 5);
  EXPECT_EQ(back.state.deep[1].steps, 12);
  EXPECT_EQ(back.state.deep[1].depth, 0.17);
  EXPECT_EQ(back.trackers[0].covered, (std::vector<int>{5, 6, 7}));
  EXPECT_EQ(back.interval.passes, 1234);
  EXPECT_EQ(back.sampler.open.size(), 1u);
}

TEST(Checkpoint, OfAnotherSceneOrDamagedIsRefused) {
  const auto bytes = talus::pack(sample_checkpoint());
  EXPECT_THROW((void)talus::unpack(bytes, 3, 8, "file"), talus::InputError);
  EXPECT_THROW((void)talus::unpack(bytes, 2, 7, "file"), talus::InputError);
  EXPECT_THROW((void)talus::unpack({}, 2, 8, "file"), talus::InputError);
  for (std::size_t i = 0; i < bytes.size(); i += 37) {
    auto damaged = bytes;
    damaged[i] ^= 0x40;
    EXPECT_THROW((void)talus::unpack(damaged, 2, 8, "file"), talus::InputError) << i;
  }
}

}  // namespace
