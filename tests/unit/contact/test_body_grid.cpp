// Fixed bodies by place: none missed, few handed out in vain.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

#include "contact/body_grid.hpp"

namespace {

using namespace talus;

struct Crowd {
  std::vector<Vec3> centre;
  std::vector<double> radius;
};

// Bodies of very different sizes, most of them in a corner.
Crowd crowd_of(int n, std::mt19937_64& random) {
  std::uniform_real_distribution<double> share(0, 1);
  Crowd crowd;
  for (int i = 0; i < n; ++i) {
    const double reach = share(random) < 0.7 ? 20 : 1000;
    crowd.centre.emplace_back(reach * share(random), reach * share(random), 50 * share(random));
    crowd.radius.push_back(0.1 + 20 * std::pow(share(random), 6));
  }
  return crowd;
}

TEST(BodyGrid, HandsOutAllWhoseBallMeetsTheBox) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> share(0, 1);
  std::vector<int> near;
  for (const int n : {1, 2, 50, 2000}) {
    const Crowd crowd = crowd_of(n, random);
    const BodyGrid grid = make_body_grid(crowd.centre, crowd.radius);
    for (int k = 0; k < 200; ++k) {
      const Vec3 at(1100 * share(random) - 50, 1100 * share(random) - 50, 25);
      const Vec3 half = Vec3::Constant(30 * share(random));
      find_near(grid, {at - half, at + half}, near);
      EXPECT_TRUE(std::is_sorted(near.begin(), near.end(), std::less_equal<>()));
      for (int i = 0; i < n; ++i) {
        const auto b = static_cast<std::size_t>(i);
        const Vec3 closest = crowd.centre[b].cwiseMax(at - half).cwiseMin(at + half);
        const bool meets = (crowd.centre[b] - closest).norm() <= crowd.radius[b];
        EXPECT_TRUE(!meets || std::binary_search(near.begin(), near.end(), i)) << i;
      }
    }
  }
}

TEST(BodyGrid, HandsOutFewThatAreFar) {
  Crowd trees;
  for (int i = 0; i < 100; ++i)
    for (int j = 0; j < 100; ++j) {
      trees.centre.emplace_back(5 * i, 5 * j, 0);
      trees.radius.push_back(1);
    }
  const BodyGrid grid = make_body_grid(trees.centre, trees.radius);
  std::vector<int> near;
  find_near(grid, {Vec3(250, 250, -1), Vec3(252, 252, 1)}, near);
  EXPECT_LE(near.size(), 9u);
  find_near(grid, {Vec3(-900, 250, -1), Vec3(-800, 252, 1)}, near);
  EXPECT_TRUE(near.empty());
}

TEST(BodyGrid, HandsOutAllForABoxThatIsNotFinite) {
  std::mt19937_64 random(5);
  const Crowd crowd = crowd_of(30, random);
  std::vector<int> near;
  const Vec3 nowhere = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  find_near(make_body_grid(crowd.centre, crowd.radius), {nowhere, nowhere}, near);
  EXPECT_EQ(near.size(), 30u);
}

}  // namespace
