// Bodies of many parts: contacts push along the least path out.
#include <gtest/gtest.h>

#include "many_parts.hpp"

namespace {

TEST(ManyParts, AreSupportedAlongTheLeastPathOut) { EXPECT_EQ(talus::test::follow_pairs(300), 0); }

}  // namespace
