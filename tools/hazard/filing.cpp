// A hazard map as an authority files it, by the terms of a data model.
#include "tools/hazard/filing.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <functional>

#include "base/text.hpp"
#include "io/topology_gdal.hpp"
#include "post/hazard/patches.hpp"
#include "tools/frame/build_info.hpp"
#include "tools/frame/filing_keys.hpp"
#include "tools/hazard/layers.hpp"

namespace talus {
namespace {

using Value = FieldValue;
constexpr FieldType words = FieldType::text;
constexpr const char* swiss_model = "Hazard_Mapping 1.2";

// At most n letters: a field of the model holds no more.
std::string cut(std::string text, std::size_t n) {
  std::size_t at = 0, letters = 0;
  while (at < text.size() && letters < n) {
    ++at;
    while (at < text.size() && (static_cast<unsigned char>(text[at]) & 0xC0) == 0x80) ++at;
    ++letters;
  }
  text.resize(at);
  return text;
}

// Common part of all areas of a filing.
struct Filed {
  const Site& site;
  const HazardSources& sources;
  std::string canton, process_source, method;
  std::size_t n_process_sources = 0;

  [[nodiscard]] const Recipe& recipe() const { return sources.recipe; }
  // Each event is a rock, a mass, or one or the other by its class.
  [[nodiscard]] const char* process(const char* rocks, const char* masses, const char* both) const {
    const auto of_rocks = [](const HazardRuns& runs) { return runs.kind.of_rocks; };
    const auto& classes = sources.classes;
    if (std::all_of(classes.begin(), classes.end(), of_rocks)) return rocks;
    return std::none_of(classes.begin(), classes.end(), of_rocks) ? masses : both;
  }
  [[nodiscard]] std::string comments() const {
    return cut(site.hazard.author + ", " + site.hazard.date + "; source: " + process_source + "; " +
                   method,
               250);
  }
};

Filed filed_of(const Site& site, const HazardSources& sources) {
  Filed filed{site, sources, canton_of(site), {}, {}, 0};
  const auto add = [&](const std::string& name) {
    filed.process_source += (filed.process_source.empty() ? "" : ", ") + name;
    ++filed.n_process_sources;
  };
  if (std::find(site.sections.begin(), site.sections.end(), "source") != site.sections.end())
    add(site.info.name);
  for (const RockfallSettings& source : site.rockfalls) add(source.name);
  for (const PlacedSettings& source : site.blocks) add(source.name);
  if (filed.n_process_sources == 0) add(site.info.name);
  filed.method = "modelling, Talus " + std::string(build_version) + "; " + sources.recipe.name;
  return filed;
}

// One polygon of one layer of cells.
struct Area {
  const Filed& of;
  std::string id;
  double period = std::nan("");  ///< NaN: of all of them
  int value = 0;                 ///< from 1, the weakest
  std::string quality;
  double quantity = std::nan("");
  double area = 0;
};

Value text_or_none(const std::string& words) { return words.empty() ? Value() : Value(words); }
Value number_or_none(double value) { return std::isnan(value) ? Value() : Value(value); }
// As written in names of maps: to a year from ten years on.
double years_of(double period) { return period < 10 ? period : std::round(period); }
Value whole_years(const Area& a) {
  return std::isnan(a.period) ? Value() : Value(static_cast<std::int64_t>(std::lround(a.period)));
}

const std::vector<Field<Area>>& inspire_fields() {
  using Row = const Area&;
  static const std::vector<Field<Area>> fields = {
      {"inspireId_localId", "", "Identifier", [](Row a) -> Value { return a.id; }, words},
      {"inspireId_namespace", "", "Namespace of the identifier",
       [](Row a) -> Value { return a.of.site.hazard.name_space; }, words},
      {"beginLifeSpanVersion", "", "Day of the assessment",
       [](Row a) -> Value { return a.of.site.hazard.date + "T00:00:00Z"; }, words},
      {"determinationMethod", "", "How the area was determined",
       [](Row) -> Value { return "modelling"; }, words},
      {"typeOfHazard_hazardCategory", "", "Category of the hazard",
       [](Row) -> Value {
         return "http://inspire.ec.europa.eu/codelist/NaturalHazardCategoryValue/landslide";
       },
       words},
      {"typeOfHazard_specificHazardType", "", "Process",
       [](Row a) -> Value {
         return a.of.process("rockfall", "rockslide", "rockfall and rockslide");
       },
       words},
      {"likelihoodOfOccurrence_quantitativeLikelihood_returnPeriod", "", "Return period, in years",
       [](Row a) -> Value { return number_or_none(years_of(a.period)); }},
      {"likelihoodOfOccurrence_assessmentMethod_name", "", "How the likelihood was assessed",
       [](Row a) -> Value { return a.of.method; }, words},
      {"magnitudeOrIntensity_qualitativeValue", "", "Intensity or class in words",
       [](Row a) -> Value { return text_or_none(a.quality); }, words},
      {"magnitudeOrIntensity_quantitativeValue", "", "Energy that is exceeded",
       [](Row a) -> Value { return number_or_none(a.quantity); }},
      {"magnitudeOrIntensity_quantitativeValue_uom", "", "Its unit",
       [](Row a) -> Value { return std::isnan(a.quantity) ? Value() : Value("kJ"); }, words},
      {"magnitudeOrIntensity_assessmentMethod_name", "", "How the intensity was assessed",
       [](Row a) -> Value { return a.of.method; }, words},
      {"process_source", "", "Process source", [](Row a) -> Value { return a.of.process_source; },
       words},
      {"author", "", "Author", [](Row a) -> Value { return a.of.site.hazard.author; }, words},
      {"area_m2", "m2", "Area", [](Row a) -> Value { return a.area; }}};
  return fields;
}

using AreaFields = std::vector<Field<Area>>;

// Of every class of the Swiss model.
AreaFields swiss_fields(const AreaFields& more) {
  using Row = const Area&;
  AreaFields fields = {
      {"T_Ili_Tid", "", "Identifier",
       [](Row a) -> Value { return a.id + "." + lower(a.of.canton) + ".ch"; }, words},
      {"data_responsibility", "", "Canton", [](Row a) -> Value { return a.of.canton; }, words},
      {"comments", "", "Author, day, process source, method",
       [](Row a) -> Value { return a.of.comments(); }, words}};
  fields.insert(fields.end(), more.begin(), more.end());
  return fields;
}

// The tool cannot know whether all processes and sources were looked at.
Value to_be_clarified(const Area&) { return "to_be_clarified"; }
Value subprocess(const Area& a) {
  return a.of.process("r_rock_fall", "r_rock_slide_rock_avalanche", "rockfall");
}

const Field<Area> process_field = {"process_cantonal_term", "", "Process in the canton's words",
                                   [](const Area& a) -> Value {
                                     return a.of.process("rockfall", "rockslide",
                                                         "rockfall and rockslide");
                                   },
                                   words};
const Field<Area> intensity_field = {
    "intensity_class", "", "Intensity",
    [](const Area& a) -> Value { return swiss_intensities[static_cast<std::size_t>(a.value) - 1]; },
    words};
const Field<Area> years_field = {"return_period_in_years", "", "Return period, in years",
                                 whole_years, FieldType::integer};
// The longest period beyond 300 years is the model's extreme event.
const Field<Area> extreme_field = {
    "extreme_scenario", "", "Extreme event",
    [](const Area& a) -> Value {
      return static_cast<std::int64_t>(a.period > 300 &&
                                       a.period == a.of.recipe().return_periods.back());
    },
    FieldType::boolean};

const AreaFields& synoptic_fields() {
  static const AreaFields fields =
      swiss_fields({intensity_field,
                    process_field,
                    years_field,
                    extreme_field,
                    {"subproc_synoptic_intensity", "", "Process", subprocess, words},
                    {"sources_in_subprocesses_compl", "", "All sources were looked at",
                     to_be_clarified, words}});
  return fields;
}

const AreaFields& by_source_fields() {
  static const AreaFields fields =
      swiss_fields({intensity_field,
                    process_field,
                    years_field,
                    extreme_field,
                    {"process_source", "", "Process source",
                     [](const Area& a) -> Value { return cut(a.of.process_source, 50); }, words},
                    {"subproc_intensity_by_source", "", "Process", subprocess, words},
                    {"subscenario_probability", "", "Probability of the scenario",
                     [](const Area&) -> Value { return 1.0; }}});
  return fields;
}

const AreaFields& level_fields() {
  static const AreaFields fields = swiss_fields(
      {{"main_process", "", "Process", [](const Area&) -> Value { return "rockfall"; }, words},
       {"hazard_level", "", "Hazard level",
        [](const Area& a) -> Value { return swiss_levels[static_cast<std::size_t>(a.value) - 1]; },
        words},
       {"subprocesses_complete", "", "All processes were looked at", to_be_clarified, words},
       {"sources_complete", "", "All sources were looked at", to_be_clarified, words}});
  return fields;
}

template <int is_rocks>
Value state_of_fall(const Area& a) {
  const bool all = a.of.process("rocks", "masses", "both") == std::string("both");
  const bool this_one =
      a.of.process("rocks", "masses", "both") == std::string(is_rocks ? "rocks" : "masses");
  return all || this_one ? "assessed_and_to_be_clarified" : "not_assessed";
}

const AreaFields& perimeter_fields() {
  static const AreaFields fields = [] {
    AreaFields out = swiss_fields({});
    const auto none = [](const Area&) -> Value { return "not_assessed"; };
    for (const auto& [name, title] : std::vector<std::pair<const char*, const char*>>{
             {"fl_state_flooding", "Flooding"},
             {"df_state_debris_flow", "Debris flow"},
             {"be_state_bank_erosion", "Bank erosion"},
             {"pl_state_permanent_landslide", "Permanent landslide"},
             {"sl_state_spontaneous_landslide", "Spontaneous landslide"},
             {"hd_state_hillslope_debris_flow", "Hillslope debris flow"}})
      out.push_back({name, "", title, none, words});
    out.push_back({"rf_state_rock_fall", "", "Rock fall", state_of_fall<1>, words});
    out.push_back({"rs_state_rock_slide_rock_aval", "", "Rock slide and rock avalanche",
                   state_of_fall<0>, words});
    for (const auto& [name, title] : std::vector<std::pair<const char*, const char*>>{
             {"if_state_ice_fall", "Ice fall"},
             {"sh_state_sinkhole", "Sinkhole"},
             {"su_state_subsidence", "Subsidence"},
             {"fa_state_flowing_avalanche", "Flowing avalanche"},
             {"pa_state_powder_avalanche", "Powder avalanche"},
             {"gs_state_gliding_snow", "Gliding snow"}})
      out.push_back({name, "", title, none, words});
    return out;
  }();
  return fields;
}

// --- areas ---------------------------------------------------------------------------------------

// Meaning of the value of a cell.
struct Meaning {
  std::string name;  ///< of the layer of cells: "intensity T300"
  double period = std::nan("");
  std::function<std::string(int)> quality;
  std::function<double(int)> quantity;
  bool is_counted = true;  ///< not a second time
};

class Filer {
 public:
  Filer(const Filed& filed, const PassageGrid& grid, const Vec3& origin, std::string path)
      : filed_(filed), grid_(grid), origin_(origin), path_(std::move(path)) {}

