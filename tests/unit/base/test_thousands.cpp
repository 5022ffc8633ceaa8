// Heights as text in which a point may part thousands.
#include <gtest/gtest.h>

#include <vector>

#include "base/thousands.hpp"

namespace talus {
namespace {

bool is_doubtful(const std::vector<std::string>& words) {
  ThousandsDoubt doubt;
  for (const std::string& word : words) doubt.add(word);
  return doubt.is_doubtful();
}

TEST(Thousands, ThreeDigitsBehindThePointOfAllAreInDoubt) {
  EXPECT_TRUE(is_doubtful({"1.000", "1.010", "1.020"}));
  EXPECT_TRUE(is_doubtful({"980", "990", "1.000", "1.010"}));
  EXPECT_TRUE(is_doubtful({"", "8.848"}));
}

TEST(Thousands, NumbersThatCannotBeThousandsAreNot) {
  EXPECT_FALSE(is_doubtful({"1.5", "1.010"}));        // a decimal point beside it
  EXPECT_FALSE(is_doubtful({"432.187", "431.200"}));  // no mountain is that high
  EXPECT_FALSE(is_doubtful({"0.125", "0.250"}));
  EXPECT_FALSE(is_doubtful({"1000", "1010"}));
  EXPECT_FALSE(is_doubtful({}));
}

}  // namespace
}  // namespace talus
