// The part of post/hazard/recipe.hpp that reads the file.
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/sha256.hpp"
#include "base/text.hpp"
#include "post/hazard/recipe.hpp"

namespace talus {
namespace {

class RecipeReader {
 public:
  RecipeReader(const toml::table& root, const std::string& path) : root_(root), path_(path) {}

  Recipe read() {
    check_keys(root_, "",
               {"name", "edition", "source", "intensity", "return_period_a", "probability",
                "in_years", "matrix", "numbers", "split", "beyond", "risk", "mass", "min_area_m2",
                "width_m", "class"});
    recipe_.name = word(root_, "name", "name");
    recipe_.edition = word(root_, "edition", "edition");
    read_intensity();
    read_classes();
    if (root_.contains("risk"))
      read_risk();
    else
      read_classes_of_cells();
    check_classes_are_used();
    read_sources();
    return recipe_;
  }

 private:
  [[noreturn]] void refuse(const toml::node* node, const std::string& item,
                           const std::string& finding, const std::string& hint = "") const {
    throw InputError(
        {path_, node ? static_cast<int>(node->source().begin.line) : 0, item}, finding,
        hint.empty() ? "share/hazard/switzerland_ti.toml shows how a recipe is written" : hint);
  }
  void check_keys(const toml::table& table, const std::string& of,
                  const std::vector<std::string>& known) const {
    for (const auto& [key, node] : table)
      if (std::find(known.begin(), known.end(), key.str()) == known.end()) {
        std::string all;
        for (const std::string& name : known) all += (all.empty() ? "known: " : ", ") + name;
        refuse(&node, of + std::string(key.str()), "is not a key of a recipe", all);
      }
  }
  const toml::node& needed(const toml::table& table, const char* key,
                           const std::string& item) const {
    const toml::node* node = table.get(key);
    if (!node) refuse(&table, item, "is missing");
    return *node;
  }
  std::string word(const toml::table& table, const char* key, const std::string& item) const {
    const toml::node& node = needed(table, key, item);
    if (!node.is_string() || node.as_string()->get().empty()) refuse(&node, item, "is not a text");
    return node.as_string()->get();
  }
  double number(const toml::node& node, const std::string& item) const {
    const auto value = node.value<double>();
    if (!node.is_number() || !value || !std::isfinite(*value))
      refuse(&node, item, "is not a number");
    return *value;
  }
  double above_zero(const char* key) const {
    const double value = number(*root_.get(key), key);
    if (!(value > 0)) refuse(root_.get(key), key, "is not above 0");
    return value;
  }
  const toml::array& list(const toml::node& node, const std::string& item, std::size_t n) const {
    if (!node.is_array()) refuse(&node, item, "is not a list");
    const toml::array& out = *node.as_array();
    if (out.empty() || (n > 0 && out.size() != n))
      refuse(&node, item,
             "has " + std::to_string(out.size()) + " entries, expected " +
                 (n > 0 ? std::to_string(n) : std::string("one or more")));
    return out;
  }
  // Positive and ascending.
  std::vector<double> numbers(const toml::table& table, const char* key,
                              const std::string& item) const {
    std::vector<double> out;
    const toml::node& node = needed(table, key, item);
    for (const toml::node& entry : list(node, item, 0)) {
      out.push_back(number(entry, item));
      if (!(out.back() > (out.size() > 1 ? out[out.size() - 2] : 0)))
        refuse(&node, item, "does not ascend from above 0");
    }
    return out;
  }
  const toml::table& section(const toml::table& table, const char* key,
                             const std::string& item) const {
    const toml::node& node = needed(table, key, item);
    if (!node.is_table()) refuse(&node, item, "is not a section");
    return *node.as_table();
  }

  // Keys that are open in one form of a recipe and have no meaning in the other.
  void refuse_beside(const char* other, const std::vector<const char*>& keys) const {
    for (const char* key : keys)
      if (root_.contains(key))
        refuse(root_.get(key), key, std::string("means nothing beside ") + other,
               std::string("take ") + key + " out, or " + other);
  }

