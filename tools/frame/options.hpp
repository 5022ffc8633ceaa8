// tools/frame/options.hpp
// For sources that declare options: CLI11 whole. Its header costs each source seconds to compile,
// so tool.hpp only names its types.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "tools/frame/tool.hpp"

namespace talus {

template <class T>
CLI::Option* Tool::option(const std::string& name, T& value, const std::string& help) {
  return app().add_option(name, value, help)->capture_default_str();
}

}  // namespace talus
