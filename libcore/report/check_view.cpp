#include "report/check_view.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "base/text.hpp"
#include "base/units.hpp"
#include "draw/ticks.hpp"
#include "geometry/plan2d.hpp"
#include "report/encode.hpp"
#include "report/map_marks.hpp"

namespace talus {
namespace {

using std::size_t;

std::string number(double value) { return text(std::round(value * 100) / 100); }

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
  // A road may be long: what lies far off would make all else small.
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

// Metres of the drawing: x to the east, y to the south, zero at the north-west node.
class Drawing {
 public:
  explicit Drawing(const Trn& trn) : trn_(trn) {}
  [[nodiscard]] Vec2 at(const Vec2& p) const {
    return {p.x() - trn_.node0.x(), trn_.node0.y() - p.y()};
  }
  [[nodiscard]] std::string path(const std::vector<Vec2>& points, bool closed) const {
    std::string out;
    for (const Vec2& p : points) {
      const Vec2 q = at(p);
      out += (out.empty() ? "M" : "L") + number(q.x()) + " " + number(q.y());
    }
    return out + (closed ? "Z" : "");
  }
  [[nodiscard]] std::string segment(const Vec2& a, const Vec2& b) const {
    const Vec2 p = at(a), q = at(b);
    return "M" + number(p.x()) + " " + number(p.y()) + "L" + number(q.x()) + " " + number(q.y());
  }

