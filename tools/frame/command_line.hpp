// tools/frame/command_line.hpp
// Words of the command line: how GDAL spells options, checks of their values, and how a command is
// written down so that a shell reads it again.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/error.hpp"

namespace CLI {
class App;
}

namespace talus {

/// The command line is wrong, independent of the files (exit code 2).
class UsageError : public InputError {
 public:
  using InputError::InputError;
};

/// Result of `read` for words of the command line; an InputError of it becomes a UsageError.
template <class Read>
auto from_command_line(const Read& read) {
  try {
    return read();
  } catch (const InputError& error) {
    throw UsageError({}, error.what(), error.hint());
  }
}

/// For CLI::Option::check(): a finite number from `low` to `high`, or "nan" where `or_nan`.
[[nodiscard]] std::function<std::string(const std::string&)> number_between(double low, double high,
                                                                            bool or_nan = false);

/// The words behind the program's name, last one first as CLI11 takes them. Long options of `app`
/// may be spelt with one dash and underscores, as GDAL does (-t_srs, -overwrite).
[[nodiscard]] std::vector<std::string> arguments_of(int argc, char** argv, const CLI::App& app);

/// All words, quoted for a shell where they must be.
[[nodiscard]] std::string command_text(int argc, char** argv);

}  // namespace talus
