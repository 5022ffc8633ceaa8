// libcore/post/maps/pen_cairo.hpp
// Lines, areas, pictures and words on a page, all in millimetres from its upper left corner.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/types.hpp"
#include "io/style.hpp"
#include "post/maps/map_page.hpp"

struct _cairo;

namespace talus {

struct Letters {
  double size = 2.4;  ///< [mm]
  bool is_bold = false;
  double width = 0;  ///< that lines are broken at; 0: one line [mm]
  Colour colour{30, 30, 30, 255};
  bool has_halo = false;  ///< a white rim, over a map
};

struct Stroke {
  double width = 0.2;  ///< [mm]
  Colour colour{0, 0, 0, 255};
  std::vector<double> dashes = {};  ///< [mm]
  bool has_casing = false;          ///< a white rim, over a map
};

class Pen {
 public:
  explicit Pen(_cairo* page);
  ~Pen();
  Pen(const Pen&) = delete;
  Pen& operator=(const Pen&) = delete;

  void line(const std::vector<Vec2>& points, const Stroke& stroke, bool is_closed = false);
  void area(const std::vector<Vec2>& points, const Colour& colour);
  void box(const PageBox& box, const Colour& colour);    ///< filled
  void frame(const PageBox& box, const Stroke& stroke);  ///< its rim
  void circle(const Vec2& middle, double radius, const Stroke& stroke);
  /// Lines that rise to the right, or fall, `distance` apart, as far as they lie in the box; those
  /// of boxes side by side meet.
  void hatch(const PageBox& box, double distance, bool rises, const Stroke& stroke);

  /// Width and height of words [mm].
  [[nodiscard]] Vec2 size_of(const std::string& words, const Letters& letters);
  /// Upper left corner at `at`. Returns their height [mm].
  double words(const Vec2& at, const std::string& words, const Letters& letters);
  /// The middle at `at`, turned by `angle` to the left [rad].
  void words_about(const Vec2& at, double angle, const std::string& words, const Letters& letters);

  /// Pixels 0xAARRGGBB, not multiplied by their alpha, from the upper left corner of `box` on;
  /// sharp, or blurred into each other.                                    (n_rows x n_cols)
  void picture(const PageBox& box, int n_rows, int n_cols, const std::vector<std::uint32_t>& pixels,
               bool is_sharp);

  /// What is drawn between these shows in the box alone.
  void clip(const PageBox& box);
  void unclip();
  /// What follows is drawn `factor` as large about `at`.
  void shrink(const Vec2& at, double factor);

 private:
  struct Words;
  void set(const std::string& words, const Letters& letters);
  void show(const Vec2& at, const Letters& letters);
  void stroke(const Stroke& stroke);
  _cairo* page_;
  std::unique_ptr<Words> words_;
};

}  // namespace talus
