// Finds and applies the coordinate operation between two systems, in plan and in height.
#include "import/crs_operation_gdal.hpp"

#include <ogr_spatialref.h>
#include <proj.h>

#include <algorithm>
#include <cmath>

#include "base/text.hpp"
#include "import/crs_place_gdal.hpp"
#include "io/crs_gdal.hpp"
#include "io/errors_gdal.hpp"

namespace talus {
namespace {

// --- PROJ's objects ------------------------------------------------------------------------------

struct Free {
  void operator()(PJ_CONTEXT* context) const { proj_context_destroy(context); }
  void operator()(PJ* object) const { proj_destroy(object); }
  void operator()(PJ_OBJ_LIST* list) const { proj_list_destroy(list); }
  void operator()(PJ_OPERATION_FACTORY_CONTEXT* factory) const {
    proj_operation_factory_context_destroy(factory);
  }
};
template <class T>
using Owned = std::unique_ptr<T, Free>;

Owned<PJ_CONTEXT> quiet_context() {
  Owned<PJ_CONTEXT> context(proj_context_create());
  proj_log_level(context.get(), PJ_LOG_NONE);
  return context;
}

Owned<PJ_OPERATION_FACTORY_CONTEXT> factory_for(PJ_CONTEXT* context, const DegreeWindow& area) {
  Owned<PJ_OPERATION_FACTORY_CONTEXT> factory(
      proj_create_operation_factory_context(context, nullptr));
  // missing grids must not change the order: they are looked at afterwards
  proj_operation_factory_context_set_grid_availability_use(context, factory.get(),
                                                           PROJ_GRID_AVAILABILITY_IGNORED);
  proj_operation_factory_context_set_spatial_criterion(context, factory.get(),
                                                       PROJ_SPATIAL_CRITERION_PARTIAL_INTERSECTION);
  if (area.known)
    proj_operation_factory_context_set_area_of_interest(context, factory.get(), area.west,
                                                        area.south, area.east, area.north);
  return factory;
}

// PROJ's data of one operation.
struct Candidate {
  std::string text, name, missing_grid;
  double accuracy_m = NAN;
  bool is_ballpark = false;

