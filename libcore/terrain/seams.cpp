// Steps of one height along a straight line of nodes, where two sources of heights meet.
#include "terrain/seams.hpp"

#include <algorithm>
#include <cmath>

#include "base/percentile.hpp"

namespace talus {
namespace {

constexpr int most_looks = 1000;  // nodes of a line
constexpr std::size_t fewest_looks = 16;
constexpr double least_step_m = 0.5;
constexpr double beyond_usual = 6;   // of a step, against the median over all lines
constexpr double alike = 0.25;       // of the step, within which steps of one line are one
constexpr double share_alike = 0.8;  // of the nodes of a line

// Steps beside the slope between nodes `line` and `line` + 1 of all rows (or columns) looked at.
std::vector<double> steps_at(const Trn& trn, bool between_rows, int line) {
  const int n = between_rows ? trn.n_cols : trn.n_rows;
  const int stride = std::max(1, n / most_looks);
  const auto height = [&](int along, int across) {
    const int row = between_rows ? across : along, col = between_rows ? along : across;
    return trn.elevation[node_index(trn, row, col)];
  };
  std::vector<double> steps;
  for (int k = 0; k < n; k += stride) {
    const double a = height(k, line - 1), b = height(k, line), c = height(k, line + 1),
                 d = height(k, line + 2);
    const double before = b - a, after = d - c;
    const double step = (c - b) - 0.5 * (before + after);
    // a rim or a ridge bends by more than it steps
    if (std::isfinite(step)) steps.push_back(std::abs(after - before) < std::abs(step) ? step : 0);
  }
  return steps;
}

struct Line {
  int number = 0;
  double step_m = 0;  // median
  bool is_one_step = false;
};

Line line_of(int number, std::vector<double> steps) {
  Line line{number, 0, false};
  if (steps.size() < fewest_looks) return line;
  line.step_m = median(steps);
  const auto is_alike = [&](double step) {
    return std::abs(step - line.step_m) <= alike * std::abs(line.step_m);
  };
  const auto n_alike = std::count_if(steps.begin(), steps.end(), is_alike);
  line.is_one_step =
      std::abs(line.step_m) >= least_step_m &&
      static_cast<double>(n_alike) >= share_alike * static_cast<double>(steps.size());
  return line;
}

void find_seams(const Trn& trn, bool between_rows, std::vector<Seam>& seams) {
  const int n_lines = between_rows ? trn.n_rows : trn.n_cols;
  std::vector<Line> lines;
  std::vector<double> sizes;
  for (int line = 1; line + 2 < n_lines; ++line) {
    lines.push_back(line_of(line, steps_at(trn, between_rows, line)));
    sizes.push_back(std::abs(lines.back().step_m));
  }
  if (lines.empty()) return;
  const double usual = median(sizes);
  const auto stands_out = [&](const Line& line) {
    return line.is_one_step && std::abs(line.step_m) > beyond_usual * usual;
  };
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (!stands_out(lines[i])) continue;
    seams.push_back({between_rows, lines[i].number, (between_rows ? trn.n_cols : trn.n_rows) / 2,
                     lines[i].step_m});
  }
}

}  // namespace

std::vector<Seam> find_seams(const Trn& trn) {
  std::vector<Seam> seams;
  for (const bool between_rows : {false, true}) find_seams(trn, between_rows, seams);
  return seams;
}

}  // namespace talus
