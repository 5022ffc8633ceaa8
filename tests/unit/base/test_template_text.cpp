// Templates: values, parts, and the faults that must not pass unseen.
#include <gtest/gtest.h>

#include "base/error.hpp"
#include "base/template_text.hpp"

namespace {

using namespace talus;

std::string error_of(const std::string& text, const TemplateMarks& marks) {
  try {
    return "filled: " + filled_template("page.in", text, marks);
  } catch (const InputError& error) {
    return error.what();
  }
}

bool contains(const std::string& whole, const std::string& part) {
  return whole.find(part) != std::string::npos;
}

TEST(Template, PutsValuesInPlaceOfMarks) {
  EXPECT_EQ(filled_template("page.in", "{{a}} of {{b}}, {{a}}\nplain { } }}\n",
                            {{{"a", "1"}, {"b", "| x |\n| y |"}}, {}}),
            "1 of | x |\n| y |, 1\nplain { } }}\n");
}

// A value is text, never a mark: the content of a file name cannot pull in another value.
TEST(Template, DoesNotLookForMarksInValues) {
  EXPECT_EQ(filled_template("page.in", "{{a}}{{b}}\n", {{{"a", "{{b}}"}, {"b", "2"}}, {}}),
            "{{b}}2\n");
}

TEST(Template, KeepsAPartOrLeavesItOutWithTheLinesOfItsMarks) {
  const std::string text = "1\n{{#p}}\n2\n{{#q}}\n{{x}}\n{{/q}}\n{{/p}}\n4\n";
  EXPECT_EQ(filled_template("page.in", text, {{{"x", "3"}}, {{"p", true}, {"q", true}}}),
            "1\n2\n3\n4\n");
  EXPECT_EQ(filled_template("page.in", text, {{}, {{"p", true}, {"q", false}}}), "1\n2\n4\n");
  EXPECT_EQ(filled_template("page.in", text, {{}, {{"p", false}, {"q", true}}}), "1\n4\n");
}

TEST(Template, SaysInWhichLineAMarkHasNoValue) {
  EXPECT_EQ(error_of("1\n{{a}}\n", {}).rfind("page.in:2", 0), 0u) << error_of("1\n{{a}}\n", {});
  EXPECT_TRUE(contains(error_of("1\n{{a}}\n", {}), "mark a has no value"));
  EXPECT_TRUE(contains(error_of("{{#p}}\n{{/p}}\n", {}), "part p is unknown"));
  EXPECT_TRUE(contains(error_of("{{a\n", {{{"a", "1"}}, {}}), "a mark has no }}"));
}

TEST(Template, RefusesPartsThatAreNotClosedInOrder) {
  const TemplateMarks marks = {{}, {{"p", false}, {"q", true}}};
  EXPECT_TRUE(contains(error_of("{{#p}}\n{{#q}}\n", marks), "part q is not closed"));
  EXPECT_TRUE(contains(error_of("{{#p}}\n{{#q}}\n{{/p}}\n{{/q}}\n", marks), "{{/p}} closes"));
  EXPECT_TRUE(contains(error_of("{{/p}}\n", marks), "{{/p}} closes"));
}

TEST(Template, DropsNoValueSilently) {
  EXPECT_TRUE(contains(error_of("1\n", {{{"table", "| x |"}}, {}}), "no mark uses table"));
  EXPECT_TRUE(contains(error_of("1\n", {{}, {{"p", true}}}), "no mark uses p"));
}

}  // namespace
