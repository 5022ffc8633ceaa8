// JSON values: building, reading, order of members, errors.
#include <gtest/gtest.h>

#include <limits>

#include "base/json.hpp"

namespace {

using talus::Json;

TEST(Json, ListsOfPairsAreObjectsInOrder) {
  const Json json = {{"b", 1}, {"a", {1.5, 2}}, {"c", {{"deep", true}}}, {"none", nullptr}};
  EXPECT_EQ(json.dump(), R"({"b":1,"a":[1.5,2],"c":{"deep":true},"none":null})");
  EXPECT_EQ(Json({"b", 1}).dump(), R"(["b",1])");
  EXPECT_EQ(Json::array({Json("a")}).dump(), R"(["a"])");
  EXPECT_EQ(Json::object().dump() + Json::array().dump() + Json().dump(), "{}[]null");
}

TEST(Json, TextComesBackAsItWas) {
  const std::string text = R"({"z":[0.1,1e+300,-3,18446744073709551615,"ü\n",false,null],"a":{}})";
  EXPECT_EQ(Json::parse(text).dump(), text);
  EXPECT_EQ(Json::parse(text), Json::parse(text));
  EXPECT_EQ(Json::parse_or_null("{").dump(), "null");
  EXPECT_THROW((void)Json::parse("{"), talus::JsonError);
  EXPECT_EQ(Json("\xff").dump(), "\"\xEF\xBF\xBD\"");
  EXPECT_TRUE(talus::number_or_null(std::numeric_limits<double>::infinity()).is_null());
}

TEST(Json, WhatIsPutIntoNullMakesAnArrayOrAnObject) {
  Json json;
  json["list"].push_back({{"x", 1}});
  json["list"].back().update({{"x", 2}, {"y", 3}});
  json["at"][1] = "second";
  EXPECT_EQ(json.dump(), R"({"list":[{"x":2,"y":3}],"at":[null,"second"]})");
  std::string words;
  for (const auto& [key, value] : json.items()) words += key + std::to_string(value.size());
  EXPECT_EQ(words, "list1at2");
}

TEST(Json, ValuesOfAnotherKindAreRefused) {
  const Json json = {{"n", 2}, {"real", 2.0}, {"text", "t"}};
  EXPECT_EQ(json["n"].get<double>(), 2);
  EXPECT_EQ(json["real"].get<int>(), 2);
  EXPECT_EQ(json["n"], json["real"]);
  EXPECT_EQ(json.value("missing", "else"), "else");
  EXPECT_THROW((void)json["text"].get<double>(), talus::JsonError);
  EXPECT_THROW((void)json.at("missing"), talus::JsonError);
  EXPECT_THROW((void)json["text"]["deeper"], talus::JsonError);
}

}  // namespace
