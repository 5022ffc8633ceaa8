// libcore/draw/pen.hpp: public
// The only interface to draw with: lines, areas, pictures and words, in units of the drawing from
// its upper left corner. drawing.hpp makes files of it.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/types.hpp"
#include "draw/colour.hpp"

namespace talus {

/// A rectangle from its upper left corner.
struct PageBox {
  double x = 0, y = 0, width = 0, height = 0;
};

/// Lines, or the rings of an area.
using PenLines = std::vector<std::vector<Vec2>>;

struct Letters {
  double size = 2.4;
  bool is_bold = false;
  double width = 0;  ///< that lines are broken at; 0: one line
  Colour colour{30, 30, 30, 255};
  bool has_halo = false;  ///< a white rim, over a map
};

struct Stroke {
  double width = 0.2;
  Colour colour{0, 0, 0, 255};
  std::vector<double> dashes = {};  ///< lengths drawn and left out, in turn
  double casing = 0;                ///< a white rim of this width on each side, over a map
};

/// Part of the words at their point.
enum class Anchor { begin, middle, end };

class Pen {
 public:
  struct Surface;
  explicit Pen(Surface& surface) : surface_(surface) {}

  void lines(const PenLines& lines, const Stroke& stroke, bool is_closed = false);
  void line(const std::vector<Vec2>& points, const Stroke& stroke, bool is_closed = false);
  void area(const PenLines& rings, const Colour& colour);  ///< inside an odd number of rings
  void areas(const PenLines& rings,
             const Colour& colour);                      ///< inside any ring; all turn alike
  void box(const PageBox& box, const Colour& colour);    ///< filled
  void frame(const PageBox& box, const Stroke& stroke);  ///< its rim
  void circles(const std::vector<Vec2>& middles, double radius, const Stroke& stroke);
  void dots(const std::vector<Vec2>& middles, double radius, const Colour& colour);
  /// Lines that rise to the right, or fall, `distance` apart, in these boxes; those of boxes side
  /// by side meet.
  void hatch(const std::vector<PageBox>& boxes, double distance, bool rises, const Stroke& stroke);
  /// Pixels 0xAARRGGBB, not multiplied by their alpha, over a box; sharp, or blurred into each
  /// other.                                                                    (n_rows x n_cols)
  void picture(const PageBox& box, int n_rows, int n_cols, const std::vector<std::uint32_t>& pixels,
               bool is_sharp);

  /// Width and height of words.
  [[nodiscard]] Vec2 size_of(const std::string& words, const Letters& letters);
  /// Upper left corner at `at`. Returns their height.
  double words(const Vec2& at, const std::string& words, const Letters& letters);
  /// One line, its middle height at `at`, turned by `angle` to the left [rad].
  void words_about(const Vec2& at, const std::string& words, const Letters& letters,
                   Anchor anchor = Anchor::middle, double angle = 0);

  /// Tooltip of these lines or this area of an SVG.
  void note(const std::string& title, const PenLines& lines, bool is_area);

  /// Drawing between clip() and unclip() shows inside the box alone.
  void clip(const PageBox& box);
  void unclip();
  /// Drawing after this call is `factor` as large, about `at`.
  void shrink(const Vec2& at, double factor);

 private:
  void show(const Vec2& at, const Letters& letters);
  void stroke(const Stroke& stroke);
  void fill(const Colour& colour);
  void trace(const PenLines& lines, bool is_closed);
  Surface& surface_;
};

}  // namespace talus
