// tools/import/talus_import.cpp
// Inputs of a site, brought to one form: metres, one system, named layers.
// Page: docs/tools/talus-import.md
#include "base/text.hpp"
#include "import/canonical_gdal.hpp"
#include "import/crs_place_gdal.hpp"
#include "import/feature_tables_gdal.hpp"
#include "import/import_inputs_gdal.hpp"
#include "import/layer_names.hpp"
#include "import/site_rasters_gdal.hpp"
#include "import/tin_files_gdal.hpp"
#include "io/crs_gdal.hpp"
#include "io/data_files_gdal.hpp"
#include "setup/site_shapes_gdal.hpp"
#include "setup/vector_inputs_gdal.hpp"
#include "tools/frame/doubts.hpp"
#include "tools/frame/import_options.hpp"
#include "tools/frame/site_options.hpp"

namespace {

using namespace talus;  // NOLINT: a program of its own

struct Options {
  ImportOptions ground;
  std::string dem, out, report;
  DoubtOptions doubts;
};

// The ground is that of [terrain], with its keys where no option gives them. Of an elevation
// model the system is taken alone.
void take_from_site(Tool& tool, const Site& site, Options& o) {
  const TerrainSettings& t = site.terrain;
  const auto take = [&](const char* role, const std::string& path, std::string& given) {
    if (!given.empty() || path.empty()) return;
    given = resolved(site, path);
    tool.read_also(role, given);
  };
  ImportOptions& ground = o.ground;
  take("contours", t.contours, ground.contours.path);
  if (ground.contours.path.empty()) {
    if (!t.dem.empty()) o.dem = resolved(site, t.dem);
    return;
  }
  take("breaklines", t.breaklines, ground.breaklines.path);
  take("spots", t.spots, ground.spots.path);
  take("boundary", t.boundary, ground.boundary.path);
  const std::vector<std::string> fields = parted(t.elevation_field, ',');
  ground.fields.insert(ground.fields.begin(), fields.begin(), fields.end());
}

// The system of an elevation model or a TIN, which talus-trn reads, checks and reprojects.
std::string system_of_dem(Tool& tool, const std::string& path, const SystemsByUser& said) {
  tool.keep(path);
  tool.leave_out_of_run_id({"dem"});
  const std::string frame = !said.t_srs.empty() ? said.t_srs
                            : said.crs_given    ? said.crs
                            : is_tin_file(path) ? read_tin_file({path, "", 0}).tin.crs_wkt
                                                : crs_of_source(path);
  tool.content_read("dem.crs", frame);
  return frame;
}

// The layers of the ground, or the system of an elevation model, and all shapes on it; nothing
// where layers cannot be computed with in that system, since talus-trn takes it to another one.
InputsRequest whole_request(Tool& tool, const Site& site, Options& o) {
  InputsRequest request;
  if (!o.ground.contours.path.empty()) {
    request = request_of(tool, o.ground);
  } else if (!o.dem.empty()) {
    request.frame = system_of_dem(tool, o.dem, systems_by_user(o.ground.crs));
    request.has_frame = true;
    const CrsProblem problem = find_crs_problem(request.frame, Vec2::Zero());
    if (!request.frame.empty() && !problem.finding.empty()) {
      tool.warn(o.dem + ": " + problem.finding +
                ": what stands on it is read by each tool itself "
                "(give talus-import the --t-srs of talus-trn: make IMPORT_FLAGS)");
      return request;
    }
  } else {
    throw InputError(
        {site.file}, "[terrain] names neither contours nor dem",
        "name what the ground is made from: --set terrain.contours=FILE, or terrain.dem");
  }
  request.is_measured = true;
  for (RequestedLayer& layer : request.layers) layer.digest = digest_of_data(layer.ref.path);
  for (const RequestedLayer& layer : layers_of(site)) {
    if (!layer.file.empty()) tool.read_by_content(layer.ref.path);
    request.layers.push_back(layer);
  }
  return request;
}

// Rasters are used where they are. Like layers on the ground they count by content: the terrain,
// which is made from the same import, is not of an older fence.
std::vector<LayerReading> look_at_rasters(Tool& tool, const Site& site, const std::string& dem) {
  std::vector<LayerReading> rasters;
  if (!dem.empty() && !is_tin_file(dem)) rasters.push_back(look_at_raster("dem", dem));
  for (const SiteRaster& raster : rasters_of(site)) {
    tool.read_by_content(raster.path);
    tool.content_read(raster.key, digest_of_data(raster.path));
    rasters.push_back(look_at_raster(raster.key, raster.path));
  }
  return rasters;
}

// Tools refuse a raster in another system than that of the terrain: said before all else is made.
void doubt_systems(Tool& tool, const Site& site, const std::string& map) {
  if (!find_crs_problem(map, Vec2::Zero()).finding.empty()) return;  // talus-trn reprojects
  for (const SiteRaster& raster : rasters_of(site)) try {
      check_raster_system(crs_of_source(raster.path), map, raster.kind, raster.path);
    } catch (const InputError& error) {
      Doubt doubt = error.doubt();
      doubt.state = DoubtState::in_doubt;
      tool.doubts({doubt});
    }
}

Json as_json(const LayerReading& layer) {
  Json decisions = Json::array(), magnitudes = Json::object();
  for (const Decision& d : layer.decisions)
    decisions.push_back({{"question", d.question}, {"answer", d.answer}, {"why", d.why}});
  for (const Magnitude& m : layer.magnitudes)
    magnitudes[m.quantity] = {{"n", m.n},
                              {"lowest", m.lowest},
                              {"median", m.median},
                              {"highest", m.highest},
                              {"spread", m.spread}};
  return {{"name", layer.role},       {"file", layer.file},     {"layer", layer.layer},
          {"n_parts", layer.n_parts}, {"decisions", decisions}, {"magnitudes", magnitudes}};
}

// "contours: 163 lines, 100 to 126 m high, half of them below 110 m"
std::string line_of(const LayerReading& layer) {
  std::string words = layer.role + ": " + parts_of(layer);
  if (!layer.where.empty()) words += ", where " + layer.where;
  for (const Magnitude& m : layer.magnitudes) {
    const std::string unit = m.quantity == "z_m" ? " m" : "";
    if (m.quantity == "z_m" || m.quantity == "value")
      words += ", " + text(m.lowest, 7) + " to " + text(m.highest, 7) + unit + ", median " +
               text(m.median, 7) + unit;
  }
  return words;
}

void run_tool(Tool& tool, const Site& site, Options& o) {
  take_from_site(tool, site, o);
  const std::vector<LayerReading> rasters = look_at_rasters(tool, site, o.dem);
  const InputsRequest request = whole_request(tool, site, o);
  ImportReading reading;
  const Imported inputs = import_inputs(request, reading);
  say_reading(tool, reading);
  for (const VectorShapes& shapes : inputs.shapes) note_shapes(tool, shapes);
  doubt_systems(tool, site, inputs.map.crs_wkt);
  o.doubts.crs_wkt = inputs.map.crs_wkt;
  reading.layers.insert(reading.layers.end(), rasters.begin(), rasters.end());
  write_canonical(tool.stage(o.out), request, inputs, reading);
  Json report = {{"tool", "talus-import"},
                 {"run_id", tool.run_id()},
                 {"crs", crs_name(inputs.map.crs_wkt)},
                 {"layers", Json::array()}};
  std::string summary;
  for (const LayerReading& layer : reading.layers) {
    report["layers"].push_back(as_json(layer));
    summary += (summary.empty() ? "" : "\n") + line_of(layer);
  }
  report["notes"] = reading.notes;
  report["operations"] = reading.operations;
  tool.report(o.report, report);
  tool.result(report, summary);
}

}  // namespace

int main(int argc, char** argv) {
  Options o;
  Tool tool("talus-import", "Brings what a site is made from to one form.");
  SiteOptions site(tool);
  declare_import_options(tool, o.ground);
  tool.output("-o,--out", o.out, "layers in metres and in one system (GeoPackage)").required();
  tool.output("--report", o.report, "every decision, and how large the numbers are (JSON)");
  declare_doubts_layer(tool, o.doubts);
  tool.footer("Example:\n  talus-import site.toml -o inputs.gpkg --report import.json");
  return tool.run(argc, argv, [&] { run_tool(tool, site.load(), o); });
}