  void read_classes_of_cells() {
    read_periods();
    read_matrix();
    if (root_.contains("numbers")) read_numbers();
    const std::string side = root_.contains("split") ? word(root_, "split", "split") : "a";
    if (side != "a" && side != "b")
      refuse(root_.get("split"), "split", "is \"" + side + "\", expected a or b");
    if (root_.contains("split") && !recipe_.has_sides)
      refuse(root_.get("split"), "split", "chooses a side, and no cell of the matrix has two",
             "take split out, or write a cell as \"CLASS|CLASS\"");
    recipe_.side = side == "b";
    if (root_.contains("beyond")) read_beyond();
    if (root_.contains("mass")) read_mass();
    if (root_.contains("min_area_m2")) recipe_.min_area = above_zero("min_area_m2");
    if (root_.contains("width_m")) recipe_.width = above_zero("width_m");
  }

  // The rate of events at which one comes within `years` with the probability p is
  // -ln(1 - p) / years.
  void read_periods() {
    if (!root_.contains("probability")) {
      refuse_beside("return_period_a", {"in_years"});
      recipe_.return_periods = numbers(root_, "return_period_a", "return_period_a");
      if (recipe_.return_periods.back() < 1)
        refuse(root_.get("return_period_a"), "return_period_a",
               "has no period of a year or more: these look like probabilities",
               "write probability = [0.01, 0.001] with in_years = 1");
    } else {
      refuse_beside("probability", {"return_period_a"});
      const double years = number(needed(root_, "in_years", "in_years"), "in_years");
      if (!(years > 0)) refuse(root_.get("in_years"), "in_years", "is not above 0");
      const toml::node& node = *root_.get("probability");
      for (const toml::node& entry : list(node, "probability", 0)) {
        const double p = number(entry, "probability");
        if (!(p > 0 && p < 1))
          refuse(&entry, "probability", "is " + text(p) + ", expected above 0 and below 1",
                 "10 % is 0.1");
        recipe_.return_periods.push_back(-years / std::log1p(-p));
        if (recipe_.return_periods.size() > 1 &&
            !(recipe_.return_periods.back() > recipe_.return_periods.rbegin()[1]))
          refuse(&entry, "probability", "does not fall from the first one on",
                 "write what comes most often first");
      }
    }
    const std::vector<double>& periods = recipe_.return_periods;
    for (std::size_t t = 1; t < periods.size(); ++t)
      if (period_name(periods[t]) == period_name(periods[t - 1]))
        refuse(root_.get(root_.contains("probability") ? "probability" : "return_period_a"),
               "return_period_a", "has " + period_name(periods[t]) + " years twice");
  }

  void read_risk() {
    refuse_beside("risk", {"return_period_a", "probability", "in_years", "matrix", "numbers",
                           "split", "beyond", "mass", "width_m"});
    const toml::table& table = section(root_, "risk", "risk");
    check_keys(table, "risk.", {"limits_per_a", "classes"});
    if (recipe_.by == IntensityBy::translational_energy)
      refuse(root_["intensity"]["by"].node(), "intensity.by",
             "is translational_energy_kj, and hits of objects have their energy with spin alone",
             "write total_energy_kj or block_volume_m3, or leave [intensity] out");
    recipe_.risk_limits = numbers(table, "limits_per_a", "risk.limits_per_a");
    if (recipe_.risk_limits.back() >= 1)
      refuse(table.get("limits_per_a"), "risk.limits_per_a",
             "has " + text(recipe_.risk_limits.back()) + ", a probability of death is below 1",
             "one in 10,000 a year is 1e-4");
    const toml::node& names = needed(table, "classes", "risk.classes");
    for (const toml::node& entry : list(names, "risk.classes", recipe_.risk_limits.size() + 1)) {
      if (!entry.is_string()) refuse(&entry, "risk.classes", "is not a list of texts");
      const int own = class_named(&entry, entry.as_string()->get(), "risk.classes");
      if (own < 0)
        refuse(&entry, "risk.classes", "has \"none\", and each object has a class",
               "describe a class of the risk that is tolerated");
      if (!recipe_.risk_classes.empty() &&
          code_of(own) <= recipe_.classes[recipe_.risk_classes.back()].code)
        refuse(&entry, "risk.classes",
               "has \"" + name_of(own) + "\" behind \"" +
                   recipe_.classes[recipe_.risk_classes.back()].name +
                   "\", whose code is not lower",
               "classes go from the lowest risk to the highest");
      recipe_.risk_classes.push_back(static_cast<std::size_t>(own));
    }
  }

