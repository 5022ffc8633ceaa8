// Joint sets of a site: limits, keys, contradictions.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "base/units.hpp"
#include "site/joint_list.hpp"
#include "site/joint_plan.hpp"

namespace {

using namespace talus;

std::string refusal(const std::string& text) {
  try {
    static_cast<void>(plan_joint_sets(parse_site(text, "s.toml"), {}));
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace

TEST(PlanJointSets, TakesDipAndSpacingFromTheFile) {
  const Site site = parse_site(
      "[joints.a]\ndip_deg = 44\ndip_direction_deg = 144\nspacing_m = 6\npersistence = 0.5\n"
      "[joints.b]\ndip_deg = 80\ndip_direction_deg = 10\nspacing = 'uniform'\nspacing_min_m = "
      "1\nspacing_max_m = 3\n",
      "s.toml");
  const auto sets = plan_joint_sets(site, {});
  ASSERT_EQ(sets.size(), 2u);
  EXPECT_NEAR(sets[0].set.dip, 44 * degree, 1e-15);
  EXPECT_EQ(sets[0].set.disc_diameter, 60);
  EXPECT_EQ(sets[1].set.mean_spacing, 2);
}

TEST(PlanJointSets, MissingAndContradictingKeysAreNamed) {
  EXPECT_EQ(refusal("\n[joints.a]\ndip_deg = 4\nspacing_m = 1\n"),
            "s.toml:2: dip_direction_deg of [joints.a] is not given");
  EXPECT_EQ(refusal("[joints.a]\ndip_deg = 4\ndip_direction_deg = 1\n"),
            "s.toml:1: spacing_m of [joints.a] is not given");
  EXPECT_NE(refusal("[joints.a]\ndip_deg = 4\nspacing_m = 1\nmeasured = [[10, 20]]\n")
                .find("measured orientations and a dip"),
            std::string::npos);
  EXPECT_NE(refusal("[joints.a]\nspacing_m = 1\nmeasured = [[10, 20]]\nn_sets = 2\n")
                .find("cannot make 2 sets"),
            std::string::npos);
  EXPECT_EQ(refusal("[joints.a]\nspacing_m = 1\nmeasured = [[10, 95]]\n"),
            "s.toml:3: dip is 95, expected 0 to 90");
  EXPECT_EQ(refusal("[joints.m]\nspacing_m = 1\nmeasured = [[10, 80], [100, 80]]\nn_sets = 2\n"
                    "[joints.m_1]\ndip_deg = 4\ndip_direction_deg = 1\nspacing_m = 1\n"),
            "s.toml:5: two joint sets are called m_1: one is made by [joints.m]");
}

TEST(PlanJointSets, NumbersBeyondWhatRockShowsAreRefused) {
  const std::string set = "dip_deg = 4\ndip_direction_deg = 1\nspacing_m = 2\n";
  const std::string wide = "[joints.a]\n" + set + "spacing = 'lognormal'\nspacing_std_m = ";
  EXPECT_EQ(refusal(wide + "20\n"), "accepted");
  EXPECT_EQ(refusal(wide + "20.5\n"),
            "s.toml:6: spacing_std_m is 20.5, expected at most 10 times spacing_m, 20");
  std::string many;
  for (int i = 0; i < 30; ++i) many += "[joints.j" + std::to_string(i) + "]\n" + set;
  EXPECT_EQ(refusal(many), "accepted");
  EXPECT_NE(refusal(many + "[joints.last]\n" + set).find("31 joint sets, expected at most 30"),
            std::string::npos);
}

// A sliver is a hundredth of the mean joint cell in the mass, whatever the number of sets.
TEST(PlanLimits, FollowTheExpectedCells) {
  const Site site = parse_site("[source]\ndepth_m = 5\n", "s.toml");
  EXPECT_DOUBLE_EQ(plan_limits(site, {}, 1000, 1).min_volume, 10);
  EXPECT_DOUBLE_EQ(plan_limits(site, {}, 1000, 50).min_volume, 0.2);
}

// A published list of measurements: its three sets are found where an eye on the net finds them.
TEST(PlanJointSets, GroupsAPublishedListOfMeasurements) {
  const std::string path =
      std::string(TALUS_SHARED_DIR) + "/data/joints/rock_joint_sets_my_set.txt";
  std::ifstream file(path);
  if (!file) GTEST_SKIP() << "no ../shared/data";
  std::ostringstream content;
  content << file.rdbuf();
  const auto poles = read_orientations(content.str(), path).poles;
  const Site site =
      parse_site("[joints.m]\nspacing_m = 1\nmeasured_file = 'x'\nn_sets = 3\n", "s.toml");
  const auto sets = plan_joint_sets(site, {{poles, "", false}});
  ASSERT_EQ(sets.size(), 3u);
  size_t n = 0;
  for (const auto& planned : sets) {
    n += planned.measured_poles.size();
    EXPECT_GT(planned.set.fisher_k, 5) << planned.set.name;
    // every member is nearer to its own mean than to another
    for (const Vec3& p : planned.measured_poles)
      for (const auto& other : sets)
        EXPECT_GE(std::abs(p.dot(pole(planned.set.dip, planned.set.dip_direction))) + 1e-12,
                  std::abs(p.dot(pole(other.set.dip, other.set.dip_direction))));
  }
  EXPECT_EQ(n, poles.size());
}

// Declination is added, convergence taken off. A list computed from points knows no compass.
TEST(PlanJointSets, TurnsCompassAzimuthsToTheMapsNorth) {
  const Site site = parse_site(
      "[joints]\ndeclination_deg = 12\nconvergence_deg = -1.5\n"
      "[joints.compass]\ndip_deg = 40\ndip_direction_deg = 350\nspacing_m = 5\n"
      "[joints.list]\nmeasured = [[100, 80]]\nspacing_m = 5\n"
      "[joints.cloud]\nmeasured_file = 'f'\nspacing_m = 5\n",
      "s.toml");
  const Vec3 of_file = checked_pole(200, 30, {});
  const auto sets = plan_joint_sets(site, {{}, {}, {{of_file}, "", true}});
  ASSERT_EQ(sets.size(), 3u);
  EXPECT_NEAR(sets[0].set.dip_direction / degree, 3.5, 1e-12);
  EXPECT_NEAR(sets[1].set.dip_direction / degree, 113.5, 1e-9);
  EXPECT_NEAR(sets[1].set.dip / degree, 80, 1e-9);
  EXPECT_EQ(sets[2].measured_poles[0], of_file);
  EXPECT_EQ(refusal("[joints]\ndeclination = 4\n[joints.a]\n").find("s.toml:2: joints.decl"), 0u);
}