 private:
  const Trn& trn_;
};

std::string shape(const std::string& css_class, const std::string& d, const std::string& title) {
  if (d.empty()) return "";
  return "<path class=\"" + css_class + "\" d=\"" + d + "\">" +
         (title.empty() ? "" : "<title>" + xml_escaped(title) + "</title>") + "</path>\n";
}

// Where a contour crosses a triangle with these corners.
bool crossing(const std::array<Vec3, 3>& corners, double level, Vec2& from, Vec2& to) {
  int n = 0;
  std::array<Vec2, 3> found;
  for (int k = 0; k < 3; ++k) {
    const Vec3 &a = corners[k], &b = corners[(k + 1) % 3];
    if ((a.z() > level) == (b.z() > level)) continue;
    const double share = (level - a.z()) / (b.z() - a.z());
    found[n++] = (a + share * (b - a)).head<2>();
  }
  if (n != 2) return false;
  from = found[0];
  to = found[1];
  return true;
}

// Contours of the ground, seen at no more than this many nodes a side, so that a page stays small.
constexpr int most_nodes = 160;

// visit(k, from, to): where the contour at k intervals of the map's height crosses a triangle.
template <typename Visit>
void visit_crossings(const Trn& ground, double interval, const Visit& visit) {
  const int stride = std::max(1, std::max(ground.n_rows, ground.n_cols) / most_nodes);
  const auto look_at = [&](const std::array<Vec3, 3>& corners) {
    if (!std::isfinite(corners[0].z() + corners[1].z() + corners[2].z())) return;
    const auto [low, high] = std::minmax({corners[0].z(), corners[1].z(), corners[2].z()});
    const double zero = ground.origin.z();  // contours lie at round heights of the map
    for (double k = std::ceil((low + zero) / interval); k * interval <= high + zero; ++k) {
      Vec2 from, to;
      if (crossing(corners, k * interval - zero, from, to)) visit(k, from, to);
    }
  };
  for (int r = 0; r + stride < ground.n_rows; r += stride)
    for (int c = 0; c + stride < ground.n_cols; c += stride) {
      const Vec3 north_west = node_point(ground, r, c),
                 south_east = node_point(ground, r + stride, c + stride);
      look_at({north_west, node_point(ground, r + stride, c), south_east});
      look_at({north_west, south_east, node_point(ground, r, c + stride)});
    }
}

bool is_bold(double k) { return std::fmod(std::abs(k), 5) == 0; }

std::string contours(const Trn& ground, const Drawing& draw, double interval, bool bold) {
  std::string d;
  visit_crossings(ground, interval, [&](double k, const Vec2& from, const Vec2& to) {
    if (is_bold(k) == bold) d += draw.segment(from, to);
  });
  return d;
}

// Heights of the bold contours, each once, one above the other near the western border.
std::string contour_heights(const Trn& ground, const Drawing& draw, double interval, double width,
                            double height) {
  const double unit = width / 100, column = 8 * unit, margin = 5 * unit;
  struct Place {
    Vec2 at = Vec2::Zero(), along = Vec2::Zero();
    double off = 0;  // from the column
  };
  std::map<double, Place> places;  // by k
  visit_crossings(ground, interval, [&](double k, const Vec2& from, const Vec2& to) {
    const Vec2 a = draw.at(from), b = draw.at(to), at = (a + b) / 2;
    if (!is_bold(k) || at.x() < margin || at.x() > width - margin || at.y() < margin ||
        at.y() > height - margin)
      return;
    const double off = std::abs(at.x() - column);
    const auto found = places.find(k);
    if (found == places.end() || off < found->second.off) places[k] = {at, b - a, off};
  });
  std::string out;
  std::vector<Vec2> drawn;
  for (const auto& [k, place] : places) {
    const auto is_near = [&p = place.at, unit](const Vec2& q) { return (p - q).norm() < 6 * unit; };
    if (std::any_of(drawn.begin(), drawn.end(), is_near)) continue;
    drawn.push_back(place.at);
    double turn = std::atan2(place.along.y(), place.along.x()) / degree;
    turn += turn > 90 ? -180 : turn <= -90 ? 180 : 0;  // never upside down
    const std::string x = number(place.at.x()), y = number(place.at.y());
    out += "<text class=\"height\" font-size=\"" + number(1.6 * unit) + "\" stroke-width=\"" +
           number(0.5 * unit) + "\" text-anchor=\"middle\" dy=\"0.35em\" x=\"" + x + "\" y=\"" + y +
           "\" transform=\"rotate(" + number(turn) + " " + x + " " + y + ")\">" +
           text(k * interval) + "</text>\n";
  }
  return out;
}

// Sides of cells between two classes of ground. `cell_class` belongs to the whole terrain, of which
// `part` is a part.
std::string class_borders(const CheckView& view, const Trn& part, const Trn& whole,
                          const Drawing& draw) {
  if (view.cell_class.empty()) return "";
  const auto class_at = [&](const Vec2& p) {
    const Cell cell = locate(whole, p.x(), p.y()).cell;
    return view.cell_class[static_cast<size_t>(first_triangle(whole, cell)) / 2];
  };
  std::string d;
  const double half = part.cell_size / 2;
  for (int r = 0; r + 1 < part.n_rows; ++r)
    for (int c = 0; c + 1 < part.n_cols; ++c) {
      const Vec2 corner = node_point(part, r, c).head<2>();
      const Vec2 middle = corner + Vec2(half, -half);
      const Vec2 east = middle + Vec2(2 * half, 0), south = middle - Vec2(0, 2 * half);
      const Vec2 far = corner + Vec2(2 * half, -2 * half);
      if (c + 2 < part.n_cols && class_at(middle) != class_at(east))
        d += draw.segment(corner + Vec2(2 * half, 0), far);
      if (r + 2 < part.n_rows && class_at(middle) != class_at(south))
        d += draw.segment(corner - Vec2(0, 2 * half), far);
    }
  return d;
}

std::string rings_of(const NamedArea& area, const Drawing& draw) {
  std::string d;
  for (const auto& polygon : area.polygons)
    for (const auto& ring : polygon) d += draw.path(ring, true);
  return d;
}

// Beside the middle of the points, so that the mark stays free; a hundredth of the width is a unit.
std::string label(const std::string& css_class, const std::vector<Vec2>& points,
                  const std::string& words, const Drawing& draw, double width, double height) {
  Vec2 sum = Vec2::Zero();
  int n = 0;
  for (const Vec2& p : points) {
    const Vec2 at = draw.at(p);
    if (at.x() < 0 || at.y() < 0 || at.x() > width || at.y() > height) continue;
    sum += at;
    ++n;
  }
  if (n == 0) return "";
  const double unit = width / 100;
  const bool is_right = sum.x() / n > 0.7 * width;
  return "<text class=\"" + css_class + "\" font-size=\"" + number(2.4 * unit) +
         "\" stroke-width=\"" + number(0.5 * unit) + "\" text-anchor=\"" +
         (is_right ? "end" : "start") + "\" x=\"" +
         number(sum.x() / n + (is_right ? -unit : unit)) + "\" y=\"" + number(sum.y() / n - unit) +
         "\">" + xml_escaped(words) + "</text>\n";
}

// A number in a circle at the place, or at a corner of the extent.
std::string mark(const DoubtMark& doubt, const Drawing& draw, double width) {
  const Vec2 a = draw.at(doubt.at.front()), b = draw.at(doubt.at.back());
  const Vec2 low = a.cwiseMin(b);
  const double unit = width / 100;
  std::string out = "<g class=\"doubt\"><title>" + xml_escaped(doubt.title) + "</title>";
  if (doubt.at.size() == 2)
    out += "<rect x=\"" + number(low.x()) + "\" y=\"" + number(low.y()) + "\" width=\"" +
           number(std::abs(a.x() - b.x())) + "\" height=\"" + number(std::abs(a.y() - b.y())) +
           "\"/>";
  return out + "<circle cx=\"" + number(low.x()) + "\" cy=\"" + number(low.y()) + "\" r=\"" +
         number(1.5 * unit) + "\"/><text font-size=\"" + number(2 * unit) +
         "\" text-anchor=\"middle\" dy=\"0.35em\" x=\"" + number(low.x()) + "\" y=\"" +
         number(low.y()) + "\">" + std::to_string(doubt.number) + "</text></g>\n";
}

const char* class_of(BlockOutlook outlook) {
  switch (outlook) {
    case BlockOutlook::goes:
      return "goes";
    case BlockOutlook::stays:
      return "stays";
    case BlockOutlook::holds_others:
      break;
  }
  return "holds";
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

double contour_interval(double low, double high) {
  const double wanted = std::max(high - low, 1e-3) / 20;
  const double power = std::pow(10, std::floor(std::log10(wanted)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= wanted * (1 - 1e-9)) return factor * power;
  return 10 * power;
}

double contour_interval(const Trn& ground) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const double z : ground.elevation)
    if (std::isfinite(z)) low = std::min(low, z), high = std::max(high, z);
  return low < high ? contour_interval(low, high) : 0;
}

Trn part_for(const CheckView& view, const Trn& ground) {
  const DrawnBox box = drawn_box(view, ground.cell_size);
  if (!(box.low.x() <= box.high.x())) return ground;
  const double margin = std::max(0.15 * (box.high - box.low).maxCoeff(), 5 * ground.cell_size);
  const Cell north_west = locate(ground, box.low.x() - margin, box.high.y() + margin).cell;
  const Cell south_east = locate(ground, box.high.x() + margin, box.low.y() - margin).cell;
  Trn part = ground;
  part.n_rows = south_east.row - north_west.row + 2;
  part.n_cols = south_east.col - north_west.col + 2;
  part.node0 = node_point(ground, north_west.row, north_west.col).head<2>();
  part.elevation.clear();
  for (int r = 0; r < part.n_rows; ++r)
    for (int c = 0; c < part.n_cols; ++c)
      part.elevation.push_back(
          ground.elevation[node_index(ground, north_west.row + r, north_west.col + c)]);
  return part;
}

bool is_drawn(const NamedArea& object, const Trn& part) {
  const Drawing draw(part);
  const double width = (part.n_cols - 1) * part.cell_size,
               height = (part.n_rows - 1) * part.cell_size;
  const std::vector<Vec2> points = points_along(object, part.cell_size);
  return std::any_of(points.begin(), points.end(), [&](const Vec2& p) {
    const Vec2 at = draw.at(p);
    return at.x() >= 0 && at.y() >= 0 && at.x() <= width && at.y() <= height;
  });
}

std::string check_map_svg(const CheckView& view, const Trn& ground,
                          std::string_view hillshade_png) {
  const Trn part = part_for(view, ground);
  const Drawing draw(part);
  const double cell = part.cell_size, width = (part.n_cols - 1) * cell,
               height = (part.n_rows - 1) * cell;
  std::string out = "<svg class=\"plan check\" viewBox=\"0 0 " + number(width) + " " +
                    number(height) + "\" role=\"img\" aria-label=\"map of the source\">\n" +
                    "<image x=\"" + number(-cell / 2) + "\" y=\"" + number(-cell / 2) +
                    "\" width=\"" + number(part.n_cols * cell) + "\" height=\"" +
                    number(part.n_rows * cell) + "\" preserveAspectRatio=\"none\" href=\"" +
                    data_address("image/png", hillshade_png) + "\"/>\n";
  if (const double interval = contour_interval(part); interval > 0) {
    const std::string title = "contours every " + text(interval) + " m";
    out += shape("contour", contours(part, draw, interval, false), title);
    out += shape("contour bold", contours(part, draw, interval, true), title);
    out += contour_heights(part, draw, interval, width, height);
  }
  out += shape("ground-class", class_borders(view, part, ground, draw), "border of ground classes");
  for (const NamedArea& object : view.objects)
    out += shape("object", rings_of(object, draw), object.title);
  for (const auto& line : view.fall_lines) out += shape("fall", draw.path(line, false), "");
  for (const OutlinedBlock& block : view.blocks)
    out += shape(class_of(block.outlook), draw.path(block.outline, true), block.title);
  for (const auto& ring : view.source) out += shape("source", draw.path(ring, true), "source");
  for (const NamedArea& surface : view.surfaces)
    out += shape("proposed", rings_of(surface, draw), surface.title);
  for (const FootMark& mark : view.foot) {
    const Vec2 at = draw.at(mark.place);
    out += "<circle class=\"" + std::string(mark.holds ? "step" : "clear") + "\" cx=\"" +
           number(at.x()) + "\" cy=\"" + number(at.y()) + "\" r=\"" + number(cell / 4) +
           "\"><title>" +
           (mark.step > 0.1 ? "step of " + text(mark.step, 2) + " m" : "comes out here") +
           "</title></circle>\n";
  }
  out += shape("section", draw.path(view.section, false), "section");
  for (const ViewedFence& fence : view.fences) {
    std::vector<Vec2> plan;
    for (const Vec3& p : fence.line.points) plan.emplace_back(p.head<2>());
    out += shape("fence", draw.path(plan, false), "fence " + fence.line.name);
    out += label("fence-name", plan, fence.line.name, draw, width, height);
  }
  for (const NamedArea& object : view.objects)
    out += label("object-name", points_along(object, cell), object.name, draw, width, height);
  for (const DoubtMark& doubt : view.doubts) out += mark(doubt, draw, width);
  return out + scale_and_north({0, 0}, {width, height}) + "</svg>\n";
}

Trn thinned(const Trn& ground, int most) {
  const int stride = std::max(1, (std::max(ground.n_rows, ground.n_cols) + most - 1) / most);
  Trn thin = ground;
  thin.n_rows = (ground.n_rows - 1) / stride + 1;
  thin.n_cols = (ground.n_cols - 1) / stride + 1;
  thin.cell_size = stride * ground.cell_size;
  thin.elevation.clear();
  for (int r = 0; r < thin.n_rows; ++r)
    for (int c = 0; c < thin.n_cols; ++c)
      thin.elevation.push_back(ground.elevation[node_index(ground, stride * r, stride * c)]);
  return thin;
}

bool is_far(const ViewedInput& input, const Trn& ground) {
  const DrawnBox box = box_of(ground);
  const Vec2 reach = Vec2::Constant(2 * (box.high - box.low).maxCoeff());
  return ((input.low - box.low).array() < -reach.array()).any() ||
         ((input.high - box.high).array() > reach.array()).any();
}

std::string inputs_map_svg(const CheckView& view, const std::vector<ViewedInput>& inputs,
                           const Trn& ground, std::string_view hillshade_png) {
  const DrawnBox of_ground = box_of(ground);
  DrawnBox box = of_ground;
  for (const ViewedInput& input : inputs) {
    if (is_far(input, ground)) continue;
    box.add(input.low);
    box.add(input.high);
  }
  const Vec2 margin = Vec2::Constant(0.03 * (box.high - box.low).maxCoeff());
  box.add(box.low - margin);
  box.add(box.high + margin);
  Trn corner = ground;  // the drawing begins at the north-west of all
  corner.node0 = Vec2(box.low.x(), box.high.y());
  const Drawing draw(corner);
  const double width = box.high.x() - box.low.x(), height = box.high.y() - box.low.y();
  const double unit = width / 100, cell = ground.cell_size;
  const Vec2 north_west = draw.at(ground.node0);
  std::string out = "<svg class=\"plan check\" viewBox=\"0 0 " + number(width) + " " +
                    number(height) + "\" role=\"img\" aria-label=\"map of the inputs\">\n" +
                    "<image x=\"" + number(north_west.x() - cell / 2) + "\" y=\"" +
                    number(north_west.y() - cell / 2) + "\" width=\"" +
                    number(ground.n_cols * cell) + "\" height=\"" + number(ground.n_rows * cell) +
                    "\" preserveAspectRatio=\"none\" href=\"" +
                    data_address("image/png", hillshade_png) + "\"/>\n";
  if (const double interval = contour_interval(ground); interval > 0)
    out += shape("contour",
                 contours(ground, draw, interval, false) + contours(ground, draw, interval, true),
                 "contours of the terrain every " + text(interval) + " m");
  for (const NamedArea& object : view.objects)
    out += shape("object", rings_of(object, draw), object.title);
  for (const auto& ring : view.source) out += shape("source", draw.path(ring, true), "source");
  for (const ViewedFence& fence : view.fences) {
    std::vector<Vec2> plan;
    for (const Vec3& p : fence.line.points) plan.emplace_back(p.head<2>());
    out += shape("fence", draw.path(plan, false), "fence " + fence.line.name);
  }
  std::vector<Vec2> named;
  for (const ViewedInput& input : inputs) {
    if (is_far(input, ground)) continue;
    const std::vector<Vec2> ring = {
        input.low, {input.high.x(), input.low.y()}, input.high, {input.low.x(), input.high.y()}};
    out += shape("input", draw.path(ring, true), input.title);
    Vec2 at = draw.at({input.low.x(), input.high.y()}) + Vec2(0.5 * unit, 2 * unit);
    const auto is_near = [&](const Vec2& other) { return (at - other).norm() < 2.2 * unit; };
    while (std::any_of(named.begin(), named.end(), is_near)) at.y() += 2.2 * unit;
    named.push_back(at);
    out += "<text class=\"input-name\" font-size=\"" + number(1.8 * unit) + "\" stroke-width=\"" +
           number(0.5 * unit) + "\" x=\"" + number(at.x()) + "\" y=\"" + number(at.y()) + "\">" +
           xml_escaped(input.name) + "</text>\n";
  }
  for (const DoubtMark& doubt : view.doubts) out += mark(doubt, draw, width);
  return out + scale_and_north({0, 0}, {width, height}) + "</svg>\n";
}

std::string section_svg(const CheckView& view, const Trn& ground, const Trn& bed) {
  const std::vector<SectionPoint> points = points_along(view.section, ground, bed);
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const SectionPoint& p : points) {
    if (!std::isfinite(p.ground)) continue;
    low = std::min({low, p.ground, std::isfinite(p.bed) ? p.bed : p.ground});
    high = std::max(high, p.ground);
  }
  if (points.empty() || !(low < high) || points.back().along <= 0) return "";
  constexpr double wide = 1000, left = 70, right = 20, top = 16, bottom = 44;
  const double scale = (wide - left - right) / points.back().along;
  const double tall = top + bottom + scale * (high - low);
  const auto x = [&](double along) { return left + scale * along; };
  const auto y = [&](double z) { return top + scale * (high - z); };
  std::string out = "<svg class=\"section\" viewBox=\"0 0 " + number(wide) + " " + number(tall) +
                    "\" role=\"img\" aria-label=\"section along the motion\">\n";
  const double zero = ground.origin.z();
  for (const double tick : round_ticks(low + zero, high + zero, 5)) {
    if (tick < low + zero || tick > high + zero) continue;
    out += "<path class=\"grid\" d=\"M" + number(left) + " " + number(y(tick - zero)) + "H" +
           number(wide - right) + "\"/><text text-anchor=\"end\" x=\"" + number(left - 6) +
           "\" y=\"" + number(y(tick - zero) + 4) + "\">" + text(tick) + " m</text>\n";
  }
  for (const double tick : round_ticks(0, points.back().along, 8))
    if (tick <= points.back().along)
      out += "<text text-anchor=\"middle\" x=\"" + number(x(tick)) + "\" y=\"" +
             number(tall - bottom + 20) + "\">" + text(tick) + "</text>\n";
  out += "<text text-anchor=\"middle\" x=\"" + number(wide / 2) + "\" y=\"" + number(tall - 6) +
         "\">distance along the section [m]</text>\n";
  std::string surface, back, line;
  for (const SectionPoint& p : points) {
    if (!std::isfinite(p.ground)) continue;
    line += (line.empty() ? "M" : "L") + number(x(p.along)) + " " + number(y(p.ground));
    if (!std::isfinite(p.bed)) continue;
    const std::string at = number(x(p.along)) + " ";
    surface += (surface.empty() ? "M" : "L") + at + number(y(p.ground));
    back = "L" + at + number(y(std::min(p.bed, p.ground))) + back;
  }
  out += shape("mass", surface + back + "Z", "between the ground and the failure surface");
  out += shape("surface", line, "ground");
  for (size_t k = 0; k < view.fences.size(); ++k)
    for (const auto& [along, z] : fences_across(view, ground, k))
      out += shape(
          "fence",
          "M" + number(x(along)) + " " + number(y(z)) + "V" + number(y(z + view.fences[k].height)),
          "fence " + view.fences[k].line.name);
  return out + "</svg>\n";
}

}  // namespace talus
