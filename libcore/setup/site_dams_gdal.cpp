// Burns the [dam.*] of a site into its terrain.
#include "setup/site_dams_gdal.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string>

#include "base/text.hpp"
#include "base/units.hpp"
#include "geometry/plan2d.hpp"
#include "scene/site_fence.hpp"
#include "setup/site_shapes_gdal.hpp"
#include "terrain/extent_text.hpp"

namespace talus {
namespace {

constexpr double cells_of_a_part = 2;  // fewer do not show how wide it is
constexpr double other_height = 0.25;  // of the height, that the crest may be off it between points

constexpr const char* other_terrain_hint = "make the terrain again, with this site file";

Where where_of_dam(const Site& site, const DamSettings& dam) {
  return {site.file, dam.line_number, "dam." + dam.name};
}

// All that the ground with it depends on, to the millimetre.
std::string shape_words(const DamShape& shape, const Trn& trn) {
  std::string words = std::string(shape.is_gallery ? "gallery" : "dam");
  for (const double value : {shape.height, shape.crest_width, shape.tan_uphill, shape.tan_downhill,
                             shape.ditch_depth, shape.ditch_width})
    words += " " + text(value, 6);
  for (const Vec2& p : shape.line) words += "; " + place_text(p, trn.origin);
  return words;
}

InputError error_of(const DamFault& fault, const Where& where, const DamSettings& s,
                    const Trn& trn) {
  const std::string at = " at " + place_text(fault.at, trn.origin);
  const auto face = [&](const char* name, double slope_deg) {
    return std::string("the ") + name + " of " + text(slope_deg, 4) +
           " degrees does not meet the ground within ten heights of the line,";
  };
  switch (fault.kind) {
    case DamFault::uphill_face:
      return {where, face("uphill face", s.slopes_deg[0]) + at,
              "draw the line where the ground rises on one side of it"};
    case DamFault::downhill_face:
      return {where, face("downhill face", s.slopes_deg[1]) + at,
              "the ground falls nearly as steeply: a steeper face (slopes_deg), or flatter ground"};
    case DamFault::ditch_side:
      return {where, face("far side of the ditch", s.slopes_deg[1]) + at,
              "the ground rises nearly as steeply: a steeper downhill face, which the ditch's far "
              "side is as steep as (slopes_deg), or no ditch"};
    default:
      return {where, "reaches beyond the known ground" + at + "; " + extent_text(trn),
              "make the terrain larger, or move the dam"};
  }
}

Doubt doubt_on_cells(const Where& where, const std::string& key, const std::string& finding,
                     double wide, double low, const Trn& trn, const Vec2& at) {
  Doubt doubt;
  doubt.where = {where.file, where.line};
  doubt.what = where.item + "." + key;
  doubt.found = text(wide, 3) + " m on cells of " + text(trn.cell_size, 3) + " m: " + finding;
  doubt.expected = "at least " + text(low, 3) + " m";
  doubt.hint = "a finer elevation model; of contours, terrain.cell_size_m";
  const Vec2 place = at + trn.origin.head<2>();
  doubt.at = {{place.x(), place.y(), Doubt::none}};
  doubt.value = wide;
  doubt.low = low;
  return doubt;
}

// Whether the side that is taken as uphill may be the wrong one.
std::vector<Doubt> doubts_on_side(const DamShape& shape, const Where& where, const Trn& ground) {
  const SideRise rise = rise_to_the_left(ground, shape);
  const bool is_level = std::abs(rise.mean) < other_height * shape.height;
  if (!is_level && rise.other_share == 0) return {};
  const bool left = rise.mean >= 0;
  std::string finding = std::string("uphill is taken to be ") + (left ? "left" : "right") +
                        " of the line seen from its first point, where the ground lies " +
                        text(std::abs(rise.mean), 2) + " m higher than on the other side, " +
                        text(side_distance(shape), 3) + " m from the line";
  if (rise.other_share > 0)
    finding += "; along " + text(std::round(100 * rise.other_share)) + " % of it it lies lower";
  return {doubt_on(where, std::move(finding),
                   "is it there that blocks come from? If not, draw the line where the ground "
                   "rises on that side")};
}

// Doubts: shapes that the cells cannot represent, and heights along the line that differ.
std::vector<Doubt> doubts_on(const BuiltDam& built, const Where& where, const Trn& trn) {
  const DamShape& shape = built.dam.shape;
  const DamBurn& burn = built.burn;
  const Vec2 first = shape.line.front();
  const double least = cells_of_a_part * trn.cell_size;
  const std::string crest = shape.is_gallery ? "roof" : "crest";
  const std::string held = shape.is_gallery
                               ? ""
                               : " and holds " + text(std::round(burn.in_cells.fill)) + " of its " +
                                     text(std::round(burn.designed.fill)) + " m3";
  std::vector<Doubt> doubts;
  if (shape.crest_width < least)
    doubts.push_back(doubt_on_cells(
        where, "crest_width_m",
        "the terrain lies up to " + text(burn.crest_loss, 3) + " m below the " + crest + held,
        shape.crest_width, least, trn, burn.crest_loss_at));
  if (shape.ditch_depth > 0 && shape.ditch_width < least)
    doubts.push_back(doubt_on_cells(where, "ditch_m",
                                    "the terrain has " + text(std::round(burn.in_cells.cut)) +
                                        " of its " + text(std::round(burn.designed.cut)) + " m3",
                                    shape.ditch_width, least, trn, first));
  const double run = shape.height / shape.tan_uphill;
  if (!shape.is_gallery && run < trn.cell_size)
    doubts.push_back(doubt_on_cells(
        where, "slopes_deg",
        "the uphill face runs so far in plan; in the cells it is at most " +
            text(std::atan(shape.height / trn.cell_size) / degree, 3) + " degrees steep",
        run, trn.cell_size, trn, first));
  const double off =
      std::max(built.dam.most_height - shape.height, shape.height - built.dam.least_height);
  if (off > other_height * shape.height) {
    Doubt doubt = doubt_on(where,
                           "the " + crest + " stands " + text(built.dam.least_height, 3) + " to " +
                               text(built.dam.most_height, 3) +
                               " m above the ground between the points of its line, height_m is " +
                               text(shape.height, 3),
                           "give the line more points: the " + crest + " is straight between them");
    doubts.push_back(std::move(doubt));
  }
  return doubts;
}

void check_share_no_node(const Site& site, const DamSettings& settings, const BuiltDam& built,
                         const Trn& trn, std::map<int, std::string>& dam_of_node) {
  for (const int node : built.burn.nodes) {
    const auto [known, is_new] = dam_of_node.emplace(node, built.name);
    if (is_new) continue;
    const Vec3 at = node_point(trn, node / trn.n_cols, node % trn.n_cols);
    throw InputError(
        where_of_dam(site, settings),
        "shares ground with dam." + known->second + " at " + place_text(at.head<2>(), trn.origin),
        "draw them as one line, or farther apart");
  }
}

// The faces of a gallery are vertical, it has no ditch, and nothing judges its strength.
void check_gallery_keys(const Where& where, const DamSettings& settings) {
  if (settings.kind != "gallery") return;
  const auto refuse = [&where](const char* key) {
    throw InputError(where, std::string("is a gallery with ") + key,
                     std::string("leave ") + key + " out: it is of dams");
  };
  if (settings.slopes_deg != DamSettings{}.slopes_deg) refuse("slopes_deg");
  if (!settings.ditch_m.empty()) refuse("ditch_m");
  if (!std::isnan(settings.capacity_kj)) refuse("capacity_kj");
}

}  // namespace

std::vector<SiteDam> dams_of(InputLog& log, const Site& site, const Trn& trn,
                             const DamSettings& settings) {
  const Where where = where_of_dam(site, settings);
  if (settings.line.empty() == settings.file.empty())
    throw InputError(where, settings.line.empty() ? "has no line" : "has both line and file",
                     "give one of line and file");
  check_gallery_keys(where, settings);
  DamShape shape;
  shape.is_gallery = settings.kind == "gallery";
  shape.height = settings.height_m;
  shape.crest_width = settings.crest_width_m;
  shape.tan_uphill = tangent_of_degrees(settings.slopes_deg[0]);
  shape.tan_downhill = tangent_of_degrees(settings.slopes_deg[1]);
  if (!settings.ditch_m.empty()) {
    shape.ditch_depth = settings.ditch_m[0];
    shape.ditch_width = settings.ditch_m[1];
  }
  std::vector<SiteDam> dams;
  const auto lines = local_shapes(log, site, trn, place_of(settings)).shapes;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    shape.line.clear();
    std::vector<Vec3> points;
    for (const Vec3& p : lines[i])
      if (shape.line.empty() || shape.line.back() != p.head<2>()) {
        shape.line.push_back(p.head<2>());
        points.emplace_back(p.x(), p.y(), 0);
      }
    if (points.size() < 2)
      throw InputError(where, "has a line with one point",
                       "a " + settings.kind + " needs two points");
    check_no_crossing(trn, points, where);
    dams.push_back({settings.name + (lines.size() > 1 ? "." + std::to_string(i + 1) : ""), shape});
  }
  return dams;
}

