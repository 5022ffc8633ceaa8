#include <gtest/gtest.h>

#include "setup/site_scene.hpp"

namespace {

using namespace talus;

// What the cases of talus-verify and the tests run with is what a site file without settings does.
TEST(SettingsOf, DefaultsOfASiteFileAreThoseOfTheEngine) {
  ScenePlan plan;
  plan.block_contacts = true;
  const Settings of_site = settings_of({}, plan), engine;
  EXPECT_EQ(SolverSettings{}.law, "talus");
  EXPECT_EQ(of_site.strains, engine.strains);
  EXPECT_EQ(of_site.dt, engine.dt);
  EXPECT_EQ(of_site.normal_stiffness, engine.normal_stiffness);
  EXPECT_EQ(of_site.shear_ratio, engine.shear_ratio);
  EXPECT_EQ(of_site.tolerance_factor, engine.tolerance_factor);
  EXPECT_EQ(of_site.accuracy, engine.accuracy);
  EXPECT_EQ(of_site.flight, engine.flight);
  EXPECT_EQ(of_site.block_contacts, engine.block_contacts);
  EXPECT_EQ(of_site.sleep, engine.sleep);
}

}  // namespace
