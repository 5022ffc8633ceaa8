// libcore/verify/page.hpp
// The page of a study, docs/verification.md: what is claimed, against what, the error, the CPU
// time, the test; diagrams, stability chart, what leaving out saves, and what is not verified.
// in:    everything that was measured
// out:   Markdown, nothing of it written by hand
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "verify/leaving_out.hpp"
#include "verify/slide_study.hpp"
#include "verify/stability.hpp"

namespace talus {

/// A study; what was not run is empty.
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

/// `pictures`: where the diagrams stand, as seen from the page, with a slash at its end or empty.
[[nodiscard]] std::string study_page(const Study& study, const std::string& pictures);

/// The page's last part: what no case, corner or scene of the study shows.
[[nodiscard]] std::string not_verified();

}  // namespace talus
