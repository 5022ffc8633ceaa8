#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "verify/measure.hpp"
#include "verify/peers.hpp"
#include "verify/summary.hpp"

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

TEST(PeerRatio, IsTheLeastOverUsefulRuns) {
  const std::vector<VerifyRow> rows = {row("talus", 1, 1e-6), row("talus", 0.5, 1e-2)};
  EXPECT_DOUBLE_EQ(peer_ratio(rows, {{"a", 4, 1e-4}, {"b", 3, 2e-2}, {"c", 1e-9, 0.5}}), 4);
  EXPECT_DOUBLE_EQ(peer_ratio(rows, {{"a", 4, 1e-9}}), 0);
  EXPECT_TRUE(std::isnan(peer_ratio(rows, {})));
}

TEST(VerifyCsv, HasTheColumnsAndFlags) {
  VerifyRow one = row("talus", 1, 1e-3);
  one.flags = StepFlag::unconverged | StepFlag::deep;
  one.norm = "relative";
  const std::string csv = csv_of({one}, "machine", "abc");
  EXPECT_EQ(csv.substr(0, csv.find('\n')),
            "case,law,dof,dt_s,normal_stiffness_n_m,steps,error,error_norm,cpu_time_s,wall_time_s,"
            "iterations,unconverged,largest_penetration_m,flags,machine,commit,solver_tolerance");
  EXPECT_NE(csv.find("unconverged+deep"), std::string::npos);
  EXPECT_NE(csv.find("\"machine\",abc,1\n"), std::string::npos);
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
          rows.push_back(row(method.settings.law == Law::talus ? "talus" : "paper", 1, 1));
          rows.back().method = method.name;
          rows.back().dt = dt;
        }
      EXPECT_NE(default_row(rows), nullptr) << c.name;
    }
  }
}

// The whole way of one case: measured, on the front, below its bound, drawn, in the table.
TEST(Measure, GivesErrorBesideTime) {
  const VerifyCase& c = verify_cases().front();
  CaseOutcome outcome{&c, {}, std::nan("")};
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
