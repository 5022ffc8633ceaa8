// Lines of fences: posts, names, refusals.
#include <gtest/gtest.h>

#include <cmath>

#include "record/fence_lines.hpp"

using namespace talus;

namespace {

// Level ground at 50 m, 100 x 100 m from (0, 0).
Trn level() {
  Trn trn;
  trn.n_rows = trn.n_cols = 11;
  trn.cell_size = 10;
  trn.node0 = Vec2(0, 100);
  trn.origin = Vec3(500000, 5000000, 0);
  trn.elevation.assign(121, 50);
  return trn;
}

FenceSettings fence_named(const std::string& name, bool active) {
  FenceSettings fence;
  fence.name = name;
  fence.height_m = 4;
  fence.post_spacing_m = 5;
  fence.active = active;
  fence.line_number = 7;
  return fence;
}

std::vector<FenceLine> as_lines(const FenceSettings& fence,
                                const std::vector<std::vector<Vec3>>& corners) {
  std::vector<FenceLine> lines;
  for (const RecordLine& line : lines_of_fence(fence, level(), corners, {"site.toml"}))
    lines.push_back({&fence, line});
  return lines;
}

std::vector<FenceLine> joined(std::vector<FenceLine> lines, const std::vector<FenceLine>& more) {
  lines.insert(lines.end(), more.begin(), more.end());
  return lines;
}

const std::vector<Vec3> low = {{10, 20, NAN}, {40, 20, NAN}}, high = {{10, 60, NAN}, {10, 90, NAN}},
                        low_again = {{40, 20, NAN}, {10, 20, NAN}};

}  // namespace

TEST(FenceLines, HavePostsOnTheGroundAndNamesWithANumberWhereThereAreSeveral) {
  const FenceSettings fence = fence_named("upper", true);
  const auto one = lines_of_fence(fence, level(), {low}, {"site.toml"});
  ASSERT_EQ(one.size(), 1U);
  EXPECT_EQ(one[0].name, "upper");
  ASSERT_EQ(one[0].points.size(), 7U);
  for (const Vec3& post : one[0].points) EXPECT_EQ(post.z(), 50);
  EXPECT_EQ(one[0].chainage.back(), 30);
  const auto two = lines_of_fence(fence, level(), {low, high}, {"site.toml"});
  EXPECT_EQ(two[0].name, "upper.1");
  EXPECT_EQ(two[1].name, "upper.2");
}

TEST(FenceLines, AreRefusedWhereThereIsNoneAndWhereACornerHangsInTheAir) {
  EXPECT_THROW((void)lines_of_fence(fence_named("upper", true), level(), {}, {"site.toml"}),
               InputError);
  const std::vector<Vec3> hanging = {{10, 20, 55}, {40, 20, 50}};
  EXPECT_THROW((void)lines_of_fence(fence_named("upper", true), level(), {hanging}, {"site.toml"}),
               InputError);
  EXPECT_EQ(lines_of_fence(fence_named("upper", false), level(), {hanging}, {"site.toml"}).size(),
            1U);
}

// Two active fences are refused, whichever end they begin at; one that stops nothing is only told.
TEST(FenceLines, OnOneAnotherAreRefusedOrTold) {
  const FenceSettings a = fence_named("a", true), b = fence_named("b", true),
                      virtual_one = fence_named("c", false);
  const Trn trn = level();
  EXPECT_TRUE(check_fences_apart("site.toml", trn, joined(as_lines(a, {low}), as_lines(b, {high})))
                  .empty());
  try {
    (void)check_fences_apart("site.toml", trn,
                             joined(as_lines(a, {low}), as_lines(b, {low_again})));
    FAIL() << "two fences in one place";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what())
                  .find("site.toml:7: fence.b: lies on fence a all along, from "
                        "500040, 5000020 on"),
              std::string::npos)
        << error.what();
  }
  const std::vector<std::string> told = check_fences_apart(
      "site.toml", trn, joined(as_lines(a, {low}), as_lines(virtual_one, {low_again})));
  ASSERT_EQ(told.size(), 1U);
  EXPECT_NE(told[0].find("fence c lies on fence a"), std::string::npos) << told[0];
  EXPECT_THROW((void)check_fences_apart("site.toml", trn, as_lines(virtual_one, {low, low_again})),
               InputError);
}
