#include "report/plan_view.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "base/grouped_text.hpp"
#include "base/text.hpp"
#include "post/deposit.hpp"
#include "post/runout/runout.hpp"
#include "report/encode.hpp"
#include "report/map_marks.hpp"

namespace talus {
namespace {

// Metres of the drawing: x to the east, y to the south, zero at the north-west node.
struct Place {
  const Trn& trn;
  [[nodiscard]] Vec2 of(double x, double y) const { return {x - trn.node0.x(), trn.node0.y() - y}; }
};

std::string number(double value) { return text(std::round(value * 100) / 100); }

std::string path_of(const std::vector<Vec2>& points, const Place& place, bool closed) {
  std::string out;
  for (const Vec2& p : points) {
    const Vec2 at = place.of(p.x(), p.y());
    out += (out.empty() ? "M" : "L") + number(at.x()) + " " + number(at.y());
  }
  return out + (closed ? "Z" : "");
}

std::string shape(const std::string& css_class, const std::string& d, const std::string& title) {
  return "<path class=\"" + css_class + "\" d=\"" + d + "\">" +
         (title.empty() ? "" : "<title>" + xml_escaped(title) + "</title>") + "</path>\n";
}

std::vector<Vec2> plan_of(const std::vector<Vec3>& points) {
  std::vector<Vec2> plan;
  for (const Vec3& p : points) plan.emplace_back(p.head<2>());
  return plan;
}

std::string object_of(const RecordObject& object, const Place& place) {
  std::string out;
  for (const ObjectPart& part : object.parts) {
    if (part.is_area || part.points.size() > 1) {
      out += shape(part.is_area ? "object" : "object line",
                   path_of(part.points, place, part.is_area), object.name);
    } else if (!part.points.empty()) {
      const Vec2 at = place.of(part.points[0].x(), part.points[0].y());
      out += "<circle class=\"object\" cx=\"" + number(at.x()) + "\" cy=\"" + number(at.y()) +
             "\" r=\"" + number(object.radius) + "\"><title>" + xml_escaped(object.name) +
             "</title></circle>\n";
    }
  }
  return out;
}

std::string blocks_of(const RunFile& run, const Trn& trn) {
  const Place place{trn};
  std::string starts, paths, ends;
  for (int b = 0; b < n_blocks(run); ++b) {
    const std::string name =
        "block " + std::to_string(b) + ", " + grouped_text(run.blocks.volume[b]) + " m3";
    starts += shape("start", path_of(footprint(run, b, first_pose(run, b)), place, true), name);
    if (n_frames(run.frames) == 0) continue;
    const TimedPath path = simplified(block_path(run, b), 0.25);
    paths += shape("way", path_of(plan_of(path.point), place, false), name);
    ends += shape("end", path_of(footprint(run, b, last_pose(run, b)), place, true), name);
  }
  return starts + paths + ends;
}

}  // namespace

PlanWindow plan_window(const RunFile& run, const Trn& trn) {
  const double infinite = std::numeric_limits<double>::infinity();
  PlanWindow w{Vec2::Constant(infinite), Vec2::Constant(-infinite)};
  const auto add = [&w](const Vec2& p) {
    w.low = w.low.cwiseMin(p);
    w.high = w.high.cwiseMax(p);
  };
  const std::vector<double>& p = run.frames.position;
  for (std::size_t i = 0; i + 2 < p.size(); i += 3) add({p[i], p[i + 1]});
  for (const RecordLine& line : run.lines)
    for (const Vec3& point : line.points) add(point.head<2>());
  const Vec2 south_west(trn.node0.x(), trn.node0.y() - (trn.n_rows - 1) * trn.cell_size);
  const Vec2 north_east(trn.node0.x() + (trn.n_cols - 1) * trn.cell_size, trn.node0.y());
  if (!(w.low.x() <= w.high.x())) return {south_west, north_east};
  const double margin = std::max(0.25 * (w.high - w.low).maxCoeff(), 4 * trn.cell_size);
  return {(w.low.array() - margin).matrix().cwiseMax(south_west),
          (w.high.array() + margin).matrix().cwiseMin(north_east)};
}

std::string plan_view_svg(const RunFile& run, const Trn& trn, std::string_view hillshade_png) {
  const PlanWindow map = plan_window(run, trn);
  const Place place{trn};  // north is up here, and down in the drawing
  const PlanWindow w{place.of(map.low.x(), map.high.y()), place.of(map.high.x(), map.low.y())};
  const double cell = trn.cell_size;
  std::string out = "<svg class=\"plan\" viewBox=\"" + number(w.low.x()) + " " + number(w.low.y()) +
                    " " + number(w.high.x() - w.low.x()) + " " + number(w.high.y() - w.low.y()) +
                    "\" role=\"img\" aria-label=\"map of the run\">\n<image x=\"" +
                    number(-cell / 2) + "\" y=\"" + number(-cell / 2) + "\" width=\"" +
                    number(trn.n_cols * cell) + "\" height=\"" + number(trn.n_rows * cell) +
                    "\" preserveAspectRatio=\"none\" href=\"" +
                    data_address("image/png", hillshade_png) + "\"/>\n";
  for (const RecordObject& object : run.objects) out += object_of(object, place);
  out += blocks_of(run, trn);
  for (const RecordLine& line : run.lines)
    out += shape("fence", path_of(plan_of(line.points), place, false), "fence " + line.name);
  return out + scale_and_north(w.low, w.high) + "</svg>\n";
}

}  // namespace talus
