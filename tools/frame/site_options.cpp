// Options of every tool that reads a site file: the file, its layers, --variant, --set.
#include "tools/frame/site_options.hpp"

#include <utility>

#include "base/read_file.hpp"
#include "setup/site_files.hpp"
#include "setup/site_layers_gdal.hpp"
#include "site/site_layers.hpp"
#include "site/soils.hpp"
#include "tools/frame/command_line.hpp"

namespace talus {

SiteOptions::SiteOptions(Tool& tool, std::optional<DrawScope> draws, bool required)
    : tool_(tool), draws_(draws) {
  const ToolOption site = tool.input("site", file_, "site file (TOML)");
  site.required(required);
  if (!required)  // another input may be meant by it
    site.check([](const std::string& name) {
      return name.ends_with(".toml") ? "" : name + " not expected: a site file ends with .toml";
    });
  tool.list("--variant", variants_, "the site as [variant.NAME] makes it; of several in order");
  tool.list("--set", overrides_, "override a key of the site file: section.key=value");
  tool.more_config([this] {
    std::vector<ConfigValue> values;
    if (file_.empty()) return values;
    for (const EffectiveValue& entry : effective_values(load()))
      if (!entry.value.empty())
        values.push_back({entry.section + "." + entry.key, entry.value,
                          entry.source + (entry.note.empty() ? "" : "; " + entry.note)});
    return values;
  });
  if (draws_)
    option(tool, "--sample", "uncertainty.sample",
           *draws_ == DrawScope::rock
               ? "which sample of [uncertainty] the rock is cut by, from 1"
               : "which sample of [uncertainty] this run is, from 1; 0: nothing is drawn");
}

void SiteOptions::option(Tool& tool, const std::string& name, const std::string& key,
                         const std::string& help) {
  names_.push_back(name.substr(2));
  tool.option(
      name, [this, key](const std::string& value) { overrides_.push_back(key + "=" + value); },
      help + " [" + key + "]");
}

void SiteOptions::take_additions(Tool& tool) {
  tool.list("--add", additions_, "further sections, e.g. a fence of talus-fence-search (TOML)");
  names_.emplace_back("add");
}

void SiteOptions::take_inputs() {
  tool_
      .option("--inputs", inputs_,
              "the site's layers as talus-import wrote them; not given: as the site names them")
      .existing_file();
  tool_.leave_out_of_run_id({"inputs"});
}

const Site& SiteOptions::load() {
  if (site_) return *site_;
  Site site = additions_.empty() ? read_site(file_) : parse_site(with_additions(), file_);
  read_site_layers(tool_, site);
  read_quantities(tool_, site);
  keep_files(site);
  check_variants(site);
  if (has_variant()) before_variants_ = site;
  for (const std::string& name : variants_) apply_variant(site, name);
  take_overrides(site);
  keep_files(site);
  if (!site.info.layers.empty() || !site.uncertainty.file.empty())
    throw UsageError({"", 0, "--set"},
                     std::string("cannot name ") +
                         (site.info.layers.empty() ? "uncertainty.file" : "site.layers"),
                     "name it in the site file");
  check_uncertainty(site);
  check_grounds(site);
  if (draws_) apply_draws(site, *draws_);
  site.inputs = inputs_;
  if (!inputs_.empty()) tool_.read_by_content(inputs_);
  site_ = std::make_unique<Site>(std::move(site));
  return *site_;
}

const Site& SiteOptions::as_it_is() {
  const Site& site = load();
  if (!has_variant()) return site;
  if (!as_it_is_) {
    as_it_is_ = std::make_unique<Site>(before_variants_);
    take_overrides(*as_it_is_);
    as_it_is_->inputs = inputs_;
  }
  return *as_it_is_;
}

void SiteOptions::take_overrides(Site& site) const {
  for (const std::string& word : overrides_) {
    const std::size_t equals = end_of_key(site, word);
    if (equals == std::string::npos)
      throw UsageError({"", 0, "--set"}, "\"" + word + "\" is not section.key=value",
                       "e.g. --set source.depth_m=12");
    from_command_line(
        [&] { override_value(site, word.substr(0, equals), word.substr(equals + 1)); });
  }
}

std::vector<std::string> SiteOptions::words() const {
  std::vector<std::string> out{file_};
  for (const std::string& name : variants_) out.insert(out.end(), {"--variant", name});
  return out;
}

// As the layers: its values count, and a run says them as its own.
void SiteOptions::read_quantities(Tool& tool, Site& site) {
  if (site.uncertainty.file.empty()) return;
  const std::string path = resolved(site, site.uncertainty.file);
  tool.read_by_content(path);
  take_quantities(site, read_file(path, "[uncertainty] file of the site file names it"), path);
  site.quantities_file = std::exchange(site.uncertainty.file, "");
}

// Also files that --set replaces.
void SiteOptions::keep_files(const Site& site) const {
  for (const std::string& file : files_named(site)) tool_.keep(file);
}

std::string SiteOptions::with_additions() const {
  std::string text = read_file(file_, "give the path of a site.toml");
  for (const std::string& file : additions_) {
    tool_.read_also("add", file);
    text += "\n" + read_file(file, "it is named by --add");
  }
  return text;
}

}  // namespace talus
