// Pictures of blocks: quantiles by volume, escaped names.
#include <gtest/gtest.h>

#include "io/block_pictures.hpp"

using namespace talus;

TEST(VolumeQuantile, IsByVolumeNotByNumber) {
  EXPECT_EQ(volume_quantile({1, 1, 1, 1, 96}, 0.5), 96);
  EXPECT_EQ(volume_quantile({1, 1, 1, 1, 96}, 0.03), 1);
}

TEST(Pictures, NamesOfUsersAreEscaped) {
  const std::string svg =
      svg_of(stereonet({{"<J&1>", Vec3::UnitZ(), {Vec3::UnitZ()}}}, Vec3::Zero()));
  EXPECT_EQ(svg.find("<J"), std::string::npos);
  EXPECT_NE(svg.find("&lt;J&amp;1&gt;"), std::string::npos);
  EXPECT_NE(chart_svg(size_curve({1, 2, 50})).find("V50 = 50"), std::string::npos);
}
