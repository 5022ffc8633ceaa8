// Stems and canopies of [forest.*], from polygons, rasters and lists.
#include "setup/forest_inputs_gdal.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "base/text.hpp"
#include "base/units.hpp"
#include "base/words.hpp"
#include "blocks/area.hpp"
#include "blocks/prepared_area.hpp"
#include "contact/cylinder_contact.hpp"
#include "geometry/repeated_points.hpp"
#include "scene/stems.hpp"
#include "setup/forest_section.hpp"
#include "setup/site_shapes_gdal.hpp"
#include "terrain/dam.hpp"
#include "terrain/grid_frame.hpp"

namespace talus {
namespace {

using std::size_t;

constexpr double most_stems = 1e6;
constexpr double overlap_tolerance = 1e-3;  // that rounding and stored files explain [m]

// --- valid combinations ------------------------------------------------------------------------

void check_list_keys(const ForestSection& s) {
  for (const char* key : {"polygon", "polygon_file", "stems_per_ha", "dbh_mean_cm", "dbh_std_cm",
                          "conifer_share", "nrtrees_raster", "dbhmean_raster", "dbhstd_raster",
                          "conif_percent_raster", "seed", "new_stand_per_run"})
    if (s.is_given(key))
      s.refuse(std::string("has both stems_file and ") + key,
               "a list says all of its stems: leave " + std::string(key) +
                   " out, or draw a stand without stems_file");
}

void check_stand_keys(const ForestSection& s) {
  s.refuse_both("polygon", "polygon_file");
  s.refuse_both("stems_per_ha", "nrtrees_raster");
  s.refuse_both("dbh_mean_cm", "dbhmean_raster");
  s.refuse_both("dbh_std_cm", "dbhstd_raster");
  s.refuse_both("conifer_share", "conif_percent_raster");
  const ForestSettings& f = s.forest;
  const bool has_raster = !f.nrtrees_raster.empty();
  if (std::isnan(f.stems_per_ha) && !has_raster)
    s.refuse("does not say how many stems there are",
             "give stems_per_ha, nrtrees_raster or stems_file; or drag_kg_s above 0 without any");
  if (!std::isnan(f.stems_per_ha) && f.polygon.empty() && f.polygon_file.empty())
    s.refuse("does not say where it stands", "give polygon, polygon_file or nrtrees_raster");
  for (const char* key : {"dbhmean_raster", "dbhstd_raster", "conif_percent_raster"})
    if (s.is_given(key) && !has_raster)
      s.refuse(std::string("has ") + key + " without nrtrees_raster",
               "give nrtrees_raster, stems on a hectare, on the same cells");
}

void check_drag_keys(const ForestSection& s) {
  for (const char* key : {"stems_per_ha", "nrtrees_raster", "dbhmean_raster", "dbhstd_raster",
                          "conif_percent_raster", "stems_file"})
    if (s.is_given(key))
      s.refuse(
          std::string("has both drag_kg_s and ") + key,
          "drag stands for trees that are not known one by one: leave one of them out, or give "
          "what grows below the stems a section of its own");
  s.refuse_both("polygon", "polygon_file");
  if (s.forest.polygon.empty() && s.forest.polygon_file.empty())
    s.refuse("does not say where it drags", "give polygon or polygon_file");
}

// --- its place --------------------------------------------------------------------------------

// In local coordinates; none where only rasters say it.
std::optional<Area> area_of(const ForestSection& s) {
  const SitePlace place = place_of(s.forest);
  if (place.points.empty() && place.file.empty()) return std::nullopt;
  Area area{shapes_in_plan(s.log, s.site, s.trn, place)};
  if (place.points.empty()) return area;
  area = without_repeated_corners(std::move(area));
  check_area(area, s.trn.origin, where_of(s.site, s.name() + ".polygon"));
  return area;
}

MapBox box_of(const Area& area, const Trn& trn) {
  const MapBox terrain = box_of_terrain(trn);
  MapBox box;
  for (const std::vector<Vec2>& ring : area.rings)
    for (const Vec2& point : ring) box.add(point + trn.origin.head<2>());
  box.low = box.low.cwiseMax(terrain.low);
  box.high = box.high.cwiseMin(terrain.high);
  return box;
}

[[noreturn]] void refuse_outside(const ForestSection& s) {
  s.refuse("lies outside the terrain", "draw it on the terrain, or take a larger window");
}

// --- a stand -----------------------------------------------------------------------------------

std::vector<StockedCell> cells_of_polygon(const ForestSection& s, const MapBox& box) {
  const ForestSettings& f = s.forest;
  const Stocking trees{f.stems_per_ha, f.dbh_mean_cm / 100, f.dbh_std_cm / 100, f.conifer_share};
  std::vector<StockedCell> cells;
  for (const StandCell& cell : stand_cells(box.low, box.high)) cells.push_back({cell, trees});
  return cells;
}

void check_number(const ForestSection& s, const std::optional<Area>& area,
                  const std::vector<StockedCell>& cells) {
  double n = 0, most = 0;
  for (const StockedCell& c : cells) {
    n += c.stocking.stems_per_ha * c.cell.size * c.cell.size / 1e4;
    most = std::max(most, c.stocking.stems_per_ha);
  }
  if (area) n = std::min(n, most * area_of(*area) / 1e4);
  if (n > most_stems)
    s.refuse("has about " + text(n, 3) + " stems, expected up to " + text(most_stems),
             "draw the stand smaller, or check the unit: stems on a hectare");
}

Stem stem_of(const ForestSettings& forest, const Vec3& foot, double dbh, int species) {
  Stem stem;
  stem.foot = foot;
  stem.height = forest.height_m;
  stem.radius = dbh / 2;
  stem.capacity = stem_capacity(known_species()[species].factor, dbh);
  stem.deflection = 0.5;  // over which it takes that energy [m]
  stem.species = species;
  return stem;
}

std::vector<Stem> drawn_stems(const ForestSection& s, std::optional<Area>& area) {
  const ForestSettings& f = s.forest;
  check_stand_keys(s);
  area = area_of(s);
  const MapBox box = area ? box_of(*area, s.trn) : box_of_terrain(s.trn);
  if (box.is_empty()) refuse_outside(s);
  const std::vector<StockedCell> cells =
      f.nrtrees_raster.empty() ? cells_of_polygon(s, box) : cells_of_rasters(s, box);
  check_number(s, area, cells);
  say_stocking(s, cells);
  const StandSeed seed{f.seed, f.name, f.new_stand_per_run ? 1 + s.site.solver.seed : 0};
  const PreparedArea prepared(area ? *area : Area{});
  std::vector<DrawnStem> drawn;
  std::vector<Stem> stems;
  for (const StockedCell& c : cells) {
    drawn.clear();
    draw_cell(seed, c.cell, c.stocking, drawn);
    for (const DrawnStem& stem : drawn) {
      const Vec2 at = stem.at - s.trn.origin.head<2>();
      const double z = elevation_at(s.trn, at.x(), at.y());
      if (std::isnan(z) || (area && !prepared.contains(at))) continue;
      stems.push_back(stem_of(f, Vec3(at.x(), at.y(), z), stem.dbh, stem.is_conifer ? 0 : 1));
      stems.back().id = static_cast<std::int32_t>(stems.size()) - 1;
    }
  }
  return stems;
}

// --- a canopy ----------------------------------------------------------------------------------

Canopy dragging_canopy(const ForestSection& s, std::optional<Area>& area) {
  const ForestSettings& f = s.forest;
  check_drag_keys(s);
  area = area_of(s);
  if (box_of(*area, s.trn).is_empty()) refuse_outside(s);
  s.log.info(s.name() + ": drag of " + text(f.drag_kg_s) + " kg/s on " +
             text(area_of(*area) / 1e4, 3) + " ha");
  return make_canopy(*area, f.height_m, f.drag_kg_s);
}

// --- stands in one place -----------------------------------------------------------------------

/// A section that holds in an area.
struct StandArea {
  std::string name;  ///< "forest.upper"
  bool drags = false;
  Area area;
};

// The share of an area that lies in another one, by 100 x 100 places in the box around it.
double share_within(const Area& area, const Area& other, const Trn& trn) {
  const MapBox box = box_of(area, trn);
  const PreparedArea here(area), there(other);
  int n = 0, n_within = 0;
  for (int row = 0; row < 100; ++row)
    for (int col = 0; col < 100; ++col) {
      const Vec2 share((col + 0.5) / 100, (row + 0.5) / 100);
      const Vec2 at = box.low + share.cwiseProduct(box.high - box.low) - trn.origin.head<2>();
      if (!here.contains(at)) continue;
      ++n;
      n_within += there.contains(at) ? 1 : 0;
    }
  return n == 0 ? 0 : static_cast<double>(n_within) / n;
}

// Two sections may share ground on purpose, species or layers of a wood. A stand that is listed
// twice counts twice. Borders that were drawn twice share slivers.
void add_stand(const ForestSection& s, const std::optional<Area>& area,
               std::vector<StandArea>& stands) {
  constexpr double slivers = 0.05;
  if (!area) return;
  const bool drags = s.forest.drag_kg_s > 0;
  for (const StandArea& other : stands) {
    if (other.drags != drags) continue;
    const double share = share_within(*area, other.area, s.trn);
    if (share > slivers)
      s.warn(percent(share) + " of its area lies in " + other.name + ": there " +
             (drags ? "the drag of both acts" : "the stems of both stand"));
  }
  stands.push_back({s.name(), drags, *area});
}

// --- a list ------------------------------------------------------------------------------------

/// A list of stems as it was read.
struct StemList {
  std::string path;
  VectorShapes points;

