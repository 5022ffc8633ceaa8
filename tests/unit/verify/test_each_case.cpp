// Every case of talus-verify at the default settings: below the bound that its table names.
#include <gtest/gtest.h>

#include <ostream>
#include <string>

#include "verify/verify_cases.hpp"

namespace talus {

void PrintTo(const VerifyCase& c, std::ostream* out) { *out << c.claim; }

}  // namespace talus

namespace {

using namespace talus;

class EachCase : public testing::TestWithParam<VerifyCase> {};

std::string name_of(const testing::TestParamInfo<VerifyCase>& info) {
  std::string name = info.param.name;
  for (char& c : name)
    if (c == '.') c = '_';
  return name;
}
INSTANTIATE_TEST_SUITE_P(Verify, EachCase, testing::ValuesIn(verify_cases()), name_of);

TEST_P(EachCase, IsWithinItsBound) {
  const cases::CaseResult result = GetParam().run({});
  EXPECT_LT(result.error, GetParam().bound) << GetParam().norm;
  EXPECT_EQ(result.unconverged, 0);
  for (const StepFlag lost :
       {StepFlag::not_finite, StepFlag::left_domain, StepFlag::fell_through, StepFlag::deep})
    EXPECT_FALSE(has(result.flags, lost));
}

}  // namespace
