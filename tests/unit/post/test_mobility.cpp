// Relations of mobility: sources, closed forms, percentiles.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.hpp"
#include "base/text.hpp"
#include "post/runout/mobility.hpp"

using namespace talus;

namespace {

std::vector<MobilityRelation> shipped() {
  return mobility_relations(read_csv(TALUS_SOURCE_DIR "/share/mobility.csv"));
}

MobilityRelation named(const std::vector<MobilityRelation>& list, const std::string& id) {
  for (const MobilityRelation& r : list)
    if (r.id == id) return r;
  throw std::runtime_error("no relation " + id);
}

}  // namespace

TEST(Mobility, ShippedRelationsNameTheirSourceAndWhatIsFromMemory) {
  int n_from_memory = 0;
  for (const MobilityRelation& r : shipped()) {
    EXPECT_FALSE(r.source.empty()) << r.id;
    n_from_memory += r.from_memory;
  }
  EXPECT_EQ(n_from_memory, 6);
}

// Corominas, all rockfalls, 1e4 m3: log10(H/L) = 0.210 - 0.109 * 4 = -0.226.
TEST(Mobility, PowerLawGivesTheLengthOfItsLineAndOfItsLowerBound) {
  const auto list = shipped();
  const MobilityRow row =
      compare(named(list, "corominas_rockfall_all"), {"", 1e4, 200, 400, false});
  EXPECT_NEAR(row.length, 200 / std::pow(10, -0.226), 1e-9);
  EXPECT_NEAR(row.length_upper, 200 / std::pow(10, -0.226 - 0.253), 1e-9);
  EXPECT_NEAR(row.ratio, 400 / row.length, 1e-12);
  EXPECT_NEAR(
      row.percentile,
      100 * 0.5 * std::erfc(std::log10(row.length / 400) / 0.253 * 1.6449 / std::numbers::sqrt2),
      1e-6);
}

// On its lower 95 % line an event goes farther than 95 % of all events, on the line itself than
// half; where most of the mass stayed in its source it is none of them.
TEST(Mobility, PercentileIsThatOfTheLowerLine) {
  const auto list = shipped();
  for (const char* id : {"corominas_rockfall_all", "corominas_slide_all"}) {
    const MobilityRelation& r = named(list, id);
    MobilityEvent event{"", 5e4, 300, compare(r, {"", 5e4, 300, 1}).length_upper};
    EXPECT_NEAR(compare(r, event).percentile, 95, 1e-3);
    event.left_share = 0.49;
    EXPECT_TRUE(std::isnan(compare(r, event).percentile));
    EXPECT_NEAR(compare(r, {"", 5e4, 300, compare(r, event).length}).percentile, 50, 1e-9);
  }
}

// Median over the events, among rockfalls and rock avalanches; words name both.
TEST(Mobility, PercentilesAreThoseOfTheMiddleEvent) {
  const auto list = shipped();
  const MobilityRelation& rockfall = named(list, "corominas_rockfall_all");
  const MobilityRelation& avalanche = named(list, "mitchell_hl");
  std::vector<MobilityEvent> events;
  for (const double length : {200.0, 300.0, 800.0}) events.push_back({"", 2e4, 150, length});
  const MobilityPercentiles found = percentiles_of(list, events);
  EXPECT_NEAR(found.rockfalls, compare(rockfall, events[1]).percentile, 1e-12);
  EXPECT_NEAR(found.rock_avalanches, compare(avalanche, events[1]).percentile, 1e-12);
  EXPECT_NE(text(found).find("rockfalls " + text(found.rockfalls, 2)), std::string::npos);
  EXPECT_EQ(text(found).find("at least"), std::string::npos);
  events[2].is_cut = true;
  EXPECT_NE(text(percentiles_of(list, events)).find("at least"), std::string::npos);
  for (MobilityEvent& event : events) event.left_share = 0.4;
  EXPECT_EQ(text(percentiles_of(list, events)),
            "no percentile among published events: 40 % of the mass left its source");
  EXPECT_EQ(text(percentiles_of(list, {})), "");
}

// Rock avalanches of Canada: mean for 1e6 m3 and H = 1000 m is 10^(1.334 + 0.6712 * 3); an event on
// the mean is exceeded by half, one standard deviation above it by 15.87 %.
TEST(Mobility, LengthRegressionGivesAPercentile) {
  const auto list = shipped();
  const MobilityRelation& r = named(list, "mitchell_length");
  const double mean = std::pow(10, 1.334 + 0.6712 * 3);
  EXPECT_NEAR(compare(r, {"", 1e6, 1000, mean, false}).percentile, 50, 1e-9);
  EXPECT_NEAR(compare(r, {"", 1e6, 1000, mean * std::pow(10, 0.111), false}).percentile, 84.1345,
              1e-4);
  EXPECT_NEAR(compare(r, {"", 1e6, 1000, mean, true}).length / mean, std::pow(10, 0.1437), 1e-9);
}

TEST(Mobility, FixedAngleIsALine) {
  const auto list = shipped();
  EXPECT_NEAR(compare(named(list, "cone_method"), {"", 1, 100, 100, false}).length,
              100 / std::tan(33 * std::numbers::pi / 180), 1e-9);
}

// The slides' line at 1e3 m3, log10(H/L) = -0.159 - 0.068 * 3, and its lower 95 % line, 0.435
// below.
TEST(Mobility, ChartShowsThreeRelationsAndABand) {
  const Chart chart = mobility_chart(shipped(), {});
  const auto is_band = [](const ChartSeries& s) { return !s.y_high.empty(); };
  const auto band = std::find_if(chart.series.begin(), chart.series.end(), is_band);
  ASSERT_NE(band, chart.series.end());
  const auto at = std::find(band->x.begin(), band->x.end(), 1e3) - band->x.begin();
  EXPECT_NEAR(band->y[at], std::pow(10, -0.798), 1e-9);
  EXPECT_NEAR(band->y_high[at], std::pow(10, -0.363), 1e-9);
  EXPECT_EQ(std::count_if(chart.series.begin(), chart.series.end(),
                          [](const ChartSeries& s) { return s.width > 0; }),
            3);
  for (const ChartSeries& s : chart.series) EXPECT_EQ(s.name.find("unchecked"), std::string::npos);
}

TEST(Mobility, OfAnEventWithoutLengthSaysNothing) {
  for (const MobilityRelation& r : shipped())
    EXPECT_TRUE(std::isnan(compare(r, {"", 10, 5, 0, false}).length));
}
