// verify/study/slide_study.hpp
// The slide of 39 blocks, for which nothing exact is known: means of many starts at several
// settings, and their distance from the limit of short steps.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "base/progress.hpp"
#include "verify/study/ensemble.hpp"
#include "verify/study/peers.hpp"

namespace talus {

/// As named on the command line and in file names.
inline constexpr const char* slide_name = "slide39";

/// Claims on the slide in the table of cases, by Quantity.
[[nodiscard]] const std::array<VerifyCase, 3>& slide_claims();

struct SlideStudy {
  std::vector<EnsembleResult> results;  ///< defaults last, from the longest step
  EnsembleReference reference;
  double path = 0;  ///< of the centre, reference [m]
};
/// `full`: 32 runs of 20 s a step at the defaults, 4 at other settings, 2 of law paper, a quarter
/// of an hour; else one of 4 s. `progress` is called before every run.
[[nodiscard]] SlideStudy study_slide(const SlideData& data, bool full,
                                     const ProgressFunction& progress = {});

/// The three quantities as cases; other engines have a centre alone.
[[nodiscard]] std::vector<MeasuredCase> measured_of(const SlideStudy& study,
                                                    const std::vector<PeerSlide>& peers);

/// The reference and its uncertainty, a line a quantity.
[[nodiscard]] std::string slide_reference(const SlideStudy& study);

}  // namespace talus
