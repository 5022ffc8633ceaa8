// The site file: values, defaults, misspelt keys, page of keys.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "base/random.hpp"
#include "site/site.hpp"
#include "site/site_layers.hpp"
#include "site/soils.hpp"

namespace {

using talus::InputError;
using talus::parse_site;
using talus::Site;

constexpr const char* whole = R"(
[site]
name = "wall"
crs = "EPSG:31287"

[source]
polygon = [[10, 20], [30, 20], [30.5, 40]]
failure_surface = "vertical_depth"
depth_m = 8

[joints.J2]
dip_deg = 80
dip_direction_deg = 324
spacing_m = 6
[joints.J1]
dip_deg = 44
dip_direction_deg = 144
spacing_m = 5

[ground.scree]
friction_deg = 32
[blocks.one]
shape = "box"
size_m = [1, 2, 3]
position_m = [5, 6]
)";

// The message that refuses a site file.
std::string refusal(const std::string& text) {
  try {
    static_cast<void>(parse_site(text, "s/site.toml"));
  } catch (const InputError& error) {
    return std::string(error.what()) + " | " + error.hint();
  }
  return "accepted";
}

}  // namespace

TEST(Site, ValuesDefaultsAndTheOrderOfTheFile) {
  const Site site = parse_site(whole, "s/site.toml");
  EXPECT_EQ(site.info.name, "wall");
  ASSERT_EQ(site.joints.size(), 2u);
  EXPECT_EQ(site.joints[0].name, "J2");
  EXPECT_EQ(site.joints[1].dip_direction_deg, 144);
  ASSERT_EQ(site.source.polygon.size(), 3u);
  EXPECT_EQ(site.source.polygon[2].x(), 30.5);
  EXPECT_EQ(site.materials.at(0).density_kg_m3, 2600);
  EXPECT_EQ(site.grounds.at(0).friction_deg, 32);
  EXPECT_TRUE(std::isnan(site.solver.time_step_s));
  ASSERT_EQ(site.blocks.at(0).position_m.size(), 1u);
  EXPECT_TRUE(std::isnan(site.blocks[0].position_m[0].z()));
  EXPECT_EQ(talus::where_of(site, "source.depth_m").text(), "s/site.toml:9");
  EXPECT_EQ(talus::resolved(site, "map.gpkg"), "s/map.gpkg");
  EXPECT_EQ(talus::resolved(site, "/data/map.gpkg"), "/data/map.gpkg");
}

TEST(Site, UnknownKeysNameTheNearestAndTheLine) {
  EXPECT_EQ(refusal("[joints.J1]\n\ndip_degree = 3\n"),
            "s/site.toml:3: unknown key dip_degree in [joints.J1] | did you mean dip_deg?");
  EXPECT_NE(refusal("[source]\ndepth = 3\n").find("did you mean depth_m?"), std::string::npos);
  EXPECT_NE(refusal("[joints.J1]\nspacing_max = 3\n").find("did you mean spacing_max_m?"),
            std::string::npos);
  EXPECT_NE(refusal("[joints.J1]\nstrike_deg = 3\n").find("dip_direction_deg is the azimuth of"),
            std::string::npos);
  EXPECT_EQ(refusal("[solvr]\nlaw = 'paper'\n"),
            "s/site.toml:1: unknown section solvr | did you mean solver?");
  EXPECT_NE(refusal("friction_deg = 3\n").find("key outside any section"), std::string::npos);
}

TEST(Site, ValuesOutOfRangeSayWhatIsExpected) {
  EXPECT_EQ(refusal("[ground.g]\nfriction_deg = 250\n"),
            "s/site.toml:2: friction_deg is 250, expected 0 to below 90 | give degrees; a friction "
            "coefficient mu is atan(mu) in degrees");
  EXPECT_NE(refusal("[joints.a]\nspacing_m = 0").find("expected above 0"), std::string::npos);
  EXPECT_NE(refusal("[joints.a]\nspacing_m = -1").find("expected above 0"), std::string::npos);
  EXPECT_NE(refusal("[joints.a]\ndip_deg = 91").find("expected 0 to 90"), std::string::npos);
  EXPECT_NE(refusal("[joints.a]\ndip_deg = nan").find("is nan"), std::string::npos);
  EXPECT_NE(refusal("[joints.a]\ndip_deg = 'steep'").find("is text, expected a number"),
            std::string::npos);
  EXPECT_NE(refusal("[solver]\nlaw = 'other'").find("one of talus|paper"), std::string::npos);
  EXPECT_NE(refusal("[source]\nseed = 1.5").find("expected a whole number"), std::string::npos);
  EXPECT_NE(refusal("[source]\npolygon = [[1, 2], [3, 4]]").find("at least 3"), std::string::npos);
  EXPECT_NE(refusal("[fence.f]\nline = [[1, 2]]").find("at least 2"), std::string::npos);
  EXPECT_NE(refusal("[source]\nmaterial = 'gneis'\n[material.gneiss]").find("gneiss?"),
            std::string::npos);
  EXPECT_NE(refusal("[source]\n[material.a]\n[material.b]").find("several materials"),
            std::string::npos);
}

