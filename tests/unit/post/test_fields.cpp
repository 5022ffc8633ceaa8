// Tables that no layer has the fields of are on the page of fields.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include "post/runout/runout_fields.hpp"
#include "post/runout/runout_sensitivity.hpp"

namespace {

using namespace talus;  // NOLINT: a test

// "`time_s` (Time), `x_m` (Centre of mass, x)."
template <class Row>
std::string list_of(const std::vector<Field<Row>>& fields) {
  std::string out;
  for (const Field<Row>& field : fields)
    out += (out.empty() ? "`" : ", `") + std::string(field.name) + "` (" + field.title + ")";
  return out + ".";
}

TEST(Fields, ThePageHasTheTables) {
  std::ifstream file(std::string(TALUS_SOURCE_DIR) + "/docs/reference/fields.md");
  std::string page;
  for (std::string word; file >> word;) page += word + " ";
  for (const std::string& wanted : {list_of(curve_fields()), list_of(sensitivity_fields())})
    EXPECT_NE(page.find(wanted), std::string::npos) << "should hold " << wanted;
}

TEST(Fields, ARowOfATableHasTenDigitsAndNothingForNoNumber) {
  EXPECT_EQ(csv_row({FieldValue(), std::nan(""), 1 / 3.0, std::int64_t{-2}, "a, b"}),
            ",,0.3333333333,-2,\"a, b\"\n");
}

}  // namespace