std::vector<BuiltDam> build_dams(InputLog& log, const Site& site, Trn& trn) {
  const Trn ground = trn;
  std::map<int, std::string> dam_of_node;
  std::vector<BuiltDam> all;
  for (const DamSettings& settings : site.dams) {
    const Where where = where_of_dam(site, settings);
    for (const SiteDam& planned : dams_of(log, site, ground, settings)) {
      if (!settings.active) continue;
      BuiltDam built{planned.name, {}, {}};
      built.burn.fault = lay_dam(ground, planned.shape, built.dam);
      if (built.burn.fault.kind == DamFault::none) built.burn = burn_dam(built.dam, trn);
      if (built.burn.fault.kind != DamFault::none)
        throw error_of(built.burn.fault, where, settings, trn);
      check_share_no_node(site, settings, built, trn, dam_of_node);
      log.doubts(doubts_on(built, where, trn));
      log.doubts(doubts_on_side(planned.shape, where, ground));
      BurntDam burnt{
          built.name, built.dam.uphill, {}, built.burn.nodes, shape_words(planned.shape, ground)};
      for (const Vec3& p : built.dam.crest) burnt.crest.push_back(p.z());
      trn.dams.push_back(std::move(burnt));
      all.push_back(std::move(built));
    }
  }
  return all;
}

