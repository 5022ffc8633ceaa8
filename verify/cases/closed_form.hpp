// verify/cases/closed_form.hpp
// Cases with a closed form (or an independent integration): each runs the engine with the settings
// given and returns its error. The tests bound them; talus-verify draws them against run time.
// theory 4; g = 10 m/s2 throughout
#pragma once

#include <array>
#include <optional>

#include "paper/paper_state.hpp"
#include "scene/scene.hpp"
#include "step/report.hpp"

namespace talus {

/// How a case is computed: by law talus, or by law paper where that has settings.
struct CaseSettings : Settings {
  std::optional<PaperSettings> paper;
};

}  // namespace talus

namespace talus::cases {

/// Outcome of a case. The meaning of `error`, and its unit, are said at the case.
struct CaseResult {
  double value = 0;     ///< computed
  double expected = 0;  ///< closed form
  double error = 0;     ///< as said at the case
  long steps = 0;       ///< calls of step()
  long passes = 0;      ///< Newton or open-close iterations
  long unconverged = 0;
  double largest_penetration = 0;  ///< [m]
  double momentum_change = 0;      ///< of the angular momentum, relative [-]; free_spin() alone
  double cpu = 0;                  ///< of the start and the steps, not of the scene's set-up [s]
  double reference_cpu = 0;        ///< spent on `expected` where it is integrated [s]
  StepFlag flags = StepFlag::none;
};

/// Projectile, 10 m/s sideways, 1 s (25a, b): largest error of the three coordinates [m].
CaseResult parabola(const CaseSettings& settings);

/// Cube of 1 m sliding from rest on 30 degrees (26), `duration_s` long. Slope turned by
/// `azimuth_deg`, `offset` = local coordinates of the start. Relative error of the displacement
/// down the dip; with friction above 30 degrees the displacement after the first quarter of the
/// time [m].
CaseResult sliding(const CaseSettings& settings, double friction_deg, double azimuth_deg,
                   double duration_s, const Vec3& offset = Vec3::Zero(), double cell_size = 0.5);

/// Cube starting at 10 m/s across the dip of 30 degrees, friction 20 degrees, 2 s: distance to the
/// integrated closed form over the length of the path.
CaseResult oblique_slide(const CaseSettings& settings, double azimuth_deg);

/// Critical rolling initiation angle of a prism of n sides, 180 / n (27): error by bisection [deg].
CaseResult rolling_angle(const CaseSettings& settings, int n_sides);

/// Sustained rolling of a prism at 10 degrees with plastic edge impacts: speed before an impact in
/// the steady state, relative error (theory 4, 5).
CaseResult sustained_rolling(const CaseSettings& settings, int n_sides);

enum class Landing { face, edge, corner };
/// Drop of a cube from 5 m: largest relative error of the first three rebound heights e^2k h.
CaseResult bounce(const CaseSettings& settings, double restitution, Landing landing);

/// Cube landing on one corner, no friction: relative error of p = (1 + e)(-v_n) / (n^T W n).
CaseResult corner_impulse(const CaseSettings& settings, double restitution);

/// 2 x 3 x 5 m box spinning about its middle axis for `duration_s` in flight: error of the attitude
/// [deg].
CaseResult free_spin(const CaseSettings& settings, double duration_s);

/// The same box in the same flight: largest departure of its centroid from the parabola [m].
CaseResult tumbling_flight(const CaseSettings& settings, double duration_s);

/// Double-face wedge 40/130 and 60/220 (dip/dip direction): relative error of the acceleration
/// along the line of intersection, plunge 37.058 degrees.
CaseResult wedge(const CaseSettings& settings, double friction_deg);
/// Its critical friction angle, 33.357 degrees: error by bisection [deg].
CaseResult wedge_critical(const CaseSettings& settings);

/// Column 0.5 m wide and 1 m high: angle at which it topples, atan(b / h) = 26.565 degrees [deg].
CaseResult toppling_angle(const CaseSettings& settings);
/// The same column with friction 20 degrees: angle at which it slides [deg].
CaseResult sliding_angle(const CaseSettings& settings);

/// Cube bonded to its slope, friction 20 degrees, cohesion and tension 0.3 rho g h: angle at which
/// the bond fails, sin(a) - tan(20) cos(a) = 0.3, 36.374 degrees: error by bisection [deg].
CaseResult bond_angle(const CaseSettings& settings);

/// Rocking column 0.5 m x 2 m let go at half its slenderness angle: relative error of the time of
/// the first impact, 0.48909 s, or of the ratio of the spins after and before it, 1 - 1.5 sin^2
/// alpha.
CaseResult rocking_time(const CaseSettings& settings);
CaseResult rocking_ratio(const CaseSettings& settings);

/// Block on 20 degrees, tan(phi) = tan 30 degrees, base shaken horizontally by 5 sin(2 pi t) m/s2
/// for 10 s (Newmark's sliding block): relative error of the displacement, 3.196940 m.
CaseResult shaken_block(const CaseSettings& settings);

/// Slab on the flat, friction 15 degrees, base motion 4 sin(2 pi 0.7 (t - 0.3)) m/s2 at 60 degrees
/// east of north from 0.3 to 2.7 s: error of its displacement after 4 s along and across that, over
/// it.
CaseResult harmonic_slide(const CaseSettings& settings);

/// Block of 0.2 m sliding down a slope that eases from 27 to 23 degrees, friction 25 degrees:
/// relative error of the run-out L = H / tan(phi) (energy line; the curve's own friction is below
/// 0.2 %).
CaseResult energy_line(const CaseSettings& settings);

/// Cube of 10 m under its own weight, strains on: relative error of the mean vertical stress rho g
/// h / 2.
CaseResult own_weight(const CaseSettings& settings);

/// Cube of 1.7 m, turned by 0.3 rad, at 20 m/s over 80 m of a frictionless plane with 1 m cells and
/// the given dip: largest distance to the closed form [m].
CaseResult ghost_collisions(const CaseSettings& settings, double dip_deg);

/// Slab of 2 x 2 x 0.3 m that falls flat from 1 m on 20 degrees, friction 25 degrees: relative
/// error of the distance down the dip after all of its bounces, 5 s.
CaseResult bouncing_slab(const CaseSettings& settings, double restitution);

/// A prism of radius 1 m that turns about its lower edge at first.
struct Rolling {
  int n_sides = 0;
  double dip_deg = 0;
  double spin = 0;  ///< at the start [rad/s]
  double begin =
      -1;  ///< its centroid from the normal at that edge, as a share of half a side's angle
};
/// Of 3 to 128 sides. Two come to rest, one after a side, one after rocking; the rest continues
/// to roll. None flies.
inline constexpr std::array<Rolling, 10> rolling_prisms = {{{3, 0, 0, 0.6},
                                                            {4, 0, 2.6},
                                                            {5, 15, 1.2},
                                                            {6, 10, 1.3},
                                                            {8, 10, 1.5},
                                                            {12, 8, 1.5},
                                                            {16, 6, 1.2},
                                                            {32, 5, 1},
                                                            {64, 5, 0},
                                                            {128, 4, 0}}};
/// Friction 85 degrees: largest error of the path in `duration_s`, as a part of all of it, side by
/// side (pivot, plastic hit, next pivot).
CaseResult prism_rolls(const CaseSettings& settings, const Rolling& rolling, double duration_s);

/// Top of twelve sides on its tip, which sticks, let go at 20 degrees with `spin` about its axis:
/// how far the axis is from Lagrange's after 3 s [deg].
CaseResult spinning_top(const CaseSettings& settings, double spin);

/// Slab on ground that drops away at twice gravity for 0.3 s and stops: largest error of its height
/// above the ground, as a part of the largest height.
CaseResult lifted_slab(const CaseSettings& settings);

/// Slab of 4 x 0.4 m that slides over the edge of a cliff at 3 m/s, no friction: it tips about the
/// edge while it slides on. Error of the place of its centroid after 1.5 s [m].
CaseResult slab_over_edge(const CaseSettings& settings);

/// Slab sliding down 30 degrees from ground of friction 10 degrees onto ground of 22: relative
/// error of the path, 1.6 s.
CaseResult border_slide(const CaseSettings& settings);

/// Elastic cube of modulus `young` that falls on its face at 4 m/s and loses nothing else (COR 1;
/// of law paper that of the springs alone, which has to resolve the hit): speed after over speed
/// before, error 1 less that.
CaseResult elastic_restitution(const CaseSettings& settings, double young);

// --- yielding ground (closed_form_soil.cpp) ---------------------------------------------------

/// Cube dropped on its face from 5 m, COR 0.9 that falls by speed (v_h 10 m/s) or by energy (20
/// kJ): largest relative error of the first three heights.
CaseResult falling_restitution(const CaseSettings& settings, bool by_energy);

/// Prism of n sides, as heavy as a ball of its radius, that rolls at 2 m/s on the flat: relative
/// error of the path to its stop by rolling resistance and plastic hits of its edges.
CaseResult rolling_stop(const CaseSettings& settings, int n_sides, double resistance);

/// Critical rolling initiation angle of a prism with rolling resistance, tan = tan(pi / n) + mu_r
/// R_e / (R cos(pi / n)): error by bisection [deg].
CaseResult resisted_rolling_angle(const CaseSettings& settings, int n_sides, double resistance);

/// Cube on its edge, its weight off it: the offset at which it balances, in arms mu_r R_e; error by
/// bisection of the one that is known, 1.
CaseResult standing_on_edge(const CaseSettings& settings, double resistance);

/// Cube that pivots on its face at 10 rad/s without friction: relative error of the time to its
/// stop.
CaseResult pivoting_stop(const CaseSettings& settings);

/// Ground whose friction grows from tan(phi) = `least` to 2 along the slid distance.
GroundClass scarring_ground(double least, double rate, double decay);
/// Slab at `speed` on the flat: relative error of the path to its stop.
CaseResult scarring_stop(const CaseSettings& settings, const GroundClass& ground, double speed);
/// Slab from rest on 35 degrees: relative error of its largest speed or of the path to its stop.
CaseResult scarring_creep(const CaseSettings& settings, const GroundClass& ground);

/// Friction 0.84 at rest, 0.11 at high speed, halfway at 4 m/s; and the distance on the flat from
/// `speed` to rest, the integral of v / (g mu(v)) [m].
[[nodiscard]] GroundClass weakening_ground();
[[nodiscard]] double weakening_way(double speed);

/// Slab at `speed` on such ground, flat: the same.
CaseResult weakening_stop(const CaseSettings& settings, double speed);
/// The same slab on 20 degrees: relative error of the speed above which it runs away, at which
/// friction is tan(20 degrees), 7.497 m/s.
CaseResult weakening_runaway(const CaseSettings& settings);

/// Slab from rest on 40 degrees, friction 30 degrees, drag per time (0.6 1/s, 5 s) or per distance
/// (0.02 1/m, 10 s): relative error of its speed, by time or by distance, and of its path.
CaseResult dragged_slide(const CaseSettings& settings, bool per_way);
/// Slab at 10 m/s on the flat, friction 0.3, drag 0.5 1/s: relative error of the path to its stop.
CaseResult dragged_stop(const CaseSettings& settings);

}  // namespace talus::cases