  [[nodiscard]] Where where(size_t row) const {
    return {path, 0, "layer " + points.layer + ", stem " + std::to_string(row)};
  }
  [[nodiscard]] const std::string& at(size_t row, size_t field) const {
    return points.attributes[row][field];
  }
};

double diameter_of(const StemList& list, size_t row) {
  const std::string& words = list.at(row, 0);
  char* end = nullptr;
  const double cm = std::strtod(words.c_str(), &end);
  if (!words.empty() && *end == '\0' && cm > 0 && cm <= 1000) return cm / 100;
  throw InputError(
      list.where(row),
      words.empty() ? "has no dbh_cm" : "dbh_cm is " + words + ", expected above 0 to 1000",
      "field dbh_cm holds the diameter at breast height in centimetres; a stem without "
      "one holds nothing");
}

int species_of(const StemList& list, size_t row) {
  const std::string &species = list.at(row, 1), &conifer = list.at(row, 2);
  if (!species.empty()) {
    const int known = species_named(species);
    if (known >= 0) return known;
    std::string names;
    for (const Species& one : known_species())
      names += std::string(names.empty() ? "" : ", ") + one.name;
    throw InputError(list.where(row), "species is " + species, "known are: " + names);
  }
  if (conifer.empty() || conifer == "1" || conifer == "true") return 0;
  if (conifer == "0" || conifer == "false") return 1;
  throw InputError(list.where(row), "conifer is " + conifer + ", expected 1 or 0");
}

constexpr double same_place = 0.01;  // of two stems [m]

// Two stems in one place are one: the thickest is kept.
std::vector<Stem> each_place_once(const ForestSection& s, std::vector<Stem> stems) {
  std::vector<Vec3> feet;
  for (const Stem& stem : stems) feet.push_back(stem.foot);
  const std::vector<int> repeated = repeated_points(feet, same_place);
  std::vector<Stem> kept;
  std::vector<size_t> place_of(stems.size());
  for (size_t i = 0; i < stems.size(); ++i) {
    if (repeated[i] < 0) {
      place_of[i] = kept.size();
      kept.push_back(stems[i]);
    } else if (Stem& known = kept[place_of[repeated[i]]]; stems[i].radius > known.radius) {
      known = stems[i];
    }
  }
  if (kept.size() < stems.size())
    s.warn(std::to_string(stems.size() - kept.size()) + " of " +
           counted(static_cast<std::int64_t>(stems.size()), "stem") +
           " stand where another one does: of each place the thickest is taken");
  return kept;
}

std::vector<Stem> listed_stems(const ForestSection& s) {
  const ForestSettings& f = s.forest;
  check_list_keys(s);
  StemList list{resolved(s.site, f.stems_file), {}};
  list.points = local_shapes(s.log, s.site, s.trn, stems_of(f));
  std::vector<Stem> stems;
  for (size_t row = 0; row < list.points.shapes.size(); ++row) {
    const Vec3& at = list.points.shapes[row][0];
    const double dbh = diameter_of(list, row);
    const int species = species_of(list, row);
    const double z = elevation_at(s.trn, at.x(), at.y());
    if (std::isnan(z)) continue;
    stems.push_back(stem_of(f, Vec3(at.x(), at.y(), z), dbh, species));
    stems.back().id = static_cast<std::int32_t>(row);
  }
  const size_t n = list.points.shapes.size();
  if (!stems.empty() && stems.size() < n)
    s.warn(std::to_string(n - stems.size()) + " of " +
           counted(static_cast<std::int64_t>(n), "stem") + " lie off the known ground, left out");
  return each_place_once(s, std::move(stems));
}

// Stems of a section at places of stems of sections before it: a list given twice.
void check_apart(const ForestSection& s, const std::vector<Stem>& stems,
                 const StandingForests& before) {
  std::vector<Vec3> feet;
  for (const std::vector<Stem>* list : {&before.stems, &stems})
    for (const Stem& stem : *list) feet.push_back(stem.foot);
  const std::vector<int> repeated = repeated_points(feet, same_place);
  const auto n_before = static_cast<std::ptrdiff_t>(before.stems.size());
  const auto first = std::find_if(repeated.begin() + n_before, repeated.end(),
                                  [n_before](int other) { return other >= 0 && other < n_before; });
  if (first == repeated.end()) return;
  const Vec3 at = feet[first - repeated.begin()] + s.trn.origin;
  s.refuse("has a stem where forest." + before.forests[before.stems[*first].section].name +
               " has one, at " + text(at.x(), 9) + ", " + text(at.y(), 9),
           "leave one of the two out: the same stem would stand there twice");
}

// --- stems on dams -----------------------------------------------------------------------------

// A dam is built of earth, a roof of concrete: what stood there was felled.
void leave_out_on_dams(const ForestSection& s, std::vector<Stem>& stems) {
  const std::size_t n = stems.size();
  std::erase_if(stems, [&s](const Stem& stem) { return is_on_a_dam(s.trn, stem.foot.head<2>()); });
  if (stems.size() < n)
    s.warn(std::to_string(n - stems.size()) + " of " +
           counted(static_cast<std::int64_t>(n), "stem") +
           " stand on a dam, in its ditch or on a gallery, left out");
}

// --- stems in blocks ---------------------------------------------------------------------------

/// The blocks where they start, to find stems in them.
struct StartBlocks {
  Hulls hulls;
  PlacedHulls placed;
  BodyGrid grid;