  VectorLayer start(const std::string& name, const std::string& description,
                    const AreaFields& fields, const std::string& geometry,
                    const VectorStyle& style) const {
    return {
        name,    description, GeometryType::polygon, vector_fields(fields), {}, vector_qml(style),
        geometry};
  }

  // The patches of one layer of cells, none of which lies over another.
  void add(VectorLayer& layer, const AreaFields& fields, const MapLayer& cells, const MapBand& band,
           const Meaning& meaning, const std::function<int(float)>& value_of) {
    std::vector<int> values(static_cast<std::size_t>(grid_.n_rows) * grid_.n_cols, 0);
    int most = 0;
    for (std::size_t i = 0; i < cells.cell.size(); ++i)
      if (!std::isnan(band.value[i]))
        most = std::max(most, values[cells.cell[i]] = value_of(band.value[i]));
    const double cell = grid_.cell_size * grid_.cell_size, least = filed_.recipe().min_area;
    note(join_small_patches(values, grid_.n_cols,
                            static_cast<std::int64_t>(std::ceil(least / cell - 1e-9))),
         meaning);
    std::vector<std::vector<std::vector<Vec2>>> all;
    for (int value = most; value > 0; --value) {
      std::vector<std::uint32_t> of_value;
      for (std::size_t i = 0; i < values.size(); ++i)
        if (values[i] == value) of_value.push_back(static_cast<std::uint32_t>(i));
      for (auto& rings : polygons_on_map(grid_, of_value, origin_)) {
        Area area{filed_, "", meaning.period, value, "", std::nan(""), area_of(rings)};
        area.id = cut(file_id() + "." + meaning.name + "." + std::to_string(all.size() + 1), 100);
        std::replace(area.id.begin(), area.id.end(), ' ', '_');
        if (meaning.quality) area.quality = meaning.quality(value);
        if (meaning.quantity) area.quantity = meaning.quantity(value);
        all.push_back(rings);
        layer.features.push_back({{}, {}, {std::move(rings)}, values_of(fields, area)});
      }
    }
    check_topology(all, {least, 0.5 * grid_.cell_size}, path_, layer.name);
    n_polygons_ += all.size();
  }

