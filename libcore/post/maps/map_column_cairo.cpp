// The legend and the words beside a map.
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/text.hpp"
#include "post/maps/map_column.hpp"

namespace talus {
namespace {

constexpr double row_height = 4.9, swatch_width = 8, swatch_height = 3.7, label_x = 10.5;  // [mm]
const Letters heading{2.9, true}, label{2.5}, small{2.15, false, 0, {70, 70, 70, 255}};

// As it looks over ground of middle brightness.
Colour over_ground(const Colour& colour) {
  constexpr double ground = 232;
  Colour out{0, 0, 0, 255};
  const double share = cell_opacity * colour[3] / 255;
  for (std::size_t k = 0; k < 3; ++k)
    out[k] = static_cast<std::uint8_t>(std::lround((1 - share) * ground + share * colour[k]));
  return out;
}

// One entry below the other, from `top` on; knows where the next one comes.
class Column {
 public:
  Column(Pen& pen, const PageBox& box) : pen_(pen), x_(box.x), y_(box.y), width_(box.width) {}

  [[nodiscard]] double bottom() const { return y_; }
  void skip(double height) { y_ += height; }

  void words(const std::string& words, Letters letters) {
    letters.width = width_;
    y_ += pen_.words({x_, y_}, words, letters);
  }

  void class_row(const StyleClass& c) {
    const PageBox box{x_, y_, swatch_width, swatch_height};
    pen_.box(box, c.is_hatched ? Colour{255, 255, 255, 255} : over_ground(c.colour));
    if (c.is_hatched)
      pen_.hatch({box}, class_hatch_mm, false, hatch_stroke(c.colour, class_hatch_width));
    pen_.frame(box, {0.1, {60, 60, 60, 255}});
    row_label(c.label);
  }

  void uncertain_row() {
    const PageBox box{x_, y_, swatch_width, swatch_height};
    pen_.hatch({box}, uncertain_hatch_mm, true, hatch_stroke({30, 30, 30, 255}));
    pen_.frame(box, {0.1, {60, 60, 60, 255}});
    row_label("class not certain");
  }

  void line_row(const Stroke& stroke, const std::string& words) {
    const double y = y_ + swatch_height / 2;
    pen_.line({{x_, y}, {x_ + swatch_width, y}}, stroke);
    row_label(words);
  }

  void area_row(const Stroke& stroke, const std::string& words) {
    pen_.frame({x_ + 0.5, y_ + 0.3, swatch_width - 1, swatch_height - 0.6}, stroke);
    row_label(words);
  }

  void scale_and_north(const MapView& view, const std::string& paper) {
    pen_.words({x_, y_}, "Scale 1 : " + spaced(view.scale) + " on " + paper, heading);
    draw_north(pen_, {x_ + width_ - 4, y_ + 1});
    draw_scale_bar(pen_, {x_ + 2, y_ + 10}, view);
    y_ += 15;
  }

 private:
  void row_label(const std::string& words) {
    Letters letters = label;
    letters.width = width_ - label_x;
    const double height = pen_.size_of(words, letters).y();
    pen_.words({x_ + label_x, y_ + std::max(0.0, (swatch_height - height) / 2)}, words, letters);
    y_ += std::max(row_height, height + 1);
  }

  Pen& pen_;
  double x_, y_, width_;
};

void draw_legend(Column& column, const MapPage& page) {
  column.words(page.cells.style.legend, heading);
  column.skip(1.2);
  // the largest on top, as heights are read
  for (auto c = page.cells.style.classes.rbegin(); c != page.cells.style.classes.rend(); ++c)
    if (c->colour[3] > 0) column.class_row(*c);
  if (!page.cells.uncertain.empty()) column.uncertain_row();
}

// Whether the frame may show a part of the box of `points`.
template <class Points>
bool is_seen(const MapView& view, const Points& points) {
  Vec2 low = Vec2::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const auto& p : points) {
    low = low.cwiseMin(Vec2(p[0], p[1]));
    high = high.cwiseMax(Vec2(p[0], p[1]));
  }
  return (low.array() <= view.high.array()).all() && (high.array() >= view.low.array()).all();
}

void draw_signs(Column& column, const MapGround& ground, const MapPlaces& places) {
  column.skip(2);
  const MapView& view = ground.view;
  const bool any_object =
      std::any_of(places.objects.begin(), places.objects.end(), [&view](const RecordObject& o) {
        return std::any_of(o.parts.begin(), o.parts.end(),
                           [&view](const ObjectPart& part) { return is_seen(view, part.points); });
      });
  if (!places.source.empty()) column.area_row(source_stroke(), "source of the released rock");
  const auto any_line = [&](bool stands) {
    return std::any_of(places.lines.begin(), places.lines.end(), [&](const RecordLine& line) {
      return line.standing == stands && !is_dam(line) && is_seen(view, line.points);
    });
  };
  if (any_line(true)) column.line_row(line_stroke(true), "fence in place");
  if (any_line(false)) column.line_row(line_stroke(false), "line without a fence");
  const auto any_dam = [&places](bool of_gallery) {
    return std::any_of(places.lines.begin(), places.lines.end(), [=](const RecordLine& line) {
      return is_dam(line) && is_gallery(line) == of_gallery;
    });
  };
  if (any_dam(false)) column.line_row(line_stroke(false), "crest of a dam");
  if (any_dam(true)) column.line_row(line_stroke(false), "valley edge of a gallery");
  if (any_object) column.area_row(object_stroke(), "object");
  if (ground.contour_interval > 0)
    column.line_row(contour_stroke(true), "heights every " + text(ground.contour_interval) +
                                              " m, numbered every " +
                                              text(5 * ground.contour_interval) + " m");
}

void draw_foot(Column& column, const MapPage& page, const MapGround& ground) {
  column.scale_and_north(ground.view, page.size == PageSize::a3 ? "A3" : "A4");
  for (const auto& list : {page.cells.style.notes, page.words})
    for (const std::string& paragraph : list) {
      column.words(paragraph, small);
      column.skip(0.9);
    }
}

}  // namespace

ColumnHeights draw_column(Pen& pen, const PageBox& box, double foot, const MapPage& page,
                          const MapGround& ground, const MapPlaces& places) {
  Column top(pen, box), below(pen, {box.x, foot, box.width, 0});
  draw_legend(top, page);
  draw_signs(top, ground, places);
  draw_foot(below, page, ground);
  return {top.bottom() - box.y, below.bottom() - foot};
}

}  // namespace talus
