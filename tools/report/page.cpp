#include "tools/report/page.hpp"

#include <utility>

#include "base/text.hpp"
#include "report/doubts_html.hpp"
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

// Within the quotation marks of a script.
std::string in_script(const std::string& words) {
  std::string out;
  for (const char c : words) {
    if (c == '\\' || c == '\'' || c == '`') out += '\\';
    out += c;
  }
  return out;
}

// A script with words in place of its {{keys}}.
std::string with_texts(const std::string& script, const Texts& texts) {
  std::string out;
  std::size_t done = 0;
  for (std::size_t at = script.find("{{"); at != std::string::npos; at = script.find("{{", done)) {
    const std::size_t end = script.find("}}", at);
    out +=
        script.substr(done, at - done) + in_script(texts.of(script.substr(at + 2, end - at - 2)));
    done = end + 2;
  }
  return out + script.substr(done);
}

std::string page_head(const ReportData& data, const std::string& style) {
  const SiteInfo& info = data.site.info;
  const Texts& texts = data.texts;
  std::string out = "<!DOCTYPE html>\n<html lang=\"" + texts.of("page.language") +
                    "\">\n<head>\n<meta charset=\"utf-8\">\n<meta "
                    "name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
                    texts.of("page.title", {{"site", xml_escaped(info.name)}}) +
                    "</title>\n<link rel=\"icon\" "
                    "href=\"data:,\">\n<style>\n" +
                    style + "</style>\n</head>\n<body>\n<header>\n<h1>" + xml_escaped(info.name) +
                    "</h1>\n";
  if (!info.description.empty()) out += html_paragraph(xml_escaped(info.description));
  out += "<p class=\"soft\">" +
         texts.of("page.made_by", {{"version", xml_escaped(data.version)},
                                   {"run_id", data.run_id},
                                   {"crs", word_text(value_at(data.trn, {"grid", "crs"}))}}) +
         "<span id=\"written\"></span></p>\n<nav>";
  for (const auto& [id, title] : {std::pair{"result", "nav.result"},
                                  {"maps", "nav.maps"},
                                  {"animation", "nav.animation"},
                                  {"runout", "nav.runout"},
                                  {"hazard", "nav.hazard"},
                                  {"objects", "nav.objects"},
                                  {"search", "nav.search"},
                                  {"fences", "nav.fences"},
                                  {"trees", "nav.trees"},
                                  {"uncertainty", "nav.uncertainty"},
                                  {"curves", "nav.curves"},
                                  {"health", "nav.health"},
                                  {"doubts", "nav.doubts"},
                                  {"assumed", "nav.assumed"},
                                  {"plan", "nav.plan"},
                                  {"provenance", "nav.provenance"}}) {
    if (id == std::string("trees") && tree_section(data).empty()) continue;
    if (id == std::string("uncertainty") && uncertainty_section(data).empty()) continue;
    if (id == std::string("hazard") && hazard_section(data).empty()) continue;
    if (id == std::string("objects") && object_section(data).empty()) continue;
    if (id == std::string("search") && search_section(data).empty()) continue;
    if (id == std::string("fences") && fence_section(data).empty()) continue;
    out += std::string("<a href=\"#") + id + "\">" + texts.of(title) + "</a>";
  }
  return out + "</nav>\n</header>\n<main>\n";
}

// Shows when the file was written, which its bytes do not tell, and opens what is folded for print.
std::string page_script(const Texts& texts) {
  return "<script>\n"
         "const changed = new Date(document.lastModified), two = (n) => String(n).padStart(2, "
         "'0');\n"
         "document.getElementById('written').textContent = `" +
         in_script(texts.of(
             "page.file_written",
             {{"time",
               "${changed.getFullYear()}-${two(changed.getMonth() + 1)}-${two(changed.getDate())} "
               "${two(changed.getHours())}:${two(changed.getMinutes())}"}})) +
         "`;\n"
         "addEventListener('beforeprint', () => "
         "document.querySelectorAll('details').forEach((d) => { d.open = true; }));\n"
         "</script>\n";
}

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
       {curve_section(data), health_section(data),
        html_section("doubts", data.texts.of("doubts.title"),
                     html_note(data.texts.of("doubts.what")) +
                         doubts_html(data.doubts, data.texts.of("doubts.none"))),
        assumption_section(data), plan_section(data), provenance_section(data)})
    main += html_marked(section, xml_escaped(remark));
  const std::string first = remark.empty() ? fence_remark : remark;
  main = html_marked(result_section(data), xml_escaped(first)) + main;
  return page_head(data, files.style) + sheet_definitions(data.texts, data.sheet) +
         in_print_frame(main, first) + "</main>\n<footer>" + data.texts.of("page.footer") +
         "</footer>\n" + viewer_script(data, with_texts(files.viewer, data.texts)) + "<script>\n" +
         with_texts(files.maps, data.texts) + "\ntalusMaps();\n</script>\n" +
         page_script(data.texts) + "</body>\n</html>\n";
}

}  // namespace talus
