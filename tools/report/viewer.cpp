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
  return html_section(
      "animation", "Animation",
      html_paragraph("Run " + xml_escaped(data.shown_name) +
                     (data.runs.size() > 1 ? ", the one of the farthest run-out." : ".") +
                     " Drag to turn, right-drag, shift-drag or two fingers to move, wheel or two "
                     "fingers to zoom, "
                     "click a block." +
                     (data.trails.empty()
                          ? std::string()
                          : std::string(" Trails: the paths of all blocks of all runs.")) +
                     " The ground has lines of height every " +
                     text(data.sheet.ground.contour_interval) + " m.") +
          "<div id=\"viewer\"><p class=\"viewer-none\">The animation needs JavaScript; all results "
          "stand in the maps, tables and curves of this page.</p></div>\n");
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
