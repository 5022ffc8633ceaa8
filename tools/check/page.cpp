// The page of talus-check, with its pictures.
#include "tools/check/page.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "base/grouped_text.hpp"
#include "base/text.hpp"
#include "base/units.hpp"
#include "base/words.hpp"
#include "geometry/convex_outline.hpp"
#include "geometry/plan2d.hpp"
#include "io/block_pictures.hpp"
#include "report/check_view.hpp"
#include "report/html.hpp"
#include "setup/site_places_gdal.hpp"
#include "tools/check/inputs.hpp"
#include "tools/check/words.hpp"
#include "tools/frame/failure_plane_choice.hpp"

namespace talus {
namespace {

// Each line of a text as an item.
std::string lines_of(const std::string& words) {
  std::string out = "<ul>\n<li>";
  for (const char c : xml_escaped(words)) c == '\n' ? out += "</li>\n<li>" : out += c;
  return out + "</li>\n</ul>\n";
}

std::string motion_section(const Look& look) {
  std::string facts;
  if (look.is_probed) {
    const double share = look.probe.moved_share;
    facts += html_fact(
        percent(share),
        (moves_alone(look.work.site) ? "of the rocks move after " : "of the mass moves after ") +
            text(look.probe.time, 3) + " s of the engine: it " + text(outlook_of(share)),
        share < 0.1 ? "two bad" : "two");
  }
  if (look.is_cut) {
    facts += html_fact(percent(look.peel.share),
                       "can slide or fall off, one block at a time and without a push");
    facts += html_fact(look.step > 0.1 ? text(look.step, 2) + " m" : "none",
                       look.step > 0.1 ? "highest step at the foot; " + percent(look.step_share) +
                                             " of the foot has one of more than " +
                                             text(look.low_step, 2) + " m, which holds blocks"
                                       : "step at the foot");
    facts += html_fact(text(look.equilibrium.factor, 2),
                       "factor of safety of the mass as one; says little of the share that goes");
  }
  std::string out = "<div class=\"facts\">\n" + facts + "</div>\n";
  if (moves_alone(look.work.site)) return html_section("motion", "Will it move?", out);
  out += lines_of(motion_text(look));
  if (!look.is_cut) return html_section("motion", "Will it move?", out);
  const std::string planes =
      planes_text(look.work.planes, look.inputs.origin) +
      wedges_text(look.work.wedges, look.work.planes.best < 0, look.work.wedge);
  return html_section("motion", "Will it move?",
                      out + "<h3>Planes and wedges that daylight</h3>\n" + lines_of(planes));
}

// --- pictures ----------------------------------------------------------------------------------

BlockOutlook outlook_of_block(const Look& look, int b) {
  const bool holds =
      !look.peel.locks.empty() &&
      std::any_of(look.peel.locks.begin(), look.peel.locks.end(),
                  [b](const Lock& lock) { return lock.block == b && lock.freed >= 0.01; });
  if (look.is_probed)
    return look.probe.goes[b] ? BlockOutlook::goes
           : holds            ? BlockOutlook::holds_others
                              : BlockOutlook::stays;
  if (!look.is_cut) return BlockOutlook::goes;
  return look.peel.round[b] >= 0 ? BlockOutlook::goes
         : holds                 ? BlockOutlook::holds_others
                                 : BlockOutlook::stays;
}

std::vector<OutlinedBlock> outlined_blocks(const Look& look) {
  const BlockSet& set = look.inputs.parts.blocks;
  std::vector<OutlinedBlock> blocks;
  for (int b = 0; b < n_blocks(set); ++b) {
    std::vector<Vec2> corners;
    for (int v = set.block_vertex_begin[b]; v < set.block_vertex_begin[b + 1]; ++v)
      corners.emplace_back(set.vertices[v].head<2>());
    blocks.push_back({convex_outline(corners), outlook_of_block(look, b),
                      "block " + std::to_string(b) + ", " + grouped_text(set.volume[b]) + " m3"});
  }
  return blocks;
}

Vec2 middle_of(const Look& look) {
  Vec2 sum = Vec2::Zero();
  double volume = 0;
  const BlockSet& set = look.inputs.parts.blocks;
  for (int b = 0; b < n_blocks(set); ++b) {
    sum += set.volume[b] * set.centroid[b].head<2>();
    volume += set.volume[b];
  }
  return sum / volume;
}

Vec2 direction_of_motion(const Look& look) {
  const double azimuth = look.is_cut ? look.motion : look.slope.dip_direction;
  return {std::sin(azimuth), std::cos(azimuth)};
}

// How far the source reaches from its middle, along the motion [m].
double half_of_source(const Look& look) {
  const Vec2 down = direction_of_motion(look), middle = middle_of(look);
  double half = look.work.ground.cell_size * 5;
  for (const auto& ring : look.work.area.rings)
    for (const Vec2& p : ring) half = std::max(half, std::abs((p - middle).dot(down)));
  return half;
}

// Straight down over the source alone.
std::vector<Vec2> section_of_source(const Look& look) {
  const Vec2 reach = 1.6 * half_of_source(look) * direction_of_motion(look);
  return {middle_of(look) - reach, middle_of(look) + reach};
}

// Straight down over the source, then along the longest fall line.
std::vector<Vec2> section_line(const Look& look) {
  const Vec2 down = direction_of_motion(look), middle = middle_of(look);
  const double half = half_of_source(look);
  std::vector<Vec2> line = {middle - 1.6 * half * down, middle};
  const auto nearest = std::min_element(
      look.slides.begin(), look.slides.end(), [&](const SliderPath& a, const SliderPath& b) {
        return (a.points.front() - middle).norm() < (b.points.front() - middle).norm();
      });
  const bool has_path = nearest != look.slides.end() && nearest->path > half;
  if (has_path) {
    const double ahead = (nearest->points.front() - middle).dot(down);
    for (const Vec2& p : nearest->points)
      if ((p - middle).dot(down) > std::max(0.0, ahead) + look.work.ground.cell_size)
        line.push_back(p);
  }
  if (!has_path || line.size() < 3) line.emplace_back(middle + 3 * half * down);
  return line;
}

CheckView view_of(const Look& look, const std::vector<Doubt>& doubts) {
  CheckView view;
  view.doubts = marks_of(doubts, look.work.ground.origin);
  view.source = look.work.area.rings;
  for (const FenceLook& fence : look.fences) view.fences.push_back({fence.line, fence.height});
  view.cell_class = look.inputs.parts.cell_class;
  for (const SliderPath& slide : look.slides)
    if (slide.points.size() > 1) view.fall_lines.push_back(slide.points);
  view.blocks = outlined_blocks(look);
  for (const FootStep& at : look.foot)
    view.foot.push_back({at.place, at.height, at.height > look.low_step});
  if (n_blocks(look.inputs.parts.blocks) > 0) view.section = section_line(look);
  for (const ObjectLook& object : look.objects)
    view.objects.push_back(
        {object.object.name, "object " + object.object.name, polygons_of(object.object)});
  for (const OutlinedSurface& surface : look.surfaces)
    view.surfaces.push_back({surface.sets,
                             (surface.is_wedge ? "wedge of " : "plane of ") + title_of(surface),
                             surface.polygons});
  return view;
}

// Key of the things that the map shows, and only these.
std::string map_key(const CheckView& view) {
  const auto has = [&](BlockOutlook outlook) {
    return std::ranges::any_of(view.blocks, [&](const auto& b) { return b.outlook == outlook; });
  };
  const auto& classes = view.cell_class;
  const std::pair<bool, std::string> keys[] = {
      {has(BlockOutlook::goes), "<i class=\"goes\"></i>block that moves"},
      {has(BlockOutlook::stays), "<i class=\"stays\"></i>block that stays"},
      {has(BlockOutlook::holds_others), "<i class=\"holds\"></i>block that holds others"},
      {!view.source.empty(), "<i class=\"source-key\"></i>source"},
      {!view.fall_lines.empty(), "<i class=\"fall-key\"></i>fall lines"},
      {!view.section.empty(), "<i class=\"section-key\"></i>section"},
      {!view.fences.empty(), "<i class=\"fence\"></i>fence"},
      {!view.foot.empty(),
       "dots along the foot: green where the failure surface comes out, red where the mass leans "
       "on "
       "a step that is not low for its blocks"},
      {std::ranges::adjacent_find(classes, std::not_equal_to()) != classes.end(),
       "dashed: border of ground classes"}};
  std::string words;
  for (const auto& [is_there, key] : keys)
    if (is_there) words += (words.empty() ? "" : "; ") + key;
  return "<span class=\"key\">" + words + ".</span>";
}

// The interval is that of the map; each fifth contour is bold.
std::string caption_of_map(const CheckView& view, const MapGround& part) {
  std::string words = map_key(view);
  if (!view.surfaces.empty())
    words +=
        " <span class=\"key\"><i class=\"proposed-key\"></i>mass that could leave on a plane or "
        "wedge of the joint sets (<code>make source</code>: source.gpkg).</span>";
  std::string far;
  for (const NamedArea& object : view.objects)
    if (!is_drawn(object, part.view)) far += (far.empty() ? "" : ", ") + xml_escaped(object.name);
  if (!view.doubts.empty())
    words +=
        " <span class=\"key\"><i class=\"doubt-key\"></i>place of the doubt with this "
        "number.</span>";
  if (!view.objects.empty())
    words += " <span class=\"key\"><i class=\"object-key\"></i>object.</span>";
  if (!far.empty()) words += " Beyond the map: " + far + ".";
  return words + " Contours every " + text(part.contour_interval) + " m.";
}

// Where the fall lines are long, the mass is a speck in their section: it gets one of its own.
std::string section_figures(const Look& look, CheckView view) {
  const Trn &ground = look.work.ground, &bed = look.inputs.parts.trn;
  const Chart along = section_chart(view, ground, bed);
  if (along.series.empty()) return "";
  std::string out = html_figure(
      chart_svg(along),
      std::string("Section along the motion, heights and lengths at one scale") +
          (look.is_cut ? ": what lies between the ground and the failure surface is the "
                         "mass."
                       : "."));
  const std::vector<Vec2> near = section_of_source(look);
  if (!look.is_cut || length_of(view.section) < 3 * length_of(near)) return out;
  view.section = near;
  return out + html_figure(chart_svg(section_chart(view, ground, bed)), "The same at the source.");
}

std::string map_section(const Look& look, const std::vector<Doubt>& doubts) {
  CheckView view = view_of(look, doubts);
  const MapGround part = check_ground(view, look.work.ground);
  std::string out = html_figure(svg_of(check_map(view, look.work.ground, part), "plan"),
                                caption_of_map(view, part));
  out += section_figures(look, std::move(view));
  return html_section("map", "Map and section", out);
}

std::string kinematics_section(const Look& look) {
  if (!look.is_cut) return "";
  const Kinematics &face = look.kinematics, &smooth = look.smooth_kinematics;
  const auto cell = [](const FaceShare& a, const FaceShare& b) {
    const std::string spread =
        a.p10 == a.p90 ? "" : " (" + percent(a.p10) + " to " + percent(a.p90) + ")";
    return percent(a.mean) + spread + ", " + percent(b.mean);
  };
  std::vector<std::vector<std::string>> rows;
  for (size_t s = 0; s < face.sets.size(); ++s)
    rows.push_back({xml_escaped(face.sets[s].name),
                    cell(face.sets[s].sliding, smooth.sets[s].sliding),
                    cell(face.sets[s].sliding_lateral, smooth.sets[s].sliding_lateral),
                    cell(face.sets[s].toppling, smooth.sets[s].toppling), ""});
  std::vector<NetLine> lines;
  for (size_t p = 0; p < face.pairs.size(); ++p) {
    const PairKinematics& pair = face.pairs[p];
    const std::string name = face.sets[pair.first].name + " + " + face.sets[pair.second].name;
    rows.push_back({xml_escaped(name), cell(pair.sliding, smooth.pairs[p].sliding), "",
                    cell(pair.toppling, smooth.pairs[p].toppling),
                    pair.wedge.on_both ? text(pair.wedge.factor, 3) : "on one plane"});
    if (!pair.wedge.line.isZero())
      lines.push_back({name, pair.wedge.line, pair.sliding.mean > 0.005});
  }
  std::vector<NetSet> net;
  for (const PlannedSet& planned : look.work.sets)
    net.push_back({planned.set.name, pole(planned.set.dip, planned.set.dip_direction),
                   planned.measured_poles.empty()
                       ? std::vector<Vec3>{pole(planned.set.dip, planned.set.dip_direction)}
                       : planned.measured_poles});
  const NetZones zones{look.slope.dip, look.slope.dip_direction, look.work.planes.friction,
                       lateral_limit_deg * degree, toppling_limit_deg * degree};
  return html_section(
      "kinematics", "Joints against the face",
      html_paragraph(
          "Shares of the face, by area, on which a set or a pair of sets is free; second "
          "number: of means of 3 x 3 nodes. They look at the face alone. What holds a "
          "mass is the bed at its foot.") +
          html_table({"Set or pair", "slides", "slides within 20&deg; of the fall line", "topples",
                      "factor of safety"},
                     rows) +
          html_figure(svg_of(kinematic_net(net, pole(look.slope.dip, look.slope.dip_direction),
                                           zones, lines),
                             "net"),
                      "Stereonet of the mean sets and of the mean slope."));
}

std::string locks_section(const Look& look) {
  if (look.peel.locks.empty()) return "";
  const BlockSet& set = look.inputs.parts.blocks;
  std::vector<std::vector<std::string>> rows;
  for (size_t k = 0; k < std::min<size_t>(10, look.peel.locks.size()); ++k) {
    const Lock& lock = look.peel.locks[k];
    const Vec3 at = set.centroid[lock.block] + look.inputs.origin;
    const BlockMode& mode = look.peel.mode[lock.block];
    rows.push_back({std::to_string(lock.block), text(set.volume[lock.block], 3),
                    text(std::round(at.x())) + ", " + text(std::round(at.y())) + ", " +
                        text(std::round(at.z())),
                    mode.is_free() ? "friction, factor " + text(mode.factor(), 3) : "no way out",
                    percent(lock.freed)});
  }
  return html_section(
      "locks", "Blocks that hold others",
      html_table({"Block", "m&sup3;", "x, y, z [m]", "held by", "of the mass that it alone holds"},
                 rows, {true, true, false, false, true}));
}

std::string fence_section(const Look& look) {
  if (look.fences.empty()) return "";
  std::vector<std::vector<std::string>> rows;
  for (const FenceLook& fence : look.fences)
    rows.push_back(
        {xml_escaped(fence.line.name),
         is_gallery(fence.line) ? "valley edge of the roof"
         : fence.is_dam         ? "crest"
         : fence.stands         ? "stands"
                                : "line only",
         grouped_text(fence.line.chainage.back()), fence.is_dam ? "" : text(fence.height, 3),
         text(std::round(fence.low + look.inputs.origin.z())) + " to " +
             text(std::round(fence.high + look.inputs.origin.z())),
         std::to_string(fence.n_fall_lines) + " of " + std::to_string(look.slides.size())});
  return html_section("fences", "Protective structures",
                      html_table({"Line", "", "length [m]", "height [m]", "base at [m]",
                                  "fall lines that come to it"},
                                 rows, {false, false, true, true, false, false}) +
                          html_note("A mass spreads beside its fall lines: what none "
                                    "comes to may still be reached."));
}

std::string object_section(const Look& look) {
  if (look.objects.empty()) return "";
  std::vector<std::vector<std::string>> rows;
  for (const ObjectLook& object : look.objects)
    rows.push_back(
        {xml_escaped(object.object.name), xml_escaped(object.object.kind),
         grouped_text(object.distance, 3),
         std::to_string(object.n_fall_lines) + " of " + std::to_string(look.slides.size())});
  return html_section(
      "objects", "Objects",
      html_table({"Object", "kind", "from the mass, in plan [m]", "fall lines that come to it"},
                 rows, {false, false, true, false}) +
          html_note("Fall lines are those of points that slide; blocks that roll and bounce go "
                    "farther. An object that none comes to is not safe for that."));
}

std::string source_section(const Look& look) {
  if (!look.is_cut) return "";
  const auto cubic = [](double volume) { return grouped_text(volume, 4); };
  const auto metres = [](double length) { return grouped_text(length); };
  const std::vector<std::vector<std::string>> rows = {
      {"volume of the blocks [m&sup3;]", cubic(look.volume.cut)},
      {"between ground and failure surface [m&sup3;]", cubic(look.volume.prism)},
      {"area of the polygon times mean depth at its nodes [m&sup3;]", cubic(look.volume.nodes)},
      {"area of the polygon [m&sup2;]", cubic(area_of(look.work.area))},
      {"mean depth, vertical [m]", metres(look.mean_depth)},
      {"largest depth, vertical [m]", metres(look.measure.max_depth)},
      {"relief over the mass [m]", metres(look.relief)},
      {"blocks", std::to_string(n_blocks(look.inputs.parts.blocks))}};
  return html_section("source", "Source", html_table({"", ""}, rows, {false, true}));
}

// Where each input lies on the whole terrain; a wrong unit, zone or file shows here.
std::string inputs_section(const Look& look, const CheckPage& page) {
  const Trn& ground = look.work.ground;
  CheckView view = view_of(look, page.doubts);
  const std::vector<ViewedInput> inputs = viewed_inputs(look, page.reports);
  std::string far;
  for (const ViewedInput& input : inputs)
    if (is_far(input, ground)) far += (far.empty() ? "" : ", ") + xml_escaped(input.title);
  std::string caption =
      "All inputs over the terrain. <span class=\"key\"><i class=\"input-key\"></i>extent of an "
      "input.</span>";
  if (!far.empty()) caption += " Far beyond the map: " + far + ".";
  return html_section("inputs", "Inputs",
                      html_figure(svg_of(inputs_map(view, inputs, ground), "plan"), caption));
}

std::string whole_page(const Look& look, const CheckPage& page, const std::string& sections) {
  const std::string name = xml_escaped(look.work.site.info.name);
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta "
         "name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
         name + ": a look before the run</title>\n<link rel=\"icon\" href=\"data:,\">\n<style>\n" +
         page.style + "</style>\n</head>\n<body>\n<header>\n<h1>" + name +
         "</h1>\n<p class=\"soft\">A look before the run, id <code>" + page.run_id +
         "</code></p>\n</header>\n<main>\n" +
         html_section("doubts", "Doubts",
                      doubts_html(page.doubts, "Nothing looks other than it should.")) +
         sections + "</main>\n</body>\n</html>\n";
}

}  // namespace

std::string check_page(const Look& look, const CheckPage& page) {
  return whole_page(look, page,
                    motion_section(look) + map_section(look, page.doubts) +
                        inputs_section(look, page) + source_section(look) +
                        kinematics_section(look) + locks_section(look) + fence_section(look) +
                        object_section(look) +
                        html_section("time", "Time", lines_of(time_text(look, 1, false))));
}

std::string refused_page(const Look& look, const CheckPage& page) {
  return whole_page(look, page, inputs_section(look, page));
}

}  // namespace talus
