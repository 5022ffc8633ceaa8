// Accuracy versus CPU time of the verification cases: rows, Pareto fronts, comparison of laws.
#include "verify/study/measure.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <map>

#include "base/percentile.hpp"
#include "base/processor_time.hpp"
#include "base/text.hpp"

namespace talus {
namespace {

constexpr double least_drawn = 1e-16;

double drawn(double error) { return std::max(error, least_drawn); }

}  // namespace

double cheapest(const std::vector<VerifyRow>& rows, double error) {
  double least = std::numeric_limits<double>::infinity();
  for (const VerifyRow& row : rows)
    if (is_default(row) && !has(row.flags, StepFlag::deep) && row.error <= error)
      least = std::min(least, row.cpu);
  return least;
}

std::string text_of(StepFlag flags) {
  const std::pair<StepFlag, const char*> names[] = {{StepFlag::unconverged, "unconverged"},
                                                    {StepFlag::not_finite, "not_finite"},
                                                    {StepFlag::left_domain, "left_domain"},
                                                    {StepFlag::fell_through, "fell_through"},
                                                    {StepFlag::deep, "deep"}};
  std::string out;
  for (const auto& [flag, name] : names)
    if (has(flags, flag)) out += (out.empty() ? "" : "+") + std::string(name);
  return out.empty() ? "none" : out;
}

VerifyRow measure(const VerifyCase& c, const Method& method, double dt, double least_cpu) {
  CaseSettings settings = method.settings;
  settings.dt = dt;
  std::vector<double> cpu, set_up, wall;
  cases::CaseResult result;
  double spent = 0;
  while (cpu.empty() || (spent < least_cpu && cpu.size() < 15)) {
    const auto begin = std::chrono::steady_clock::now();
    const double start = processor_seconds();
    result = c.run(settings);
    const double all = processor_seconds() - start;
    cpu.push_back(result.cpu);
    set_up.push_back(all - result.cpu - result.reference_cpu);
    wall.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
    spent += all;
  }
  VerifyRow row;
  row.case_name = c.name;
  row.method = method.name;
  row.law = settings.paper ? "paper" : "talus";
  row.strains = settings.strains || c.has_strains;
  row.dof = c.n_blocks * (row.strains ? 12 : 6);
  row.dt = dt;
  row.normal_stiffness = settings.normal_stiffness;
  row.tolerance_factor = settings.tolerance_factor;
  row.steps = result.steps;
  const bool is_lost = has(result.flags, StepFlag::fell_through) ||
                       has(result.flags, StepFlag::left_domain) ||
                       has(result.flags, StepFlag::not_finite);
  row.error = is_lost || !std::isfinite(result.error) ? std::nan("") : result.error;
  row.norm = c.norm;
  row.cpu = median(cpu);
  row.set_up_cpu = median(set_up);
  row.wall = median(wall);
  row.iterations = result.passes;
  row.unconverged = result.unconverged;
  row.largest_penetration = result.largest_penetration;
  row.flags = result.flags;
  return row;
}

std::string csv_of(const std::vector<VerifyRow>& rows, const std::string& machine,
                   const std::string& commit) {
  std::string out =
      "case,law,dof,dt_s,normal_stiffness_n_m,steps,error,error_norm,cpu_time_s,wall_time_s,"
      "iterations,unconverged,largest_penetration_m,flags,machine,commit,solver_tolerance,set_up_"
      "cpu_time_s,runs\n";
  const auto quoted = [](const std::string& words) { return "\"" + words + "\""; };
  for (const VerifyRow& row : rows)
    out += row.case_name + "," + row.law + "," + std::to_string(row.dof) + "," + text(row.dt) +
           "," + text(row.normal_stiffness) + "," + std::to_string(row.steps) + "," +
           text(row.error, 6) + "," + quoted(row.norm) + "," + text(row.cpu, 4) + "," +
           text(row.wall, 4) + "," + std::to_string(row.iterations) + "," +
           std::to_string(row.unconverged) + "," + text(row.largest_penetration, 4) + "," +
           text_of(row.flags) + "," + quoted(machine) + "," + commit + "," +
           text(row.tolerance_factor) + "," + text(row.set_up_cpu, 4) + "," +
           std::to_string(row.runs) + "\n";
  return out;
}

std::vector<std::size_t> pareto_front(const std::vector<VerifyRow>& rows) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (std::isfinite(rows[i].error)) order.push_back(i);
  std::sort(order.begin(), order.end(), [&rows](std::size_t a, std::size_t b) {
    return std::pair(rows[a].cpu, rows[a].error) < std::pair(rows[b].cpu, rows[b].error);
  });
  std::vector<std::size_t> front;
  for (const std::size_t i : order)
    if (front.empty() || rows[i].error < rows[front.back()].error) front.push_back(i);
  return front;
}

