// Every case of talus-verify at the default settings: below the bound that its table names.
#include <gtest/gtest.h>

#include <ostream>
#include <string>
#include <vector>

#include "verify/cases/verify_cases.hpp"

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

void expect_within_bound(const VerifyCase& c, const CaseSettings& settings) {
  const cases::CaseResult result = c.run(settings);
  EXPECT_LT(result.error, c.bound) << c.norm;
  EXPECT_EQ(result.unconverged, 0);
  for (const StepFlag lost :
       {StepFlag::not_finite, StepFlag::left_domain, StepFlag::fell_through, StepFlag::deep})
    EXPECT_FALSE(has(result.flags, lost));
}

TEST_P(EachCase, IsWithinItsBound) { expect_within_bound(GetParam(), {}); }

// Blocks that touch each other are computed rigid.
class EachCaseOfOneBlock : public EachCase {};

std::vector<VerifyCase> cases_of_one_block() {
  std::vector<VerifyCase> list = verify_cases();
  const double dt = Settings{}.dt;
  std::erase_if(list,
                [=](const VerifyCase& c) { return c.n_blocks > 1 || c.shortest_strained_dt > dt; });
  return list;
}
INSTANTIATE_TEST_SUITE_P(Verify, EachCaseOfOneBlock, testing::ValuesIn(cases_of_one_block()),
                         name_of);

TEST_P(EachCaseOfOneBlock, IsWithinItsBoundWithStrains) {
  CaseSettings settings;
  settings.strains = true;
  expect_within_bound(GetParam(), settings);
}

}  // namespace
