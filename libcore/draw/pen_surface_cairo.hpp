// libcore/draw/pen_surface_cairo.hpp
// Target of a pen: a surface of Cairo, and, for an SVG, its words and notes apart.
#pragma once

#include <string>

#include "draw/pen.hpp"

struct _cairo;
struct _PangoLayout;

namespace talus {

struct Pen::Surface {
  Surface(_cairo* page, double unit, bool is_svg);
  ~Surface();
  Surface(const Surface&) = delete;
  Surface& operator=(const Surface&) = delete;

  [[nodiscard]] Vec2 at(const Vec2& p) const { return zero + unit * p; }
  void set(const std::string& words, const Letters& letters);

  _cairo* page;
  double unit;  ///< of the drawing, in units of the surface
  Vec2 zero = Vec2::Zero();
  _PangoLayout* layout = nullptr;  ///< made when words are measured first

  bool is_svg;
  std::string words, notes;  ///< elements of the SVG
  bool is_sharp = false;     ///< a picture is
};

/// The size that words of an SVG are parts of [px].
inline constexpr double base_letters = 10;

}  // namespace talus
