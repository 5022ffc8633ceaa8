// Checks whether coordinates fit their system, and guesses which system they fit.
#include "import/crs_place_gdal.hpp"

#include <geodesic.h>
#include <ogr_spatialref.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>

#include "base/source_path.hpp"
#include "base/text.hpp"
#include "base/units.hpp"
#include "base/words.hpp"
#include "io/crs_gdal.hpp"
#include "io/errors_gdal.hpp"
#include "io/raster_commands.hpp"

namespace talus {
namespace {

using Mat2 = Eigen::Matrix2d;

constexpr double stretch_limit = 0.01;  // of a metre on the map against one on the ground
constexpr double turned_deg = 45;       // from here on, another axis is the nearest to north
constexpr double askew_deg = 5;         // of grid north from north, worth a warning
constexpr double beside_deg = 0.1;      // outside of the area of use, worth a warning
constexpr double widest_degrees = 5;    // of a map that is taken to be in degrees
constexpr double same_place_m = 0.1;    // of two systems that differ by their datum alone
constexpr double million = 1e6;

using Transformation = std::unique_ptr<OGRCoordinateTransformation>;

OGRSpatialReference parse_plan(const std::string& crs_wkt) {
  return parsed_crs(horizontal_crs(crs_wkt));
}

// --- a system and its place on the Earth ---------------------------------------------------------

// Area that a system is made for [degrees].
struct Area {
  double west = 0, south = 0, east = 0, north = 0;

  [[nodiscard]] double width() const { return east >= west ? east - west : east - west + 360; }
  // Degrees by which a longitude lies outside.
  [[nodiscard]] double beside(double longitude) const {
    const double from_west = std::remainder(longitude - (west + width() / 2), 360);
    return std::max(0.0, std::abs(from_west) - width() / 2);
  }
  [[nodiscard]] double above(double latitude) const {
    return std::max({0.0, latitude - north, south - latitude});
  }
};

std::optional<Area> area_of(const OGRSpatialReference& srs) {
  Area area;
  if (srs.GetAreaOfUse(&area.west, &area.south, &area.east, &area.north, nullptr)) return area;
  const char* const name = srs.GetAuthorityName(nullptr);
  const char* const code = srs.GetAuthorityCode(nullptr);
  OGRSpatialReference of_code;
  if (name != nullptr && code != nullptr &&
      of_code.SetFromUserInput((std::string(name) + ":" + code).c_str()) == OGRERR_NONE &&
      of_code.GetAreaOfUse(&area.west, &area.south, &area.east, &area.north, nullptr))
    return area;
  return std::nullopt;
}

class Ground {
 public:
  // A zone of UTM is one projection on both sides of the equator, where northings continue.
  explicit Ground(const std::string& crs_wkt, bool on_both_sides_of_equator = false)
      : srs_(parse_plan(crs_wkt)), wkt_(crs_wkt) {
    if (srs_.IsLocal() || srs_.IsGeocentric()) return;
    area_ = area_of(srs_);
    if (area_ && on_both_sides_of_equator && srs_.GetUTMZone() != 0)
      area_->south = -80, area_->north = 84;
    const std::unique_ptr<OGRSpatialReference> base(srs_.CloneGeogCS());
    if (!base) return;
    base->SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    unit_deg_ = base->GetAngularUnits() / degree;
    meridian_deg_ = base->GetPrimeMeridian();
    const double flattening_inverse = base->GetInvFlattening();
    geod_init(&ellipsoid_, base->GetSemiMajor(),
              flattening_inverse > 0 ? 1 / flattening_inverse : 0);
    down_.reset(OGRCreateCoordinateTransformation(&srs_, base.get()));
    if (down_) up_.reset(down_->GetInverse());
  }

