#include <gtest/gtest.h>

#include "site/site.hpp"

using namespace talus;

namespace {

constexpr const char* base = R"(
[source]
polygon = [[10, 20], [30, 20], [30.5, 40]]
depth_m = 8
[joints.J1]
dip_deg = 44
dip_direction_deg = 144
spacing_m = 5
[ground.slope]
friction_deg = 32
[fence.net]
line = [[0, 0], [9, 0]]
height_m = 4
[forest.wood]
polygon = [[0, 0], [1, 0], [1, 1]]
stems_per_ha = 300
)";

Site site_of(const std::string& variants) { return parse_site(base + variants, "s/site.toml"); }

Site applied(const std::string& variants, const std::string& name) {
  Site site = site_of(variants);
  apply_variant(site, name);
  return site;
}

std::string refusal(const std::string& variants) {
  try {
    check_variants(site_of(variants));
  } catch (const InputError& error) {
    return std::string(error.what()) + " | " + error.hint();
  }
  return "accepted";
}

}  // namespace

TEST(Variants, ChangeKeysAddSectionsAndLackThem) {
  const std::string variants = R"(
[variant.high]
cost = 120000
without = ["forest.wood"]
fence.net.height_m = 6
[variant.high.fence.second]
line = [[0, 5], [9, 5]]
[variant.high.ground.slope]
friction_deg = 33
)";
  const Site site = applied(variants, "high");
  ASSERT_EQ(site.fences.size(), 2U);
  EXPECT_EQ(site.fences[0].height_m, 6);
  EXPECT_EQ(site.fences[0].line.size(), 2U);
  EXPECT_EQ(site.fences[1].name, "second");
  EXPECT_EQ(site.fences[1].line[1].y(), 5);
  EXPECT_TRUE(site.forests.empty());
  EXPECT_EQ(site.grounds[0].friction_deg, 33);
  EXPECT_TRUE(site.alternative.empty());
  EXPECT_EQ(site.variants[0].cost, 120000);
  EXPECT_NE(print_config(site).find("height_m = 6  # variant high, line 21"), std::string::npos)
      << print_config(site);
  EXPECT_EQ(site_of(variants).fences[0].height_m, 4);
  EXPECT_EQ(refusal(variants), "accepted");
}

// The same site, written as if there were no variants.
TEST(Variants, GiveTheValuesThatTheFileWouldGive) {
  const Site variant = applied("[variant.v.fence.net]\nfile = 'net.gpkg'\nheight_m = 5.25\n", "v");
  std::string text = base;
  text.replace(text.find("line = [[0, 0], [9, 0]]"), 23, "file = 'net.gpkg'");
  text.replace(text.find("height_m = 4"), 12, "height_m = 5.25");
  const auto values = effective_values(variant),
             expected = effective_values(parse_site(text, "s/site.toml"));
  std::size_t n = 0;
  for (const EffectiveValue& value : values) {
    if (value.section.starts_with("variant")) continue;
    EXPECT_EQ(value.section + value.key + value.value,
              expected[n].section + expected[n].key + expected[n].value);
    ++n;
  }
  EXPECT_EQ(n, expected.size());
}

TEST(Variants, WithAWeightAreAlternativesOfOneAnother) {
  const std::string variants =
      "[variant.low]\nweight = 3\nground.slope.friction_deg = 28\n[variant.as_it_is]\nweight = 1\n";
  EXPECT_EQ(refusal(variants), "accepted");
  Site site = applied(variants, "low");
  EXPECT_EQ(site.alternative, "low");
  EXPECT_THROW(apply_variant(site, "as_it_is"), InputError);
  EXPECT_EQ(refusal("[variant.low]\nweight = 3\n"),
            "s/site.toml:17: [variant.low] alone has a weight | the site as it is counts too where "
            "a variant has its weight alone: [variant.as_it_is] and weight = 1");
  const std::string two = "[variant.a]\nweight = 3\n[variant.b]\nweight = 1\n";
  EXPECT_NE(refusal(two + "joints.J1.spacing_m = 4\nsource.depth_m = 7\n").find("share terrain"),
            std::string::npos);
  // neither the terrain with its dams nor the rock is made anew
  const std::string dam = "[dam.road]\nline = [[0, 5], [9, 5]]\n";
  for (const std::string key : {"dam.road.height_m = 6\n", "dam.road.ditch_m = [3, 6]\n",
                                "dam.road.active = false\n", "joints.J1.spacing_m = 4\n"})
    EXPECT_NE(refusal(dam + two + key).find("share terrain"), std::string::npos) << key;
  EXPECT_EQ(refusal(dam + two + "joints.J1.friction_deg = 31\n"), "accepted");
  EXPECT_NE(refusal(two + "without = ['fence.net']\n").find("other sections than the site"),
            std::string::npos);
  EXPECT_NE(refusal(two + "cost = 7\n").find("a weight and a cost"), std::string::npos);
}

