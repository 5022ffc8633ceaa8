// Maps and the section of the check page.
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/text.hpp"
#include "geometry/plan2d.hpp"
#include "post/maps/map_drawing.hpp"
#include "report/check_view.hpp"

namespace talus {
namespace {

using std::size_t;

// --- the map -----------------------------------------------------------------------------------

struct DrawnBox {
  Vec2 low = Vec2::Constant(std::numeric_limits<double>::infinity()), high = -low;
  void add(const Vec2& p) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
};

DrawnBox box_of(const Trn& ground) {
  DrawnBox box;
  box.add(node_point(ground, 0, 0).head<2>());
  box.add(node_point(ground, ground.n_rows - 1, ground.n_cols - 1).head<2>());
  return box;
}

// Along the outlines of an area, so that a long side is found where it passes.
std::vector<Vec2> points_along(const NamedArea& area, double spacing) {
  std::vector<Vec2> points;
  for (const auto& polygon : area.polygons) {
    const std::vector<Vec2>& ring = polygon[0];
    for (size_t k = 0; k < ring.size(); ++k) {
      const Vec2 side = ring[(k + 1) % ring.size()] - ring[k];
      const int n = std::max(1, static_cast<int>(std::ceil(side.norm() / spacing)));
      for (int i = 0; i < n; ++i) points.emplace_back(ring[k] + static_cast<double>(i) / n * side);
    }
  }
  return points;
}

DrawnBox drawn_box(const CheckView& view, double spacing) {
  DrawnBox box;
  for (const auto& ring : view.source)
    for (const Vec2& p : ring) box.add(p);
  for (const ViewedFence& fence : view.fences)
    for (const Vec3& p : fence.line.points) box.add(p.head<2>());
  for (const auto& line : view.fall_lines)
    for (const Vec2& p : line) box.add(p);
  for (const OutlinedBlock& block : view.blocks)
    for (const Vec2& p : block.outline) box.add(p);
  // A road may be long: its far parts would make all else small.
  DrawnBox near = box;
  const Vec2 reach = Vec2::Constant((box.high - box.low).maxCoeff());
  near.add(box.low - reach);
  near.add(box.high + reach);
  for (const NamedArea& object : view.objects)
    for (const Vec2& p : points_along(object, spacing))
      if ((p.array() >= near.low.array()).all() && (p.array() <= near.high.array()).all())
        box.add(p);
  return box;
}

constexpr double letters = 1.4;  // of those on paper: a page shows the map narrower

MapGround ground_about(const DrawnBox& box, double margin, const Trn& ground) {
  const PageLayout layout = layout_of(PageSize::a4);
  const Vec2 beside = Vec2::Constant(margin);
  return map_ground(ground, layout, view_of(layout, box.low - beside, box.high + beside));
}

std::vector<Vec2> plan_of(const ViewedFence& fence) {
  std::vector<Vec2> plan;
  for (const Vec3& p : fence.line.points) plan.emplace_back(p.head<2>());
  return plan;
}

std::string title_of(const ViewedFence& fence) {
  return (is_dam(fence.line) ? "" : "fence ") + fence.line.name;
}

// Common parts of the maps of the page: each thing with a note, and its name beside it.
class CheckMap {
 public:
  CheckMap(Pen& pen, const MapGround& ground) : pen_(pen), ground_(ground) {
    const PageLayout layout = layout_of(PageSize::a4);
    spot_ = {{0, 0, layout.map.width, layout.map.height}, ground.view, letters, true};
  }

  [[nodiscard]] PenLines at(const PenLines& lines) const {
    PenLines out;
    for (const std::vector<Vec2>& line : lines) out.push_back(on_map(spot_, line));
    return out;
  }

