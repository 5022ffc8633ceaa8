// libcore/base/doubt.hpp: public
// A finding about an input that the user should check: where, what was found, what was expected,
// and a remedy. A finding that ends the work (InputError) is the same data.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "base/types.hpp"

namespace talus {

/// Place of a finding: a file, and the item in it (line, layer, feature, coordinates).
struct Where {
  std::string file{};  ///< path as the user gave it; empty without a file
  int line = 0;        ///< 1-based line of a text file; 0 when it has none
  std::string item{};  ///< e.g. "layer contours, feature 17"; empty when the file says enough
  /// "sites/a/site.toml:14", "map.gpkg: layer contours, feature 17"; empty when nothing is known
  [[nodiscard]] std::string text() const;
};

/// How bad a doubt is.
enum class DoubtState { in_doubt, mended, accepted, refused };
[[nodiscard]] const char* text(DoubtState state);

struct Doubt {
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();
  Where where{};
  std::string what{};      ///< its kind, "spot height", or the key of a site file that changes it
  std::string found{};     ///< a sentence, without place; empty: the height at the place says it
  std::string expected{};  ///< "1040 to 1060 m"
  std::string hint{};      ///< remedy
  DoubtState state = DoubtState::in_doubt;
  std::int64_t n = 1;              ///< number of findings of this kind that it represents
  std::int64_t feature = -1;       ///< of its source
  std::vector<Vec3> at{};          ///< on the map [m]: a point, two corners, or nowhere; z: NaN too
  double value = none;             ///< `found` as a number
  double low = none, high = none;  ///< the same of `expected`
};

/// One that names no place on the map.
[[nodiscard]] Doubt doubt_on(const Where& where, std::string found, std::string hint = {});

/// "spot height at 0 m, feature 5, x 650000, y 5200100"; empty: of no kind and at no place.
[[nodiscard]] std::string subject_of(const Doubt& doubt);

/// "map.gpkg: contour at 0 m, x 650000, y 5200100: off those beside it; expected 1040 to 1060 m"
[[nodiscard]] std::string sentence_on(const Doubt& doubt);

/// Those of one kind and state.
struct DoubtGroup {
  const Doubt* first;
  std::int64_t n;
};

/// In the order of their first doubts. A doubt without a kind is a group of its own.
[[nodiscard]] std::vector<DoubtGroup> groups_of(const std::vector<Doubt>& doubts);
/// "map.gpkg: 3 spot heights, the first at 0 m, x 650000, y 5200100: ..."
[[nodiscard]] std::string sentence_on(const DoubtGroup& group);

/// Marks as accepted the doubts that would refuse the input.
void accept(std::vector<Doubt>& doubts);
/// Subjects of up to 20 that were accepted, and how many more there are. Empty: none.
[[nodiscard]] std::string accepted_places(const std::vector<Doubt>& doubts);

/// All doubts that end the work as one: a sentence a group, the hint of the first. None: in doubt.
[[nodiscard]] Doubt refusal_of(const std::vector<Doubt>& doubts);

}  // namespace talus
