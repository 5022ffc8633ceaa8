// Rows and words of blocks that were deep in something.
#include "record/deep_rows.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/text.hpp"
#include "base/words.hpp"
#include "scene/fence.hpp"
#include "scene/scene.hpp"
#include "scene/state.hpp"
#include "step/step.hpp"

namespace talus {
namespace {

using std::size_t;

constexpr double before_toe = 0.95;  // of the mass: deposits beyond it are the toe

// The start of the mass that was highest: distances count from there.
Vec2 top_of(const Scene& scene) {
  const auto& rest = scene.blocks.rest;
  return std::max_element(
             rest.begin(), rest.end(),
             [](const Pose& a, const Pose& b) { return a.position.z() < b.position.z(); })
      ->position.head<2>();
}

// Distance in plan of each block from the top.
std::vector<double> distances(const Scene& scene, const State& state) {
  const Vec2 top = top_of(scene);
  std::vector<double> list;
  for (int b = 0; b < n_blocks(scene); ++b) {
    const Vec3 at = motion_at(scene, state, b, state.time).pose.position;
    list.push_back((at.head<2>() - top).norm());
  }
  return list;
}

// Up to this distance the blocks hold `before_toe` of the mass, the block there included.
double distance_of_toe(const std::vector<double>& distance, const std::vector<double>& mass) {
  std::vector<size_t> order(distance.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](size_t a, size_t b) { return distance[a] < distance[b]; });
  const double enough = before_toe * std::accumulate(mass.begin(), mass.end(), 0.0);
  double sum = 0;
  for (const size_t b : order) {
    sum += mass[b];
    if (sum >= enough) return distance[b];
  }
  return distance[order.back()];
}

void set_partner(const Scene& scene, int partner, DeepRow& row) {
  row.partner = partner;
  if (!names_fixed(partner)) return;
  const int panel = panel_number(scene, fixed_of_name(partner));
  row.partner = panel < 0 ? DeepRow::fixed_body : DeepRow::fence;
  if (panel < 0) return;
  row.line = scene.fixed.panels[panel].line;
  row.panel = scene.fixed.panels[panel].number;
}

double share_of_mass(const Scene& scene, int block) {
  const std::vector<double>& mass = scene.blocks.mass;
  return mass[static_cast<size_t>(block)] / std::accumulate(mass.begin(), mass.end(), 0.0);
}

// Deep in a fence, or deep before it came to one: its effect on the fence may be wrong. A block
// that lies there and is pressed by the next ones has had all the effect that is read of it.
bool met_fence(const State& state, std::span<const Crossing> crossings, const DeepRow& row) {
  const auto is_of = [&row](const auto& met) {
    return met.block == row.block && met.time >= row.first_time;
  };
  return row.partner == DeepRow::fence ||
         std::any_of(state.fence.hits.begin(), state.fence.hits.end(), is_of) ||
         std::any_of(crossings.begin(), crossings.end(), [&](const Crossing& crossing) {
           return is_of(crossing) && crossing.n_crossings > 0;
         });
}

}  // namespace

std::vector<DeepRow> deep_rows(const Scene& scene, const State& state,
                               std::span<const Crossing> crossings) {
  std::vector<DeepRow> rows;
  for (size_t b = 0; b < state.deep.size(); ++b) {
    const DeepBlock& deep = state.deep[b];
    if (deep.steps == 0) continue;
    DeepRow& row = rows.emplace_back();
    row.block = static_cast<std::int32_t>(b);
    set_partner(scene, deep.partner, row);
    row.steps = deep.steps;
    row.first_time = deep.first_time;
    row.time = deep.time;
    row.depth = deep.depth;
    row.thickness = scene.blocks.shapes.thickness[b];
    row.place = deep.place;
    row.is_too_fast = deep.is_too_fast ? 1 : 0;
    row.met_fence = met_fence(state, crossings, row) ? 1 : 0;
  }
  if (rows.empty()) return rows;
  std::vector<double> mass = scene.blocks.mass;
  for (size_t b = 0; b < mass.size(); ++b)
    if (!exists(state.phase[b])) mass[b] = 0;
  const std::vector<double> distance = distances(scene, state);
  const double total = std::accumulate(mass.begin(), mass.end(), 0.0),
               toe = distance_of_toe(distance, mass);
  for (DeepRow& row : rows) {
    row.mass_share = scene.blocks.mass[row.block] / total;
    row.ends_in_toe = distance[row.block] >= toe ? 1 : 0;
  }
  return rows;
}

