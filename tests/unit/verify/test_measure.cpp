// Measured cases: Pareto fronts, comparison of laws, claims.
#include <gtest/gtest.h>

#include <cmath>
#include <deque>
#include <set>

#include "verify/cases/claims.hpp"
#include "verify/study/measure.hpp"
#include "verify/study/summary.hpp"

namespace {

using namespace talus;

VerifyRow row(const std::string& law, double cpu, double error) {
  VerifyRow out;
  out.method = out.law = law;
  out.cpu = cpu;
  out.error = error;
  return out;
}

TEST(ParetoFront, IsWhatNothingBeats) {
  const std::vector<VerifyRow> rows = {row("talus", 3, 1e-3), row("paper", 1, 1e-1),
                                       row("paper", 4, 1e-2), row("talus", 2, std::nan("")),
                                       row("talus", 9, 1e-6), row("paper", 1, 2e-1)};
  EXPECT_EQ(pareto_front(rows), (std::vector<std::size_t>{1, 0, 4}));
}

TEST(CompareLaws, TakesCpuTimeAtEqualError) {
  std::vector<VerifyRow> rows = {row("talus", 2, 1e-4),   row("talus", 5, 1e-8),
                                 row("paper", 20, 1e-2),  row("paper", 500, 1e-5),
                                 row("paper", 600, 5e-5), row("paper", 0.1, 5)};
  LawComparison laws = compare_laws(rows);
  EXPECT_TRUE(laws.is_on_front);
  EXPECT_TRUE(laws.is_compared);
  EXPECT_DOUBLE_EQ(laws.least_ratio, 10);     // 20 / 2
  EXPECT_DOUBLE_EQ(laws.ratio_at_best, 100);  // 500 / 5
  rows.push_back(row("paper", 1000, 1e-12));  // closer than law talus ever comes
  laws = compare_laws(rows);
  EXPECT_DOUBLE_EQ(laws.least_ratio, 0);
  EXPECT_FALSE(compare_laws({row("talus", 1, 0.5), row("paper", 1, 0.5)}).is_compared);
}

TEST(CompareLaws, FrontIsOfAnswersAlone) {
  EXPECT_FALSE(compare_laws({row("talus", 10, 1e-2), row("paper", 1, 1e-3)}).is_on_front);
  // the cheapest of all, but no answer
  EXPECT_FALSE(compare_laws({row("talus", 0.1, 5), row("talus", 10, 1e-2), row("paper", 1, 1e-3)})
                   .is_on_front);
}

// Runs whose contacts get too deep break their health: they are not answers.
TEST(Cheapest, DoesNotCountDeepRuns) {
  std::vector<VerifyRow> rows = {row("talus", 1, 1e-3), row("talus", 5, 1e-3)};
  EXPECT_DOUBLE_EQ(cheapest(rows, 1e-3), 1);
  rows[0].flags = StepFlag::deep;
  EXPECT_DOUBLE_EQ(cheapest(rows, 1e-3), 5);
  EXPECT_TRUE(std::isinf(cheapest(rows, 1e-4)));
}

// A case of that name about which nothing else is said.
const VerifyCase* about(const std::string& name) {
  static std::deque<VerifyCase> named;
  named.emplace_back().name = name;
  return &named.back();
}

MeasuredCase measured_with(std::vector<PeerPoint> peers) {
  MeasuredCase out{
      about("slide_20"), {row("talus", 1, 1e-6), row("talus", 0.5, 1e-2)}, std::move(peers)};
  out.rows[0].dt = Settings{}.dt;
  out.rows[1].dt = 2e-2;
  return out;
}

TEST(PeerRatio, IsTheLeastOverUsefulRuns) {
  const MeasuredCase three = measured_with({{"a", 4, 1e-4}, {"b", 3, 2e-2}, {"c", 1e-9, 0.5}});
  EXPECT_DOUBLE_EQ(peer_ratio(three, false), 4);
  EXPECT_DOUBLE_EQ(peer_ratio(three, true), 3);
  EXPECT_DOUBLE_EQ(peer_ratio(measured_with({{"a", 4, 1e-9}}), false), 0);
  EXPECT_TRUE(std::isnan(peer_ratio(measured_with({}), false)));
}

TEST(PeerRatio, LeavesOtherSettingsOut) {
  MeasuredCase one = measured_with({{"a", 4, 1e-4}});
  one.rows.push_back(row("talus", 1e-3, 1e-9));
  one.rows.back().method = "talus, k_n 1e+08";
  EXPECT_DOUBLE_EQ(peer_ratio(one, false), 4);
}

TEST(SummaryTable, GivesTheRatioOfEachCase) {
  MeasuredCase one = measured_with({});
  EXPECT_NE(summary_table({one}).find(" | - | - | "), std::string::npos);
  one.rows.push_back(row("paper", 12, 1e-4));  // 12 times at its smallest error, 2 at 0.05
  one.rows.push_back(row("paper", 1, 0.05));
  EXPECT_NE(summary_table({one}).find("| 1e-06 | 0 | 1e+03 | 0.0001 | 12 | "), std::string::npos)
      << summary_table({one});
  EXPECT_NE(summary_table({one}, "in/").find("| [`slide_20`](in/slide_20.svg) |"),
            std::string::npos);
}

// Taken together, the least of each ratio counts, and unmeasured engines are not mentioned.
TEST(Claims, TakenTogetherAreTheLeastOfEach) {
  MeasuredCase one = measured_with({}), other = measured_with({{"a", 4, 1e-4}});
  one.rows.push_back(row("paper", 40, 1e-4));
  other.about = about("oblique");
  other.rows.push_back(row("paper", 12, 1e-4));
  other.rows.push_back(row("paper", 1, 0.05));
  const FrontCount front = front_count({one, other, measured_with({})});
  EXPECT_EQ(front.n_on_front, 2);
  EXPECT_EQ(front.n_compared, 2);
  const std::string table = claims_by_group({one, other});
  EXPECT_NE(table.find("| 12 (`oblique`, where law paper errs by 0.0001) | 2 (`oblique`, where law "
                       "paper errs by 0.05) |\n"),
            std::string::npos)
      << table;
  EXPECT_NE(table.find("at its default step | - | 4 (`oblique`) |\n"), std::string::npos) << table;
  EXPECT_EQ(table.find("bounce"), std::string::npos);
  EXPECT_EQ(claims_by_group({one}).find("other engines"), std::string::npos);
}

// Two errors below the uncertainty of the reference are the same.
TEST(Claims, CountErrorsBelowTheReferencesOwnAsEqual) {
  MeasuredCase slide{about("slide39_centre"), {row("talus", 1, 0.3), row("talus", 9, 0.1)}, {}};
  slide.rows.push_back(row("paper", 100, 0.2));
  EXPECT_FALSE(laws_of(slide).is_compared);  // no answer
  slide.worst = 9;
  EXPECT_NEAR(laws_of(slide).ratio_at_best, 100.0 / 9, 1e-9);
  slide.known_to = 0.4;
  EXPECT_NEAR(laws_of(slide).ratio_at_best, 100, 1e-9);
}

TEST(VerifyCsv, HasTheColumnsAndFlags) {
  VerifyRow one = row("talus", 1, 1e-3);
  one.flags = StepFlag::unconverged | StepFlag::deep;
  one.norm = "relative";
  const std::string csv = csv_of({one}, "machine", "abc");
  EXPECT_EQ(csv.substr(0, csv.find('\n')),
            "case,law,dof,dt_s,normal_stiffness_n_m,steps,error,error_norm,cpu_time_s,wall_time_s,"
            "iterations,unconverged,largest_penetration_m,flags,machine,commit,solver_tolerance,"
            "set_up_cpu_time_s,runs");
  EXPECT_NE(csv.find("unconverged+deep"), std::string::npos);
  EXPECT_NE(csv.find("\"machine\",abc,1,0,1\n"), std::string::npos);
}

TEST(VerifyCases, AreNamedOnceAndEachHasItsDefaultStep) {
  std::set<std::string> names;
  for (const VerifyCase& c : verify_cases()) {
    EXPECT_TRUE(names.insert(c.name).second) << c.name;
    EXPECT_GT(c.bound, 0) << c.name;
    for (const bool full : {false, true}) {
      std::vector<VerifyRow> rows;
      for (const Method& method : methods_of(c, full))
        for (const double dt : method.dt) {
          rows.push_back(row(method.settings.paper ? "paper" : "talus", 1, 1));
          rows.back().method = method.name;
          rows.back().dt = dt;
        }
      EXPECT_NE(default_row(rows), nullptr) << c.name;
    }
  }
}

// All of one case: measured, on the front, below its bound, drawn, in the table.
TEST(Measure, GivesErrorBesideTime) {
  const VerifyCase& c = verify_cases().front();
  MeasuredCase outcome;
  outcome.about = &c;
  for (const Method& method : methods_of(c, false))
    for (const double dt : method.dt) outcome.rows.push_back(measure(c, method, dt, 0));
  EXPECT_TRUE(holds(outcome));
  for (const VerifyRow& one : outcome.rows) {
    EXPECT_EQ(one.steps, std::lround(1 / one.dt));
    EXPECT_EQ(one.dof, 6);
    EXPECT_GE(one.cpu, 0);
  }
  const std::string svg = chart_file(work_precision_chart(c.name, outcome.rows, {}));
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_NE(svg.find("Pareto front"), std::string::npos);
  EXPECT_NE(summary_table({outcome}).find("`" + c.test + "`"), std::string::npos);
}

}  // namespace
