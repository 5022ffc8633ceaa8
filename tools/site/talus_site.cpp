// tools/site/talus_site.cpp
// Splits the site file into the settings of each stage, so that make repeats a stage only when its
// own settings have changed. Page: docs/tools/talus-site.md
#include <algorithm>
#include <cctype>
#include <cstring>
#include <filesystem>
#include <map>

#include "base/file_paths.hpp"
#include "base/read_file.hpp"
#include "base/source_path.hpp"
#include "base/text.hpp"
#include "import/feature_tables_gdal.hpp"
#include "io/data_files_gdal.hpp"
#include "setup/site_files.hpp"
#include "site/site_layers.hpp"
#include "site/stages.hpp"
#include "tools/frame/command_line.hpp"
#include "tools/frame/object_files.hpp"
#include "tools/frame/site_options.hpp"
#include "tools/frame/tool.hpp"
#include "tools/site/file_digests.hpp"
#include "tools/site/new_layers.hpp"

namespace {

using namespace talus;  // NOLINT: a program of its own
namespace fs = std::filesystem;

// A file that is missing stops make here, once, and not in the middle of the pipeline.
void check_files(const Site& site) {
  for (const EffectiveValue& value : effective_values(site)) {
    const std::string file = file_named(site, value);
    if (!file.empty() && !fs::exists(file))
      throw InputError(where_of(site, value.section + "." + value.key),
                       value.key + " of [" + value.section + "]: there is no file " + file,
                       "names are relative to the folder of the site file");
  }
}

// NAME=FILE or NAME=: the name of a list, and a file of it.
struct GivenFile {
  std::string name, file;
};

GivenFile given_file(const std::string& words) {
  const std::size_t sign = words.find('=');
  const std::string name = words.substr(0, sign);
  if (sign == std::string::npos || name.empty() || name.find('/') != std::string::npos)
    throw UsageError({"", 0, "--given"}, "is " + words + ", expected NAME=FILE or NAME=",
                     "NAME becomes the name of a file, NAME.files");
  return {name, words.substr(sign + 1)};
}

// The pipeline gives its files names of its own, and `make clean` removes them.
void check_results_folder(const Site& site, const std::string& folder,
                          const std::vector<std::string>& given) {
  std::vector<std::string> files = files_named(site);
  files.push_back(site.file);
  for (const std::string& words : given) files.push_back(file_of(given_file(words).file));
  const std::string results = absolute_path(folder) + "/";
  for (const std::string& file : files)
    if (!file.empty() && fs::exists(file) && absolute_path(file).starts_with(results))
      throw InputError({file}, "is an input and lies in " + folder + ", the folder of the results",
                       "move it, or name another folder: make OUT=out2");
}

// A daylighting failure surface depends on the friction of the ground, so on [ground.*] too.
bool is_read(const Site& site, const std::string& stage, const EffectiveValue& value) {
  if (stage_reads(stage, value)) return true;
  const bool is_ground = value.section.starts_with("ground.") || value.key == "ground_raster";
  return is_ground && (stage == "blocks" || stage == "rock") &&
         site.source.failure_surface == "daylighting";
}

// Digests of the files that a data set is made of.
std::string digests_of(const std::string& path, FileDigests& digests) {
  std::string out;
  for (const std::string& file : data_files(path)) out += " " + digests.of(file);
  return out;
}

// Of a layer that defines sections its features count, as the key names them: another fence is
// not another source. A GIS also changes bytes of the file when it only looks at it.
std::string digest_of_layer(const Site& site, const EffectiveValue& value) {
  const SourcePath named = parse_source_path(resolved(site, unquoted(value.value)));
  return " " +
         digest_of_features(named.source, named.layer, named.subset, attributes_of(named.layer));
}

// Settings of a stage, a line a value; files by their content.
std::string settings_of(const Site& site, const std::string& stage, FileDigests& digests) {
  std::string out = "# what the stage " + stage + " reads of the site file\n";
  for (const EffectiveValue& value : effective_values(site)) {
    if (value.value.empty() || !is_read(site, stage, value)) continue;
    out += value.section + "." + value.key + " = " + value.value;
    const std::string file = file_named(site, value);
    if (!file.empty())
      out += "  # sha256" + (names_layers_file(site, unquoted(value.value))
                                 ? digest_of_layer(site, value)
                                 : digests_of(file, digests));
    out += "\n";
  }
  return out;
}

// --- files that make was given -----------------------------------------------------------------

// A list a name: its files and their digests.
std::map<std::string, std::string> lists_of(const std::vector<std::string>& given,
                                            FileDigests& digests) {
  std::map<std::string, std::string> lists;
  for (const std::string& words : given) {
    const auto [name, file] = given_file(words);
    std::string& list = lists[name];
    if (list.empty()) list = "# files that make was given for " + name + "\n";
    if (file.empty()) continue;
    const std::string read = file_of(file);
    list += file + "  # sha256" + (is_virtual(read) ? " none" : digests_of(read, digests)) + "\n";
  }
  return lists;
}

// --- variables for make ------------------------------------------------------------------------

// A word in a recipe: quoted for the shell, with make's own signs as it takes them for text.
std::string shell_word(const std::string& word, const Site& site) {
  std::string out = "'";
  for (const char c : word) {
    if (std::iscntrl(static_cast<unsigned char>(c)) != 0)
      throw InputError({site.file}, "\"" + word + "\" holds a line break or control character",
                       "take it out: the value stands in a makefile");
    out += c == '\'' ? "'\\''" : c == '$' ? "$$" : c == '#' ? "$(number_sign)" : std::string(1, c);
  }
  return out + "'";
}

// A name for rules and recipes: one with a special character of make or of the shell is
// refused, so that a site file can name things but not give orders.
const std::string& plain_name(const std::string& name, const Where& where) {
  for (const char c : name)
    if (static_cast<unsigned char>(c) < 0x80 && std::isalnum(static_cast<unsigned char>(c)) == 0 &&
        std::strchr("_-+=,./@ #:%", c) == nullptr)
      throw InputError(where, "the name " + name + " cannot stand in a makefile",
                       "use letters, digits, blanks and _-+=,./@#:%");
  return name;
}

// The name of a file as a prerequisite and as a word of a recipe. At its beginning - is an option,
// # a remark of the shell.
std::string make_word(const std::string& path, const Site& site) {
  std::string out = !path.empty() && (path[0] == '-' || path[0] == '#') ? "./" : "";
  const std::string name = plain_name(path, {site.file});
  for (const char c : name)
    out += c == ' ' || c == '#' || c == ':' ? std::string("\\") + c : std::string(1, c);
  return out;
}

std::string joined(const std::vector<double>& numbers) {
  std::string out;
  for (const double number : numbers) out += (out.empty() ? "" : ",") + text(number);
  return out;
}

std::string tin_flags(const Site& site) {
  return site.terrain.flat.empty() ? "" : " --flat " + shell_word(site.terrain.flat, site);
}

std::string trn_flags(const Site& site) {
  const TerrainSettings& t = site.terrain;
  std::string out;
  if (!std::isnan(t.cell_size_m)) out += " --cell-size-m " + text(t.cell_size_m);
  if (!t.window_m.empty()) out += " --window " + joined(t.window_m);
  return out;
}

// A rule names the file of the contours alone. A member of an archive that is named alone
// is written there by GDAL's name for it.
std::string contours_file(const Site& site) {
  static_cast<void>(shell_word(site.terrain.contours, site));  // refuses line breaks
  const SourcePath contours = parse_source_path(resolved(site, site.terrain.contours));
  const bool is_member = contours.inside.find('/') == 0;
  return is_member || is_virtual(contours.source) ? contours.source : contours.file;
}

std::string make_variables(const Site& site) {
  std::string no_fences;  // options of talus-dda
  for (const FenceSettings& fence : site.fences)
    no_fences += " --set " + shell_word("fence." + fence.name + ".active=false", site);
  // Names of sections as words of a rule.
  const auto words_of = [&site](const std::string& group, const auto& sections) {
    std::string words;
    for (const auto& section : sections) {
      const auto cannot_stand = [](char c) {
        const auto byte = static_cast<unsigned char>(c);
        return byte < 0x80 && std::isalnum(byte) == 0 && std::strchr("_-+,.", c) == nullptr;
      };
      if (std::any_of(section.name.begin(), section.name.end(), cannot_stand))
        throw InputError(
            {site.file, section.line},
            "the name of [" + group + "." + section.name + "] cannot stand in a makefile",
            "use letters, digits and _-+,.");
      words += " " + section.name;
    }
    return words;
  };
  const bool any_active = std::any_of(site.fences.begin(), site.fences.end(),
                                      [](const FenceSettings& fence) { return fence.active; });
  std::string out = "# written by talus-site from the site file\nnumber_sign := \\#\n";
  const auto line = [&out](const char* name, const std::string& value) {
    out += std::string(name) + " :=" + (value.empty() || value[0] == ' ' ? "" : " ") + value + "\n";
  };
  line("SITE_CONTOURS", make_word(contours_file(site), site));
  line("SITE_DEM", make_word(resolved(site, site.terrain.dem), site));
  line("SITE_TIN_FLAGS", tin_flags(site));
  line("SITE_TRN_FLAGS", trn_flags(site));
  line("SITE_RUNS", std::to_string(site.solver.n_runs));
  line("SITE_SEED", std::to_string(site.solver.seed));
  const bool has_water = std::ranges::find(site.sections, "water") != site.sections.end();
  line("SITE_WATER", has_water ? "yes" : "");
  line("SITE_FENCES", site.fences.empty() && site.dams.empty() ? "" : "yes");
  line("SITE_DAMS", site.dams.empty() ? "" : "yes");
  line("SITE_WITHOUT_FENCES", no_fences);
  line("SITE_SAMPLES", site.quantities.empty() && site.uncertainty.rock_masses == 0 ? "" : "yes");
  line("SITE_ROCKS_ALONE", site.rockfalls.empty() ? "" : "yes");
  line("SITE_MAX_FAILED_SHARE", text(site.uncertainty.max_failed_share));
  line("SITE_FRAMES", site.output.frames ? "yes" : "");
  line("SITE_WHOLE_SHARE", text(site.output.whole_share));
  line("SITE_PLACES", site.places.empty() ? "" : "yes");
  line("SITE_OBSERVED", site.observed.empty() ? "" : "yes");
  line("SITE_FENCES_STAND", any_active ? "yes" : "");
  line("SITE_HAZARD_CLASSES", words_of("hazard.class", site.hazard_classes));
  line("SITE_OBJECTS", site.objects.empty() ? "" : "yes");
  line("SITE_FENCE_SEARCHES", words_of("fence_search", site.fence_searches));
  std::vector<VariantSettings> alternatives, measures;
  for (const VariantSettings& variant : site.variants)
    (is_alternative(variant) ? alternatives : measures).push_back(variant);
  line("SITE_ALTERNATIVES", words_of("variant", alternatives));
  line("SITE_MEASURES", words_of("variant", measures));
  return out;
}

// --- drawn values ----

// A line a quantity; "" where nothing is drawn.
std::string draws_text(const Site& site) {
  std::string words;
  for (const QuantitySettings& quantity : site.quantities)
    words += (words.empty() ? "" : "\n") + quantity.name + ": " + text_of(site, quantity) +
             (is_rock(quantity) ? "; cuts the rock" : "");
  if (site.uncertainty.rock_masses > 0)
    words += (words.empty() ? "" : "\n") + std::to_string(site.uncertainty.rock_masses) +
             " rock masses, each cut anew";
  return words;
}

Json draws_json(const Site& site) {
  Json list = Json::array();
  for (const QuantitySettings& quantity : site.quantities)
    list.push_back({{"quantity", quantity.name},
                    {"keys", keys_drawn(quantity)},
                    {"cuts_rock", is_rock(quantity)},
                    {"words", text_of(site, quantity)}});
  return {{"drawn", list}, {"rock_masses", site.uncertainty.rock_masses}};
}

// --- the whole ---------------------------------------------------------------------------------

// A file that holds this already keeps its time, so that make sees no change.
void write_if_changed(Tool& tool, const fs::path& path, const std::string& content) {
  if (fs::exists(path) && read_file(path.string()) == content) return;
  tool.write_text(path.string(), content);
  tool.detail("changed: " + path.string());
}

}  // namespace

