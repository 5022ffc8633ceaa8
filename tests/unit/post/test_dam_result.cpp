// Verdicts of blocks at a dam, and on the dam, where its line turns uphill at both ends.
#include <gtest/gtest.h>

#include "post/fence/dam_result.hpp"

namespace {

using namespace talus;  // NOLINT: a test

// The hollow of the dam is uphill, left of its line; its continuations run north from (0, 20) and
// (40, 20).
struct Hollow {
  FenceRunGroup group;
  DamCase dam;

  Hollow() {
    dam.name = "road";
    dam.crest = 1;
    dam.capacity = 1e6;
    dam.line = record_line("dam.road", {{0, 20, 0}, {0, 0, 0}, {40, 0, 0}, {40, 20, 0}});
    group.members.resize(1);
    group.runs.resize(1);
    group.runs[0].at_fence.resize(2);
    group.clusters = clusters_of(group.members);
  }
  // A block that met the crest or what continues it, first in this direction.
  int add(bool beside, int direction, const Vec2& end, bool moves = false) {
    FenceRun& run = group.runs[0];
    const int block = static_cast<int>(run.end.size());
    run.end.emplace_back(end.x(), end.y(), 0);
    run.moves.push_back(moves);
    run.weight.push_back(1);
    run.volume.push_back(1);
    FenceArrival crossing;
    crossing.block = block;
    crossing.beside = beside;
    crossing.direction = direction;
    crossing.passed_for_good = true;
    run.at_fence[1].crossings.push_back(crossing);
    run.at_fence[1].verdicts.push_back(
        {0, block, beside ? Verdict::bypassed_left : Verdict::overtopped, 0});
    run.at_fence[0].verdicts.push_back({0, block, Verdict::not_reached, -1});
    return block;
  }
  Verdict verdict_of(int block) {
    set_verdicts(group, dam);
    return group.runs[0].at_fence[0].verdicts[block].verdict;
  }
};

}  // namespace

TEST(DamResult, BlocksBypassThatComeFromUphillAndEndDownhill) {
  Hollow hollow;
  const int into = hollow.add(true, 1, {10, 10}), out = hollow.add(true, -1, {-10, 5}),
            back = hollow.add(true, -1, {10, 60}), over = hollow.add(false, -1, {20, -9}),
            up = hollow.add(false, 1, {20, 9});
  EXPECT_EQ(hollow.verdict_of(into), Verdict::not_reached);
  EXPECT_EQ(hollow.verdict_of(out), Verdict::bypassed_left);
  EXPECT_EQ(hollow.verdict_of(back), Verdict::not_reached);
  EXPECT_EQ(hollow.verdict_of(over), Verdict::overtopped);
  EXPECT_EQ(hollow.verdict_of(up), Verdict::not_reached);
  EXPECT_EQ(dam_result(hollow.dam, hollow.group).passing.n, 1);
}

TEST(DamResult, NothingIsSaidWhileBlocksThatHaveNotPassedMove) {
  Hollow hollow;
  hollow.add(true, -1, {-10, 5}, true);  // past it: it may move
  set_verdicts(hollow.group, hollow.dam);
  EXPECT_EQ(dam_result(hollow.dam, hollow.group).verdict, DesignVerdict::nothing_came);
  hollow.add(true, 1, {10, 10}, true);
  set_verdicts(hollow.group, hollow.dam);
  const DamResult r = dam_result(hollow.dam, hollow.group);
  EXPECT_EQ(r.n_moving, 1);
  EXPECT_EQ(r.verdict, DesignVerdict::still_moving);
}

TEST(DamResult, NothingIsSaidWhereBlocksComeToTheCrestFromDownhill) {
  Hollow hollow;
  RunAtFence& before = hollow.group.runs[0].at_fence[0];
  const int up = hollow.add(false, 1, {20, 9});
  // it goes on over the line before the uphill face
  before.arrivals = hollow.group.runs[0].at_fence[1].crossings;
  before.verdicts[0].arrival = 0;
  EXPECT_EQ(hollow.verdict_of(up), Verdict::not_reached);
  DamResult r = dam_result(hollow.dam, hollow.group);
  EXPECT_EQ(r.arriving.n, 0);
  EXPECT_EQ(r.n_from_downhill, 1);
  EXPECT_EQ(r.verdict, DesignVerdict::from_downhill);
  hollow.add(false, -1, {20, -9});
  r = dam_result(hollow.dam, hollow.group);
  EXPECT_EQ(r.verdict, DesignVerdict::does_not_meet);
}

// As on a counter-slope: the ground rises away from where blocks come from.
TEST(DamResult, BlocksThatStayOnTheOtherSideAreNamedWhereNothingCame) {
  Hollow hollow;
  hollow.add(true, 1, {20, -9});
  hollow.add(true, 1, {10, 10});
  hollow.group.runs[0].at_fence[1].crossings.clear();
  set_verdicts(hollow.group, hollow.dam);
  const DamResult r = dam_result(hollow.dam, hollow.group);
  EXPECT_EQ(r.n_ended_downhill, 1);
  EXPECT_EQ(r.verdict, DesignVerdict::nothing_came);
  EXPECT_TRUE(r.text.ends_with("blocks that ended on the other side: 1")) << r.text;
}

// A roof 4 m wide on a straight wall, its edges at y = 4 and 0; rock lies on the ground 5 m below.
TEST(DamResult, RockAgainstTheUphillWallOfAGalleryDidNotComeToIt) {
  Hollow hollow;
  hollow.dam.is_gallery = true;
  hollow.dam.line = record_line("gallery.road", {{0, 0, 5}, {40, 0, 5}});
  FenceRun& run = hollow.group.runs[0];
  const auto at_edge = [&](const Vec3& end, bool for_good) {
    const int block = hollow.add(true, 1, {0, 0});
    run.end[block] = end;
    FenceArrival a;
    a.block = block;
    a.direction = -1;
    a.passed_for_good = for_good;
    run.at_fence[0].verdicts[block].arrival = static_cast<int>(run.at_fence[0].arrivals.size());
    run.at_fence[0].arrivals.push_back(a);
    return block;
  };
  const int fell_back = at_edge({20, 4.4, 0}, false), leans = at_edge({20, 3.9, 4.2}, true),
            rests = at_edge({20, 2, 5.4}, true), off_its_end = at_edge({41, 2, 0}, true);
  EXPECT_EQ(hollow.verdict_of(fell_back), Verdict::not_reached);
  EXPECT_EQ(hollow.verdict_of(leans), Verdict::not_reached);
  EXPECT_EQ(hollow.verdict_of(rests), Verdict::stopped);
  EXPECT_EQ(hollow.verdict_of(off_its_end), Verdict::stopped);
  EXPECT_EQ(dam_result(hollow.dam, hollow.group).arriving.n, 2);
}
