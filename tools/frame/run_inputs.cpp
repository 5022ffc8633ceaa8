#include "tools/frame/run_inputs.hpp"

#include <algorithm>
#include <filesystem>

#include "base/sha256.hpp"
#include "post/deposit.hpp"
#include "tools/frame/command_line.hpp"

namespace talus {
namespace {

// Files of runs that are read once and held together, where little of each is wanted: opening them
// again to check them first takes a tenth of the time of all maps.
constexpr std::uintmax_t most_at_once = 200'000'000;  // [bytes]

std::uintmax_t bytes_of(const std::vector<std::string>& paths) {
  std::uintmax_t sum = 0;
  for (const std::string& path : paths) {
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(path, error);
    sum += error ? 0 : size;
  }
  return sum;
}

}  // namespace

RunInputs::RunInputs(Tool& tool) : tool_(tool) {
  tool.inputs("run", files, "runs written by talus-dda (HDF5), in any order");
  tool.input("--trn", trn_file, "terrain of the runs (GeoTIFF of talus-trn)")->required();
  tool.option("--rest-speed-m-s", rest_speed_m_s,
              "blocks slower than this at the end count as deposited [m/s]")
      ->check(number_between(0, 1000));
  tool.flag("--allow-unfinished", allow_unfinished,
            "take runs that were interrupted before their end; every output is marked");
  tool.option("--missing", n_missing,
              "runs that were wanted and are not there: every output says so")
      ->check(number_between(0, 1e9));
}

const Trn& RunInputs::trn() {
  if (has_trn_) return trn_;
  trn_ = read_trn(trn_file);
  has_trn_ = true;
  return trn_;
}

void RunInputs::read(const std::vector<std::string>& paths, const RunParts& parts,
                     const std::function<void(RunFile&, int)>& take) {
  if (set_options_.trn_sha256.empty())
    set_options_ = {allow_unfinished, trn_file, sha256_of_file(trn_file)};
  const bool at_once = parts.only_last_frame && bytes_of(paths) <= most_at_once;
  std::vector<RunMember> found;
  std::vector<RunFile> runs;
  const ProgressFunction progress = tool_.progress();
  for (const std::string& path : paths) {
    RunFile run = at_once ? read_run_file(path, parts) : read_run_head(path);
    found.push_back(member_of(path, run));
    check_member(found.back(), members.empty() ? found.front() : members.front(), set_options_);
    if (!at_once) continue;
    std::vector<HealthRow>().swap(run.health);
    runs.push_back(std::move(run));
    progress(static_cast<double>(runs.size()) / static_cast<double>(paths.size()));
  }
  const std::size_t first = members.size();
  const std::vector<int> order = order_by_id(found);
  for (const int i : order) members.push_back(std::move(found[i]));
  const auto hand_over = [&](RunFile& run, int i) {
    members[i].n_moving = balance_of(run, rest_speed_m_s).n_moving;
    take(run, i);
  };
  if (at_once) {
    for (std::size_t k = 0; k < runs.size(); ++k)
      hand_over(runs[order[k]], static_cast<int>(first + k));
    return;
  }
  read_members(first, parts, [&](RunFile& run, int i) {
    members[i] = member_of(members[i].file, run);
    hand_over(run, i);
  });
}

void RunInputs::read_again(const RunParts& parts, const std::function<void(RunFile&, int)>& take) {
  read_members(0, parts, take);
}

void RunInputs::read_members(std::size_t first, const RunParts& parts,
                             const std::function<void(RunFile&, int)>& take) {
  const ProgressFunction progress = tool_.progress();
  const auto n = static_cast<double>(members.size() - first);
  for (std::size_t i = first; i < members.size(); ++i) {
    progress(static_cast<double>(i - first) / n);
    RunFile run = read_run_file(members[i].file, parts);
    take(run, static_cast<int>(i));
  }
  progress(1);
}

void RunInputs::warn_of_ends() const {
  int moving = 0, released = 0;
  std::int64_t left = 0;
  for (const RunMember& member : members) {
    moving += member.n_moving;
    released += member.n_blocks;
    left += member.left_domain;
  }
  if (left > 0)
    tool_.warn(std::to_string(left) + " of " + std::to_string(released) +
               " blocks left the known terrain: maps and run-out end where it does");
  if (moving > 0)
    tool_.warn(std::to_string(moving) + " of " + std::to_string(released) +
               " blocks were still moving when their runs ended: deposits leave them out; give "
               "talus-dda a longer --duration-s ([solver] duration_s)");
}

std::string RunInputs::run_set() const {
  std::vector<std::string> ids;
  for (std::size_t i = 0; i < files.size(); ++i) ids.push_back(members[i].info.run_id);
  return run_set_id(std::move(ids));
}

std::string RunInputs::remark() const {
  const RunFaults faults = faults_of(members);
  std::string words = text(faults), short_words = headline(faults);
  if (n_missing > 0) {
    const std::string missing = std::to_string(n_missing) + " of " +
                                std::to_string(static_cast<int>(members.size()) + n_missing) +
                                " runs missing";
    for (std::string* all : {&words, &short_words}) *all += (all->empty() ? "" : "; ") + missing;
  }
  if (!words.empty()) tool_.warn(words + ": every output says so");
  return short_words;
}

void mark_layers(std::vector<VectorLayer>& layers, const std::string& remark) {
  if (remark.empty()) return;
  for (VectorLayer& layer : layers) layer.description += " (" + remark + ")";
}

}  // namespace talus
