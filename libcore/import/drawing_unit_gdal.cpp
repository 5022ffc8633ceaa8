#include "import/drawing_unit_gdal.hpp"

#include <cpl_conv.h>
#include <cpl_vsi.h>

#include <cmath>
#include <memory>

#include "base/text.hpp"

namespace talus {
namespace {

constexpr int inches = 1;

struct CloseFile {
  void operator()(VSILFILE* file) const { VSIFCloseL(file); }
};

// Codes of $INSUNITS; those left out are no lengths that maps are drawn in.
DrawingUnit unit_of_code(int code) {
  constexpr double us_foot = 1200.0 / 3937;
  switch (code) {
    case inches:
      return {code, 0.0254, "inches"};
    case 2:
      return {code, 0.3048, "feet"};
    case 3:
      return {code, 1609.344, "miles"};
    case 4:
      return {code, 0.001, "millimetres"};
    case 5:
      return {code, 0.01, "centimetres"};
    case 6:
      return {code, 1, "metres"};
    case 7:
      return {code, 1000, "kilometres"};
    case 10:
      return {code, 0.9144, "yards"};
    case 14:
      return {code, 0.1, "decimetres"};
    case 15:
      return {code, 10, "decametres"};
    case 16:
      return {code, 100, "hectometres"};
    case 21:
      return {code, us_foot, "US survey feet"};
    case 22:
      return {code, us_foot / 12, "US survey inches"};
    case 23:
      return {code, us_foot * 3, "US survey yards"};
    case 24:
      return {code, us_foot * 5280, "US survey miles"};
    default:
      return {code, 0, "units of no known length"};
  }
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
                        const Where& where, const std::string& way_out) {
  if (user_unit_m > 0) return user_unit_m;
  const DrawingUnit unit = drawing_unit(path);
  if (unit.code == 0 || unit.code == inches || std::abs(unit.metres - 1) < 1e-9) return 1;
  if (unit.metres > 0 && std::abs(unit.metres / plan_unit_m - 1) < 1e-5) return 1;
  throw InputError(where,
                   "the drawing is in " + unit.name + " ($INSUNITS " + std::to_string(unit.code) +
                       " in its header), expected metres",
                   way_out);
}

}  // namespace talus
