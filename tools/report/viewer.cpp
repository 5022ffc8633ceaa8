#include "tools/report/viewer.hpp"

#include <vector>

#include "base/text.hpp"
#include "report/html.hpp"
#include "report/viewer_scene.hpp"

namespace talus {
namespace {

// Heights of the fences that the lines of a run stand for, 0 for a line that is none [m]. Several
// lines of one fence are named NAME.1, NAME.2 ...
std::vector<double> line_heights(const std::vector<RecordLine>& lines,
                                 const std::vector<FenceSettings>& fences) {
  std::vector<double> heights;
  for (const RecordLine& line : lines) {
    double height = 0;
    for (const FenceSettings& fence : fences)
      if (line.name == fence.name || line.name.starts_with(fence.name + "."))
        height = fence.height_m;
    heights.push_back(height);
  }
  return heights;
}

bool has_frames(const ReportData& data) {
  return !data.shown.frames.time.empty() && !data.shown.reach;
}

}  // namespace

std::string viewer_section(const ReportData& data) {
  if (!has_frames(data)) return "";
  const Texts& texts = data.texts;
  return html_section(
      "animation", texts.of("animation.title"),
      html_paragraph(
          texts.of(data.runs.size() > 1 ? "animation.farthest_run" : "animation.run",
                   {{"run", xml_escaped(data.shown_name)}}) +
          " " + texts.of("animation.how_to") + " " +
          (data.trails.empty() ? "" : texts.of("animation.trails") + " ") +
          texts.of("animation.ground", {{"interval", text(data.sheet.ground.contour_interval)}})) +
          "<div id=\"viewer\"><p class=\"viewer-none\">" + texts.of("animation.needs_script") +
          "</p></div>\n");
}

std::string viewer_script(const ReportData& data, const std::string& viewer) {
  if (!has_frames(data)) return "";
  return "<script type=\"application/json\" id=\"scene\">" +
         viewer_scene(data.shown, data.bed,
                      {line_heights(data.shown.lines, data.site.fences), data.trails,
                       data.sheet.ground.contour_interval}) +
         "</script>\n<script>\n" + viewer +
         "\nwindow.talus = talusViewer(document.getElementById('viewer'), "
         "JSON.parse(document.getElementById('scene').textContent));\n</script>\n";
}

}  // namespace talus
