// The strength of a bonded face in closed form, for each load alone and for two together.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <vector>

#include "geometry/corner_shares.hpp"
#include "scene/bond_face.hpp"

namespace {

using namespace talus;

constexpr double cohesion = 2e5, tension = 5e4, friction = 0.4;

/// Load of a face: forces along its axes u, v and normal (> 0 pressed), moments about them.
struct Load {
  double shear_u = 0, shear_v = 0, pressed = 0, bending_u = 0, bending_v = 0, torsion = 0;
};

/// A bonded polygon in its plane, turned and moved so that no axis is one of the coordinates'. Its
/// loads act on its centre of area; forces at its corners balance them.
struct Polygon {
  std::vector<Vec2> corners;

  static Polygon rectangle(double length, double width) {
    return {{{-length / 2, -width / 2},
             {length / 2, -width / 2},
             {length / 2, width / 2},
             {-length / 2, width / 2}}};
  }

  // The face with the load, by forces at its corners that are linear in place.
  [[nodiscard]] BondFace under(const Load& load, double scale) const {
    const size_t n = corners.size();
    Vec2 mean = Vec2::Zero();
    std::vector<double> share(n, 0);
    share_area(
        n, [&](size_t i) { return corners[i]; }, [&](size_t i, double area) { share[i] += area; });
    double area = 0;
    for (size_t i = 0; i < n; ++i) mean += share[i] * corners[i], area += share[i];
    mean /= area;
    // f_i = F / n + G (x_i - mean of corners): six equations for N and its moments, V and T
    Eigen::Matrix<double, 6, Eigen::Dynamic> balance(6, 3 * n);
    for (size_t i = 0; i < n; ++i) {
      const Vec2 x = corners[i] - mean;
      balance.middleCols<3>(static_cast<Eigen::Index>(3 * i)) << 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0,
          x.y(), 0, 0, -x.x(), -x.y(), x.x(), 0;
    }
    Eigen::Matrix<double, 6, 1> wanted;
    wanted << load.shear_u, load.shear_v, load.pressed, load.bending_u, load.bending_v,
        load.torsion;
    const Eigen::VectorXd force =
        balance.transpose() * (balance * balance.transpose()).inverse() * (scale * wanted);
    const Mat3 turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
    BondFace face;
    face.normal = turn.col(2);
    for (size_t i = 0; i < n; ++i) {
      BondCorner corner;
      corner.point = Vec3(400, -300, 20) + turn * Vec3(corners[i].x(), corners[i].y(), 0);
      corner.force = turn * force.segment<3>(static_cast<Eigen::Index>(3 * i));
      corner.area = share[i];
      corner.cohesion = cohesion;
      corner.tension = tension;
      corner.friction = friction;
      face.corners.push_back(corner);
    }
    return face;
  }

