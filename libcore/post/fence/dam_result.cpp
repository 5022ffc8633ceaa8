// Blocks that reach a dam, those that pass over its crest, and whether it holds.
#include "post/fence/dam_result.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/grouped_text.hpp"
#include "base/numbers.hpp"
#include "base/text.hpp"
#include "post/fence/fence_text.hpp"
#include "post/percentile_bounds.hpp"
#include "post/statistics.hpp"

namespace talus {
namespace {

std::vector<FenceArrival> not_beside(const std::vector<FenceArrival>& all) {
  std::vector<FenceArrival> out;
  for (const FenceArrival& a : all)
    if (!a.beside) out.push_back(a);
  return out;
}

bool is_from_uphill(const FenceArrival& a, const DamCase& dam) {
  return a.direction == -dam.uphill;
}

// The crest and its straight continuations, which part the ground in two sides.
RecordLine continued(const RecordLine& crest) {
  constexpr double beyond = 1e5;  // farther than terrains reach [m]
  std::vector<Vec3> points = crest.points;
  const auto out_of = [&](const Vec3& end, const Vec3& next) {
    return Vec3(end + beyond * (end - next) / (end - next).head<2>().norm());
  };
  const std::size_t n = points.size();
  const Vec3 first = out_of(points[0], points[1]), last = out_of(points[n - 1], points[n - 2]);
  points.insert(points.begin(), first);
  points.push_back(last);
  return record_line(crest.name, std::move(points));
}

/// The side of a dam that a block ends on.
struct Sides {
  RecordLine line;
  Vec2 uphill = Vec2::Zero();  // a place close to the line

