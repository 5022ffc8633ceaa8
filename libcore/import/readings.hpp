// libcore/import/readings.hpp
// An input that can be read in several ways is not guessed: it is refused with the effect of each
// reading on this very input, and with the key, option or command that decides.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/doubt.hpp"

namespace talus {

struct Reading {
  std::string name;       ///< "as feet"
  std::string magnitude;  ///< "the heights go from 304.8 to 396.2 m"
  std::string way;        ///< "--elevation-unit-m 0.3048"
};

/// "FINDING: as metres the heights go from 1000 to 1300 m; as feet ...", with the choices as hint.
[[nodiscard]] Doubt choice_of(const Where& where, const std::string& finding,
                              const std::vector<Reading>& readings);

/// "the heights go from 304.8 to 396.2 m, 91.4 m over 3.2 km"; `width`: 0 where it is not known
/// [m].
[[nodiscard]] std::string rise_words(double low, double high, double width);
/// For heights of a source, in metres and in the unit of a plan that does not apply to them;
/// `way_to_metres` chooses the first.
[[nodiscard]] Doubt choice_of_height_unit(const Where& where, double plan_unit_m, double low,
                                          double high, double width, const std::string& way_to_plan,
                                          const std::string& way_to_metres);

/// Units in which heights that are too large for metres are those of ground: feet, decimetres,
/// centimetres, millimetres; `way` chooses a unit of so many metres.
[[nodiscard]] std::vector<Reading> smaller_units(double low, double high, double width,
                                                 const std::function<std::string(double)>& way);

/// "3.2 km", "12 m", "0.8 mm"
[[nodiscard]] std::string length_words(double metres);

}  // namespace talus