  // Holds a thousandth below the load, and fails a thousandth above it.
  void fails_at(const Load& load) const {
    EXPECT_TRUE(holds(under(load, 0.999)));
    EXPECT_FALSE(holds(under(load, 1.001)));
  }
};

// T = (c + tan(phi) N / A) times the integral of the distance from the centre; a square of side s:
// (sqrt(2) + ln(1 + sqrt(2))) / 6 s^3.
const double square_torsion = (std::sqrt(2) + std::log(1 + std::sqrt(2))) / 6;

TEST(BondFace, EachLoadAloneHasItsClosedForm) {
  const Polygon square = Polygon::rectangle(1, 1), large = Polygon::rectangle(3, 3),
                plank = Polygon::rectangle(4, 0.5);
  square.fails_at({.pressed = -tension});
  large.fails_at({.pressed = -tension * 9});
  square.fails_at({.shear_u = cohesion});
  plank.fails_at({.shear_u = 0.6 * 2 * cohesion, .shear_v = -0.8 * 2 * cohesion});
  square.fails_at({.torsion = square_torsion * cohesion});
  large.fails_at({.torsion = -square_torsion * cohesion * 27});
  square.fails_at({.bending_u = tension / 2});
  plank.fails_at({.bending_u = tension * 2 * 0.25});
  plank.fails_at({.bending_v = -tension * 2 * 2});
}

TEST(BondFace, TwoLoadsTogetherHaveTheirClosedForm) {
  const Polygon square = Polygon::rectangle(1, 1);
  // shear and pressure: c A + tan(phi) N
  square.fails_at({.shear_v = cohesion + friction * 1e5 * 1, .pressed = 1e5});
  // shear and tension, each by its own
  EXPECT_TRUE(holds(square.under({.shear_v = cohesion, .pressed = -tension}, 0.999)));
  EXPECT_FALSE(holds(square.under({.shear_v = 1.002 * cohesion, .pressed = -tension}, 0.999)));
  EXPECT_FALSE(holds(square.under({.shear_v = cohesion, .pressed = -1.002 * tension}, 0.999)));
  // torsion and pressure
  square.fails_at({.pressed = 2e5, .torsion = square_torsion * (cohesion + friction * 2e5)});
  // bending and pressure or tension: (N + t A) s / 2
  square.fails_at({.pressed = -tension / 2, .bending_v = tension / 4});
  for (const double N : {-0.4 * tension, 3 * tension}) {
    const double M = (N + tension) / 2;
    EXPECT_TRUE(holds(square.under({.pressed = N, .bending_u = 0.999 * M}, 1)));
    EXPECT_FALSE(holds(square.under({.pressed = N, .bending_u = 1.001 * M}, 1)));
  }
  // bending about both axes at once: the pressed corner
  square.fails_at({.bending_u = tension / 2, .bending_v = tension / 2});
}

// Of a strip of length 2 a and width w, V across it: T / (c w a^2) + (V / (2 c w a))^2 = 1.
TEST(BondFace, ShearAndTorsionOfAStripFollowAParabola) {
  const double a = 10, w = 0.02, V_0 = cohesion * 2 * a * w, T_0 = cohesion * w * a * a;
  const Polygon strip = Polygon::rectangle(2 * a, w);
  for (const double share : {0.1, 0.5, 0.8})
    strip.fails_at({.shear_v = share * V_0, .torsion = (1 - share * share) * T_0});
}

// Moments about the centre of area, not about the mean of the corners; and a face of two parts.
TEST(BondFace, TheCentreIsThatOfTheArea) {
  const Polygon triangle{{{0, 0}, {3, 0}, {0, 2}}};
  triangle.fails_at({.shear_u = cohesion * 3});
  triangle.fails_at({.pressed = -tension * 3});
  triangle.fails_at({.bending_u = -tension * 3 * (2.0 / 3)});
  const Polygon half_house{{{0, 0}, {2, 0}, {2, 1}, {1, 2}, {0, 1}}};
  half_house.fails_at({.shear_v = cohesion * 3});
  half_house.fails_at({.pressed = -tension * 3});

  for (const double scale : {0.999, 1.001}) {
    // the same in two halves, which share the corners of their border
    const Polygon whole = Polygon::rectangle(1, 1);
    BondFace parts = whole.under({.torsion = square_torsion * cohesion}, scale);
    std::vector<BondCorner>& c = parts.corners;
    const auto middle = [](const BondCorner& p, const BondCorner& q) {
      BondCorner out = p;
      out.point = (p.point + q.point) / 2;
      out.force.setZero();
      out.area = 0.125;
      return out;
    };
    for (BondCorner& corner : c) corner.area = 0.125;
    BondCorner low = middle(c[0], c[1]), high = middle(c[2], c[3]);
    c[1].polygon = c[2].polygon = 1;
    c.push_back(low), c.push_back(high);
    low.polygon = high.polygon = 1;
    c.push_back(low), c.push_back(high);
    EXPECT_EQ(holds(parts), scale < 1);
  }
}

TEST(BondFace, WithoutStrengthNothingPullsAndNoLoadBreaks) {
  BondFace face = Polygon::rectangle(1, 1).under({}, 1);
  for (BondCorner& corner : face.corners) corner.tension = 0;
  EXPECT_TRUE(holds(face));
  face.corners[0].force = -1e-3 * face.normal;
  EXPECT_FALSE(holds(face));
  face.corners[0].force = 1e-3 * face.normal;
  EXPECT_TRUE(holds(face));
  face.opened = true;
  EXPECT_FALSE(holds(face));
}

}  // namespace