  [[nodiscard]] bool is_on_earth() const { return down_ && up_; }
  [[nodiscard]] bool is_geographic() const { return srs_.IsGeographic() != 0; }
  [[nodiscard]] const std::optional<Area>& area() const { return area_; }
  [[nodiscard]] const std::string& wkt() const { return wkt_; }
  [[nodiscard]] double false_easting() const {
    return srs_.IsProjected() ? srs_.GetProjParm(SRS_PP_FALSE_EASTING, 0) : 0;
  }
  [[nodiscard]] bool is_transverse_mercator() const {
    const char* const projection = srs_.GetAttrValue("PROJECTION");
    return projection != nullptr && EQUAL(projection, SRS_PT_TRANSVERSE_MERCATOR);
  }
  // Whether zones that have this central meridian have this number: those of UTM, or those of Gauss
  // and Krueger, which are 6 or 3 degrees wide.
  [[nodiscard]] bool has_zone_number(double number) const {
    if (!is_transverse_mercator()) return false;
    const double meridian = srs_.GetNormProjParm(SRS_PP_CENTRAL_MERIDIAN) + meridian_deg_;
    const double scale = srs_.GetNormProjParm(SRS_PP_SCALE_FACTOR, 1);
    const auto is_at = [meridian](double degrees) {
      return std::abs(std::remainder(meridian - degrees, 360)) < 1e-6;
    };
    if (scale == 0.9996) return is_at(6 * number - 183);
    return scale == 1 && (is_at(6 * number - 3) || is_at(3 * number));
  }

  // Longitude and latitude of a place; nothing where the projection does not reach.
  [[nodiscard]] std::optional<Vec2> degrees(const Vec2& place) const {
    double x = place.x(), y = place.y();
    if (!down_ || !down_->Transform(1, &x, &y) || !std::isfinite(x) || !std::isfinite(y))
      return std::nullopt;
    double back_x = x, back_y = y;
    if (!up_->Transform(1, &back_x, &back_y) ||
        !(std::hypot(back_x - place.x(), back_y - place.y()) <= 1))
      return std::nullopt;
    const Vec2 found(x * unit_deg_ + meridian_deg_, y * unit_deg_);
    if (!(std::abs(found.y()) <= 90)) return std::nullopt;
    return found;
  }

  [[nodiscard]] std::optional<Vec2> map_place(const Vec2& lon_lat) const {
    double x = (lon_lat.x() - meridian_deg_) / unit_deg_, y = lon_lat.y() / unit_deg_;
    if (!up_ || !up_->Transform(1, &x, &y) || !std::isfinite(x) || !std::isfinite(y))
      return std::nullopt;
    return Vec2(x, y);
  }

  // Metres on the ground between two longitudes and latitudes.
  [[nodiscard]] double distance(const Vec2& a, const Vec2& b) const {
    double metres = 0;
    geod_inverse(&ellipsoid_, a.y(), a.x(), b.y(), b.x(), &metres, nullptr, nullptr);
    return metres;
  }

 private:
  OGRSpatialReference srs_;
  std::string wkt_;
  Transformation down_, up_;
  std::optional<Area> area_;
  double unit_deg_ = 1, meridian_deg_ = 0;
  geod_geodesic ellipsoid_{};
};

// How the axes of a map run on the ground.
struct Axes {
  double stretch_x = 1, stretch_y = 1;  // metres on the map in one on the ground
  double bearing_x_deg = 90, bearing_y_deg = 0;
};

std::optional<Axes> axes_at(const Ground& ground, const Vec2& lon_lat) {
  constexpr double step_deg = 1e-4;
  const double sign = lon_lat.y() > 0 ? -1 : 1;  // never beyond a pole
  const Vec2 to_east(lon_lat.x() + step_deg, lon_lat.y());
  const Vec2 to_north(lon_lat.x(), lon_lat.y() + sign * step_deg);
  const auto here = ground.map_place(lon_lat), east = ground.map_place(to_east),
             north = ground.map_place(to_north);
  if (!here || !east || !north) return std::nullopt;
  Mat2 map_of_ground;
  map_of_ground.col(0) = (*east - *here) / ground.distance(lon_lat, to_east);
  map_of_ground.col(1) = (*north - *here) / (sign * ground.distance(lon_lat, to_north));
  if (!(std::abs(map_of_ground.determinant()) > 1e-6)) return std::nullopt;
  const Mat2 ground_of_map = map_of_ground.inverse();
  const auto bearing = [](const Vec2& v) { return std::atan2(v.x(), v.y()) / degree; };
  return Axes{1 / ground_of_map.col(0).norm(), 1 / ground_of_map.col(1).norm(),
              bearing(ground_of_map.col(0)), bearing(ground_of_map.col(1))};
}

// --- where it lies -------------------------------------------------------------------------------

std::array<Vec2, 5> corners_of(const MapWindow& w) {
  return {Vec2(0.5 * (w.x_min + w.x_max), 0.5 * (w.y_min + w.y_max)), Vec2(w.x_min, w.y_min),
          Vec2(w.x_max, w.y_min), Vec2(w.x_max, w.y_max), Vec2(w.x_min, w.y_max)};
}

// Longitudes and latitudes of middle and corners; empty when one of them is nowhere.
std::vector<Vec2> places_of(const Ground& ground, const MapWindow& extent) {
  std::vector<Vec2> found;
  for (const Vec2& corner : corners_of(extent)) {
    const auto place = ground.degrees(corner);
    if (!place) return {};
    found.push_back(*place);
  }
  return found;
}

double stretch_of(const Axes& axes) {
  return std::max(std::abs(axes.stretch_x - 1), std::abs(axes.stretch_y - 1));
}

bool is_stretched(const Ground& ground, const std::vector<Vec2>& places) {
  return !ground.is_geographic() &&
         std::any_of(places.begin(), places.end(), [&ground](const Vec2& lon_lat) {
           const auto axes = axes_at(ground, lon_lat);
           return axes && stretch_of(*axes) > stretch_limit;
         });
}

enum class Verdict { inside, beside, far };

// Maps reach beyond the area of their system by as much as it is wide: neighbours' zones are used.
// To the east and west a whole country may be in one zone (Transverse Mercator); there the scale
// decides, which is 1 % off 900 km from its meridian.
Verdict verdict_in(const Ground& ground, const std::vector<Vec2>& places) {
  const Area& area = *ground.area();
  const double margin_x =
      ground.is_transverse_mercator() ? 180 : std::clamp(area.width(), 1.0, 6.0);
  const double margin_y = std::clamp(area.north - area.south, 1.0, 6.0);
  Verdict verdict = Verdict::inside;
  for (const Vec2& place : places) {
    const double x = area.beside(place.x()), y = area.above(place.y());
    if (x > margin_x || y > margin_y) return Verdict::far;
    if (x > beside_deg || y > beside_deg) verdict = Verdict::beside;
  }
  // outside of its area, a projection still serves where its metres are metres
  return verdict == Verdict::beside && is_stretched(ground, places) ? Verdict::far : verdict;
}

// The systems that a place must fit: that of its coordinates and the one computed in.
struct Systems {
  const Ground &own, &work;

