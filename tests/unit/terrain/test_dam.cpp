// Dams and galleries against closed forms: sections on a plane slope, a heap on flat ground,
// corners.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "base/random.hpp"
#include "geometry/plan2d.hpp"
#include "terrain/dam.hpp"

namespace {

using talus::Dam;
using talus::DamBurn;
using talus::DamFault;
using talus::DamShape;
using talus::Trn;
using talus::Vec2;

// z = rise . (x, y), cells of `cell` from -reach to reach
Trn plane(const Vec2& rise, double cell, double reach) {
  Trn trn;
  trn.n_rows = trn.n_cols = static_cast<int>(std::lround(2 * reach / cell)) + 1;
  trn.cell_size = cell;
  trn.node0 = {-reach, reach};
  for (int r = 0; r < trn.n_rows; ++r)
    for (int c = 0; c < trn.n_cols; ++c)
      trn.elevation.push_back(rise.x() * (-reach + c * cell) + rise.y() * (reach - r * cell));
  return trn;
}

// On ground that rises 1 : 2 the faces meet it 3 m uphill and 11 m downhill of the line.
DamShape shape_of(const std::vector<Vec2>& line) {
  DamShape shape;
  shape.line = line;
  shape.height = 4.5;
  shape.crest_width = 2;
  shape.tan_uphill = 1.5;
  shape.tan_downhill = 1;
  return shape;
}

DamBurn built(const DamShape& shape, Trn& trn) {
  Dam dam;
  const DamFault fault = lay_dam(trn, shape, dam);
  if (fault.kind != DamFault::none) {
    DamBurn burn;
    burn.fault = fault;
    return burn;
  }
  return burn_dam(dam, trn);
}

// What 20 m of a longer dam hold: the ends of both are alike.
talus::Earthwork of_20_m(DamShape shape, const Trn& ground, const Vec2& along, bool in_cells) {
  std::vector<talus::Earthwork> work;
  for (const double half : {15.0, 25.0}) {
    shape.line = {-half * along, half * along};
    Trn trn = ground;
    const DamBurn burn = built(shape, trn);
    EXPECT_EQ(burn.fault.kind, DamFault::none);
    work.push_back(in_cells ? burn.in_cells : burn.designed);
  }
  return {work[1].fill - work[0].fill, work[1].cut - work[0].cut};
}

// 2 h of crest, (h - 1/2) 2 / 2 uphill of it, (h + 1/2) 10 / 2 downhill.
constexpr double section_m2 = 9 + 4 + 25;

TEST(Dam, HoldsItsSectionOnAPlaneSlope) {
  for (const bool in_cells : {true, false}) {
    const auto work = of_20_m(shape_of({}), plane({0, 0.5}, 1, 100), {1, 0}, in_cells);
    EXPECT_NEAR(work.fill, 20 * section_m2, 1e-6) << in_cells;
    EXPECT_NEAR(work.cut, 0, 1e-9);
  }
}

TEST(Dam, HoldsTheSameAcrossTheCells) {
  const Vec2 along(0.8, 0.6);
  const Trn ground = plane({-0.3, 0.4}, 1, 100);
  EXPECT_NEAR(of_20_m(shape_of({}), ground, along, false).fill, 20 * section_m2, 0.01 * 760);
}

// The bottom lies 1.5 m below the foot, from 4 to 6 m uphill; its side rises 1 : 1 to 12 m.
TEST(Dam, CutsItsDitch) {
  DamShape shape = shape_of({});
  shape.ditch_depth = 1.5;
  shape.ditch_width = 2;
  const auto work = of_20_m(shape, plane({0, 0.5}, 1, 120), {1, 0}, true);
  EXPECT_NEAR(work.fill, 20 * section_m2, 1e-6);
  EXPECT_NEAR(work.cut, 20 * (1 + 5 + 9), 1e-6);
}

// On flat ground the ends are the halves of a truncated cone.
TEST(Dam, IsAHeapOnFlatGround) {
  DamShape shape = shape_of({{-10, 0}, {10, 0}});
  shape.tan_uphill = shape.tan_downhill = 1;
  Trn trn = plane({0, 0}, 0.5, 80);
  const DamBurn burn = built(shape, trn);
  const double h = 4.5, r = 1, R = 5.5;
  const double ends = std::numbers::pi * h / 3 * (R * R + R * r + r * r);
  EXPECT_NEAR(burn.designed.fill, 20 * (2 * h + h * h) + ends, 0.005 * burn.designed.fill);
  EXPECT_NEAR(burn.crest_loss, 0, 1e-9);
}

TEST(Dam, LeavesAllOtherNodesAsTheyWere) {
  DamShape shape = shape_of({{-20, 3}, {4, -2}, {30, 5}});
  shape.ditch_depth = 1;
  shape.ditch_width = 3;
  const Trn ground = plane({0.1, 0.4}, 1, 150);
  Trn trn = ground;
  const DamBurn burn = built(shape, trn);
  ASSERT_EQ(burn.fault.kind, DamFault::none);
  EXPECT_GT(burn.designed.cut, 100);
  const std::set<int> moved(burn.nodes.begin(), burn.nodes.end());
  for (int i = 0; i < static_cast<int>(ground.elevation.size()); ++i)
    EXPECT_EQ(moved.count(i) == 0, trn.elevation[i] == ground.elevation[i]);
}

// A line over a saddle has the higher ground left of it here and right of it there.
TEST(Dam, KnowsHowMuchHigherItsUphillSideIs) {
  const DamShape shape = shape_of({{-20, 0}, {20, 0}});
  const talus::SideRise slope = rise_to_the_left(plane({0, 0.5}, 1, 100), shape);
  EXPECT_NEAR(slope.mean, 0.5 * 2 * side_distance(shape), 1e-9);
  EXPECT_EQ(slope.other_share, 0);
  Trn saddle = plane({0, 0}, 1, 100);
  for (int r = 0; r < saddle.n_rows; ++r)
    for (int c = 0; c < saddle.n_cols; ++c) {
      const Vec2 at = node_point(saddle, r, c).head<2>();
      saddle.elevation[node_index(saddle, r, c)] = 0.01 * at.x() * at.y();
    }
  const talus::SideRise twisted = rise_to_the_left(saddle, shape_of({{-10, 0}, {0, 0}, {30, 0}}));
  EXPECT_NEAR(twisted.mean, 2 * side_distance(shape) * 0.01 * (-5 * 10 + 15 * 30) / 40, 1e-9);
  EXPECT_NEAR(twisted.other_share, 0.25, 1e-12);
}

// Which end the line begins at does not matter.
TEST(Dam, IsTheSameFromBothEnds) {
  DamShape shape = shape_of({{-20, 3}, {4, -2}, {30, 5}});
  shape.ditch_depth = 1;
  shape.ditch_width = 3;
  Trn one = plane({0.1, 0.4}, 1, 150), other = one;
  (void)built(shape, one);
  std::reverse(shape.line.begin(), shape.line.end());
  (void)built(shape, other);
  for (std::size_t i = 0; i < one.elevation.size(); ++i)
    EXPECT_NEAR(one.elevation[i], other.elevation[i], 1e-9);
}

// Round a point that is 10 m long and 2 m wide the line stays 5 m away, and within its hollow no
// farther than its arms are long.
TEST(Dam, IsWatchedAtTheSameDistanceRoundSharpCorners) {
  const std::vector<Vec2> line = {{-20, 0}, {-1, 0}, {0, 10}, {1, 0}, {20, 0}};
  for (const Vec2& at : line_beside(line, 5)) {
    double off = 1e9;
    for (std::size_t i = 0; i + 1 < line.size(); ++i)
      off = std::min(off, talus::distance_to_segment<Vec2>(at, line[i], line[i + 1]));
    EXPECT_NEAR(off, 5, 1e-9) << at.transpose();
  }
  for (const Vec2& at : line_beside(line, -5)) EXPECT_LT((at - Vec2(0, 0)).norm(), 20.7);
  // the middle of a hollow that is square: sqrt(2) 3
  const auto square = line_beside({{0, 9}, {0, 0}, {9, 0}}, 3);
  ASSERT_EQ(square.size(), 3U);
  EXPECT_NEAR((square[1] - Vec2(3, 3)).norm(), 0, 1e-9);
  EXPECT_NEAR((square[0] - Vec2(3, 9)).norm(), 0, 1e-9);
}

// No face is steeper than it was designed, at corners and ends either.
TEST(Dam, HasNoStepInItsFaces) {
  const Trn trn = plane({0, 0.4}, 1, 150);
  Dam dam;
  const DamShape shape = shape_of({{-20, 0}, {0, 0}, {12, 9}, {30, 0}});
  ASSERT_EQ(lay_dam(trn, shape, dam).kind, DamFault::none);
  for (talus::Vec3& p : dam.crest) p.z() = 5;  // level
  talus::Random random(1, "dam");
  for (int k = 0; k < 20000; ++k) {
    const Vec2 at(random.uniform(-40, 50), random.uniform(-20, 30));
    const double turn = random.uniform(0, 2 * std::numbers::pi);
    const Vec2 beside = at + 1e-4 * Vec2(std::cos(turn), std::sin(turn));
    // 1.55: faces turn beyond the ends, and so run on a little along them
    EXPECT_LE(std::abs(dam_height_at(dam, at) - dam_height_at(dam, beside)), 1.6e-4)
        << at.transpose();
  }
}

// Cells that are wider than the crest hold less of it, and say how much.
TEST(Dam, LosesItsCrestInWideCells) {
  Trn trn = plane({0, 0.2}, 10, 200);
  DamShape shape = shape_of({{-33, 5}, {33, 5}});  // between two rows of nodes
  const DamBurn burn = built(shape, trn);
  ASSERT_EQ(burn.fault.kind, DamFault::none);
  EXPECT_GT(burn.crest_loss, 3);
  EXPECT_LT(burn.crest_loss, 4.5 + 1e-9);
  EXPECT_GT(burn.designed.fill, 66 * 20);
  EXPECT_LT(burn.in_cells.fill, 0.7 * burn.designed.fill);
}

TEST(Dam, IsRefusedWhereItsFacesRunOn) {
  DamShape shape = shape_of({{-10, 0}, {10, 0}});
  Trn steep = plane({0, 1.05}, 1, 200);  // steeper than the downhill face
  const Trn before = steep;
  EXPECT_EQ(built(shape, steep).fault.kind, DamFault::downhill_face);
  EXPECT_EQ(steep.elevation, before.elevation);
  shape.tan_downhill = 3;
  EXPECT_EQ(built(shape, steep).fault.kind, DamFault::none);
  shape.tan_downhill = 1.4;
  shape.ditch_depth = 1;
  shape.ditch_width = 20;
  steep = plane({0, 1.1}, 1, 300);
  EXPECT_EQ(built(shape, steep).fault.kind, DamFault::ditch_side);
  shape = shape_of({{-10, 0}, {10, 0}});
  Trn small = plane({0, 0.5}, 1, 11);  // the downhill face ends at the border
  EXPECT_EQ(built(shape, small).fault.kind, DamFault::off_the_ground);
  shape.line = {{-10, 0}, {30, 0}};
  EXPECT_EQ(built(shape, small).fault.kind, DamFault::off_the_ground);
}

DamShape gallery_of(const std::vector<Vec2>& line) {
  DamShape shape;
  shape.line = line;
  shape.height = 6;
  shape.crest_width = 8;
  shape.is_gallery = true;
  return shape;
}

// The roof is level at 6 m over the line, 4 m to both sides, and falls to the ground in a cell.
TEST(Gallery, HoldsItsSectionOnAPlaneSlope) {
  // 1 : 2: 6 * 8 under the roof, a cell of 8 / 2 before it and of 4 / 2 behind it
  const auto gentle = of_20_m(gallery_of({}), plane({0, 0.5}, 1, 100), {1, 0}, true);
  EXPECT_NEAR(gentle.fill, 20 * (48 + 4 + 2), 1e-6);
  EXPECT_NEAR(gentle.cut, 0, 1e-9);
  // 2 : 1: from 3 m uphill of the line on the ground is higher than the roof, and stays
  const auto steep = of_20_m(gallery_of({}), plane({0, 2}, 1, 100), {1, 0}, true);
  EXPECT_NEAR(steep.fill, 20 * (7 * 7 + 7), 1e-6);
}

TEST(Gallery, MovesTheNodesUnderItsRoofAlone) {
  const Trn ground = plane({0.05, 0.5}, 1, 60);
  Trn trn = ground;
  const DamShape shape = gallery_of({{-20, 0}, {20, 0}});
  const DamBurn burn = built(shape, trn);
  ASSERT_EQ(burn.fault.kind, DamFault::none);
  EXPECT_NEAR(burn.crest_loss, 0, 1e-9);
  for (int r = 0; r < trn.n_rows; ++r)
    for (int c = 0; c < trn.n_cols; ++c) {
      const Vec2 at = node_point(trn, r, c).head<2>();
      const double z = trn.elevation[node_index(trn, r, c)];
      if (std::abs(at.x()) <= 20 && std::abs(at.y()) <= 4) {
        EXPECT_NEAR(z, 0.05 * at.x() + 6, 1e-9) << at.transpose();
      } else {
        EXPECT_EQ(z, ground.elevation[node_index(trn, r, c)]) << at.transpose();
      }
    }
}

// Pieces in plan and the roof in the terrain are one.
TEST(Gallery, HasItsRoofWhereItsPiecesAre) {
  Trn trn = plane({0, 0.4}, 1, 150);
  Dam dam;
  ASSERT_EQ(lay_dam(trn, gallery_of({{-20, 0}, {0, 0}, {12, 9}, {12, 30}}), dam).kind,
            DamFault::none);
  ASSERT_EQ(burn_dam(dam, trn).fault.kind, DamFault::none);
  const auto pieces = roof_pieces(trn, dam.shape);
  ASSERT_EQ(pieces.size(), 5U);
  for (const talus::RoofPiece& piece : pieces) EXPECT_GT(talus::ring_area(piece.ring), 0);
  EXPECT_NEAR(pieces[0].normal.z(), 1, 1e-9);
  EXPECT_NEAR(pieces[3].normal.y() / pieces[3].normal.z(), -0.4, 1e-9);
  talus::Random random(1, "gallery");
  int n_on = 0;
  for (int k = 0; k < 20000; ++k) {
    const Vec2 at(random.uniform(-30, 30), random.uniform(-10, 40));
    const auto is_on = [&at](const talus::RoofPiece& piece) {
      return talus::is_inside(piece.ring, at);
    };
    const bool on = std::any_of(pieces.begin(), pieces.end(), is_on);
    n_on += on;
    // the sides of a corner's piece lie 4 (1 - cos(7.5 degrees)) within the arc
    const auto is_near_arc = [&at](const Vec2& corner) {
      return std::abs((at - corner).norm() - 4) < 0.035;
    };
    const bool may_differ = !on && (is_near_arc({0, 0}) || is_near_arc({12, 9}));
    if (may_differ) continue;
    EXPECT_EQ(on, std::isfinite(dam_height_at(dam, at))) << at.transpose();
  }
  EXPECT_NEAR(n_on / 20000.0 * 60 * 50, 8 * (20 + 15 + 21), 40);
}

}  // namespace