LawComparison compare_laws(const std::vector<VerifyRow>& rows, double worst) {
  LawComparison out;
  std::vector<VerifyRow> paper, both;
  for (const VerifyRow& row : rows) {
    if (row.law == "paper" && row.error <= worst) paper.push_back(row);
    if (row.error <= worst && (row.law == "paper" || is_default(row))) both.push_back(row);
  }
  for (const std::size_t i : pareto_front(both)) out.is_on_front |= both[i].law == "talus";
  const std::vector<std::size_t> front = pareto_front(paper);
  if (front.empty()) return out;
  out.is_compared = true;
  out.least_ratio = std::numeric_limits<double>::infinity();
  for (const std::size_t i : front) {  // the last has the smallest error
    out.best_error = paper[i].error;
    out.ratio_at_best = paper[i].cpu / cheapest(rows, paper[i].error);
    if (out.ratio_at_best >= out.least_ratio) continue;
    out.least_ratio = out.ratio_at_best;
    out.least_at = paper[i].error;
  }
  return out;
}

std::string ratio_text(double ratio) {
  if (std::isnan(ratio)) return "-";
  return ratio >= 10 ? std::to_string(std::llround(ratio)) : text(ratio, 3);
}

namespace {

// Other engines, paler and smaller: a cloud of points each, of all its settings.
void add_engines(const std::vector<PeerPoint>& peers, Chart& chart) {
  const std::vector<std::string> colours = {"#e3a6a6", "#a6c8e3", "#a9d3b0", "#d9c58f",
                                            "#c9b3de", "#b8b8b8", "#e0b48e"};
  const std::size_t n_own = chart.series.size();
  for (const PeerPoint& peer : peers) {
    const std::string engine = peer.name.substr(0, peer.name.find_first_of(" ,"));
    auto cloud = std::find_if(chart.series.begin(), chart.series.end(),
                              [&engine](const ChartSeries& s) { return s.name == engine; });
    if (cloud == chart.series.end()) {
      const std::string& colour = colours[(chart.series.size() - n_own) % colours.size()];
      chart.series.push_back({engine, colour, {}, {}, 0, 2});
      cloud = chart.series.end() - 1;
    }
    cloud->x.push_back(peer.cpu);
    cloud->y.push_back(drawn(peer.error));
  }
}

}  // namespace

Chart work_precision_chart(const std::string& title, const std::vector<VerifyRow>& rows,
                           const std::vector<PeerPoint>& peers) {
  Chart chart;
  chart.title = title;
  chart.x_label = "CPU time of the start and all steps [s]";
  chart.y_label = "error";
  chart.log_x = chart.log_y = true;
  const std::vector<std::string> colours = {"#c1272d", "#e08a3c", "#8c5a2b", "#b04ba0", "#0057a8",
                                            "#4aa3df", "#2f7d4f", "#7fb13c", "#666666", "#d4b106"};
  std::vector<VerifyRow> ordered = rows;  // the defaults have the first colour
  std::stable_partition(ordered.begin(), ordered.end(), is_default);
  for (const VerifyRow& row : ordered) {
    auto line = std::find_if(chart.series.begin(), chart.series.end(),
                             [&row](const ChartSeries& s) { return s.name == row.method; });
    if (line == chart.series.end()) {
      chart.series.push_back({row.method, colours[chart.series.size() % colours.size()], {}, {}});
      line = chart.series.end() - 1;
      line->marker = 2.5;
    }
    line->x.push_back(row.cpu);
    line->y.push_back(drawn(row.error));
  }
  ChartSeries front{"Pareto front", "#222", {}, {}, 0, 5.5};
  for (const std::size_t i : pareto_front(rows)) {
    front.x.push_back(rows[i].cpu);
    front.y.push_back(drawn(rows[i].error));
  }
  chart.series.push_back(front);
  add_engines(peers, chart);
  return chart;
}

void add_band(Chart& chart, double known_to) {
  double first = std::numeric_limits<double>::infinity(), last = 0;
  for (const ChartSeries& line : chart.series)
    for (const double x : line.x) first = std::min(first, x), last = std::max(last, x);
  chart.series.push_back(
      {"uncertainty of the reference", "#000", {first, last}, {drawn(known_to), drawn(known_to)}});
}

}  // namespace talus
