// Reads the unit of a drawing from its DXF header.
#include "import/drawing_unit_gdal.hpp"

#include <cpl_conv.h>
#include <cpl_vsi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "base/length_units.hpp"
#include "base/text.hpp"
#include "import/readings.hpp"

namespace talus {
namespace {

constexpr int inches = 1;

struct CloseFile {
  void operator()(VSILFILE* file) const { VSIFCloseL(file); }
};

// Codes of $INSUNITS; those left out are not lengths that maps are drawn in.
struct UnitCode {
  int code;
  double metres;
  const char* name;
};
constexpr UnitCode unit_codes[] = {{inches, 0.0254, "inches"},
                                   {2, foot_m, "feet"},
                                   {3, 1609.344, "miles"},
                                   {4, 0.001, "millimetres"},
                                   {5, 0.01, "centimetres"},
                                   {6, 1, "metres"},
                                   {7, 1000, "kilometres"},
                                   {10, 0.9144, "yards"},
                                   {14, 0.1, "decimetres"},
                                   {15, 10, "decametres"},
                                   {16, 100, "hectometres"},
                                   {21, us_foot_m, "US survey feet"},
                                   {22, us_foot_m / 12, "US survey inches"},
                                   {23, us_foot_m * 3, "US survey yards"},
                                   {24, us_foot_m * 5280, "US survey miles"}};

DrawingUnit unit_of_code(int code) {
  for (const UnitCode& unit : unit_codes)
    if (unit.code == code) return {code, unit.metres, unit.name};
  return {code, 0, "units of no known length"};
}

std::string trimmed(const char* line) {
  const std::string words(line != nullptr ? line : "");
  const std::size_t begin = words.find_first_not_of(" \t\r");
  if (begin == std::string::npos) return {};
  return words.substr(begin, words.find_last_not_of(" \t\r") + 1 - begin);
}

}  // namespace

DrawingUnit drawing_unit(const std::string& path) {
  const std::string name = lower(path);
  if (!name.ends_with(".dxf") && !name.ends_with(".dxf.gz")) return {};
  const std::unique_ptr<VSILFILE, CloseFile> file(VSIFOpenL(path.c_str(), "rb"));
  if (!file) return {};
  constexpr int most_lines = 20000;  // headers have a few thousand
  bool is_next = false;
  for (int i = 0; i < most_lines; ++i) {
    const char* const line = CPLReadLine2L(file.get(), 1000, nullptr);
    if (line == nullptr) return {};
    const std::string code = trimmed(line);
    const std::string value = trimmed(CPLReadLine2L(file.get(), 100000, nullptr));
    if (code == "0" && value == "ENDSEC") return {};
    if (is_next && code == "70") {
      double number = 0;
      return parse_double(value, number) ? unit_of_code(static_cast<int>(number)) : DrawingUnit{};
    }
    is_next = code == "9" && value == "$INSUNITS";
  }
  return {};
}

std::string doubt_on_unit(const std::string& path, double user_unit_m) {
  if (user_unit_m > 0 || drawing_unit(path).code != inches) return {};
  return "the header says inches ($INSUNITS 1), which GDAL and QGIS write whatever the unit is; "
         "taken as metres";
}

double scale_of_drawing(const std::string& path, double user_unit_m, double plan_unit_m,
                        const Where& where, const MapWindow& extent, const DrawingWays& ways) {
  if (user_unit_m > 0) return user_unit_m;
  const DrawingUnit unit = drawing_unit(path);
  if (unit.code == 0 || unit.code == inches || std::abs(unit.metres - 1) < 1e-9) return 1;
  if (unit.metres > 0 && std::abs(unit.metres / plan_unit_m - 1) < 1e-5) return 1;
  const double width = std::max(extent.x_max - extent.x_min, extent.y_max - extent.y_min);
  const auto size = [&](double metres) {
    if (width > 0) return "it is " + length_words(width * metres) + " wide";
    return "it lies at x " + text(extent.x_min * metres, 10) + ", y " +
           text(extent.y_min * metres, 10);
  };
  throw InputError(
      choice_of(where,
                "the drawing is in " + unit.name + " ($INSUNITS " + std::to_string(unit.code) +
                    " in its header), expected metres",
                {{"as " + unit.name, unit.metres > 0 ? size(unit.metres) : "its size is not known",
                  ways.as_said},
                 {"as metres", size(1), ways.as_metres}}));
}

}  // namespace talus
