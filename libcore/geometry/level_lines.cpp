#include "geometry/level_lines.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>

namespace talus {
namespace {

// A side of a square: 2 * (number of its first sample), + 1 where it goes to the next row.
using Side = std::int64_t;

// The sides that a line joins at a side: one, or two where it goes on.
struct Neighbours {
  std::array<Side, 2> side{-1, -1};
};
using Links = std::map<Side, Neighbours>;

void link(Links& links, Side a, Side b) {
  for (const auto& [from, to] : {std::pair{a, b}, {b, a}}) {
    auto& side = links[from].side;
    side[side[0] < 0 ? 0 : 1] = to;
  }
}

double sample(const SampledField& field, int row, int col) {
  return field.value[static_cast<std::size_t>(row) * field.n_cols + col];
}

Vec2 place_on(const SampledField& field, Side side, double level) {
  const auto number = side / 2;
  const int row = static_cast<int>(number / field.n_cols),
            col = static_cast<int>(number % field.n_cols);
  const bool goes_on = side % 2 != 0;
  const double a = sample(field, row, col),
               b = sample(field, row + (goes_on ? 1 : 0), col + (goes_on ? 0 : 1));
  const double share = (level - a) / (b - a);
  return field.corner + field.spacing * (goes_on ? Vec2(col, field.north * (row + share))
                                                 : Vec2(col + share, field.north * row));
}

// The pieces of the line in a square.
void add_square(const SampledField& field, int row, int col, double level, Links& links) {
  const std::array<double, 4> corner = {sample(field, row, col), sample(field, row, col + 1),
                                        sample(field, row + 1, col + 1),
                                        sample(field, row + 1, col)};
  const Side here = 2 * (static_cast<Side>(row) * field.n_cols + col);
  // from corner k to the next one
  const std::array<Side, 4> side = {here, here + 3, here + 2 * static_cast<Side>(field.n_cols),
                                    here + 1};
  std::vector<int> cut;
  for (int k = 0; k < 4; ++k)
    if ((corner[k] >= level) != (corner[(k + 1) % 4] >= level)) cut.push_back(k);
  if (cut.size() == 2) {
    link(links, side[cut[0]], side[cut[1]]);
  } else if (cut.size() == 4) {  // a saddle: the middle says which corners belong together
    const double middle = (corner[0] + corner[1] + corner[2] + corner[3]) / 4;
    const bool joins_first = (middle >= level) == (corner[0] >= level);
    link(links, side[0], side[joins_first ? 1 : 3]);
    link(links, side[2], side[joins_first ? 3 : 1]);
  }
}

// Takes the line that begins at a side out of `links`.
LevelLine walked(const SampledField& field, double level, Side first, Links& links) {
  LevelLine line{level, {}};
  Side at = first, before = -1;
  while (at >= 0) {
    const auto found = links.find(at);
    line.points.push_back(place_on(field, at, level));
    if (found == links.end()) break;  // closed
    const auto [a, b] = found->second.side;
    links.erase(found);
    const Side next = a != before ? a : b;
    before = at;
    at = next;
  }
  return line;
}

}  // namespace

std::vector<LevelLine> level_lines(const SampledField& field, const std::vector<double>& levels) {
  std::vector<LevelLine> lines;
  std::vector<Links> links(levels.size());
  for (int row = 0; row + 1 < field.n_rows; ++row)
    for (int col = 0; col + 1 < field.n_cols; ++col) {
      const std::array<double, 4> corner = {sample(field, row, col), sample(field, row, col + 1),
                                            sample(field, row + 1, col),
                                            sample(field, row + 1, col + 1)};
      if (std::isnan(corner[0] + corner[1] + corner[2] + corner[3])) continue;
      const auto [low, high] = std::minmax_element(corner.begin(), corner.end());
      const auto first = std::upper_bound(levels.begin(), levels.end(), *low);
      for (auto level = first; level != levels.end() && *level <= *high; ++level)
        add_square(field, row, col, *level, links[level - levels.begin()]);
    }
  for (std::size_t i = 0; i < levels.size(); ++i) {
    std::vector<Side> ends;  // open lines first, from an end
    for (const auto& [side, next] : links[i])
      if (next.side[1] < 0) ends.push_back(side);
    for (const Side end : ends)
      if (links[i].contains(end)) lines.push_back(walked(field, levels[i], end, links[i]));
    while (!links[i].empty())
      lines.push_back(walked(field, levels[i], links[i].begin()->first, links[i]));
  }
  return lines;
}

}  // namespace talus