  void check_classes_are_used() const {
    std::set<int> used(recipe_.risk_classes.begin(), recipe_.risk_classes.end());
    used.insert(recipe_.beyond);
    for (const auto& row : recipe_.matrix)
      for (const MatrixCell& cell : row) used.insert(cell.of_side.begin(), cell.of_side.end());
    for (std::size_t i = 0; i < recipe_.classes.size(); ++i) {
      const RecipeClass& own = recipe_.classes[i];
      const std::string item = "class." + own.name;
      const toml::node* node = root_["class"][own.name].node();
      if (!used.contains(static_cast<int>(i)))
        refuse(node, item, "is given to nothing", "name it in the matrix, or take it out");
      for (std::size_t k = 0; k < i; ++k)
        if (recipe_.classes[k].rgb == own.rgb && recipe_.classes[k].is_hatched == own.is_hatched)
          refuse(node, item, "looks like class " + recipe_.classes[k].name + " on the map",
                 "give it another rgb, or hatched = true");
    }
  }

  // Every number of the recipe has a source.
  void read_sources() {
    static const std::vector<std::string> items = {"return_period_a", "probability", "matrix",
                                                   "intensity",       "risk",        "mass",
                                                   "min_area_m2",     "width_m",     "class"};
    const toml::node& node = needed(root_, "source", "source");
    if (!node.is_array() || !node.as_array()->is_array_of_tables())
      refuse(&node, "source", "is not a list of sections",
             "write [[source]] with of, document, page and mark");
    std::set<std::string> said;
    for (const toml::node& entry : *node.as_array()) {
      const toml::table& table = *entry.as_table();
      check_keys(table, "source.", {"of", "document", "page", "mark"});
      RecipeSource source;
      for (const toml::node& of : list(needed(table, "of", "source.of"), "source.of", 0)) {
        const std::string item = of.value_or(std::string());
        if (std::find(items.begin(), items.end(), item) == items.end() || !root_.contains(item))
          refuse(&of, "source.of",
                 "has \"" + item + "\", which is not part of this recipe that has numbers");
        if (!said.insert(item).second) refuse(&of, "source.of", "has \"" + item + "\" twice");
        source.of.push_back(item);
      }
      source.document = word(table, "document", "source.document");
      source.page = word(table, "page", "source.page");
      source.mark = word(table, "mark", "source.mark");
      if (source.mark.size() != 1 || std::string("vsmo").find(source.mark) == std::string::npos)
        refuse(table.get("mark"), "source.mark", "is \"" + source.mark + "\"",
               "v: read in the document, s: read in another that cites it, m: from memory, o: "
               "chosen by you");
      recipe_.sources.push_back(std::move(source));
    }
    for (const std::string& item : items)
      if (root_.contains(item) && !said.contains(item))
        refuse(root_.get(item), item, "has no source",
               "name it in `of` of a [[source]]; what you chose yourself has mark = \"o\"");
  }

  // Without these keys the classes are by reach alone.
  void read_intensity() {
    if (!root_.contains("intensity")) {
      recipe_.intensities = {"reached"};
      return;
    }
    const toml::table& table = section(root_, "intensity", "intensity");
    check_keys(table, "intensity.", {"by", "breaks", "names"});
    const std::string by = word(table, "by", "intensity.by");
    if (by == "total_energy_kj")
      recipe_.by = IntensityBy::total_energy;
    else if (by == "translational_energy_kj")
      recipe_.by = IntensityBy::translational_energy;
    else if (by == "block_volume_m3")
      recipe_.by = IntensityBy::block_volume;
    else
      refuse(table.get("by"), "intensity.by",
             "is \"" + by +
                 "\", expected total_energy_kj, translational_energy_kj or block_volume_m3");
    recipe_.breaks = numbers(table, "breaks", "intensity.breaks");
    check_unit(*table.get("breaks"));
    const toml::node& names = needed(table, "names", "intensity.names");
    for (const toml::node& entry : list(names, "intensity.names", recipe_.breaks.size() + 1)) {
      if (!entry.is_string() || entry.as_string()->get().empty())
        refuse(&entry, "intensity.names", "is not a list of texts");
      const std::string& name = entry.as_string()->get();
      if (std::find(recipe_.intensities.begin(), recipe_.intensities.end(), name) !=
          recipe_.intensities.end())
        refuse(&entry, "intensity.names", "has \"" + name + "\" twice");
      recipe_.intensities.push_back(name);
    }
  }

