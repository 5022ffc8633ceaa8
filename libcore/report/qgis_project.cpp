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

// The classes of a raster without the name of its band, which QGIS puts before them.
std::string nodes_xml(const QgisLayer& layer) {
  if (layer.kind != QgisLayer::raster) return "";
  std::string order;
  int n = 0;
  for (std::size_t i = layer.style.find("<item "); i != std::string::npos;
       i = layer.style.find("<item ", i + 1))
    order += (n > 0 ? "," : "") + std::to_string(n + 1), ++n;
  if (n == 0) return "";
  return "<customproperties><Option type=\"Map\"><Option name=\"legend/node-order\" "
         "type=\"QString\" value=\"" +
         order + "\"/></Option></customproperties>";
}

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
             (layer.visible ? "1" : "0") + "\">" + nodes_xml(layer) + "</layer-tree-layer>\n";
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

std::string line_symbol(const char* name, double width_mm, const char* colour) {
  return std::string("<symbol type=\"line\" alpha=\"1\" name=\"") + name +
         "\" clip_to_extent=\"1\"><layer class=\"SimpleLine\" enabled=\"1\" pass=\"0\" "
         "locked=\"0\"><prop k=\"line_color\" v=\"" +
         colour + "\"/><prop k=\"line_style\" v=\"solid\"/><prop k=\"line_width\" v=\"" +
         text(width_mm) + "\"/><prop k=\"line_width_unit\" v=\"MM\"/></layer></symbol>\n";
}

// Each fifth contour is bold.
std::string contour_style(double interval) {
  return "<pipe><rasterrenderer type=\"contour\" band=\"1\" opacity=\"1\" alphaBand=\"-1\" "
         "nodataColor=\"\" downscale=\"4\" contour-interval=\"" +
         text(interval) + "\" contour-index-interval=\"" + text(5 * interval) + "\"><symbols>\n" +
         line_symbol("contour", 0.1, "110,70,20,120") +
         line_symbol("index", 0.25, "110,70,20,180") +
         "</symbols></rasterrenderer></pipe>\n<blendMode>0</blendMode>\n";
}

std::string style_of(const QgisProject& project, const QgisLayer& layer) {
  if (layer.kind == QgisLayer::contours) return contour_style(project.contour_interval);
  if (layer.kind != QgisLayer::hillshade) return inner_of(layer.style);
  return R"(<pipe><rasterrenderer type="hillshade" band="1" azimuth="315" angle="45" zfactor="1" multidirection="1" opacity="1" alphaBand="-1" nodataColor=""/>
<brightnesscontrast brightness="20" contrast="0" gamma="1"/><huesaturation saturation="0" grayscaleMode="0"/><rasterresampler maxOversampling="2" zoomedInResampler="bilinear"/></pipe>
<blendMode>0</blendMode>
)";
}

