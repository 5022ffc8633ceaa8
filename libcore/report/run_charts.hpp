// libcore/report/run_charts.hpp: public
// How runs went over time, as charts: speeds and paths, health, where the energy went.
#pragma once

#include <string>
#include <vector>

#include "base/csv.hpp"
#include "draw/chart.hpp"
#include "record/run_file.hpp"
#include "report/texts.hpp"

namespace talus {

/// A column of talus-runout's curves (curve_csv) against time: a line a run; of three runs
/// or more the median, and a band from the smallest to the largest.
[[nodiscard]] Chart curve_chart(const Texts& texts, const CsvTable& table,
                                const std::string& column, const std::string& title,
                                const std::string& unit);

/// A field of the health against time, a line a run, on a logarithmic axis.
[[nodiscard]] Chart health_chart(const Texts& texts, const std::vector<RunFile>& runs,
                                 const std::string& title, const std::string& unit,
                                 double HealthRow::*field);

/// Energy of a run by kind [MJ]: kinetic and spent energy add up to the input by the fall, the
/// start and the motion of the base.
[[nodiscard]] Chart energy_chart(const Texts& texts, const RunFile& run);

}  // namespace talus
