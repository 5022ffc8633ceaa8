// verify/study/page.hpp
// The page of a study, docs/evidence/verification.md: claims, references, errors, CPU times, tests;
// diagrams, stability chart, savings of the scene plan, and parts not verified.
// in:    everything that was measured, and the page's text with marks (page.md.in)
// out:   Markdown, each figure of it from the measurements
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "verify/study/leaving_out.hpp"
#include "verify/study/slide_study.hpp"
#include "verify/study/stability.hpp"

namespace talus {

/// A study; parts that were not run are empty.
struct Study {
  std::string commit, commit_date, machine;
  std::string command;  ///< that makes it again
  bool full = false;
  std::vector<MeasuredCase> cases;  ///< those of the slide too
  std::optional<SlideStudy> slide;
  std::vector<StabilityRow> corners;
  std::vector<OmissionRow> omissions;
};

/// How many corners came out how: "89 corners: 85 right, ...".
[[nodiscard]] std::string corner_counts(const std::vector<StabilityRow>& corners);

/// `page_template`: content of page.md.in. `pictures`: where the diagrams are, as seen from the
/// page, with a slash at its end or empty.
[[nodiscard]] std::string study_page(const std::string& page_template, const Study& study,
                                     const std::string& pictures);

}  // namespace talus
