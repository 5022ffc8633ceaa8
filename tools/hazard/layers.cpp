// Hazard classes as polygons.
#include "tools/hazard/layers.hpp"

#include <cmath>

#include "post/outline.hpp"

namespace talus {
namespace {

std::string joined(const std::vector<std::string>& notes) {
  std::string out;
  for (const std::string& note : notes) out += (out.empty() ? "" : "; ") + note;
  return out;
}

using Value = FieldValue;
constexpr FieldType words = FieldType::text;

struct ClassRow {
  const Recipe& recipe;
  const RecipeClass& of;
  double area;
  const std::string& basis;
};
const std::vector<Field<ClassRow>>& class_fields() {
  using Row = const ClassRow&;
  static const std::vector<Field<ClassRow>> fields = {
      {"class", "", "Class", [](Row r) -> Value { return r.of.name; }, words},
      {"code", "", "Code", [](Row r) -> Value { return r.of.code; }, FieldType::integer},
      {"label", "", "Label", [](Row r) -> Value { return r.of.label; }, words},
      {"area_m2", "m2", "Area", [](Row r) -> Value { return r.area; }},
      {"recipe", "", "Recipe", [](Row r) -> Value { return r.recipe.name; }, words},
      {"edition", "", "Edition", [](Row r) -> Value { return r.recipe.edition; }, words},
      {"basis", "", "Basis", [](Row r) -> Value { return r.basis; }, words}};
  return fields;
}

VectorLayer class_layer(const std::string& name, const std::string& description,
                        const std::vector<int>& codes, const PassageGrid& grid, const Vec3& origin,
                        const Recipe& recipe, const std::string& basis) {
  VectorLayer layer{name,
                    description,
                    GeometryType::multi_polygon,
                    vector_fields(class_fields()),
                    {},
                    vector_qml(class_style(recipe, 0.2))};
  for (auto c = recipe.classes.rbegin(); c != recipe.classes.rend(); ++c) {
    std::vector<std::uint32_t> cells;
    for (std::size_t i = 0; i < codes.size(); ++i)
      if (codes[i] == c->code) cells.push_back(static_cast<std::uint32_t>(i));
    if (cells.empty()) continue;
    VectorFeature feature;
    feature.polygons = polygons_on_map(grid, cells, origin);
    feature.values = values_of(
        class_fields(),
        {recipe, *c, static_cast<double>(cells.size()) * grid.cell_size * grid.cell_size, basis});
    layer.features.push_back(std::move(feature));
  }
  return layer;
}

const std::vector<Field<double>>& area_fields() {
  static const std::vector<Field<double>> fields = {
      {"area_m2", "m2", "Area", [](const double& area) -> Value { return area; }}};
  return fields;
}

VectorLayer uncertain_layer(const MapLayer& certainty, const PassageGrid& grid,
                            const Vec3& origin) {
  VectorLayer layer{"uncertain",
                    "cells whose class is another one at a bound of the frequencies",
                    GeometryType::multi_polygon,
                    vector_fields(area_fields()),
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
  feature.polygons = polygons_on_map(grid, cells, origin);
  feature.values =
      values_of(area_fields(), static_cast<double>(cells.size()) * grid.cell_size * grid.cell_size);
  layer.features.push_back(std::move(feature));
  return layer;
}

}  // namespace

std::vector<std::vector<std::vector<Vec2>>> polygons_on_map(const PassageGrid& grid,
                                                            const std::vector<std::uint32_t>& cells,
                                                            const Vec3& origin) {
  auto polygons = outline(grid, cells);
  for (auto& rings : polygons)
    for (auto& ring : rings)
      for (Vec2& p : ring) p += origin.head<2>();
  return polygons;
}

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
