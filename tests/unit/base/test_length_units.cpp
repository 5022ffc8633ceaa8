// Words for units of length, as files write them.
#include <gtest/gtest.h>

#include "base/length_units.hpp"

namespace talus {
namespace {

TEST(LengthUnits, MetresInManyLanguages) {
  for (const char* word : {"m", "m NHN", "metres above sea level", "m \u00fc. M.", "M", "metre",
                           "Meters", "metros", "metri", "m a.s.l.", "mamsl"})
    EXPECT_EQ(metres_in(word), 1) << word;
}

TEST(LengthUnits, FeetOfTwoLengths) {
  for (const char* word : {"ft", "Foot", "feet", "international foot"})
    EXPECT_EQ(metres_in(word), 0.3048) << word;
  for (const char* word : {"US survey foot", "us-ft", "USSurveyFoot", "ftUS"})
    EXPECT_EQ(metres_in(word), 1200.0 / 3937) << word;
}

TEST(LengthUnits, PartsOfAMetre) {
  EXPECT_EQ(metres_in("dm"), 0.1);
  EXPECT_EQ(metres_in("centimeters"), 0.01);
  EXPECT_EQ(metres_in("mm"), 0.001);
}

TEST(LengthUnits, OtherWordsAreNotKnown) {
  for (const char* word : {"", "fathom", "m/s", "m x 10", "f", "mg"})
    EXPECT_EQ(metres_in(word), 0) << word;
}

TEST(LengthUnits, SomeWordsSayNoUnit) {
  for (const char* word : {"", "unspecified", "Unknown", "none"}) EXPECT_TRUE(is_no_unit(word));
  for (const char* word : {"m", "ft", "fathom"}) EXPECT_FALSE(is_no_unit(word)) << word;
}

}  // namespace
}  // namespace talus
