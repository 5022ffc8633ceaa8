// Coordinate reference systems: names, parts and comparison of plans and heights.
#include "io/crs_gdal.hpp"

#include <cpl_conv.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>

#include "base/error.hpp"
#include "base/source_path.hpp"
#include "base/text.hpp"
#include "io/errors_gdal.hpp"

namespace talus {
namespace {

std::string copied(char* wkt) {
  std::string text(wkt ? wkt : "");
  CPLFree(wkt);
  return text;
}

std::string as_wkt(const OGRSpatialReference& srs) {
  char* wkt = nullptr;
  const char* const options[] = {"FORMAT=WKT2_2019", nullptr};
  srs.exportToWkt(&wkt, options);
  return copied(wkt);
}

// The system without heights: of a compound one its first half, of a spatial one the plane.
OGRSpatialReference plan_of(const std::string& wkt) {
  OGRSpatialReference srs = parsed_crs(wkt);
  if (srs.IsCompound()) srs.StripVertical();
  if (srs.GetAxesCount() == 3 && !srs.IsGeocentric()) srs.DemoteTo2D(nullptr);
  return srs;
}

bool is_same(const OGRSpatialReference& a, const OGRSpatialReference& b) {
  const char* const options[] = {"IGNORE_DATA_AXIS_TO_SRS_AXIS_MAPPING=YES",
                                 "CRITERION=EQUIVALENT_EXCEPT_AXIS_ORDER_GEOGCRS", nullptr};
  return a.IsSame(&b, options) != 0;
}

std::string authority(const OGRSpatialReference& srs) {
  const char* name = srs.GetAuthorityName(nullptr);
  const char* code = srs.GetAuthorityCode(nullptr);
  return name && code ? std::string(name) + ":" + code : std::string();
}

// Name in a GeoPackage for the reference of a layer that has none.
bool is_undefined(const OGRSpatialReference& srs) {
  const char* const name = srs.GetName();
  return name != nullptr && std::string_view(name).starts_with("Undefined ");
}

}  // namespace

OGRSpatialReference parsed_crs(const std::string& crs_wkt) {
  OGRSpatialReference srs;
  srs.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  if (srs.importFromWkt(crs_wkt.c_str()) != OGRERR_NONE)
    throw InputError({}, "the CRS cannot be understood: " + crs_wkt.substr(0, 80));
  return srs;
}

std::string wkt_of(const OGRSpatialReference* srs) {
  if (!srs || srs->IsEmpty() || is_undefined(*srs)) return {};
  if (srs->IsLocal() && std::abs(srs->GetLinearUnits() - 1) < 1e-9) return {};
  return as_wkt(*srs);
}

bool is_beyond_degrees(const std::string& crs_wkt, const std::vector<Vec3>& points) {
  if (crs_wkt.empty()) return false;
  const GdalErrors errors;
  const OGRSpatialReference srs = parsed_crs(crs_wkt);
  if (!srs.IsGeographic()) return false;
  const double turn = 2 * std::numbers::pi / srs.GetAngularUnits();
  return std::any_of(points.begin(), points.end(), [turn](const Vec3& p) {
    return std::abs(p.x()) > turn || std::abs(p.y()) > turn / 4 + 1e-9;
  });
}

std::string crs_from_user(const std::string& user_text, const std::string& option) {
  if (user_text == "none") return {};
  const GdalErrors errors;
  OGRSpatialReference srs;
  // A file of that name would be read without being an input.
  constexpr const char* limits[] = {"ALLOW_NETWORK_ACCESS=NO", "ALLOW_FILE_ACCESS=NO", nullptr};
  if (user_text.empty() || srs.SetFromUserInput(user_text.c_str(), limits) != OGRERR_NONE)
    throw InputError({"", 0, option}, "\"" + user_text + "\" is not a CRS",
                     "write EPSG:code, for example EPSG:31287, a PROJ string or WKT (of a file: "
                     "--crs \"$(cat FILE.prj)\")");
  return wkt_of(&srs);
}

std::string crs_name(const std::string& crs_wkt) {
  if (crs_wkt.empty()) return "no CRS";
  const GdalErrors errors;
  const OGRSpatialReference srs = parsed_crs(crs_wkt);
  const char* name = srs.GetName();
  const std::string code = authority(srs);
  // Names that GDAL and PROJ write for missing ones.
  const auto is_name = [](const char* word) {
    return word && word != std::string("unnamed") && word != std::string("unknown");
  };
  if (!is_name(name)) {
    if (!code.empty()) return code;
    const char* geographic = srs.GetAttrValue("GEOGCS");
    return "a CRS without a name" +
           (is_name(geographic) ? " (of " + std::string(geographic) + ")" : std::string());
  }
  return code.empty() ? std::string(name) : code + " (" + name + ")";
}

std::string crs_code(const std::string& crs_wkt) {
  if (crs_wkt.empty()) return "CRS";
  const GdalErrors errors;
  const OGRSpatialReference plan = plan_of(crs_wkt);
  std::string code = authority(plan);
  if (code.empty())
    if (OGRSpatialReference* const known = plan.FindBestMatch()) {
      code = authority(*known);
      known->Release();
    }
  return code.empty() ? shell_word(as_wkt(plan)) : code;
}

double length_unit_m(const std::string& crs_wkt) {
  if (crs_wkt.empty()) return 1;
  const GdalErrors errors;
  const OGRSpatialReference srs = plan_of(crs_wkt);
  if (srs.IsVertical() != 0) return srs.GetTargetLinearUnits("VERT_CS");
  return srs.IsProjected() || srs.IsLocal() ? srs.GetLinearUnits() : 1;
}

bool is_local(const std::string& crs_wkt) {
  const GdalErrors errors;
  return !crs_wkt.empty() && plan_of(crs_wkt).IsLocal() != 0;
}

bool same_crs(const std::string& a, const std::string& b) {
  if (a == b) return true;
  if (a.empty() || b.empty()) return false;
  const GdalErrors errors;
  const OGRSpatialReference first = plan_of(a), second = plan_of(b);
  if (is_same(first, second)) return true;
  const std::string code = authority(first);
  return !code.empty() && code == authority(second);
}

std::string horizontal_crs(const std::string& crs_wkt) {
  if (crs_wkt.empty()) return {};
  const GdalErrors errors;
  return as_wkt(plan_of(crs_wkt));
}

std::string height_crs(const std::string& crs_wkt) {
  if (crs_wkt.empty()) return {};
  const GdalErrors errors;
  const OGRSpatialReference srs = parsed_crs(crs_wkt);
  const OGR_SRSNode* const node = srs.IsCompound() ? srs.GetAttrNode("VERT_CS") : nullptr;
  if (node == nullptr) return {};
  char* wkt = nullptr;
  node->exportToWkt(&wkt);
  return as_wkt(parsed_crs(copied(wkt)));
}

std::optional<double> height_unit_m(const std::string& crs_wkt) {
  const std::string heights = height_crs(crs_wkt);
  const double unit_m = length_unit_m(heights.empty() ? crs_wkt : heights);
  if (std::isnan(unit_m) || std::abs(unit_m - 1) < 1e-9) return 1;
  return heights.empty() ? std::nullopt : std::make_optional(unit_m);
}

bool same_heights(const std::string& a, const std::string& b) {
  const std::string first = height_crs(a), second = height_crs(b);
  if (first.empty() || second.empty() || first == second) return true;
  const GdalErrors errors;
  return is_same(parsed_crs(first), parsed_crs(second));
}

std::string assumed_heights(const std::string& a, const std::string& b) {
  const std::string first = height_crs(a), second = height_crs(b);
  if (first.empty() == second.empty()) return {};
  return "taken to have heights in " + crs_name(first.empty() ? second : first);
}

std::string with_heights(const std::string& plan, const std::string& vertical, const Where& where) {
  const GdalErrors errors;
  const OGRSpatialReference horizontal = parsed_crs(plan), heights = parsed_crs(vertical);
  OGRSpatialReference both;
  const std::string name =
      std::string(horizontal.GetName()) + " + " + std::string(heights.GetName());
  if (both.SetCompoundCS(name.c_str(), &horizontal, &heights) != OGRERR_NONE)
    throw InputError(where, "cannot be in " + crs_name(plan) + " with " + crs_name(vertical));
  return as_wkt(both);
}

std::string with_heights_of(const std::string& other, const std::string& plan, const Where& where) {
  const std::string heights = height_crs(other), wanted = height_crs(plan);
  if (!wanted.empty() && (heights.empty() || !same_heights(other, plan)))
    throw InputError(where,
                     (heights.empty() ? "does not say what system its heights are in"
                                      : "its heights are in " + crs_name(heights)) +
                         ", and " + crs_name(plan) + " would have them in " + crs_name(wanted),
                     "--t-srs " + crs_code(plan) +
                         " reprojects in plan, heights stay; --t-vertical " + crs_code(wanted) +
                         " takes them there");
  return heights.empty() || !wanted.empty() ? plan : with_heights(plan, heights, where);
}

bool has_unknown_datum(const std::string& crs_wkt) {
  if (crs_wkt.empty()) return false;
  const GdalErrors errors;
  const OGRSpatialReference srs = plan_of(crs_wkt);
  std::array<double, 7> shift{};
  if (srs.GetTOWGS84(shift.data(), 7) == OGRERR_NONE) return false;
  const char* const name = srs.GetAttrValue("DATUM");
  const std::string datum = lower(name != nullptr ? name : "unknown");
  return datum.find("unknown") != std::string::npos ||
         datum.find("not specified") != std::string::npos ||
         datum.find("not_specified") != std::string::npos;
}

}  // namespace talus
