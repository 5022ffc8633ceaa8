// libcore/io/picture.hpp: public
// A picture in memory.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace talus {

/// 8 bits a channel, rows from the top.
struct Picture {
  int n_rows = 0, n_cols = 0;
  std::vector<std::array<std::uint8_t, 4>> pixel;  ///< red green blue alpha      (n_rows x n_cols)
};

}  // namespace talus
