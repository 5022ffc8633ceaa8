// tools/report/pictures.hpp
// The pictures of the page: maps, charts, and the data of the 3-D view.
#pragma once

#include "tools/report/data.hpp"

namespace talus {

/// By the names of the template; HTML and SVG, or the address of an image.
[[nodiscard]] Json pictures_of(const ReportData& data);
/// The proposals of a search, on the map of reach; "": nowhere.
[[nodiscard]] std::string proposal_map(const ReportData& data, const Json& proposals);

/// Where an event left its boulders, scars and deposit, on the map of reach.
[[nodiscard]] std::string observed_map(const ReportData& data, const Json& event);
/// The run-outs of observed boulders, as points, and of the computed blocks, as a line.
[[nodiscard]] std::string observed_chart(const Texts& texts, const Json& boulders);

struct Bar {
  std::string name;
  double value = 0;
};
/// The address of a picture with a bar each, from a line at 0; "": there are none.
[[nodiscard]] std::string bar_picture(const std::vector<Bar>& bars, const std::string& title);

/// Data of the 3-D view, as JSON; "" for a run without frames.
[[nodiscard]] std::string scene_of(const ReportData& data);

}  // namespace talus
