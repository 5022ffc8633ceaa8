// tests/unit/step/rows_of_island.hpp
// Contacts of an island one by one, read from their lanes.
#pragma once

#include <vector>

#include "solver/contact_row.hpp"
#include "solver/island.hpp"

namespace talus::test {

/// Numbers of all rows, pair by pair.
inline std::vector<int> row_numbers(const Island& island) {
  std::vector<int> numbers;
  for (const BodyPair& pair : island.pairs)
    for (int r = pair.row_begin; r < pair.row_end; ++r) numbers.push_back(r);
  return numbers;
}

inline ContactRow row_at(const Island& island, int r) {
  const ConstIslandRow of = row_of(island, r);
  ContactRow out;
  static_cast<LawRow<double>&>(out) = of.law();
  out.arm = of.arm();
  return out;
}

}  // namespace talus::test
