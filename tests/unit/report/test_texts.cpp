// Texts of the page: values, translations, refusals.
#include <gtest/gtest.h>

#include "base/error.hpp"
#include "report/texts.hpp"
#include "unit/report/shipped_texts.hpp"

using namespace talus;

namespace {

const char* const page = R"([maps]
title = "Maps"
plan = """
Run {run};
  north is {side}."""
heads = ["run", "from {n}"]
)";

Texts page_texts() { return parse_texts(page, "texts.toml"); }

// The message when a file with this content takes the place of the page's texts.
std::string refusal(const std::string& content) {
  try {
    page_texts().replace_by(parse_texts(content, "office.toml"));
  } catch (const InputError& error) {
    return error.what() + std::string("; ") + error.hint();
  }
  return "accepted";
}

}  // namespace

TEST(Texts, ValuesStandInPlaceOfTheirNames) {
  const Texts texts = page_texts();
  EXPECT_EQ(texts.of("maps.title"), "Maps");
  EXPECT_EQ(texts.of("maps.plan", {{"side", "up"}, {"run", "{side} 3"}}),
            "Run {side} 3; north is up.");
  EXPECT_EQ(texts.list("maps.heads"), (std::vector<std::string>{"run", "from {n}"}));
  EXPECT_EQ(talus::testing::shipped_texts().counted(1, "words.run", "words.runs"), "1 run");
  EXPECT_EQ(talus::testing::shipped_texts().counted(0, "words.run", "words.runs"), "0 runs");
}

TEST(Texts, AFileReplacesWhatItHas) {
  Texts texts = page_texts();
  const Texts office =
      parse_texts("maps.title = 'Karten'\nmaps.plan = 'Lauf {run}, {run}'", "office.toml");
  EXPECT_EQ(texts.replace_by(office), std::vector<std::string>{"maps.heads"});
  EXPECT_EQ(texts.of("maps.title"), "Karten");
  EXPECT_EQ(texts.of("maps.plan", {{"run", "3"}, {"side", "up"}}), "Lauf 3, 3");
  EXPECT_EQ(texts.list("maps.heads")[0], "run");
  EXPECT_TRUE(page_texts().replace_by(page_texts()).empty());
}

TEST(Texts, WhatDoesNotFitIsRefusedWithItsLine) {
  EXPECT_EQ(refusal("[maps]\n\ntitel = 'Karten'"),
            "office.toml:3: maps.titel: is not a key of these texts; did you mean maps.title?");
  EXPECT_EQ(refusal("[maps]\nplan = 'Lauf {lauf}'"),
            "office.toml:2: maps.plan: has {lauf}, which is not a value of this text; its values: "
            "{run}, {side}");
  EXPECT_EQ(
      refusal("[maps]\ntitle = '{n} Karten'"),
      "office.toml:2: maps.title: has {n}, which is not a value of this text; its values: none");
  EXPECT_EQ(refusal("[maps]\nheads = ['Lauf']").substr(0, 72),
            "office.toml:2: maps.heads: is a list of 1 text, expected a list of 2 tex");
  EXPECT_EQ(refusal("[maps]\nheads = 'Lauf'").substr(0, 60),
            "office.toml:2: maps.heads: is one text, expected a list of 2");
  EXPECT_EQ(refusal("[maps]\ntitle = ['Karten']").substr(0, 55),
            "office.toml:2: maps.title: is a list of 1 text, expecte");
  EXPECT_EQ(refusal("[maps]\ntitle = 3").substr(0, 62),
            "office.toml:2: maps.title: is not a text, nor a list of texts;");
  EXPECT_EQ(refusal("[maps]\ntitle = 'a { b'").substr(0, 61),
            "office.toml:2: maps.title: has a brace that begins no {name};");
  EXPECT_EQ(refusal("[maps]\ntitle = 'a'\ntitle = 'b'").substr(0, 14), "office.toml:3:");
  EXPECT_EQ(refusal("[maps]\nplan = 'Lauf {run}'"), "accepted");
}

TEST(Texts, WordsOfResultsAreTranslatedByTheirNearestForm) {
  const Texts texts = parse_texts(R"toml(number.decimal = ","
number.thousands = "."
[said]
"pass" = "bestanden"
"{n} runs" = "{n} Läufe"
"{n} runs failed: {why}" = "{why} ({n} Läufe)"
)toml",
                                  "de.toml");
  EXPECT_EQ(texts.said("pass"), "bestanden");
  EXPECT_EQ(texts.said("12,300.5 runs"), "12.300,5 Läufe");
  EXPECT_EQ(texts.said("3 runs failed: pass"), "bestanden (3 Läufe)");
  EXPECT_EQ(texts.said("3 blocks"), "3 blocks") << "what is not known stays";
  EXPECT_EQ(texts.said("version 1.2"), "version 1.2");
  EXPECT_EQ(texts.number("1.5 - 2,000 of 0.2.0"), "1,5 - 2.000 of 0.2.0");
  EXPECT_EQ(refusal("said.\"{n} runs\" = \"{m}\""),
            "office.toml:1: said.{n} runs: has {m}, which the words have not; the same names on "
            "both sides");
}

// Each shipped translation says all that the page says, with the same values.
TEST(Texts, TranslationsAreWhole) {
  for (const std::string language : {"de", "fr", "it"}) {
    const std::string path = TALUS_SOURCE_DIR "/tools/report/texts." + language + ".toml";
    Texts texts = talus::testing::shipped_texts();
    EXPECT_EQ(texts.replace_by(parse_texts(read_file(path), path)),
              std::vector<std::string>{"page.sections"});
    EXPECT_EQ(texts.of("page.language"), language);
  }
}