  [[nodiscard]] Verdict verdict(const std::vector<Vec2>& places) const {
    if (places.empty()) return Verdict::far;
    Verdict worst = Verdict::inside;
    for (const Ground* ground : {&own, &work}) {
      if (ground->area()) worst = std::max(worst, verdict_in(*ground, places));
    }
    return worst;
  }
  [[nodiscard]] bool knows_area() const { return own.area() || work.area(); }
  // The one that the places lie farther outside of.
  [[nodiscard]] const Ground& narrower(const std::vector<Vec2>& places) const {
    const bool own_fits =
        !own.area() || (!places.empty() && verdict_in(own, places) == Verdict::inside);
    return own_fits && work.area() ? work : own;
  }
};

std::string area_text(const Area& area) {
  const auto side = [](double value, const char* plus, const char* minus) {
    return text(std::abs(value), 4) + (value < 0 ? minus : plus);
  };
  return side(area.west, " E", " W") + " to " + side(area.east, " E", " W") + ", " +
         side(area.south, " N", " S") + " to " + side(area.north, " N", " S");
}

std::string extent_words(const MapWindow& w) {
  return "x " + text(w.x_min, 10) + " to " + text(w.x_max, 10) + ", y " + text(w.y_min, 10) +
         " to " + text(w.y_max, 10);
}

// --- likely readings -----------------------------------------------------------------------------

// Something that coordinates may be instead, and how to say or mend it.
struct Guess {
  std::string words;  // "with x and y exchanged they would lie in it"
  std::string hint;
};

MapWindow mapped(const MapWindow& w, const std::function<Vec2(const Vec2&)>& change) {
  const Vec2 a = change({w.x_min, w.y_min}), b = change({w.x_max, w.y_max});
  return {std::min(a.x(), b.x()), std::min(a.y(), b.y()), std::max(a.x(), b.x()),
          std::max(a.y(), b.y())};
}

std::string mended_command(const CrsExtent& place, const Where& where, const std::string& function,
                           const MapWindow& moved) {
  const std::string named = " -a_srs " + crs_code(place.crs_wkt);
  if (place.is_raster)
    return function.starts_with("SwapCoords")
               ? "look at its corners: gdalinfo " + command_words(where.file)
               : "gdal_translate" + named + " -a_ullr " + text(moved.x_min, 12) + " " +
                     text(moved.y_max, 12) + " " + text(moved.x_max, 12) + " " +
                     text(moved.y_min, 12) + " " + command_words(where.file) + " mended.tif";
  if (place.layer.empty()) return "write them as x, y in metres of that system";
  if (is_table_name(where.file))
    return function.starts_with("SwapCoords")
               ? "exchange the names of the columns in the first line of the table: x is the "
                 "easting, y the northing"
               : "compute the eastings and northings of that system in the table";
  const std::string column = place.geometry_column.empty() ? "geometry" : place.geometry_column;
  const std::size_t hole = function.find('@');
  return "ogr2ogr" + named + " -f GPKG -nln mended mended.gpkg " + command_words(where.file) +
         " -dialect sqlite -sql " +
         shell_word("SELECT " + function.substr(0, hole) + column + function.substr(hole + 1) +
                    " AS " + column + ", * FROM \"" + place.layer + "\"");
}

std::string way_out(const CrsExtent& place, const Where& where) {
  if (place.has_crs_option)
    return "is it the CRS of these coordinates? name the right one with --crs EPSG:code";
  if (!place.crs_said_in.empty())
    return "is it the CRS of these coordinates? " + place.crs_said_in + " says so";
  return "is it the CRS of these coordinates? name the right one in the file: " +
         (place.is_raster
              ? "gdal_translate -a_srs EPSG:code " + command_words(where.file) + " named.tif"
              : "ogr2ogr -a_srs EPSG:code named.gpkg " + command_words(where.file));
}

std::string way_to_zone(const CrsExtent& place, const Where& where, const Vec2& lon_lat) {
  const std::string zone = utm_zone(place.crs_wkt, lon_lat);
  const std::string to = zone.empty() ? "EPSG:code" : zone;
  if (!place.way_to_other_crs.empty()) return place.way_to_other_crs + " " + to;
  if (place.has_crs_option) return "--t-srs " + to + " reprojects";
  if (!place.is_raster) return "reproject it to " + to + " first";
  return warp_command(CellKind::heights, "-t_srs " + to, where.file, "projected.tif");
}

// Code of zone 0 of UTM on the datum of the map, where it has codes of its own; else on WGS 84. To
// another datum a shift is needed that PROJ may not know.
int zones_on_datum(const std::string& crs_wkt, int zone, bool is_south) {
  struct Zones {
    const char* datum;  // code of its longitudes and latitudes
    bool is_south;
    int before, first, last;
  };
  const std::unique_ptr<OGRSpatialReference> base(parse_plan(crs_wkt).CloneGeogCS());
  const std::string code = base ? crs_code(wkt_of(base.get())) : std::string();
  for (const Zones& zones : {Zones{"EPSG:4258", false, 25800, 28, 38},  // ETRS89
                             Zones{"EPSG:4269", false, 26900, 1, 23},   // NAD83
                             Zones{"EPSG:6318", false, 6329, 1, 19},    // NAD83(2011)
                             Zones{"EPSG:7844", true, 7800, 46, 59}})   // GDA2020
    if (code == zones.datum && zones.is_south == is_south && zones.first <= zone &&
        zone <= zones.last)
      return zones.before;
  return is_south ? 32700 : 32600;
}

class Guesses {
 public:
  Guesses(const CrsExtent& place, const Where& where, const Systems& systems)
      : place_(place), where_(where), systems_(systems) {}

