// Finds doubtful nodes of a terrain: level areas, rims, steps, seams, sunken ground.
#include "terrain/ground_doubts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "base/numbers.hpp"
#include "base/text.hpp"
#include "terrain/elevation.hpp"
#include "terrain/lone_levels.hpp"
#include "terrain/seams.hpp"

namespace talus {
namespace {

class DoubtFinder {
 public:
  DoubtFinder(const Trn& trn, const std::string& source)
      : trn_(trn),
        source_(source),
        far_(impossible_step(trn.cell_size)),
        doubtful_(doubtful_step(trn.cell_size)),
        lowest_(lowest_land - trn.origin.z()) {}

  std::vector<Doubt> find() {
    for (int r = 0; r < trn_.n_rows; ++r)
      for (int c = 0; c < trn_.n_cols; ++c) look(r, c);
    for (const LoneLevel& level : levels()) {
      Doubt& doubt = add(level.row, level.col, level_area);
      doubt.found = std::to_string(level.n_cells) + " nodes of one height, more than " +
                    text(doubtful_, 4) + " m off most of what is beside: is it undeclared nodata?";
      doubt.hint = "where it is not ground, declare its height as nodata in the file";
    }
    for (const Seam& seam : find_seams(trn_)) add_seam(seam);
    std::stable_sort(found_.begin(), found_.end(),
                     [](const PlacedDoubt& a, const PlacedDoubt& b) { return a.node < b.node; });
    std::vector<Doubt> doubts;
    for (PlacedDoubt& placed : found_) doubts.push_back(std::move(placed.doubt));
    return doubts;
  }

 private:
  struct PlacedDoubt {
    std::size_t node;
    Doubt doubt;
  };

  Doubt& add(int row, int col, const char* what, double expected = no_value) {
    Doubt& doubt = found_.emplace_back(PlacedDoubt{node_index(trn_, row, col), {}}).doubt;
    doubt.where.file = source_;
    doubt.what = what;
    doubt.at = {node_point(trn_, row, col) + trn_.origin};
    doubt.value = doubt.at[0].z();
    if (std::isnan(expected)) return doubt;
    doubt.low = doubt.high = expected + trn_.origin.z();
    doubt.expected = "about " + text(doubt.low, 6) + " m, as beside it";
    return doubt;
  }

  void add_seam(const Seam& seam) {
    const int row = seam.between_rows ? seam.line : seam.middle;
    const int col = seam.between_rows ? seam.middle : seam.line;
    if (std::isnan(height(row, col))) return;
    add(row, col, "seam", height(row, col) + seam.step_m).found =
        "a step of " + text(std::abs(seam.step_m), 3) +
        " m along a straight line of nodes: do two tiles, sources or height systems meet there?";
  }

  [[nodiscard]] double height(int row, int col) const {
    const bool is_inside = row >= 0 && col >= 0 && row < trn_.n_rows && col < trn_.n_cols;
    return is_inside ? trn_.elevation[node_index(trn_, row, col)] : no_value;
  }

  void add_sunken(int row, int col) {
    Doubt& doubt = add(row, col, "sunken node");
    doubt.found = "lower than any land";
    doubt.low = lowest_land;
    doubt.expected = text(lowest_land) + " m or more";
    doubt.hint =
        "declare it as nodata, or mend the units; --accept-doubts takes ground below the sea (make "
        "TRN_FLAGS=--accept-doubts)";
    doubt.state = DoubtState::refused;
  }

  void look(int row, int col) {
    const double z = height(row, col);
    if (std::isnan(z)) return;
    if (z < lowest_) return add_sunken(row, col);
    constexpr std::array<std::array<int, 2>, 4> beside = {{{-1, 0}, {0, -1}, {0, 1}, {1, 0}}};
    for (const auto& [dr, dc] : beside) {
      const double other = height(row + dr, col + dc), difference = std::abs(z - other);
      if (!(difference > doubtful_)) continue;
      values_.insert({z, other});
      const bool is_rim = std::isnan(height(row - dr, col - dc));
      if (!is_rim && !(difference > far_ && (dr > 0 || dc > 0))) continue;  // said by the other
      add(row, col, is_rim ? "rim node" : "step", other).found =
          is_rim ? "at the rim of what is known, more than " + text(doubtful_, 4) +
                       " m off the next: is it blended with nodata?"
                 : "more than " + text(far_, 4) + " m to the next node: is it ground?";
      return;
    }
  }

  [[nodiscard]] std::vector<LoneLevel> levels() const {
    if (values_.empty()) return {};
    LoneLevels areas(trn_.n_cols, doubtful_, values_);
    for (int r = 0; r < trn_.n_rows; ++r)
      areas.add_row(trn_.elevation.data() + node_index(trn_, r, 0));
    std::vector<LoneLevel> found = areas.all();
    std::erase_if(found, [](const LoneLevel& level) { return level.n_cells < 2; });
    return found;
  }

  const Trn& trn_;
  const std::string& source_;
  double far_, doubtful_, lowest_;
  std::set<double> values_;  // at both ends of doubtful steps
  std::vector<PlacedDoubt> found_;
};

}  // namespace

double doubtful_step(double cell_size) { return std::max(20.0, 5 * cell_size); }

std::vector<Doubt> find_ground_doubts(const Trn& trn, const std::string& source) {
  return DoubtFinder(trn, source).find();
}

}  // namespace talus
