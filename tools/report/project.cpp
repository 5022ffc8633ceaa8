// Layers and groups of the QGIS project of a site.
#include "tools/report/project.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <set>
#include <sstream>
#include <utility>

#include "base/file_paths.hpp"
#include "base/text.hpp"
#include "draw/ticks.hpp"
#include "io/crs_gdal.hpp"
#include "io/style.hpp"
#include "io/tags_gdal.hpp"
#include "post/maps/map_layers.hpp"
#include "report/plan_view.hpp"
#include "report/styles_gdal.hpp"
#include "site/site_layers.hpp"
#include "tools/report/page.hpp"

namespace talus {
namespace {

namespace fs = std::filesystem;

// Of layers that bring none: an outline that covers nothing.
std::string plain_style() {
  return vector_qml({SymbolKind::polygon, "", {{"", "", {42, 87, 184, 60}}}, 0.5});
}

constexpr const char* protection = "Protective structures";  // group of the layers

// Where the project lies, paths in it begin.
std::string relative_to(const std::string& project, const fs::path& path) {
  const fs::path folder = fs::absolute(fs::path(project)).parent_path();
  return fs::absolute(path).lexically_normal().lexically_relative(folder.lexically_normal());
}

// Names of layers of the packages in legends; the rest by their own names.
std::string layer_words(const std::string& name) {
  static const std::map<std::string, std::string> words = {
      {"fences", "Fence: verdict"},
      {"dams", "Dam or gallery: verdict"},
      {"fence_fields", "Fields of the fence: verdict"},
      {"fence_posts", "Posts of the fence"},
      {"fence_arrivals", "Blocks that arrived"},
      {"candidates", "Candidate lines"},
      {"front", "Best lines by length and residual"},
      {"proposals", "Proposed fence line"},
      {"posts", "Posts of the proposal"},
      {"objects", "Object at risk"},
      {"source_cells", "Source cells by probability of a hit"},
      {"links", "Links of source cells and object"},
      {"observed_boulders", "Observed boulders"},
      {"observed_scars", "Observed scars, with their heights"},
      {"observed_outlines", "Outline of an observed deposit"},
      {"uncertain", "Class not certain"},
      {"classes", "Class"},
      {"classes_smoothed", "Class, smoothed"},
      {"envelope", "Area that any block passed"},
      {"deposit", "Blocks at the end"},
      {"paths", "Paths of the blocks"},
      {"path_points", "Points of the paths"},
      {"impacts", "Impacts of the blocks"},
      {"streamline", "Path to the toe, with L and H"},
      {"reach_points", "Ends of L and H"},
      {"runs", "Centre of mass at the end of a run"},
      {"blocks", "Blocks of the source"},
      {"source_area", "Source"},
      {"stability", "Factor of safety: which blocks go first"}};
  if (const auto at = words.find(name); at != words.end()) return at->second;
  std::string out = name;
  std::replace(out.begin(), out.end(), '_', ' ');
  return out;
}

void add_package(QgisProject& project, const std::string& file, const ResultFolder& folder,
                 const std::string& package, const std::string& group,
                 const std::set<std::string>& hidden) {
  if (!folder.has(package)) return;
  static constexpr QgisLayer::Kind kinds[] = {QgisLayer::raster, QgisLayer::point, QgisLayer::line,
                                              QgisLayer::polygon};
  for (StyledLayer& layer : styled_layers(folder.path(package).string())) {
    QgisLayer added{group,
                    layer_words(layer.name),
                    relative_to(file, folder.path(package)) + "|layername=" + layer.name,
                    kinds[layer.shape],
                    layer.qml.empty() ? plain_style() : layer.qml,
                    hidden.count(layer.name) == 0};
    added.about = layer.description;
    added.fields = std::move(layer.fields);
    project.layers.push_back(std::move(added));
  }
}

// Lines of many runs would cover the classes: those of the farthest run represent all.
void show_farthest(QgisProject& project, const ReportData& data) {
  std::string id;
  double farthest = -1;
  for (const Json& run : data.runout.at("runs")) {
    const Json length = run.at("event").value("L_path_m", Json());
    if (!length.is_number() || length.get<double>() <= farthest) continue;
    farthest = length.get<double>();
    id = run.at("run_id").get<std::string>();
  }
  if (id.empty()) return;
  for (QgisLayer& layer : project.layers)
    for (const char* name :
         {"runout.gpkg|layername=streamline", "runout.gpkg|layername=reach_points"})
      if (layer.source.ends_with(name)) {
        layer.source += "|subset=\"run_id\" = '" + id + "'";
        layer.name += ", farthest run";
      }
}

std::string unit_words(const BandTags& band, const std::string& before, const std::string& after) {
  return band.unit.empty() || band.unit == "1" ? "" : before + band.unit + after;
}

// A raster with its definition and unit.
QgisLayer raster_layer(const std::string& file, const ResultFolder& folder, const std::string& base,
                       const std::string& group, const std::string& name, const RasterTags& tags) {
  QgisLayer layer{group,
                  name,
                  relative_to(file, folder.path(base + ".tif")),
                  QgisLayer::raster,
                  folder.text(base + ".qml"),
                  false};
  for (const BandTags& band : tags.bands)
    if (band.name == tags.shown) layer.about = band.meaning + unit_words(band, "; in ", "");
  return layer;
}

QgisLayer raster_layer(const std::string& file, const ResultFolder& folder, const std::string& base,
                       const std::string& group, const std::string& name) {
  return raster_layer(file, folder, base, group, name,
                      raster_tags(folder.path(base + ".tif").string()));
}

// "velocity_p95_hi" of the map velocity -> "95th percentile, upper bound"; empty for a map of one
// quantity.
std::string band_words(const std::string& map, const std::string& band) {
  static const std::map<std::string, std::string> known = {
      {"p50", "median"},          {"p90", "90th percentile"}, {"p95", "95th percentile"},
      {"p99", "99th percentile"}, {"max", "largest"},         {"lo", "lower bound"},
      {"hi", "upper bound"}};
  if (!band.starts_with(map + "_")) return "";
  std::string words;
  std::istringstream parts(band.substr(map.size() + 1));
  for (std::string part; std::getline(parts, part, '_');) {
    const auto at = known.find(part);
    words += (words.empty() ? "" : ", ") + (at == known.end() ? part : at->second);
  }
  return words;
}

// A map with a style a band of its quantity, in the name which one is shown.
QgisLayer map_layer(const std::string& file, const ResultFolder& folder, const std::string& base,
                    const MapLayerKind& kind) {
  const RasterTags tags = raster_tags(folder.path(base + ".tif").string());
  const std::vector<BandTags>& bands = tags.bands;
  QgisLayer layer = raster_layer(file, folder, base, kind.group, kind.title, tags);
  const auto at = std::find_if(bands.begin(), bands.end(),
                               [&tags](const BandTags& band) { return band.name == tags.shown; });
  if (at == bands.end()) return layer;
  layer.shown = band_words(kind.name, tags.shown);
  layer.name += (layer.shown.empty() ? "" : ", " + layer.shown) + unit_words(*at, " [", "]");
  if (layer.shown.empty()) return layer;
  const std::string number = "band=\"" + std::to_string(at - bands.begin() + 1) + "\"";
  const std::size_t of_shown = layer.style.find(number);
  for (std::size_t i = 0; i < bands.size() && of_shown != std::string::npos; ++i) {
    const std::string name = band_words(kind.name, bands[i].name);
    if (name.empty() || bands[i].unit != at->unit || bands[i].name == tags.shown) continue;
    std::string style = layer.style;
    style.replace(of_shown, number.size(), "band=\"" + std::to_string(i + 1) + "\"");
    layer.other_styles.emplace_back(name, std::move(style));
  }
  return layer;
}

// Two maps over each other show neither: where there are classes, these are visible.
void add_maps(QgisProject& project, const std::string& file, const ResultFolder& folder,
              const ReportData& data) {
  const bool has_classes = data.hazard.is_object() && data.hazard.at("classes").is_array();
  for (const MapLayerKind& kind : map_layers()) {
    const std::string base = std::string("maps/") + kind.name;
    if (!folder.has(base + ".tif")) continue;
    project.layers.push_back(map_layer(file, folder, base, kind));
    project.layers.back().visible = kind.is_visible && !has_classes;
  }
}

// Of each case alone, where there are several.
void add_case_maps(QgisProject& project, const std::string& file, const ResultFolder& folder,
                   const ReportData& data) {
  for (const auto& [name, pictures] : data.case_maps)
    for (const MapLayerKind& kind : map_layers()) {
      const std::string base = "maps/" + name + "/" + kind.name;
      if (!folder.has(base + ".tif")) continue;
      QgisLayer layer = map_layer(file, folder, base, kind);
      layer.group = "Case " + name;
      layer.name += ", case " + name;
      layer.visible = false;
      project.layers.push_back(std::move(layer));
    }
}

// "ke_T300", "return_period_300kJ", "return_period_0.25m3" and the rest by their names.
std::string hazard_words(const std::string& name) {
  if (name.starts_with("ke_T"))
    return "Kinetic energy of the return period " + name.substr(4) + " a [kJ]";
  if (name.starts_with("return_period_")) {
    const std::string limit = name.substr(14, name.size() - 16),
                      unit = name.substr(name.size() - 2);
    return "Return period of " + (limit == "0" ? "any block" : limit + " " + unit + " and more") +
           " [a]";
  }
  std::string words = layer_words(name);
  if (!words.empty()) words[0] = static_cast<char>(std::toupper(words[0]));
  return words;
}

void add_objects(QgisProject& project, const std::string& file, const ResultFolder& folder,
                 const ReportData& data) {
  add_package(project, file, folder, "fence_search.gpkg", "Fence search", {"candidates", "front"});
  add_package(project, file, folder, "trace.gpkg", "Objects", {"source_cells", "links"});
  if (data.trace.is_object())
    for (const Json& object : data.trace.at("objects")) {
      const std::string base = "sources/source_" + file_word(text_at(object, "/name"));
      if (folder.has(base + ".tif"))
        project.layers.push_back(
            raster_layer(file, folder, base, "Objects", "Sources of " + text_at(object, "/name")));
    }
}

// Classes above the maps that they are made of; the class as polygons is visible.
void add_hazard(QgisProject& project, const std::string& file, const ResultFolder& folder,
                const ReportData& data) {
  if (!data.hazard.is_object()) return;
  if (data.hazard.at("classes").is_array()) {
    add_package(project, file, folder, "hazard/hazard.gpkg", "Hazard classes",
                {"classes_smoothed"});
    const std::size_t first = project.layers.size();
    add_package(project, file, folder, "hazard/filing.gpkg", "To be filed", {});
    for (std::size_t i = first; i < project.layers.size(); ++i) project.layers[i].visible = false;
  }
  for (const std::string& name : hazard_maps_of(data.hazard)) {
    const std::string base = "hazard/" + name;
    if (!folder.has(base + ".tif")) continue;
    project.layers.push_back(
        raster_layer(file, folder, base, "Frequency and return period", hazard_words(name)));
  }
}

// A name is written once: by the result, where the layer of the input has one.
std::string without_labels(std::string style) {
  constexpr std::string_view end = "</labeling>";
  const std::size_t begin = style.find("<labeling"), close = style.find(end);
  if (begin != std::string::npos && close != std::string::npos)
    style.erase(begin, close + end.size() - begin);
  return style;
}

// Inputs of the site, to be edited: the styles and forms are those of the file.
void add_inputs(QgisProject& project, const std::string& file, const ResultFolder& folder,
                const Site& site) {
  if (site.layers_file.empty()) return;
  static constexpr QgisLayer::Kind kinds[] = {QgisLayer::raster, QgisLayer::point, QgisLayer::line,
                                              QgisLayer::polygon};
  const std::string path = resolved(site, site.layers_file);
  const std::vector<StyledLayer> layers = styled_layers(path);
  for (const SiteLayer& known : site_layers())
    for (const StyledLayer& layer : layers) {
      if (known.name != layer.name) continue;
      const std::string style = layer.qml.empty() ? plain_style() : layer.qml;
      const bool has_result = (known.section == "fence" && folder.has("fence.gpkg")) ||
                              (known.section == "object" && folder.has("trace.gpkg"));
      project.layers.push_back({"Inputs (edit, then make)", known.title,
                                relative_to(file, path) + "|layername=" + layer.name,
                                kinds[layer.shape], has_result ? without_labels(style) : style,
                                true});
    }
  project.is_edited = true;
}

// Of the relief in the window [m].
double interval_in(const Trn& trn, const PlanWindow& window) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (int r = 0; r < trn.n_rows; ++r)
    for (int c = 0; c < trn.n_cols; ++c) {
      const Vec3 node = node_point(trn, r, c);
      const Vec2 at = node.head<2>();
      if (std::isnan(node.z()) || (at.array() < window.low.array()).any() ||
          (at.array() > window.high.array()).any())
        continue;
      low = std::min(low, node.z());
      high = std::max(high, node.z());
    }
  return low < high ? round_up((high - low) / 20) : 0;
}

// Of the template's placeholders.
std::map<std::string, std::string> layout_words(const ReportData& data,
                                                const QgisProject& project) {
  const auto tag = [&data](const std::string& name) {
    return text_at(data.runout, ("/tags/" + name).c_str());
  };
  const std::string crs = crs_name(data.terrain.crs_wkt);
  std::string statement =
      project.run + ", CRS " + crs + "\n" + tag("DENOMINATOR") + "\nhealth: " + tag("HEALTH");
  if (data.hazard.is_object() && data.hazard.at("classes").is_array() &&
      data.hazard.contains("notes") && data.hazard["notes"].is_array())
    for (const Json& note : data.hazard["notes"])
      if (note.is_string()) statement += "\n" + note.get<std::string>();
  return {{"title", data.texts.of("page.title", {{"site", data.site.info.name}}) +
                        (project.remark.empty() ? "" : " (" + project.remark + ")")},
          {"site", data.site.info.name},
          {"remark", project.remark},
          {"statement", statement},
          {"author", data.site.hazard.author},
          {"date", data.site.hazard.date},
          {"run_id", data.run_id},
          {"version", data.version},
          {"crs", crs}};
}

}  // namespace

