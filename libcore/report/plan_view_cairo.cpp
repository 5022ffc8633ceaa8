// The paths of a run on a map, and the part of the terrain that they need.
#include <algorithm>
#include <limits>
#include <vector>

#include "base/grouped_text.hpp"
#include "post/deposit.hpp"
#include "post/runout/runout.hpp"
#include "report/plan_view.hpp"

namespace talus {
namespace {

void draw_blocks(Pen& pen, const MapSpot& spot, const Texts& texts, const RunFile& run) {
  PenLines starts, paths, ends;
  for (int b = 0; b < n_blocks(run); ++b) {
    starts.push_back(on_map(spot, footprint(run, b, first_pose(run, b))));
    if (n_frames(run.frames) == 0) continue;
    paths.emplace_back();
    for (const Vec3& p : simplified(block_path(run, b), 0.25).point)
      paths.back().push_back(on_map(spot, Vec2(p.head<2>())));
    ends.push_back(on_map(spot, footprint(run, b, last_pose(run, b))));
  }
  pen.areas(starts, rgb(0x285ac8, 64));
  pen.lines(starts, {0.25, rgb(0x2a57b8)}, true);
  pen.lines(paths, {0.25, rgb(0x781414, 140)});
  pen.areas(ends, rgb(0xf08214, 153));
  pen.lines(ends, {0.2, rgb(0x6b3000)}, true);
  for (std::size_t b = 0; b < starts.size(); ++b) {
    const std::string name = texts.of(
        "maps.block", {{"n", std::to_string(b)}, {"volume", grouped_text(run.blocks.volume[b])}});
    pen.note(name, {starts[b]}, true);
    if (ends.empty()) continue;
    pen.note(name, {paths[b]}, false);
    pen.note(name, {ends[b]}, true);
  }
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
  return sheet_svg(
      sheet,
      sheet_group(sheet, "class=\"blocks\"",
                  [&](Pen& pen, const MapSpot& spot) { draw_blocks(pen, spot, texts, run); }),
      texts.of("maps.plan_picture"));
}

}  // namespace talus