  [[nodiscard]] bool is_here() const { return missing_grid.empty() && !text.empty(); }
};

std::string missing_grid_of(PJ_CONTEXT* context, const PJ* operation) {
  if (proj_coordoperation_is_instantiable(context, operation) != 0) return {};
  for (int i = 0; i < proj_coordoperation_get_grid_used_count(context, operation); ++i) {
    const char* name = nullptr;
    int is_available = 0;
    if (proj_coordoperation_get_grid_used(context, operation, i, &name, nullptr, nullptr, nullptr,
                                          nullptr, nullptr, &is_available) != 0 &&
        is_available == 0 && name != nullptr)
      return name;
  }
  return "of its own";
}

Candidate candidate_of(PJ_CONTEXT* context, const PJ* operation) {
  Candidate found;
  const char* const name = proj_get_name(operation);
  found.name = name != nullptr ? name : "an operation without a name";
  found.is_ballpark = proj_coordoperation_has_ballpark_transformation(context, operation) != 0 ||
                      lower(found.name).find("ballpark") != std::string::npos;
  found.missing_grid = missing_grid_of(context, operation);
  const double accuracy = proj_coordoperation_get_accuracy(context, operation);
  if (accuracy >= 0) found.accuracy_m = accuracy;
  const char* words = proj_as_proj_string(context, operation, PJ_PROJ_5, nullptr);
  if (words == nullptr) words = proj_as_wkt(context, operation, PJ_WKT2_2019, nullptr);
  if (words != nullptr) found.text = words;
  return found;
}

// All operations between two systems, the best first whether its grids are there or not.
std::vector<Candidate> candidates(const std::string& from, const std::string& to,
                                  const DegreeWindow& area) {
  const Owned<PJ_CONTEXT> context = quiet_context();
  const Owned<PJ> source(proj_create(context.get(), from.c_str()));
  const Owned<PJ> target(proj_create(context.get(), to.c_str()));
  if (!source || !target) return {};
  const auto factory = factory_for(context.get(), area);
  const Owned<PJ_OBJ_LIST> list(
      proj_create_operations(context.get(), source.get(), target.get(), factory.get()));
  std::vector<Candidate> found;
  for (int i = 0; list && i < proj_list_get_count(list.get()); ++i) {
    const Owned<PJ> operation(proj_list_get(context.get(), list.get(), i));
    if (operation) found.push_back(candidate_of(context.get(), operation.get()));
  }
  return found;
}

std::string accuracy_text(double accuracy_m) {
  return std::isnan(accuracy_m) ? "of unknown accuracy"
         : accuracy_m == 0      ? "exact"
                                : "good to " + text(accuracy_m, 3) + " m";
}

std::string way_to_grid(const std::string& grid) { return "fetch it with projsync --file " + grid; }

// --- transformations of GDAL that follow one operation -------------------------------------------

using Transformation = std::unique_ptr<OGRCoordinateTransformation>;

Transformation transformation_by(const std::string& from, const std::string& to,
                                 const std::string& operation) {
  const OGRSpatialReference source = parsed_crs(from), target = parsed_crs(to);
  OGRCoordinateTransformationOptions options;
  options.SetCoordinateOperation(operation.c_str(), false);
  return Transformation(OGRCreateCoordinateTransformation(&source, &target, options));
}

InputError no_operation(const std::string& from, const std::string& to, const Candidate* known,
                        const Where& where) {
  if (known != nullptr)
    return InputError(where,
                      "taking it from " + crs_name(from) + " to " + crs_name(to) +
                          " needs the grid " + known->missing_grid + " (\"" + known->name + "\", " +
                          accuracy_text(known->accuracy_m) +
                          "), which is not installed; without it the place may be off by a "
                          "hundred metres",
                      way_to_grid(known->missing_grid) +
                          "; --accept-ballpark goes on without a shift of the datum");
  return InputError(where,
                    "PROJ knows no shift of the datum from " + crs_name(from) + " to " +
                        crs_name(to) + "; without it the place may be off by a hundred metres",
                    "name the CRS that is meant with --crs EPSG:code; --accept-ballpark goes on "
                    "without a shift of the datum");
}

}  // namespace

CrsOperation find_operation(const std::string& from, const std::string& to, const MapWindow& window,
                            const Where& where, bool accept_ballpark) {
  const GdalErrors errors;
  CrsOperation operation;
  operation.from = horizontal_crs(from);
  operation.to = horizontal_crs(to);
  const std::vector<Candidate> all =
      candidates(operation.from, operation.to, degrees_of(operation.from, window));
  const auto known =
      std::find_if(all.begin(), all.end(), [](const Candidate& c) { return !c.is_ballpark; });
  auto chosen = std::find_if(all.begin(), all.end(),
                             [](const Candidate& c) { return !c.is_ballpark && c.is_here(); });
  if (chosen == all.end()) {
    if (!accept_ballpark)
      throw no_operation(from, to, known == all.end() ? nullptr : &*known, where);
    chosen = std::find_if(all.begin(), all.end(), [](const Candidate& c) { return c.is_here(); });
    if (chosen == all.end())
      throw InputError(where, "PROJ cannot take it from " + crs_name(from) + " to " + crs_name(to));
  }
  operation.text = chosen->text;
  operation.name = chosen->name;
  operation.accuracy_m = chosen->accuracy_m;
  operation.is_ballpark = chosen->is_ballpark;
  if (known != chosen && known != all.end()) {
    operation.better_grid = known->missing_grid;
    operation.better_accuracy_m = known->accuracy_m;
  }
  return operation;
}

bool carry_out(const CrsOperation& operation, std::vector<Vec3>& points) {
  const GdalErrors errors;
  const Transformation transformation =
      transformation_by(operation.from, operation.to, operation.text);
  if (!transformation) return false;
  for (Vec3& point : points)
    if (!transformation->Transform(1, &point.x(), &point.y())) return false;
  return true;
}

std::string sentence_on(const CrsOperation& operation) {
  return "reprojected from " + crs_name(operation.from) + " to " + crs_name(operation.to) +
         " by \"" + operation.name + "\", " +
         (operation.is_ballpark ? "without a shift of the datum"
                                : accuracy_text(operation.accuracy_m));
}

std::string doubt_on(const CrsOperation& operation) {
  if (operation.is_ballpark)
    return "the datums of " + crs_name(operation.from) + " and " + crs_name(operation.to) +
           " are taken for the same one (--accept-ballpark): the place may be off by a hundred "
           "metres";
  if (operation.better_grid.empty()) return {};
  return "a better operation, " + accuracy_text(operation.better_accuracy_m) + ", needs the grid " +
         operation.better_grid + ", which is not installed; " + way_to_grid(operation.better_grid);
}

// --- heights -------------------------------------------------------------------------------------

namespace {

// A compound system, or the plan with heights above its ellipsoid.
std::string in_space(const std::string& plan, const std::string& vertical, const Where& where) {
  if (vertical != ellipsoidal_heights) return with_heights(plan, vertical, where);
  OGRSpatialReference srs = parsed_crs(plan);
  srs.PromoteTo3D(nullptr);
  return wkt_of(&srs);
}

// The best operation that PROJ knows between two systems with heights; null when it knows none.
// Throws InputError when the grid of the best is missing.
std::unique_ptr<Candidate> best_in_space(const std::string& from, const std::string& to,
                                         const DegreeWindow& area, const std::string& what,
                                         const Where& where) {
  for (const Candidate& candidate : candidates(from, to, area)) {
    if (candidate.is_ballpark) continue;
    if (candidate.is_here()) return std::make_unique<Candidate>(candidate);
    throw InputError(where,
                     what + " needs the grid " + candidate.missing_grid + " (\"" + candidate.name +
                         "\", " + accuracy_text(candidate.accuracy_m) + "), which is not installed",
                     way_to_grid(candidate.missing_grid) +
                         "; heights are the same on every machine, so no other is taken");
  }
  return nullptr;
}

}  // namespace

void HeightOperation::add(const std::string& from, const std::string& to, const std::string& name,
                          const std::string& operation) {
  steps_.push_back(transformation_by(from, to, operation));
  if (!steps_.back()) throw InputError(where_, "PROJ cannot carry out \"" + name + "\"");
}

HeightOperation::HeightOperation(const std::string& plan_wkt, const std::string& from,
                                 const std::string& to, const MapWindow& window, Where where)
    : where_(std::move(where)) {
  const GdalErrors errors;
  const std::string plan = horizontal_crs(plan_wkt);
  const DegreeWindow area = degrees_of(plan, window);
  const std::string source = in_space(plan, from, where_), target = in_space(plan, to, where_);
  const std::string what = "taking heights from " + heights_name(from) + " to " + heights_name(to);
  sentence_ = "heights taken from " + heights_name(from) + " to " + heights_name(to);
  if (const auto direct = best_in_space(source, target, area, what, where_)) {
    add(source, target, direct->name, direct->text);
    sentence_ += " by \"" + direct->name + "\", " + accuracy_text(direct->accuracy_m);
    return;
  }
  const std::string ellipsoid = in_space(plan, ellipsoidal_heights, where_);
  const auto first = best_in_space(source, ellipsoid, area, what, where_);
  const auto second = best_in_space(ellipsoid, target, area, what, where_);
  if (!first || !second)
    throw InputError(where_, what + ": PROJ knows no operation for that here",
                     "bring the heights to " + heights_name(to) +
                         " with the software of the agency that publishes its model");
  add(source, ellipsoid, first->name, first->text);
  add(ellipsoid, target, second->name, second->text);
  sentence_ += " by \"" + first->name + "\" and \"" + second->name + "\"";
}

void HeightOperation::apply(std::size_t n, const double* x, const double* y, double* z) const {
  const GdalErrors errors;
  for (std::size_t i = 0; i < n; ++i) {
    if (std::isnan(z[i])) continue;
    double east = x[i], north = y[i], height = z[i];
    for (const auto& step : steps_)
      if (!step->Transform(1, &east, &north, &height)) height = HUGE_VAL;
    if (!std::isfinite(height))
      throw InputError(where_,
                       "the height at x " + text(x[i], 10) + ", y " + text(y[i], 10) +
                           " cannot be taken to the other system: its grid does not reach there",
                       "cut the map there first");
    z[i] = height;
  }
}

void HeightOperation::apply(std::vector<Vec3>& points) const {
  for (Vec3& p : points) apply(1, &p.x(), &p.y(), &p.z());
}

std::string vertical_crs_from_user(const std::string& user_text, const std::string& option) {
  if (user_text == ellipsoidal_heights) return user_text;
  const std::string wkt = user_text == "none" ? std::string() : crs_from_user(user_text, option);
  const GdalErrors errors;
  if (wkt.empty() || !parsed_crs(wkt).IsVertical() || parsed_crs(wkt).IsCompound())
    throw InputError({"", 0, option}, "\"" + user_text + "\" is not a system of heights",
                     "write the code of a vertical CRS, for example EPSG:5773 (EGM96), or " +
                         std::string(ellipsoidal_heights));
  const double unit_m = parsed_crs(wkt).GetTargetLinearUnits("VERT_CS");
  if (std::abs(unit_m - 1) > 1e-9)
    throw InputError({"", 0, option},
                     crs_name(wkt) + " is in units of " + text(unit_m, 10) + " m, expected metres",
                     "bring the heights to metres and name the system in metres");
  return wkt;
}

std::string target_heights_from_user(const std::string& user_text, const std::string& option) {
  if (user_text == ellipsoidal_heights)
    throw InputError({"", 0, option}, "heights above the ellipsoid are not a system to compute in",
                     "write the code of a vertical CRS, for example EPSG:5773 (EGM96)");
  return vertical_crs_from_user(user_text, option);
}

std::string heights_name(const std::string& vertical_wkt) {
  return vertical_wkt == ellipsoidal_heights ? "heights above the ellipsoid"
                                             : crs_name(vertical_wkt);
}

namespace {

// For a system that names no system of heights, but has a third axis above the ellipsoid.
bool is_ellipsoidal(const std::string& crs) {
  if (crs.empty()) return false;
  const GdalErrors errors;
  const OGRSpatialReference srs = parsed_crs(crs);
  return !srs.IsCompound() && srs.GetAxesCount() == 3 && srs.IsGeocentric() == 0;
}

}  // namespace

std::string with_stated_heights(const std::string& crs, const std::string& vertical,
                                const Where& where) {
  if (crs.empty())
    throw InputError(where, "has no CRS, so its heights are in no system",
                     "name it with --crs EPSG:code, or leave --vertical-crs away");
  const std::string own = is_ellipsoidal(crs) ? ellipsoidal_heights : height_crs(crs);
  if (!own.empty() && !same_system(own, vertical))
    throw InputError(
        where, "its heights are in " + heights_name(own) + ", not in " + heights_name(vertical),
        "leave --vertical-crs away; --t-vertical takes heights to another system");
  if (!own.empty() || vertical == ellipsoidal_heights) return crs;
  return with_heights(horizontal_crs(crs), vertical, where);
}

std::string stated_heights(const std::string& crs, const Where& where) {
  if (is_ellipsoidal(crs)) return ellipsoidal_heights;
  const std::string own = height_crs(crs);
  if (own.empty())
    throw InputError(where, "does not say what system its heights are in",
                     "say it with --vertical-crs EPSG:code, or --vertical-crs " +
                         std::string(ellipsoidal_heights));
  return own;
}

bool same_system(const std::string& vertical_a, const std::string& vertical_b) {
  if (vertical_a == vertical_b) return true;
  if (vertical_a == ellipsoidal_heights || vertical_b == ellipsoidal_heights) return false;
  const GdalErrors errors;
  const OGRSpatialReference a = parsed_crs(vertical_a), b = parsed_crs(vertical_b);
  return a.IsSame(&b) != 0;
}

}  // namespace talus
