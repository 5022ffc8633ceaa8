// tests/fuzz/fuzz_site.cpp
// Site files: all sections, with fences and joint sets, up to the plan of the joint sets.
#include "fuzz.hpp"
#include "site/joint_plan.hpp"
#include "site/site.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return talus::accepts_or_refuses([&] {
    const talus::Site site = talus::parse_site(talus::text_of(data, size), "fuzz.toml");
    static_cast<void>(talus::effective_values(site));
    static_cast<void>(talus::print_config(site));
    static_cast<void>(
        talus::plan_joint_sets(site, std::vector<talus::OrientationList>(site.joints.size())));
  });
}
