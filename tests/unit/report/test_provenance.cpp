#include <gtest/gtest.h>

#include <filesystem>

#include "report/provenance.hpp"

using namespace talus;

namespace {

// The page of a step whose program and site lie in these folders.
std::string table_in(const std::string& programs, const std::string& site) {
  RunRecord step;
  step.command_line = programs + "talus-tin a.gpkg -o out/tin.ply";
  step.inputs = {{"contours", site + "/a.gpkg", "0123456789abcdef", 1}};
  step.outputs = {{"output", site + "/out/tin.ply", "", 1}};
  return provenance_table({step}, site + "/site.toml");
}

}  // namespace

TEST(ProvenanceTable, DoesNotDependOnWhereProgramsAndSiteLie) {
  const std::string here = std::filesystem::weakly_canonical(std::filesystem::current_path());
  const std::string table = table_in("", here + "/a");
  EXPECT_EQ(table, table_in("/usr/bin/", here + "/b/c"));
  EXPECT_NE(table.find("<code>talus-tin a.gpkg -o out/tin.ply</code>"), std::string::npos);
  EXPECT_NE(table.find("<code>a.gpkg</code> <code>0123456789ab</code>"), std::string::npos);
  EXPECT_NE(table.find("<code>out/tin.ply</code> <code>not hashed</code>"), std::string::npos);
}
