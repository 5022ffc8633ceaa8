#include "tools/report/page.hpp"

#include <utility>

#include "base/text.hpp"
#include "report/html.hpp"
#include "tools/report/basis.hpp"
#include "tools/report/course.hpp"
#include "tools/report/fences.hpp"
#include "tools/report/hazard.hpp"
#include "tools/report/json.hpp"
#include "tools/report/maps.hpp"
#include "tools/report/objects.hpp"
#include "tools/report/result.hpp"
#include "tools/report/runout.hpp"
#include "tools/report/search.hpp"
#include "tools/report/trees.hpp"
#include "tools/report/uncertainty.hpp"
#include "tools/report/viewer.hpp"

namespace talus {
namespace {

std::string page_head(const ReportData& data, const std::string& style) {
  const SiteInfo& info = data.site.info;
  std::string out =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta "
      "name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
      xml_escaped(info.name) +
      ": rockslide hazard</title>\n<link rel=\"icon\" "
      "href=\"data:,\">\n<style>\n" +
      style + "</style>\n</head>\n<body>\n<header>\n<h1>" + xml_escaped(info.name) + "</h1>\n";
  if (!info.description.empty()) out += html_paragraph(xml_escaped(info.description));
  out += "<p class=\"soft\">Rockslide hazard report by Talus " + xml_escaped(data.version) +
         ", run id " + "<code>" + data.run_id + "</code>, " +
         word_text(value_at(data.trn, {"grid", "crs"})) + "<span id=\"written\"></span></p>\n<nav>";
  for (const auto& [id, title] : {std::pair{"result", "Result"},
                                  {"maps", "Maps"},
                                  {"animation", "Animation"},
                                  {"runout", "Run-out"},
                                  {"hazard", "Hazard classes"},
                                  {"objects", "Objects"},
                                  {"search", "Where a fence belongs"},
                                  {"fences", "Fences"},
                                  {"trees", "Trees"},
                                  {"uncertainty", "Uncertainty"},
                                  {"curves", "Over time"},
                                  {"health", "Numerical checks"},
                                  {"assumed", "Assumptions"},
                                  {"plan", "Plan"},
                                  {"provenance", "Provenance"}}) {
    if (id == std::string("trees") && tree_section(data).empty()) continue;
    if (id == std::string("uncertainty") && uncertainty_section(data).empty()) continue;
    if (id == std::string("hazard") && hazard_section(data).empty()) continue;
    if (id == std::string("objects") && object_section(data).empty()) continue;
    if (id == std::string("search") && search_section(data).empty()) continue;
    if (id == std::string("fences") && fence_section(data).empty()) continue;
    out += std::string("<a href=\"#") + id + "\">" + title + "</a>";
  }
  return out + "</nav>\n</header>\n<main>\n";
}

// Shows when the file was written, which its bytes do not tell, and opens what is folded for print.
constexpr const char* page_script =
    "<script>\n"
    "const changed = new Date(document.lastModified), two = (n) => String(n).padStart(2, '0');\n"
    "document.getElementById('written').textContent = `, file written ${changed.getFullYear()}-"
    "${two(changed.getMonth() + 1)}-${two(changed.getDate())} "
    "${two(changed.getHours())}:${two(changed.getMinutes())}`;\n"
    "addEventListener('beforeprint', () => "
    "document.querySelectorAll('details').forEach((d) => { d.open = true; }));\n"
    "</script>\n";

// The remark as a head that a browser repeats on every printed page, since the heading of a section
// may stand pages before. On a screen the frame is not seen.
std::string in_print_frame(const std::string& content, const std::string& remark) {
  if (remark.empty()) return content;
  return "<table class=\"print-frame\"><thead><tr><td><div class=\"banner\">" +
         xml_escaped(remark) + "</div></td></tr></thead><tbody><tr><td>\n" + content +
         "</td></tr></tbody></table>\n";
}

}  // namespace

std::string remark_of(const ReportData& data) { return headline(data.faults); }

std::string fence_remark_of(const ReportData& data) {
  const Json remark = value_at(data.fence, {"tags", "REMARK"});
  return remark.is_string() ? remark.get<std::string>() : remark_of(data);
}

std::string report_page(const ReportData& data, const PageFiles& files) {
  const std::string remark = remark_of(data), fence_remark = fence_remark_of(data);
  std::string main;
  for (const std::string& section : {map_section(data), viewer_section(data), runout_section(data)})
    main += html_marked(section, xml_escaped(remark));
  for (const std::string& section :
       {hazard_section(data), object_section(data), search_section(data)})
    if (!section.empty()) main += html_marked(section, xml_escaped(remark));
  main += html_marked(fence_section(data), xml_escaped(fence_remark));
  if (const std::string trees = tree_section(data); !trees.empty())
    main += html_marked(trees, xml_escaped(remark));
  if (const std::string drawn = uncertainty_section(data); !drawn.empty())
    main += html_marked(drawn, xml_escaped(remark));
  for (const std::string& section :
       {curve_section(data), health_section(data), assumption_section(data), plan_section(data),
        provenance_section(data)})
    main += html_marked(section, xml_escaped(remark));
  const std::string first = remark.empty() ? fence_remark : remark;
  main = html_marked(result_section(data), xml_escaped(first)) + main;
  return page_head(data, files.style) + sheet_definitions(data.sheet) +
         in_print_frame(main, first) +
         "</main>\n<footer>Talus is free software (GPL-3.0-or-later), without any warranty. A "
         "model is not the slope: limits and assumptions stand in docs/limits.md.</footer>\n" +
         viewer_script(data, files.viewer) + "<script>\n" + files.maps +
         "\ntalusMaps();\n</script>\n" + page_script + "</body>\n</html>\n";
}

}  // namespace talus
