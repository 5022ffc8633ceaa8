// tools/frame/doubts.hpp
// Doubts of a tool: said, listed in its report, written as a layer to open in a GIS; the tool ends
// where one is refused and not accepted.
#pragma once

#include <string>
#include <vector>

#include "base/doubt.hpp"
#include "tools/frame/tool.hpp"

namespace talus {

struct DoubtOptions {
  std::string layer;    ///< file of the places; empty: none
  bool accept = false;  ///< inputs that would be refused are taken all the same
  std::string crs_wkt;  ///< of the places, once it is known
};

/// Declares --doubts, which is written at the end, also where the input is refused.
void declare_doubts_layer(Tool& tool, DoubtOptions& options);
/// The same, and --accept-doubts; `accept` says which inputs are then taken.
void declare_doubts(Tool& tool, DoubtOptions& options, const std::string& accept);

/// Tells the tool. Returns the places that were accepted, in words. Throws InputError where one is
/// refused and not accepted.
std::string judge(Tool& tool, const DoubtOptions& options, std::vector<Doubt> doubts);

}  // namespace talus
