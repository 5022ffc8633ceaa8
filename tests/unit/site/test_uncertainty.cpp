// Uncertain quantities: samples, moments, keys that move together.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "base/units.hpp"
#include "blocks/joint_sets.hpp"
#include "site/site_layers.hpp"
#include "site/uncertainty.hpp"

namespace {

using namespace talus;  // NOLINT: a test

constexpr const char* whole = R"(
[source]
seed = 5
[joints.bedding]
dip_deg = 44
dip_direction_deg = 144
spacing_m = 5
fisher_k = 40
[ground.slope]
friction_deg = 28
[ground.scree]
friction_deg = 32
[uncertainty]
rock_masses = 8
[uncertainty.friction]
keys = ["ground.slope.friction_deg", "ground.scree.friction_deg"]
apply = "add"
distribution = "normal"
std = 2
source = "back-analysis of 3 events"
[uncertainty.cor]
keys = "ground.slope.cor"
distribution = "uniform"
min = 0.1
max = 0.5
[uncertainty.bedding]
keys = ["joints.bedding.orientation"]
distribution = "fisher"
n_measured = 50
[uncertainty.spacing]
keys = ["joints.bedding.spacing_m"]
apply = "factor"
distribution = "lognormal"
std = 0.2
)";

Site site_of(const std::string& text, std::int64_t sample = 0) {
  Site site = parse_site(text, "s/site.toml");
  site.uncertainty.sample = sample;
  check_uncertainty(site);
  return site;
}

Site drawn_site(std::int64_t sample, DrawScope scope = DrawScope::all) {
  Site site = site_of(whole, sample);
  apply_draws(site, scope);
  return site;
}

