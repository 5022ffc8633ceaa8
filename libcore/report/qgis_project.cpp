#include "report/qgis_project.hpp"

#include <algorithm>
#include <cmath>

#include "base/text.hpp"

namespace talus {
namespace {

std::string id_of(const QgisProject& project, std::size_t i) {
  std::string id = "talus_" + std::to_string(i) + "_";
  for (const char c : project.layers[i].name)
    id += (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') ? c : '_';
  return id;
}

bool is_vector(const QgisLayer& layer) { return layer.kind >= QgisLayer::point; }

std::string crs_xml(const QgisProject& project) {
  if (project.crs_wkt.empty()) return "<spatialrefsys/>";
  return "<spatialrefsys><wkt>" + xml_escaped(project.crs_wkt) + "</wkt><authid>" +
         xml_escaped(project.crs_authid) + "</authid></spatialrefsys>";
}

// --- the tree of layers --------------------------------------------------------------------------

std::string layer_tree(const QgisProject& project) {
  std::vector<std::string> groups;
  for (const QgisLayer& layer : project.layers)
    if (std::find(groups.begin(), groups.end(), layer.group) == groups.end())
      groups.push_back(layer.group);
  std::string out = "<layer-tree-group>\n";
  for (const std::string& group : groups) {
    out += "<layer-tree-group name=\"" + xml_escaped(group) +
           "\" checked=\"Qt::Checked\" expanded=\"1\">\n";
    for (std::size_t i = 0; i < project.layers.size(); ++i) {
      const QgisLayer& layer = project.layers[i];
      if (layer.group != group) continue;
      out += "<layer-tree-layer id=\"" + id_of(project, i) + "\" name=\"" +
             xml_escaped(layer.name) + "\" source=\"./" + xml_escaped(layer.source) +
             "\" providerKey=\"" + (is_vector(layer) ? "ogr" : "gdal") + "\" checked=\"" +
             (layer.visible ? "Qt::Checked" : "Qt::Unchecked") + "\" expanded=\"" +
             (layer.visible ? "1" : "0") + "\"/>\n";
    }
    out += "</layer-tree-group>\n";
  }
  return out + "</layer-tree-group>\n";
}

// An abstract of a layer or of the project, as its properties show it; empty without a remark.
std::string metadata_xml(const QgisProject& project, const char* element,
                         const std::string& title) {
  if (project.remark.empty()) return "";
  const std::string open = element;
  return "<" + open + "><identifier></identifier><language></language><type></type><title>" +
         xml_escaped(title) + "</title><abstract>" + xml_escaped(project.remark) + "</abstract></" +
         open + ">\n";
}

// --- layers --------------------------------------------------------------------------------------

// What stands between <qgis ...> and </qgis> of a style file.
std::string inner_of(const std::string& qml) {
  const std::size_t open = qml.find("<qgis");
  const std::size_t begin = open == std::string::npos ? open : qml.find('>', open);
  const std::size_t end = qml.rfind("</qgis>");
  if (begin == std::string::npos || end == std::string::npos || end <= begin) return "";
  return qml.substr(begin + 1, end - begin - 1);
}

std::string style_of(const QgisLayer& layer) {
  if (layer.kind != QgisLayer::hillshade) return inner_of(layer.style);
  return R"(<pipe><rasterrenderer type="hillshade" band="1" azimuth="315" angle="45" zfactor="1" multidirection="1" opacity="1" alphaBand="-1" nodataColor=""/>
<brightnesscontrast brightness="20" contrast="0" gamma="1"/><huesaturation saturation="0" grayscaleMode="0"/><rasterresampler maxOversampling="2" zoomedInResampler="bilinear"/></pipe>
<blendMode>0</blendMode>
)";
}

std::string layer_xml(const QgisProject& project, std::size_t i) {
  static const char* const geometry[] = {"", "", "Point", "Line", "Polygon"};
  const QgisLayer& layer = project.layers[i];
  std::string out = is_vector(layer) ? std::string("<maplayer type=\"vector\" geometry=\"") +
                                           geometry[layer.kind] + "\" "
                                     : std::string("<maplayer type=\"raster\" ");
  out += "styleCategories=\"AllStyleCategories\" hasScaleBasedVisibilityFlag=\"0\">\n<id>" +
         id_of(project, i) + "</id>\n<datasource>./" + xml_escaped(layer.source) +
         "</datasource>\n<layername>" + xml_escaped(layer.name) + "</layername>\n<srs>" +
         crs_xml(project) + "</srs>\n<provider" +
         (is_vector(layer) ? " encoding=\"UTF-8\">ogr" : ">gdal") + "</provider>\n" +
         metadata_xml(project, "resourceMetadata", layer.name + " (" + project.remark + ")");
  if (!project.remark.empty()) out += "<abstract>" + xml_escaped(project.remark) + "</abstract>\n";
  return out + style_of(layer) + "</maplayer>\n";
}

// --- the print layout: A4 across -----------------------------------------------------------------

constexpr const char* white_symbol =
    R"(<symbol type="fill" alpha="1" name="" clip_to_extent="1"><layer class="SimpleFill" enabled="1" pass="0" locked="0"><prop k="color" v="255,255,255,255"/><prop k="outline_style" v="no"/><prop k="style" v="solid"/></layer></symbol>)";

std::string item(int type, const std::string& uuid, double x, double y, double width, double height,
                 const std::string& attributes, const std::string& content) {
  const std::string at = text(x) + "," + text(y) + ",mm";
  return "<LayoutItem type=\"" + std::to_string(type) + "\" uuid=\"{" + uuid +
         "}\" templateUuid=\"{" + uuid + "}\" position=\"" + at + "\" positionOnPage=\"" + at +
         "\" size=\"" + text(width) + "," + text(height) +
         ",mm\" referencePoint=\"0\" itemRotation=\"0\" opacity=\"1\" blendMode=\"0\" "
         "visibility=\"1\" excludeFromExports=\"0\" positionLock=\"false\" groupUuid=\"\" "
         "zValue=\"1\" " +
         attributes + ">\n" + content + "</LayoutItem>\n";
}

std::string text_style(double size_pt, bool bold) {
  return "<text-style fontFamily=\"Sans Serif\" namedStyle=\"" +
         std::string(bold ? "Bold" : "Regular") + "\" fontWeight=\"" + (bold ? "75" : "50") +
         "\" fontSize=\"" + text(size_pt) +
         "\" fontSizeUnit=\"Point\" textColor=\"0,0,0,255\" textOpacity=\"1\" "
         "multilineHeight=\"1.1\"/>\n";
}

std::string label_item(const std::string& uuid, double x, double y, double width, double height,
                       double size_pt, bool bold, const std::string& words) {
  return item(65641, uuid, x, y, width, height,
              "frame=\"false\" background=\"false\" htmlState=\"0\" halign=\"1\" valign=\"32\" "
              "marginX=\"0\" marginY=\"0\" labelText=\"" +
                  xml_escaped(words) + "\"",
              "<LabelFont description=\"Sans Serif," + text(size_pt) + ",-1,5," +
                  (bold ? "75" : "50") +
                  ",0,0,0,0,0\" style=\"\"/>\n<FontColor red=\"0\" green=\"0\" blue=\"0\" "
                  "alpha=\"255\"/>\n");
}

constexpr const char* map_uuid = "00000000-0000-4000-8000-000000000001";

// The part of the map that has the shape of its frame and holds the extent.
std::array<double, 4> framed(const std::array<double, 4>& extent, double width, double height) {
  const double cx = (extent[0] + extent[2]) / 2, cy = (extent[1] + extent[3]) / 2;
  const double scale =
      std::max((extent[2] - extent[0]) / width, (extent[3] - extent[1]) / height) / 2;
  return {cx - scale * width, cy - scale * height, cx + scale * width, cy + scale * height};
}

std::string map_item(const QgisProject& project, double x, double y, double width, double height) {
  const auto [x_min, y_min, x_max, y_max] = framed(project.extent, width, height);
  return item(65639, map_uuid, x, y, width, height,
              "id=\"Map\" frame=\"true\" background=\"true\" followPreset=\"false\" "
              "keepLayerSet=\"false\" mapRotation=\"0\" drawCanvasItems=\"true\" mapFlags=\"1\"",
              "<Extent xmin=\"" + text(x_min) + "\" ymin=\"" + text(y_min) + "\" xmax=\"" +
                  text(x_max) + "\" ymax=\"" + text(y_max) + "\"/>\n");
}

std::string legend_item(double x, double y) {
  std::string styles;
  for (const auto& [name, size] :
       {std::pair{"title", 11.0}, {"group", 9.0}, {"subgroup", 8.0}, {"symbolLabel", 7.0}})
    styles += "<style name=\"" + std::string(name) +
              "\" alignment=\"1\" indent=\"0\" marginTop=\"1\" "
              "marginLeft=\"2\">" +
              text_style(size, size > 8.5) + "</style>\n";
  return item(
      65642, "00000000-0000-4000-8000-000000000002", x, y, 70, 120,
      std::string("id=\"Legend\" frame=\"false\" background=\"true\" title=\"\" "
                  "legendFilterByAtlas=\"0\" legendFilterByMap=\"1\" resizeToContents=\"1\" "
                  "columnCount=\"1\" symbolWidth=\"5\" symbolHeight=\"3\" boxSpace=\"1\" "
                  "wrapChar=\"\" splitLayer=\"0\" equalColumnWidth=\"0\" map_uuid=\"{") +
          map_uuid + "}\"",
      "<styles>\n" + styles + "</styles>\n");
}

std::string scale_bar(const QgisProject& project, double x, double y, double map_width) {
  const auto extent = framed(project.extent, map_width, map_width);
  const double quarter = (extent[2] - extent[0]) / 8;
  double step = std::pow(10, std::floor(std::log10(quarter)));
  for (const double factor : {5.0, 2.0})
    if (factor * step <= quarter) {
      step *= factor;
      break;
    }
  return item(65646, "00000000-0000-4000-8000-000000000003", x, y, 60, 12,
              std::string("id=\"Scale\" frame=\"false\" background=\"true\" style=\"Single Box\" "
                          "unitType=\"meters\" unitLabel=\"m\" numMapUnitsPerScaleBarUnit=\"1\" "
                          "numSegments=\"2\" numSegmentsLeft=\"0\" segmentSizeMode=\"0\" "
                          "numUnitsPerSegment=\"") +
                  text(step) +
                  "\" height=\"2\" labelBarSpace=\"2\" boxContentSpace=\"1\" alignment=\"0\" "
                  "outlineWidth=\"0.3\" mapUuid=\"{" +
                  map_uuid + "}\"",
              text_style(8, false));
}

// QGIS evaluates what stands between [% and %] in a label: words of others must not.
std::string without_expressions(std::string words) {
  for (std::size_t at = words.find("[%"); at != std::string::npos; at = words.find("[%", at))
    words.insert(at + 1, " ");
  return words;
}

std::string layout_xml(const QgisProject& project) {
  std::string words;
  for (const std::string& line : project.layout_lines) words += without_expressions(line) + "\n";
  words += "printed [% format_date(now(), 'yyyy-MM-dd') %]";
  std::string out =
      "<Layout name=\"Map\" units=\"mm\" printResolution=\"300\" worldFileMap=\"\">\n"
      "<PageCollection>\n";
  out += white_symbol;
  out += "\n" +
         item(65638, "00000000-0000-4000-8000-000000000000", 0, 0, 297, 210,
              "frame=\"false\" background=\"true\"", std::string(white_symbol) + "\n") +
         "</PageCollection>\n";
  out += map_item(project, 10, 22, 200, 165) + legend_item(214, 22) +
         scale_bar(project, 12, 172, 200) +
         label_item("00000000-0000-4000-8000-000000000004", 10, 8, 277, 10, 16, true,
                    without_expressions(project.title)) +
         label_item("00000000-0000-4000-8000-000000000005", 10, 189, 277, 18, 7.5, false, words);
  return out + "</Layout>\n";
}

// To corners of all layers, 12 pixels around the cursor.
constexpr const char* snapping =
    R"(<snapping-settings enabled="1" type="1" mode="2" tolerance="12" unit="1" intersection-snapping="0" self-snapping="0" scaleDependencyMode="0" minScale="0" maxScale="0"><individual-layer-settings/></snapping-settings>
)";

}  // namespace

