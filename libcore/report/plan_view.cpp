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

namespace talus {
namespace {

std::string shape(const std::string& css_class, const std::string& d, const std::string& title) {
  return "<path class=\"" + css_class + "\" d=\"" + d + "\">" +
         (title.empty() ? "" : "<title>" + xml_escaped(title) + "</title>") + "</path>\n";
}

std::vector<Vec2> plan_of(const std::vector<Vec3>& points) {
  std::vector<Vec2> plan;
  for (const Vec3& p : points) plan.emplace_back(p.head<2>());
  return plan;
}

std::string blocks_of(const Texts& texts, const RunFile& run, const MapSheet& sheet) {
  std::string starts, paths, ends;
  for (int b = 0; b < n_blocks(run); ++b) {
    const std::string name = texts.of(
        "maps.block", {{"n", std::to_string(b)}, {"volume", grouped_text(run.blocks.volume[b])}});
    starts += shape("start", sheet_path(sheet, footprint(run, b, first_pose(run, b)), true), name);
    if (n_frames(run.frames) == 0) continue;
    const TimedPath path = simplified(block_path(run, b), 0.25);
    paths += shape("way", sheet_path(sheet, plan_of(path.point), false), name);
    ends += shape("end", sheet_path(sheet, footprint(run, b, last_pose(run, b)), true), name);
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
    if (!is_candidate(line))
      for (const Vec3& point : line.points) add(point.head<2>());
  const Vec2 south_west(trn.node0.x(), trn.node0.y() - (trn.n_rows - 1) * trn.cell_size);
  const Vec2 north_east(trn.node0.x() + (trn.n_cols - 1) * trn.cell_size, trn.node0.y());
  if (!(w.low.x() <= w.high.x())) return {south_west, north_east};
  const double margin = std::max(0.25 * (w.high - w.low).maxCoeff(), 4 * trn.cell_size);
  return {(w.low.array() - margin).matrix().cwiseMax(south_west),
          (w.high.array() + margin).matrix().cwiseMin(north_east)};
}

std::string plan_view_svg(const Texts& texts, const RunFile& run, const MapSheet& sheet) {
  return sheet_svg(sheet, blocks_of(texts, run, sheet), texts.of("maps.plan_picture"));
}

}  // namespace talus