QgisProject project_of(const ReportData& data, const std::string& file,
                       const ResultFolder& folder) {
  const Trn& trn = data.terrain;
  QgisProject project;
  project.remark = remark_of(data).empty() ? fence_remark_of(data) : remark_of(data);
  project.crs_wkt = trn.crs_wkt;
  if (const std::string name = crs_name(trn.crs_wkt); name.starts_with("EPSG:"))
    project.crs_authid = name.substr(0, name.find(' '));
  const PlanWindow window = plan_window(data.shown, trn);
  const Vec2 origin = trn.origin.head<2>(), low = window.low + origin, high = window.high + origin;
  project.extent = {low.x(), low.y(), high.x(), high.y()};
  project.run = "run id " + data.run_id + ", Talus " + data.version;
  project.words = layout_words(data, project);

  // the source that is computed over the one that was drawn
  add_package(project, file, folder, "stability/blocks.gpkg", "Source", {});
  add_package(project, file, folder, "blocks.gpkg", "Source", {"blocks"});
  add_inputs(project, file, folder, data.site);
  add_package(project, file, folder, "fence.gpkg", protection, {"fence_fields", "fence_posts"});
  if (folder.has("change.tif"))
    project.layers.push_back(
        raster_layer(file, folder, "change", protection, "Change by the structures"));
  add_package(project, file, folder, "calibrate.gpkg", "Observed", {});
  add_objects(project, file, folder, data);
  // Footprints of many runs would cover the maps.
  std::set<std::string> hidden = {"path_points", "impacts", "paths",
                                  "envelope",    "runs",    "tree_hits"};
  if (data.runs.size() > 1) hidden.insert("deposit");
  add_package(project, file, folder, "runout.gpkg", "Paths", hidden);
  if (data.runs.size() > 1) show_farthest(project, data);
  add_hazard(project, file, folder, data);
  add_case_maps(project, file, folder, data);
  add_maps(project, file, folder, data);
  project.contour_interval = interval_in(trn, window);
  if (project.contour_interval > 0)
    project.layers.push_back({"Terrain", "Contours every " + text(project.contour_interval) + " m",
                              relative_to(file, folder.path("trn.tif")), QgisLayer::contours, "",
                              true});
  project.layers.push_back({"Terrain", "Hillshade", relative_to(file, folder.path("trn.tif")),
                            QgisLayer::hillshade, "", true});
  return project;
}

}  // namespace talus