  void ground(const Trn& trn) {
    draw_shading(pen_, spot_, ground_);
    draw_contours(pen_, spot_, ground_);
    draw_grid(pen_, spot_, trn.origin.head<2>());
  }
  void lines(const PenLines& lines, const Stroke& stroke, const std::string& title) {
    pen_.lines(at(lines), stroke);
    pen_.note(title, at(lines), false);
  }
  void rings(const PenLines& rings, const Colour& fill, const Stroke& stroke,
             const std::string& title) {
    pen_.area(at(rings), fill);
    pen_.lines(at(rings), stroke, true);
    pen_.note(title, at(rings), fill[3] > 0);
  }
  void areas(const std::vector<NamedArea>& areas, const Colour& fill, const Stroke& stroke) {
    for (const NamedArea& area : areas)
      for (const auto& polygon : area.polygons) rings(polygon, fill, stroke, area.title);
  }
  // Beside the middle of the visible points.
  void name(const std::vector<Vec2>& points, const std::string& words, const Colour& colour) {
    Vec2 sum = Vec2::Zero();
    int n = 0;
    for (const Vec2& p : points) {
      if (!is_seen(p)) continue;
      sum += on_map(spot_, p);
      ++n;
    }
    if (n > 0) draw_name(pen_, spot_, sum / n, words, colour);
  }
  void dots(const std::vector<Vec2>& places, double radius_m, const Colour& colour) {
    pen_.dots(on_map(spot_, places), 1000 * radius_m / spot_.view.scale, colour);
  }
  void source(const CheckView& view) { rings(view.source, {}, {0.55, rgb(0xc0127a)}, "source"); }
  void fences(const CheckView& view) {
    for (const ViewedFence& fence : view.fences) {
      lines({plan_of(fence)}, line_stroke(true), title_of(fence));
      name(plan_of(fence), fence.line.name, rgb(0x000000));
    }
  }
  void objects(const CheckView& view, double spacing) {
    const Colour colour = object_stroke().colour;
    areas(view.objects, {colour[0], colour[1], colour[2], 60}, object_stroke());
    for (const NamedArea& object : view.objects)
      name(points_along(object, spacing), object.name, colour);
  }
  // A number in a circle at the place, or at a corner of the extent.
  void doubts(const CheckView& view) {
    constexpr Colour orange = rgb(0xc77700);
    for (const DoubtMark& doubt : view.doubts) {
      const Vec2 a = on_map(spot_, doubt.at.front()), b = on_map(spot_, doubt.at.back());
      const Vec2 low = a.cwiseMin(b), size = (a - b).cwiseAbs();
      if (doubt.at.size() == 2)
        pen_.frame({low.x(), low.y(), size.x(), size.y()}, {0.42, orange, {1.8, 1}});
      pen_.dots({low}, 3, rgb(0xffffff));
      pen_.circles({low}, 3, {0.42, orange});
      pen_.words_about(low, std::to_string(doubt.number), {3.4, true, 0, rgb(0x7a4800)});
      pen_.note(doubt.title,
                {{low - Vec2(3, 3), low + Vec2(3, -3), low + Vec2(3, 3), low + Vec2(-3, 3)}}, true);
    }
  }
  void note(const std::string& title, const std::vector<Vec2>& ring) {
    pen_.note(title, at({ring}), true);
  }
  void marks() {
    draw_scale_bar(pen_, {4, spot_.frame.height - 12}, spot_.view, letters);
    draw_north(pen_, {spot_.frame.width - 6, 4}, letters);
  }
  [[nodiscard]] bool is_seen(const Vec2& p) const {
    return (p.array() >= spot_.view.low.array()).all() &&
           (p.array() <= spot_.view.high.array()).all();
  }
  [[nodiscard]] Vec2 place(const Vec2& local) const { return on_map(spot_, local); }