std::string layer_xml(const QgisProject& project, std::size_t i) {
  static const char* const geometry[] = {"", "", "", "Point", "Line", "Polygon"};
  const QgisLayer& layer = project.layers[i];
  std::string out = is_vector(layer) ? std::string("<maplayer type=\"vector\" geometry=\"") +
                                           geometry[layer.kind] + "\" "
                                     : std::string("<maplayer type=\"raster\" ");
  if (layer.style.find("<labeling") != std::string::npos) out += "labelsEnabled=\"1\" ";
  out += "styleCategories=\"AllStyleCategories\" hasScaleBasedVisibilityFlag=\"0\">\n<id>" +
         id_of(project, i) + "</id>\n<datasource>./" + xml_escaped(layer.source) +
         "</datasource>\n<layername>" + xml_escaped(layer.name) + "</layername>\n<srs>" +
         crs_xml(project) + "</srs>\n<provider" +
         (is_vector(layer) ? " encoding=\"UTF-8\">ogr" : ">gdal") + "</provider>\n" +
         metadata_xml(project, "resourceMetadata", layer.name + " (" + project.remark + ")");
  if (!project.remark.empty()) out += "<abstract>" + xml_escaped(project.remark) + "</abstract>\n";
  return out + style_of(project, layer) + "</maplayer>\n";
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

// As QGIS writes a font.
std::string font_description(double size_pt, bool bold) {
  return "description=\"Sans Serif," + text(size_pt) + ",-1,5," + (bold ? "75" : "50") +
         ",0,0,0,0,0\" style=\"\"";
}

std::string label_item(const std::string& uuid, double x, double y, double width, double height,
                       double size_pt, bool bold, const std::string& words) {
  return item(65641, uuid, x, y, width, height,
              "frame=\"false\" background=\"false\" htmlState=\"0\" halign=\"1\" valign=\"32\" "
              "marginX=\"0\" marginY=\"0\" labelText=\"" +
                  xml_escaped(words) + "\"",
              "<LabelFont " + font_description(size_pt, bold) +
                  "/>\n<FontColor red=\"0\" green=\"0\" blue=\"0\" "
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

// 1, 2 or 5 times a power of ten, at most `largest`.
double round_length(double largest) {
  const double power = std::pow(10, std::floor(std::log10(largest)));
  for (const double factor : {5.0, 2.0})
    if (factor * power <= largest) return factor * power;
  return power;
}

// Crosses where coordinates are round, with the coordinates outside of the frame.
std::string grid(double interval) {
  std::string sides;
  for (const char* side : {"left", "right", "top", "bottom"}) {
    const bool is_named = side == std::string("left") || side == std::string("bottom");
    const bool is_upright = side == std::string("left") || side == std::string("right");
    sides += " " + std::string(side) + "AnnotationDisplay=\"" + (is_named ? "0" : "3") + "\" " +
             side + "AnnotationPosition=\"1\" " + side + "AnnotationDirection=\"" +
             (is_upright ? "1" : "0") + "\" " + side + "FrameDivisions=\"0\"";
  }
  return "<ComposerMapGrid name=\"Coordinates\" show=\"1\" gridStyle=\"1\" crossLength=\"2\" "
         "unit=\"0\" offsetX=\"0\" offsetY=\"0\" intervalX=\"" +
         text(interval) + "\" intervalY=\"" + text(interval) +
         "\" gridFrameStyle=\"0\" gridFrameSideFlags=\"15\" showAnnotation=\"1\" "
         "annotationFormat=\"0\" annotationPrecision=\"0\" frameAnnotationDistance=\"1\" "
         "annotationFontColor=\"60,60,60,255\" blendMode=\"0\" position=\"3\"" +
         sides + ">\n<lineStyle>" + line_symbol("", 0.15, "60,60,60,255") +
         "</lineStyle>\n<annotationFontProperties description=\"Sans "
         "Serif,6,-1,5,50,0,0,0,0,0\" style=\"\"/>\n</ComposerMapGrid>\n";
}

std::string map_item(const QgisProject& project, double x, double y, double width, double height) {
  const auto [x_min, y_min, x_max, y_max] = framed(project.extent, width, height);
  return item(65639, map_uuid, x, y, width, height,
              "id=\"Map\" frame=\"true\" background=\"true\" followPreset=\"false\" "
              "keepLayerSet=\"false\" mapRotation=\"0\" drawCanvasItems=\"true\" mapFlags=\"1\"",
              "<Extent xmin=\"" + text(x_min) + "\" ymin=\"" + text(y_min) + "\" xmax=\"" +
                  text(x_max) + "\" ymax=\"" + text(y_max) + "\"/>\n" +
                  grid(round_length(std::max(x_max - x_min, 1e-3) / 4)));
}

std::string legend_item(double x, double y) {
  std::string styles;
  struct Style {
    const char* name;
    double size_pt, above_mm;
  };
  constexpr Style all[] = {{"title", 11, 1},
                           {"group", 8, 1.5},
                           {"subgroup", 7.5, 0.8},
                           {"symbol", 7, 0.8},
                           {"symbolLabel", 7, 0.8}};
  for (const Style& style : all) {
    const bool is_bold = style.size_pt > 7.6;
    styles += "<style name=\"" + std::string(style.name) +
              "\" alignment=\"1\" indent=\"0\" marginTop=\"" + text(style.above_mm) +
              "\" marginLeft=\"2\"><styleFont " + font_description(style.size_pt, is_bold) + "/>" +
              text_style(style.size_pt, is_bold) + "</style>\n";  // QGIS 3.22, 3.30
  }
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
  const double step = round_length(std::max(extent[2] - extent[0], 1e-3) / 8);
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

// A drawing as a file's content (base64): an arrow and N.
constexpr const char* north_arrow =
    "PHN2ZyB4bWxucz0iaHR0cDovL3d3dy53My5vcmcvMjAwMC9zdmciIHZpZXdCb3g9IjAgMCAyMCAzMCI+PHBhdGggZD0i"
    "TTEwIDlMMTUgMjhMMTAgMjRMNSAyOFoiIGZpbGw9IiMwMDAiIHN0cm9rZT0iI2ZmZiIgc3Ryb2tlLXdpZHRoPSIuNSIv"
    "Pjx0ZXh0IHg9IjEwIiB5PSI4IiBmb250LXNpemU9IjkiIGZvbnQtZmFtaWx5PSJzYW5zLXNlcmlmIiB0ZXh0LWFuY2hv"
    "cj0ibWlkZGxlIj5OPC90ZXh0Pjwvc3ZnPg==";

std::string north(double x, double y) {
  return item(65640, "00000000-0000-4000-8000-000000000006", x, y, 10, 15,
              std::string("id=\"North\" frame=\"false\" background=\"false\" mode=\"0\" "
                          "resizeMode=\"0\" anchorPoint=\"4\" pictureRotation=\"0\" "
                          "northMode=\"0\" northOffset=\"0\" file=\"base64:") +
                  north_arrow + "\"",
              "");
}

// What whoever signs the sheet fills in, as variables of the project.
constexpr const char* title_block =
    "Scale 1 : [% format_number(map_get(item_variables('Map'), 'map_scale'), 0) %] (A4)\n"
    "Scenario: [% coalesce(nullif(@scenario, ''), '................................') %]\n"
    "For: [% coalesce(nullif(@client, ''), '................................') %]\n"
    "Prepared by: [% coalesce(nullif(@prepared_by, ''), '................................') %]\n"
    "Printed [% format_date(now(), 'yyyy-MM-dd') %]     Signature:";
constexpr const char* caution =
    "Simulated, on assumptions that report.html lists; no survey and no hazard zoning by itself.";

constexpr const char* variables =
    "<Variables><variableNames type=\"QStringList\"><value>prepared_by</value><value>client</value>"
    "<value>scenario</value></variableNames><variableValues type=\"QStringList\"><value></value>"
    "<value></value><value></value></variableValues></Variables>";

// QGIS evaluates what stands between [% and %] in a label: words of others must not.
std::string without_expressions(std::string words) {
  for (std::size_t at = words.find("[%"); at != std::string::npos; at = words.find("[%", at))
    words.insert(at + 1, " ");
  return words;
}

std::string layout_xml(const QgisProject& project) {
  std::string words;
  for (const std::string& line : project.layout_lines) words += without_expressions(line) + "\n";
  words += caution;
  std::string out =
      "<Layout name=\"Map\" units=\"mm\" printResolution=\"300\" worldFileMap=\"\">\n"
      "<PageCollection>\n";
  out += white_symbol;
  out += "\n" +
         item(65638, "00000000-0000-4000-8000-000000000000", 0, 0, 297, 210,
              "frame=\"false\" background=\"true\"", std::string(white_symbol) + "\n") +
         "</PageCollection>\n";
  out +=
      map_item(project, 16, 20, 192, 152) + legend_item(213, 20) +
      scale_bar(project, 18, 158, 192) + north(196, 22) +
      label_item("00000000-0000-4000-8000-000000000004", 10, 8, 277, 10, 16, true,
                 without_expressions(project.title)) +
      label_item("00000000-0000-4000-8000-000000000005", 16, 180, 190, 26, 7, false, words) +
      label_item("00000000-0000-4000-8000-000000000007", 213, 178, 76, 28, 8, false, title_block);
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
      "<SpatialRefSys><ProjectionsEnabled type=\"int\">1</ProjectionsEnabled></SpatialRefSys>";
  out += variables;
  out += "</properties>\n<Layouts>\n";
  return out + layout_xml(project) + "</Layouts>\n</qgis>\n";
}

}  // namespace talus
