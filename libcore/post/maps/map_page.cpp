// Layout of a map page: its parts, their positions and the scale.
#include "post/maps/map_page.hpp"

#include <algorithm>
#include <cmath>

#include "draw/ticks.hpp"
#include "geometry/plan2d.hpp"

namespace talus {
namespace {

constexpr double per_mm = 0.001;  // metres of paper

// Samples at the nodes of a grid over the view, one more than its squares on each side.
SampledField sampled(const Trn& trn, const MapView& view, double spacing) {
  SampledField field;
  field.corner = {view.low.x(), view.high.y()};
  field.spacing = spacing;
  field.n_cols = static_cast<int>(std::ceil((view.high.x() - view.low.x()) / spacing)) + 1;
  field.n_rows = static_cast<int>(std::ceil((view.high.y() - view.low.y()) / spacing)) + 1;
  for (int row = 0; row < field.n_rows; ++row)
    for (int col = 0; col < field.n_cols; ++col) {
      const Vec2 at = field.corner + spacing * Vec2(col, -row);
      field.value.push_back(elevation_at(trn, at.x(), at.y()) + trn.origin.z());
    }
  return field;
}

void add_contours(MapGround& ground, const Trn& trn) {
  constexpr double line_mm = 0.8;  // between samples: finer ones are not seen
  constexpr double most_lines = 30;
  const double spacing = std::max(line_mm * per_mm * ground.view.scale, trn.cell_size / 2);
  const SampledField field = sampled(trn, ground.view, spacing);
  double low = INFINITY, high = -INFINITY;
  for (const double z : field.value)
    if (!std::isnan(z)) {
      low = std::min(low, z);
      high = std::max(high, z);
    }
  if (!(high > low)) return;
  ground.contour_interval = round_up((high - low) / most_lines);
  std::vector<double> levels;
  const double first = std::ceil(low / ground.contour_interval),
               last = std::floor(high / ground.contour_interval);
  for (double k = first; k <= last; ++k) levels.push_back(k * ground.contour_interval);
  ground.contours = level_lines(field, levels);
}

// The heights of one line, apart from those that are there.
void add_labels(const LevelLine& line, const MapView& view, const Vec2& size,
                std::vector<LevelLabel>& labels) {
  constexpr double half = 4, apart = 40, from_frame = 6, most_bend = 0.3, step = 5;  // mm, radians
  std::vector<Vec2> points;
  std::vector<double> length{0};
  for (const Vec2& p : line.points) {
    points.emplace_back(1000 * (p.x() - view.low.x()) / view.scale,
                        1000 * (view.high.y() - p.y()) / view.scale);
    if (points.size() > 1)
      length.push_back(length.back() + (points.back() - points[points.size() - 2]).norm());
  }
  const auto along = [&](double s) -> Vec2 {
    const auto i = std::clamp<std::ptrdiff_t>(
        std::upper_bound(length.begin(), length.end(), s) - length.begin(), 1,
        static_cast<std::ptrdiff_t>(length.size()) - 1);
    const double piece = length[i] - length[i - 1];
    return points[i - 1] +
           (piece > 0 ? (s - length[i - 1]) / piece : 0) * (points[i] - points[i - 1]);
  };
  for (double s = half; s + half <= length.back(); s += step) {
    const Vec2 middle = along(s), a = middle - along(s - half), b = along(s + half) - middle;
    const double bend = std::atan2(cross(a, b), a.dot(b));
    const bool is_inside =
        (middle.array() > from_frame).all() && ((size - middle).array() > from_frame).all();
    if (std::abs(bend) > most_bend || !is_inside) continue;
    if (std::any_of(labels.begin(), labels.end(),
                    [&](const LevelLabel& l) { return (l.at - middle).norm() < apart; }))
      continue;
    const Vec2 direction = a + b;
    double angle = std::atan2(-direction.y(), direction.x());
    if (std::abs(angle) > M_PI / 2) angle += M_PI;
    labels.push_back({line.level, middle, angle});
  }
}

}  // namespace

PageLayout layout_of(PageSize size) {
  const bool is_a3 = size == PageSize::a3;
  constexpr double margin = 8, title = 14, beside_map = 5, below_map = 5, gap = 5;
  PageLayout out;
  out.width = is_a3 ? 420 : 297;
  out.height = is_a3 ? 297 : 210;
  const double column = is_a3 ? 84 : 66;
  out.column = {out.width - margin - column, margin + title, column,
                out.height - 2 * margin - title};
  out.map = {margin + beside_map, margin + title,
             out.width - 2 * margin - beside_map - gap - column,
             out.height - 2 * margin - title - below_map};
  return out;
}

MapView view_of(const PageLayout& layout, const Vec2& low, const Vec2& high) {
  const Vec2 frame = per_mm * Vec2(layout.map.width, layout.map.height);
  MapView view;
  view.scale = round_scale(((high - low).array() / frame.array()).maxCoeff());
  const Vec2 middle = (low + high) / 2, half = view.scale * frame / 2;
  view.low = middle - half;
  view.high = middle + half;
  return view;
}

MapGround map_ground(const Trn& trn, const PageLayout& layout, const MapView& view) {
  constexpr double square_mm = 0.34;  // two pixels of a picture
  MapGround ground;
  ground.view = view;
  ground.shading_cell = std::max(square_mm * per_mm * view.scale, trn.cell_size / 4);
  const double cells_per_mm = per_mm * view.scale / ground.shading_cell;
  ground.shading = shading_of(trn, {Vec2(view.low.x(), view.high.y()), ground.shading_cell,
                                    static_cast<int>(std::ceil(layout.map.height * cells_per_mm)),
                                    static_cast<int>(std::ceil(layout.map.width * cells_per_mm))});
  add_contours(ground, trn);
  return ground;
}

bool is_numbered(const MapGround& ground, const LevelLine& line) {
  return std::lround(line.level / ground.contour_interval) % 5 == 0;
}

std::vector<LevelLabel> level_labels(const MapGround& ground, const Vec2& size) {
  std::vector<LevelLabel> labels;
  for (const LevelLine& line : ground.contours)
    if (is_numbered(ground, line)) add_labels(line, ground.view, size, labels);
  return labels;
}

}  // namespace talus
