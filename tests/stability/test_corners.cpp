// Every corner of the stability chart: finite, no energy from nothing, no block in the ground, and
// as right as the chart in docs/evidence/verification.md says.
#include <gtest/gtest.h>

#include <ostream>
#include <string>

#include "verify/study/stability.hpp"

namespace talus {

void PrintTo(const Corner& corner, std::ostream* out) {
  *out << corner.axis << ' ' << corner.value << ' ' << corner.unit;
}

}  // namespace talus

namespace {

using namespace talus;

class Corners : public testing::TestWithParam<Corner> {};

std::string name_of(const testing::TestParamInfo<Corner>& info) {
  std::string name = info.param.axis + "_" + std::to_string(info.index);
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return name;
}
INSTANTIATE_TEST_SUITE_P(Stability, Corners, testing::ValuesIn(stability_corners()), name_of);

// Corners that the chart shows outside their tolerance: contacts too soft for the weight on them.
bool is_known_to_err(const Corner& c) { return c.axis == "k_n" && c.value <= 1e6; }

TEST_P(Corners, IsRight) {
  const StabilityRow row = run_corner(GetParam());
  EXPECT_EQ(text_of(row.outcome), is_known_to_err(GetParam()) ? "inexact" : "right")
      << row.corner.axis << " " << row.corner.value << ": error " << row.seen.error << ", gain "
      << row.seen.gain << ", depth " << row.seen.depth << ", " << row.seen.refusal;
}

// The verdict itself: each thing that must not happen is seen.
TEST(Judge, SeesWhatMustNotHappen) {
  const Corner corner{"a", 1, "1", "s", "relative", 1e-3, {}};
  EXPECT_EQ(judge(corner, {5e-4, true, 0, 0, ""}), Outcome::right);
  EXPECT_EQ(judge(corner, {5e-3, true, 0, 0, ""}), Outcome::inexact);
  EXPECT_EQ(judge(corner, {5e-4, false, 0, 0, ""}), Outcome::broken);
  EXPECT_EQ(judge(corner, {5e-4, true, 0.1, 0, ""}), Outcome::broken);
  EXPECT_EQ(judge(corner, {5e-4, true, 0, 0.05, ""}), Outcome::inexact);
  EXPECT_EQ(judge(corner, {5e-4, true, 0, 0.2, ""}), Outcome::broken);
  EXPECT_EQ(judge(corner, {std::nan(""), true, 0, 0, ""}), Outcome::broken);
  EXPECT_EQ(judge(corner, {0, true, 0, 0, "", true}), Outcome::broken);
  EXPECT_EQ(judge(corner, {0, true, 0, 0, "no"}), Outcome::refused);
}

}  // namespace
