// tests/fuzz/fuzz_csv.cpp
// Tables: classes of barriers, points of comparison.
#include "base/csv.hpp"
#include "fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return talus::accepts_or_refuses([&] {
    const talus::CsvTable table = talus::parse_csv(talus::text_of(data, size), "fuzz.csv");
    for (std::size_t row = 0; row < table.rows.size(); ++row)
      static_cast<void>(table.number(row, table.names[0]));
  });
}
