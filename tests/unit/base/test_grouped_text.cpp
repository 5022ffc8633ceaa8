// Numbers for readers: thousands apart, no powers of ten, rounding up.
#include <gtest/gtest.h>

#include "base/grouped_text.hpp"
#include "base/text.hpp"

namespace {

TEST(GroupedText, HasNoPowerOfTenWhereDigitsCanBeRead) {
  EXPECT_EQ(talus::grouped_text(12432.7, 4), "12,430");
  EXPECT_EQ(talus::grouped_text(55773.6, 4), "55,770");
  EXPECT_EQ(talus::grouped_text(-1234567, 3), "-1,230,000");
  EXPECT_EQ(talus::grouped_text(2524, 3), "2,520");
  EXPECT_EQ(talus::grouped_text(99999, 4), "100,000");
}

TEST(GroupedText, IsThatOfTextElsewhere) {
  for (const double value : {0.0, 0.00123456, 1234.0, 9.99e9, -3.14159})
    EXPECT_EQ(talus::grouped_text(value, 4), talus::text(value, 4));
}

TEST(GroupedText, ShowsThreeDigitsUnlessMoreAreAskedFor) {
  EXPECT_EQ(talus::grouped_text(79219.6), "79,200");
  EXPECT_EQ(talus::grouped_text(168.34), "168");
  EXPECT_EQ(talus::grouped_text(33.7412), "33.7");
}

TEST(GroupedText, RoundsUpWhatIsNeeded) {
  EXPECT_EQ(talus::needed_text(1311.2), "1,320");
  EXPECT_EQ(talus::needed_text(1310), "1,310");
  EXPECT_EQ(talus::needed_text(9991), "10,000");
  EXPECT_EQ(talus::needed_text(2.911), "2.92");
  EXPECT_EQ(talus::needed_text(0), "0");
}

}  // namespace
