// verify/study/page.hpp
// Makes docs/evidence/verification.md, the report of talus-verify, from what was measured: cases,
// diagrams, extreme settings, and what a scene saves by parts that it leaves out.
// in:    the measurements, and a template with placeholders (page.md.in)
// out:   Markdown whose numbers are those of the measurements
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
  std::string command;  ///< line that reproduces the study
  bool full = false;
  std::vector<MeasuredCase> cases;  ///< with those of the slide
  std::optional<SlideStudy> slide;
  std::vector<StabilityRow> corners;
  std::vector<OmissionRow> omissions;
};

/// Summary of the extreme settings (corners of the range of inputs): "89 corners: 85 right, ...".
[[nodiscard]] std::string corner_counts(const std::vector<StabilityRow>& corners);

/// `page_template`: content of page.md.in. `pictures`: prefix of the diagrams' paths as
/// seen from the page, empty or with a slash at its end.
[[nodiscard]] std::string study_page(const std::string& page_template, const Study& study,
                                     const std::string& pictures);

}  // namespace talus
