// libcore/io/style.hpp: public
// How results are coloured: classes with limits, colours and labels; the same ones in QGIS styles,
// on pages and in legends.
#pragma once

#include <string>
#include <vector>

#include "draw/colour.hpp"

namespace talus {

/// Values up to and with `upper` that no class before takes.
struct StyleClass {
  double upper = 0;
  Colour colour{};
  std::string label;        ///< with its unit
  bool is_hatched = false;  ///< on white, on pages
};

struct RasterStyle {
  int band = 1;                         ///< that is shown, from 1
  std::string title;                    ///< in QGIS: name of the band, with the unit
  std::vector<StyleClass> classes;      ///< ascending; the last limit is infinite, but of codes
  std::string remark = {};              ///< that no picture may lack; empty: none
  std::vector<std::string> notes = {};  ///< paragraphs of a page: basis of the map
  std::string heading = {};             ///< of a page, in words
  std::string legend = {};              ///< above the classes of a page, in words, with the unit
};

/// The class of a value; null for NaN and above all.
[[nodiscard]] const StyleClass* class_of(const RasterStyle& style, double value);
/// Its colour; transparent where there is none.
[[nodiscard]] Colour colour_of(const RasterStyle& style, double value);

/// A style file that QGIS (3.22 and later) takes up when it lies beside the raster: NAME.qml.
[[nodiscard]] std::string raster_qml(const RasterStyle& style);

enum class SymbolKind { point, line, polygon };

/// How a layer of features is drawn: one symbol, or one for each value of `field`.
struct VectorStyle {
  SymbolKind kind = SymbolKind::line;
  std::string field;  ///< empty: one symbol, the first class
  struct Class {
    std::string value, label;
    Colour colour{};
    std::string fill = "solid";  ///< of polygons, as QGIS names it: "b_diagonal", "no"
  };
  std::vector<Class> classes;
  double size_mm = 0.4;    ///< width of lines and outlines, diameter of points
  std::string label = {};  ///< expression of QGIS, written beside each feature; empty: none
};
[[nodiscard]] std::string vector_qml(const VectorStyle& style);

}  // namespace talus
