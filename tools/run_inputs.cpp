#include "run_inputs.hpp"

#include <algorithm>

#include "base/sha256.hpp"
#include "post/deposit.hpp"

namespace talus {

RunInputs::RunInputs(Tool& tool) : tool_(tool) {
  tool.inputs("run", files, "runs written by talus-dda (HDF5), in any order");
  tool.input("--trn", trn_file, "terrain of the runs (GeoTIFF of talus-trn)")->required();
  tool.option("--rest-speed-m-s", rest_speed_m_s,
              "blocks slower than this at the end count as deposited [m/s]");
  tool.flag("--allow-unfinished", allow_unfinished,
            "take runs that have not ended or have failed; every output is marked");
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
  std::vector<RunMember> found;
  for (const std::string& path : paths) {
    found.push_back(member_of(path, read_run_head(path)));
    check_member(found.back(), members.empty() ? found.front() : members.front(), set_options_);
  }
  const std::size_t first = members.size();
  for (const int i : order_by_id(found)) members.push_back(std::move(found[i]));
  read_members(first, parts, [&](RunFile& run, int i) {
    members[i] = member_of(members[i].file, run);
    members[i].n_moving = balance_of(run, rest_speed_m_s).n_moving;
    take(run, i);
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
               "talus-dda a longer --duration-s");
}

std::string RunInputs::remark() const {
  const auto n = std::count_if(members.begin(), members.end(), [](const RunMember& member) {
    return member.info.status != "done";
  });
  if (n == 0) return "";
  const std::string words = std::to_string(n) + " of " + std::to_string(members.size()) +
                            (members.size() == 1 ? " run" : " runs") + " unfinished or failed";
  tool_.warn(words + ": every output says so");
  return words;
}

}  // namespace talus
