// Refusals that list the readings of an input.
#include <gtest/gtest.h>

#include "import/readings.hpp"

using namespace talus;

TEST(Readings, EachSaysWhatItMakesOfTheInputAndTheOptionThatDecides) {
  const Doubt doubt = choice_of_height_unit({"a.gpkg"}, 0.3048, 1000, 1300, 3200,
                                            "--elevation-unit-m 0.3048", "--elevation-unit-m 1");
  EXPECT_EQ(doubt.state, DoubtState::refused);
  EXPECT_EQ(
      sentence_on(doubt),
      "a.gpkg: the plan is in units of 0.3048 m, and nothing says what unit the heights are "
      "in: in that unit the heights go from 304.8 to 396.24 m, 91.44 m over 3.2 km; in metres "
      "the heights go from 1000 to 1300 m, 300 m over 3.2 km");
  EXPECT_EQ(doubt.hint, "in that unit: --elevation-unit-m 0.3048; in metres: --elevation-unit-m 1");
}

TEST(Readings, OfHeightsAreAllUnitsThatMakeGroundOfThem) {
  const auto way = [](double unit_m) { return std::to_string(unit_m); };
  const auto names = [&](double low, double high) {
    std::string all;
    for (const Reading& reading : smaller_units(low, high, 200, way)) all += reading.name + " ";
    return all;
  };
  EXPECT_EQ(names(10000, 20000), "as feet as decimetres as centimetres as millimetres ");
  EXPECT_EQ(names(100000, 110000), "as centimetres as millimetres ");
  EXPECT_EQ(names(-100000, 5), "as centimetres as millimetres ");
  EXPECT_EQ(smaller_units(10125, 20125, 200, way)[2].magnitude,
            "the heights go from 101.25 to 201.25 m, 100 m over 200 m");
}

TEST(Readings, LengthsHaveTheUnitThatFits) {
  EXPECT_EQ(length_words(3204.5), "3.204 km");
  EXPECT_EQ(length_words(12), "12 m");
  EXPECT_EQ(length_words(0), "0 m");
  EXPECT_EQ(length_words(0.0008), "0.8 mm");
  EXPECT_EQ(rise_words(1, 2, 0), "the heights go from 1 to 2 m");
}
