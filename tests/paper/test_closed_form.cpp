// The closed forms of theory 4 with law talus: one default setting for all. Each case runs at the
// default step, at dt = 1e-2 and at a small step; the bounds are the required ones, not the errors
// reached (listed in docs/evidence/verification.md).
#include <gtest/gtest.h>

#include "verify/cases/closed_form.hpp"

namespace {

using namespace talus;
using namespace talus::cases;

CaseSettings with_dt(double dt) {
  CaseSettings settings;
  settings.dt = dt;
  return settings;
}

class LawTalus : public testing::TestWithParam<double> {
 protected:
  CaseSettings settings = with_dt(GetParam());
};
INSTANTIATE_TEST_SUITE_P(Steps, LawTalus, testing::Values(1e-2, Settings{}.dt, 1e-3));

TEST_P(LawTalus, ParabolaIsExact) { EXPECT_LT(parabola(settings).error, 1e-12); }

TEST_P(LawTalus, SlidesAsInClosedForm) {
  for (const double friction : {0.0, 5.0, 10.0, 15.0, 20.0, 25.0, 29.0}) {
    const double bound = friction < 29 ? 1e-6 : 1e-5;
    EXPECT_LT(sliding(settings, friction, 0, 1).error, bound) << friction;
    EXPECT_LT(sliding(settings, friction, 37, 1).error, bound) << friction;
  }
}

// Local coordinates as large as map coordinates: worse than any site, whose origin lies near it.
TEST_P(LawTalus, SlidesAtMapCoordinatesToTheSameDigits) {
  const Vec3 map(5e5, 5e6, 1800);
  for (const double friction : {0.0, 20.0, 25.0})
    EXPECT_LT(sliding(settings, friction, 37, 1, map).error, 1e-6) << friction;
}

TEST_P(LawTalus, SticksAboveTheDipAndSlidesBelow) {
  CaseSettings awake = settings;
  awake.sleep = false;
  for (const double friction : {30.1, 31.0, 35.0, 60.0})
    for (const double azimuth : {0.0, 37.0})
      EXPECT_LT(sliding(awake, friction, azimuth, 4).error, 1e-8) << friction;
  EXPECT_LT(sliding(settings, 29.9, 37, 4).error, 1e-3);
}

TEST_P(LawTalus, SlidesTheSameOnAnyCellSize) {
  for (const double cell : {0.13, 1.0, 7.0})
    EXPECT_LT(sliding(settings, 20, 37, 1, Vec3::Zero(), cell).error, 1e-6) << cell;
}

// The cells' diagonal has one direction: turning the slope turns it against the block.
TEST_P(LawTalus, SlidesTheSameAcrossAnyDiagonal) {
  for (const double azimuth : {0.0, 45.0, 90.0, 135.0, 225.0, 300.0})
    EXPECT_LT(sliding(settings, 20, azimuth, 1).error, 1e-6) << azimuth;
}

// The static start gives it the forces of a block that slides, and its acceleration.
TEST(LawTalusDefault, WhatSlidesOffFromRestBeginsAsItGoesOn) {
  for (const double dt : {5e-3, 0.05, 0.25})
    for (const double friction_deg : {0, 10, 25}) {
      const CaseResult result = sliding(with_dt(dt), friction_deg, 37, 4);
      EXPECT_LT(result.error, 2e-9) << dt << " " << friction_deg;
      EXPECT_LT(result.passes, 1.5 * result.steps) << dt << " " << friction_deg;
    }
  EXPECT_LT(wedge(with_dt(1e-2), 20).error, 1e-9);
}

TEST_P(LawTalus, SlidesObliquely) {
  EXPECT_LT(oblique_slide(settings, 0).error, 1e-5);
  EXPECT_LT(oblique_slide(settings, 37).error, 1e-5);
}

TEST_P(LawTalus, BouncesToTheHeightAskedFor) {
  for (const double restitution : {0.3, 0.7, 1.0})
    for (const Landing landing : {Landing::face, Landing::edge, Landing::corner})
      EXPECT_LT(bounce(settings, restitution, landing).error, 1e-11)
          << restitution << " " << static_cast<int>(landing);
}

TEST_P(LawTalus, CornerImpulseIsExact) {
  EXPECT_LT(corner_impulse(settings, 0).error, 1e-8);
  EXPECT_LT(corner_impulse(settings, 0.7).error, 1e-8);
}

TEST_P(LawTalus, WedgeSlidesAsInClosedForm) {
  EXPECT_LT(wedge(settings, 20).error, 1e-4);
  EXPECT_LT(wedge(settings, 30).error, 2e-4);
}

TEST_P(LawTalus, ColumnRocksAndLosesWhatHousnerSays) {
  EXPECT_LT(rocking_time(settings).error, 1e-3);
  EXPECT_LT(rocking_ratio(settings).error, 1e-3);
}

TEST_P(LawTalus, PrismRollsOnAtTheSteadySpeed) {
  for (const int n : {6, 8, 10, 12, 16}) EXPECT_LT(sustained_rolling(settings, n).error, 0.01) << n;
}

TEST_P(LawTalus, ShakenBlockSlidesAsNewmarkSays) {
  const CaseResult result = shaken_block(settings);
  EXPECT_LT(result.error, 5e-3);
  EXPECT_LT(result.passes, 8 * result.steps);  // it stops and goes: Newton must not go in circles
}

TEST_P(LawTalus, NothingToCollideWithOnAPlane) {
  EXPECT_LT(ghost_collisions(settings, 0).error, 1e-6);
  EXPECT_LT(ghost_collisions(settings, 17).error, 1e-6);
}

TEST_P(LawTalus, OwnWeightStressesTheBlock) { EXPECT_LT(own_weight(settings).error, 1e-3); }

// Row 15; law paper, which has to resolve the hit: LawPaper.ElasticRestitutionTendsToOne.
TEST_P(LawTalus, ElasticBlockReboundsWhole) {
  for (const double young : {1e8, 1e10, 1e12})
    EXPECT_LT(elastic_restitution(settings, young).error, 1e-11) << young;
}

TEST(LawTalusDefault, SpinsFreelyAndTumblesInFlight) {
  const CaseResult spin = free_spin(with_dt(2e-3), 10);
  EXPECT_LT(spin.error, 0.01);
  EXPECT_LT(spin.momentum_change, 1e-12);
}

TEST_P(LawTalus, TumblingBlockFliesTheParabola) {
  EXPECT_LT(tumbling_flight(settings, 10).error, 1e-12);
}

TEST(LawTalusDefault, PrismStartsToRollAtTheCriticalAngle) {
  for (int n = 3; n <= 12; ++n) {
    EXPECT_LT(rolling_angle(with_dt(1e-2), n).error, 0.01) << n;
    EXPECT_LT(rolling_angle({}, n).error, 0.003) << n;
  }
}

TEST(LawTalusDefault, WedgeStopsSlidingAtTheCriticalFriction) {
  EXPECT_LT(wedge_critical({}).error, 0.05);
  EXPECT_LT(wedge_critical(with_dt(1e-2)).error, 0.05);
}

TEST(LawTalusDefault, ColumnTopplesOrSlidesAtTheRightAngle) {
  EXPECT_LT(toppling_angle({}).error, 0.05);
  EXPECT_LT(sliding_angle({}).error, 0.05);
}

TEST(LawTalusDefault, EnergyLineHasTheSlopeOfFriction) { EXPECT_LT(energy_line({}).error, 5e-3); }

}  // namespace