TEST(Site, TextThatIsNotTomlIsRefusedWithItsLine) {
  EXPECT_EQ(refusal("[site]\nname = \n").rfind("s/site.toml:2: ", 0), 0u);
  EXPECT_EQ(refusal("[site]\nname = 'a'\nname = 'b'\n").rfind("s/site.toml:3: ", 0), 0u);
  EXPECT_NE(refusal("site = 3").find("expected a section"), std::string::npos);
  EXPECT_NE(refusal("[joints]\ndip_deg = 3").find("write [joints.NAME]"), std::string::npos);
}

TEST(Site, TheCommandLineOverridesTheFile) {
  Site site = parse_site(whole, "s/site.toml");
  talus::override_value(site, "source.depth_m", "12");
  talus::override_value(site, "joints.J1.spacing_m", "2.5");
  talus::override_value(site, "solver.law", "paper");
  EXPECT_EQ(site.source.depth_m, 12);
  EXPECT_EQ(site.joints[1].spacing_m, 2.5);
  EXPECT_EQ(site.solver.law, "paper");
  EXPECT_THROW(talus::override_value(site, "solver.lawn", "paper"), InputError);
  EXPECT_THROW(talus::override_value(site, "joints.J9.dip_deg", "3"), InputError);
  try {
    talus::override_value(site, "joints.J22.dip_deg", "3");
    ADD_FAILURE() << "joints.J22 is known";
  } catch (const InputError& error) {
    EXPECT_EQ(error.hint(), "did you mean joints.J2?");
  }
  EXPECT_THROW(talus::override_value(site, "solver.duration_s", "soon"), InputError);
  EXPECT_THROW(talus::override_value(site, "duration_s", "3"), InputError);
  EXPECT_THROW(talus::override_value(site, "source.depth_m", "1\nseed = 3"), InputError);
  EXPECT_THROW(talus::override_value(site, "source.depth_m", "1]\nseed = [3"), InputError);
  EXPECT_THROW(talus::override_value(site, "source.depth_m", "5 # m"), InputError);
  for (const char* name : {"2024", "true", "a #1", "1 # 2", "[1]", "a = b"}) {
    talus::override_value(site, "site.name", name);
    EXPECT_EQ(site.info.name, name);
  }
}

// A printed configuration reads back as the same one.
TEST(Site, ANameMayHoldWhatAKeyAndItsValueArePartedBy) {
  const std::string fence = "line = [[0, 0], [1, 1]]\n";
  Site site = parse_site(
      "[fence.\"a=b\"]\n" + fence + "[fence.a]\n" + fence + "[fence.\"v1.5 = 'x' #2\"]\n" + fence,
      "site.toml");
  const auto set = [&site](const std::string& words) {
    const std::size_t at = talus::end_of_key(site, words);
    talus::override_value(site, words.substr(0, at), words.substr(at + 1));
  };
  set("fence.a=b.active=false");
  set("fence.v1.5 = 'x' #2.height_m=7");
  set("fence.a.file=f.gpkg|subset=name = 'a=b'");
  EXPECT_FALSE(site.fences[0].active);
  EXPECT_EQ(site.fences[1].file, "f.gpkg|subset=name = 'a=b'");
  EXPECT_TRUE(site.fences[1].active);
  EXPECT_EQ(site.fences[2].height_m, 7);
  EXPECT_EQ(talus::end_of_key(site, "solver.lawn=paper"), 11U);
  EXPECT_EQ(talus::end_of_key(site, "solver.law"), std::string::npos);
}