  // The ground that was modelled.
  void add_perimeter(VectorLayer& layer, const AreaFields& fields, const std::vector<bool>& known) {
    std::vector<std::uint32_t> cells;
    for (std::size_t i = 0; i < known.size(); ++i)
      if (known[i]) cells.push_back(static_cast<std::uint32_t>(i));
    int n = 0;
    for (auto& rings : polygons_on_map(grid_, cells, origin_)) {
      Area area{filed_,
                file_id() + ".perimeter." + std::to_string(++n),
                std::nan(""),
                0,
                "",
                std::nan(""),
                area_of(rings)};
      layer.features.push_back({{}, {}, {std::move(rings)}, values_of(fields, area)});
    }
  }

  [[nodiscard]] VectorLayer left_out() const {
    struct Row {
      std::string of;
      double area;
    };
    static const std::vector<Field<Row>> fields = {
        {"of", "", "Left out of", [](const Row& r) -> Value { return r.of; }, words},
        {"area_m2", "m2", "Area", [](const Row& r) -> Value { return r.area; }}};
    VectorLayer layer{"left_out",
                      "patches with nothing around them, smaller than what is filed",
                      GeometryType::polygon,
                      vector_fields(fields),
                      {},
                      vector_qml({SymbolKind::polygon,
                                  "",
                                  {{"", "too small to be filed", {40, 40, 40, 255}, "f_diagonal"}},
                                  0.1})};
    for (const auto& [of, cells] : left_out_)
      for (auto& rings : polygons_on_map(grid_, cells, origin_)) {
        const Row row{of, area_of(rings)};
        layer.features.push_back({{}, {}, {std::move(rings)}, values_of(fields, row)});
      }
    return layer;
  }