  [[nodiscard]] std::optional<Guess> best() const {
    if (auto guess = degrees()) return guess;
    if (auto guess = exchanged()) return guess;
    if (auto guess = other_hemisphere()) return guess;
    if (auto guess = zone_number()) return guess;
    if (auto guess = gauss_krueger()) return guess;
    if (auto guess = other_unit()) return guess;
    return turned_over();
  }

  // Degrees where metres are expected: the map would be smaller than a room.
  [[nodiscard]] std::optional<Guess> degrees() const {
    const MapWindow& w = place_.extent;
    if (systems_.own.is_geographic() || !(w.x_max - w.x_min < widest_degrees) ||
        !(w.y_max - w.y_min < widest_degrees))
      return std::nullopt;
    for (const bool is_exchanged : {false, true}) {
      std::vector<Vec2> places;
      for (const Vec2& c : corners_of(w)) places.push_back(is_exchanged ? Vec2(c.y(), c.x()) : c);
      const bool may_be = std::all_of(places.begin(), places.end(), [](const Vec2& p) {
        return std::abs(p.x()) <= 180 && std::abs(p.y()) <= 90;
      });
      if (!may_be || !systems_.knows_area() || systems_.verdict(places) != Verdict::inside)
        continue;
      const std::string work = crs_code(systems_.work.wkt());
      return Guess{
          std::string("they look like degrees") + (is_exchanged ? ", the latitude first" : ""),
          is_exchanged ? "write longitude and latitude, x first, and name the CRS EPSG:4326"
          : place_.has_crs_option ? "--crs EPSG:4326 --t-srs " + work
          : !place_.crs_said_in.empty()
              ? place_.crs_said_in + " says metres, and they would be in EPSG:4326"
              : "name the CRS that they are in: ogr2ogr -a_srs EPSG:4326 -f GPKG "
                "named.gpkg " +
                    command_words(where_.file)};
    }
    return std::nullopt;
  }

