// tests/unit/report/shipped_texts.hpp
// The words of the page as they are shipped.
#pragma once

#include "base/read_file.hpp"
#include "report/texts.hpp"

namespace talus::testing {

inline const Texts& shipped_texts() {
  static const Texts texts =
      parse_texts(read_file(TALUS_SOURCE_DIR "/tools/report/texts.toml"), "texts.toml");
  return texts;
}

}  // namespace talus::testing
