// Options of the tools that import data: systems, units, heights, layers.
#include "tools/frame/import_options.hpp"

#include <array>
#include <optional>
#include <utility>

#include "base/text.hpp"
#include "import/canonical_gdal.hpp"
#include "import/crs_operation_gdal.hpp"
#include "io/crs_gdal.hpp"
#include "setup/vector_inputs_gdal.hpp"
#include "tools/frame/command_line.hpp"
#include "tools/frame/tool.hpp"

namespace talus {
namespace {

struct NamedLayer {
  InputRole role;
  std::string name;
  LayerRef* ref;
};

std::array<NamedLayer, 5> layers_of(ImportOptions& o) {
  return {{{o.of_points ? InputRole::points : InputRole::contours, "contours", &o.contours},
           {InputRole::labels, "labels", &o.labels},
           {InputRole::breaklines, "breaklines", &o.breaklines},
           {InputRole::spots, "spots", &o.spots},
           {InputRole::boundary, "boundary", &o.boundary}}};
}

// Part of an option for one input: "spots=0.3048", or "0.3048" of the contours.
std::pair<LayerRef*, std::string> of_input(ImportOptions& o, const std::string& words) {
  for (const NamedLayer& layer : layers_of(o))
    if (words.starts_with(layer.name + "="))
      return {layer.ref, words.substr(layer.name.size() + 1)};
  return {&o.contours, words};
}

}  // namespace

std::string check_positive(const std::string& word) {
  double value = 0;
  if (parse_double(word, value) && value > 0) return {};
  return word + " is not a size, expected metres above 0";
}

std::string check_not_negative(const std::string& word) {
  double value = 0;
  if (parse_double(word, value) && value >= 0) return {};
  return word + " is not a distance, expected metres, 0 or more";
}

void declare_crs_options(Tool& tool, CrsOptions& o) {
  tool.option("--crs", o.crs,
              "CRS of a source that has none, or one that cannot be true; none: local metres");
  tool.option("--t-srs", o.t_srs, "reproject to this CRS, e.g. EPSG:32632 (heights stay)");
  tool.option("--vertical-crs", o.vertical_crs,
              "what the heights are in, e.g. EPSG:5773, or ellipsoidal");
  tool.option("--t-vertical", o.t_vertical, "take the heights to this system, e.g. EPSG:5773");
  tool.flag("--accept-ballpark", o.accept_ballpark,
            "reproject also where nothing is known of the datum");
}

SystemsByUser systems_by_user(const CrsOptions& o) {
  SystemsByUser said;
  said.crs_given = !o.crs.empty();
  said.accept_ballpark = o.accept_ballpark;
  from_command_line([&] {
    if (!o.crs.empty()) said.crs = crs_from_user(o.crs, "--crs");
    if (!o.t_srs.empty()) said.t_srs = crs_from_user(o.t_srs, "--t-srs");
    if (!o.vertical_crs.empty())
      said.vertical_crs = vertical_crs_from_user(o.vertical_crs, "--vertical-crs");
    if (!o.t_vertical.empty())
      said.t_vertical = target_heights_from_user(o.t_vertical, "--t-vertical");
  });
  return said;
}

void declare_import_options(Tool& tool, ImportOptions& o) {
  tool.flag("--points", o.of_points,
            "the source holds points of the ground, not contours: a vector layer, CSV or XYZ");
  tool.input("--labels", o.labels.path,
             "texts beside the contours that say their heights (e.g. the same DXF drawing)");
  tool.input("--breaklines", o.breaklines.path, "lines with heights where the slope breaks");
  tool.input("--spots", o.spots.path, "spot heights (points)");
  tool.input("--boundary", o.boundary.path,
             "polygons or closed lines: triangles with their centre outside go");
  tool.list("--elevation-field", o.fields,
            "field with the elevation of the contours, Z: the geometries' own; INPUT=FIELD: "
            "of labels, breaklines or spots");
  tool.option("--elevation-unit-m", o.elevation_unit_m,
              "metres in one unit of all elevations; 0: as their height system says, else metres")
      .check(check_positive);
  tool.list("--unit-m", o.units,
            "metres in one unit of the contours, in plan and height; INPUT=METRES: of labels, "
            "breaklines, spots or boundary")
      .check([&o](const std::string& words) { return check_positive(of_input(o, words).second); });
  declare_crs_options(tool, o.crs);
}

namespace {

void refuse_options_beside(const InputsRequest& inputs, const ImportOptions& o) {
  const CrsOptions& crs = o.crs;
  if (o.labels.path.empty() && o.breaklines.path.empty() && o.spots.path.empty() &&
      o.boundary.path.empty() && o.fields.empty() && o.units.empty() && o.elevation_unit_m == 0 &&
      (crs.crs + crs.t_srs + crs.vertical_crs + crs.t_vertical).empty())
    return;
  throw UsageError({o.contours.path},
                   "was written by talus-import, with " + counted(inputs.layers.size(), "layer") +
                       ", and says units, fields and systems itself",
                   "give layers, fields, units and systems to talus-import (make IMPORT_FLAGS)");
}

}  // namespace

InputsRequest request_of(Tool& tool, ImportOptions& o) {
  if (std::optional<InputsRequest> inputs = canonical_request(o.contours.path)) {
    refuse_options_beside(*inputs, o);
    tool.leave_out_of_run_id({"contours"});  // its ground counts, not the rest of the file
    tool.content_read("contours", inputs->seal);
    tool.content_read("contours.crs", inputs->frame);
    o.of_points = inputs->layers.front().role == InputRole::points;
    return std::move(*inputs);
  }
  for (const std::string& words : o.fields) {
    const auto [ref, field] = of_input(o, words);
    ref->elevation_field = field;
  }
  for (const std::string& words : o.units) {
    const auto [ref, unit] = of_input(o, words);
    static_cast<void>(parse_double(unit, ref->unit_m));  // was checked
  }
  InputsRequest request;
  static_cast<SystemsByUser&>(request) = systems_by_user(o.crs);
  request.elevation_unit_m = o.elevation_unit_m;
  for (const NamedLayer& layer : layers_of(o)) {
    if (layer.ref->path.empty()) continue;
    read_members(tool, layer.name, layer.ref->path);
    request.layers.push_back({layer.role, *layer.ref});
  }
  return request;
}

void say_reading(Tool& tool, const ImportReading& reading) {
  for (const LayerReading& layer : reading.layers)
    if (layer.role == "contours" || layer.role == "points")
      tool.info("elevation from " + layer.elevation_from + " of layer " + layer.layer +
                (layer.unit_m == 1 ? "" : ", in units of " + text(layer.unit_m) + " m"));
  for (const std::string& note : reading.notes) tool.info(note);
  for (const std::string& operation : reading.operations) {
    tool.info(operation);
    tool.record(operation);
  }
  tool.doubts(reading.doubts);
  for (const LayerReading& layer : reading.layers) tool.layer_read(facts_on(layer, layer.role));
}

}  // namespace talus