 private:
  const CrsExtent& place_;
  const Where& where_;
  const Systems& systems_;

  [[nodiscard]] double first_million() const { return std::floor(place_.extent.x_min / million); }

  [[nodiscard]] bool fits(const MapWindow& window) const {
    return systems_.knows_area() &&
           systems_.verdict(places_of(systems_.own, window)) == Verdict::inside;
  }

  [[nodiscard]] std::optional<Guess> changed(const std::function<Vec2(const Vec2&)>& change,
                                             const std::string& words,
                                             const std::string& function) const {
    const MapWindow moved = mapped(place_.extent, change);
    if (!fits(moved)) return std::nullopt;
    return Guess{words, mended_command(place_, where_, function, moved)};
  }

  [[nodiscard]] std::optional<Guess> exchanged() const {
    return changed([](const Vec2& p) { return Vec2(p.y(), p.x()); },
                   "with x and y exchanged they would lie in it", "SwapCoords(@)");
  }

  // Signs of systems whose axes run to the south and west.
  [[nodiscard]] std::optional<Guess> turned_over() const {
    if (auto guess = changed([](const Vec2& p) { return Vec2(-p.x(), -p.y()); },
                             "with the other signs they would lie in it", "ScaleCoords(@, -1)"))
      return guess;
    return changed([](const Vec2& p) { return Vec2(-p.y(), -p.x()); },
                   "with x and y exchanged, and the other signs, they would lie in it",
                   "ScaleCoords(SwapCoords(@), -1)");
  }

  [[nodiscard]] std::optional<Guess> other_hemisphere() const {
    const Ground both(systems_.own.wkt(), true);
    const std::vector<Vec2> places = places_of(both, place_.extent);
    if (!both.area() || places.empty() || verdict_in(both, places) != Verdict::inside ||
        verdict_in(systems_.own, places) == Verdict::inside)
      return std::nullopt;
    return Guess{"they lie in its zone on the other side of the equator",
                 way_to_zone(place_, where_, places.front())};
  }

  // The number of the zone in millions before the easting, or missing there. Only the number of
  // this very zone is one: any other means another projection, which no shift brings here. Nor
  // does the lack of one tell zones of Gauss and Krueger from those of UTM.
  [[nodiscard]] std::optional<Guess> zone_number() const {
    const double zone = first_million();
    if (zone >= 1 && systems_.own.has_zone_number(zone))
      if (auto guess = changed([&](const Vec2& p) { return Vec2(p.x() - zone * million, p.y()); },
                               "the eastings begin with the zone number " + text(zone) +
                                   ", which this CRS leaves out",
                               "ShiftCoords(@, " + text(-zone * million, 9) + ", 0)"))
        return with_system_of_zone(zone, *guess);
    const double false_easting = systems_.own.false_easting();
    const double missing = std::floor(false_easting / million);
    if (missing < 1 || false_easting - missing * million != 500000 ||
        !fits(mapped(place_.extent,
                     [&](const Vec2& p) { return Vec2(p.x() + missing * million, p.y()); })))
      return std::nullopt;
    return Guess{
        "the eastings lack the zone number " + text(missing) + " that they have in this CRS",
        way_out(place_, where_)};
  }

