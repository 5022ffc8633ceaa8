// XML of the parts of a QGIS project: layers, their tree, styles and words.
#include "report/qgis_project.hpp"

#include <algorithm>

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
  return "<spatialrefsys>" + crs_parts_xml(project) + "</spatialrefsys>";
}

// --- the tree of layers --------------------------------------------------------------------------

std::string shown_name(const QgisLayer& layer) { return without_expressions(layer.name); }

constexpr const char* hidden_title =
    "<Option name=\"legend/title-style\" type=\"QString\" value=\"hidden\"/>";

std::string node_order_xml(const std::string& order, const std::string& more = "") {
  return "<customproperties><Option type=\"Map\"><Option name=\"legend/node-order\" "
         "type=\"QString\" value=\"" +
         order + "\"/>" + more + "</Option></customproperties>";
}

// The classes of a raster without the name of its band, which QGIS puts before them, and without
// those that nobody sees. Contours are one line, named by the layer.
std::string nodes_xml(const QgisLayer& layer) {
  if (layer.kind == QgisLayer::contours)
    return node_order_xml("0", hidden_title + ("<Option name=\"legend/label-0\" type=\"QString\" "
                                               "value=\"" +
                                               xml_escaped(shown_name(layer)) + "\"/>"));
  if (layer.kind == QgisLayer::hillshade) return node_order_xml("", hidden_title);
  if (layer.kind != QgisLayer::raster) return "";
  std::string order;
  int n = 0;
  for (std::size_t i = layer.style.find("<item "); i != std::string::npos;
       i = layer.style.find("<item ", i + 1)) {
    ++n;
    const std::string item = layer.style.substr(i, layer.style.find("/>", i) - i);
    if (item.find(" alpha=\"0\"") == std::string::npos)
      order += (order.empty() ? "" : ",") + std::to_string(n);
  }
  return n == 0 ? "" : node_order_xml(order);
}

// Metadata for the properties of a layer.
std::string metadata_xml(const QgisProject& project, const QgisLayer& layer) {
  std::string about;
  for (const std::string& words : {project.remark, layer.about, project.run})
    if (!words.empty()) about += (about.empty() ? "" : "\n") + words;
  if (about.empty()) return "";
  const std::string title =
      layer.name + (project.remark.empty() ? "" : " (" + project.remark + ")");
  about = "<abstract>" + xml_escaped(about) + "</abstract>";
  return "<resourceMetadata><identifier></identifier><language></language><type></type><title>" +
         xml_escaped(title) + "</title>" + about + "</resourceMetadata>\n" + about + "\n";
}

// --- layers --------------------------------------------------------------------------------------

// Where the tag that begins at `at` ends; npos: nowhere.
std::size_t end_of_tag(const std::string& xml, std::size_t at) {
  char quote = 0;
  for (std::size_t i = at + 1; i < xml.size(); ++i) {
    const char c = xml[i];
    if (c == '<') return std::string::npos;
    if (quote == 0 && c == '>') return i;
    if (quote == 0 && (c == '"' || c == '\''))
      quote = c;
    else if (c == quote)
      quote = 0;
  }
  return std::string::npos;
}

// Whether all elements that begin in a text end in it, and only these. Comments and orders to a
// program count as none.
bool is_whole_xml(const std::string& xml) {
  std::vector<std::string> open;
  for (std::size_t at = xml.find('<'); at != std::string::npos; at = xml.find('<', at + 1)) {
    const std::size_t end = end_of_tag(xml, at);
    if (end == std::string::npos) return false;
    const bool is_closing = xml[at + 1] == '/';
    const std::size_t first = at + (is_closing ? 2 : 1);
    const std::string name = xml.substr(first, xml.find_first_of(" \t\r\n/>", first) - first);
    if (name.empty() || name[0] == '!' || name[0] == '?') return false;
    if (is_closing) {
      if (open.empty() || open.back() != name) return false;
      open.pop_back();
    } else if (xml[end - 1] != '/') {
      open.push_back(name);
    }
    at = end;
  }
  return open.empty();
}

// The text between <qgis ...> and </qgis> of a style file. It is put into the project, and a
// foreign style must not end the elements around it: a style that might is left out.
std::string inner_of(const std::string& qml) {
  const std::size_t open = qml.find("<qgis");
  const std::size_t begin = open == std::string::npos ? open : qml.find('>', open);
  const std::size_t end = qml.rfind("</qgis>");
  if (begin == std::string::npos || end == std::string::npos || end <= begin) return "";
  const std::string inner = qml.substr(begin + 1, end - begin - 1);
  return is_whole_xml(inner) ? inner : "";
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
  return "<pipe><provider><resampling enabled=\"true\" maxOversampling=\"2\" "
         "zoomedInResamplingMethod=\"bilinear\" zoomedOutResamplingMethod=\"bilinear\"/>"
         "</provider><rasterrenderer type=\"contour\" band=\"1\" opacity=\"1\" alphaBand=\"-1\" "
         "nodataColor=\"\" downscale=\"2\" contour-interval=\"" +
         text(interval) + "\" contour-index-interval=\"" + text(5 * interval) + "\"><symbols>\n" +
         line_symbol("contour", 0.12, "110,70,20,180") +
         line_symbol("index", 0.3, "110,70,20,220") +
         "</symbols></rasterrenderer><resamplingStage>provider</resamplingStage></pipe>\n"
         "<blendMode>0</blendMode>\n";
}

