#include "post/maps/map_picture.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>

namespace talus {
namespace {

constexpr int long_side = 1000;  // of the map, about [pixels]
constexpr int letter_height = 11;
constexpr double opacity = 0.75;

// Letters as strokes on a grid of 5 columns (0-4) and 7 rows (0-6), row 0 on top: pairs of digits
// "column row"; a blank ends a stroke.
const std::map<char, const char*> strokes = {
    {'A', "0610 1020 2046 0444"},
    {'B', "000636454433 0333 0030413233"},
    {'C', "4130100105164645"},
    {'D', "000626454121 2000"},
    {'E', "40000646 0333"},
    {'F', "400006 0333"},
    {'G', "41301001051636454323"},
    {'H', "0006 4046 0343"},
    {'I', "1030 2026 1636"},
    {'J', "4045361605"},
    {'K', "0006 4003 0346"},
    {'L', "000646"},
    {'M', "0600234046"},
    {'N', "06004640"},
    {'O', "100105163645413010"},
    {'P', "06003041423303"},
    {'Q', "100105163645413010 2446"},
    {'R', "06003041423303 2346"},
    {'S', "413010010213334445361605"},
    {'T', "0040 2026"},
    {'U', "000516364540"},
    {'V', "002640"},
    {'W', "0016233640"},
    {'X', "0046 4006"},
    {'Y', "002340 2326"},
    {'Z', "00400646"},
    {'0', "100105163645413010 0541"},
    {'1', "1120 2026 1636"},
    {'2', "01103041420646"},
    {'3', "01103041423313 334445361605"},
    {'4', "36300444"},
    {'5', "400002324345361605"},
    {'6', "413010010516364544330304"},
    {'7', "00404116"},
    {'8', "13020110304142331304051636454433"},
    {'9', "431302011030414536 361605"},
    {'.', "2526"},
    {',', "2516"},
    {'-', "1333"},
    {'+', "0343 2125"},
    {'/', "0640"},
    {'(', "30121436"},
    {')', "10323416"},
    {'[', "30101636"},
    {']', "10303616"},
    {'<', "400346"},
    {'>', "004306"},
    {'=', "0242 0444"},
    {':', "2122 2425"},
    {';', "2122 2516"},
    {'%', "0640 0011 3546"},
    {'_', "0646"},
    {'*', "0343 1135 3115"},
    {'\'', "2021"},
};

void put(Picture& picture, int row, int col, const Colour& colour) {
  if (row < 0 || col < 0 || row >= picture.n_rows || col >= picture.n_cols) return;
  picture.pixel[static_cast<std::size_t>(row) * static_cast<std::size_t>(picture.n_cols) +
                static_cast<std::size_t>(col)] = colour;
}

void draw_line(Picture& picture, double r0, double c0, double r1, double c1, const Colour& colour) {
  const int n = std::max(1, static_cast<int>(std::ceil(2 * std::hypot(r1 - r0, c1 - c0))));
  for (int i = 0; i <= n; ++i) {
    const double s = static_cast<double>(i) / n;
    put(picture, static_cast<int>(std::lround(r0 + s * (r1 - r0))),
        static_cast<int>(std::lround(c0 + s * (c1 - c0))), colour);
  }
}

void fill(Picture& picture, int row, int col, int n_rows, int n_cols, const Colour& colour) {
  for (int r = row; r < row + n_rows; ++r)
    for (int c = col; c < col + n_cols; ++c) put(picture, r, c, colour);
}

// Brightness of the ground lit from the north-west at 45 degrees, 0 to 255; NaN off the ground.
// Slopes are differences over a cell, one-sided at the terrain's border.
double shade(const Trn& trn, double x, double y) {
  const double d = 0.5 * trn.cell_size;
  const Vec2 low = trn.node0 - Vec2(0, (trn.n_rows - 1) * trn.cell_size);
  const Vec2 high = trn.node0 + Vec2((trn.n_cols - 1) * trn.cell_size, 0);
  const double east = std::min(x + d, high.x()), west = std::max(x - d, low.x());
  const double north = std::min(y + d, high.y()), south = std::max(y - d, low.y());
  Vec2 gradient((elevation_at(trn, east, y) - elevation_at(trn, west, y)) / (east - west),
                (elevation_at(trn, x, north) - elevation_at(trn, x, south)) / (north - south));
  if (std::isnan(gradient.x()) || std::isnan(gradient.y())) {
    if (!contains(trn, x, y)) return std::nan("");
    gradient = triangle_gradient(trn, triangle_at(trn, x, y));
    if (std::isnan(gradient.x() + gradient.y())) return std::nan("");
  }
  const Vec3 normal = Vec3(-gradient.x(), -gradient.y(), 1).normalized();
  const Vec3 light = Vec3(-0.5, 0.5, std::sqrt(0.5));
  return 40 + 215 * std::max(0.0, normal.dot(light));
}

Colour over(double ground, const Colour& colour) {
  Colour out{0, 0, 0, 255};
  const double share = opacity * colour[3] / 255;
  for (std::size_t k = 0; k < 3; ++k)
    out[k] = static_cast<std::uint8_t>(std::lround((1 - share) * ground + share * colour[k]));
  return out;
}

int text_width(const std::string& words, int height) {
  int width = 0;
  for (const char c : words) {
    const bool is_small = std::islower(static_cast<unsigned char>(c)) != 0;
    width += static_cast<int>(std::lround((is_small ? 0.75 : 1.0) * height)) * 4 / 6 + 3;
  }
  return width;
}

// Whether a pixel lies on a line of a hatching that rises to the right, or falls.
bool is_on_hatch(int row, int col, int distance, bool rises) {
  return (rises ? row + col : row - col + 100000 * distance) % distance < 2;
}

constexpr int class_hatch = 6, uncertain_hatch = 9;  // [pixels]
constexpr const char* uncertain_words = "hatched: class not certain";

// Around words at blanks, to at most `width` pixels a line.
std::vector<std::string> wrapped(const std::vector<std::string>& lines, int width) {
  std::vector<std::string> out;
  for (const std::string& line : lines) {
    std::string now;
    std::size_t begin = 0;
    while (begin < line.size()) {
      const std::size_t end = std::min(line.find(' ', begin), line.size());
      const std::string word = line.substr(begin, end - begin);
      if (!now.empty() && text_width(now + " " + word, letter_height) > width) {
        out.push_back(now);
        now = "  " + word;
      } else {
        now += (now.empty() ? "" : " ") + word;
      }
      begin = end + 1;
    }
    out.push_back(now);
  }
  return out;
}

// Colour of a class at a pixel.
Colour shown_at(const StyleClass* of, int row, int col) {
  if (!of) return {};
  if (of->is_hatched && !is_on_hatch(row, col, class_hatch, false)) return {255, 255, 255, 255};
  return of->colour;
}

void draw_legend(Picture& picture, int row, int col, const RasterStyle& style, bool any_uncertain) {
  const Colour black{0, 0, 0, 255};
  draw_text(picture, row, col, letter_height, style.title, black);
  row += 2 * letter_height;
  for (const StyleClass& c : style.classes) {
    fill(picture, row - 1, col - 1, letter_height + 4, 26, black);
    for (int r = row; r < row + letter_height + 2; ++r)
      for (int k = col; k < col + 24; ++k) put(picture, r, k, over(220, shown_at(&c, r, k)));
    draw_text(picture, row + 1, col + 34, letter_height, c.label, black);
    row += letter_height + 8;
  }
  if (any_uncertain) draw_text(picture, row + 1, col, letter_height, uncertain_words, black);
}

// A red strip across the picture with the remark in white, as large as its width allows.
constexpr int strip_height = 34;  // [pixels]

void draw_remark(Picture& picture, const std::string& remark) {
  fill(picture, 0, 0, strip_height, picture.n_cols, {179, 32, 31, 255});
  int height = 18;
  while (height > 7 && text_width(remark, height) > picture.n_cols - 24) --height;
  for (const int shift : {0, 1})  // twice, since one stroke is thin
    draw_text(picture, (strip_height - height) / 2, 12 + shift, height, remark,
              {255, 255, 255, 255});
}

int legend_width(const RasterStyle& style, bool any_uncertain) {
  int width = text_width(style.title, letter_height);
  for (const StyleClass& c : style.classes)
    width = std::max(width, 34 + text_width(c.label, letter_height));
  if (any_uncertain) width = std::max(width, text_width(uncertain_words, letter_height));
  return width + 30;
}

}  // namespace

std::vector<bool> known_cells(const Trn& trn, const PassageGrid& grid) {
  std::vector<bool> known;
  known.reserve(static_cast<std::size_t>(grid.n_rows) * static_cast<std::size_t>(grid.n_cols));
  for (int row = 0; row < grid.n_rows; ++row)
    for (int col = 0; col < grid.n_cols; ++col) {
      bool any = false;
      for (const auto& [right, down] :
           {std::pair{0.5, 0.5}, {0.01, 0.01}, {0.99, 0.01}, {0.01, 0.99}, {0.99, 0.99}}) {
        const Vec2 at = grid.corner + grid.cell_size * Vec2(col + right, -row - down);
        any = any || !std::isnan(elevation_at(trn, at.x(), at.y()));
      }
      known.push_back(any);
    }
  return known;
}

int draw_text(Picture& picture, int row, int col, int height, const std::string& words,
              const Colour& colour) {
  for (const char c : words) {
    const bool is_small = std::islower(static_cast<unsigned char>(c)) != 0;
    const int own = static_cast<int>(std::lround((is_small ? 0.75 : 1.0) * height));
    const double unit = own / 6.0;
    const auto found = strokes.find(static_cast<char>(std::toupper(static_cast<unsigned char>(c))));
    const std::string path = found == strokes.end() ? "" : found->second;
    std::size_t begin = 0;
    while (begin < path.size()) {
      const std::size_t end = std::min(path.find(' ', begin), path.size());
      for (std::size_t i = begin; i + 3 < end; i += 2)
        draw_line(picture, row + height - own + unit * (path[i + 1] - '0'),
                  col + unit * (path[i] - '0'), row + height - own + unit * (path[i + 3] - '0'),
                  col + unit * (path[i + 2] - '0'), colour);
      begin = end + 1;
    }
    col += own * 4 / 6 + 3;
  }
  return col;
}

Shading shading_of(const Trn& trn, const PassageGrid& grid) {
  const double cells = std::max(grid.n_rows, grid.n_cols);
  Shading out;
  out.per_cell =
      cells < long_side ? std::max(1.0, std::floor(long_side / cells)) : long_side / cells;
  out.n_rows = std::max(1, static_cast<int>(grid.n_rows * out.per_cell));
  out.n_cols = std::max(1, static_cast<int>(grid.n_cols * out.per_cell));
  for (int r = 0; r < out.n_rows; ++r)
    for (int c = 0; c < out.n_cols; ++c) {
      const Vec2 at = grid.corner + grid.cell_size / out.per_cell * Vec2(c + 0.5, -r - 0.5);
      out.brightness.push_back(static_cast<float>(shade(trn, at.x(), at.y())));
    }
  return out;
}

Picture map_picture(const Shading& shading, const PassageGrid& grid,
                    const std::vector<float>& value, float nodata, const RasterStyle& style,
                    const std::vector<bool>& uncertain) {
  const bool any_uncertain = !uncertain.empty();
  const int legend_rows = 40 + static_cast<int>(style.classes.size() + 2) * (letter_height + 8);
  Picture picture;
  picture.n_cols = shading.n_cols + legend_width(style, any_uncertain);
  const int top = style.remark.empty() ? 0 : strip_height;
  const int bottom = top + std::max(shading.n_rows, legend_rows);
  const std::vector<std::string> notes = wrapped(style.notes, picture.n_cols - 24);
  picture.n_rows = bottom;
  if (!notes.empty()) picture.n_rows += 16 + static_cast<int>(notes.size()) * (letter_height + 6);
  picture.pixel.assign(
      static_cast<std::size_t>(picture.n_rows) * static_cast<std::size_t>(picture.n_cols),
      Colour{255, 255, 255, 255});
  const float* ground = shading.brightness.data();
  for (int r = 0; r < shading.n_rows; ++r)
    for (int c = 0; c < shading.n_cols; ++c, ++ground) {
      if (std::isnan(*ground)) continue;
      const auto row = static_cast<std::size_t>((r + 0.5) / shading.per_cell);
      const auto col = static_cast<std::size_t>((c + 0.5) / shading.per_cell);
      const std::size_t cell = row * static_cast<std::size_t>(grid.n_cols) + col;
      const float v = value[cell];
      const StyleClass* const of = v == nodata ? nullptr : class_of(style, v);
      put(picture, top + r, c,
          any_uncertain && uncertain[cell] && is_on_hatch(r, c, uncertain_hatch, true)
              ? Colour{40, 40, 40, 255}
              : over(*ground, shown_at(of, r, c)));
    }
  draw_legend(picture, top + 12, shading.n_cols + 16, style, any_uncertain);
  for (std::size_t i = 0; i < notes.size(); ++i)
    draw_text(picture, bottom + 10 + static_cast<int>(i) * (letter_height + 6), 12, letter_height,
              notes[i], {0, 0, 0, 255});
  if (top > 0) draw_remark(picture, style.remark);
  return picture;
}

}  // namespace talus