  // Eastings that begin with the number of a zone of Gauss and Krueger, 3 or 6 degrees wide.
  [[nodiscard]] std::optional<Guess> gauss_krueger() const {
    const double zone = first_million();
    if (systems_.own.is_geographic() || zone < 1 || zone > 60) return std::nullopt;
    for (const double meridian : {3 * zone, 6 * zone - 3}) {
      const Ground other(crs_from_user("+proj=tmerc +k=1 +ellps=bessel +lon_0=" + text(meridian) +
                                           " +x_0=" + text(zone * million + 500000),
                                       ""));
      const std::vector<Vec2> places = places_of(other, place_.extent);
      if (!systems_.knows_area() || systems_.verdict(places) != Verdict::inside) continue;
      return Guess{"as eastings of zone " + text(zone) + " of Gauss and Krueger (meridian " +
                       text(meridian) + " E) they would lie in it",
                   way_out(place_, where_)};
    }
    return std::nullopt;
  }

  // ETRS89 / UTM zones 31 to 33 have codes of their own for eastings with the number.
  [[nodiscard]] Guess with_system_of_zone(double zone, Guess guess) const {
    const std::string own = crs_code(place_.crs_wkt);
    const char* const code = own == "EPSG:25831" && zone == 31   ? "EPSG:5649"
                             : own == "EPSG:25832" && zone == 32 ? "EPSG:4647"
                             : own == "EPSG:25833" && zone == 33 ? "EPSG:5650"
                                                                 : nullptr;
    if (code != nullptr && place_.has_crs_option)
      guess.hint = "--crs " + std::string(code) + " --t-srs " + crs_code(systems_.work.wkt());
    return guess;
  }

  // A zone from the equator to the pole takes in most coordinates when they are scaled, also metres
  // of another system, which lie within 10,000 km of the equator.
  [[nodiscard]] bool may_be_in_other_unit() const {
    constexpr double widest_country_deg = 15, farthest_north_m = 10.1e6;
    const std::optional<Area>& area = systems_.own.area();
    return area && (area->north - area->south <= widest_country_deg ||
                    std::min(std::abs(place_.extent.y_min), std::abs(place_.extent.y_max)) >
                        farthest_north_m);
  }

