// Doubts about values of a site that are valid but most likely mistakes.
#include "site/plausibility.hpp"

#include <algorithm>
#include <cmath>

#include "base/text.hpp"
#include "base/words.hpp"

namespace talus {
namespace {

std::string metres(double value) { return text(value, 3) + " m"; }
// A value that should stay below `warn`, and is implausible from `refuse` on.
struct Upper {
  double warn, refuse;
};

class Doubts {
 public:
  void above(double value, const Upper& limit, const std::string& key, const std::string& finding,
             const std::string& hint) {
    if (!(value > limit.warn)) return;
    const bool refused = value >= limit.refuse;
    add(value, refused, key, finding, hint).high = refused ? limit.refuse : limit.warn;
  }
  // The same for a value that should stay above.
  void below(double value, const Upper& limit, const std::string& key, const std::string& finding,
             const std::string& hint) {
    if (!(value < limit.warn)) return;
    const bool refused = value < limit.refuse;
    add(value, refused, key, finding, hint).low = refused ? limit.refuse : limit.warn;
  }
  std::vector<Doubt> list;

 private:
  Doubt& add(double value, bool refused, const std::string& key, const std::string& finding,
             const std::string& hint) {
    Doubt& doubt = list.emplace_back();
    doubt.what = key, doubt.found = finding, doubt.hint = hint, doubt.value = value;
    doubt.state = refused ? DoubtState::refused : DoubtState::in_doubt;
    return doubt;
  }
};

constexpr double never_high = std::numeric_limits<double>::infinity(), never_low = -never_high;

void look_at_depth(const PlausibilityFacts& f, Doubts& doubts) {
  const double size = std::sqrt(f.polygon_area);
  const std::string units =
      "check the failure surface and its units: all lengths and heights are in metres";
  doubts.above(f.mean_depth / size, {0.25, 1}, f.depth_key,
               "the mass is " + metres(f.mean_depth) + " deep on average, " +
                   text(f.mean_depth / size, 2) + " of the size of the source (" + metres(size) +
                   "); slides have 0.02 to 0.25",
               units);
  doubts.above(f.max_depth / f.relief, {0.5, 1}, f.depth_key,
               "the mass is up to " + metres(f.max_depth) + " deep, " +
                   percent(f.max_depth / f.relief) + " of the relief over it (" + metres(f.relief) +
                   ")",
               units);
  doubts.above(f.mean_depth / f.normal_depth, {2, 5}, "source.failure_surface",
               "a depth of " + metres(f.normal_depth) + " along the normal is " +
                   metres(f.mean_depth) + " upright: the face is steep",
               "give the surface as a plane (failure_surface = \"daylighting\")");
}

void look_at_resolution(const PlausibilityFacts& f, Doubts& doubts) {
  doubts.below(f.width / f.cell_size, {10, 3}, "terrain.cell_size_m",
               "the source is " + text(f.width / f.cell_size, 2) + " cells wide (cells of " +
                   metres(f.cell_size) + "); 10 or more show its form",
               "take smaller cells, or a finer elevation model");
  doubts.below(f.smallest_spacing / f.cell_size, {1, never_low}, "terrain.cell_size_m",
               "joints are " + metres(f.smallest_spacing) + " apart, cells " + metres(f.cell_size) +
                   "; blocks smaller than a cell lie on a bed smoother "
                   "than they are",
               "widen the spacings, or take smaller cells");
  doubts.below(f.width / f.smallest_spacing, {3, 1}, "joints.spacing_m",
               "the source is " + text(f.width / f.smallest_spacing, 2) +
                   " spacings wide; below 3 no block has neighbours on all sides",
               "narrow the spacings");
  doubts.above(f.polygon_area / f.terrain_area, {0.3, never_high}, "terrain",
               "the source covers " + percent(f.polygon_area / f.terrain_area) +
                   " of the terrain: the mass will leave it",
               "extend the terrain down the slope (window_m, or a larger elevation model)");
  doubts.above(f.n_blocks, {1000, never_high}, "joints.spacing_m",
               text(f.n_blocks) + " blocks take long to compute",
               "widen the spacings at first; see the time below");
}

void look_at_motion(const PlausibilityFacts& f, Doubts& doubts) {
  doubts.above(
      f.step_at_foot / f.sliding_spacing, {low_step_spacings, never_high}, "source.failure_surface",
      "the mass leans on a step of up to " + metres(f.step_at_foot) + " along " +
          percent(f.step_share) + " of its foot",
      f.daylights ? "move the lower edge of the source to where the surface comes out, or leave "
                    "out what leans on it: daylight = \"...\""
                  : "a surface that comes out at the foot: failure_surface = \"daylighting\", or "
                    "daylight = \"...\" (talus-source lists what there is)");
  doubts.below(f.moved_share, {0.9, never_low}, "source.failure_surface",
               f.moved_share < 0.1 ? "this is not a rockslide: " + percent(f.moved_share) +
                                         " of the mass goes in the probe, the rest stands"
                                   : percent(f.moved_share) +
                                         " of the mass goes in the probe: the rest is likely "
                                         "to stay",
               "look at the step at the foot, at friction against the dip of the failure surface, "
               "and at the blocks that lock");
  doubts.above(
      f.left_share, {0.01, never_high}, "terrain",
      percent(f.left_share) + " of the fall lines from the source leave the known terrain",
      "extend the terrain down the slope (window_m, or a larger elevation model), or fill the hole "
      "in it that they end in: what leaves the terrain is counted, and not followed");
  doubts.below(f.duration, {f.travel_duration, never_low}, "solver.duration_s",
               "the run lasts " + text(f.duration, 3) +
                   " s; points that slide from the source ask for " +
                   text(std::ceil(f.travel_duration), 3) + " s",
               "duration_s = " + text(std::ceil(f.travel_duration)));
}

// Magnitudes: rocks in centimetres, fences that nobody builds, slides every month.
void look_at_magnitudes(const PlausibilityFacts& f, Doubts& doubts) {
  doubts.above(f.largest_rock, {1000, 1e5}, "rockfall",
               "the largest rock has " + text(f.largest_rock, 3) +
                   " m3; those that fall one by one have up to some hundred",
               "check size_m (metres) and volume_m3, or cut the mass by [source] and [joints.*]");
  doubts.above(f.frequency, {1, 100}, f.frequency_key,
               "the whole mass goes " + text(f.frequency, 3) + " times a year",
               "check the frequency: it counts events a year, not the years between them");
  for (const PlausibilityFacts::Fence& fence : f.fences) {
    doubts.above(fence.height, {12, 50}, fence.section + ".height_m",
                 "the fence is " + metres(fence.height) + " high; they are built up to about 10 m",
                 "check the height: it is in metres");
    doubts.above(
        fence.capacity, {20'000, 1e6}, fence.section + ".capacity_kj",
        "a panel takes " + text(fence.capacity, 3) + " kJ; fences are tested up to about 10,000 kJ",
        "check the capacity: it is in kJ");
  }
}

// Of 10 ms and one simulated second; a step of 5 ms needs 1.7 times as much. Masses of 70, 150 and
// 258 blocks took 0.6, 1.1 and 3.0 s; one of 873 that leans on a step of 22 m took 44 s.
constexpr double cpu_factor = 8e-4, cpu_power = 1.49, probe_step = 0.01;
const double step_power = std::log2(1.7);
constexpr double jam_s = 10;  // how long a mass stays packed
constexpr double cpu_of_loose_second = 0.3;

double whole_run(double packed_second, double duration) {
  return packed_second * std::min(duration, jam_s) +
         std::min(cpu_of_loose_second, packed_second) * std::max(0.0, duration - jam_s);
}

}  // namespace

std::vector<Doubt> doubts_of(const PlausibilityFacts& facts) {
  Doubts doubts;
  look_at_depth(facts, doubts);
  look_at_resolution(facts, doubts);
  look_at_motion(facts, doubts);
  look_at_magnitudes(facts, doubts);
  return doubts.list;
}

Outlook outlook_of(double moved_share) {
  if (moved_share < 0.1) return Outlook::stands;
  return moved_share > 0.9 ? Outlook::goes : Outlook::goes_in_part;
}

const char* text(Outlook outlook) {
  switch (outlook) {
    case Outlook::stands:
      return "stands";
    case Outlook::goes_in_part:
      return "goes in part";
    case Outlook::goes:
      return "goes";
  }
  return "";
}

double cpu_s_of_a_packed_second(double n_blocks, double dt) {
  return cpu_factor * std::pow(n_blocks, cpu_power) * std::pow(probe_step / dt, step_power);
}

double expected_cpu_s(double n_blocks, double duration, double dt) {
  return whole_run(cpu_s_of_a_packed_second(n_blocks, dt), duration);
}

double expected_cpu_s_alone(double n_rocks) {
  constexpr double cpu_of_a_rock = 0.01;  // tests/studies/speed.py
  return cpu_of_a_rock * n_rocks;
}

double scaled_cpu_s(double probe_cpu, double probe_duration, double probe_dt, double duration,
                    double dt) {
  return whole_run(probe_cpu / probe_duration * std::pow(probe_dt / dt, step_power), duration);
}

}  // namespace talus
