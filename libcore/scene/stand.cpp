// Draws the stems of a stand of trees, cell by cell.
#include "scene/stand.hpp"

#include <cmath>

#include "base/hash_random.hpp"

namespace talus {
namespace {

constexpr double hectare = 1e4;  // [m2]

double drawn_diameter(const Stocking& stocking, HashRandom& random) {
  if (stocking.dbh_std == 0) return stocking.dbh_mean;
  const double ratio = stocking.dbh_mean / stocking.dbh_std;
  const double scale = stocking.dbh_std / ratio;
  double dbh = 0;
  while (!(dbh > 0)) dbh = scale * random.gamma(ratio * ratio);  // tiny ones may round to 0
  return dbh;
}

}  // namespace

StandCell stand_cell_at(const Vec2& place, double size) {
  const double col = std::floor(place.x() / size), row = std::floor(place.y() / size);
  return {static_cast<std::int64_t>(col), static_cast<std::int64_t>(row), size,
          size * Vec2(col, row)};
}

std::vector<StandCell> stand_cells(const Vec2& low, const Vec2& high) {
  std::vector<StandCell> cells;
  const StandCell first = stand_cell_at(low, stand_cell), last = stand_cell_at(high, stand_cell);
  for (std::int64_t row = first.row; row <= last.row; ++row)
    for (std::int64_t col = first.col; col <= last.col; ++col)
      cells.push_back({col, row, stand_cell,
                       stand_cell * Vec2(static_cast<double>(col), static_cast<double>(row))});
  return cells;
}

void draw_cell(const StandSeed& seed, const StandCell& cell, const Stocking& stocking,
               std::vector<DrawnStem>& stems) {
  const auto word = [](std::int64_t value) { return static_cast<std::uint64_t>(value); };
  const std::uint64_t name = HashRandom::word_of(seed.name);
  const auto of_cell = [&](std::uint64_t index) {
    return HashRandom{word(seed.seed), name, word(seed.run), word(cell.col), word(cell.row), index};
  };
  const int n = of_cell(0).poisson(stocking.stems_per_ha * cell.size * cell.size / hectare);
  for (int k = 1; k <= n; ++k) {
    HashRandom random = of_cell(word(k));
    DrawnStem stem;
    const double east = random.uniform(), north = random.uniform();
    stem.at = cell.low + cell.size * Vec2(east, north);
    stem.is_conifer = random.uniform() < stocking.conifer_share;
    stem.dbh = drawn_diameter(stocking, random);
    stems.push_back(stem);
  }
}

const std::vector<Species>& known_species() {
  static const std::vector<Species> list = {
      {"conifer", 0.93}, {"broadleaf", 1.59}, {"larch", 0.9}, {"spruce", 0.9}, {"fir", 1.0},
      {"pine", 1.1},     {"maple", 1.1},      {"beech", 1.5}, {"oak", 2.2},    {"robinia", 2.7}};
  return list;
}

int species_named(const std::string& name) {
  for (std::size_t k = 0; k < known_species().size(); ++k)
    if (name == known_species()[k].name) return static_cast<int>(k);
  return -1;
}

}  // namespace talus