  [[nodiscard]] std::optional<Guess> other_unit() const {
    struct Unit {
      const char* name;
      double metres;
    };
    if (systems_.own.is_geographic() || !may_be_in_other_unit()) return std::nullopt;
    for (const Unit& unit : {Unit{"feet", 0.3048}, Unit{"millimetres", 0.001},
                             Unit{"centimetres", 0.01}, Unit{"kilometres", 1000}}) {
      auto guess = changed([&](const Vec2& p) { return (p * unit.metres).eval(); },
                           std::string("as ") + unit.name + " they would lie in it",
                           "ScaleCoords(@, " + text(unit.metres) + ")");
      if (!guess) continue;
      // feet of two lengths are in use there, and systems of their own for each
      const bool is_american = unit.metres == 0.3048 && systems_.own.area()->east < -60;
      if (is_american)
        guess->hint = way_out(place_, where_);
      else if (place_.has_unit_option)
        guess->hint = "--unit-m " + text(unit.metres) + " scales plan and heights";
      return guess;
    }
    return std::nullopt;
  }
};

// --- the checks ----------------------------------------------------------------------------------

std::string outside_words(const CrsExtent& place, const Ground& ground) {
  return "its coordinates, " + extent_words(place.extent) + ", lie outside the area that " +
         crs_name(ground.wkt()) + " is made for" +
         (ground.area() ? " (" + area_text(*ground.area()) + ")" : "");
}

void check_degrees(const Guesses& guesses, const CrsExtent& place, const Where& where) {
  const auto guess = guesses.degrees();
  if (!guess) return;
  throw InputError(where,
                   "its coordinates are " + extent_words(place.extent) + " in a CRS in metres, " +
                       crs_name(place.crs_wkt) + ": " + guess->words,
                   guess->hint);
}

// On the whole of the extent, where that is on the map.
Doubt on_extent(const CrsExtent& place, const Where& where, const std::string& found) {
  Doubt doubt = doubt_on(where, found);
  if (!place.work_wkt.empty() && !same_crs(place.crs_wkt, place.work_wkt)) return doubt;
  const MapWindow& e = place.extent;
  doubt.at = {{e.x_min, e.y_min, Doubt::none}, {e.x_max, e.y_max, Doubt::none}};
  return doubt;
}

void check_area(const Systems& systems, const std::vector<Vec2>& places, const Guesses& guesses,
                const CrsExtent& place, const Where& where, std::vector<Doubt>& doubts) {
  const Verdict verdict = systems.verdict(places);
  if (verdict == Verdict::inside) return;
  const auto guess = guesses.best();
  const std::string finding = outside_words(place, systems.narrower(places)) +
                              (guess ? "; " + guess->words : std::string());
  if (verdict == Verdict::far)
    throw InputError(where, finding, guess ? guess->hint : way_out(place, where));
  doubts.push_back(on_extent(place, where, finding + ": is it the right CRS?"));
}

void check_axes(const Ground& ground, const std::vector<Vec2>& places, const CrsExtent& place,
                const Where& where, std::vector<Doubt>& doubts) {
  Axes worst;
  double worst_stretch = 0, askew = 0, map_north = 0;
  for (const Vec2& lon_lat : places) {
    const auto axes = axes_at(ground, lon_lat);
    if (!axes) continue;
    const double stretch = stretch_of(*axes);
    const double turn_x = std::abs(std::remainder(axes->bearing_x_deg - 90, 360));
    const double turn_y = std::abs(std::remainder(axes->bearing_y_deg, 360));
    if (turn_x > turned_deg || turn_y > turned_deg)
      throw InputError(where,
                       "in " + crs_name(ground.wkt()) + " x runs to " +
                           text(std::remainder(axes->bearing_x_deg, 360), 3) + " and y to " +
                           text(std::remainder(axes->bearing_y_deg, 360), 3) +
                           " degrees from north here, expected x to the east and y to the north",
                       way_to_zone(place, where, lon_lat));
    if (std::max(turn_x, turn_y) > askew) {
      askew = std::max(turn_x, turn_y);
      map_north = std::remainder(axes->bearing_y_deg, 360);
    }
    if (stretch <= worst_stretch) continue;
    worst_stretch = stretch;
    worst = *axes;
  }
  if (worst_stretch > stretch_limit)
    throw InputError(where,
                     "the CRS is " + crs_name(ground.wkt()) +
                         ", whose metres are stretched here: " + text(worst.stretch_x, 4) +
                         " of them along x and " + text(worst.stretch_y, 4) +
                         " along y are one on the ground, expected 1 "
                         "within " +
                         percent(stretch_limit),
                     way_to_zone(place, where, places.front()));
  if (askew > askew_deg)
    doubts.push_back(on_extent(place, where,
                               "north of the map is " + text(std::abs(map_north), 3) + " degrees " +
                                   (map_north < 0 ? "west" : "east") + " of north in " +
                                   crs_name(ground.wkt()) +
                                   "; directions of joints count from north of the map: for those "
                                   "from true north give [joints] convergence_deg = " +
                                   text(map_north, 3)));
}

}  // namespace

std::string utm_zone(const std::string& crs_wkt, const Vec2& lon_lat) {
  const double longitude = std::remainder(lon_lat.x(), 360), latitude = lon_lat.y();
  if (!(std::abs(latitude) <= 84)) return {};
  const int zone = std::min(60, 1 + static_cast<int>(std::floor((longitude + 180) / 6)));
  return "EPSG:" + std::to_string(zones_on_datum(crs_wkt, zone, latitude < 0) + zone);
}

std::optional<Vec2> degrees_at(const std::string& crs_wkt, const Vec2& place) {
  const GdalErrors errors;
  return Ground(crs_wkt).degrees(place);
}

DegreeWindow degrees_of(const std::string& crs_wkt, const MapWindow& window) {
  const GdalErrors errors;
  const std::vector<Vec2> places = places_of(Ground(crs_wkt), window);
  if (places.empty()) return {};
  DegreeWindow found{true, places[0].x(), places[0].y(), places[0].x(), places[0].y()};
  for (const Vec2& place : places) {
    const double x = places[0].x() + std::remainder(place.x() - places[0].x(), 360);
    found.west = std::min(found.west, x);
    found.east = std::max(found.east, x);
    found.south = std::min(found.south, place.y());
    found.north = std::max(found.north, place.y());
  }
  found.west = std::remainder(found.west, 360);
  found.east = std::remainder(found.east, 360);
  return found;
}

void check_place(const CrsExtent& place, const Where& where, std::vector<Doubt>& doubts) {
  if (place.crs_wkt.empty()) return;
  const GdalErrors errors;
  const bool is_taken_on = !place.work_wkt.empty() && !same_crs(place.crs_wkt, place.work_wkt);
  const Ground own(place.crs_wkt, is_taken_on);
  const std::optional<Ground> target =
      is_taken_on ? std::make_optional<Ground>(place.work_wkt) : std::nullopt;
  const Systems systems{own, target ? *target : own};
  if (!systems.own.is_on_earth() || !systems.work.is_on_earth()) return;
  const Guesses guesses(place, where, systems);
  check_degrees(guesses, place, where);
  const std::vector<Vec2> places = places_of(systems.own, place.extent);
  check_area(systems, places, guesses, place, where, doubts);
  if (!systems.work.is_geographic()) check_axes(systems.work, places, place, where, doubts);
}

std::string reason_to_replace(const std::string& own, const std::string& given,
                              const MapWindow& extent) {
  if (own.empty() || given.empty()) return {};
  const GdalErrors errors;
  const Ground named(own), wanted(given);
  if (!named.is_on_earth() || !wanted.is_on_earth()) return {};
  const std::vector<Vec2> places = places_of(named, extent);
  const Systems systems{named, named};
  const CrsExtent place{own, extent};
  const bool is_nowhere =
      systems.verdict(places) == Verdict::far || Guesses(place, {}, systems).degrees().has_value();
  if (is_nowhere) return "where its coordinates cannot be";
  if (!has_unknown_datum(own)) return {};
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto there = wanted.map_place(places[i]);
    if (!there || !((*there - corners_of(extent)[i]).norm() < same_place_m)) return {};
  }
  return "whose datum is not known";
}