  [[nodiscard]] Json result() const {
    const double cell = grid_.cell_size * grid_.cell_size;
    const auto area = [cell](std::int64_t n) { return static_cast<double>(n) * cell; };
    std::int64_t n_left_out = 0;
    for (const auto& [of, cells] : left_out_) n_left_out += static_cast<std::int64_t>(cells.size());
    return {{"model", filed_.canton.empty() ? "INSPIRE HazardArea" : swiss_model},
            {"n_polygons", n_polygons_},
            {"min_area_m2", filed_.recipe().min_area},
            {"n_joined", repair_.n_joined},
            {"raised_m2", area(repair_.cells_raised)},
            {"lowered_m2", area(repair_.cells_lowered - n_left_out)},
            {"n_left_out", repair_.n_left_out},
            {"left_out_m2", area(n_left_out)}};
  }

 private:
  void note(PatchRepair repair, const Meaning& meaning) {
    if (!meaning.is_counted) return;
    repair_.n_joined += repair.n_joined;
    repair_.n_left_out += repair.n_left_out;
    repair_.cells_raised += repair.cells_raised;
    repair_.cells_lowered += repair.cells_lowered;
    if (!repair.left_out.empty()) left_out_.emplace_back(meaning.name, std::move(repair.left_out));
  }

  [[nodiscard]] double area_of(const std::vector<std::vector<Vec2>>& rings) const {
    double twice = 0;
    for (const auto& ring : rings)
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const Vec2 a = ring[i] - ring[0], b = ring[(i + 1) % ring.size()] - ring[0];
        twice += a.x() * b.y() - a.y() * b.x();
      }
    return twice / 2;
  }

  [[nodiscard]] std::string file_id() const {
    std::string id = lower(filed_.site.info.name);
    for (char& c : id)
      if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
    return id;
  }

