// Settings of runs that are evaluated together.
#include <gtest/gtest.h>

#include "base/error.hpp"
#include "ensemble/made_with.hpp"

using namespace talus;

namespace {

// `config` as print_config() writes it: a line a value with its origin.
RunInfo info_of(const std::string& config, const std::string& more = "") {
  RunInfo info;
  info.config = config;
  info.made_with = more;
  info.blocks_hash = "blocks";
  info.trn_sha256 = "bed";
  return info;
}

std::string refusal(SettingsCheck check, const std::string& file, const RunInfo& info) {
  try {
    check.add(file, info);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

SettingsCheck after(const std::string& file, const RunInfo& info) {
  SettingsCheck check;
  check.add(file, info);
  return check;
}

const std::string slope = "[ground.slope]\nfriction_deg = 30  # file, line 7\n";

}  // namespace

TEST(SettingsOfRuns, AreNamedWithBothValuesWhereTheyDiffer) {
  const SettingsCheck check =
      after("run_1.h5", info_of(slope + "\n[solver]\nduration_s = 6  # default\n"));
  const std::string words = refusal(check, "run_2.h5",
                                    info_of("[ground.slope]\nfriction_deg = 5  # "
                                            "cli\n\n[solver]\nduration_s = 20  # file, line 9\n"));
  EXPECT_EQ(words.substr(0, words.find('\n')),
            "run_2.h5: was computed with other settings than run_1.h5: ground.slope.friction_deg: "
            "5, there 30; solver.duration_s: 20, there 6");
  EXPECT_EQ(refusal(check, "run_2.h5", info_of(slope + "\n[solver]\nduration_s = 6  # cli\n")), "");
}

TEST(SettingsOfRuns, MayDifferInSeedSampleFramesAndWhatNoStageOfARunReads) {
  const auto with = [](const std::string& seed, const std::string& kept, const std::string& place) {
    return info_of(slope + "\n[solver]\nseed = " + seed + "  # cli\n\n[uncertainty]\nsample = " +
                   seed + "  # cli\n\n[output]\nframes = " + kept +
                   "  # file, line 2\n\n[place.p]\nhalf_width = " + place + "  # file, line 3\n");
  };
  EXPECT_EQ(
      refusal(after("run_1.h5", with("1", "true", "0.1")), "run_2.h5", with("2", "false", "0.2")),
      "");
}

TEST(SettingsOfRuns, OptionsAndFilesCount) {
  const SettingsCheck check =
      after("run_1.h5", info_of(slope, "--settle = true\nfile forest.wood = aa\n"));
  EXPECT_EQ(refusal(check, "run_2.h5", info_of(slope, "--settle = true\nfile forest.wood = aa\n")),
            "");
  EXPECT_NE(refusal(check, "run_2.h5", info_of(slope, "--settle = \nfile forest.wood = bb\n"))
                .find("--settle: not given, there true; file forest.wood: bb, there aa"),
            std::string::npos);
}

TEST(SettingsOfRuns, DrawnValuesDifferFromSampleToSampleAndFromNoRunWithoutOne) {
  const auto drawn = [](const std::string& value, const std::string& source) {
    return info_of("[ground.slope]\nfriction_deg = " + value + "  # " + source + "\n");
  };
  const SettingsCheck check = after("run_1.h5", drawn("28", "sample 1 of uncertainty.friction"));
  EXPECT_EQ(refusal(check, "run_2.h5", drawn("31", "sample 2 of uncertainty.friction")), "");
  EXPECT_NE(refusal(check, "run_3.h5", drawn("30", "file, line 7")), "");
}

TEST(SettingsOfRuns, CasesDifferInWhatTheCommandLineGave) {
  const auto of_case = [](const std::string& name, const std::string& config) {
    RunInfo info = info_of(config);
    info.case_name = name;
    return info;
  };
  const std::string soft = "[ground.slope]\nfriction_deg = 5  # cli\n";
  const SettingsCheck check = after("hard/run_1.h5", of_case("hard", slope));
  EXPECT_EQ(refusal(check, "soft/run_1.h5", of_case("soft", soft)), "");
  EXPECT_NE(refusal(check, "hard/run_2.h5", of_case("hard", soft)), "");
  EXPECT_NE(refusal(check, "soft/run_1.h5",
                    of_case("soft", "[ground.slope]\nfriction_deg = 5  # file, line 7\n")),
            "");
  SettingsCheck both = check;
  both.add("soft/run_1.h5", of_case("soft", soft));
  EXPECT_NE(
      refusal(both, "soft/run_2.h5", of_case("soft", "[ground.slope]\nfriction_deg = 6  # cli\n")),
      "");
}

TEST(SettingsOfRuns, HaveOneDigestWhateverSeedAndSample) {
  const auto drawn = [](const std::string& seed, const std::string& friction) {
    return info_of("[solver]\nseed = " + seed + "  # cli\n\n[ground.slope]\nfriction_deg = " +
                   friction + "  # sample " + seed + " of uncertainty.friction\n");
  };
  const std::string one = settings_digest(drawn("1", "28"));
  EXPECT_EQ(settings_digest(drawn("2", "31")), one);
  EXPECT_NE(settings_digest(info_of("[ground.slope]\nfriction_deg = 28  # cli\n")), one);
  RunInfo other = drawn("1", "28");
  other.blocks_hash = "others";
  EXPECT_NE(settings_digest(other), one);
}

TEST(SettingsOfRuns, BlocksAndTerrainAreThoseOfTheRockMass) {
  const auto of_mass = [](int sample, const std::string& blocks, const std::string& bed) {
    RunInfo info = info_of(slope + "\n[uncertainty]\nsample = " + std::to_string(sample) +
                           "  # cli\nrock_masses = 2  # file, line 4\n");
    info.blocks_hash = blocks;
    info.trn_sha256 = bed;
    info.terrain_digest = "ground";
    return info;
  };
  SettingsCheck check = after("run_1.h5", of_mass(1, "one", "bed 1"));
  check.add("run_2.h5", of_mass(2, "two", "bed 2"));
  EXPECT_EQ(refusal(check, "run_3.h5", of_mass(3, "one", "bed 1")), "");
  EXPECT_NE(
      refusal(check, "run_3.h5", of_mass(3, "other", "bed 1")).find("other blocks of rock mass 1"),
      std::string::npos);
  EXPECT_NE(
      refusal(check, "run_4.h5", of_mass(4, "two", "other")).find("another terrain of rock mass 2"),
      std::string::npos);
  RunInfo other = info_of(slope);
  other.blocks_hash = "others";
  EXPECT_NE(refusal(after("run_1.h5", info_of(slope)), "run_2.h5", other)
                .find("other blocks than run_1.h5"),
            std::string::npos);
}

TEST(SettingsOfRuns, FencesMayDifferBetweenRunsWithAndWithoutThem) {
  const auto fence = [](const std::string& active, const std::string& friction) {
    return info_of("[ground.slope]\nfriction_deg = " + friction +
                   "  # file, line 7\n\n[fence.low]\nactive = " + active + "  # cli\n");
  };
  const SettingsCheck check = after("run_1.h5", fence("true", "30"));
  EXPECT_NE(refusal(check, "run_1.h5", fence("false", "30")), "");
  EXPECT_EQ(refusal(check.for_other_fences(), "run_1.h5", fence("false", "30")), "");
  EXPECT_NE(refusal(check.for_other_fences(), "run_1.h5", fence("false", "29")), "");
}

TEST(SettingsOfRuns, GroundsThatOverlapCountByTheirOrder) {
  const std::string grass = "[ground.grass]\nfriction_deg = 20  # file, line 9\n";
  const SettingsCheck check = after("run_1.h5", info_of(slope + "\n" + grass));
  EXPECT_NE(refusal(check, "run_2.h5", info_of(grass + "\n" + slope))
                .find("order of [ground.*]: ground.grass, ground.slope"),
            std::string::npos);
}