std::function<double(double, double)> on_one_side(const std::string& crs_wkt) {
  const GdalErrors errors;
  if (crs_wkt.empty() || parse_plan(crs_wkt).IsGeographic() == 0)
    return [](double x, double) { return x; };
  const double turn = 360 * degree / parse_plan(crs_wkt).GetAngularUnits();
  return [turn](double x, double other) {
    const double turns = std::round((x - other) / turn);
    return std::isfinite(turns) ? x - turns * turn : x;
  };
}

MapWindow window_of(const std::vector<Vec3>& points, const std::string& crs_wkt) {
  MapWindow window{HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
  const auto near = on_one_side(crs_wkt);
  for (const Vec3& p : points) {
    const double x = near(p.x(), points.front().x());
    window.x_min = std::min(window.x_min, x);
    window.y_min = std::min(window.y_min, p.y());
    window.x_max = std::max(window.x_max, x);
    window.y_max = std::max(window.y_max, p.y());
  }
  return window;
}

namespace {

std::string unit_text(double metres, const char* name) {
  return std::string(name ? name : "unknown units") + " of " + text(metres, 10) + " m";
}

std::string describe_problem(const std::string& crs_wkt) {
  const OGRSpatialReference srs = parsed_crs(crs_wkt);
  if (srs.IsGeographic()) return "in degrees";
  if (srs.IsGeocentric()) return "measured from the centre of the Earth";
  if (!srs.IsProjected() && !is_local(crs_wkt)) return "neither projected nor local";
  const char* name = nullptr;
  const double unit = srs.GetLinearUnits(&name);
  if (std::abs(unit - 1) > 1e-9) return "in " + unit_text(unit, name);
  const double height_unit = srs.GetTargetLinearUnits("VERT_CS", &name);
  if (srs.IsVertical() && std::abs(height_unit - 1) > 1e-9)
    return "with heights in " + unit_text(height_unit, name);
  return {};
}

std::string zone_of(const std::string& crs_wkt, const Vec2& place) {
  const std::optional<Vec2> lon_lat = degrees_at(crs_wkt, place);
  return lon_lat ? utm_zone(crs_wkt, *lon_lat) : std::string();
}

}  // namespace

CrsProblem find_crs_problem(const std::string& crs_wkt, const Vec2& place) {
  if (crs_wkt.empty()) return {"there is no CRS, expected a projected one in metres", {}};
  const GdalErrors errors;
  const OGRSpatialReference srs = parsed_crs(crs_wkt);
  const std::string problem = describe_problem(crs_wkt);
  if (problem.empty()) return {};
  const bool fit_in_plan = srs.IsCompound() && describe_problem(horizontal_crs(crs_wkt)).empty();
  const double height_unit_m = fit_in_plan ? srs.GetTargetLinearUnits("VERT_CS") : 1;
  return {
      "the CRS is " + crs_name(crs_wkt) + ", " + problem + ", expected a projected one in metres",
      fit_in_plan ? std::string() : zone_of(crs_wkt, place), height_unit_m};
}

}  // namespace talus