namespace {

// Height of the crest across the nearest place of the line.
double crest_at(const DamShape& shape, const std::vector<double>& crest, const Vec2& at) {
  double nearest = std::numeric_limits<double>::infinity(), height = 0;
  for (std::size_t i = 0; i + 1 < shape.line.size(); ++i) {
    const Vec2 &a = shape.line[i], &b = shape.line[i + 1];
    const double share = share_along_segment<Vec2>(at, a, b);
    const double off = (at - a - share * (b - a)).norm();
    if (!(off < nearest)) continue;
    nearest = off;
    height = crest[i] + share * (crest[i + 1] - crest[i]);
  }
  return height;
}

const BurntDam* burnt_in(const Trn& trn, const SiteDam& dam) {
  for (const BurntDam& burnt : trn.dams)
    if (burnt.name == dam.name && burnt.shape == shape_words(dam.shape, trn)) return &burnt;
  return nullptr;
}

}  // namespace

WatchedDams watched_dams(InputLog& log, const Site& site, const Trn& trn) {
  constexpr double spacing = 10;
  WatchedDams all;
  std::set<std::string> active;
  for (const DamSettings& settings : site.dams) {
    if (!settings.active) continue;
    const Where where = where_of_dam(site, settings);
    for (const SiteDam& dam : dams_of(log, site, trn, settings)) {
      const DamShape& shape = dam.shape;
      const BurntDam* const found = burnt_in(trn, dam);
      active.insert(dam.name);
      if (found == nullptr) {
        if (!all.other_ground)
          all.other_ground.emplace(
              where, "is active, and the terrain was made without it or with another shape of it",
              other_terrain_hint);
        continue;
      }
      const BurntDam& burnt = *found;
      const auto edge_at = [&](double off, const std::string& name) {
        std::vector<Vec3> posts = posts_on_ground(
            trn, off == 0 ? shape.line : line_beside(shape.line, burnt.uphill * off), spacing,
            where);
        if (shape.is_gallery)  // at the edge itself the terrain falls from the roof
          for (Vec3& post : posts)
            post.z() = std::max(post.z(), crest_at(shape, burnt.crest, post.head<2>()));
        return record_line(name, std::move(posts));
      };
      const double edge = shape.crest_width / 2;
      // half the height more: the centroid of a block that touches the face has crossed the line
      const double before =
          shape.is_gallery ? edge : edge + shape.height / shape.tan_uphill + shape.height / 2;
      const std::string name =
          std::string(shape.is_gallery ? gallery_prefix : dam_prefix) + dam.name;
      all.dams.push_back({&settings, edge_at(shape.is_gallery ? -edge : 0, name),
                          edge_at(before, name + std::string(before_dam)), burnt.uphill});
      if (!shape.is_gallery) continue;
      all.dams.back().crest.roof = roof_pieces(trn, shape);
      all.dams.back().crest.roof_nodes = burnt.nodes;
    }
  }
  for (const BurntDam& burnt : trn.dams)
    if (!all.other_ground && !active.contains(burnt.name))
      all.other_ground.emplace(Where{site.file, 0, "dam." + burnt.name},
                               "is in the ground of the terrain, and not active here",
                               other_terrain_hint);
  return all;
}