TEST(Variants, WhatCannotBeComparedIsRefusedWithAWayOut) {
  const auto expect = [](const std::string& lines, const std::string& words) {
    const std::string said = refusal("[variant.v]\n" + lines);
    EXPECT_NE(said.find(words), std::string::npos) << said;
  };
  expect("fence.nett.height_m = 6\n",
         "changes fence.nett, which the site does not have | did you mean net?");
  expect("fence.net.heigth_m = 6\n",
         "unknown key heigth_m in [fence.net] | did you mean height_m?");
  expect("fence.height_m = 6\n", "write [variant.v.fence.NAME]");
  expect("fences.net.height_m = 6\n",
         "unknown section fences.net in [variant.v] | did you mean fence?");
  expect("fence.net.height_m = -1\n", "s/site.toml:18: fence.net.height_m is -1");
  expect("without = ['fence.nett']\n", "has no such section | did you mean fence.net?");
  expect("source.depth_m = 7\n", "would draw other rocks");
  expect("joints.J1.spacing_m = 7\n", "would draw other rocks");
  expect("joints.J1.friction_deg = 40\n", "accepted");
  expect("solver.n_runs = 7\n", "for all variants");
  expect("solver.seed = 7\n", "for all variants");
  expect("terrain.cell_size_m = 7\n", "for all variants");
  expect("site.name = 'b'\n", "write it in [site]");
  expect("uncertainty.rock_masses = 7\n", "would draw other rocks");
  expect("terrain.dem = 'b.tif'\n", "accepted");
}

// One rock a year from two sources: without one of them the whole year would be the other's.
TEST(Variants, WithoutASourceNeedsFrequenciesOfTheSources) {
  const auto said = [](const std::string& frequencies, const std::string& frequency_of_class,
                       const std::string& lines) {
    std::string text = "[ground.slope]\nfriction_deg = 32\n";
    for (const char* name : {"a", "b"})
      text += std::string("[rockfall.") + name +
              "]\nshape = 'box'\nsize_m = [1, 1, 1]\nposition_m = [[1, 2]]\n" + frequencies;
    text += "[hazard.class.rocks]\n" + frequency_of_class +
            "[variant.scaled]\nwithout = ['rockfall.a']\n" + lines;
    try {
      check_variants(parse_site(text, "s/site.toml"));
    } catch (const InputError& error) {
      return std::string(error.what()) + " | " + error.hint();
    }
    return std::string("accepted");
  };
  EXPECT_EQ(said("", "frequency_per_a = 1\n", ""),
            "s/site.toml:14: [variant.scaled] is without rockfall.a, and "
            "the frequency of [hazard.class.rocks] is that of all sources together: it would all "
            "come from the others | take it out of the class and give each [rockfall.*] its "
            "frequency_per_a; or change it in [variant.scaled] too");
  EXPECT_NE(said("", "events = 3\nobserved_a = 9\n", "").find("all sources"), std::string::npos);
  EXPECT_EQ(said("frequency_per_a = 0.5\n", "", ""), "accepted");
  EXPECT_EQ(said("", "frequency_per_a = 1\n", "hazard.class.rocks.frequency_per_a = 0.5\n"),
            "accepted");
}
