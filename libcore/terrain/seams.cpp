// Steps of one height along a straight line of nodes, where two sources of heights meet.
#include "terrain/seams.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

#include "base/numbers.hpp"
#include "base/percentile.hpp"
#include "terrain/as_index.hpp"

namespace talus {
namespace {

constexpr int most_looks = 1000;                   // nodes of a line
constexpr std::array<int, 3> widths = {1, 4, 16};  // looks of which the median is taken
constexpr int fewest = 16;                         // medians of a line, or of a part of it
constexpr double least_step_m = 0.5;
constexpr double beyond_usual = 6;       // of a step, against the median over other lines
constexpr double share_of_others = 0.1;  // that may have half of it: tiles are wide, pixels are not
constexpr double alike = 0.25;           // of the step, within which steps of one line are one
constexpr double share_alike = 0.8;      // of the medians of a line, or a part
constexpr double share_going_on = 0.6;   // of those by which a part is longer
constexpr int lines_beside = 32;         // on either side, against which a part is held
constexpr int lines_to_rim = 4;          // a rim of contours has steps of its own
constexpr int medians_to_corner = 3;     // between the ends of two parts that meet
constexpr int fewest_of_island = 64;     // looks: a tile is larger than a house

// The lines between rows, or those between columns; line `i` lies between nodes i and i + 1.
struct SeamLines {
  SeamLines(const Trn& terrain, bool of_rows)
      : trn(terrain),
        between_rows(of_rows),
        n_lines((of_rows ? trn.n_rows : trn.n_cols) - 1),
        n_along(of_rows ? trn.n_cols : trn.n_rows),
        stride(std::max(1, n_along / most_looks)) {}

  // Steps beside the slope, at every `stride`-th node from `first` to `last`; NaN: not known.
  [[nodiscard]] std::vector<double> looks(int line, int first, int last) const {
    const auto height = [&](int along, int across) {
      const int row = between_rows ? across : along, col = between_rows ? along : across;
      return trn.elevation[node_index(trn, row, col)];
    };
    std::vector<double> found;
    for (int k = first; k <= last; k += stride) {
      const double a = height(k, line - 1), b = height(k, line), c = height(k, line + 1),
                   d = height(k, line + 2);
      const double before = b - a, after = d - c;
      const double step = (c - b) - 0.5 * (before + after);
      // a rim or a ridge bends by more than it steps
      found.push_back(std::isnan(step) || std::abs(after - before) < std::abs(step) ? step : 0);
    }
    return found;
  }