std::vector<RoofPiece> gallery_roofs(InputLog& log, const Site& site, const Trn& trn) {
  std::vector<RoofPiece> roofs;
  for (const DamSettings& settings : site.dams) {
    if (!settings.active || settings.kind != "gallery") continue;
    for (const SiteDam& gallery : dams_of(log, site, trn, settings))
      for (RoofPiece& piece : roof_pieces(trn, gallery.shape)) roofs.push_back(std::move(piece));
  }
  return roofs;
}

std::string sentence_on(const BuiltDam& built) {
  const Dam& dam = built.dam;
  const auto volumes = [](const Earthwork& work, bool has_cut) {
    return "fill " + text(std::round(work.fill)) + " m3" +
           (has_cut ? ", cut " + text(std::round(work.cut)) + " m3" : "");
  };
  const bool has_cut = dam.shape.ditch_depth > 0;
  if (dam.shape.is_gallery)
    return "gallery " + built.name + ": " + text(length_of(dam.shape.line), 4) + " m long, " +
           text(dam.shape.crest_width, 3) + " m wide, roof " + text(dam.least_height, 3) + " to " +
           text(dam.most_height, 3) + " m above the ground; in the cells up to " +
           text(built.burn.crest_loss, 2) + " m lower, its sides a cell wide";
  return "dam " + built.name + ": " + text(length_of(dam.shape.line), 4) + " m long, crest " +
         text(dam.least_height, 3) + " to " + text(dam.most_height, 3) + " m above the ground, " +
         volumes(built.burn.designed, has_cut) + "; in the cells " +
         volumes(built.burn.in_cells, has_cut) + ", the crest up to " +
         text(built.burn.crest_loss, 2) + " m lower";
}

}  // namespace talus
