// Steps of provenance: independent of places and parts.
#include <gtest/gtest.h>

#include <filesystem>

#include "report/provenance.hpp"

using namespace talus;

namespace {

// A step as one text.
std::string words_of(const std::vector<RunRecord>& steps, const std::string& site_file) {
  std::string words;
  for (const ProvenanceStep& step : provenance_steps(steps, site_file)) {
    words += step.command;
    for (const auto* files : {&step.read, &step.wrote})
      for (const StepFile& file : *files) words += "; " + file.path + " " + file.sha;
  }
  return words;
}

// The step whose program and site lie in these folders.
std::string step_in(const std::string& programs, const std::string& site) {
  RunRecord step;
  step.command_line = programs + "talus-tin a.gpkg -o out/tin.ply";
  step.inputs = {{"contours", site + "/a.gpkg", "0123456789abcdef", 1}};
  step.outputs = {{"output", site + "/out/tin.ply", "", 1}};
  return words_of({step}, site + "/site.toml");
}

}  // namespace

TEST(ProvenanceSteps, DoesNotDependOnWhereProgramsAndSiteLie) {
  const std::string here = std::filesystem::weakly_canonical(std::filesystem::current_path());
  const std::string table = step_in("", here + "/a");
  EXPECT_EQ(table, step_in("/usr/bin/", here + "/b/c"));
  EXPECT_EQ(table, "talus-tin a.gpkg -o out/tin.ply; a.gpkg 0123456789ab; out/tin.ply ");
}

TEST(ProvenanceSteps, DoesNotDependOnPartsOfRunsOrOnTheRegistry) {
  const std::string site = std::filesystem::weakly_canonical(std::filesystem::current_path());
  const RunArtifact run{"run", site + "/out/runs/run_1.h5", "0123456789abcdef", 1};
  const RunArtifact other{"without", site + "/out/without/run_1.h5", "fedcba9876543210", 1};
  const auto table = [&](const std::string& command, std::vector<RunArtifact> inputs) {
    RunRecord step;
    step.folder = site;
    step.command_line = command;
    step.inputs = std::move(inputs);
    return words_of({step}, site + "/site.toml");
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
  EXPECT_EQ(of_runs,
            "talus-fence RUN.h5... --without RUN.h5...; out/runs/run_1.h5 0123456789ab; "
            "out/without/run_1.h5 fedcba987654");
}