TEST(Site, NamesOfWhatIsNotSeenAreRefusedWhereverTheyStand) {
  for (const char* name : {"\\u001b[2J", "a\\nb", "a\\tb", "\\u202egnp", "\\u0085"}) {
    const std::string text = std::string("[ground.\"") + name + "\"]\nfriction_deg = 30\n";
    EXPECT_THROW(static_cast<void>(parse_site(text, "site.toml")), InputError) << name;
  }
  Site site = parse_site("[site]\nname = \"a\"\n", "site.toml");
  EXPECT_THROW(
      talus::take_sections(site, {{"fence", "a\x1b[2J", "site.gpkg, fences", {}, "digest"}}),
      InputError);
  EXPECT_NO_THROW(static_cast<void>(
      parse_site("[ground.\"H\u00f6he 50 % #1 (a/b); $x 'y'\"]\nfriction_deg = 30\n", "s")));
}

TEST(Site, PrintedConfigurationReadsBackTheSame) {
  Site site = parse_site(whole, "s/site.toml");
  talus::override_value(site, "source.depth_m", "12");
  const std::string printed = talus::print_config(site);
  EXPECT_NE(printed.find("depth_m = 12  # cli"), std::string::npos);
  EXPECT_NE(printed.find("dip_deg = 44  # file, line 16"), std::string::npos);
  EXPECT_NE(printed.find("law = 'talus'  # default"), std::string::npos);
  const auto without_comments = [](const std::string& text) {
    std::string kept;
    for (size_t i = 0; i < text.size(); ++i) {
      if (text.compare(i, 3, "  #") == 0) i = text.find('\n', i);
      kept += text[i];
    }
    return kept;
  };
  EXPECT_EQ(without_comments(printed),
            without_comments(talus::print_config(parse_site(printed, "s/site.toml"))));
}

// A key with a dimension says its unit, so that no number is without one.
TEST(Site, EveryKeyIsDescribedAndUnique) {
  std::set<std::string> seen;
  for (const auto& row : talus::site_keys()) {
    EXPECT_TRUE(seen.insert(row.section + "." + row.key).second) << row.key;
    EXPECT_FALSE(row.help.empty()) << row.key;
  }
  EXPECT_TRUE(seen.count("joints.NAME.dip_deg"));
}

// Whoever adds a key takes another one away.
TEST(Site, KeysAreNoMoreThanThese) {
  const std::size_t n = talus::site_keys().size();
  std::cout << n << " keys of the site file\n";
  EXPECT_LE(n, 285U);
}

TEST(Site, AKeyThatIsGoneSaysWhatToWriteInstead) {
  EXPECT_EQ(refusal("[source]\npolygon_layer = 'release'\n"),
            "s/site.toml:2: the key polygon_layer of [source] is gone | write polygon_file = "
            "\"FILE|layername=LAYER\"");
  EXPECT_EQ(refusal("[fence.a]\nline_file = 'f.gpkg'\n"),
            "s/site.toml:2: the key line_file of [fence.a] is gone | write file = \"FILE\"");
  EXPECT_EQ(refusal("[fence.a]\nline_where = 'k = 1'\n"),
            "s/site.toml:2: the key line_where of [fence.a] is gone | write file = "
            "\"FILE|subset=FILTER\"");
  EXPECT_EQ(refusal("[solver]\ncor = 0.3\n"),
            "s/site.toml:2: the key cor of [solver] is gone | write cor in [material.NAME] and "
            "[ground.NAME]");
  EXPECT_EQ(refusal("[fence.a]\nbreaklines_layer = 'a'\n").find("gone"), std::string::npos);
}

// --- the page of keys ----------------------------------------------------------------------------

