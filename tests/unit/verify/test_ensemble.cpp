#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/error.hpp"
#include "verify/cases.hpp"
#include "verify/ensemble.hpp"

namespace {

using namespace talus;

// Cubes of 1, 2 and 3 m on a plane without friction: all come g sin(dip) t^2 / 2 far.
Scene three_cubes(std::uint64_t) {
  const cases::SlopeFrame frame = cases::slope_frame(30, 0);
  std::vector<Body> bodies;
  for (const double side : {1.0, 2.0, 3.0})
    bodies.push_back(cases::body_of(
        cases::box_in(frame, Vec3(0, 6 * side, 0), Vec3(0, 0, 0), Vec3(side, side, side))));
  return cases::scene_of(cases::plane_trn(frame, 1, 60), {}, bodies, {});
}

TEST(Ensemble, MeansAreThoseOfTheClosedForm) {
  const EnsembleResult one = run_ensemble(
      three_cubes, 2, 1, [](const Vec3& from, const Vec3& now) { return (now - from).norm(); });
  constexpr double settled = 1.2e-6;  // by the static start: the weight over k_n and k_s [m]
  EXPECT_NEAR(one.mean[0], 2.5, settled);
  EXPECT_NEAR(one.mean[1], 2.5, settled);
  EXPECT_NEAR(one.mean[2], 0, 1e-6);
  EXPECT_NEAR(one.standard_error[0], 0, 1e-12);  // every seed is the same scene
  EXPECT_EQ(one.n_blocks, 3);
}

// Places weighted by mass: 1, 8 and 27 parts.
TEST(Ensemble, BlocksCountByTheirMass) {
  double next = 0;
  const EnsembleResult one =
      run_ensemble(three_cubes, 1, 0, [&](const Vec3&, const Vec3&) { return ++next; });
  const double mean = (1 + 8 * 2 + 27 * 3) / 36.0;
  EXPECT_NEAR(one.mean[0], mean, 1e-12);
  EXPECT_NEAR(one.mean[1], 3, 1e-12);
  const double square =
      (std::pow(1 - mean, 2) + 8 * std::pow(2 - mean, 2) + 27 * std::pow(3 - mean, 2)) / 36;
  EXPECT_NEAR(one.mean[2], std::sqrt(square), 1e-12);
}

TEST(Ensemble, ReferenceKnowsHowFarToBeTrusted) {
  EnsembleResult fine, coarse;
  fine.mean = {10, 20, 3};
  fine.standard_error = {0.3, 0.1, 0};
  coarse.mean = {10.4, 20, 3.5};
  coarse.n_runs = fine.n_runs = 4;
  const EnsembleReference reference = reference_of(fine, coarse);
  EXPECT_NEAR(reference.band[0], 0.5, 1e-12);
  EXPECT_NEAR(reference.band[1], 0.1, 1e-12);
  const auto rows = rows_of("slide", Quantity::spread, {coarse, fine}, reference);
  EXPECT_NEAR(rows[0].error, 0.5, 1e-12);
  EXPECT_NEAR(rows[1].error, 0, 1e-12);
}

TEST(ReadSlide, RefusesWhatIsNone) {
  EXPECT_THROW((void)read_slide("ncols x", ""), InputError);
  EXPECT_THROW((void)read_slide("ncols 2\nnrows 2\nxll 0\nyll 0\ncell 1\nnodata -9999\n1 2 3", ""),
               InputError);
}

}  // namespace
