// The lists of fields, and the page that is made from them.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <iostream>
#include <set>
#include <sstream>
#include <string>

#include "record/tables.hpp"

namespace {

using namespace talus;  // NOLINT: a test

// Units as names of fields end in them.
const std::set<std::string> units = {"1", "m", "s", "m/s", "rad", "rad/s", "J", "N", "m3", "kg"};

template <class Row>
std::string section() {
  const Table<Row>& table = table_of<Row>();
  std::string out = std::string("\n## ") + table.name + "\n" + table.title +
                    "\n\n| Field | Unit | Meaning |\n|---|---|---|\n";
  std::set<std::string> names;
  std::set<const void*> places;
  Row row;
  for (const StoredField<Row>& field : table.fields) {
    EXPECT_TRUE(names.insert(field.name).second) << field.name << " stands there twice";
    const void* place =
        std::visit([](auto* p) { return static_cast<const void*>(p); }, field.at(row));
    EXPECT_TRUE(places.insert(place).second) << field.name << " is another field again";
    EXPECT_TRUE(units.contains(field.unit)) << field.name;
    EXPECT_GE(std::string(field.title).size(), 8u) << field.name;
    out += std::string("| `") + field.name + "` | " + field.unit + " | " + field.title +
           (field.kept == Kept::where_any ? " (missing where no row has another value)" : "") +
           " |\n";
  }
  return out;
}

// TALUS_PRINT_FIELDS=1 prints the text for docs/reference/fields.md.
TEST(Tables, ThePageOfFieldsIsTheLists) {
  const std::string rows = section<Passage>() + section<Crossing>() + section<ObjectHit>() +
                           section<PanelRow>() + section<FenceHit>() + section<TreeHitRow>() +
                           section<HealthRow>() + section<Break>() + section<CrushedBlock>() +
                           section<DeepRow>();
  if (std::getenv("TALUS_PRINT_FIELDS") != nullptr) std::cout << rows;
  std::ifstream file(std::string(TALUS_SOURCE_DIR) + "/docs/reference/fields.md");
  std::ostringstream page;
  page << file.rdbuf();
  EXPECT_NE(page.str().find(rows), std::string::npos) << "the lists of fields have changed";
}

}  // namespace