int main(int argc, char** argv) {
  std::string folder, results;
  std::vector<std::string> given;
  Tool tool("talus-site", "Parts the site file into what each stage of the pipeline reads.");
  SiteOptions site_options(tool, {}, false);
  NewLayers new_layers;
  const ToolOption out =
      tool.output_folder("-o,--out", folder, "folder for a file a stage, and site.mk");
  tool.list("--given", given,
            "NAME=FILE: a file that make was given; DIR/NAME.files lists those of a NAME with "
            "their digests");
  tool.option("--results", results,
              "folder of the results: refused where it holds a file that is read");
  declare_new_layers(tool, new_layers);
  tool.footer(
      "Example:\n  talus-site site.toml -o out/stages --overwrite --no-db\n"
      "  talus-site --new-layers site.gpkg --crs-of dem.tif --source release.gpkg --no-db");
  return tool.run(argc, argv, [&] {
    if (!new_layers.out.empty()) return make_new_layers(tool, new_layers);
    if (site_options.file().empty() || !out.is_given())
      throw UsageError({"", 0, "command line"}, "needs a site file and a folder to write to",
                       "talus-site site.toml -o out/stages, or --new-layers site.gpkg");
    const Site& site = site_options.load();
    const std::string variables = make_variables(site);
    check_files(site);
    if (!results.empty()) check_results_folder(site, results, given);
    check_object_files(site);
    for (const VariantSettings& variant : site.variants) {
      if (site_options.has_variant()) break;  // the rest is not of the present site
      Site with = site;
      apply_variant(with, variant.name);
      check_files(with);
      check_object_files(with);
    }
    const fs::path stages = folder, memory = stages / ".digests";
    FileDigests digests(fs::is_regular_file(memory) ? read_file(memory.string()) : "");
    write_if_changed(tool, stages / "site.mk", variables);
    for (const std::string& stage : stage_names())
      write_if_changed(tool, stages / (stage + ".txt"), settings_of(site, stage, digests));
    for (const auto& [name, list] : lists_of(given, digests))
      write_if_changed(tool, stages / (name + ".files"), list);
    write_if_changed(tool, memory, digests.as_text());
    if (const std::string words = draws_text(site); !words.empty())
      tool.result(draws_json(site), words);
  });
}
