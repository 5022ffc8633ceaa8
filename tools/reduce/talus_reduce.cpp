// tools/reduce/talus_reduce.cpp
// Runs, and parts of runs, to one part. Page: docs/tools/talus-reduce.md
#include <algorithm>
#include <filesystem>

#include "base/memory.hpp"
#include "base/text.hpp"
#include "post/reduce.hpp"
#include "tools/frame/command_line.hpp"
#include "tools/frame/fault_json.hpp"
#include "tools/frame/run_inputs.hpp"
#include "tools/frame/tool.hpp"

namespace {

using namespace talus;  // NOLINT: a program of its own
namespace fs = std::filesystem;

struct Options {
  std::string out;
  double tolerance_m = 0.5;
};

void declare(Tool& tool, Options& o) {
  tool.output("-o,--out", o.out, "part to write (HDF5)").required();
  tool.option("--path-tolerance-m", o.tolerance_m,
              "no point of a block's path lies farther from its simplified path [m]")
      .check(number_between(1e-6, 1e6));
  tool.footer(
      "Example:\n  talus-reduce runs/run_*.h5 --trn bed.tif -o part_1.h5\n"
      "  talus-reduce part_1.h5 part_2.h5 --trn bed.tif -o part.h5");
}

// "runs/run_3.h5": tells runs apart for a reader, independent of the part's place.
std::string name_of(const RunMember& run) {
  const fs::path path = fs::absolute(run.file);
  return (path.parent_path().filename() / path.filename()).string();
}

// Room for `n` more rows. All of them are sorted together.
void make_room(std::vector<PartRow>& rows, std::size_t n, const std::string& file) {
  if (rows.size() + n <= rows.capacity()) return;
  const std::size_t wanted = std::max(rows.size() + n, rows.capacity() + rows.capacity() / 2);
  require_memory(static_cast<double>(wanted) * sizeof(PartRow), {file},
                 std::to_string(wanted) + " rows of passages",
                 "make several parts, each of fewer runs");
  rows.reserve(wanted);
}

void run_tool(Tool& tool, const Options& o, RunInputs& inputs) {
  const Trn& trn = inputs.trn();
  inputs.path_tolerance_m = o.tolerance_m;
  const ReachSettings settings{.tolerance = o.tolerance_m};
  PartBuilder builder;
  std::vector<PartRow> rows;
  inputs.read({.checkpoint = false}, [&](RunFile& run, int index) {
    make_room(rows, run.passages.size(), inputs.members[index].file);
    for (const Passage& passage : run.passages) rows.push_back({index, passage});
    run = without_frames(std::move(run), trn, settings);
    run.health = short_health(run.health);
    add_run(builder, name_of(inputs.members[index]), std::move(run));
  });
  constexpr std::uint64_t most_rows = 1'000'000;
  for (const PartInput& part : inputs.parts())
    for_each_strip(part.file, 1, {}, most_rows, [&](const auto& by_run) {
      for (std::size_t r = 0; r < by_run.size(); ++r) {
        make_room(rows, by_run[r].size(), o.out);
        for (const Passage& passage : by_run[r]) rows.push_back({part.member[r], passage});
      }
    });
  sort_rows(rows);
  write_part_file(tool.stage(o.out), builder.part, rows);
  const RunFaults faults = faults_of(inputs.members);
  if (const std::string words = text(faults); !words.empty()) tool.warn(words);
  tool.metric("runs", n_runs(builder.part), "1");
  tool.metric("passages", static_cast<double>(rows.size()), "1");
  Json result = {{"part", o.out},
                 {"run_set", inputs.run_set()},
                 {"n_runs", n_runs(builder.part)},
                 {"n_passages", rows.size()}};
  add_faults(result, faults);
  tool.result(result, counted(n_runs(builder.part), "run") + ", " +
                          counted(static_cast<std::int64_t>(rows.size()), "passage") + " in " +
                          o.out);
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  Tool tool("talus-reduce", "Runs, and parts of runs, to one part that stands for them.");
  RunInputs runs(tool, RunUse::reduced);
  declare(tool, options);
  return tool.run(argc, argv, [&] { run_tool(tool, options, runs); });
}