 private:
  Pen& pen_;
  const MapGround& ground_;
  MapSpot spot_;
};

Drawing map_drawing(const std::string& title, const MapGround& ground,
                    const std::function<void(Pen&, CheckMap&)>& draw) {
  const PageLayout layout = layout_of(PageSize::a4);
  return {layout.map.width, layout.map.height, title, 1, [=](Pen& pen) {
            CheckMap map(pen, ground);
            draw(pen, map);
          }};
}

// Sides of cells between two classes of ground, in the view.
PenLines class_borders(const CheckView& view, const Trn& ground, const MapView& part) {
  PenLines out;
  if (view.cell_class.empty()) return out;
  const Cell first = locate(ground, part.low.x(), part.high.y()).cell,
             last = locate(ground, part.high.x(), part.low.y()).cell;
  const auto class_at = [&](int row, int col) {
    return view.cell_class[static_cast<size_t>(first_triangle(ground, {row, col})) / 2];
  };
  const auto node = [&ground](int row, int col) -> Vec2 {
    return node_point(ground, row, col).head<2>();
  };
  for (int r = first.row; r <= last.row; ++r)
    for (int c = first.col; c <= last.col; ++c) {
      if (c < last.col && class_at(r, c) != class_at(r, c + 1))
        out.push_back({node(r, c + 1), node(r + 1, c + 1)});
      if (r < last.row && class_at(r, c) != class_at(r + 1, c))
        out.push_back({node(r + 1, c), node(r + 1, c + 1)});
    }
  return out;
}

void draw_blocks(CheckMap& map, const CheckView& view) {
  const auto looks = {std::tuple{BlockOutlook::goes, rgb(0xf09628, 102), rgb(0x8a4a00)},
                      std::tuple{BlockOutlook::stays, rgb(0x6e7882, 140), rgb(0x333333)},
                      std::tuple{BlockOutlook::holds_others, rgb(0xbe1e1e, 178), rgb(0x660000)}};
  for (const auto& [outlook, fill, rim] : looks)
    for (const OutlinedBlock& block : view.blocks)
      if (block.outlook == outlook) map.rings({block.outline}, fill, {0.16, rim}, block.title);
}

void draw_foot(CheckMap& map, const CheckView& view, double radius) {
  for (const FootMark& mark : view.foot) {
    map.dots({mark.place}, radius, rgb(mark.holds ? 0xc01515 : 0x148a35));
    const Vec2 half(radius, radius);
    map.note(mark.step > 0.1 ? "step of " + text(mark.step, 2) + " m" : "comes out here",
             {mark.place - half, mark.place + Vec2(radius, -radius), mark.place + half});
  }
}

// --- the section -------------------------------------------------------------------------------

struct SectionPoint {
  double along = 0;  // in plan, from the start of the line [m]
  double ground = 0, bed = 0;
};

std::vector<SectionPoint> points_along(const std::vector<Vec2>& line, const Trn& ground,
                                       const Trn& bed) {
  std::vector<SectionPoint> points;
  double before = 0;
  for (size_t k = 0; k + 1 < line.size(); ++k) {
    const double length = (line[k + 1] - line[k]).norm();
    const int n = std::max(1, static_cast<int>(std::ceil(2 * length / ground.cell_size)));
    for (int i = 0; i < n; ++i) {
      const Vec2 p = line[k] + static_cast<double>(i) / n * (line[k + 1] - line[k]);
      points.push_back({before + length * i / n, elevation_at(ground, p.x(), p.y()),
                        elevation_at(bed, p.x(), p.y())});
    }
    before += length;
  }
  return points;
}

// Where the section crosses a fence: how far along, and how high the ground is there.
std::vector<std::pair<double, double>> fences_across(const CheckView& view, const Trn& ground,
                                                     size_t fence) {
  std::vector<std::pair<double, double>> found;
  const auto& posts = view.fences[fence].line.points;
  double before = 0;
  for (size_t k = 0; k + 1 < view.section.size(); ++k) {
    const Vec2 a = view.section[k], step = view.section[k + 1] - a;
    for (size_t i = 0; i + 1 < posts.size(); ++i) {
      const Vec2 b = posts[i].head<2>(), side = posts[i + 1].head<2>() - b;
      const double turn = cross(step, side);
      if (turn == 0) continue;
      const Vec2 d = b - a;
      const double s = cross(d, side) / turn;
      const double t = cross(d, step) / turn;
      if (s < 0 || s >= 1 || t < 0 || t > 1) continue;
      const Vec2 p = a + s * step;
      found.emplace_back(before + s * step.norm(), elevation_at(ground, p.x(), p.y()));
    }
    before += step.norm();
  }
  return found;
}

}  // namespace

MapGround check_ground(const CheckView& view, const Trn& ground) {
  DrawnBox box = drawn_box(view, ground.cell_size);
  if (!(box.low.x() <= box.high.x())) box = box_of(ground);
  const double margin = std::max(0.15 * (box.high - box.low).maxCoeff(), 5 * ground.cell_size);
  return ground_about(box, margin, ground);
}

bool is_drawn(const NamedArea& object, const MapView& part) {
  const std::vector<Vec2> points = points_along(object, (part.high - part.low).x() / 100);
  return std::any_of(points.begin(), points.end(), [&part](const Vec2& p) {
    return (p.array() >= part.low.array()).all() && (p.array() <= part.high.array()).all();
  });
}

Drawing check_map(const CheckView& view, const Trn& ground, const MapGround& part) {
  return map_drawing("map of the source", part, [&view, &ground, &part](Pen&, CheckMap& map) {
    map.ground(ground);
    map.lines(class_borders(view, ground, part.view), {0.26, rgb(0x444444), {1.3, 1.1}},
              "border of ground classes");
    map.objects(view, ground.cell_size);
    map.lines(view.fall_lines, {0.26, rgb(0x1450aa, 115)}, "");
    draw_blocks(map, view);
    map.source(view);
    map.areas(view.surfaces, {}, {0.48, rgb(0x7a28a0), {1.6, 1.1}});
    draw_foot(map, view, ground.cell_size / 4);
    map.lines({view.section}, {0.37, rgb(0x111111), {2.4, 0.8, 0.5, 0.8}}, "section");
    map.fences(view);
    map.doubts(view);
    map.marks();
  });
}

bool is_far(const ViewedInput& input, const Trn& ground) {
  const DrawnBox box = box_of(ground);
  const Vec2 reach = Vec2::Constant(2 * (box.high - box.low).maxCoeff());
  return ((input.low - box.low).array() < -reach.array()).any() ||
         ((input.high - box.high).array() > reach.array()).any();
}

Drawing inputs_map(const CheckView& view, const std::vector<ViewedInput>& inputs,
                   const Trn& ground) {
  DrawnBox box = box_of(ground);
  for (const ViewedInput& input : inputs) {
    if (is_far(input, ground)) continue;
    box.add(input.low);
    box.add(input.high);
  }
  const auto draw = [&view, &inputs, &ground](Pen& pen, CheckMap& map) {
    constexpr Colour blue = rgb(0x14508c);
    constexpr double line = 4;              // from name to name [mm]
    constexpr std::size_t most_named = 50;  // more names cannot be read; each box has its tooltip
    map.ground(ground);
    map.objects(view, ground.cell_size);
    map.source(view);
    map.fences(view);
    std::vector<Vec2> named;
    for (const ViewedInput& input : inputs) {
      if (is_far(input, ground)) continue;
      map.rings({{input.low,
                  {input.high.x(), input.low.y()},
                  input.high,
                  {input.low.x(), input.high.y()}}},
                {}, {0.37, blue, {2.1, 1.1}}, input.title);
      if (named.size() == most_named) continue;
      Vec2 at = map.place({input.low.x(), input.high.y()}) + Vec2(1, line);
      const auto is_near = [&](const Vec2& other) { return (at - other).norm() < line; };
      while (std::any_of(named.begin(), named.end(), is_near)) at.y() += line;
      named.push_back(at);
      pen.words_about(at, input.name, {2.3 * letters, true, 0, blue, true}, Anchor::begin);
    }
    map.doubts(view);
    map.marks();
  };
  return map_drawing("map of the inputs",
                     ground_about(box, 0.03 * (box.high - box.low).maxCoeff(), ground), draw);
}

Chart section_chart(const CheckView& view, const Trn& ground, const Trn& bed) {
  Chart chart{"Section", "distance along the section [m]", "height [m]", {}};
  chart.is_true_scale = true;
  ChartSeries mass{"between the ground and the failure surface", "#f09628", {}, {}, 0},
      surface{"ground", "#222222", {}, {}, 1.6};
  bool has_mass = false;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  const double zero = ground.origin.z();
  for (const SectionPoint& p : points_along(view.section, ground, bed)) {
    if (!std::isfinite(p.ground)) continue;
    low = std::min(low, p.ground);
    high = std::max(high, p.ground);
    surface.x.push_back(p.along);
    surface.y.push_back(p.ground + zero);
    if (!std::isfinite(p.bed)) continue;
    has_mass |= p.bed < p.ground;
    mass.x.push_back(p.along);
    mass.y.push_back(std::min(p.bed, p.ground) + zero);
    mass.y_high.push_back(p.ground + zero);
  }
  if (!(low < high) || surface.x.back() <= surface.x.front()) return chart;
  if (has_mass) chart.series.push_back(std::move(mass));
  chart.series.push_back(std::move(surface));
  for (size_t k = 0; k < view.fences.size(); ++k)
    for (const auto& [along, z] : fences_across(view, ground, k))
      chart.series.push_back({title_of(view.fences[k]),
                              "#000000",
                              {along, along},
                              {z + zero, z + zero + view.fences[k].height},
                              3});
  return chart;
}

}  // namespace talus