void replace_all(std::string& text, const std::string& from, const std::string& to) {
  for (size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
}

// "0.3 (0..1)", "fill (keep)": the default, and what is allowed in brackets.
std::string default_and_allowed(const talus::KeyDescription& row) {
  static const std::map<std::string, std::string> types = {{"whole number", "integer"},
                                                           {"list of numbers", "numbers"},
                                                           {"list of points", "points"},
                                                           {"list of texts", "texts"}};
  std::string given = row.default_value, allowed;
  if (row.type == "text") {
    if (!given.empty()) given = given.substr(1, given.size() - 2);  // without quotes
    std::istringstream choices(row.range);
    for (std::string choice; std::getline(choices, choice, '|');)
      if (choice != given) allowed += (allowed.empty() ? "" : ", ") + choice;
  } else {
    allowed = row.range;
    replace_all(allowed, " to below ", "..<");
    replace_all(allowed, " to ", "..");
    replace_all(allowed, "above ", ">");
    replace_all(allowed, "at least ", ">=");
    if (types.contains(row.type))
      allowed = types.at(row.type) + (allowed.empty() ? "" : " ") + allowed;
    else if (row.type == "number" && given.empty() && allowed.empty())
      allowed = row.type;
  }
  const char* between = given.empty() || allowed.empty() ? "" : " ";
  return given + between + (allowed.empty() ? "" : "(" + allowed + ")");
}

using KeyLine = std::pair<std::string, std::string>;  // key in quotes, the rest of its line

std::string lines_of(const std::vector<KeyLine>& keys) {
  std::string out;
  for (size_t i = 0; i < keys.size(); ++i) {
    const bool goes_on = i > 0 && keys[i].second == keys[i - 1].second;
    out += (goes_on ? ", " : "| ") + keys[i].first;
    if (i + 1 == keys.size() || keys[i + 1].second != keys[i].second) out += keys[i].second;
  }
  return out;
}

// A section; keys that another one has, too, are named on one line.
std::string table_of(const std::string& section, const std::vector<KeyLine>& keys,
                     std::map<KeyLine, std::string>& first) {
  std::map<std::string, std::vector<KeyLine>> shared;  // by the section that has them
  for (const KeyLine& key : keys)
    if (first.contains(key))
      shared[first.at(key)].emplace_back(key.first, " |  | as in [" + first.at(key) + "] |\n");
  std::string out = "\n### [" + section + "]\n| Key | Value | Meaning |\n|---|---|---|\n";
  for (const auto& [other, lines] : shared)
    if (lines.size() > 1) out += lines_of(lines);
  std::vector<KeyLine> own;
  for (const KeyLine& key : keys)
    if (!first.contains(key) || shared.at(first.at(key)).size() == 1) own.push_back(key);
  for (const KeyLine& key : keys) first.emplace(key, section);
  return out + lines_of(own);
}

// docs/reference/site-file.md holds the table of keys; TALUS_PRINT_KEYS=1 prints its text.
TEST(Site, ThePageOfKeysIsTheTable) {
  std::vector<std::pair<std::string, std::vector<KeyLine>>> sections;
  for (const talus::KeyDescription& row : talus::site_keys()) {
    if (sections.empty() || sections.back().first != row.section)
      sections.emplace_back(row.section, std::vector<KeyLine>());
    sections.back().second.emplace_back(
        "`" + row.key + "`", " | " + default_and_allowed(row) + " | " + row.help + " |\n");
  }
  std::string rows;
  std::map<KeyLine, std::string> first;
  for (const auto& [section, keys] : sections) rows += table_of(section, keys, first);
  if (std::getenv("TALUS_PRINT_KEYS")) std::cout << rows;
  std::ifstream file(std::string(TALUS_SOURCE_DIR) + "/docs/reference/site-file.md");
  std::ostringstream page;
  page << file.rdbuf();
  EXPECT_NE(page.str().find(rows), std::string::npos) << "the table of keys has changed";
}

// Mangled files are refused or accepted, never anything else.
TEST(Site, MangledFilesNeverCrash) {
  talus::Random random(3);
  const std::string source = whole;
  for (int trial = 0; trial < 3000; ++trial) {
    std::string text = source;
    for (int k = 0; k < 1 + trial % 4; ++k) {
      const size_t at = random.below(text.size());
      switch (random.below(4)) {
        case 0:
          text.erase(at, random.below(20));
          break;
        case 1:
          text.insert(at, 1, static_cast<char>(random.below(256)));
          break;
        case 2:
          text[at] = "[]=.\"'{}\n-e9"[random.below(12)];
          break;
        default:
          text.insert(at, source.substr(random.below(source.size()), random.below(30)));
      }
      if (text.empty()) break;
    }
    EXPECT_FALSE(refusal(text).empty());
  }
}

// --- soils -------------------------------------------------------------------------------------

TEST(SiteSoil, FillsKeysThatAreNotGiven) {
  Site site = parse_site("[ground.g]\nsoil = 'meadow'\nfriction_deg = 31\n", "s/site.toml");
  const talus::GroundSettings& ground = site.grounds.at(0);
  EXPECT_EQ(ground.friction_deg, 31);
  EXPECT_EQ(ground.cor, 0.9);
  EXPECT_EQ(ground.cor_half_energy_kj, 2);
  EXPECT_EQ(ground.bearing_kpa, 4000);
  const std::string printed = talus::print_config(site);
  EXPECT_NE(printed.find("cor = 0.9  # soil meadow (field test)"), std::string::npos);
  EXPECT_NE(printed.find("friction_deg = 31  # file, line 3"), std::string::npos);
  EXPECT_NE(printed.find("\n# field test: 18 runs at Tschamut"), std::string::npos);
  EXPECT_EQ(parse_site(printed, "s/site.toml").grounds.at(0).cor, 0.9);
}

TEST(SiteSoil, AnotherOneTakesThePlaceOfWhatTheFirstFilled) {
  Site site = parse_site("[ground.g]\nsoil = 'meadow'\n", "s/site.toml");
  talus::override_value(site, "ground.g.soil", "swamp");
  EXPECT_EQ(site.grounds[0].cor, 0);
  EXPECT_TRUE(std::isnan(site.grounds[0].cor_half_energy_kj));
  EXPECT_EQ(site.grounds[0].friction_deg, 30);
  talus::override_value(site, "ground.g.bearing_kpa", "100");
  talus::override_value(site, "ground.g.soil", "rock");
  EXPECT_EQ(site.grounds[0].bearing_kpa, 100);
  EXPECT_EQ(site.grounds[0].cor_half_energy_kj, 4);
}

TEST(SiteSoil, LeavesOutWhatAGivenKeyExcludes) {
  const Site site = parse_site(
      "[ground.g]\nsoil = 'talus'\nrolling_resistance = 0.1\ncor_half_speed_m_s = 5\n", "s");
  EXPECT_TRUE(std::isnan(site.grounds[0].bearing_kpa));
  EXPECT_TRUE(std::isnan(site.grounds[0].cor_half_energy_kj));
  talus::check_grounds(site);
}

// Every soil is a choice of the key, and every choice a soil.
TEST(SiteSoil, TheKeyNamesEverySoil) {
  std::string names;
  for (const talus::Soil& soil : talus::soils()) {
    names += (names.empty() ? "" : "|") + std::string(soil.name);
    EXPECT_EQ(refusal(std::string("[ground.g]\nsoil = '") + soil.name + "'\n"), "accepted");
  }
  EXPECT_NE(refusal("[ground.g]\nsoil = 'lawn'\n").find("\"lawn\", expected one of " + names),
            std::string::npos);
}

std::string refusal_of_ground(const std::string& keys) {
  try {
    talus::check_grounds(parse_site("[ground.g]\n" + keys, "s/site.toml"));
  } catch (const InputError& error) {
    return std::string(error.what()) + " | " + error.hint();
  }
  return "accepted";
}

TEST(SiteSoil, KeysThatExcludeOrNeedEachOtherAreRefused) {
  EXPECT_EQ(refusal_of_ground("cor_half_speed_m_s = 5\ncor_half_energy_kj = 3\n"),
            "s/site.toml:3: [ground.g] has cor_half_speed_m_s and cor_half_energy_kj, which "
            "exclude each other | one says how COR falls: by speed, or by energy");
  const auto says = [](const std::string& keys, const std::string& words) {
    EXPECT_NE(refusal_of_ground(keys).find(words), std::string::npos) << refusal_of_ground(keys);
  };
  says("rolling_resistance = 0.1\nbearing_kpa = 90\n", "rolling_resistance and bearing_kpa");
  says("scar_friction = 2\n", "scar_friction without scar_rate_1_m");
  says("scar_decay_1_s = 2\n", "scar_decay_1_s without scar_friction");
  says("scar_friction = 0.2\nscar_rate_1_m = 1\nscar_decay_1_s = 9\n", "below the tangent");
  says("friction_weak_deg = 10\n", "friction_weak_deg without weakening_speed_m_s");
  says("friction_weak_deg = 40\nweakening_speed_m_s = 4\n", "above friction_deg, 30");
  says(
      "scar_friction = 2\nscar_rate_1_m = 1\nscar_decay_1_s = 9\nfriction_weak_deg = 5\n"
      "weakening_speed_m_s = 4\n",
      "scar_friction and friction_weak_deg");
  says("jrc = 10\n", "jrc without jcs_mpa");
  says("jcs_mpa = 100\n", "jcs_mpa without jrc");
  says("jrc = 10\njcs_mpa = 100\ncohesion_pa = 1e4\n", "jrc and cohesion or tension");
  says("jrc = 10\njcs_mpa = 100\nfriction_deg = 0\n", "friction_deg is 0");
  says("jrc = 10\njcs_mpa = 100\nfriction_weak_deg = 5\nweakening_speed_m_s = 4\n",
       "jrc and friction_weak_deg");
  says("jrc = 10\njcs_mpa = 100\n", "accepted");
  says("rolling_resistance = 0.1\ndrag_1_s = 1\n", "accepted");
}

// --- layers for sections -------------------------------------------------------------------------

namespace {

talus::LayerSection section_of(const std::string& group, const std::string& name,
                               std::vector<talus::LayerSection::Value> values) {
  return {group, name, "site.gpkg, layer x, feature 2", std::move(values)};
}

std::string refusal_of_layer(const std::string& text, const talus::LayerSection& section) {
  Site site = parse_site(text, "s/site.toml");
  try {
    take_sections(site, {section});
  } catch (const InputError& error) {
    return std::string(error.what()) + " | " + error.hint();
  }
  return "accepted";
}

}  // namespace

TEST(SiteLayers, ASectionOfALayerIsAsOneOfTheFile) {
  Site site = parse_site(whole, "s/site.toml");
  take_sections(site, {section_of("fence", "road",
                                  {{"file", "site.gpkg"}, {"height_m", "4"}, {"active", "false"}}),
                       section_of("blocks", "two", {{"shape", "box"}, {"size_m", "[1, 2, 3]"}}),
                       section_of("ground", "scree", {{"cor", "0.2"}})});
  ASSERT_EQ(site.fences.size(), 1u);
  EXPECT_EQ(site.fences[0].name, "road");
  EXPECT_EQ(site.fences[0].height_m, 4);
  EXPECT_FALSE(site.fences[0].active);
  EXPECT_EQ(site.fences[0].post_spacing_m, 10);  // the default
  ASSERT_EQ(site.blocks.size(), 2u);
  EXPECT_EQ(site.blocks[1].size_m, (std::vector<double>{1, 2, 3}));
  ASSERT_EQ(site.grounds.size(), 1u);  // joins the section of the file
  EXPECT_EQ(site.grounds[0].friction_deg, 32);
  EXPECT_EQ(site.grounds[0].cor, 0.2);
  for (const talus::EffectiveValue& value : effective_values(site)) {
    if (value.section == "fence.road" && value.key == "height_m") {
      EXPECT_EQ(value.source, "site.gpkg, layer x, feature 2");
    }
  }
}

TEST(SiteLayers, WhatIsPrintedReadsBackWithoutTheLayers) {
  Site site = parse_site(whole, "s/site.toml");
  const std::string file = "site.gpkg|layername=fences|subset=name = 'road'";
  take_sections(site, {section_of("fence", "road", {{"file", file}})});
  const Site again = parse_site(print_config(site), "s/site.toml");
  ASSERT_EQ(again.fences.size(), 1u);
  EXPECT_EQ(again.fences[0].file, file);
}

TEST(SiteLayers, AKeyIsSaidOnceAndHeldToItsRange) {
  EXPECT_EQ(refusal_of_layer(whole, section_of("source", "", {{"depth_m", "5"}})),
            "site.gpkg, layer x, feature 2: depth_m of [source] stands here and in s/site.toml:9 | "
            "say it once: take it out of one of the two");
  EXPECT_NE(refusal_of_layer(whole, section_of("fence", "road", {{"height_m", "-4"}}))
                .find("site.gpkg, layer x, feature 2: fence.road.height_m is -4, expected above 0"),
            std::string::npos);
  EXPECT_NE(refusal_of_layer(whole, section_of("ground", "new", {{"soil", "moss"}})).find("soil"),
            std::string::npos);
  EXPECT_EQ(refusal_of_layer(whole, section_of("ground", "new", {{"soil", "scree"}})), "accepted");
}

TEST(SiteLayers, EveryFieldOfALayerIsAKeyOfItsSection) {
  for (const talus::SiteLayer& layer : talus::site_layers()) {
    const std::string section = has_names(layer) ? layer.section + ".NAME" : layer.section;
    std::set<std::string> keys;
    for (const talus::KeyDescription& row : talus::site_keys())
      if (row.section == section) keys.insert(row.key);
    for (const std::string& field : layer.fields)
      EXPECT_TRUE(keys.count(field)) << layer.name << ": " << field;
    EXPECT_TRUE(keys.count(layer.prefix + "file")) << layer.name;
  }
}
