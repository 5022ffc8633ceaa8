// tools/frame/site_options.hpp
// The site file as every tool that reads one takes it: the file, layers that stand for its
// sections,
// --set, and what --print-config shows.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/read_file.hpp"
#include "setup/site_files.hpp"
#include "setup/site_layers_gdal.hpp"
#include "site/site.hpp"
#include "site/soils.hpp"
#include "site/uncertainty.hpp"
#include "tools/frame/command_line.hpp"
#include "tools/frame/options.hpp"

namespace talus {

/// Declares SITE.toml and --set on a tool; load() reads the file once, applies the overrides and,
/// for a tool with `draws`, the sample that --sample names.
class SiteOptions {
 public:
  /// `required`: else the tool has a use without a site file, and load() must not be called for it.
  explicit SiteOptions(Tool& tool, std::optional<DrawScope> draws = {}, bool required = true)
      : tool_(tool), draws_(draws) {
    tool.input("site", file_, "site file (TOML)")->required(required);
    tool.app()
        .add_option("--set", overrides_, "override a key of the site file: section.key=value")
        ->allow_extra_args(false);
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

  /// An option of the tool that stands for a key of the site file and wins over it.
  void option(Tool& tool, const std::string& name, const std::string& key,
              const std::string& help) {
    names_.push_back(name.substr(2));
    tool.app().add_option_function<std::string>(
        name, [this, key](const std::string& value) { overrides_.push_back(key + "=" + value); },
        help + " [" + key + "]");
  }

  /// Declares --add: files with further sections, as if they stood at the end of the site file.
  void take_additions(Tool& tool) {
    tool.app()
        .add_option("--add", additions_,
                    "further sections, e.g. a fence of talus-fence-search (TOML)")
        ->allow_extra_args(false);
    names_.emplace_back("add");
  }

  /// Declares --inputs: what the site names as talus-import wrote it. Other bytes of that file make
  /// no other result: what is read of it counts.
  void take_inputs() {
    tool_.app()
        .add_option("--inputs", inputs_,
                    "the site's layers as talus-import wrote them; not given: as the site "
                    "names them")
        ->check(CLI::ExistingFile);
    tool_.leave_out_of_run_id({"inputs"});
  }

  /// Throws InputError (read_site, check_uncertainty, apply_draws), UsageError (--set).
  const Site& load() {
    if (site_) return *site_;
    Site site = additions_.empty() ? read_site(file_) : parse_site(with_additions(), file_);
    read_site_layers(tool_, site);
    keep_files(site);
    for (const std::string& word : overrides_) {
      const std::size_t equals = end_of_key(site, word);
      if (equals == std::string::npos)
        throw UsageError({"", 0, "--set"}, "\"" + word + "\" is not section.key=value",
                         "e.g. --set source.depth_m=12");
      from_command_line(
          [&] { override_value(site, word.substr(0, equals), word.substr(equals + 1)); });
    }
    keep_files(site);
    if (!site.info.layers.empty())
      throw UsageError({"", 0, "--set"}, "cannot name site.layers", "name it in the site file");
    check_uncertainty(site);
    check_grounds(site);
    if (draws_) apply_draws(site, *draws_);
    site.inputs = inputs_;
    if (!inputs_.empty()) tool_.read_by_content(inputs_);
    site_ = std::make_unique<Site>(std::move(site));
    return *site_;
  }
  [[nodiscard]] const std::string& file() const { return file_; }
  /// Names of the file and of the options that override it. Where its effective values count, the
  /// words that they were given in do not.
  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }

 private:
  // Also what --set puts others in the place of.
  void keep_files(const Site& site) const {
    for (const std::string& file : files_named(site)) tool_.keep(file);
  }

  [[nodiscard]] std::string with_additions() const {
    std::string text = read_file(file_, "give the path of a site.toml");
    for (const std::string& file : additions_) {
      tool_.read_also("add", file);
      text += "\n" + read_file(file, "it is named by --add");
    }
    return text;
  }

  Tool& tool_;
  std::string file_, inputs_;
  std::vector<std::string> overrides_, additions_, names_{"site", "set"};
  std::unique_ptr<Site> site_;
  std::optional<DrawScope> draws_;
};

}  // namespace talus
