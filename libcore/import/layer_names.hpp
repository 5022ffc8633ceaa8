// libcore/import/layer_names.hpp: public
// Names of layers as people write them: several parted by commas, with * and ? for any letters.
#pragma once

#include <string>
#include <vector>

namespace talus {

/// The words between the signs, without blanks around them; empty ones are left out.
[[nodiscard]] std::vector<std::string> parted(const std::string& list, char sign);

[[nodiscard]] bool is_pattern(const std::string& name);

/// Whether `name` matches the pattern.
[[nodiscard]] bool matches(const std::string& pattern, const std::string& name);

/// Whether a filter names a field, in any case.
[[nodiscard]] bool names_field(const std::string& filter, const std::string& field);

/// How one of these layers is asked for, several, or all.
[[nodiscard]] std::string hint_to_choose(const std::vector<std::string>& names);

}  // namespace talus
