// tools/import/talus_import.cpp
// What the ground of a site is made from, brought to one form: metres, one system, named layers.
// Page: docs/tools/talus-import.md
#include "base/text.hpp"
#include "import/canonical_gdal.hpp"
#include "import/import_inputs_gdal.hpp"
#include "import/layer_names.hpp"
#include "io/crs_gdal.hpp"
#include "setup/vector_inputs_gdal.hpp"
#include "tools/frame/import_options.hpp"
#include "tools/frame/site_options.hpp"

namespace {

using namespace talus;  // NOLINT: a program of its own

// What no option gives stands in [terrain].
void take_from_site(Tool& tool, const Site& site, ImportOptions& o) {
  const TerrainSettings& t = site.terrain;
  const auto take = [&](const char* role, const std::string& path, LayerRef& ref) {
    if (!ref.path.empty() || path.empty()) return;
    ref.path = resolved(site, path);
    tool.read_also(role, ref.path);
  };
  take("contours", t.contours, o.contours);
  take("breaklines", t.breaklines, o.breaklines);
  take("spots", t.spots, o.spots);
  take("boundary", t.boundary, o.boundary);
  const std::vector<std::string> fields = parted(t.elevation_field, ',');
  o.fields.insert(o.fields.begin(), fields.begin(), fields.end());
  if (o.contours.path.empty())
    throw InputError({site.file}, "[terrain] names no contours",
                     "an elevation model needs no talus-import: talus-trn reads it");
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
  std::string words = layer.role + ": " + counted(layer.n_parts, layer.noun);
  for (const Magnitude& m : layer.magnitudes)
    if (m.quantity == "z_m")
      words += ", " + text(m.lowest, 7) + " to " + text(m.highest, 7) + " m, median " +
               text(m.median, 7) + " m";
  return words;
}

void run_tool(Tool& tool, const Site& site, ImportOptions& o, const std::string& out,
              const std::string& report_file) {
  take_from_site(tool, site, o);
  ImportReading reading;
  const ContourMap map = import_map(request_of(tool, o), reading);
  say_reading(tool, reading);
  measure(map, reading);
  write_canonical(tool.stage(out), map, reading);
  Json report = {{"tool", "talus-import"},
                 {"run_id", tool.run_id()},
                 {"crs", crs_name(map.crs_wkt)},
                 {"layers", Json::array()}};
  std::string summary;
  for (const LayerReading& layer : reading.layers) {
    report["layers"].push_back(as_json(layer));
    summary += (summary.empty() ? "" : "\n") + line_of(layer);
  }
  report["notes"] = reading.notes;
  report["operations"] = reading.operations;
  if (!report_file.empty()) tool.write_text(report_file, json_text(report, 2) + "\n");
  tool.result(report, summary);
}

}  // namespace

int main(int argc, char** argv) {
  std::string out, report;
  ImportOptions o;
  Tool tool("talus-import", "Brings what the ground of a site is made from to one form.");
  SiteOptions site(tool);
  declare_import_options(tool, o, "--contours");
  tool.output("-o,--out", out, "layers in metres and in one system (GeoPackage)")->required();
  tool.output("--report", report, "every decision, and how large the numbers are (JSON)");
  tool.footer("Example:\n  talus-import site.toml -o inputs.gpkg --report import.json");
  return tool.run(argc, argv, [&] { run_tool(tool, site.load(), o, out, report); });
}