  explicit StartBlocks(const BlockSet& blocks) {
    std::vector<Pose> poses;
    for (const Vec3& centroid : blocks.centroid) poses.push_back({centroid, Quat::Identity()});
    hulls = make_hulls(blocks, poses);
    place_hulls(hulls, poses, {}, {}, placed);
    grid = make_body_grid(blocks.centroid, hulls.radius);
  }

  // The first block that contains a stem, -1: none.
  int block_at(const Stem& stem, std::vector<int>& near) const {
    const VerticalCylinder cylinder{stem.foot.head<2>(), stem.radius, stem.foot.z() + stem.height};
    const Vec3 around = Vec3::Constant(stem.radius);
    find_near(grid, {stem.foot - around, stem.foot + around}, near);
    for (const int b : near)
      for (int p = hulls.part_begin[b]; p < hulls.part_begin[b + 1]; ++p) {
        Vec3 normal;
        std::vector<PairPoint> points;
        if (find_cylinder_contact(hulls, placed, p, cylinder, -overlap_tolerance, normal, points) >
            0)
          return b;
      }
    return -1;
  }
};

// A listed stem in a block is a mistake; of a drawn stand those are left out.
void leave_out_in_blocks(const ForestSection& s, const StartBlocks& blocks,
                         std::vector<Stem>& stems) {
  std::vector<int> near;
  std::vector<Stem> free;
  for (const Stem& stem : stems) {
    const int block = blocks.block_at(stem, near);
    if (block < 0) {
      free.push_back(stem);
      continue;
    }
    if (s.forest.stems_file.empty()) continue;
    const Vec3 at = stem.foot + s.trn.origin;
    throw InputError(
        {resolved(s.site, s.forest.stems_file), 0, "stem " + std::to_string(stem.id)},
        "stands in block " + std::to_string(block) + " at the start, at " + text(at.x(), 9) + ", " +
            text(at.y(), 9),
        "leave out what stands in the source, e.g. by stems_file = \"FILE|subset=FILTER\"");
  }
  if (free.size() < stems.size())
    s.warn(std::to_string(stems.size() - free.size()) + " of " +
           counted(static_cast<std::int64_t>(stems.size()), "stem") +
           " stand in blocks at the start, left out");
  stems = std::move(free);
}

}  // namespace

StandingForests read_forests(InputLog& log, const Site& site, const Trn& trn,
                             const BlockSet& blocks) {
  StandingForests out;
  std::optional<StartBlocks> start;
  std::vector<StandArea> stands;
  for (const ForestSettings& forest : site.forests) {
    if (!forest.active || site.solver.law != "talus") continue;
    const ForestSection s{log, site, trn, forest, out.warnings};
    std::optional<Area> area;
    if (forest.drag_kg_s > 0) {
      out.canopies.push_back(dragging_canopy(s, area));
      add_stand(s, area, stands);
      continue;
    }
    std::vector<Stem> stems = forest.stems_file.empty() ? drawn_stems(s, area) : listed_stems(s);
    add_stand(s, area, stands);
    if (stems.empty() && !(forest.stems_per_ha == 0))
      s.refuse("has no stem on the terrain",
               "check where it lies, and how many stems on a hectare there are");
    leave_out_on_dams(s, stems);
    say_stems(s, stems);
    if (!forest.stems_file.empty()) check_apart(s, stems, out);
    if (!start) start.emplace(blocks);
    leave_out_in_blocks(s, *start, stems);
    for (Stem& stem : stems) stem.section = static_cast<std::int32_t>(out.forests.size());
    out.forests.push_back({forest.name, static_cast<std::int32_t>(stems.size())});
    GroundClass face;
    face.friction = std::tan(forest.friction_deg * degree);
    out.faces.push_back(face);
    out.stems.insert(out.stems.end(), stems.begin(), stems.end());
  }
  return out;
}

}  // namespace talus