double mass_share(std::span<const DeepRow> rows) {
  double sum = 0;
  for (const DeepRow& row : rows) sum += row.mass_share;
  return sum;
}

int n_that_matter(std::span<const DeepRow> rows) {
  return static_cast<int>(std::count_if(rows.begin(), rows.end(), [](const DeepRow& row) {
    return row.ends_in_toe != 0 || row.met_fence != 0 || row.is_too_fast != 0;
  }));
}

std::vector<DeepRow> by_weight(std::span<const DeepRow> rows) {
  std::vector<DeepRow> sorted(rows.begin(), rows.end());
  std::stable_sort(sorted.begin(), sorted.end(), [](const DeepRow& a, const DeepRow& b) {
    const int a_matters = n_that_matter({&a, 1}), b_matters = n_that_matter({&b, 1});
    return a_matters != b_matters ? a_matters > b_matters : a.mass_share > b.mass_share;
  });
  return sorted;
}

std::string partner_name(const DeepRow& row, std::span<const RecordLine> lines) {
  if (row.partner == DeepRow::ground) return "the ground";
  if (row.partner == DeepRow::fixed_body) return "the fixed slope";
  if (row.partner >= 0) return "block " + std::to_string(row.partner);
  const std::string panel = "panel " + std::to_string(row.panel) + " of fence ";
  const auto line = static_cast<size_t>(row.line);
  return panel + (line < lines.size() ? lines[line].name : std::to_string(row.line));
}

DeepRow deepest_row(const Scene& scene, const NumericalFault& deepest) {
  DeepRow row;
  row.block = static_cast<std::int32_t>(deepest.block);
  set_partner(scene, deepest.partner, row);
  row.time = deepest.time;
  row.depth = deepest.depth;
  row.thickness = scene.blocks.shapes.thickness[static_cast<size_t>(deepest.block)];
  row.place = deepest.place;
  row.mass_share = share_of_mass(scene, deepest.block);
  return row;
}

std::string where_words(double time, const Vec3& place) {
  const auto metres = [](double x) { return text(std::round(10 * x) / 10); };
  return "at " + text(time, 4) + " s near " + metres(place.x()) + ", " + metres(place.y()) + ", " +
         metres(place.z());
}

std::string fault_words(const Scene& scene, const NumericalFault& fault, const Vec3& origin) {
  if (fault.block < 0) return "";
  return "first block " + std::to_string(fault.block) + " " +
         where_words(fault.time, fault.place + origin) + ", " +
         percent(share_of_mass(scene, fault.block)) + " of the mass";
}

std::string deep_words(const DeepRow& row, std::span<const RecordLine> lines, const Vec3& origin) {
  std::string words = "block " + std::to_string(row.block) + " was in " + partner_name(row, lines) +
                      " by " + text(row.depth, 3) + " m of its " + text(row.thickness, 3) + " m " +
                      where_words(row.time, row.place + origin);
  if (row.steps > 0) words += ", deep in " + counted(row.steps, "step");
  words += ", " + percent(row.mass_share) + " of the mass";
  if (row.ends_in_toe != 0) words += ", ends in the toe";
  if (row.met_fence != 0) words += ", met a fence";
  if (row.is_too_fast != 0) words += ", was faster than its fall can have made it";
  return words;
}

}  // namespace talus
