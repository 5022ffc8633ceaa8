#include "tools/hazard/layers.hpp"

#include <cmath>

#include "post/outline.hpp"

namespace talus {
namespace {

using Polygons = std::vector<std::vector<std::vector<Vec2>>>;

Polygons on_map(Polygons polygons, const Vec3& origin) {
  for (auto& rings : polygons)
    for (auto& ring : rings)
      for (Vec2& p : ring) p += origin.head<2>();
  return polygons;
}

std::string joined(const std::vector<std::string>& notes) {
  std::string out;
  for (const std::string& note : notes) out += (out.empty() ? "" : "; ") + note;
  return out;
}

VectorStyle class_style(const Recipe& recipe) {
  VectorStyle style{SymbolKind::polygon, "code", {}, 0.2};
  for (auto c = recipe.classes.rbegin(); c != recipe.classes.rend(); ++c)
    style.classes.push_back({std::to_string(c->code),
                             c->label,
                             {c->rgb[0], c->rgb[1], c->rgb[2], 180},
                             c->is_hatched ? "b_diagonal" : "solid"});
  return style;
}

VectorLayer class_layer(const std::string& name, const std::string& description,
                        const std::vector<int>& codes, const PassageGrid& grid, const Vec3& origin,
                        const Recipe& recipe, const std::string& basis) {
  VectorLayer layer{name,
                    description,
                    GeometryType::multi_polygon,
                    {{"class", FieldType::text},
                     {"code", FieldType::integer},
                     {"label", FieldType::text},
                     {"area_m2", FieldType::real},
                     {"recipe", FieldType::text},
                     {"edition", FieldType::text},
                     {"basis", FieldType::text}},
                    {},
                    vector_qml(class_style(recipe))};
  for (auto c = recipe.classes.rbegin(); c != recipe.classes.rend(); ++c) {
    std::vector<std::uint32_t> cells;
    for (std::size_t i = 0; i < codes.size(); ++i)
      if (codes[i] == c->code) cells.push_back(static_cast<std::uint32_t>(i));
    if (cells.empty()) continue;
    VectorFeature feature;
    feature.polygons = on_map(outline(grid, cells), origin);
    feature.values = {
        c->name,     static_cast<std::int64_t>(c->code),
        c->label,    static_cast<double>(cells.size()) * grid.cell_size * grid.cell_size,
        recipe.name, recipe.edition,
        basis};
    layer.features.push_back(std::move(feature));
  }
  return layer;
}

VectorLayer uncertain_layer(const MapLayer& certainty, const PassageGrid& grid,
                            const Vec3& origin) {
  VectorLayer layer{"uncertain",
                    "cells whose class is another one at a bound of the frequencies",
                    GeometryType::multi_polygon,
                    {{"area_m2", FieldType::real}},
                    {},
                    vector_qml({SymbolKind::polygon,
                                "",
                                {{"", "class not certain", {40, 40, 40, 255}, "f_diagonal"}},
                                0.1})};
  std::vector<std::uint32_t> cells;
  for (std::size_t i = 0; i < certainty.cell.size(); ++i)
    if (certainty.bands[0].value[i] == 0) cells.push_back(certainty.cell[i]);
  if (cells.empty()) return layer;
  VectorFeature feature;
  feature.polygons = on_map(outline(grid, cells), origin);
  feature.values = {static_cast<double>(cells.size()) * grid.cell_size * grid.cell_size};
  layer.features.push_back(std::move(feature));
  return layer;
}

}  // namespace

std::vector<VectorLayer> hazard_polygons(const MapLayer& classes, const MapLayer& certainty,
                                         const PassageGrid& grid, const Vec3& origin,
                                         const Recipe& recipe,
                                         const std::vector<std::string>& notes) {
  std::vector<int> codes(
      static_cast<std::size_t>(grid.n_rows) * static_cast<std::size_t>(grid.n_cols), no_class);
  for (std::size_t i = 0; i < classes.cell.size(); ++i)
    if (const float code = classes.bands[0].value[i]; !std::isnan(code))
      codes[classes.cell[i]] = static_cast<int>(code);
  const std::string basis = joined(notes);
  return {uncertain_layer(certainty, grid, origin),
          class_layer("classes", "hazard classes as the cells have them", codes, grid, origin,
                      recipe, basis),
          class_layer("classes_smoothed",
                      "the same, each cell by the most of its neighbours, twice: for drawings",
                      smoothed_classes(codes, grid.n_rows, grid.n_cols, 2), grid, origin, recipe,
                      basis)};
}

}  // namespace talus