  const Trn& trn;
  bool between_rows;
  int n_lines, n_along, stride;
};

// Rough ground hides a step of single nodes, not that of their medians.
std::vector<double> medians_of(const std::vector<double>& looks, int width) {
  if (width == 1) return looks;
  std::vector<double> found;
  std::array<double, widths.back()> some{};
  for (auto begin = looks.begin(); looks.end() - begin >= width; begin += width) {
    const auto end = std::copy(begin, begin + width, some.begin());
    const bool is_known =
        std::none_of(begin, begin + width, [](double z) { return std::isnan(z); });
    if (is_known) std::nth_element(some.begin(), some.begin() + width / 2, end);
    found.push_back(is_known ? some[as_index(width / 2)] : no_value);
  }
  return found;
}

bool is_alike(double step, double of) { return std::abs(step - of) <= alike * std::abs(of); }

struct LineStep {
  double size_m = 0;  // median
  bool is_one = false;
};

LineStep step_of(std::vector<double> steps, double least_m) {
  std::erase_if(steps, [](double step) { return std::isnan(step); });
  if (std::ssize(steps) < fewest) return {};
  const double size_m = median(steps);
  const auto n_alike = std::count_if(steps.begin(), steps.end(),
                                     [size_m](double step) { return is_alike(step, size_m); });
  return {size_m,
          std::abs(size_m) >= least_m &&
              static_cast<double>(n_alike) >= share_alike * static_cast<double>(steps.size())};
}

// --- parts of lines ------------------------------------------------------------------------------

// From node `first` to `last` of a line.
struct SeamPart {
  bool between_rows = false;
  int line = 0, first = 0, last = 0;
  int n_looks = 0;
  int reach = 0;  // of its ends, to the corner of a tile [nodes]
  double step_m = 0;
  bool is_first_at_edge = false, is_last_at_edge = false;  // of known ground
  bool is_open = false;                                    // an end meets nothing
};

// Heights that are rounded step at each contour of the rounding.
double least_step_of(const Trn& trn) {
  const std::size_t stride = 1 + trn.elevation.size() / 100'000;
  for (const double unit : {10.0, 5.0, 2.0, 1.0, 0.5}) {
    std::size_t n = 0, n_whole = 0;
    for (std::size_t i = 0; i < trn.elevation.size(); i += stride) {
      const double z = (trn.elevation[i] + trn.origin.z()) / unit;
      n += std::isnan(z) ? 0 : 1;
      n_whole += std::abs(z - std::round(z)) < 1e-6 ? 1 : 0;
    }
    if (10 * n_whole > 9 * n) return 2 * unit;
  }
  return least_step_m;
}

// The look up to which steps go on from look `from` as `of`.
int end_of_run(const std::vector<double>& steps, int from, int direction, double of) {
  constexpr double per_other = share_going_on / (1 - share_going_on);
  double score = 0, best = 0;
  int end = from;
  for (int k = from + direction; k >= 0 && k < std::ssize(steps); k += direction) {
    const double step = steps[as_index(k)];
    if (std::isnan(step)) continue;
    score += is_alike(step, of) ? 1 : -per_other;
    if (score > best) best = score, end = k;
  }
  return end;
}

bool is_at_edge(const std::vector<double>& steps, int end, int direction) {
  for (int k = end; std::abs(k - end) <= medians_to_corner; k += direction)
    if (k < 0 || k >= std::ssize(steps) || std::isnan(steps[as_index(k)])) return true;
  return false;
}

// `sizes`: of steps on other lines, and their median.
bool is_unusual(double step, const std::vector<double>& sizes, double usual) {
  const auto n_half = std::count_if(sizes.begin(), sizes.end(),
                                    [step](double size) { return size > std::abs(step) / 2; });
  return std::abs(step) > beyond_usual * usual &&
         static_cast<double>(n_half) <= share_of_others * static_cast<double>(sizes.size());
}

// Whether most of the ground on either side is known where it is.
bool is_inside(const SeamLines& lines, const SeamPart& part) {
  const std::vector<double> here = lines.looks(part.line, part.first, part.last);
  const auto is_known = [&](int line) {
    if (line < 1 || line > lines.n_lines - 2) return false;
    const std::vector<double> there = lines.looks(line, part.first, part.last);
    int n = 0, n_known = 0;
    for (std::size_t k = 0; k < here.size(); ++k) {
      n += std::isnan(here[k]) ? 0 : 1;
      n_known += std::isnan(here[k] + there[k]) ? 0 : 1;
    }
    return 2 * n_known > n;
  };
  return is_known(part.line - lines_to_rim) && is_known(part.line + lines_to_rim);
}

// Whether its step is beyond what is usual on the lines beside, over the same nodes.
bool stands_out(const SeamLines& lines, const SeamPart& part, int width) {
  std::vector<double> sizes;
  const int end = std::min(lines.n_lines - 2, part.line + lines_beside);
  for (int line = std::max(1, part.line - lines_beside); line <= end; ++line) {
    if (std::abs(line - part.line) < 2) continue;
    const std::vector<double> steps = medians_of(lines.looks(line, part.first, part.last), width);
    sizes.push_back(std::abs(step_of(steps, least_step_m).size_m));
  }
  return !sizes.empty() && is_unusual(part.step_m, sizes, median(sizes));
}

void find_parts(const SeamLines& lines, int line, int width, const std::vector<double>& steps,
                double least_m, std::vector<SeamPart>& parts) {
  const auto is_high = [&](int k) {
    return std::abs(steps[as_index(k)]) >= (1 - alike) * least_m ? 1 : 0;
  };
  const auto step = [&](int from, int to) {
    return step_of({steps.begin() + from, steps.begin() + to + 1}, least_m);
  };
  const int spacing = width * lines.stride;
  int n_high = 0;  // from `begin` on
  for (int k = 0, begin = 0; k < std::ssize(steps); ++k) {
    n_high += is_high(k);
    if (k - begin >= fewest) n_high -= is_high(begin++);
    if (n_high < share_alike * fewest) continue;
    const LineStep here = step(begin, k);
    if (!here.is_one) continue;
    const int first = end_of_run(steps, begin, -1, here.size_m);
    const int last = end_of_run(steps, k, 1, here.size_m);
    const LineStep all = step(first, last);
    SeamPart part;
    part.between_rows = lines.between_rows;
    part.line = line;
    part.first = first * spacing;
    part.last = std::min((last + 1) * spacing, lines.n_along) - 1;
    part.n_looks = (last - first + 1) * width;
    part.reach = medians_to_corner * spacing;
    part.step_m = all.size_m;
    part.is_first_at_edge = is_at_edge(steps, first, -1);
    part.is_last_at_edge = is_at_edge(steps, last, 1);
    if (all.is_one && is_inside(lines, part) && stands_out(lines, part, width))
      parts.push_back(part);
    k = std::max(k, last);
    begin = k + 1;
    n_high = 0;
  }
}

// Whether the end of a part at node `end` lies on another part, as at the corner of a tile.
bool ends_on(const SeamPart& part, int end, const SeamPart& other) {
  const int reach = std::max(part.reach, other.reach);
  const bool is_same_way = part.between_rows == other.between_rows;
  const int along = is_same_way ? end : part.line, across = is_same_way ? part.line : end;
  return std::abs(other.line - across) <= reach && along >= other.first - reach &&
         along <= other.last + reach;
}

bool meet(const SeamPart& a, const SeamPart& b) {
  return ends_on(a, a.first, b) || ends_on(a, a.last, b) || ends_on(b, b.first, a) ||
         ends_on(b, b.last, a);
}

// A tile has corners; a cliff ends.
void drop_open(std::vector<SeamPart>& parts) {
  const auto is_open = [&parts](const SeamPart& part, int end, bool is_at_edge) {
    return !is_at_edge && std::none_of(parts.begin(), parts.end(), [&](const SeamPart& other) {
      return &other != &part && ends_on(part, end, other);
    });
  };
  do {
    for (SeamPart& part : parts)
      part.is_open = is_open(part, part.first, part.is_first_at_edge) ||
                     is_open(part, part.last, part.is_last_at_edge);
  } while (std::erase_if(parts, [](const SeamPart& part) { return part.is_open; }) > 0);
}

// What is joined to no edge is a house or a platform, unless a side is as long as that of a tile.
void drop_small_islands(std::vector<SeamPart>& parts) {
  auto end_of_kept = std::partition(parts.begin(), parts.end(), [](const SeamPart& part) {
    return part.is_first_at_edge || part.is_last_at_edge || part.n_looks >= fewest_of_island;
  });
  for (auto kept = parts.begin(); kept != end_of_kept; ++kept)
    end_of_kept = std::partition(end_of_kept, parts.end(),
                                 [&kept](const SeamPart& part) { return meet(part, *kept); });
  parts.erase(end_of_kept, parts.end());
}

// Of parts that lie on one another the longest stays.
void drop_repeated(std::vector<SeamPart>& parts) {
  std::sort(parts.begin(), parts.end(), [](const SeamPart& a, const SeamPart& b) {
    return std::tuple(a.between_rows, a.line, a.first - a.last, a.first) <
           std::tuple(b.between_rows, b.line, b.first - b.last, b.first);
  });
  std::vector<SeamPart> kept;
  for (const SeamPart& part : parts) {
    const auto is_on = [&part](const SeamPart& other) {
      return other.between_rows == part.between_rows && other.line == part.line &&
             other.first <= part.last && part.first <= other.last;
    };
    if (std::none_of(kept.begin(), kept.end(), is_on)) kept.push_back(part);
  }
  parts = std::move(kept);
}

// --- lines from edge to edge ---------------------------------------------------------------------

void find_whole(const SeamLines& lines, const std::vector<LineStep>& steps,
                std::vector<SeamPart>& parts) {
  std::vector<double> sizes;
  for (const LineStep& step : steps) sizes.push_back(std::abs(step.size_m));
  if (sizes.empty()) return;
  const double usual = median(sizes);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (!steps[i].is_one || !is_unusual(steps[i].size_m, sizes, usual)) continue;
    SeamPart part;
    part.between_rows = lines.between_rows;
    part.line = static_cast<int>(i) + 1;
    part.last = lines.n_along - 1;
    part.reach = medians_to_corner * lines.stride;
    part.step_m = steps[i].size_m;
    part.is_first_at_edge = part.is_last_at_edge = true;
    if (is_inside(lines, part)) parts.push_back(part);
  }
}

void find_parts_of_all(const SeamLines& lines, double least_m, std::vector<SeamPart>& parts) {
  std::array<std::vector<LineStep>, widths.size()> of_lines;
  for (int line = 1; line + 1 < lines.n_lines; ++line) {
    const std::vector<double> looks = lines.looks(line, 0, lines.n_along - 1);
    for (std::size_t w = 0; w < widths.size(); ++w) {
      const std::vector<double> steps = medians_of(looks, widths[w]);
      of_lines[w].push_back(step_of(steps, least_m));
      find_parts(lines, line, widths[w], steps, least_m, parts);
    }
  }
  for (const std::vector<LineStep>& steps : of_lines) find_whole(lines, steps, parts);
}

}  // namespace

std::vector<Seam> find_seams(const Trn& trn) {
  std::vector<SeamPart> parts;
  const double least_m = least_step_of(trn);
  for (const bool between_rows : {false, true})
    find_parts_of_all(SeamLines(trn, between_rows), least_m, parts);
  drop_open(parts);
  drop_small_islands(parts);
  drop_repeated(parts);
  std::vector<Seam> seams;
  for (const SeamPart& part : parts)
    seams.push_back({part.between_rows, part.line, (part.first + part.last) / 2, part.step_m});
  return seams;
}

}  // namespace talus
