// libcore/io/layer_names.hpp
// Names of layers as people write them: several parted by commas, with * and ? for any letters.
#pragma once

#include <string>
#include <vector>

namespace talus {

/// "index, intermediate"; "none" for an empty list.
[[nodiscard]] std::string list_of(const std::vector<std::string>& names);

/// The words between the signs, without blanks around them; empty ones are left out.
[[nodiscard]] std::vector<std::string> parted(const std::string& list, char sign);

[[nodiscard]] bool is_pattern(const std::string& name);

/// Whether `name` is what the pattern says.
[[nodiscard]] bool matches(const std::string& pattern, const std::string& name);

/// Whether a filter names a field, in any case.
[[nodiscard]] bool names_field(const std::string& filter, const std::string& field);

/// The option or key of a layer, where the options of a source begin with `prefix`: "--spots-",
/// "source.polygon_".
[[nodiscard]] std::string layer_option(const std::string& prefix);
[[nodiscard]] bool is_on_command_line(const std::string& prefix);

/// How one of these layers is asked for, or several.
[[nodiscard]] std::string hint_to_choose(const std::string& prefix,
                                         const std::vector<std::string>& names);

}  // namespace talus
