#include <gtest/gtest.h>

#include <filesystem>

#include "report/provenance.hpp"
#include "unit/report/shipped_texts.hpp"

using namespace talus;

namespace {

// The page of a step whose program and site lie in these folders.
std::string table_in(const std::string& programs, const std::string& site) {
  RunRecord step;
  step.command_line = programs + "talus-tin a.gpkg -o out/tin.ply";
  step.inputs = {{"contours", site + "/a.gpkg", "0123456789abcdef", 1}};
  step.outputs = {{"output", site + "/out/tin.ply", "", 1}};
  return provenance_table(talus::testing::shipped_texts(), {step}, site + "/site.toml");
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

TEST(ProvenanceTable, DoesNotDependOnPartsOfRunsOrOnTheRegistry) {
  const std::string site = std::filesystem::weakly_canonical(std::filesystem::current_path());
  const RunArtifact run{"run", site + "/out/runs/run_1.h5", "0123456789abcdef", 1};
  const RunArtifact other{"without", site + "/out/without/run_1.h5", "fedcba9876543210", 1};
  const auto table = [&](const std::string& command, std::vector<RunArtifact> inputs) {
    RunRecord step;
    step.folder = site;
    step.command_line = command;
    step.inputs = std::move(inputs);
    return provenance_table(talus::testing::shipped_texts(), {step}, site + "/site.toml");
  };
  const std::string of_runs =
      table("talus-fence out/runs/run_1.h5 --without out/without/run_1.h5 --db out/runs.sqlite",
            {run, other});
  EXPECT_EQ(of_runs, table("talus-fence out/parts/1-of-1.h5 --without out/parts/without/1-of-1.h5 "
                           "--db 'a registry'",
                           {run,
                            other,
                            {"part", site + "/out/parts/1-of-1.h5", "1", 1},
                            {"part", site + "/out/parts/without/1-of-1.h5", "2", 1}}));
  EXPECT_NE(of_runs.find("<code>talus-fence RUN.h5... --without RUN.h5...</code>"),
            std::string::npos);
  EXPECT_NE(of_runs.find("run_1.h5</code> <code>0123456789ab</code>"), std::string::npos);
}
