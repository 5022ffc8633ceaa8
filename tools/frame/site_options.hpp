// tools/frame/site_options.hpp
// The site file as every tool that reads one takes it: the file, layers that define its
// sections, --variant, --set, and the values for --print-config.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "site/site.hpp"
#include "site/uncertainty.hpp"
#include "tools/frame/tool.hpp"

namespace talus {

/// Declares SITE.toml, --variant and --set on a tool; load() reads the file once, applies the
/// variants, the overrides and, for a tool with `draws`, the sample that --sample names.
class SiteOptions {
 public:
  /// `required`: else the tool has a use without a site file, and load() must not be called for it.
  explicit SiteOptions(Tool& tool, std::optional<DrawScope> draws = {}, bool required = true);

  /// An option of the tool that sets a key of the site file and wins over it.
  void option(Tool& tool, const std::string& name, const std::string& key, const std::string& help);
  /// Declares --add: files with further sections, as if they were at the end of the site file.
  void take_additions(Tool& tool);
  /// Declares --inputs: files of the site as talus-import wrote them. Other bytes of that file do
  /// not change results: the content read counts.
  void take_inputs();

  /// Throws InputError (read_site, check_variants, check_uncertainty, apply_draws), UsageError
  /// (--set).
  const Site& load();
  /// The same without --variant: the site that a measure is compared with.
  const Site& as_it_is();
  [[nodiscard]] const std::string& file() const { return file_; }
  /// The site file and its variants, for a tool that is started.
  [[nodiscard]] std::vector<std::string> words() const;
  [[nodiscard]] bool has_variant() const { return !variants_.empty(); }
  /// Names of the file and of the options that override it. Where its effective values count, the
  /// words that they were given in do not.
  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }

 private:
  void take_overrides(Site& site) const;
  static void read_quantities(Tool& tool, Site& site);
  void keep_files(const Site& site) const;
  [[nodiscard]] std::string with_additions() const;

  Tool& tool_;
  std::string file_, inputs_;
  std::vector<std::string> overrides_, variants_, additions_, names_{"site", "set", "variant"};
  std::unique_ptr<Site> site_, as_it_is_;
  Site before_variants_;
  std::optional<DrawScope> draws_;
};

}  // namespace talus