  const Filed& filed_;
  const PassageGrid& grid_;
  Vec3 origin_;
  std::string path_;
  PatchRepair repair_;
  std::vector<std::pair<std::string, std::vector<std::uint32_t>>> left_out_;
  std::size_t n_polygons_ = 0;
};

// --- styles --------------------------------------------------------------------------------------

// Of areas over each other one period is seen: the longest, which may be changed in the expression.
std::string of_longest(const Recipe& recipe, const std::string& period, const std::string& field) {
  return "CASE WHEN \"" + period + "\" = " + text(years_of(recipe.return_periods.back())) +
         " THEN \"" + field + "\" END";
}

VectorStyle outline_style(const std::string& label) {
  return {SymbolKind::polygon, "", {{"", label, {20, 20, 20, 255}, "no"}}, 0.6};
}

VectorStyle intensity_style(const std::string& field, const std::vector<std::string>& values,
                            const Recipe& recipe) {
  VectorStyle style{SymbolKind::polygon, field, {}, 0.2};
  const auto n = static_cast<double>(values.size());
  for (std::size_t i = values.size(); i-- > 0;) {
    Colour colour = ramp_colour(Ramp::intensity, (static_cast<double>(i) + 1) / n);
    colour[3] = 180;
    style.classes.push_back({values[i], intensity_words(recipe, i), colour});
  }
  return style;
}

VectorStyle level_style(const std::string& field, const std::vector<std::string>& values,
                        const Recipe& recipe) {
  VectorStyle style = class_style(recipe, 0.2);  // the worst first
  style.field = field;
  for (std::size_t i = 0; i < values.size(); ++i)
    style.classes[values.size() - 1 - i].value = values[i];
  return style;
}

VectorStyle energy_style(const Recipe& recipe) {
  VectorStyle style{SymbolKind::polygon,
                    of_longest(recipe, "likelihoodOfOccurrence_quantitativeLikelihood_returnPeriod",
                               "magnitudeOrIntensity_quantitativeValue"),
                    {},
                    0.2};
  const std::vector<StyleClass> steps = stepped_classes(energy_limits, " kJ", false, Ramp::energy);
  for (std::size_t i = steps.size(); i-- > 0;) {
    Colour colour = steps[i].colour;
    colour[3] = 180;
    style.classes.push_back({i == 0 ? "0" : text(energy_limits[i - 1]), steps[i].label, colour});
  }
  return style;
}

// --- both models ---------------------------------------------------------------------------------

const MapLayer* layer_named(const std::vector<MapLayer>& layers, const std::string& name) {
  const auto at = std::find_if(layers.begin(), layers.end(),
                               [&](const MapLayer& layer) { return layer.name == name; });
  return at == layers.end() ? nullptr : &*at;
}

int rank_of_code(const Recipe& recipe, float code) {
  for (std::size_t i = 0; i < recipe.classes.size(); ++i)
    if (static_cast<float>(recipe.classes[i].code) == code) return static_cast<int>(i) + 1;
  return 0;
}

int code_as_it_is(float code) { return static_cast<int>(code); }

int rank_of_energy(float energy) {
  const auto above = std::count_if(energy_limits.begin(), energy_limits.end(),
                                   [energy](double limit) { return energy > limit; });
  return energy > 0 ? static_cast<int>(above) + 1 : 0;
}

void add_intensities(Filer& filer, VectorLayer& layer, const AreaFields& fields,
                     const std::vector<MapLayer>& layers, const Recipe& recipe,
                     bool is_counted = true) {
  const MapLayer& cells = *layer_named(layers, "intensity");
  for (std::size_t t = 0; t < recipe.return_periods.size(); ++t) {
    const double period = recipe.return_periods[t];
    filer.add(
        layer, fields, cells, cells.bands[t],
        {layer.name + " T" + period_name(period),
         period,
         [&recipe](int i) { return intensity_words(recipe, static_cast<std::size_t>(i) - 1); },
         {},
         is_counted},
        code_as_it_is);
  }
}

void add_classes(Filer& filer, VectorLayer& layer, const AreaFields& fields,
                 const std::vector<MapLayer>& layers, const Recipe& recipe) {
  const MapLayer& cells = *layer_named(layers, "class");
  filer.add(layer, fields, cells, cells.bands[0],
            {layer.name,
             std::nan(""),
             [&recipe](int i) { return recipe.classes[static_cast<std::size_t>(i) - 1].label; },
             {}},
            [&recipe](float code) { return rank_of_code(recipe, code); });
}

void add_energies(Filer& filer, VectorLayer& layer, const std::vector<MapLayer>& layers,
                  const Recipe& recipe) {
  for (const double period : recipe.return_periods)
    if (const MapLayer* cells = layer_named(layers, "ke_T" + period_name(period)))
      filer.add(layer, inspire_fields(), *cells, cells->bands[0],
                {layer.name + " T" + period_name(period),
                 period,
                 {},
                 [](int i) { return i < 2 ? 0 : energy_limits[static_cast<std::size_t>(i) - 2]; }},
                rank_of_energy);
}

std::vector<VectorLayer> inspire_layers(Filer& filer, const Filed& filed,
                                        const std::vector<MapLayer>& layers,
                                        const std::vector<bool>& known) {
  const Recipe& recipe = filed.recipe();
  const AreaFields& fields = inspire_fields();
  const std::string quality = "magnitudeOrIntensity_qualitativeValue";
  std::vector<std::string> intensities, labels;
  for (std::size_t i = 0; i < recipe.intensities.size(); ++i)
    intensities.push_back(intensity_words(recipe, i));
  for (const RecipeClass& c : recipe.classes) labels.push_back(c.label);
  VectorLayer classes = filer.start("HazardArea_class", "areas of a hazard class", fields, "geom",
                                    level_style(quality, labels, recipe));
  add_classes(filer, classes, fields, layers, recipe);
  VectorLayer intensity = filer.start(
      "HazardArea", "areas of an intensity by return period", fields, "geom",
      intensity_style(
          of_longest(recipe, "likelihoodOfOccurrence_quantitativeLikelihood_returnPeriod", quality),
          intensities, recipe));
  add_intensities(filer, intensity, fields, layers, recipe);
  VectorLayer energy = filer.start("HazardArea_energy", "areas of an energy by return period",
                                   fields, "geom", energy_style(recipe));
  add_energies(filer, energy, layers, recipe);
  VectorLayer perimeter = filer.start("perimeter", "ground that was modelled", fields, "geom",
                                      outline_style("perimeter"));
  filer.add_perimeter(perimeter, fields, known);
  return {std::move(perimeter), std::move(classes), std::move(intensity), std::move(energy)};
}

std::vector<VectorLayer> swiss_layers(Filer& filer, const Filed& filed,
                                      const std::vector<MapLayer>& layers,
                                      const std::vector<bool>& known) {
  const Recipe& recipe = filed.recipe();
  const VectorStyle of_intensity = intensity_style(
      of_longest(recipe, "return_period_in_years", "intensity_class"), swiss_intensities, recipe);
  std::vector<VectorLayer> out;
  out.push_back(filer.start("assessment_area", "ground that was modelled", perimeter_fields(),
                            "area", outline_style("assessment area")));
  filer.add_perimeter(out.back(), perimeter_fields(), known);
  out.push_back(filer.start("hazard_area", "areas of a hazard level", level_fields(), "impact_zone",
                            level_style("hazard_level", swiss_levels, recipe)));
  add_classes(filer, out.back(), level_fields(), layers, recipe);
  out.push_back(filer.start("synoptic_intensity", "areas of an intensity by return period",
                            synoptic_fields(), "impact_zone", of_intensity));
  add_intensities(filer, out.back(), synoptic_fields(), layers, recipe);
  if (filed.n_process_sources > 1) return out;
  out.push_back(filer.start("intensity_by_source", "the same of the one process source",
                            by_source_fields(), "impact_zone", of_intensity));
  add_intensities(filer, out.back(), by_source_fields(), layers, recipe, false);
  return out;
}

}  // namespace

Filing filing_of(const Site& site, const HazardSources& sources,
                 const std::vector<MapLayer>& layers, const PassageGrid& grid,
                 const std::vector<bool>& known, const Vec3& origin, const std::string& path) {
  const Filed filed = filed_of(site, sources);
  Filer filer(filed, grid, origin, path);
  Filing filing;
  filing.layers = filed.canton.empty() ? inspire_layers(filer, filed, layers, known)
                                       : swiss_layers(filer, filed, layers, known);
  filing.layers.push_back(filer.left_out());
  filing.result = filer.result();
  const Json& r = filing.result;
  const auto number = [&r](const char* key) { return text(r[key].get<double>(), 6); };
  filing.words = "\nto be filed: " + number("n_polygons") + " polygons by " +
                 r["model"].get<std::string>() + "; smaller than " + number("min_area_m2") +
                 " m2: " + number("n_joined") + " joined (" + number("raised_m2") + " m2 raised, " +
                 number("lowered_m2") + " lowered), " + number("n_left_out") + " left out (" +
                 number("left_out_m2") + " m2)";
  return filing;
}

}  // namespace talus
