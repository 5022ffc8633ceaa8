// tools/blocks/json.hpp
// Properties of blocks, as talus-blocks writes them to JSON and to the user: volumes, sizes,
// shapes, the cut and its joints.
#pragma once

#include <string>

#include "setup/source_work.hpp"
#include "tools/frame/tool.hpp"

namespace talus {

/// The whole report; without "cut" and "joints" where no source is cut.
[[nodiscard]] Json blocks_json(const BlocksWork& work, const std::string& run_id);

/// The same in short: the lines that go to the terminal.
[[nodiscard]] std::string blocks_summary(const Json& report);

}  // namespace talus
