// The page of a study, and docs/evidence/verification.md as the program would write it now.
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <sstream>

#include "base/error.hpp"
#include "base/read_file.hpp"
#include "base/text.hpp"
#include "verify/study/page.hpp"

namespace {

using namespace talus;

const std::string source = TALUS_SOURCE_DIR;
const std::string page_template = read_file(source + "/verify/study/page.md.in");

bool contains(const std::string& whole, const std::string& part) {
  return whole.find(part) != std::string::npos;
}

StabilityRow corner_of(Outcome outcome) {
  StabilityRow row;
  row.corner = {"speed", 200, "m/s", "a rock", "", 0, {}};
  row.outcome = outcome;
  return row;
}

TEST(StudyPage, SaysWhatWasRunAndNothingElse) {
  Study study;
  study.commit = "0123abc";
  study.commit_date = "2026-11-25";
  MeasuredCase measured;
  measured.about = &verify_cases().front();
  VerifyRow row;
  row.method = row.law = "talus";
  row.dt = Settings{}.dt;
  measured.rows = {row};
  study.cases = {measured};
  std::string page = study_page(page_template, study, "diagrams/");
  EXPECT_TRUE(contains(page, "Commit 0123abc of 2026-11-25"));
  EXPECT_TRUE(contains(page, "1 of 1 case within their bounds"));
  EXPECT_TRUE(contains(page, "(diagrams/" + measured.about->name + ".svg)"));
  for (const char* part : {"## The slide", "## Stability chart", "## Leaving out"})
    EXPECT_FALSE(contains(page, part)) << part;
  study.cases[0].rows[0].error = 1;
  study.corners = {corner_of(Outcome::right), corner_of(Outcome::broken),
                   corner_of(Outcome::right)};
  study.omissions.resize(2);
  study.omissions[0].holds = true;
  page = study_page(page_template, study, "");
  EXPECT_TRUE(contains(page, "0 of 1 case within their bounds"));
  EXPECT_TRUE(contains(page, "3 corners: 2 right, 0 inexact, 0 refused, 1 broken."));
  EXPECT_TRUE(contains(page, "| speed | 200 m/s | a rock | **broken** | - | - |"));
  EXPECT_TRUE(contains(page, "1 of 2 rows hold"));
  EXPECT_TRUE(contains(page, "**does not hold**"));
}

TEST(StudyPage, OfAQuickStudySaysThatItsRatiosSayLittle) {
  Study study;
  EXPECT_TRUE(contains(study_page(page_template, study, ""), "its ratios say little"));
  study.full = true;
  EXPECT_FALSE(contains(study_page(page_template, study, ""), "its ratios say little"));
}

// No mark is left in the page, and each figure is on it: a template without its mark is refused.
TEST(StudyPage, FillsEveryMark) {
  Study study;
  study.slide.emplace();
  study.corners = {corner_of(Outcome::right)};
  study.omissions.resize(1);
  EXPECT_FALSE(contains(study_page(page_template, study, ""), "{{"));
  std::string without = page_template;
  without.erase(without.find("{{corner_table}}"), std::string("{{corner_table}}").size());
  EXPECT_THROW((void)study_page(without, study, ""), InputError);
}

// Where one of these fails, the claims have changed since the page was made: make it anew with the
// command on it.
class CommittedPage : public testing::Test {
 protected:
  const std::string page = read_file(source + "/docs/evidence/verification.md");
};

TEST_F(CommittedPage, HasEveryCaseAsItIsNow) {
  std::vector<VerifyCase> all = verify_cases();
  all.insert(all.end(), slide_claims().begin(), slide_claims().end());
  for (const VerifyCase& c : all) {
    EXPECT_TRUE(contains(page, "| [`" + c.name + "`](verification/" + c.name + ".svg) | " +
                                   c.claim + " | " + c.reference + " | " + c.norm + " | "))
        << c.name;
    EXPECT_TRUE(contains(page, "| `" + c.test + "` |")) << c.test;
  }
}

TEST_F(CommittedPage, HasEveryCornerAndOmissionAsItIsNow) {
  const std::string corners = read_file(source + "/docs/evidence/verification/stability.csv");
  for (const Corner& c : stability_corners())
    EXPECT_TRUE(contains(
        corners, "\"" + c.axis + "\"," + text(c.value) + "," + c.unit + ",\"" + c.scene + "\","))
        << c.axis << " " << c.value;
  const SlideData none;  // the scenes are named, not run
  for (const Omission& omission : omissions(none, true))
    EXPECT_TRUE(contains(page, "| " + omission.item + " | " + omission.scene + " |"))
        << omission.item << ", " << omission.scene;
  EXPECT_FALSE(contains(page, "**does not hold**"));
  EXPECT_FALSE(contains(page, "**broken**"));
}

// All prose of the template but the parts that a full study leaves out.
TEST_F(CommittedPage, HasTheProseOfTheTemplate) {
  std::istringstream lines(page_template);
  int n_compared = 0;
  bool is_of_quick = false;
  for (std::string line; std::getline(lines, line);) {
    if (line == "{{#quick}}" || line == "{{/quick}}") is_of_quick = !is_of_quick;
    if (is_of_quick || line.empty() || contains(line, "{{")) continue;
    EXPECT_TRUE(contains(page, "\n" + line + "\n") || page.rfind(line + "\n", 0) == 0) << line;
    ++n_compared;
  }
  EXPECT_GT(n_compared, 30);
}

TEST_F(CommittedPage, IsOfTheFullStudyOfACommit) {
  EXPECT_TRUE(std::regex_search(page, std::regex("Commit [0-9a-f]{10} of \\d{4}-\\d\\d-\\d\\d, ")))
      << page.substr(0, 700);
  EXPECT_TRUE(contains(page, " full study."));
  const std::regex picture("\\]\\((verification/[^)]*)\\)");
  for (std::sregex_iterator it(page.begin(), page.end(), picture), end; it != end; ++it)
    EXPECT_TRUE(std::filesystem::exists(source + "/docs/evidence/" + it->str(1))) << it->str(1);
}

// A test that a case names exists: TEST, TEST_F or TEST_P of that suite and name.
TEST(VerifyCases, NameTestsThatExist) {
  std::string sources;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(source + "/tests"))
    if (entry.path().extension() == ".cpp") sources += read_file(entry.path().string());
  std::vector<VerifyCase> all = verify_cases();
  all.insert(all.end(), slide_claims().begin(), slide_claims().end());
  for (const VerifyCase& c : all) {
    const std::string name = c.test.substr(c.test.find('/') + 1);  // without its instantiation
    const auto dot = name.find('.');
    EXPECT_TRUE(contains(sources, "(" + name.substr(0, dot) + ", " + name.substr(dot + 1) + ")"))
        << c.test;
  }
}

}  // namespace
