// The list of cases that talus-verify runs, with claims, references and methods.
#include "verify/cases/verify_cases.hpp"

#include <algorithm>

#include "base/text.hpp"
#include "verify/cases/block_cases.hpp"
#include "verify/cases/breakage_case.hpp"
#include "verify/cases/case_run.hpp"
#include "verify/cases/pile_scenes.hpp"
#include "verify/cases/stem_case.hpp"

namespace talus {
namespace {

using namespace cases;

void keep_worst(const CaseResult& one, CaseResult& worst) {
  if (one.error >= worst.error) {
    worst.value = one.value;
    worst.expected = one.expected;
    worst.error = one.error;
  }
  add_counts(one, worst);
}

CaseResult worst_rolling_angle(const CaseSettings& settings) {
  CaseResult worst;
  for (int n = 3; n <= 12; ++n) keep_worst(rolling_angle(settings, n), worst);
  return worst;
}

CaseResult worst_breaking_speed(const CaseSettings& settings) {
  CaseResult worst;
  for (const double side : {0.3, 1.0, 3.0}) keep_worst(breaking_speed(settings, side), worst);
  return worst;
}

VerifyCase slide_case(const std::string& name, double friction_deg, double bound) {
  return {
      .name = name,
      .claim = "a cube slides down 30 degrees at friction " + text(friction_deg) + " degrees, 4 s",
      .reference = "closed form (26)",
      .norm = "relative",
      .test = "LawTalus.SlidesAsInClosedForm",
      .bound = bound,
      .run = [=](const CaseSettings& s) { return sliding(s, friction_deg, 37, 4); }};
}

VerifyCase bounce_case(const std::string& name, double restitution, Landing landing) {
  return {
      .name = name,
      .claim = "three rebounds from 5 m at COR " + text(restitution) + " have the heights e^2k h",
      .reference = "closed form",
      .norm = "of the first fall, largest of three",
      .test = "LawTalus.BouncesToTheHeightAskedFor",
      .bound = 1e-11,
      .run = [=](const CaseSettings& s) { return bounce(s, restitution, landing); }};
}

std::vector<VerifyCase> single_block_cases() {
  return {
      {.name = "parabola",
       .claim = "a thrown block flies the parabola, 1 s",
       .reference = "closed form (25)",
       .norm = "m",
       .test = "LawTalus.ParabolaIsExact",
       .bound = 1e-12,
       .run = parabola},
      slide_case("slide_0", 0, 1e-6),
      slide_case("slide_5", 5, 1e-6),
      slide_case("slide_10", 10, 1e-6),
      slide_case("slide_15", 15, 1e-6),
      slide_case("slide_20", 20, 1e-6),
      slide_case("slide_25", 25, 1e-6),
      slide_case("slide_29", 29, 1e-5),
      slide_case("slide_29.9", 29.9, 1e-3),
      {.name = "stick",
       .claim = "a cube at friction 30.1 degrees does not creep on 30 degrees, 3 s",
       .reference = "rest",
       .norm = "m",
       .test = "LawTalus.SticksAboveTheDipAndSlidesBelow",
       .bound = 1e-8,
       .run =
           [](const CaseSettings& s) {
             CaseSettings awake = s;
             awake.sleep = false;
             return sliding(awake, 30.1, 37, 4);
           }},
      {.name = "oblique",
       .claim = "a cube at 10 m/s across the dip turns down it, 2 s",
       .reference = "integrated closed form",
       .norm = "share of the path",
       .test = "LawTalus.SlidesObliquely",
       .bound = 1e-5,
       .run = [](const CaseSettings& s) { return oblique_slide(s, 37); }},
      {.name = "rolling",
       .claim = "prisms of 3 to 12 sides start to roll at 180 / n degrees",
       .reference = "closed form (27)",
       .norm = "degrees, worst of ten",
       .test = "LawTalusDefault.PrismStartsToRollAtTheCriticalAngle",
       .bound = 0.003,
       .run = worst_rolling_angle},
      {.name = "sustained_rolling",
       .claim = "a prism of 12 sides rolls on at the steady speed of plastic edge impacts",
       .reference = "closed form (theory 4)",
       .norm = "relative",
       .test = "LawTalus.PrismRollsOnAtTheSteadySpeed",
       .bound = 0.01,
       .run = [](const CaseSettings& s) { return sustained_rolling(s, 12); }},
      bounce_case("bounce_face", 0.7, Landing::face),
      bounce_case("bounce_edge", 0.7, Landing::edge),
      bounce_case("bounce_corner", 0.7, Landing::corner),
      bounce_case("bounce_soft", 0.3, Landing::face),
      bounce_case("bounce_elastic", 1, Landing::corner),
      {.name = "corner_impulse",
       .claim = "a cube that lands on one corner takes (1 + e)(-v_n) / (n^T W n)",
       .reference = "closed form",
       .norm = "relative",
       .test = "LawTalus.CornerImpulseIsExact",
       .bound = 1e-8,
       .run = [](const CaseSettings& s) { return corner_impulse(s, 0.7); }},
      {.name = "free_spin",
       .claim = "a box spins about its middle axis in flight, 20 s",
       .reference = "Euler's equations by Runge-Kutta, 200,000 steps",
       .norm = "degrees",
       .test = "LawTalusDefault.SpinsFreelyAndTumblesInFlight",
       .bound = 0.01,
       .run = [](const CaseSettings& s) { return free_spin(s, 20); }},
      {.name = "tumbling",
       .claim = "the box that spins about its middle axis flies the parabola, 10 s",
       .reference = "closed form (25)",
       .norm = "m",
       .test = "LawTalus.TumblingBlockFliesTheParabola",
       .bound = 1e-12,
       .run = [](const CaseSettings& s) { return tumbling_flight(s, 10); }},
      {.name = "wedge",
       .claim = "a wedge slides along the line of its two planes, friction 20 degrees",
       .reference = "closed form",
       .norm = "relative",
       .test = "LawTalus.WedgeSlidesAsInClosedForm",
       .bound = 1e-4,
       .run = [](const CaseSettings& s) { return wedge(s, 20); }},
      {.name = "wedge_critical",
       .claim = "the wedge holds from 33.357 degrees of friction",
       .reference = "closed form",
       .norm = "degrees",
       .test = "LawTalusDefault.WedgeStopsSlidingAtTheCriticalFriction",
       .bound = 0.05,
       .run = wedge_critical,
       .shortest_strained_dt = 5e-3},
      {.name = "toppling",
       .claim = "a column topples from 26.565 degrees",
       .reference = "closed form",
       .norm = "degrees",
       .test = "LawTalusDefault.ColumnTopplesOrSlidesAtTheRightAngle",
       .bound = 0.05,
       .run = toppling_angle},
      {.name = "column_slides",
       .claim = "the same column at friction 20 degrees slides from 20 degrees",
       .reference = "closed form",
       .norm = "degrees",
       .test = "LawTalusDefault.ColumnTopplesOrSlidesAtTheRightAngle",
       .bound = 0.05,
       .run = sliding_angle},
      {.name = "bond",
       .claim = "a bonded cube comes off its slope at 36.374 degrees",
       .reference = "closed form",
       .norm = "degrees",
       .test = "Step.BondHoldsToItsStrengthAndBreaksForGood",
       .bound = 0.05,
       .run = bond_angle},
      {.name = "rocking",
       .claim = "a rocking column hits the ground after 0.48909 s",
       .reference = "integrated closed form",
       .norm = "relative",
       .test = "LawTalus.ColumnRocksAndLosesWhatHousnerSays",
       .bound = 1e-3,
       .run = rocking_time},
      {.name = "rocking_ratio",
       .claim = "that hit leaves it 0.91176 of its spin",
       .reference = "Housner's closed form",
       .norm = "relative",
       .test = "LawTalus.ColumnRocksAndLosesWhatHousnerSays",
       .bound = 1e-3,
       .run = rocking_ratio},
      {.name = "shaken",
       .claim = "a block on a shaken slope slides 3.19694 m in 10 s",
       .reference = "Newmark's sliding block",
       .norm = "relative",
       .test = "LawTalus.ShakenBlockSlidesAsNewmarkSays",
       .bound = 5e-3,
       .run = shaken_block},
      {.name = "energy_line",
       .claim = "a block stops where the line of its friction angle meets the ground",
       .reference = "H / tan(phi), without the friction of the curve (1e-3)",
       .norm = "relative",
       .test = "LawTalusDefault.EnergyLineHasTheSlopeOfFriction",
       .bound = 5e-3,
       .run = energy_line},
      {.name = "own_weight",
       .claim = "a cube of 10 m at rest carries the stress of its own weight",
       .reference = "rho g h / 2",
       .norm = "relative",
       .test = "LawTalus.OwnWeightStressesTheBlock",
       .bound = 1e-3,
       .run = own_weight,
       .has_strains = true},
      {.name = "elastic_cor",
       .claim = "a cube of E = 1e12 Pa that loses nothing else rebounds at the speed of its fall",
       .reference = "COR 1 (Fig. 12b)",
       .norm = "1 - COR",
       .test = "LawTalus.ElasticBlockReboundsWhole",
       .bound = 1e-11,
       .run = [](const CaseSettings& s) { return elastic_restitution(s, 1e12); },
       .has_strains = true,
       .paper_dt = {1e-4, 1e-5, 1e-6}},
      {.name = "ghost",
       .claim = "a cube at 20 m/s feels no edge of the cells of a plane of 17 degrees",
       .reference = "closed form",
       .norm = "m",
       .test = "LawTalus.NothingToCollideWithOnAPlane",
       .bound = 1e-6,
       .run = [](const CaseSettings& s) { return ghost_collisions(s, 17); }},
  };
}

// Yielding ground. Law paper knows none of it: its errors are those of firm ground.
std::vector<VerifyCase> soil_cases() {
  const auto of_soil = [](VerifyCase c) {
    c.paper_dt = {1e-2, 1e-3};
    return c;
  };
  return {
      of_soil({.name = "soil_bounce",
               .claim = "three rebounds from 5 m at a COR that falls with the speed of the hit",
               .reference = "closed form",
               .norm = "relative, largest of three",
               .test = "Soil.RestitutionFallsWithSpeedOrEnergy",
               .bound = 1e-6,
               .run = [](const CaseSettings& s) { return falling_restitution(s, false); }}),
      of_soil({.name = "soil_bounce_energy",
               .claim = "three rebounds from 5 m at a COR that falls with the energy of the hit",
               .reference = "closed form",
               .norm = "relative, largest of three",
               .test = "Soil.RestitutionFallsWithSpeedOrEnergy",
               .bound = 1e-6,
               .run = [](const CaseSettings& s) { return falling_restitution(s, true); }}),
      of_soil({.name = "soil_rolling",
               .claim = "a prism of 64 sides rolls to its stop, rolling resistance 0.1",
               .reference = "closed form of plastic hits of its edges",
               .norm = "relative",
               .test = "Soil.PrismRollsToItsStop",
               .bound = 0.01,
               .run = [](const CaseSettings& s) { return rolling_stop(s, 64, 0.1); }}),
      of_soil({.name = "soil_rolling_angle",
               .claim = "a prism of 6 sides starts to roll at 32.594 degrees, resistance 0.05",
               .reference = "closed form",
               .norm = "degrees",
               .test = "Soil.PrismStartsToRollAtItsAngle",
               .bound = 0.02,
               .run = [](const CaseSettings& s) { return resisted_rolling_angle(s, 6, 0.05); }}),
      of_soil({.name = "soil_edge",
               .claim = "a cube stands on its edge while its weight is within mu_r R_e of it",
               .reference = "closed form",
               .norm = "of that arm",
               .test = "Soil.CubeStandsOnItsEdgeWithinItsArm",
               .bound = 0.01,
               .run = [](const CaseSettings& s) { return standing_on_edge(s, 0.1); }}),
      of_soil({.name = "soil_pivoting",
               .claim = "a cube that pivots on its face stops in time, resistance 0.1",
               .reference = "closed form",
               .norm = "relative",
               .test = "Soil.PivotingStopsInTime",
               .bound = 1e-3,
               .run = pivoting_stop}),
      of_soil({.name = "soil_scar",
               .claim = "a slab at 10 m/s stops on ground whose friction grows as it slides",
               .reference = "closed form",
               .norm = "relative",
               .test = "Soil.ScarsStopASlab",
               .bound = 1e-3,
               .run =
                   [](const CaseSettings& s) {
                     return scarring_stop(s, scarring_ground(0.25, 1.25, 100), 10);
                   }}),
      of_soil({.name = "soil_creep",
               .claim = "a slab let go on 35 degrees comes to rest on ground that it scars",
               .reference = "closed form",
               .norm = "relative, of its largest speed and its way",
               .test = "Soil.ScarsHoldASlabThatCreeps",
               .bound = 1e-3,
               .run =
                   [](const CaseSettings& s) {
                     return scarring_creep(s, scarring_ground(0.35, 2, 150));
                   }}),
      of_soil({.name = "soil_weakening",
               .claim = "a slab at 10 m/s stops on ground whose friction falls with its speed",
               .reference = "integrated closed form",
               .norm = "relative",
               .test = "Soil.FrictionWeakensWithSpeed",
               .bound = 1e-3,
               .run = [](const CaseSettings& s) { return weakening_stop(s, 10); }}),
      of_soil({.name = "soil_runaway",
               .claim = "a slab on 20 degrees runs away above 7.497 m/s where friction weakens",
               .reference = "closed form",
               .norm = "relative",
               .test = "Soil.FrictionWeakensWithSpeed",
               .bound = 1e-3,
               .run = weakening_runaway}),
      of_soil({.name = "soil_drag",
               .claim = "a slab slides down 40 degrees against drag of 0.6 per second, 5 s",
               .reference = "closed form",
               .norm = "relative",
               .test = "Soil.DragSlowsASlide",
               .bound = 1e-3,
               .run = [](const CaseSettings& s) { return dragged_slide(s, false); }}),
      of_soil({.name = "soil_drag_way",
               .claim = "a slab slides down 40 degrees against drag of 0.02 per metre, 10 s",
               .reference = "closed form",
               .norm = "relative",
               .test = "Soil.DragSlowsASlide",
               .bound = 1e-3,
               .run = [](const CaseSettings& s) { return dragged_slide(s, true); }}),
      of_soil({.name = "soil_drag_stop",
               .claim = "a slab at 10 m/s stops by friction 0.3 and drag of 0.5 per second",
               .reference = "closed form",
               .norm = "relative",
               .test = "Soil.DragStopsASlide",
               .bound = 1e-3,
               .run = dragged_stop}),
  };
}

std::vector<VerifyCase> block_cases() {
  const auto of_blocks = [](int n, VerifyCase c) {
    c.n_blocks = n;
    return c;
  };
  return {
      of_blocks(3, {.name = "tower_slide",
                    .claim = "three cubes on a slope slide as one",
                    .reference = "closed form",
                    .norm = "relative",
                    .test = "StepIsland.TowerSlidesAsOne",
                    .bound = 2e-3,
                    .run = tower_slide}),
      of_blocks(3, {.name = "tower_holds",
                    .claim = "three cubes on 15 degrees hold at friction 15.5 degrees, 4 s",
                    .reference = "rest",
                    .norm = "m",
                    .test = "StepIsland.TowerHoldsWhereFrictionIsEnough",
                    .bound = 1e-6,
                    .run = tower_holds}),
      of_blocks(4, {.name = "pile_topples",
                    .claim = "a pile of four cubes topples from 14.036 degrees",
                    .reference = "closed form of a rigid pile",
                    .norm = "degrees",
                    .test = "ManyBlocks.PileTopplesWhereItsWeightLeavesItsBase",
                    .bound = 0.5,
                    .run = pile_topples}),
      of_blocks(2, {.name = "block_on_block",
                    .claim = "a cube slides on a plate that sticks, friction 20 degrees, 1.5 s",
                    .reference = "closed form (26)",
                    .norm = "relative",
                    .test = "ManyBlocks.BlockSlidesOnABlock",
                    .bound = 2e-3,
                    .run = block_on_block}),
      of_blocks(3,
                {.name = "groove",
                 .claim = "a keel slides in the groove of two blocks, friction 20 degrees, 1.5 s",
                 .reference = "closed form",
                 .norm = "relative",
                 .test = "ManyBlocks.WedgeSlidesInAGrooveOfTwoBlocks",
                 .bound = 5e-3,
                 .run = groove}),
      of_blocks(2, {.name = "head_on",
                    .claim = "cubes that meet face to face at COR 0.5 part with half their speed",
                    .reference = "closed form",
                    .norm = "relative",
                    .test = "StepIsland.HeadOnCollisionHasItsRestitution",
                    .bound = 4e-5,
                    .run = [](const CaseSettings& s) { return head_on(s, 0.5); }}),
      of_blocks(8, {.name = "collision",
                    .claim = "eight tumbling boxes that collide keep momentum, also angular",
                    .reference = "conservation",
                    .norm = "share of what they bring",
                    .test = "ManyBlocks.CollidingBlocksKeepMomentum",
                    .bound = 1e-10,
                    .run = [](const CaseSettings& s) { return collision(s, 0.5); }}),
      of_blocks(14, {.name = "dominoes",
                     .claim = "the wave along fourteen dominoes takes its time",
                     .reference = "angles and projected Gauss-Seidel, steps of 2e-5 s",
                     .norm = "relative",
                     .test = "ManyBlocks.DominoesFallAsARigidComputationSays",
                     .bound = 0.02,
                     .run = dominoes}),
      of_blocks(1, {.name = "stem",
                    .claim = "a stem takes its energy from a cube of 500 kg at 10 to 25 m/s",
                    .reference = "closed form, v'^2 = v^2 - 2 E / m",
                    .norm = "share of the speed before, worst of four",
                    .test = "Stems/CentralHit.TakesTheCapacityAndNoMore",
                    .bound = 1e-3,
                    .run = stem}),
      of_blocks(1, {.name = "forest_drag",
                    .claim = "a block of 1000 kg stops after 30 m in a forest of 500 kg/s",
                    .reference = "closed form, m v / d",
                    .norm = "relative",
                    .test = "Canopies.StopABlockInTheAir",
                    .bound = 1e-6,
                    .run = dragged_flight,
                    .paper_dt = {1e-2, 1e-3}}),
      of_blocks(2, {.name = "break_pieces",
                    .claim = "500 J drive pieces of 1000 and 1600 kg apart",
                    .reference = "momentum and energy",
                    .norm = "relative, of velocities and energy",
                    .test = "Breakage.SeparationEnergyDrivesPiecesApart",
                    .bound = 1e-9,
                    .run = pieces_part,
                    .paper_dt = {1e-2, 1e-3}}),
      of_blocks(2, {.name = "break_speed",
                    .claim = "cubes of 0.3, 1 and 3 m break from 16.786, 9.194 and 5.308 m/s on",
                    .reference = "closed form, sqrt(2 G / (rho a (1 - e^2)))",
                    .norm = "relative, worst of three",
                    .test = "BreakageAtStep.ThresholdSpeedFallsWithTheRootOfSize",
                    .bound = 1e-3,
                    .run = worst_breaking_speed,
                    .paper_dt = {1e-2, 1e-3}}),
      of_blocks(10, {.name = "stack_10",
                     .claim = "a stack of ten cubes stands still, 4 s",
                     .reference = "rest",
                     .norm = "m",
                     .test = "StepIsland/Stack.StandsStill",
                     .bound = 1e-6,
                     .run = [](const CaseSettings& s) { return stack_stands(s, 10, 5); }}),
      of_blocks(7, {.name = "arch",
                    .claim = "an arch of seven stones stands still, 5 s",
                    .reference = "rest",
                    .norm = "m",
                    .test = "ManyBlocks.ArchOfSevenStands",
                    .bound = 1e-6,
                    .run = arch_stands}),
      of_blocks(5, {.name = "large_on_small",
                    .claim = "a cube of 10 m rests on four of 0.1 m, 2 s",
                    .reference = "rest",
                    .norm = "m",
                    .test = "StepIsland.LargeBlockRestsOnSmallOnes",
                    .bound = 1e-3,
                    .run = large_on_small}),
      of_blocks(2, {.name = "thin_plate",
                    .claim = "a plate of 10 x 10 x 0.1 m rests on a cube of 2 m, 4 s",
                    .reference = "rest",
                    .norm = "m",
                    .test = "ManyBlocks.ThinPlateRestsOnABlock",
                    .bound = 1e-6,
                    .run = thin_plate}),
  };
}

// Events within a step, at their times.
std::vector<VerifyCase> event_cases() {
  return {
      {.name = "rolling_64",
       .claim = "a prism of 64 sides rolls down 5 degrees from rest, 2 s",
       .reference = "pivot, plastic hit, next pivot",
       .norm = "of the way, largest",
       .test = "Events.PrismsRollHitByHit",
       .bound = 1e-3,
       .run =
           [](const CaseSettings& s) {
             return prism_rolls(s, {64, 5, 0}, 2);
           },
       .shortest_strained_dt = 1},
      {.name = "bounces_on_slope",
       .claim = "a slab falls flat on 20 degrees at COR 0.8 and friction 25 degrees, all bounces",
       .reference = "closed form",
       .norm = "relative",
       .test = "Events.AFlatSlabBouncesDownASlope",
       .bound = 1e-3,
       .run = [](const CaseSettings& s) { return bouncing_slab(s, 0.8); }},
      {.name = "top",
       .claim = "a top of twelve sides spins on its tip at 60 rad/s, 3 s",
       .reference = "Lagrange's top, integrated",
       .norm = "degrees",
       .test = "Events.ATopNutates",
       .bound = 0.1,
       .run = [](const CaseSettings& s) { return spinning_top(s, 60); },
       .shortest_strained_dt = 1},
      {.name = "lifted",
       .claim = "the ground drops away from a slab at twice gravity, stops, and is met again",
       .reference = "closed form",
       .norm = "of the largest height",
       .test = "Events.DroppingGroundLetsGoInTheMiddleOfAStep",
       .bound = 1e-3,
       .run = lifted_slab},
      {.name = "harmonic",
       .claim = "a slab slides on the flat in a harmonic motion at 60 degrees to east, 4 s",
       .reference = "Newmark's sliding block, integrated",
       .norm = "relative",
       .test = "Events.AHarmonicMotionSlidesASlab",
       .bound = 1e-3,
       .run = harmonic_slide},
      {.name = "over_edge",
       .claim = "a slab slides over the edge of a cliff at 3 m/s and tips, 1.5 s",
       .reference = "integrated closed form",
       .norm = "m",
       .test = "Events.ASlabTipsOverAnEdge",
       .bound = 1e-3,
       .run = slab_over_edge},
      {.name = "border",
       .claim = "a slab slides from friction 10 onto friction 22 degrees, 1.6 s",
       .reference = "integrated closed form",
       .norm = "relative",
       .test = "Events.FrictionChangesWhereTheBorderIs",
       .bound = 1e-4,
       .run = border_slide},
  };
}

std::vector<VerifyCase> contact_cases() {
  const auto of_blocks = [](int n, VerifyCase c) {
    c.n_blocks = n;
    c.paper_dt = {1e-2, 1e-3};
    return c;
  };
  return {
      of_blocks(8, {.name = "tower_topples",
                    .claim = "eight cubes topple at 1.05 of their angle, time to 0.2 rad",
                    .reference = "one rigid column, integrated",
                    .norm = "relative",
                    .test = "Piles.TowerTopplesWhenARigidOneDoes",
                    .bound = 0.01,
                    .run = tower_topples}),
      of_blocks(16, {.name = "twin_towers",
                     .claim = "two towers of eight cubes side by side stand at 0.97 of that, 2 s",
                     .reference = "rest",
                     .norm = "of a side",
                     .test = "Piles/PileStands.UpToTheAngleOfARigidOne",
                     .bound = 1e-3,
                     .run =
                         [](const CaseSettings& s) {
                           return pile_moves(s, {.across = 2, .high = 8, .share = 0.97}, 2);
                         }}),
      of_blocks(10, {.name = "stack_of_1_cm",
                     .claim = "ten cubes of 1 cm on each other sag by no more, 1 s",
                     .reference = "rest",
                     .norm = "of a side",
                     .test = "Sides/Sag.OfAStackOfTenIsAPartOfItsSide",
                     .bound = 1e-4,
                     .run =
                         [](const CaseSettings& s) {
                           return pile_moves(s, {.high = 10, .side = 0.01}, 1);
                         }}),
      of_blocks(2, {.name = "tumbling_pairs",
                    .claim = "cubes that tumble at up to 14 rad/s and meet return COR 0.9",
                    .reference = "what momentum and angular momentum say",
                    .norm = "COR, worst hit",
                    .test = "Hits.EveryHitOfATumblingPairReturnsItsRestitution",
                    .bound = 0.01,
                    .run = [](const CaseSettings& s) { return tumbling_pairs(s, 0.9); }}),
      of_blocks(2, {.name = "borne_slab",
                    .claim = "a cube rebounds from a slab that the ground bears, COR 0.7",
                    .reference = "hits in turn in one dimension",
                    .norm = "relative",
                    .test = "Hits.ACubeReboundsFromABorneSlabAsHitByHit",
                    .bound = 0.01,
                    .run = borne_slab}),
      of_blocks(5, {.name = "unequal_row",
                    .claim = "five unequal blocks in a row pass a hit on at COR 0.9",
                    .reference = "event by event in one dimension",
                    .norm = "of the speed of the first",
                    .test = "Hits.AnUnequalRowPassesItsHitsOnInOrder",
                    .bound = 0.01,
                    .run = [](const CaseSettings& settings) { return unequal_row(settings); }}),
      of_blocks(6, {.name = "plastic_row",
                    .claim = "six cubes in a row hit and go on together",
                    .reference = "momentum",
                    .norm = "relative",
                    .test = "Hits.APlasticPileUpStaysTogether",
                    .bound = 1e-3,
                    .run = plastic_row}),
      of_blocks(8, {.name = "elastic_bowl",
                    .claim = "eight elastic cubes in a bowl keep their energy, 4 s",
                    .reference = "conservation",
                    .norm = "relative",
                    .test = "Hits.ElasticBoxesInABowlKeepTheirEnergy",
                    .bound = 0.01,
                    .run = elastic_bowl}),
      of_blocks(2, {.name = "parts_on_ridge",
                    .claim = "a plate of two parts rests on a ridge of 20 degrees, 1 s",
                    .reference = "rest",
                    .norm = "of its size",
                    .test = "PartsOnRidges.APlateOfTwoPartsDoesNotSinkIn",
                    .bound = 1e-4,
                    .run = [](const CaseSettings& s) { return parts_on_ridge(s, 10); }}),
      of_blocks(2, {.name = "parts_land_flat",
                    .claim = "a slab of two parts falls flat with friction and stays flat",
                    .reference = "symmetry",
                    .norm = "of the speed of the hit",
                    .test = "Verify/EachCase.IsWithinItsBound",
                    .bound = 1e-3,
                    .run = parts_land_flat}),
  };
}

// Changes by a method of the settings of its law.
struct Change {
  double stiffness = 0;
  bool strains = false;
  double tolerance = 1;
};

Method law_talus(const Change& change, std::vector<double> dt) {
  Method method{"talus", {}, std::move(dt)};
  method.settings.normal_stiffness = change.stiffness;
  method.settings.strains = change.strains;
  method.settings.tolerance_factor = change.tolerance;
  if (change.stiffness > 0) method.name += ", k_n " + text(change.stiffness, 2);
  if (change.strains) method.name += ", strains";
  if (change.tolerance != 1) method.name += ", tolerance x " + text(change.tolerance, 2);
  return method;
}

Method law_paper(const Change& change, std::vector<double> dt) {
  Method method = law_talus(change, std::move(dt));
  method.name.replace(0, 5, "paper");
  method.settings.paper.emplace();
  return method;
}

// Law talus computes blocks that touch each other rigid, law paper with strains: a tenth of the
// speed, so at few steps.
void add_full_study(const VerifyCase& c, std::vector<Method>& methods) {
  const double default_dt = Settings{}.dt;
  const std::vector<double> few = {1e-2, default_dt, 1e-3};
  const bool is_alone = c.n_blocks == 1;
  methods.push_back(
      law_talus({}, {4e-1, 2.5e-1, 1.6e-1, 1e-1, 5e-2, 2e-2, 1e-2, default_dt, 2e-3, 1e-3, 2e-4}));
  for (const double stiffness : {1e8, 5e10}) methods.push_back(law_talus({stiffness}, few));
  for (const double tolerance : {1e4, 1e2, 1e-2})
    methods.push_back(law_talus({0, false, tolerance}, few));
  if (is_alone && !c.has_strains) {
    methods.push_back(law_talus({0, true}, few));
    std::erase_if(methods.back().dt, [&c](double dt) { return dt < c.shortest_strained_dt; });
  }
  const std::vector<double> dt = {1e-2, 3e-3, 1e-3, 3e-4, 1e-4};
  for (const double stiffness : {paper_stiffness, 5e8})
    methods.push_back(law_paper({stiffness}, dt));
  if (!c.has_strains)
    methods.push_back(
        law_paper({paper_stiffness, true}, is_alone ? dt : std::vector<double>{1e-2, 3e-3, 1e-3}));
}

}  // namespace

const std::vector<VerifyCase>& verify_cases() {
  static const std::vector<VerifyCase> list = [] {
    std::vector<VerifyCase> all = single_block_cases();
    for (VerifyCase& c : event_cases()) all.push_back(std::move(c));
    for (VerifyCase& c : soil_cases()) all.push_back(std::move(c));
    for (VerifyCase& c : block_cases()) all.push_back(std::move(c));
    for (VerifyCase& c : contact_cases()) all.push_back(std::move(c));
    return all;
  }();
  return list;
}

std::vector<Method> methods_of(const VerifyCase& c, bool full) {
  std::vector<Method> methods;
  if (full) {
    add_full_study(c, methods);
  } else {
    methods.push_back(law_talus({}, {1e-2, Settings{}.dt}));
    methods.push_back(law_paper({paper_stiffness}, {1e-2, 1e-3}));
  }
  for (Method& method : methods)
    if (method.settings.paper && !c.paper_dt.empty()) method.dt = c.paper_dt;
  return methods;
}

}  // namespace talus
