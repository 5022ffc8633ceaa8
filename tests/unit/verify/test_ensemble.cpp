// Means of a slide over starts.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/error.hpp"
#include "verify/cases/cases.hpp"
#include "verify/study/ensemble.hpp"

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

EnsembleResult result_of(const std::string& method, double dt, std::array<double, 3> mean,
                         double standard_error) {
  EnsembleResult out;
  out.method = method;
  out.settings.dt = dt;
  out.mean = mean;
  out.standard_error.fill(standard_error);
  out.n_runs = 4;
  return out;
}

// Means that err in proportion to the step are extrapolated to their limit.
TEST(Ensemble, ReferenceIsWhatTheShortestStepsTendTo) {
  const std::vector<EnsembleResult> results = {
      result_of("other", 1e-3, {99, 99, 99}, 0), result_of("talus", 1e-1, {77, 77, 77}, 0),
      result_of("talus", 5e-3, {10.5, 20, 2.5}, 0), result_of("talus", 2e-3, {10.2, 20, 2.8}, 0),
      result_of("talus", 1e-3, {10.1, 20, 2.9}, 0)};
  const EnsembleReference reference = reference_of(results);
  EXPECT_NEAR(reference.mean[0], 10, 1e-12);
  EXPECT_NEAR(reference.mean[1], 20, 1e-12);
  EXPECT_NEAR(reference.mean[2], 3, 1e-12);
  EXPECT_NEAR(reference.band[0], 0.2, 1e-12);  // how far the second shortest is from it
  EXPECT_NEAR(reference.band[1], 0, 1e-12);
  const auto rows = rows_of("slide", Quantity::spread, results, reference);
  EXPECT_NEAR(rows.back().error, 0.1, 1e-12);
}

TEST(Ensemble, ASettingThatLosesABlockHasNoAnswer) {
  EnsembleResult lost = result_of("paper", 1e-2, {10, 20, 3}, 0);
  lost.sums.flags = StepFlag::fell_through;
  const EnsembleReference reference = reference_of(
      {result_of("talus", 2e-3, {10, 20, 3}, 0), result_of("talus", 1e-3, {10, 20, 3}, 0)});
  EXPECT_TRUE(std::isnan(rows_of("slide", Quantity::centre, {lost}, reference)[0].error));
}

// The scatter of the means is carried to the reference: least squares over steps of 1, 2 and 5 ms,
// and twice the one mean less the other where there are two.
TEST(Ensemble, ReferenceKnowsHowFarToBeTrusted) {
  const std::array<double, 3> same = {10, 20, 3};
  const EnsembleReference of_three =
      reference_of({result_of("talus", 5e-3, same, 0.1), result_of("talus", 2e-3, same, 0.1),
                    result_of("talus", 1e-3, same, 0.1)});
  const double mean = 8.0 / 3, square = 25 + 4 + 1 - 3 * mean * mean;
  EXPECT_NEAR(of_three.band[0], 0.1 * std::sqrt(1.0 / 3 + mean * mean / square), 1e-12);
  const EnsembleReference of_two = reference_of({result_of("paper", 4e-3, {1, 1, 1}, 0),
                                                 result_of("talus", 2e-3, {10.4, 20, 3}, 0.1),
                                                 result_of("talus", 1e-3, {10, 20, 3}, 0.1)});
  EXPECT_NEAR(of_two.mean[0], 9.6, 1e-12);
  EXPECT_NEAR(of_two.band[0], std::hypot(0.8, 0.1 * std::sqrt(5.0)), 1e-12);
}

TEST(ReadSlide, RefusesWhatIsNone) {
  EXPECT_THROW((void)read_slide("ncols x", ""), InputError);
  EXPECT_THROW((void)read_slide("ncols 2\nnrows 2\nxll 0\nyll 0\ncell 1\nnodata -9999\n1 2 3", ""),
               InputError);
}

}  // namespace