  // Nothing weak or small begins there: the numbers are of another unit.
  void check_unit(const toml::node& breaks) const {
    constexpr double most_kj = 10000, most_m3 = 1000;
    const double least = recipe_.breaks[0];
    if (recipe_.by == IntensityBy::block_volume ? least < most_m3 : least < most_kj) return;
    refuse(&breaks, "intensity.breaks",
           "begins at " + break_name(recipe_, least) + ", above all that is weak",
           recipe_.by == IntensityBy::block_volume ? "volumes are in m3: 1 dm3 is 0.001"
                                                   : "energies are in kJ: 30000 J are 30");
  }

  void read_classes() {
    const toml::table& table = section(root_, "class", "class");
    for (const auto& [key, node] : table) {
      const std::string name(key.str()), item = "class." + name;
      if (!node.is_table()) refuse(&node, item, "is not a section");
      const toml::table& of = *node.as_table();
      check_keys(of, item + ".", {"code", "rgb", "label", "hatched"});
      RecipeClass out;
      out.name = name;
      out.label = word(of, "label", item + ".label");
      const double code = number(needed(of, "code", item + ".code"), item + ".code");
      if (code != std::floor(code) || code < 1 || code >= no_class)
        refuse(of.get("code"), item + ".code", "is " + text(code) + ", expected 1 to 254");
      out.code = static_cast<int>(code);
      const toml::array& rgb = list(needed(of, "rgb", item + ".rgb"), item + ".rgb", 3);
      for (std::size_t k = 0; k < 3; ++k) {
        const double part = number(rgb[k], item + ".rgb");
        if (!(part >= 0 && part <= 255) || part != std::floor(part))
          refuse(&rgb, item + ".rgb", "has " + text(part) + ", expected whole numbers, 0 to 255");
        out.rgb[k] = static_cast<std::uint8_t>(part);
      }
      if (of.contains("hatched") && !of["hatched"].is_boolean())
        refuse(of.get("hatched"), item + ".hatched", "is neither true nor false");
      out.is_hatched = of["hatched"].value_or(false);
      for (const RecipeClass& other : recipe_.classes)
        if (other.code == out.code)
          refuse(&node, item, "has the code of class " + other.name, "give each class its own");
      recipe_.classes.push_back(out);
    }
    std::sort(recipe_.classes.begin(), recipe_.classes.end(),
              [](const auto& a, const auto& b) { return a.code < b.code; });
  }

  int class_named(const toml::node* node, const std::string& name, const std::string& item) const {
    if (name == "none") return -1;
    for (std::size_t i = 0; i < recipe_.classes.size(); ++i)
      if (recipe_.classes[i].name == name) return static_cast<int>(i);
    refuse(node, item, "names class \"" + name + "\", which no [class." + name + "] describes",
           "describe it, or write \"none\"");
  }

  [[nodiscard]] int code_of(int chosen) const {
    return chosen < 0 ? 0 : recipe_.classes[static_cast<std::size_t>(chosen)].code;
  }
  [[nodiscard]] std::string name_of(int chosen) const {
    return chosen < 0 ? "none" : recipe_.classes[static_cast<std::size_t>(chosen)].name;
  }

  // Of the last cell of a row that is being read: a stronger or more frequent cell must not have a
  // lower class, on either side of the split.
  void check_order(const toml::node& entry, const std::string& item,
                   const std::vector<MatrixCell>& cells) const {
    const std::size_t row = recipe_.matrix.size(), t = cells.size() - 1;
    for (const std::size_t side : {0U, 1U}) {
      const int own = cells[t].of_side[side];
      if (row > 0 && code_of(own) < code_of(recipe_.matrix[row - 1][t].of_side[side]))
        refuse(&entry, item,
               "gives \"" + name_of(own) + "\" to " + recipe_.intensities[row] + " in " +
                   text(recipe_.return_periods[t]) + " years, and the row before gives \"" +
                   name_of(recipe_.matrix[row - 1][t].of_side[side]) + "\" to " +
                   recipe_.intensities[row - 1],
               "rows go from the weakest intensity to the strongest, which has no lower class");
      if (t > 0 && code_of(own) > code_of(cells[t - 1].of_side[side]))
        refuse(&entry, item,
               "gives \"" + name_of(own) + "\" in " + text(recipe_.return_periods[t]) +
                   " years, and \"" + name_of(cells[t - 1].of_side[side]) + "\" in " +
                   text(recipe_.return_periods[t - 1]),
               "columns go from the shortest return period to the longest, which has no higher "
               "class");
    }
  }

