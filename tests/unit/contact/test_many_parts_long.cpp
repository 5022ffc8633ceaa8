// The long form of test_many_parts.cpp.
#include <gtest/gtest.h>

#include "many_parts.hpp"

namespace {

TEST(ManyPartsLong, TenThousandPairsAreSupportedAlongTheLeastPathOut) {
  EXPECT_LE(talus::test::follow_pairs(10000), 2);
}

}  // namespace
