#include <gtest/gtest.h>

#include "many_parts.hpp"

namespace {

TEST(ManyParts, AreBorneAlongTheLeastPathOut) { EXPECT_EQ(talus::test::follow_pairs(300), 0); }

}  // namespace
