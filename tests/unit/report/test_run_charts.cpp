// Charts of energies and curves of runs.
#include <gtest/gtest.h>

#include "report/run_charts.hpp"
#include "unit/report/shipped_texts.hpp"

using namespace talus;

TEST(CurveChart, HasALineForEachRun) {
  const CsvTable table = parse_csv("run_id,time_s,front_m\na,0,0\nb,0,1\na,2,5\n", "curves.csv");
  const Chart chart = curve_chart(talus::testing::shipped_texts(), table, "front_m", "Front", "m");
  ASSERT_EQ(chart.series.size(), 2u);
  EXPECT_EQ(chart.series[0].x, (std::vector<double>{0, 2}));
  EXPECT_EQ(chart.series[0].y, (std::vector<double>{0, 5}));
  EXPECT_EQ(chart.series[1].y, (std::vector<double>{1}));
  EXPECT_NE(chart.series[0].colour, chart.series[1].colour);
}

// Medians of 0, 2, 7 and of 4, 5, 7: run c has ended and keeps its value; b is half-way at 1 s.
TEST(CurveChart, ShowsMedianAndBandOfThreeRuns) {
  const CsvTable table =
      parse_csv("run_id,time_s,front_m\na,0,0\na,1,4\na,2,4\nb,0,2\nb,2,8\nc,0,7\n", "curves.csv");
  const Chart chart = curve_chart(talus::testing::shipped_texts(), table, "front_m", "Front", "m");
  ASSERT_EQ(chart.series.size(), 2u);
  EXPECT_EQ(chart.series[0].x, (std::vector<double>{0, 1, 2}));
  EXPECT_EQ(chart.series[0].y, (std::vector<double>{0, 4, 4}));
  EXPECT_EQ(chart.series[0].y_high, (std::vector<double>{7, 7, 8}));
  EXPECT_EQ(chart.series[1].y, (std::vector<double>{2, 5, 7}));
  const std::string svg = chart_svg(chart);
  EXPECT_NE(svg.find("fill-opacity"), std::string::npos);
  EXPECT_NE(svg.find(">median</text>"), std::string::npos);
}

// 10 MJ fall; 4 move, 3 went into friction, 2 into impacts, 1 was removed. The run started with
// 1 MJ of motion, and the base gave 2 more, which friction took.
TEST(EnergyChart, SumLiesOnWhatHasFallen) {
  RunFile run;
  HealthRow row;
  row.translation = 1e6;
  row.potential = 30e6;
  run.health.push_back(row);
  row.time = 1;
  row.potential = 20e6;
  row.translation = 4e6;
  row.rotation = 1e6;
  row.friction = 5e6;
  row.impact = 2e6;
  row.removed = 1e6;
  row.base = 2e6;
  run.health.push_back(row);
  const Chart chart = energy_chart(talus::testing::shipped_texts(), run);
  ASSERT_EQ(chart.series.size(), 5u);
  EXPECT_EQ(chart.series[0].name, "sum");
  EXPECT_EQ(chart.series[1].name, "fallen");
  EXPECT_NEAR(chart.series[0].y[0], 1, 1e-12);
  EXPECT_NEAR(chart.series[0].y[1], 13, 1e-12);
  EXPECT_NEAR(chart.series[1].y[0], 1, 1e-12);
  EXPECT_NEAR(chart.series[1].y[1], 13, 1e-12);
}
