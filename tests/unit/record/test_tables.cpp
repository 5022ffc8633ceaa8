// The lists of fields, and the page that is made from them.
#include <gtest/gtest.h>

#include <cctype>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "record/tables.hpp"

namespace {

using namespace talus;  // NOLINT: a test

// Units as names of fields end in them.
const std::set<std::string> units = {"1", "m", "s", "m/s", "rad", "rad/s", "J", "N", "m3", "kg"};

// "" or how a name with this unit ends: "_m_s".
std::string ending_of(std::string unit) {
  if (unit == "1") return "";
  for (char& c : unit) c = c == '/' ? '_' : static_cast<char>(std::tolower(c));
  return "_" + unit;
}

// position_x_m: position_y_m
std::string along(std::string name, char axis) {
  const std::size_t at = ("_" + name).find("_x_");
  if (at != std::string::npos) name[at] = axis;
  return name;
}

// A line of the page; the three parts of a vector are one.
template <class Row>
std::string line_of(const std::vector<StoredField<Row>>& fields, std::size_t& i) {
  const std::string name = fields[i].name;
  std::string names = "`" + name + "`", title = fields[i].title;
  if (along(name, 'y') != name) {
    for (const char axis : {'y', 'z'}) {
      const StoredField<Row>& next = fields.at(++i);
      EXPECT_EQ(next.name, along(name, axis));
      EXPECT_EQ(next.title, std::string(fields[i - 1].title).replace(title.size() - 1, 1, 1, axis));
      names += std::string(", `") + next.name + "`";
    }
    title += ", y, z";
  }
  return "- " + names + (fields[i].kept == Kept::where_any ? "\\*" : "") + ": " + title + "\n";
}

template <class Row>
std::string section() {
  const Table<Row>& table = table_of<Row>();
  std::set<std::string> names;
  std::set<const void*> places;
  Row row;
  for (const StoredField<Row>& field : table.fields) {
    EXPECT_TRUE(names.insert(field.name).second) << field.name << " stands there twice";
    const void* place =
        std::visit([](auto* p) { return static_cast<const void*>(p); }, field.at(row));
    EXPECT_TRUE(places.insert(place).second) << field.name << " is another field again";
    EXPECT_TRUE(units.contains(field.unit)) << field.name;
    EXPECT_TRUE(std::string(field.name).ends_with(ending_of(field.unit))) << field.name;
    EXPECT_GE(std::string(field.title).size(), 8u) << field.name;
  }
  std::string out = std::string("\n## ") + table.name + "\n" + table.title + "\n";
  for (std::size_t i = 0; i < table.fields.size(); ++i) out += line_of(table.fields, i);
  return out;
}

std::string with_single_blanks(std::istream& text) {
  std::string out;
  for (std::string word; text >> word;) out += word + " ";
  return out;
}

// TALUS_PRINT_FIELDS=1 prints the text for docs/reference/fields.md, whose lines may be broken.
TEST(Tables, ThePageOfFieldsIsTheLists) {
  std::istringstream lists(section<Passage>() + section<Crossing>() + section<ObjectHit>() +
                           section<RoofHit>() + section<PanelRow>() + section<FenceHit>() +
                           section<TreeHitRow>() + section<HealthRow>() + section<Break>() +
                           section<CrushedBlock>() + section<DeepRow>());
  if (std::getenv("TALUS_PRINT_FIELDS") != nullptr) std::cout << lists.str();
  std::ifstream page(std::string(TALUS_SOURCE_DIR) + "/docs/reference/fields.md");
  EXPECT_NE(with_single_blanks(page).find(with_single_blanks(lists)), std::string::npos)
      << "the lists of fields have changed";
}

}  // namespace
