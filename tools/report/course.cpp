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
  const Texts& texts = data.texts;
  std::string out = "<div class=\"charts\">\n";
  for (const auto& [column, title, unit] :
       {std::array{"max_speed_m_s", "curves.fastest", "m/s"},
        std::array{"mean_speed_m_s", "curves.mean_speed", "m/s"},
        std::array{"front_m", "curves.front", "m"},
        std::array{"translational_energy_kj", "curves.energy", "kJ"}})
    out += html_figure(chart_svg(curve_chart(texts, table, column, texts.of(title), unit)), "");
  out += "</div>\n" + html_note(texts.of(data.runs.size() < 3 ? "curves.lines" : "curves.bands"));
  return html_section("curves", texts.of("curves.title"), out);
}

std::string health_section(const ReportData& data) {
  const Texts& texts = data.texts;
  std::string out = all_pass(data.runs, data.limits)
                        ? "<div class=\"verdict pass\">" + texts.of("health.pass") + "</div>\n"
                        : "<div class=\"verdict fail\">" + texts.of("health.fail") + "</div>\n";
  std::string more = data.limits.empty() ? html_note(texts.of("health.no_record"))
                                         : limit_table(texts, data.limits, data.runs.size());
  for (std::size_t i = 0; i < data.runs.size(); ++i)
    if (const RunFile& run = data.runs[i]; !run.info.reason.empty())
      more += html_note(texts.of("health.run_failed", {{"run", xml_escaped(data.run_names[i])},
                                                       {"reason", xml_escaped(run.info.reason)}}));
  more += counter_table(texts, data.runs, data.run_names);
  if (const std::string cuts = cut_table(texts, data.runs, data.run_names); !cuts.empty())
    more += html_note(texts.of("health.cuts")) + cuts;
  if (const std::string deep = deep_table(texts, data.runs, data.run_names); !deep.empty())
    more += html_note(texts.of("health.deep")) + deep;
  more += "<div class=\"charts\">\n";
  more += html_figure(chart_svg(energy_chart(texts, data.shown)),
                      texts.of("health.energy_caption", {{"run", xml_escaped(data.shown_name)}}));
  more += html_figure(chart_svg(health_chart(texts, data.runs, texts.of("health.penetration"), "m",
                                             &HealthRow::largest_penetration)),
                      "");
  more += html_figure(chart_svg(health_chart(texts, data.runs, texts.of("health.time_step"), "s",
                                             &HealthRow::shortest_dt)),
                      texts.of("health.time_step_caption"));
  return html_section("health", texts.of("health.title"),
                      out + html_fold(texts.of("health.more"), more + "</div>\n"));
}

}  // namespace talus
