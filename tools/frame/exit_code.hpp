// tools/frame/exit_code.hpp
// Exit codes of the tools. docs/tools/common.md
#pragma once

namespace talus {

enum ExitCode { done = 0, input_unusable = 1, usage_wrong = 2, numbers_failed = 3, stopped = 130 };

}  // namespace talus
