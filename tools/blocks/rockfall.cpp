// Rocks of the [rockfall.*] sections: release places, forms and frequencies.
#include "tools/blocks/rockfall.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "base/text.hpp"
#include "base/units.hpp"
#include "base/words.hpp"
#include "blocks/placed_bodies.hpp"
#include "blocks/placement.hpp"
#include "blocks/rock_draws.hpp"
#include "blocks/shapes.hpp"
#include "geometry/plan2d.hpp"
#include "setup/joint_cells_gdal.hpp"
#include "setup/map_box.hpp"
#include "setup/site_shapes_gdal.hpp"
#include "setup/value_raster_gdal.hpp"
#include "site/joint_plan.hpp"

namespace talus {
namespace {

/// A place that releases rocks.
struct ReleasePlace {
  Vec3 position;                ///< local; z NaN: on the ground
  double area = not_given;      ///< of sloping ground that it represents [m2]
  Vec3 extents = Vec3::Zero();  ///< of its rocks, by rasters [m]; 0: as the section says
  int shape = 0;                ///< of blshape_raster; 0: as the section says
};

struct RockfallSection : BodySection {
  const RockfallSettings& settings;

  [[noreturn]] void refuse(const std::string& finding, const std::string& hint) const {
    throw InputError(where(), finding, hint);
  }
};

// --- places -------------------------------------------------------------------------------------

void add_release_shapes(const RockfallSection& section, std::vector<ReleasePlace>& places) {
  const SitePlace release = release_of(section.settings);
  const double spacing = section.settings.release_spacing_m;
  for (std::vector<Vec2> line :
       shapes_in_plan(section.tool, section.site, section.ground, release)) {
    if (release.kind == VectorKind::lines) {
      check_number(section, length_of(line) / spacing);
      line = points_along(line, spacing);
    }
    for (const Vec2& p : line) places.push_back({Vec3(p.x(), p.y(), NAN)});
  }
}

double slope_deg_at(const Trn& ground, const Vec2& at) {
  if (!contains(ground, at.x(), at.y())) return not_given;
  const Vec2 gradient = triangle_gradient(ground, triangle_at(ground, at.x(), at.y()));
  return std::atan(gradient.norm()) / degree;
}

// Without any place the steep ground of all the terrain releases rocks.
bool is_everywhere(const RockfallSettings& s) {
  return s.min_slope_deg > 0 && s.position_m.empty() && s.release_file.empty() &&
         s.polygon.empty() && s.polygon_file.empty() && s.rockdensity_raster.empty();
}

void add_areas(const RockfallSection& section, Random& random, std::vector<ReleasePlace>& places) {
  const RockfallSettings& s = section.settings;
  const SitePlace where = areas_of(s);
  ReleaseArea release{{}, s.min_slope_deg * degree};
  if (!is_everywhere(s)) {
    if (where.file.empty() && where.points.empty()) return;
    release.area = without_repeated_corners(
        {shapes_in_plan(section.tool, section.site, section.ground, where)});
    check_area(release.area, section.ground.origin, section.where());
  }
  const double spacing =
      std::isnan(s.release_spacing_m) ? section.ground.cell_size : s.release_spacing_m;
  const SlopingArea area = sloping_area(section.ground, release);
  check_number(section, area.steep / (spacing * spacing));
  const Vec3 shift{random.uniform(), random.uniform(), random.uniform()};
  const std::vector<Vec2> points = points_over(section.ground, release, spacing, shift);
  for (const Vec2& p : points)
    places.push_back({Vec3(p.x(), p.y(), NAN), area.steep / static_cast<double>(points.size())});
  if (s.min_slope_deg > 0)
    section.tool.info(section.path + ": " + percent(area.steep / area.all) + " of the ground of " +
                      (is_everywhere(s) ? "the terrain" : "its areas") + " is " +
                      text(s.min_slope_deg) + " deg steep or more");
}

std::optional<ValueRaster> beside(const ValueRasterContext& of, const char* key,
                                  const std::string& file, const MapBox& box,
                                  const ValueRaster& cells) {
  if (file.empty()) return std::nullopt;
  ValueRaster raster = read_values(of, key, file, box);
  check_same_cells(raster, cells);
  return raster;
}

// The density that the raster has must be that of the section's material, which the run has.
void check_density(const RockfallSection& section, const ValueRaster& density, std::size_t cell) {
  const double expected = section.site
                              .materials[static_cast<std::size_t>(
                                  material_index(section.site, section.settings.material))]
                              .density_kg_m3;
  if (std::abs(density.value[cell] - expected) > 0.01 * expected)
    density.refuse(cell,
                   text(density.value[cell]) + " kg/m3, and the material has " + text(expected),
                   "give the material this density_kg_m3; rocks of two densities are two "
                   "[rockfall.*] with a material each");
}

void add_cells(const RockfallSection& section, Random& random, std::vector<ReleasePlace>& places) {
  const RockfallSettings& s = section.settings;
  if (s.rockdensity_raster.empty()) return;
  const int n_extents = !s.d1_raster.empty() + !s.d2_raster.empty() + !s.d3_raster.empty();
  if (n_extents != 0 && n_extents != 3)
    section.refuse("has some of d1_raster, d2_raster and d3_raster", "give all three, or none");
  const ValueRasterContext of{section.tool, section.site, section.ground, section.path};
  const MapBox box = box_of_terrain(section.ground);
  const ValueRaster density = read_values(of, "rockdensity_raster", s.rockdensity_raster, box);
  const std::array<std::optional<ValueRaster>, 3> extents = {
      beside(of, "d1_raster", s.d1_raster, box, density),
      beside(of, "d2_raster", s.d2_raster, box, density),
      beside(of, "d3_raster", s.d3_raster, box, density)};
  const std::optional<ValueRaster> shapes =
      beside(of, "blshape_raster", s.blshape_raster, box, density);
  const double side = density.frame.cell_size;
  for (std::size_t cell = 0; cell < density.value.size(); ++cell) {
    if (!(density.value[cell] > 0)) continue;
    const Vec2 at = density.centre_of(cell) - section.ground.origin.head<2>();
    const double slope = slope_deg_at(section.ground, at);
    if (!(slope >= s.min_slope_deg)) continue;  // unknown ground, too
    check_density(section, density, cell);
    const Vec2 off{random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5)}, there = at + side * off;
    const bool is_ground = !std::isnan(slope_deg_at(section.ground, there));
    const Vec2& start = is_ground ? there : at;
    ReleasePlace place{Vec3(start.x(), start.y(), NAN), side * side / std::cos(slope * degree)};
    if (n_extents == 3) {
      for (int k = 0; k < 3; ++k) {
        place.extents[k] = extents[static_cast<std::size_t>(k)]->value[cell];
        if (!(place.extents[k] > 0))
          extents[static_cast<std::size_t>(k)]->refuse(
              cell, text(place.extents[k]) + " m", "a cell that releases rocks has their extents");
      }
    }
    if (shapes) {
      const double code = shapes->value[cell];
      if (code != 1 && code != 2 && code != 3 && code != 4)
        shapes->refuse(cell, text(code), "1 is a box, 2 an ellipsoid, 3 a sphere, 4 a disc");
      place.shape = static_cast<int>(code);
    }
    places.push_back(place);
  }
}

// A place that is named twice is one place. Those of areas and cells differ in another run.
std::vector<ReleasePlace> places_of(const RockfallSection& section) {
  std::vector<ReleasePlace> places;
  std::vector<Vec3> points = local_points(section.tool, section.site, section.ground,
                                          section.settings.position_m, section.path, "position_m");
  if (!section.settings.release_file.empty()) {
    std::vector<ReleasePlace> released;
    add_release_shapes(section, released);
    for (const ReleasePlace& place : released) points.push_back(place.position);
  }
  for (const Vec3& point : each_place_once(section, points)) places.push_back({point});
  Random random(static_cast<std::uint64_t>(section.settings.seed),
                "release places of " + section.settings.name);
  add_areas(section, random, places);
  add_cells(section, random, places);
  if (places.empty())
    section.refuse("no place releases rocks",
                   "give position_m, release_file, polygon_file or rockdensity_raster; a "
                   "min_slope_deg that the ground reaches, alone or of areas");
  check_number(section,
               static_cast<double>(places.size()) * static_cast<double>(section.settings.rocks));
  return places;
}

// --- how often ----------------------------------------------------------------------------------

bool has_frequency(const RockfallSettings& s) {
  return !std::isnan(s.frequency_per_a) || !std::isnan(s.frequency_per_m2_a);
}

void check_frequency(const RockfallSection& section) {
  const RockfallSettings& s = section.settings;
  if (!std::isnan(s.frequency_per_a) && !std::isnan(s.frequency_per_m2_a))
    section.refuse("has both frequency_per_a and frequency_per_m2_a",
                   "give the one of the whole source, or the one of area");
  for (const RockfallSettings& other : section.site.rockfalls)
    if (has_frequency(other) != has_frequency(s))
      section.refuse(std::string("has ") + (has_frequency(s) ? "a" : "no") +
                         " frequency, and rockfall." + other.name + " has " +
                         (has_frequency(s) ? "none" : "one"),
                     "rocks are weighed by their frequencies: give one to each section");
}

// Rocks a year that each rock of a place represents; 1 where no frequency is given.
double weight_of(const RockfallSection& section, const ReleasePlace& place, std::size_t n_places) {
  const RockfallSettings& s = section.settings;
  if (!has_frequency(s)) return 1;
  const auto rocks = static_cast<double>(s.rocks);
  if (!std::isnan(s.frequency_per_a))
    return s.frequency_per_a / (rocks * static_cast<double>(n_places));
  if (std::isnan(place.area))
    section.refuse("has frequency_per_m2_a, and its points and lines do not stand for an area",
                   "areas and rasters do; else give frequency_per_a of the whole source");
  return s.frequency_per_m2_a * place.area / rocks;
}

// --- rocks --------------------------------------------------------------------------------------

void check_sizes(const RockfallSection& section) {
  const RockfallSettings& s = section.settings;
  const bool by_law = !std::isnan(s.volume_max_m3);
  const int n_ways = !s.volumes_m3.empty() + by_law + !s.d1_raster.empty();
  if (n_ways > 1)
    section.refuse("says the sizes of its rocks in " + std::to_string(n_ways) + " ways",
                   "give volumes_m3, or volume_max_m3, or d1_raster, d2_raster and d3_raster");
  if (by_law && !(s.volume_max_m3 > s.volume_m3))
    section.refuse(
        "has volume_max_m3 " + text(s.volume_max_m3) + " and " +
            (std::isnan(s.volume_m3) ? "no volume_m3" : "volume_m3 " + text(s.volume_m3)),
        "volume_m3 is the smallest volume of the power law, below volume_max_m3");
}

// Source of rocks with a form of their own: bodies of a mesh, all alike, or joint cells.
JointCells forms_of(const RockfallSection& section) {
  const RockfallSettings& s = section.settings;
  const bool of_cells = s.shape == "joint_cell";
  if (s.file.empty() && !of_cells) return {};
  if (!s.size_m.empty() || !s.d1_raster.empty() || !s.blshape_raster.empty())
    section.refuse("has " + std::string(of_cells ? "joint cells" : "a mesh") +
                       " for its rocks, and the extents of another shape",
                   "leave out size_m, d1_raster and blshape_raster; volume_m3, volumes_m3 and "
                   "volume_max_m3 scale them");
  if (of_cells)
    return cut_joint_cells(section.tool, section.site, static_cast<std::uint64_t>(s.seed),
                           section.where());
  return {mesh_bodies(section, false), {}};
}

const Body& drawn_form(const JointCells& forms, Random& random) {
  if (forms.share_up_to.empty()) return forms.cells[random.below(forms.cells.size())];
  const auto at =
      std::upper_bound(forms.share_up_to.begin(), forms.share_up_to.end() - 1, random.uniform());
  return forms.cells[static_cast<std::size_t>(at - forms.share_up_to.begin())];
}

double drawn_volume(const RockfallSettings& s, Random& random) {
  if (!s.volumes_m3.empty()) return s.volumes_m3[random.below(s.volumes_m3.size())];
  if (std::isnan(s.volume_max_m3)) return s.volume_m3;
  return power_law_volume(random.uniform(), s.volume_m3, s.volume_max_m3, s.volume_exponent);
}

// One body about its centre of mass.
Body rock_of(const RockfallSection& section, const ReleasePlace& place, const JointCells& forms,
             Random& random) {
  BodySettings settings = section.settings;
  settings.volume_m3 = drawn_volume(section.settings, random);
  if (!forms.cells.empty()) {
    std::vector<Body> one = {drawn_form(forms, random)};
    centre(one);
    if (!std::isnan(settings.volume_m3)) scale_to_volume(one, settings.volume_m3);
    return std::move(one.front());
  }
  if (place.shape > 0) settings.shape = place.shape == 1 ? "box" : "rock";
  if (place.extents.x() > 0) {
    settings.size_m = {place.extents.x(), place.extents.y(), place.extents.z()};
    const double box = place.extents.prod();
    settings.volume_m3 = settings.shape == "rock" ? std::numbers::pi / 6 * box : not_given;
  }
  Body body;
  body.parts = {
      shape_of({section.tool, section.site, section.ground, settings, section.path}, random)};
  return body;
}

void add_rock_section(const RockfallSection& section, BlockSet& set) {
  const RockfallSettings& s = section.settings;
  if (s.blshape_raster.empty() || !s.file.empty()) check_form(section);
  check_frequency(section);
  check_sizes(section);
  const std::vector<ReleasePlace> places = places_of(section);
  const JointCells forms = forms_of(section);
  Random random(static_cast<std::uint64_t>(s.seed), "rockfall " + s.name);
  const auto scatter = [&random](double deviation) {
    return deviation > 0 ? Vec3(deviation * Vec3(random.normal(), random.normal(), random.normal()))
                         : Vec3::Zero();
  };
  int n_at_rim = 0;
  for (const ReleasePlace& place : places)
    for (std::int64_t rock = 0; rock < s.rocks; ++rock) {
      std::vector<Body> bodies = {rock_of(section, place, forms, random)};
      Vec3 position = place.position;
      double height = s.height_above_ground_m;
      if (s.height_scatter_m > 0) {
        const double higher = random.uniform(0, s.height_scatter_m);
        if (std::isnan(height) && !std::isnan(position.z()))
          position.z() += higher;
        else
          height = (std::isnan(height) ? 0 : height) + higher;
      }
      if (!put(section, random_rotation(random), position, height, bodies)) {
        if (!is_everywhere(s)) refuse_place(section, position);
        ++n_at_rim;
        continue;
      }
      add_bodies(section, vector_of(s.velocity_m_s) + scatter(s.velocity_scatter_m_s),
                 vector_of(s.spin_rad_s) + scatter(s.spin_scatter_rad_s),
                 weight_of(section, place, places.size()), std::move(bodies), set);
      // once a year is a frequency too
      if (has_frequency(s) && set.weight.empty()) set.weight.assign(set.volume.size(), 1);
    }
  if (n_at_rim > 0)
    section.tool.info(section.path + ": " + counted(n_at_rim, "rock") +
                      " at the rim of the known ground left out");
}

}  // namespace

void add_rocks(Tool& tool, const Site& site, const Trn& ground, BlockSet& set) {
  for (const RockfallSettings& settings : site.rockfalls)
    add_rock_section({{tool, site, ground, settings, "rockfall." + settings.name}, settings}, set);
}

}  // namespace talus
