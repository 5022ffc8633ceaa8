// libcore/site/number_key.hpp
// Keys of the site file by their names, as numbers that a draw may read and set. Within the module.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "site/site_keys.hpp"

namespace talus {

/// A key of the site.
struct NumberKey {
  enum Kind { number, whole_number, other } kind = other;
  double value = not_given;
  KeyRange range;
};
/// "ground.scree.friction_deg"; none for an unknown section or key.
[[nodiscard]] std::optional<NumberKey> number_key(const Site& site, const std::string& path);

/// Sets a number; whole numbers are rounded. The key must be there, and hold one.
void set_number(Site& site, const std::string& path, double value, const ValueSource& source);

/// All keys of the sections of this site that hold numbers, for messages.
[[nodiscard]] std::vector<std::string> number_keys(const Site& site);

}  // namespace talus