std::string qgis_project_xml(const QgisProject& project) {
  std::string out =
      "<!DOCTYPE qgis PUBLIC 'http://mrcc.com/qgis.dtd' 'SYSTEM'>\n"
      "<qgis version=\"3.22.16\" projectname=\"" +
      xml_escaped(project.title) + "\">\n<homePath path=\"\"/>\n<title>" +
      xml_escaped(project.title) + "</title>\n<projectCrs>" + crs_xml(project) + "</projectCrs>\n" +
      metadata_xml(project, "projectMetadata", project.title) + layer_tree(project) +
      (project.is_edited ? snapping : "") +
      "<mapcanvas name=\"theMapCanvas\"><units>meters</units><extent><xmin>" +
      text(project.extent[0]) + "</xmin><ymin>" + text(project.extent[1]) + "</ymin><xmax>" +
      text(project.extent[2]) + "</xmax><ymax>" + text(project.extent[3]) +
      "</ymax></extent><destinationsrs>" + crs_xml(project) +
      "</destinationsrs></mapcanvas>\n<projectlayers>\n";
  for (std::size_t i = 0; i < project.layers.size(); ++i) out += layer_xml(project, i);
  out += "</projectlayers>\n<layerorder>\n";
  for (std::size_t i = 0; i < project.layers.size(); ++i)
    out += "<layer id=\"" + id_of(project, i) + "\"/>\n";
  out +=
      "</layerorder>\n<properties><Paths><Absolute type=\"bool\">false</Absolute></Paths>"
      "<SpatialRefSys><ProjectionsEnabled type=\"int\">1</ProjectionsEnabled></SpatialRefSys>"
      "</properties>\n<Layouts>\n";
  return out + layout_xml(project) + "</Layouts>\n</qgis>\n";
}

}  // namespace talus
