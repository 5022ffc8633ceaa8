// Classes, colours and labels of results for QGIS styles, pages and legends.
#include "io/style.hpp"

#include <cmath>

#include "base/text.hpp"

namespace talus {
namespace {

constexpr const char* document_type =
    "<!DOCTYPE qgis PUBLIC 'http://mrcc.com/qgis.dtd' 'SYSTEM'>\n";

std::string attribute(const std::string& name, const std::string& value) {
  return " " + name + "=\"" + xml_escaped(value) + "\"";
}

std::string hex_colour(const Colour& colour) {
  constexpr const char* digits = "0123456789abcdef";
  std::string out = "#";
  for (int i = 0; i < 3; ++i) {
    out += digits[colour[i] / 16];
    out += digits[colour[i] % 16];
  }
  return out;
}

std::string list_colour(const Colour& colour) {
  std::string out;
  for (const std::uint8_t part : colour) out += (out.empty() ? "" : ",") + std::to_string(part);
  return out;
}

std::string limit(double upper) { return std::isinf(upper) ? "inf" : text(upper); }

std::string prop(const std::string& key, const std::string& value) {
  return "          <Option" + attribute("type", "QString") + attribute("name", key) +
         attribute("value", value) + "/>\n";
}

std::string symbol_layer(const VectorStyle& style, const VectorStyle::Class& of) {
  const Colour& colour = of.colour;
  const std::string size = text(style.size_mm);
  switch (style.kind) {
    case SymbolKind::point:
      return "SimpleMarker\" enabled=\"1\" pass=\"0\" locked=\"0\">\n        <Option "
             "type=\"Map\">\n" +
             prop("name", "circle") + prop("color", list_colour(colour)) +
             prop("outline_color", "35,35,35,255") + prop("outline_width", "0.1") +
             prop("outline_width_unit", "MM") + prop("size", size) + prop("size_unit", "MM");
    case SymbolKind::line:
      return "SimpleLine\" enabled=\"1\" pass=\"0\" locked=\"0\">\n        <Option "
             "type=\"Map\">\n" +
             prop("line_color", list_colour(colour)) + prop("line_style", "solid") +
             prop("line_width", size) + prop("line_width_unit", "MM") + prop("capstyle", "round") +
             prop("joinstyle", "round");
    case SymbolKind::polygon:
      break;
  }
  Colour outline = colour;
  outline[3] = 255;
  return "SimpleFill\" enabled=\"1\" pass=\"0\" locked=\"0\">\n        <Option type=\"Map\">\n" +
         prop("color", list_colour(colour)) + prop("style", of.fill) +
         prop("outline_color", list_colour(outline)) + prop("outline_style", "solid") +
         prop("outline_width", size) + prop("outline_width_unit", "MM");
}

std::string symbol(const VectorStyle& style, std::size_t i) {
  const char* const kind = style.kind == SymbolKind::point  ? "marker"
                           : style.kind == SymbolKind::line ? "line"
                                                            : "fill";
  return "      <symbol" + attribute("type", kind) + attribute("name", std::to_string(i)) +
         " alpha=\"1\" clip_to_extent=\"1\" force_rhr=\"0\">\n        <layer class=\"" +
         symbol_layer(style, style.classes[i]) +
         "        </Option>\n        </layer>\n      </symbol>\n";
}

}  // namespace

const StyleClass* class_of(const RasterStyle& style, double value) {
  for (const StyleClass& c : style.classes)
    if (value <= c.upper) return &c;
  return nullptr;
}

Colour colour_of(const RasterStyle& style, double value) {
  const StyleClass* const found = class_of(style, value);
  return found ? found->colour : Colour{0, 0, 0, 0};
}

std::string raster_qml(const RasterStyle& style) {
  const double low = style.classes.front().upper;
  const double high =
      style.classes.size() < 2 ? low : style.classes[style.classes.size() - 2].upper;
  std::string out = document_type;
  out +=
      "<qgis version=\"3.22.16\" styleCategories=\"AllStyleCategories\" "
      "hasScaleBasedVisibilityFlag=\"0\">\n";
  out +=
      "  <pipe>\n    <rasterrenderer type=\"singlebandpseudocolor\" opacity=\"1\" alphaBand=\"-1\" "
      "nodataColor=\"\"";
  out += attribute("band", std::to_string(style.band)) + attribute("classificationMin", text(low)) +
         attribute("classificationMax", text(high)) + ">\n";
  out +=
      "      <rasterTransparency/>\n      <minMaxOrigin>\n        <limits>None</limits>\n"
      "        <extent>WholeRaster</extent>\n        <statAccuracy>Exact</statAccuracy>\n"
      "      </minMaxOrigin>\n      <rastershader>\n        <colorrampshader "
      "classificationMode=\"1\" colorRampType=\"DISCRETE\" clip=\"0\" labelPrecision=\"2\"";
  out += attribute("minimumValue", text(low)) + attribute("maximumValue", text(high)) + ">\n";
  for (const StyleClass& c : style.classes)
    out += "          <item" + attribute("value", limit(c.upper)) +
           attribute("color", hex_colour(c.colour)) +
           attribute("alpha", std::to_string(c.colour[3])) + attribute("label", c.label) + "/>\n";
  out +=
      "        </colorrampshader>\n      </rastershader>\n    </rasterrenderer>\n"
      "    <brightnesscontrast brightness=\"0\" contrast=\"0\" gamma=\"1\"/>\n"
      "    <huesaturation saturation=\"0\" grayscaleMode=\"0\"/>\n"
      "    <rasterresampler maxOversampling=\"2\"/>\n  </pipe>\n  <blendMode>0</blendMode>\n";
  const std::string title = style.title + (style.remark.empty() ? "" : ", " + style.remark);
  out += "  <layerTitle>" + xml_escaped(title) + "</layerTitle>\n</qgis>\n";
  return out;
}

namespace {

// Around a point, above a line, inside an area.
std::string labeling(const VectorStyle& style) {
  if (style.label.empty()) return "";
  const char* const placement = style.kind == SymbolKind::point  ? "0"
                                : style.kind == SymbolKind::line ? "2"
                                                                 : "1";
  return "  <labeling type=\"simple\"><settings calloutType=\"simple\"><text-style" +
         attribute("fieldName", style.label) +
         " isExpression=\"1\" fontFamily=\"Sans Serif\" fontSize=\"9\" fontSizeUnit=\"Point\" "
         "textColor=\"20,20,20,255\"><text-buffer bufferDraw=\"1\" bufferSize=\"0.8\" "
         "bufferSizeUnits=\"MM\" bufferColor=\"255,255,255,255\"/></text-style><text-format/>"
         "<placement placement=\"" +
         placement +
         "\" placementFlags=\"10\"/><rendering obstacle=\"0\"/></settings></labeling>\n";
}

}  // namespace

std::string vector_qml(const VectorStyle& style) {
  std::string out = document_type;
  out += "<qgis version=\"3.22.16\" styleCategories=\"AllStyleCategories\">\n";
  if (style.field.empty()) {
    out +=
        "  <renderer-v2 type=\"singleSymbol\" symbollevels=\"0\" enableorderby=\"0\">\n"
        "    <symbols>\n" +
        symbol(style, 0) + "    </symbols>\n  </renderer-v2>\n";
  } else {
    out += "  <renderer-v2 type=\"categorizedSymbol\" symbollevels=\"0\" enableorderby=\"0\"" +
           attribute("attr", style.field) + ">\n    <categories>\n";
    for (std::size_t i = 0; i < style.classes.size(); ++i)
      out += "      <category render=\"true\"" + attribute("symbol", std::to_string(i)) +
             attribute("value", style.classes[i].value) +
             attribute("label", style.classes[i].label) + "/>\n";
    out += "    </categories>\n    <symbols>\n";
    for (std::size_t i = 0; i < style.classes.size(); ++i) out += symbol(style, i);
    out += "    </symbols>\n  </renderer-v2>\n";
  }
  out += labeling(style);
  const int geometry = style.kind == SymbolKind::point ? 0 : style.kind == SymbolKind::line ? 1 : 2;
  out +=
      "  <blendMode>0</blendMode>\n  <featureBlendMode>0</featureBlendMode>\n"
      "  <layerGeometryType>" +
      std::to_string(geometry) + "</layerGeometryType>\n</qgis>\n";
  return out;
}

}  // namespace talus
