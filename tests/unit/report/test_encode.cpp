// JSON strings and Base64 for the page.
#include <gtest/gtest.h>

#include "report/encode.hpp"

using namespace talus;

// The examples of RFC 4648, section 10.
TEST(Base64, EncodesTheExamplesOfTheStandard) {
  EXPECT_EQ(base64(std::string_view("")), "");
  EXPECT_EQ(base64(std::string_view("f")), "Zg==");
  EXPECT_EQ(base64(std::string_view("fo")), "Zm8=");
  EXPECT_EQ(base64(std::string_view("foo")), "Zm9v");
  EXPECT_EQ(base64(std::string_view("foobar")), "Zm9vYmFy");
}

TEST(Base64, NumbersAreLittleEndianAndSingle) {
  // 1.0f is 00 00 80 3f
  EXPECT_EQ(base64(std::vector<float>{1.0F}), "AACAPw==");
  EXPECT_EQ(base64(std::vector<std::uint32_t>{1}), "AQAAAA==");
}

// A fence called "</script>" must not end the script element that holds its name.
TEST(JsonString, CannotEndAScriptElement) {
  EXPECT_EQ(json_string("</script>\"\\\n"), "\"\\u003c/script>\\\"\\\\\\u000a\"");
}
