// The template of the page: values, blocks, languages.
#include <gtest/gtest.h>

#include "base/error.hpp"
#include "report/page_template.hpp"
#include "report/texts.hpp"

using namespace talus;

namespace {

const char* const words = R"([page]
sections = ["two", "one"]
[nav]
one = "One"
two = "Two"
[one]
title = "First"
hit = "{name}: {n} hits, {share}"
heads = ["name", "hits"]
[two]
title = "Second"
[kind]
road = "a road"
[words]
yes = "yes"
no = "no"
[number]
decimal = ","
thousands = "'"
[said]
"does not meet" = "erfüllt nicht"
"{n} of {all} failed: {why}" = "{why}: {n} von {all}"
)";

// The page of a template whose part "page" is this.
std::string page(const std::string& content, const std::string& data = "{}") {
  return filled_page("p.html", "{{@one}}\n{{@two}}\n{{@page}}\n" + content, data,
                     parse_texts(words, "t.toml"));
}

std::string refusal(const std::string& content) {
  try {
    return page(content, R"({"a": [1]})");
  } catch (const InputError& error) {
    return error.what();
  }
}

}  // namespace

TEST(PageTemplate, ValuesAreWrittenByTheirKindInTheLanguageOfThePage) {
  const std::string data = R"({"a": 12345.678, "n": 1234567, "s": "<b>", "share": 0.1234, "t": true,
                               "none": null, "list": [[7, 8]]})";
  EXPECT_EQ(
      page("{{a}} {{a|4}} {{n}} {{s}} {{s|raw}} {{share|percent}} {{t}} {{none}} {{gone}}", data),
      "12'300 12'350 1234567 &lt;b&gt; <b> 12,3 % yes &ndash; &ndash;");
  EXPECT_EQ(page("{{list.0.1}} {{share|years}} {{a|needed}}", data), "8 8,1 12'400");
}

TEST(PageTemplate, BlocksStandOnceForEachEntry) {
  const std::string data = R"({"x": 1, "l": [{"x": 2}, {"y": 3}], "o": {"p": 4, "q": 5}, "zero": 0,
                               "e": [], "v": "does not meet"})";
  EXPECT_EQ(page("{{#l}}{{^@first}}, {{/}}{{@n}}:{{x}}{{/}}", data), "1:2, 2:1") << "the outer x";
  EXPECT_EQ(page("{{#o.*}}{{@key}}={{.}};{{/}}{{#o}}{{q}}{{/}}", data), "p=4;q=5;5");
  EXPECT_EQ(page("{{#e}}a{{/}}{{^e}}b{{/}}{{?zero}}c{{/}}{{^gone}}d{{/}}{{?l}}e{{/}}", data),
            "bde");
  EXPECT_EQ(
      page("{{#v=meets}}a{{/}}{{#v=does not meet}}b{{#l}}c{{/}}{{/}}{{^v=meets}}d{{/}}", data),
      "bccd");
}

TEST(PageTemplate, TextsTakeTheirValuesFromTheDataOrFromTheMark) {
  const std::string data =
      R"({"name": "A & B", "n": 3, "r": 0.5, "k": "road", "u": "wood", "v": "2 of 5.5 failed: does not meet"})";
  EXPECT_EQ(page("{{=one.hit share=r|percent}}", data), "A &amp; B: 3 hits, 50 %");
  EXPECT_EQ(page("{{=kind.@k}}, {{=kind.@u}}", data), "a road, wood");
  EXPECT_EQ(page("{{v|said}}", data), "erfüllt nicht: 2 von 5,5");
  EXPECT_EQ(page("{{*one.heads ln}}", data), "<th>name</th>\n<th class=\"n\">hits</th>\n");
}

TEST(PageTemplate, SectionsStandInTheOrderOfTheTexts) {
  const Texts texts = parse_texts(words, "t.toml");
  const std::string content =
      "ignored\n{{@page}}\n{{#sections}}<a href=\"#{{id}}\">{{nav|raw}}</a>{{title|raw}}: "
      "{{body|raw}}{{/}}\n{{@one}}\n{{#a}}one{{/}}\n{{@two}}\n{{+three}}\n{{@three}}\ntwo";
  EXPECT_EQ(filled_page("p", content, R"({"a": 1})", texts),
            "<a href=\"#two\">Two</a>Second: two\n<a href=\"#one\">One</a>First: one\n\n");
  EXPECT_EQ(filled_page("p", content, "{}", texts), "<a href=\"#two\">Two</a>Second: two\n\n")
      << "what holds nothing is no section";
}

TEST(PageTemplate, WhatIsNotUnderstoodIsNamedWithItsLine) {
  EXPECT_EQ(refusal("\n{{#a}}"), "p.html:5: the block is not closed by {{/}}");
  EXPECT_EQ(refusal("{{/}}"), "p.html:4: {{/}} closes nothing");
  EXPECT_EQ(refusal("{{=one.gone}}"), "p.html:4: there is no text one.gone");
  EXPECT_EQ(refusal("{{a.0|furlong}}"), "p.html:4: format furlong is not known");
  EXPECT_EQ(refusal("{{+gone}}"), "p.html:4: has no part gone");
  EXPECT_EQ(refusal("{{a"), "p.html:4: a mark has no }}");
}