  void read_beyond() {
    recipe_.beyond = class_named(root_.get("beyond"), word(root_, "beyond", "beyond"), "beyond");
    for (const int least : recipe_.matrix[0].back().of_side)
      if (code_of(recipe_.beyond) > code_of(least))
        refuse(root_.get("beyond"), "beyond",
               "is \"" + name_of(recipe_.beyond) + "\", and the matrix gives \"" + name_of(least) +
                   "\" to what comes more often",
               "give a class that is no higher than any of the matrix, or \"none\"");
  }

  void read_matrix() {
    const toml::node& matrix = needed(root_, "matrix", "matrix");
    for (const toml::node& row : list(matrix, "matrix", recipe_.intensities.size())) {
      std::vector<MatrixCell> cells;
      const std::string item = "matrix, row " + std::to_string(recipe_.matrix.size() + 1);
      for (const toml::node& entry : list(row, item, recipe_.return_periods.size())) {
        if (!entry.is_string() || entry.as_string()->get().empty())
          refuse(&entry, item, "has a cell without a class", "write \"none\" where there is none");
        const std::string words = entry.as_string()->get();
        const std::size_t bar = words.find('|');
        const std::string a = words.substr(0, bar),
                          b = bar == std::string::npos ? a : words.substr(bar + 1);
        recipe_.has_sides = recipe_.has_sides || a != b;
        cells.push_back({{class_named(&entry, a, item), class_named(&entry, b, item)}, 0});
        check_order(entry, item, cells);
      }
      recipe_.matrix.push_back(std::move(cells));
    }
  }

  void read_numbers() {
    const toml::array& rows = list(*root_.get("numbers"), "numbers", recipe_.matrix.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const toml::array& row = list(rows[i], "numbers", recipe_.return_periods.size());
      for (std::size_t t = 0; t < row.size(); ++t) {
        const double given = number(row[t], "numbers");
        if (given != std::floor(given) || given < 0 || given > 1e6)
          refuse(&row[t], "numbers", "has " + text(given) + ", expected a whole number from 0 on");
        recipe_.matrix[i][t].number = static_cast<int>(given);
      }
    }
  }

  void read_mass() {
    const toml::table& table = section(root_, "mass", "mass");
    check_keys(table, "mass.", {"volume_m3", "intensity", "alone_s"});
    recipe_.mass_volume = number(needed(table, "volume_m3", "mass.volume_m3"), "mass.volume_m3");
    if (!(recipe_.mass_volume > 0)) refuse(&table, "mass.volume_m3", "is not above 0");
    if (table.contains("alone_s")) recipe_.alone_s = number(*table.get("alone_s"), "mass.alone_s");
    if (!(recipe_.alone_s > 0)) refuse(table.get("alone_s"), "mass.alone_s", "is not above 0");
    const std::string name = word(table, "intensity", "mass.intensity");
    const auto at = std::find(recipe_.intensities.begin(), recipe_.intensities.end(), name);
    if (at == recipe_.intensities.end())
      refuse(table.get("intensity"), "mass.intensity",
             "is \"" + name + "\", which is none of intensity.names");
    recipe_.mass_intensity = static_cast<int>(at - recipe_.intensities.begin());
  }

  const toml::table& root_;
  std::string path_;
  Recipe recipe_;
};

}  // namespace

Recipe parse_recipe(const std::string& text, const std::string& path) {
  try {
    Recipe recipe = RecipeReader(toml::parse(text, path), path).read();
    Sha256 sum;
    sum.add(text.data(), text.size());
    recipe.sha256 = sum.hex();
    return recipe;
  } catch (const toml::parse_error& error) {
    throw InputError({path, static_cast<int>(error.source().begin.line)},
                     std::string(error.description()), "a recipe must be TOML");
  }
}

}  // namespace talus
