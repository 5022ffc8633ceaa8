// Fences of a site file: feet, capacity, refusals.
#include <gtest/gtest.h>

#include <cmath>

#include "scene/site_fence.hpp"
#include "verify/cases/cases.hpp"

namespace {

using namespace talus;
using namespace talus::cases;

const Where where{"site.toml", 12, "fence.f"};

std::string refusal(const std::vector<Vec3>& posts, const Trn& trn, double height = 4) {
  FenceSettings settings;
  settings.height_m = height;
  try {
    (void)standing_fence(settings, trn, 0, posts, where);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

std::vector<Vec3> on_ground(const std::vector<Vec2>& corners, const Trn& trn) {
  std::vector<Vec3> posts;
  for (const Vec2& c : corners) posts.emplace_back(c.x(), c.y(), elevation_at(trn, c.x(), c.y()));
  return posts;
}

Trn flat() {
  Trn trn = make_trn([](double, double) { return 7.0; }, 1, 30);
  trn.origin = Vec3(1000, 2000, 0);
  return trn;
}

// Fences are the same whichever end they begin at and however many posts they have.
TEST(LinesOfFences, LieAlongEachOtherWhateverTheirPoints) {
  const std::vector<Vec3> line = {{0, 0, 1}, {10, 0, 2}, {20, 10, 3}};
  const std::vector<Vec3> reversed = {{20, 10, 3}, {15, 5, 0}, {10, 0, 2}, {4, 0.05, 0}, {0, 0, 1}};
  EXPECT_TRUE(lies_along(line, line));
  EXPECT_TRUE(lies_along(reversed, line));
  EXPECT_TRUE(lies_along(line, reversed));
  EXPECT_TRUE(lies_along({{2, 0, 0}, {8, 0, 0}}, line));     // a part of it
  EXPECT_FALSE(lies_along(line, {{2, 0, 0}, {8, 0, 0}}));    // and not the whole on the part
  EXPECT_FALSE(lies_along({{0, 0, 0}, {20, 10, 0}}, line));  // ends alone
  EXPECT_FALSE(lies_along({{0, 1, 0}, {10, 1, 0}}, line));   // a metre beside
}

TEST(StandingFence, KeepsCapacityAndDeflectionInSiUnits) {
  FenceSettings settings;
  settings.capacity_kj = 500;
  settings.height_m = 4;
  const Trn trn = flat();
  const std::vector<Vec3> posts = on_ground({{0, 0}, {8, 0}, {16, 2}}, trn);
  StandingFence fence = standing_fence(settings, trn, 3, posts, where);
  EXPECT_EQ(fence.line, 3);
  EXPECT_EQ(fence.capacity, 5e5);
  EXPECT_EQ(fence.deflection, 2);  // half the height
  EXPECT_EQ(fence.depth.size(), 2u);
  settings.max_deflection_m = 3;
  fence = standing_fence(settings, trn, 3, posts, where);
  EXPECT_EQ(fence.deflection, 3);
  settings.capacity_kj = not_given;
  EXPECT_TRUE(std::isinf(standing_fence(settings, trn, 3, posts, where).capacity));
}

TEST(StandingFence, ThatCrossesItselfIsRefusedWithThePlace) {
  const Trn trn = flat();
  const std::string loop = refusal(on_ground({{0, 0}, {10, 0}, {10, 10}, {5, -5}}, trn), trn);
  EXPECT_NE(loop.find("site.toml:12: fence.f: crosses itself at 1006.66"), std::string::npos)
      << loop;
  EXPECT_NE(
      refusal(on_ground({{0, 0}, {10, 0}, {10, 10}, {5, 0}}, trn), trn).find("touches itself"),
      std::string::npos);
  EXPECT_NE(refusal(on_ground({{0, 0}, {10, 0}, {10, 10}, {10, 0}}, trn), trn)
                .find("comes back to itself at 1010, 2000"),
            std::string::npos);
  // a ring is a fence
  EXPECT_EQ(refusal(on_ground({{0, 0}, {10, 0}, {10, 10}, {0, 0}}, trn), trn), "");
}

// A gully of 3 m across the middle of the span: the fence hangs where it is deepest.
TEST(StandingFence, ThatDoesNotReachTheGroundIsRefusedWithThePlace) {
  const auto gully = [](double depth) {
    return make_trn(
        [depth](double x, double) { return -depth * std::max(0.0, 1 - std::abs(x) / 2); }, 1, 20);
  };
  const std::vector<Vec2> span = {{-6, 0.3}, {6, 0.3}};
  const Trn deep = gully(1.1), shallow = gully(0.9);
  const std::string text = refusal(on_ground(span, deep), deep);
  EXPECT_NE(text.find("hangs 1.1 m above it at 0, 0.3, expected at most 1"), std::string::npos)
      << text;
  EXPECT_EQ(refusal(on_ground(span, shallow), shallow), "");
  FenceSettings settings;
  settings.height_m = 4;
  const StandingFence fence = standing_fence(settings, shallow, 0, on_ground(span, shallow), where);
  EXPECT_NEAR(fence.depth[0], 0.9 + 0.5, 1e-12);  // the panel reaches down into the gully
}

TEST(CheckFeet, RefusesAPointAboveTheGround) {
  const Trn trn = flat();
  FenceSettings settings;
  settings.height_m = 4;
  EXPECT_THROW(check_feet(settings, trn, {Vec3(0, 0, 7), Vec3(3, 0, 8.01)}, where), InputError);
  EXPECT_NO_THROW(check_feet(settings, trn, {Vec3(0, 0, 7), Vec3(3, 0, 7.99)}, where));
  EXPECT_NO_THROW(check_feet(settings, trn, {Vec3(0, 0, std::nan(""))}, where));
}

}  // namespace
