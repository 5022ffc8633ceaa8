// tools/frame/tool_description.hpp
// Options and outputs of a tool, for programs that call it (--describe json): dialogs, completions.
#pragma once

#include <string>

#include "tools/frame/tool_options.hpp"

namespace talus {

/// Name, version, purpose and options, in the order of --help; those of sub-commands apart. The
/// page docs/tools/common.md explains the members.
[[nodiscard]] Json description_of(const std::string& tool, const CLI::App& app,
                                  const ToolOptions& options);

}  // namespace talus
