#include "tools/report/course.hpp"

#include <array>

#include "base/text.hpp"
#include "report/html.hpp"
#include "report/run_charts.hpp"

namespace talus {

std::string curve_section(const ReportData& data) {
  // Runs that keep no frames have no curves: the file holds its heading alone.
  if (data.curves_csv.find('\n') + 1 >= data.curves_csv.size()) return "";
  const CsvTable table = parse_csv(data.curves_csv, "curves.csv");
  std::string out = "<div class=\"charts\">\n";
  for (const auto& [column, title, unit] :
       {std::array{"max_speed_m_s", "Fastest block", "m/s"},
        std::array{"mean_speed_m_s", "Mean speed of the mass", "m/s"},
        std::array{"front_m", "Front: path of the block farthest ahead", "m"},
        std::array{"translational_energy_kj", "Kinetic energy of translation", "kJ"}})
    out += html_figure(chart_svg(curve_chart(table, column, title, unit)), "");
  out += "</div>\n" + html_note(data.runs.size() < 3
                                    ? "A line a run. <code>curves.csv</code>"
                                    : "Of all runs; each is in <code>curves.csv</code>");
  return html_section("curves", "Over time", out);
}

std::string health_section(const ReportData& data) {
  std::string out =
      all_pass(data.runs, data.limits)
          ? "<div class=\"verdict pass\"><b>Pass.</b> All runs finished within their "
            "limits.</div>\n"
          : "<div class=\"verdict fail\"><b>Fail.</b> A limit is broken or a run has not "
            "finished.</div>\n";
  std::string more =
      data.limits.empty()
          ? html_note("The registry holds no record of these runs: limits cannot be shown.")
          : limit_table(data.limits, data.runs.size());
  for (std::size_t i = 0; i < data.runs.size(); ++i)
    if (const RunFile& run = data.runs[i]; !run.info.reason.empty())
      more += html_note("Run " + xml_escaped(data.run_names[i]) +
                        " failed: " + xml_escaped(run.info.reason) + ".");
  more += counter_table(data.runs, data.run_names);
  if (const std::string cuts = cut_table(data.runs, data.run_names); !cuts.empty())
    more += html_note("Substeps of blocks in contact that were made again, by reason:") + cuts;
  if (const std::string deep = deep_table(data.runs, data.run_names); !deep.empty())
    more += html_note("Blocks that came into something by more than a tenth of their thickness:") +
            deep;
  more += "<div class=\"charts\">\n";
  more += html_figure(chart_svg(energy_chart(data.shown)),
                      "Run " + xml_escaped(data.shown_name) +
                          ": the energy balance closes where the sum of moving and spent energy "
                          "meets the line of fall energy.");
  more += html_figure(chart_svg(health_chart(data.runs, "Largest penetration in the interval", "m",
                                             &HealthRow::largest_penetration)),
                      "");
  more += html_figure(chart_svg(health_chart(data.runs, "Shortest time step in the interval", "s",
                                             &HealthRow::shortest_dt)),
                      "A step ends at an impact, so steps may be very short without anything being "
                      "wrong. Gaps: no step with a search for contacts.");
  return html_section(
      "health", "Numerical checks",
      out + html_fold("Limits, counters, energy balance, time step", more + "</div>\n"));
}

}  // namespace talus
