// The slide of 39 blocks to its end, as means over seeds: a single block that bounces far moves the
// mean place of one run by half a metre.
#include <gtest/gtest.h>

#include <cmath>

#include "base/read_file.hpp"
#include "verify/study/slide_study.hpp"

namespace {

using namespace talus;

TEST(SlideOf39Blocks, AnswersAgreeBetweenOneAndTenMilliseconds) {
  const std::string data = std::string(TALUS_SOURCE_DIR) + "/tests/data/";
  const SlideData slide =
      read_slide(read_file(data + "terrain_F.asc"), read_file(data + "blocks_39.obj"));
  const auto down_the_slope = [](const Vec3& from, const Vec3& now) { return from.y() - now.y(); };
  const auto runs_with = [&](double dt) {
    Settings settings;
    settings.dt = dt;
    const auto scene = [&](std::uint64_t seed) { return slide_scene(slide, settings, seed); };
    return run_ensemble(scene, 24, 20, down_the_slope);
  };
  const EnsembleResult fine = runs_with(1e-3), coarse = runs_with(1e-2);
  const double scatter = std::hypot(fine.standard_error[0], coarse.standard_error[0]);
  EXPECT_GT(fine.mean[0], 100);
  EXPECT_LT(scatter, 2e-3 * fine.mean[0]);
  for (std::size_t q = 0; q < quantity_names.size(); ++q)
    EXPECT_NEAR(coarse.mean[q], fine.mean[q], slide_claims()[q].bound) << quantity_names[q];
  EXPECT_LT(fine.sums.unconverged, 24);
  EXPECT_LT(coarse.sums.unconverged, 24);
}

}  // namespace