std::string style_of(const QgisProject& project, const QgisLayer& layer) {
  if (layer.kind == QgisLayer::contours) return contour_style(project.contour_interval);
  if (layer.kind != QgisLayer::hillshade) return inner_of(layer.style);
  // over white as light as the ground of pages: 185 + 70 cos (post/maps/shading.cpp)
  return R"(<pipe><rasterrenderer type="hillshade" band="1" azimuth="315" angle="45" zfactor="1" multidirection="0" opacity="0.2745" alphaBand="-1" nodataColor=""/>
<brightnesscontrast brightness="0" contrast="0" gamma="1"/><huesaturation saturation="0" grayscaleMode="0"/><rasterresampler maxOversampling="2" zoomedInResampler="bilinear"/></pipe>
<blendMode>0</blendMode>
)";
}

// Columns of tables and forms in words; a style that brings its own keeps them.
std::string aliases_xml(const QgisLayer& layer) {
  if (layer.fields.empty() || layer.style.find("<aliases>") != std::string::npos) return "";
  std::string out = "<aliases>";
  for (std::size_t i = 0; i < layer.fields.size(); ++i)
    out += "<alias index=\"" + std::to_string(i) + "\" field=\"" +
           xml_escaped(layer.fields[i].first) + "\" name=\"" + xml_escaped(layer.fields[i].second) +
           "\"/>";
  return out + "</aliases>\n";
}

// To choose from in the list of styles; the shown one is in the layer itself.
std::string other_styles_xml(const QgisLayer& layer) {
  if (layer.other_styles.empty()) return "";
  std::string out = "<map-layer-style-manager current=\"" + xml_escaped(layer.shown) +
                    "\"><map-layer-style name=\"" + xml_escaped(layer.shown) + "\"/>";
  for (const auto& [name, qml] : layer.other_styles)
    out += "<map-layer-style name=\"" + xml_escaped(name) +
           "\"><qgis version=\"3.22.16\" styleCategories=\"AllStyleCategories\">" + inner_of(qml) +
           "</qgis></map-layer-style>";
  return out + "</map-layer-style-manager>\n";
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
         "</datasource>\n<layername>" + xml_escaped(shown_name(layer)) + "</layername>\n<srs>" +
         crs_xml(project) + "</srs>\n<provider" +
         (is_vector(layer) ? " encoding=\"UTF-8\">ogr" : ">gdal") + "</provider>\n" +
         metadata_xml(project, layer) + aliases_xml(layer) + other_styles_xml(layer);
  return out + style_of(project, layer) + "</maplayer>\n";
}

}  // namespace

std::string without_expressions(std::string words) {
  for (std::size_t at = words.find("[%"); at != std::string::npos; at = words.find("[%", at))
    words.insert(at + 1, " ");
  return words;
}

std::string crs_parts_xml(const QgisProject& project) {
  return "<wkt>" + xml_escaped(project.crs_wkt) + "</wkt><authid>" +
         xml_escaped(project.crs_authid) + "</authid>";
}

std::string layer_tree_xml(const QgisProject& project) {
  std::vector<std::string> groups;
  for (const QgisLayer& layer : project.layers)
    if (std::find(groups.begin(), groups.end(), layer.group) == groups.end())
      groups.push_back(layer.group);
  std::string out;
  for (const std::string& group : groups) {
    out += "<layer-tree-group name=\"" + xml_escaped(without_expressions(group)) +
           "\" checked=\"Qt::Checked\" expanded=\"1\">\n";
    for (std::size_t i = 0; i < project.layers.size(); ++i) {
      const QgisLayer& layer = project.layers[i];
      if (layer.group != group) continue;
      out += "<layer-tree-layer id=\"" + id_of(project, i) + "\" name=\"" +
             xml_escaped(shown_name(layer)) + "\" source=\"./" + xml_escaped(layer.source) +
             "\" providerKey=\"" + (is_vector(layer) ? "ogr" : "gdal") + "\" checked=\"" +
             (layer.visible ? "Qt::Checked" : "Qt::Unchecked") + "\" expanded=\"" +
             (layer.visible ? "1" : "0") + "\">" + nodes_xml(layer) + "</layer-tree-layer>\n";
    }
    out += "</layer-tree-group>\n";
  }
  return out;
}

std::string map_canvas_xml(const QgisProject& project) {
  return "<mapcanvas name=\"theMapCanvas\"><units>meters</units><extent><xmin>" +
         text(project.extent[0]) + "</xmin><ymin>" + text(project.extent[1]) + "</ymin><xmax>" +
         text(project.extent[2]) + "</xmax><ymax>" + text(project.extent[3]) +
         "</ymax></extent><destinationsrs>" + crs_xml(project) + "</destinationsrs></mapcanvas>";
}

std::string layers_xml(const QgisProject& project) {
  std::string out;
  for (std::size_t i = 0; i < project.layers.size(); ++i) out += layer_xml(project, i);
  return out;
}

std::string layer_order_xml(const QgisProject& project) {
  std::string out;
  for (std::size_t i = 0; i < project.layers.size(); ++i)
    out += "<layer id=\"" + id_of(project, i) + "\"/>\n";
  return out;
}

}  // namespace talus
