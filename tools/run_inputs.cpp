#include "run_inputs.hpp"

#include <algorithm>

#include "base/sha256.hpp"

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
  const ProgressFunction progress = tool_.progress();
  for (std::size_t i = 0; i < paths.size(); ++i) {
    progress(static_cast<double>(i) / static_cast<double>(paths.size()));
    RunFile run = read_run_file(paths[i], parts);
    members.push_back(member_of(paths[i], run));
    check_member(members.back(), members.front(), set_options_);
    take(run, static_cast<int>(members.size()) - 1);
  }
  progress(1);
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