  explicit Sides(const DamCase& dam) : line(continued(dam.line)) {
    const Vec2 a = dam.line.points[0].head<2>(), b = dam.line.points[1].head<2>();
    const Vec2 along = (b - a).normalized();
    uphill = 0.5 * (a + b) + 1e-3 * dam.uphill * Vec2(-along.y(), along.x());
  }
  [[nodiscard]] bool is_downhill(const Vec2& at) const {
    return line_meetings(line, uphill, at).size() % 2 == 1;
  }
};

// Passages of the crest, and beside it, of blocks that came from uphill and end downhill.
std::vector<FenceArrival> passages(const FenceRun& run, const DamCase& dam) {
  const Sides sides(dam);
  std::vector<FenceArrival> out;
  for (const FenceArrival& a : passed_for_good(run.at_fence[dam.crest]))
    if (is_from_uphill(a, dam) && (!a.beside || sides.is_downhill(run.end[a.block].head<2>())))
      out.push_back(a);
  return out;
}

std::vector<FenceArrival> over_the_crest(const FenceRunGroup& group, const DamCase& dam) {
  std::vector<FenceArrival> out;
  for (int r = 0; r < n_runs(group); ++r)
    for (FenceArrival a : not_beside(passages(group.runs[r], dam))) {
      a.run = r;
      out.push_back(a);
    }
  return out;
}

// Height of the roof across from a place; beside its ends it has none.
double roof_at(const DamCase& gallery, const Vec2& at) {
  const std::vector<Vec3>& edge = gallery.line.points;
  double nearest = std::numeric_limits<double>::infinity(), height = no_value;
  for (std::size_t i = 0; i + 1 < edge.size(); ++i) {
    const Vec2 a = edge[i].head<2>(), along = edge[i + 1].head<2>() - a;
    const double share = (at - a).dot(along) / along.squaredNorm(), on = std::clamp(share, 0., 1.);
    const double off = (at - a - on * along).norm();
    if (!(off < nearest)) continue;
    nearest = off;
    const bool beside = (i == 0 && share < 0) || (i + 2 == edge.size() && share > 1);
    height = beside ? no_value : edge[i].z() + on * (edge[i + 1].z() - edge[i].z());
  }
  return height;
}

// Rock that crossed the uphill edge of a gallery and fell back, or that lies against its uphill
// wall, below the roof, did not come to it.
bool came(const FenceArrival& a, const FenceRun& run, const DamCase& dam) {
  if (a.beside || !is_from_uphill(a, dam)) return false;
  if (!dam.is_gallery) return true;
  const Vec3& end = run.end[a.block];
  return a.passed_for_good &&
         (Sides(dam).is_downhill(end.head<2>()) || !(end.z() < roof_at(dam, end.head<2>())));
}

std::vector<FenceArrival> came_to(const FenceRunGroup& group, const DamCase& dam) {
  std::vector<FenceArrival> out;
  for (const FenceArrival& a : arrivals_at(group, dam.arrival))
    if (came(a, group.runs[a.run], dam)) out.push_back(a);
  return out;
}

std::vector<RoofLoad> loads_at(const FenceRunGroup& group, const DamCase& gallery) {
  std::vector<RoofLoad> loads;
  for (int r = 0; r < n_runs(group); ++r)
    for (RoofLoad load : group.runs[r].at_fence[gallery.crest].loads) {
      load.run = r;
      loads.push_back(load);
    }
  std::stable_sort(loads.begin(), loads.end(), [](const RoofLoad& a, const RoofLoad& b) {
    return a.normal_energy() < b.normal_energy();
  });
  return loads;
}

void add_loads(const FenceRunGroup& group, const DamCase& gallery, DamResult& r) {
  constexpr std::array<std::pair<double, const char*>, 3> levels = {
      {{0.5, "p50"}, {0.95, "p95"}, {0.99, "p99"}}};
  const std::vector<RoofLoad> loads = loads_at(group, gallery);
  std::vector<BlockWeight> blocks;
  for (const RoofLoad& load : loads) {
    blocks.push_back({load.run, load.block, load.weight});
    r.n_hits += load.n_hits;
  }
  r.n_loads = static_cast<int>(loads.size());
  PercentileBounds bounds{group.clusters};
  for (const auto& [p, name] : levels) {
    const int place = percentile_places(bounds, blocks, p).place;
    r.load_cases.push_back({name, {}});
    if (place >= 0) r.load_cases.back().load = loads[place];
  }
  r.load_cases.push_back({"max", {}});
  if (!loads.empty()) r.load_cases.back().load = loads.back();
}

int n_moving(const FenceRunGroup& group, const DamCase& dam) {
  int sum = 0;
  for (const FenceRun& run : group.runs)
    for (const BlockVerdict& v : run.at_fence[dam.arrival].verdicts)
      sum += run.moves[v.block] != 0 &&
             (v.verdict == Verdict::stopped || v.verdict == Verdict::not_reached);
  return sum;
}

int n_from_downhill(const FenceRunGroup& group, const DamCase& dam) {
  int sum = 0;
  for (const FenceRun& run : group.runs)
    for (const FenceArrival& a : run.at_fence[dam.crest].crossings)
      sum += !a.beside && !is_from_uphill(a, dam);
  return sum;
}

std::string downhill_text(const DamResult& r) {
  return "not judged: blocks came to its crest from the side taken as downhill: " +
         std::to_string(r.n_from_downhill);
}

// Of blocks that did not come to it.
int n_ended_downhill(const FenceRunGroup& group, const DamCase& dam) {
  const Sides sides(dam);
  int sum = 0;
  for (const FenceRun& run : group.runs)
    for (const BlockVerdict& v : run.at_fence[dam.arrival].verdicts)
      sum += v.verdict == Verdict::not_reached && sides.is_downhill(run.end[v.block].head<2>());
  return sum;
}

// A dam on a counter-slope has its uphill side where no block comes from.
std::string nothing_came_text(const DamResult& r) {
  return r.n_ended_downhill == 0
             ? "not judged: nothing came to it"
             : "not judged: nothing came to it from the side taken as uphill; blocks that ended on "
               "the other side: " +
                   std::to_string(r.n_ended_downhill);
}

std::string moving_text(const DamResult& r) {
  return "blocks that had not passed it still moved at the end: " + std::to_string(r.n_moving);
}

void describe_gallery(DamResult& r) {
  if (r.n_from_downhill > 0) {
    r.verdict = DesignVerdict::from_downhill;
    r.text = downhill_text(r);
    return;
  }
  const std::string passed =
      std::to_string(r.passing.n) + " passed over it; its strength is not checked";
  if (r.arriving.n == 0 && r.n_loads == 0) {
    r.text = r.n_moving > 0 ? "not judged: " + moving_text(r) : nothing_came_text(r);
    if (r.n_moving > 0) r.verdict = DesignVerdict::still_moving;
    return;
  }
  r.verdict = DesignVerdict::energy_unknown;
  r.text = r.n_loads == 0 ? "no block hit the roof; " + passed
                          : std::to_string(r.n_loads) + " blocks hit the roof, the hardest with " +
                                grouped_text(r.load_cases.back().load->normal_energy() / 1e3) +
                                " kJ normal to it; " + passed;
}

void judge(const DamCase& dam, DamResult& r) {
  const double p95 = r.arriving.energy.percentile[place_of_p95].value;
  r.energy_use = p95 / dam.capacity;
  const std::string energy = grouped_text(p95 / 1e3) + " kJ (95 % of the blocks)",
                    capacity = ", the dam is for " + grouped_text(dam.capacity / 1e3) + " kJ";
  if (r.passing.n > 0) {
    r.verdict = DesignVerdict::does_not_meet;
    r.text = "does not hold: " + std::to_string(r.passing.n) + " of " +
             std::to_string(std::max(r.passing.n, r.arriving.n)) + " blocks passed over the crest";
  } else if (r.energy_use > 1) {
    r.verdict = DesignVerdict::does_not_meet;
    r.text = "does not hold: the energy is " + energy + capacity;
  } else if (r.n_from_downhill > 0) {
    r.verdict = DesignVerdict::from_downhill;
    r.text = downhill_text(r);
  } else if (r.n_moving > 0) {
    r.verdict = DesignVerdict::still_moving;
    r.text = "not judged: " + moving_text(r);
  } else if (r.arriving.n == 0) {
    r.text = nothing_came_text(r);
  } else if (std::isnan(p95)) {
    r.verdict = DesignVerdict::too_few;
    r.text = "not judged: too few arrivals, " + std::to_string(r.arriving.n) + " of " +
             std::to_string(smallest_sample(0.95)) + "; none passed over the crest";
  } else if (std::isnan(dam.capacity)) {
    r.verdict = DesignVerdict::energy_unknown;
    r.text = "high enough; no capacity given: energy not checked, " + energy;
  } else {
    r.verdict = DesignVerdict::meets;
    r.text = "holds: none passed over the crest; energy " + energy + capacity;
  }
}

}  // namespace

void set_verdicts(FenceRunGroup& group, const DamCase& dam) {
  for (FenceRun& run : group.runs) {
    RunAtFence &before = run.at_fence[dam.arrival], &crest = run.at_fence[dam.crest];
    for (BlockVerdict& v : before.verdicts) {
      v.verdict = Verdict::not_reached;
      if (v.arrival >= 0 && came(before.arrivals[v.arrival], run, dam))
        v.verdict = Verdict::stopped;
    }
    for (const FenceArrival& a : passages(run, dam))
      before.verdicts[a.block].verdict =
          a.beside ? crest.verdicts[a.block].verdict : Verdict::overtopped;
  }
}

DamResult dam_result(const DamCase& dam, const FenceRunGroup& group) {
  DamResult r;
  r.arriving = summarise(came_to(group, dam), group.clusters);
  r.passing = summarise(over_the_crest(group, dam), group.clusters);
  r.n_moving = n_moving(group, dam);
  r.n_from_downhill = n_from_downhill(group, dam);
  r.n_ended_downhill = n_ended_downhill(group, dam);
  if (dam.is_gallery) {
    add_loads(group, dam, r);
    describe_gallery(r);
  } else {
    judge(dam, r);
  }
  return r;
}

std::string dam_summary(const DamCase& dam, const DamResult& r, const FenceRunGroup& group) {
  return verdicts_text((dam.is_gallery ? "gallery " : "dam ") + dam.name, dam.arrival, group) +
         " " + std::to_string(r.arriving.n) + " came: " + r.text;
}

}  // namespace talus
