// libcore/post/hazard/recipe.hpp: public
// How an authority makes hazard classes: numbers that change from place to place, so they are data.
// in:    a file as those of share/hazard (TOML)
// out:   intensities, return periods and the matrix of classes, or limits of risk; the rule for
//        masses, colours; where each number is from
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/error.hpp"

namespace talus {

struct RecipeClass {
  std::string name, label;
  int code = 0;  ///< 1 to 254, a higher one is worse
  std::array<std::uint8_t, 3> rgb{};
  bool is_hatched = false;
};

/// A cell of the matrix: the class chosen by the split, and the class of the other side.
struct MatrixCell {
  std::array<int, 2> of_side{-1, -1};  ///< index into Recipe::classes, sides a and b; -1: no class
  int number = 0;                      ///< that the authority gives to the cell; 0: none
};

/// reach: any block that comes is as bad as another.
enum class IntensityBy { reach, total_energy, translational_energy, block_volume };

/// Sources of a recipe's numbers, and how sure they are.
struct RecipeSource {
  std::vector<std::string> of;  ///< keys and sections of the recipe
  std::string document, page;
  std::string
      mark;  ///< v read there, s read in what cites it, m from memory, o chosen by the writer
};

struct Recipe {
  std::string name, edition;
  std::vector<RecipeSource> sources;  ///< of all that has numbers
  std::string sha256;                 ///< of the file's text
  IntensityBy by = IntensityBy::reach;
  std::vector<double> breaks;            ///< ascending [kJ or m3]; none by reach
  std::vector<std::string> intensities;  ///< from the weakest                  (n_breaks + 1)
  std::vector<double> return_periods;    ///< ascending; none of a recipe of risk [a] (n_periods)
  std::vector<std::vector<MatrixCell>> matrix;  ///< by intensity, then period
  int side = 0;                                 ///< of cells with two classes: 0 a, 1 b
  bool has_sides = false;                       ///< whether there are such cells
  int beyond = -1;         ///< class of cells reached more rarely than all periods; -1: none
  double mass_volume = 0;  ///< released volume above which blocks are a mass; 0: no rule [m3]
  double alone_s = 3;      ///< a block is alone with no other in the cell within so long [s]
  int mass_intensity = 0;  ///< that a cell reached by a mass has at least, from 0
  double min_area = 0;     ///< of a polygon that is filed; 0: none [m2]
  double width = 0;        ///< of what rocks one by one may hit, across their path; 0: a cell [m]
  /// Of a recipe of risk: annual risk of the person most at risk, ascending [1/a].
  std::vector<double> risk_limits;
  /// Indices into `classes`: below the first limit, from each on                   (n_limits + 1)
  std::vector<std::size_t> risk_classes;
  std::vector<RecipeClass> classes;  ///< by code
};
/// Whether classes are of the risk at objects (post/hazard/risk.hpp), not of cells.
[[nodiscard]] inline bool is_of_risk(const Recipe& recipe) { return !recipe.risk_classes.empty(); }

/// Reads a recipe. Throws InputError with the line where a part is missing, does not fit together,
/// or is unknown: holes of the matrix, one whose classes fall with the intensity or rise with the
/// return period, classes that are not described, not used or look alike, breaks that do not
/// ascend or are in other units, numbers without a source.
[[nodiscard]] Recipe parse_recipe(const std::string& text, const std::string& path);

/// "v; class o": the mark of the first source, and the parts with another one.
[[nodiscard]] std::string mark_words(const Recipe& recipe);
/// "matrix: Ordinance 7, page 3 (v); class: ours (o)".
[[nodiscard]] std::string source_words(const Recipe& recipe);

/// "300", to a year from ten years on: as in the names of bands.
[[nodiscard]] std::string period_name(double years);
/// "300kJ", "0.25m3": as in the names of bands.
[[nodiscard]] std::string break_name(const Recipe& recipe, double value);
/// "weak, up to 30 kJ", "reached", of intensity i.
[[nodiscard]] std::string intensity_words(const Recipe& recipe, std::size_t i);

inline constexpr int no_class = 255;  ///< in rasters
/// A rate that lacks so little of 1 / period has that period: weights are single precision [-].
inline constexpr double rate_rounding = 1e-6;

struct ClassChoice {
  int code = no_class;
  int number = 0;  ///< of the matrix cell that decides; 0: none
};
/// The intensity that is reached at least once in `period`: 0 none, else from 1. `rates`: of
/// reaching the cell, then of each break [1/a], from the weakest              (n_breaks + 1)
[[nodiscard]] int intensity_at(const Recipe& recipe, std::span<const double> rates, double period);
/// The worst class of all return periods; the one beyond them where none is reached and the cell
/// is; none where it is not.
[[nodiscard]] ClassChoice class_of(const Recipe& recipe, std::span<const double> rates);

}  // namespace talus
