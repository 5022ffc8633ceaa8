// Writes an empty site.gpkg: a layer a kind of section, with fields, forms and styles.
#include "tools/site/new_layers.hpp"

#include "base/text.hpp"
#include "import/feature_tables_gdal.hpp"
#include "import/vectors_gdal.hpp"
#include "io/crs_gdal.hpp"
#include "io/geopackage_gdal.hpp"
#include "site/site_layers.hpp"
#include "tools/frame/command_line.hpp"
#include "tools/site/layer_form.hpp"

namespace talus {
namespace {

VectorField field_of(const KeyDescription& key) {
  if (key.type == "number") return {key.key, FieldType::real};
  if (key.type == "whole number") return {key.key, FieldType::integer};
  if (key.type == "true or false") return {key.key, FieldType::boolean};
  return {key.key, FieldType::text};  // lists as TOML writes them
}

GeometryType type_of(SiteLayer::Shape shape) {
  return shape == SiteLayer::points  ? GeometryType::point
         : shape == SiteLayer::lines ? GeometryType::line
                                     : GeometryType::multi_polygon;
}

VectorLayer empty_layer(const SiteLayer& layer) {
  VectorLayer out{layer.name, layer.title, type_of(layer.shape), {}, {}, layer_form_qml(layer)};
  if (has_names(layer)) out.fields.push_back({"name", FieldType::text});
  for (const KeyDescription& key : fields_of(layer)) out.fields.push_back(field_of(key));
  out.fields.push_back({"remark", FieldType::text});
  return out;
}

// Even-odd rings as a polygon each: a ring in a ring, which is a hole, cannot be told here.
void add_polygons(Tool& tool, const std::string& path, const std::string& crs, VectorLayer& layer) {
  const VectorShapes found = read_vectors({path, VectorKind::areas}, crs);
  if (static_cast<int>(found.shapes.size()) != found.n_parts && found.n_united == 0)
    throw InputError({path}, "has a polygon with a hole, which is not copied",
                     "copy it into the layer source yourself, or take out the hole");
  for (const std::vector<Vec3>& shape : found.shapes) {
    std::vector<Vec2> ring;
    for (const Vec3& p : shape) ring.push_back(p.head<2>());
    VectorFeature feature{{}, {}, {{ring}}, {}};
    feature.values.resize(layer.fields.size());
    layer.features.push_back(std::move(feature));
  }
  tool.info(path + ": " + counted(static_cast<std::int64_t>(found.shapes.size()), "polygon") +
            " copied into the layer source");
}

}  // namespace

void declare_new_layers(Tool& tool, NewLayers& wanted) {
  tool.output("--new-layers", wanted.out,
              "make a file with the layers that stand for sections instead (GeoPackage)");
  tool.input("--crs-of", wanted.crs_of, "with it: raster or vector file that says their CRS");
  tool.input("--source", wanted.source,
             "with it: polygons that the layer source begins with (any vector source)");
}

void make_new_layers(Tool& tool, const NewLayers& wanted) {
  if (wanted.crs_of.empty())
    throw UsageError({"", 0, "--new-layers"}, "needs a coordinate system",
                     "name the ground: --crs-of dem.tif");
  const std::string said = crs_of_source(wanted.crs_of);
  const std::string crs = said.empty() ? said : horizontal_crs(said);
  std::vector<VectorLayer> layers;
  for (const SiteLayer& layer : site_layers()) {
    layers.push_back(empty_layer(layer));
    if (layer.section == "source" && !wanted.source.empty())
      add_polygons(tool, wanted.source, crs, layers.back());
  }
  write_geopackage(tool.stage(wanted.out), crs, layers);
  tool.result({{"layers", wanted.out}, {"crs", crs_name(crs)}},
              wanted.out + ": " + counted(static_cast<std::int64_t>(layers.size()), "layer") +
                  " in " + crs_name(crs));
}

}  // namespace talus
