#include "terrain/ground_doubts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "terrain/elevation.hpp"
#include "terrain/lone_levels.hpp"
#include "terrain/seams.hpp"

namespace talus {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

class DoubtFinder {
 public:
  explicit DoubtFinder(const Trn& trn)
      : trn_(trn),
        far_(impossible_step(trn.cell_size)),
        doubtful_(doubtful_step(trn.cell_size)),
        lowest_(lowest_land - trn.origin.z()) {}

  std::vector<GroundDoubt> find() {
    for (int r = 0; r < trn_.n_rows; ++r)
      for (int c = 0; c < trn_.n_cols; ++c) look(r, c);
    for (const LoneLevel& level : levels())
      found_.push_back({GroundDoubtKind::level, level.row, level.col, nan, level.n_cells});
    for (const Seam& seam : find_seams(trn_)) {
      const int row = seam.between_rows ? seam.line : seam.middle;
      const int col = seam.between_rows ? seam.middle : seam.line;
      if (std::isnan(height(row, col))) continue;
      found_.push_back({GroundDoubtKind::seam, row, col, height(row, col) + seam.step_m, 1});
    }
    std::stable_sort(found_.begin(), found_.end(), [](const GroundDoubt& a, const GroundDoubt& b) {
      return std::pair(a.row, a.col) < std::pair(b.row, b.col);
    });
    return std::move(found_);
  }

 private:
  [[nodiscard]] double height(int row, int col) const {
    const bool is_inside = row >= 0 && col >= 0 && row < trn_.n_rows && col < trn_.n_cols;
    return is_inside ? trn_.elevation[node_index(trn_, row, col)] : nan;
  }

  void look(int row, int col) {
    const double z = height(row, col);
    if (std::isnan(z)) return;
    if (z < lowest_) {
      found_.push_back({GroundDoubtKind::below_land, row, col, nan, 1});
      return;
    }
    constexpr std::array<std::array<int, 2>, 4> beside = {{{-1, 0}, {0, -1}, {0, 1}, {1, 0}}};
    for (const auto& [dr, dc] : beside) {
      const double other = height(row + dr, col + dc), difference = std::abs(z - other);
      if (!(difference > doubtful_)) continue;
      values_.insert({z, other});
      const bool is_rim = std::isnan(height(row - dr, col - dc));
      if (!is_rim && !(difference > far_ && (dr > 0 || dc > 0))) continue;  // said by the other
      found_.push_back({is_rim ? GroundDoubtKind::rim : GroundDoubtKind::step, row, col, other, 1});
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
  double far_, doubtful_, lowest_;
  std::set<double> values_;  // at both ends of doubtful steps
  std::vector<GroundDoubt> found_;
};

}  // namespace

double doubtful_step(double cell_size) { return std::max(20.0, 5 * cell_size); }

std::vector<GroundDoubt> find_ground_doubts(const Trn& trn) { return DoubtFinder(trn).find(); }

}  // namespace talus
