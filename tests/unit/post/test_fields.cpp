// Tables that no layer has the fields of are on the page of fields.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "post/runout/runout_fields.hpp"
#include "post/runout/runout_sensitivity.hpp"

namespace {

using namespace talus;  // NOLINT: a test

template <class Row>
std::string section(const std::string& name, const std::vector<Field<Row>>& fields) {
  std::string out = "\n## " + name + "\n| Field | Title |\n|---|---|\n";
  for (const Field<Row>& field : fields)
    out += std::string("| `") + field.name + "` | " + title_of(field.title, field.unit) + " |\n";
  return out;
}

TEST(Fields, ThePageHasTheTables) {
  std::ifstream file(std::string(TALUS_SOURCE_DIR) + "/docs/reference/fields.md");
  std::ostringstream page;
  page << file.rdbuf();
  for (const std::string& wanted : {section("Table curves.csv", curve_fields()),
                                    section("Table sensitivity.csv", sensitivity_fields())})
    EXPECT_NE(page.str().find(wanted), std::string::npos) << "should hold" << wanted;
}

TEST(Fields, ARowOfATableHasTenDigitsAndNothingForNoNumber) {
  EXPECT_EQ(csv_row({FieldValue(), std::nan(""), 1 / 3.0, std::int64_t{-2}, "a, b"}),
            ",,0.3333333333,-2,\"a, b\"\n");
}

}  // namespace
