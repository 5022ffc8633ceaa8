// libcore/base/words.hpp: public
// Quantities and lists in sentences.
#pragma once

#include <functional>
#include <string>

#include "base/text.hpp"

namespace talus {

/// A share, 0 to 1, in percent: three significant digits ("12.3 %", "0.0123 %", "100 %").
[[nodiscard]] inline std::string percent(double share) { return text(100 * share, 3) + " %"; }

/// "index, intermediate"; "none" for an empty list. `word_of` gives the word of an entry.
template <class List, class WordOf = std::identity>
[[nodiscard]] std::string list_of(const List& entries, const WordOf& word_of = {}) {
  std::string words;
  for (const auto& entry : entries)
    words += (words.empty() ? "" : ", ") + std::string(std::invoke(word_of, entry));
  return words.empty() ? "none" : words;
}

}  // namespace talus
