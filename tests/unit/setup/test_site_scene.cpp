// Settings and grounds of a scene from a site.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "base/units.hpp"
#include "setup/site_scene.hpp"
#include "site/site.hpp"

namespace {

using namespace talus;

// The cases of talus-verify and the tests run with the defaults of a site file.
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

// Weakening friction begins at the smaller of its own and the section's, after the draws; a section
// with a law of its own keeps it.
TEST(DrawnGrounds, WeakenAllAlike) {
  const auto ground_of = [](const std::string& keys, const std::string& friction) {
    return ground_class(
        drawn_grounds(
            parse_site("[solver]\nfriction = '" + friction + "'\n[ground.a]\n" + keys, "site.toml"))
            .front());
  };
  const double given = std::tan(32 * degree);
  EXPECT_NEAR(friction_on(ground_of("friction_deg = 32\n", "given"), 50, 0), given, 1e-12);
  const GroundClass weak = ground_of("friction_deg = 32\n", "weakening");
  EXPECT_NEAR(friction_on(weak, 0, 0), given, 1e-12);
  EXPECT_NEAR(friction_on(weak, 4, 0), (given + 0.11) / 2, 1e-12);
  EXPECT_NEAR(friction_on(weak, 1e9, 0), 0.11, 1e-6);
  EXPECT_NEAR(friction_on(ground_of("friction_deg = 50\n", "weakening"), 12, 0), 0.11 + 0.73 / 4,
              1e-12);
  EXPECT_NEAR(friction_on(ground_of("friction_deg = 5\n", "weakening"), 12, 0),
              std::tan(5 * degree), 1e-12);
  const std::string own = "friction_deg = 30\nfriction_weak_deg = 20\nweakening_speed_m_s = 1\n";
  EXPECT_NEAR(friction_on(ground_of(own, "weakening"), 1e9, 0), std::tan(20 * degree), 1e-6);
}

}  // namespace