// The message that refuses a section [uncertainty.q], beside a site with a ground and a joint set.
std::string refusal(const std::string& section, const std::string& before = "") {
  const std::string text =
      "[ground.slope]\nfriction_deg = 28\n[joints.J1]\ndip_deg = 70\ndip_direction_deg = 10\n"
      "spacing_m = 5\n[solver]\nseed = 1\n" +
      before + "[uncertainty.q]\n" + section;
  try {
    check_uncertainty(parse_site(text, "s/site.toml"));
  } catch (const InputError& error) {
    return std::string(error.what()) + " | " + error.hint();
  }
  return "accepted";
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(Uncertainty, KeysOfAQuantityMoveTogetherAroundTheirValues) {
  for (std::int64_t sample = 1; sample <= 20; ++sample) {
    const Site site = drawn_site(sample);
    EXPECT_NEAR(site.grounds[1].friction_deg - site.grounds[0].friction_deg, 4, 1e-12);
    EXPECT_NE(site.grounds[0].friction_deg, 28);
    EXPECT_TRUE(site.grounds[0].cor > 0.1 && site.grounds[0].cor < 0.5);
  }
  const Site held = drawn_site(0);
  EXPECT_EQ(held.grounds[0].friction_deg, 28);
  EXPECT_EQ(held.source.seed, 5);
}

// 512 points of the sequence: mean and standard deviation are those that were asked for.
TEST(Uncertainty, SamplesHaveTheMomentsThatWereGiven) {
  double sum = 0, squares = 0;
  constexpr int n = 512;
  for (std::int64_t sample = 1; sample <= n; ++sample) {
    const double x = drawn_site(sample).grounds[0].friction_deg - 28;
    sum += x, squares += x * x;
  }
  EXPECT_NEAR(sum / n, 0, 0.01);
  EXPECT_NEAR(std::sqrt(squares / n), 2, 0.02);
}

// Keys that belong together stay together, as often as their weight says.
TEST(Uncertainty, RowsAreDrawnWhole) {
  const std::string rows =
      "[ground.slope]\nfriction_deg = 28\n[rockfall.a]\nshape = 'rock'\nvolume_m3 = 1\n"
      "[uncertainty.set]\nkeys = ['ground.slope.friction_deg', 'ground.slope.cor', "
      "'fragmentation.max_generation']\ndistribution = 'rows'\n"
      "values = [20, 0.5, 2,\n 30, 0.25, 3,\n 40, 0.125, 4]\nweights = [1, 2, 1]\n";
  std::map<double, int> n;
  for (std::int64_t sample = 1; sample <= 64; ++sample) {
    Site site = site_of(rows, sample);
    apply_draws(site, DrawScope::all);
    const GroundSettings& slope = site.grounds[0];
    EXPECT_EQ(slope.cor, slope.friction_deg == 20 ? 0.5 : slope.friction_deg == 30 ? 0.25 : 0.125);
    EXPECT_EQ(site.fragmentation.max_generation, slope.friction_deg / 10);
    ++n[slope.friction_deg];
  }
  EXPECT_EQ(n[20], 16);  // Sobol's points are even
  EXPECT_EQ(n[30], 32);
  EXPECT_EQ(n[40], 16);
  EXPECT_NE(text_of(site_of(rows), site_of(rows).quantities[0]).find("rows: 3 sets of values"),
            std::string::npos);
}

TEST(Uncertainty, RowsThatCannotBeAreRefused) {
  const std::string keys =
      "keys = ['ground.slope.friction_deg', 'ground.slope.cor']\ndistribution = 'rows'\n";
  EXPECT_TRUE(
      has(refusal(keys + "values = [20, 0.5, 30]\n"), "there are 3 values, expected rows of 2"));
  EXPECT_TRUE(has(refusal(keys + "values = [20, 0.5, 30, 1.5]\n"),
                  "row 2 has 1.5 for ground.slope.cor, expected 0 to 1"));
  EXPECT_TRUE(has(refusal(keys + "values = [20, 0.5]\nweights = [1, 1]\n"), "there are 2 weights"));
  EXPECT_TRUE(has(refusal(keys + "values = [20, 0.5]\napply = 'add'\n"), "expected set"));
  EXPECT_TRUE(has(refusal("keys = 'fragmentation.max_generation'\ndistribution = 'rows'\n"
                          "values = [2.5]\n"),
                  "expected a whole number"));
  EXPECT_EQ(refusal(keys + "values = [20, 0.5, 30, 1]\n"), "accepted");
}

// A file takes the place of all quantities of the site, and of nothing else.
TEST(Uncertainty, AFileTakesThePlaceOfTheQuantities) {
  Site site = parse_site(whole, "s/site.toml");
  const std::string set =
      "[uncertainty.cor]\nkeys = 'ground.slope.cor'\ndistribution = 'discrete'\nvalues = [0.2]\n";
  take_quantities(site, set, "s/set.toml");
  ASSERT_EQ(site.quantities.size(), 1u);
  EXPECT_EQ(site.quantities[0].values, std::vector<double>{0.2});
  EXPECT_EQ(site.uncertainty.rock_masses, 8);
  EXPECT_EQ(site.sources.count("uncertainty.cor.min"), 0u);
  EXPECT_EQ(site.sources.at("uncertainty.cor.values").words, "s/set.toml, line 4");
  site.uncertainty.sample = 1;
  check_uncertainty(site);
  apply_draws(site, DrawScope::all);
  EXPECT_EQ(site.grounds[0].cor, 0.2);
  EXPECT_EQ(site.grounds[0].friction_deg, 28);
  const auto refused = [&site](const std::string& text) {
    try {
      take_quantities(site, text, "s/set.toml");
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  EXPECT_TRUE(has(refused("[ground.slope]\ncor = 0.1\n" + set),
                  "s/set.toml:2: holds ground.slope.cor, expected [uncertainty.NAME] alone"));
  EXPECT_TRUE(has(refused("[uncertainty]\nseed = 2\n" + set), "holds uncertainty.seed"));
  EXPECT_TRUE(has(refused("# nothing\n"), "holds no section [uncertainty.NAME]"));
}

TEST(Uncertainty, ASampleIsTheSameInAnyOrderAndWithMoreRuns) {
  std::map<std::int64_t, double> friction;
  for (std::int64_t sample = 1; sample <= 30; ++sample)
    friction[sample] = drawn_site(sample).grounds[0].friction_deg;
  for (std::int64_t sample = 60; sample >= 1; --sample) {
    const double again = drawn_site(sample).grounds[0].friction_deg;
    if (sample <= 30) {
      EXPECT_EQ(again, friction[sample]);
    }
  }
  // a quantity behind the earlier ones leaves theirs as they are
  Site more = site_of(std::string(whole) +
                          "[uncertainty.last]\nkeys = \"solver.start_jitter_m_s\"\n"
                          "distribution = \"uniform\"\nmin = 0\nmax = 1\n",
                      7);
  apply_draws(more, DrawScope::all);
  EXPECT_EQ(more.grounds[0].friction_deg, friction[7]);
}

TEST(Uncertainty, RockKeysAreDrawnOnceForEachRockMass) {
  std::set<double> spacings;
  for (std::int64_t sample = 1; sample <= 8; ++sample) {
    const Site site = drawn_site(sample), later = drawn_site(sample + 8);
    spacings.insert(site.joints[0].spacing_m);
    EXPECT_EQ(site.joints[0].spacing_m, later.joints[0].spacing_m);
    EXPECT_EQ(site.joints[0].dip_deg, later.joints[0].dip_deg);
    EXPECT_EQ(site.source.seed, 4 + sample);
    EXPECT_EQ(later.source.seed, 4 + sample);
    EXPECT_NE(site.grounds[0].friction_deg, later.grounds[0].friction_deg);
    EXPECT_EQ(rock_mass(later.uncertainty), sample);
  }
  EXPECT_EQ(spacings.size(), 8U);
  // talus-blocks draws these alone
  const Site rock = drawn_site(3, DrawScope::rock);
  EXPECT_EQ(rock.joints[0].spacing_m, drawn_site(3).joints[0].spacing_m);
  EXPECT_EQ(rock.grounds[0].friction_deg, 28);
  EXPECT_EQ(print_config(rock), print_config(drawn_site(11, DrawScope::rock)));
}

// Mean of 50 poles that scatter by 40: concentration 1,951, 95 % within 3.18 degrees.
TEST(Uncertainty, OrientationsScatterAroundTheMeanOfWhatWasMeasured) {
  Site site = site_of(whole);
  site.uncertainty.rock_masses = 400;
  const Vec3 mean = pole(44 * degree, 144 * degree);
  int n_within = 0;
  double sum = 0;
  for (std::int64_t sample = 1; sample <= 400; ++sample) {
    Site drawn = site;
    drawn.uncertainty.sample = sample;
    apply_draws(drawn, DrawScope::all);
    const Vec3 made =
        pole(drawn.joints[0].dip_deg * degree, drawn.joints[0].dip_direction_deg * degree);
    n_within += std::acos(std::min(1.0, made.dot(mean))) < 3.18 * degree;
    sum += 1 - made.dot(mean);
  }
  EXPECT_NEAR(n_within / 400.0, 0.95, 0.01);
  EXPECT_NEAR(sum / 400, 1 / 1951.0, 1e-5);  // 1 - coth k + 1/k
}

TEST(Uncertainty, EffectiveValuesSayWhichSampleTheyAreOf) {
  const Site site = drawn_site(10);
  std::map<std::string, EffectiveValue> values;
  for (const EffectiveValue& value : effective_values(site))
    values[value.section + "." + value.key] = value;
  EXPECT_EQ(values["ground.slope.friction_deg"].source, "sample 10 of uncertainty.friction");
  EXPECT_EQ(values["source.seed"].source, "rock mass 2");
  EXPECT_EQ(values["uncertainty.friction.keys"].value,
            "['ground.slope.friction_deg', 'ground.scree.friction_deg']");
  // and the text reads back, with the values that were drawn
  const Site back = parse_site(print_config(site), "run");
  EXPECT_EQ(back.grounds[0].friction_deg, site.grounds[0].friction_deg);
  EXPECT_EQ(back.joints[0].dip_direction_deg, site.joints[0].dip_direction_deg);
  const std::vector<DrawnKey> now = values_in_effect(back);
  ASSERT_EQ(now.size(), 6U);
  EXPECT_EQ(now[0].key, "ground.slope.friction_deg");
  EXPECT_EQ(now[0].value, site.grounds[0].friction_deg);
  EXPECT_EQ(now[3].key, "joints.bedding.dip_deg");
  EXPECT_EQ(text_of(site_of(whole), site_of(whole).quantities[0]),
            "ground.slope.friction_deg, ground.scree.friction_deg: what is added is drawn from "
            "normal, mean 0, standard deviation 2 (back-analysis of 3 events)");
}

// A key that a soil filled has a value, so it can be drawn around that; its other keys stay the
// soil's.
TEST(Uncertainty, KeysThatASoilFilledAreDrawnAroundItsValues) {
  const std::string text =
      "[ground.slope]\nsoil = \"meadow\"\n[uncertainty.rolling]\n"
      "keys = \"ground.slope.bearing_kpa\"\napply = \"factor\"\n"
      "distribution = \"lognormal\"\nstd = 0.2\n";
  std::set<double> drawn;
  for (std::int64_t sample = 1; sample <= 4; ++sample) {
    Site site = site_of(text, sample);
    apply_draws(site, DrawScope::all);
    const double bearing = site.grounds[0].bearing_kpa;
    EXPECT_TRUE(bearing > 4000.0 / 3 && bearing < 4000.0 * 3) << bearing;
    drawn.insert(bearing);
    const std::string printed = print_config(site);
    EXPECT_TRUE(has(printed, "  # sample " + std::to_string(sample) + " of uncertainty.rolling\n"));
    EXPECT_TRUE(has(printed, "cor = 0.9  # soil meadow (field test)"));
    EXPECT_EQ(parse_site(printed, "run").grounds[0].bearing_kpa, bearing);
  }
  EXPECT_EQ(drawn.size(), 4U);
  EXPECT_FALSE(drawn.contains(4000));
  EXPECT_TRUE(has(print_config(site_of(text)), "bearing_kpa = 4000  # soil meadow"));
}

TEST(Uncertainty, TheCommandLineHoldsAKey) {
  Site site = site_of(whole, 4);
  override_value(site, "ground.slope.friction_deg", "25");
  apply_draws(site, DrawScope::all);
  EXPECT_EQ(site.grounds[0].friction_deg, 25);
  EXPECT_NE(site.grounds[1].friction_deg, 32);
}

TEST(Uncertainty, AzimuthsGoOnBeyondNorth) {
  const Site base = site_of(
      "[joints.J1]\ndip_deg = 70\ndip_direction_deg = 358\nspacing_m = 5\n"
      "[uncertainty]\nrock_masses = 64\n[uncertainty.q]\nkeys = \"joints.J1.dip_direction_deg\"\n"
      "distribution = \"normal\"\nstd = 10\n");
  int n_beyond = 0;
  for (std::int64_t sample = 1; sample <= 64; ++sample) {
    Site site = base;
    site.uncertainty.sample = sample;
    apply_draws(site, DrawScope::all);
    const double azimuth = site.joints[0].dip_direction_deg;
    EXPECT_TRUE(azimuth >= 0 && azimuth <= 360);
    n_beyond += azimuth < 180;
  }
  EXPECT_NEAR(n_beyond, 27, 2);  // above 2 of a normal with 10: 0.42
}

TEST(Uncertainty, WhatCannotBeDrawnIsRefusedWithPlaceAndWayOut) {
  const std::string normal = "distribution = \"normal\"\nstd = 2\n";
  const std::string friction = "keys = \"ground.slope.friction_deg\"\n";
  const std::string unknown = refusal("keys = \"ground.slope.fricton_deg\"\n" + normal);
  EXPECT_EQ(
      unknown,
      "s/site.toml:10: [uncertainty.q]: there is no key ground.slope.fricton_deg in this site "
      "file | did you mean ground.slope.friction_deg?");
  EXPECT_TRUE(has(refusal("keys = \"solver.law\"\n" + normal), "solver.law holds no number"));
  EXPECT_TRUE(has(refusal("keys = \"solver.seed\"\n" + normal), "seeds follow from the run"));
  EXPECT_TRUE(has(refusal("keys = \"terrain.cell_size_m\"\n" + normal), "terrain_rmse_m"));
  EXPECT_TRUE(has(refusal("keys = \"dam.road.height_m\"\n" + normal,
                          "[dam.road]\nline = [[0, 5], [9, 5]]\nheight_m = 3\n"),
                  "a dam stands in the terrain, which is the same in all runs"));
  EXPECT_TRUE(has(refusal("keys = \"hazard.class.V1.frequency_per_a\"\n" + normal),
                  "[hazard] is the same in all runs"));
  EXPECT_TRUE(has(refusal("keys = \"joints.J1.spacing_m\"\n" + normal), "needs a rock mass"));
  EXPECT_TRUE(has(refusal("keys = \"joints.J1.spacing_m\"\n" + normal), "rock_masses"));
  EXPECT_TRUE(has(refusal("keys = \"joints.J1.friction_deg\"\napply = \"add\"\n" + normal),
                  "is not given, so nothing can be added to it"));
  EXPECT_TRUE(has(refusal(friction), "distribution is missing"));
  EXPECT_TRUE(has(refusal(friction + "distribution = \"normal\"\n"), "needs std"));
  EXPECT_TRUE(has(refusal(friction + normal + "min = 3\n"),
                  "min does not belong to distribution = \"normal\""));
  EXPECT_TRUE(has(refusal(friction + "distribution = \"uniform\"\nmin = 30\nmax = 20\n"),
                  "max is 20, expected above min, 30"));
  EXPECT_TRUE(
      has(refusal(friction + "distribution = \"uniform\"\nmin = 20\nmax = 95\n"), "draws 95"));
  EXPECT_TRUE(
      has(refusal(friction + "distribution = \"triangular\"\nmin = 20\nmax = 30\nmode = 31\n"),
          "mode is 31, expected between min and max, 20 to 30"));
  EXPECT_TRUE(has(refusal(friction + "distribution = \"normal\"\nstd = 30\n"),
                  "of what it draws lies outside of 0 to 90"));
  EXPECT_TRUE(has(refusal(friction + normal + "truncate = [30, 20]\n"), "the lowest value first"));
  EXPECT_TRUE(has(refusal(friction + normal + "truncate = [-5, 20]\n"), "expected within 0 to 90"));
  EXPECT_TRUE(has(refusal(friction + normal + "truncate = [80, 85]\n"), "leaves nothing"));
  EXPECT_TRUE(
      has(refusal(friction + "distribution = \"discrete\"\nvalues = [20, 30]\nweights = [1]\n"),
          "there are 1 weight, expected one for each of 2 values"));
  EXPECT_TRUE(has(refusal(friction + "distribution = \"fisher\"\nn_measured = 5\n"),
                  "is not an orientation"));
  EXPECT_TRUE(
      has(refusal("keys = \"joints.J1.orientation\"\ndistribution = \"fisher\"\nn_measured = 5\n",
                  "[uncertainty]\nrock_masses = 4\n"),
          "fisher_k of [joints.J1] is 0"));
  EXPECT_TRUE(has(refusal("keys = [\"ground.slope.cor\", \"ground.slope.cor\"]\n"
                          "distribution = \"uniform\"\nmin = 0\nmax = 1\n"),
                  "is drawn twice"));
  EXPECT_TRUE(
      has(refusal(friction + normal, "friction_scatter_deg = 2\n"), "scatters by [solver]"));
  EXPECT_TRUE(has(refusal("keys = \"fragmentation.max_generation\"\n" + normal), "\"discrete\""));
  EXPECT_TRUE(has(refusal(friction + normal, "[uncertainty]\nsampling = \"hypercube\"\n"),
                  "needs n_samples"));
  EXPECT_EQ(refusal(friction + normal), "accepted");
}

TEST(Uncertainty, AHypercubeHasNoSampleBeyondItsLast) {
  Site site = site_of(
      "[uncertainty]\nsampling = \"hypercube\"\nn_samples = 10\n[uncertainty.q]\n"
      "keys = \"ground.ground.friction_deg\"\ndistribution = \"normal\"\nstd = 2\n",
      10);
  EXPECT_EQ(drawn_keys(site, DrawScope::all).size(), 1U);
  site.uncertainty.sample = 11;
  EXPECT_THROW(static_cast<void>(drawn_keys(site, DrawScope::all)), InputError);
}

}  // namespace
